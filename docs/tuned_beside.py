"""What the leaves of tuned settings are worth, and their largest legal pushes, from what beside.py walked."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import tuned_text as words
from tuned_entries import Entry, key_of, reference, walks_of
from tuned_questions import LEVEL, WORST, Answer, Group, answered
from tuned_text import MRAD, at, name, number, ratio

from biped_adrc.analysis.statistics import Interval, holm, over_seeds, sign_test
from biped_adrc.types import Array


class Worth(NamedTuple):
    """A setting held against the same one without a leaf."""

    leaf: str
    """Its name in contest.toml."""
    answer: Answer
    """a: with it, b: without."""


def worths(summary: Mapping[str, Any], found: Sequence[Entry]) -> list[Worth]:
    """Every setting held against itself without each leaf, one family."""
    by_key = {key_of(e._asdict()): e for e in found}
    leaves, pairs = [], []
    for told in summary["beside"].get("without", []):
        e = by_key.get(key_of(told))
        if e is not None:
            leaves.append(told["leaf"])
            pairs.append((e, e._replace(tuned=walks_of(told["walks"]))))
    return [Worth(*x) for x in zip(leaves, answered(pairs), strict=True)]


def worth_sentences(summary: Mapping[str, Any], found: Sequence[Entry]) -> list[str]:
    """For each leaf what it is worth, over contestants, places and gaits."""
    asked, lines = worths(summary, found), []
    for leaf, given in summary["contest"]["leaves"].items():
        here = [x.answer for x in asked if x.leaf == leaf]
        if not here:
            continue
        kinds = words.by_verdict(here, lambda x: f"{name(x.a)} at {at(x.a)}")
        counts = {kind: len(some) for kind, some in kinds.items()}
        typical = sorted(x.ratio.value for x in here)[(len(here) - 1) // 2]
        middle = ratio(Interval(typical, typical, typical)).split(" (")[0]
        harm = f", which are {'; '.join(kinds['larger'])}" if kinds["larger"] else ""
        bound = max((x.within for x in here if x.verdict == "open"), default=1.0)
        still = f" (within a factor {number(bound)})" if 1.0 < bound < words.NEVER else ""
        lines.append(
            f"**{given['words']}**: of {len(here)} settings that have it, {counts['smaller']} have a smaller "
            f"error with it, {counts['larger']} a larger one{harm}, and {counts['open']} are open{still}; the "
            f"middle ratio is {middle}."
        )
    return lines


def worth_rows(
    summary: Mapping[str, Any], found: Sequence[Entry]
) -> tuple[list[str], list[list[str]]]:
    """Headings and rows of a table: settings down, leaves across, the ratio with to without."""
    leaves = list(summary["contest"]["leaves"])
    cells: dict[tuple[str, str], dict[str, str]] = {}
    for x in worths(summary, found):
        told = ratio(x.answer.ratio) + (" (open)" if x.answer.verdict == "open" else "")
        cells.setdefault((at(x.answer.a), x.answer.a.contestant), {})[x.leaf] = told
    head = [
        "place, gait",
        "contestant",
        *(summary["contest"]["leaves"][k]["words"] for k in leaves),
    ]
    return head, [[*key, *(row.get(k, "–") for k in leaves)] for key, row in cells.items()]


def with_all_leaves(summary: Mapping[str, Any], groups: Sequence[Group]) -> list[str]:
    """What NPD reaches with all leaves, beside the best one, where leaves are offered."""
    lines = []
    for g in groups:
        npd = g.get("NPD")
        if npd is None or not summary["contest"]["places"][npd.place]["leaves"]:
            continue
        some = [e for e in g.values() if e.found and e is not npd]
        if not npd.found:
            lines.append(f"{at(npd)}: with all leaves *NPD* has no setting that keeps the limits.")
        elif some:
            best = min(some, key=lambda e: e.selected)
            lines.append(
                f"{at(npd)}: with all leaves *NPD* reaches {words.error(npd.tuned)} mrad with "
                f"{words.legal(npd.tuned)} walks legal; {name(best)}, the best of the others, "
                f"{words.error(best.tuned)} mrad with {words.legal(best.tuned)}."
            )
    return lines


class Pushes(NamedTuple):
    """The largest legal pushes of a setting held against those of another, known to intervals alone."""

    a: Entry
    b: Entry
    median: tuple[float, float]
    """Bounds of the median of a [N m]."""
    low: Interval
    """Median ratio with the lower ends of a and the upper ends of b."""
    high: Interval
    """Median ratio with the upper ends of a and the lower ends of b."""
    won: int
    """Seeds in which a bears more for certain: its interval is above that of b."""
    lost: int
    """Seeds in which it bears less for certain."""
    p: float
    """Of the sign test over those seeds, corrected by Holm's method."""

    @property
    def verdict(self) -> str:
        """Whether a bears "larger" or "smaller" pushes; "open" where that is not carried."""
        if self.p < LEVEL and self.low.low > 1.0:
            return "larger"
        return "smaller" if self.p < LEVEL and self.high.high < 1.0 else "open"

    @property
    def within(self) -> float:
        """The factor within which both are of each other, with 95 %, wherever in its interval a push lies."""
        return max(self.high.high, 1.0 / self.low.low)


