"""Two photographs beside each other: what is equal, what is within round-off, what differs.

The numbers of a walk may differ by what a start moved by 1e-14 of itself changes in them, times `FACTOR`, and
by `FLOOR` in any case, in units of max(1, |x|). Other numbers, of which nothing like that is recorded, may
differ by `RELATIVE` of themselves or by `SMALL`; numbers within texts too, or by one in the last of four or
more digits.
"""

from __future__ import annotations

import difflib
import fnmatch
import html
import json
import math
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from tests.photograph.adapter.walks import apart

FACTOR = 100.0
FLOOR = 1e-11
MOST = 0.1
"""Where more than this would be allowed, a walk says nothing: a change of round-off ends elsewhere."""
RELATIVE, SMALL = 1e-7, 1e-9
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
EQUAL, WITHIN, UNJUDGED, ALLOWED, DIFFERS = "equal", "within", "unjudged", "allowed", "differs"
WORDS = (EQUAL, WITHIN, UNJUDGED, ALLOWED, DIFFERS)


class Finding(NamedTuple):
    """One thing that was compared; `key` names it, `kind` is its row in the table."""

    kind: str
    key: str
    word: str
    text: str = ""


@dataclass
class Comparison:
    """Findings, and how far walks are apart in units of what is allowed."""

    findings: list[Finding] = field(default_factory=list)
    shares: list[float] = field(default_factory=list)
    sensitive: int = 0
    left_out: list[str] = field(default_factory=list)
    """Files that one of the two has not."""

    def add(self, kind: str, key: str, word: str, text: str = "") -> None:
        """One more."""
        self.findings.append(Finding(kind, key, word, text))

    def allow(self, allowed: list[tuple[str, str]]) -> None:
        """What an allowed difference names is one no longer."""
        for i, f in enumerate(self.findings):
            reason = next((why for glob, why in allowed if fnmatch.fnmatchcase(f.key, glob)), None)
            if f.word in (DIFFERS, UNJUDGED) and reason is not None:
                self.findings[i] = f._replace(word=ALLOWED, text=reason)

    @property
    def broken(self) -> list[Finding]:
        """What differs."""
        return [f for f in self.findings if f.word == DIFFERS]

    def table(self) -> str:
        """How many of what, by kind."""
        counts = Counter((f.kind, f.word) for f in self.findings)
        kinds = list(dict.fromkeys(f.kind for f in self.findings))
        lines = [f"{'':34s}" + "".join(f"{word:>10s}" for word in WORDS)]
        for kind in kinds:
            lines.append(f"{kind:34s}" + "".join(f"{counts[kind, word]:10d}" for word in WORDS))
        return "\n".join(lines)

    def distribution(self) -> str:
        """Of the distances of walks that are not bit for bit the same."""
        if not self.shares:
            return "all walks that both have are the same bit for bit"
        ranked = sorted(self.shares)
        marks = (0.1, 0.5, 0.9, 0.99, 1.0)
        at = [
            f"{100 * m:g} %: {ranked[min(int(m * len(ranked)), len(ranked) - 1)]:.1e}"
            for m in marks
        ]
        return (
            f"{len(ranked)} groups of numbers are not the same bit for bit; distance over what is allowed "
            f"({FACTOR:g} times what a change of 1e-14 does, at least {FLOOR:g}): {', '.join(at)}"
        )


# -- numbers and texts -----------------------------------------------------------------------------
def close(a: float, b: float) -> bool:
    """Within what is allowed of a number of which nothing else is known."""
    return a == b or abs(a - b) <= max(RELATIVE * max(abs(a), abs(b)), SMALL)


def text_word(a: str, b: str) -> str:
    """Whether two texts are equal, or equal but for round-off in their numbers; &#39; and &#x27; are one."""
    a, b = html.unescape(a), html.unescape(b)
    if a == b:
        return EQUAL
    if NUMBER.sub("#", a) != NUMBER.sub("#", b):
        return DIFFERS
    pairs = zip(NUMBER.findall(a), NUMBER.findall(b), strict=True)
    same = all(x == y or text_close(x, y) for x, y in pairs)
    return WITHIN if same else DIFFERS


def text_close(x: str, y: str) -> bool:
    """Two printed numbers: by their values, or by one in the last of at least four digits."""
    if close(float(x), float(y)):
        return True
    (p, u), (q, w) = scaled(x), scaled(y)
    return u == w and max(abs(p), abs(q)) >= 1000 and abs(p - q) <= 1