def pushes(summary: Mapping[str, Any], groups: Sequence[Group]) -> list[Pushes]:
    """The largest legal pushes of all contestants held against those of the reference, one family."""
    known = summary["beside"].get("pushes", [])
    ends = {key_of(x): np.array(x["ends"], dtype=float) for x in known}
    found = []
    for g in groups:
        base = reference(g)
        keys = {e.contestant: key_of(e._asdict()) for e in g.values()}
        if base is None or (of_base := ends.get(keys[base.contestant])) is None:
            continue
        found += [
            _compared(e, base, ends[keys[name]], of_base)
            for name, e in g.items()
            if e is not base and keys[name] in ends
        ]
    return [x._replace(p=p) for x, p in zip(found, holm([x.p for x in found]), strict=True)]


def _compared(a: Entry, b: Entry, x: Array, y: Array) -> Pushes:
    """The ends x of a beside the ends y of b, each (seeds, 2) [N m]."""
    low, high = (_median(_logs(x[:, i], y[:, 1 - i])) for i in (0, 1))
    won, lost = int(np.sum(x[:, 0] >= y[:, 1])), int(np.sum(x[:, 1] <= y[:, 0]))
    both = int(
        np.sum((x[:, 0] >= y[:, 1]) & (x[:, 1] <= y[:, 0]))
    )  # the same number, known exactly
    median = float(np.median(x[:, 0])), float(np.median(x[:, 1]))
    won, lost = won - both, lost - both
    return Pushes(a, b, median, low, high, won, lost, sign_test(won, lost))


def _logs(x: Array, y: Array) -> Array:
    """log(x / y) of numbers that may be 0 or infinite, at most log of `WORST` in size; 0 for two zeros."""
    with np.errstate(divide="ignore", invalid="ignore"):
        found = np.log(x) - np.log(y)
    found[np.isnan(found)] = 0.0
    return np.clip(found, -np.log(WORST), np.log(WORST))


def _median(logs: Array) -> Interval:
    found = over_seeds(logs[None, :], lambda sets: np.median(sets, axis=1))
    return Interval(*np.exp(found).tolist())


def push_sentences(asked: Sequence[Pushes]) -> list[str]:
    """What each contestant's largest legal push is beside that of the reference."""
    lines = []
    for x in asked:
        bounds = " to ".join(number(y) for y in x.median)
        told = {
            "larger": f"bears larger pushes than {name(x.b)}, by a median factor of at least "
            f"{number(x.low.low)}",
            "smaller": f"bears smaller pushes than {name(x.b)}, by a median factor of at most "
            f"{number(x.high.high)}",
            "open": f"is open against {name(x.b)}",
        }[x.verdict]
        bound = ""
        if x.verdict == "open":
            bound = (
                f", within a factor {number(x.within)} of each other"
                if x.within < words.NEVER
                else ", without a bound"
            )
        lines.append(
            f"{at(x.a)}: {name(x.a)} {told}{bound}; median {bounds} N m, larger for certain in {x.won} seeds, "
            f"smaller in {x.lost} (p {words.p_value(x.p)})."
        )
    return lines


def unsearched_sentences(summary: Mapping[str, Any], groups: Sequence[Group]) -> list[str]:
    """What settings that no search has made do beside the best searched one, and which limit they miss."""
    lines = []
    for told in summary["beside"].get("unsearched", []):
        walks = walks_of(told["walks"])
        least = summary["contest"]["places"][told["place"]]["margin"]
        here = [
            e
            for g in groups
            for e in g.values()
            if (e.place, e.gait) == (told["place"], told["gait"])
        ]
        some = [e for e in here if e.found]
        beside = ""
        if some:
            best = min(some, key=lambda e: e.selected)
            beside = (
                f", beside {words.error(best.tuned)} mrad of {name(best)}, the best of those tuned"
            )
        margin = told["margin"] or 0.0
        kept = "keeps" if margin >= least else "misses"
        lines.append(
            f"*{told['name']}*, not tuned, at {told['place']}, gait {told['gait']}: "
            f"{words.error(walks)} mrad, {words.legal(walks)} walks legal{beside}. Its delay margin of "
            f"{MRAD * margin:.2g} ms {kept} the limit of {MRAD * least:g} ms."
        )
    return lines