def scaled(x: str) -> tuple[int, int]:
    """A printed number as a whole one, and the power of ten of its last digit."""
    mantissa, _, exponent = x.lower().partition("e")
    whole, _, rest = mantissa.partition(".")
    return int(whole + rest), int(exponent or 0) - len(rest)


def leaf_word(a: Any, b: Any) -> str:
    """Of two values that are no dicts."""
    if type(a) is type(b) and a == b:
        return EQUAL
    if isinstance(a, str) and isinstance(b, str):
        return text_word(a, b)
    if isinstance(a, bool) or isinstance(b, bool) or a is None or b is None:
        return DIFFERS
    if isinstance(a, int | float) and isinstance(b, int | float):
        same = a == b or (math.isnan(a) and math.isnan(b))
        return EQUAL if same else WITHIN if close(a, b) else DIFFERS
    return DIFFERS


def leaves(tree: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Values by their path."""
    if isinstance(tree, dict) and tree:
        for k, x in tree.items():
            yield from leaves(x, f"{path}/{k}")
    elif isinstance(tree, list) and tree:
        for i, x in enumerate(tree):
            yield from leaves(x, f"{path}/{i}")
    else:
        yield path, tree


def tree_words(c: Comparison, kind: str, key: str, a: Any, b: Any) -> None:
    """All values of two trees."""
    before, after = dict(leaves(a)), dict(leaves(b))
    for path in dict.fromkeys((*before, *after)):
        if path not in after or path not in before:
            gone = "is gone" if path in before else "is new"
            c.add(kind, key + path, DIFFERS, f"{gone}: {short(before.get(path, after.get(path)))}")
            continue
        word = leaf_word(before[path], after[path])
        text = "" if word in (EQUAL, WITHIN) else diff(before[path], after[path])
        c.add(kind, key + path, word, text)


def short(x: Any) -> str:
    """At most a line of it."""
    text = x if isinstance(x, str) else json.dumps(x)
    return text if len(text) <= 160 else text[:157] + "..."


def diff(a: Any, b: Any) -> str:
    """What was and what is; of long texts their differing lines."""
    if isinstance(a, str) and isinstance(b, str) and ("\n" in a + b or len(a + b) > 300):
        a, b = (re.sub(r"([.;:]) ", r"\1\n", x) if "\n" not in x else x for x in (a, b))
        lines = difflib.unified_diff(a.splitlines(), b.splitlines(), "before", "after", "", "", 1)
        return "\n".join(line.rstrip("\n") for line in lines)
    return f"before: {short(a)}\nafter:  {short(b)}"


# -- walks -----------------------------------------------------------------------------------------
def walk_words(c: Comparison, key: str, a: Any, b: Any) -> None:
    """One scenario in one engine."""
    if "error" in a or "error" in b:
        names = ("error", "text")
        tree_words(c, "scenarios: errors", key, *({n: x.get(n) for n in names} for x in (a, b)))
        return
    for name in dict.fromkeys((*a["words"], *b["words"])):
        x, y = a["words"].get(name), b["words"].get(name)
        word = leaf_word(x, y)
        text = "" if word in (EQUAL, WITHIN) else diff(x, y)
        if word == DIFFERS and name == "detail" and vague(a["deviation"]):
            word = UNJUDGED
        c.add(f"scenarios: {name if name in NAMED else 'row, words'}", f"{key}/{name}", word, text)
    if a["deviation"] is None:
        c.sensitive += 1
    same = all(a["words"].get(name) == b["words"].get(name) for name in ("status", "impacts"))
    if same:
        number_words(c, key, a, b)


def vague(deviation: dict[str, float] | None) -> bool:
    """Whether round-off decides how a walk ends."""
    return deviation is None or not FACTOR * max(deviation.values(), default=0.0) < MOST


NAMED = ("status", "detail", "impacts", "method", "engine", "why")


def number_words(c: Comparison, key: str, a: Any, b: Any) -> None:
    """The numbers of a walk, group by group."""
    deviation = a["deviation"]
    kind = "scenarios: row, numbers" if key.endswith("/row") else "scenarios: states"
    for name in dict.fromkeys((*a["numbers"], *b["numbers"])):
        x, y = a["numbers"].get(name), b["numbers"].get(name)
        at = f"{key}/{name}"
        if x is None or y is None or len(x) != len(y):
            c.add(kind, at, DIFFERS, f"before: {short(x)}\nafter:  {short(y)}")
            continue
        gap = apart(x, y)
        if gap == 0.0:
            c.add(kind, at, EQUAL)
        elif deviation is None or not FACTOR * deviation[name] < MOST:
            c.add(kind, at, UNJUDGED, f"apart by {gap:.1e}; a change of 1e-14 ends otherwise")
        else:
            allowed = max(FLOOR, FACTOR * deviation[name])
            c.shares.append(gap / allowed)
            word = WITHIN if gap <= allowed else DIFFERS
            c.add(kind, at, word, f"apart by {gap:.1e}, allowed {allowed:.1e}")


def scenario_words(c: Comparison, before: Any, after: Any) -> None:
    """All scenarios that both have."""
    for k in (k for k in before if k in after):
        a, b = before[k], after[k]
        c.add(
            "scenarios: drawn",
            f"scenarios/{k}/scenario",
            EQUAL if a["scenario"] == b["scenario"] else DIFFERS,
        )
        for part in dict.fromkeys((*a["found"], *b["found"])):
            if part not in b["found"] or part not in a["found"]:
                c.add("scenarios: errors", f"scenarios/{k}/{part}", DIFFERS, "only one has it")
                continue
            walk_words(c, f"scenarios/{k}/{part}", a["found"][part], b["found"][part])


# -- all of it -------------------------------------------------------------------------------------
KINDS = {
    "help": "help",
    "commands": "calls",
    "summary": "summary.json",
    "reports": "runs and reports",
}


def compared(before: Path, after: Path) -> Comparison:
    """Two folders. Raises ValueError where there is nothing that both have recorded."""
    c = Comparison()
    old, new = ({p.stem: p for p in folder.glob("*.json")} for folder in (before, after))
    both = [name for name in ("scenarios", *KINDS) if name in old and name in new]
    if not both:
        raise ValueError(
            f"'{before}' has {sorted(old)}, '{after}' has {sorted(new)}: nothing in common"
        )
    for name in both:
        a, b = (json.loads(files[name].read_text(encoding="utf-8")) for files in (old, new))
        if name == "scenarios":
            scenario_words(c, a, b)
            continue
        for k in dict.fromkeys((*a, *b)):
            x, y = ({k: tree[k]} if k in tree else {} for tree in (a, b))
            if name == "commands":
                call_words(c, k, x.get(k, {}), y.get(k, {}))
            else:
                kind = KINDS[name] + (f": {k.partition('/')[0]}" if name == "reports" else "")
                tree_words(c, kind, name, x, y)
    c.left_out = sorted({*old, *new} - {*both, "about"})
    return c


def call_words(c: Comparison, key: str, a: Any, b: Any) -> None:
    """What a call left, by what it is."""
    for name in dict.fromkeys((*a, *b)):
        tree_words(
            c,
            f"calls: {name}",
            f"commands/{key}",
            *({name: paired(x[name])} if name in x else {} for x in (a, b)),
        )


def paired(tree: Any) -> Any:
    """The runs and points of a file of results in the order of what they found, not of their hashed names."""
    if isinstance(tree, list):
        return [paired(x) for x in tree]
    if not isinstance(tree, dict):
        return tree
    order = {"runs": lambda run: found(run["row"]), "points": lambda point: found(point["at"])}
    return {
        k: sorted(x, key=order[k]) if k in order and isinstance(x, list) else paired(x)
        for k, x in tree.items()
    }


def found(row: dict[str, Any]) -> list[tuple[str, str]]:
    """Values by name, numbers with six digits."""
    return sorted((k, f"{x:.6g}" if isinstance(x, float) else str(x)) for k, x in row.items())


def allowed_in(path: Path | None) -> list[tuple[str, str]]:
    """Pairs of pattern and reason: lines `PATTERN  # reason`. Raises ValueError for a line without a reason."""
    pairs = []
    for line in [] if path is None else path.read_text(encoding="utf-8").splitlines():
        pattern, sign, reason = line.partition("  # ")
        if not line.strip() or line.startswith("#"):
            continue
        if not sign or not reason.strip():
            raise ValueError(f"'{line}' has no reason; expected 'PATTERN  # reason'")
        pairs.append((pattern.strip(), reason.strip()))
    return pairs
