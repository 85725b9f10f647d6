"""Write biped_adrc/bench/tuned.toml, the tuned settings that `compare` takes by default, from the contest.

Run: python docs/write_tuned_sets.py

A set for each gait of docs/tuned/summary.json (benchmarks/tuned/alike.py), the gait first on which most
contestants have a setting. Of several searches of one contestant the best by the selection set is taken;
numbers of the test set decide nothing. A contestant whose candidates all miss a limit has no line, and walks as
published, as those of `UNTUNED` do.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from biped_adrc.files import write_text

DOCS = Path(__file__).resolve().parent
SUMMARY = DOCS / "tuned" / "summary.json"
SETS = DOCS.parent / "biped_adrc" / "bench" / "tuned.toml"
UNTUNED = {"ADRC, Table I": {"controller": "ADRC"}}
"""Contestants of the comparison that no search has tuned: the paper's own."""
HEAD = """\
# Settings tuned alike, by place and contestant: values of a scenario [SI]. A contestant without a line has no
# setting that keeps the limits, or was not searched. Behind a line: the seed of the optimiser, the median rms
# error on the selection set, and the delay in all motors that the setting bears besides.
# Written by `python docs/write_tuned_sets.py`.
"""


def best(summary: Mapping[str, Any], gait: str) -> dict[str, dict[str, Mapping[str, Any]]]:
    """By place and contestant the search of this gait that is best on the selection set."""
    contest = summary["contest"]
    found: dict[str, dict[str, Mapping[str, Any]]] = {place: {} for place in contest["places"]}
    for place, there in found.items():
        for name in contest["contestants"]:
            at = (place, gait, name)
            told = [
                s
                for s in summary["searches"]
                if (s["place"], s["gait"], s["contestant"]) == at and not s["why"]
            ]
            if told:
                there[name] = min(told, key=lambda s: s["selected"])
    return found


def text(summary: Mapping[str, Any]) -> str:
    """The text of tuned.toml."""
    contest = summary["contest"]
    gaits = dict.fromkeys(s["gait"] for s in summary["searches"])
    by_gait = {gait: best(summary, gait) for gait in gaits}
    counts = {gait: sum(map(len, found.values())) for gait, found in by_gait.items()}
    ordered = sorted(by_gait, key=lambda gait: -counts[gait])
    return HEAD + "".join(_set(contest, gait, by_gait[gait]) for gait in ordered)


def _set(contest: Mapping[str, Any], gait: str, found: Mapping[str, Any]) -> str:
    """The tables of one set."""
    name = f"tuned-{gait}"
    hashed = hashlib.sha256(json.dumps(contest, sort_keys=True).encode()).hexdigest()[:12]
    margins = ", ".join(f"{1e3 * x['margin']:g} ms ({p})" for p, x in contest["places"].items())
    said = (
        f"tuned alike on gait {gait} by benchmarks/tuned/contest.toml ({hashed}), each bears at least this "
        f"much more delay in all motors: {margins}"
    )
    known = {n: x["values"] for n, x in contest["contestants"].items()} | UNTUNED
    lines = [
        f"\n[{_quoted(name)}]",
        f"words = {_quoted(said)}",
        f"values = {_table({'gait': gait})}",
        f"\n[{_quoted(name)}.contestants]",
        *(f"{_quoted(n)} = {_table(values)}" for n, values in known.items()),
    ]
    for place, there in found.items():
        lines.append(f"\n[{_quoted(name)}.places.{_quoted(place)}]")
        lines += [f"{_quoted(n)} = {_table(s['chosen'])} # {_told(s)}" for n, s in there.items()]
    return "\n".join(lines) + "\n"


def _told(search: Mapping[str, Any]) -> str:
    """Where a line is from: seed of the optimiser, and the error and margin that it was chosen by."""
    error, margin = 1e3 * search["selected"], 1e3 * search["margins"][0]
    return f"seed {search['seed']}, {error:.3g} mrad, {margin:.3g} ms"


def _table(values: Mapping[str, Any]) -> str:
    """An inline table of TOML."""
    return "{ " + ", ".join(f"{_key(k)} = {_value(x)}" for k, x in values.items()) + " }"


def _key(name: str) -> str:
    return name if name.isidentifier() else _quoted(name)


def _value(x: Any) -> str:
    """Text, truth values, numbers and lists are written in TOML as in JSON; no value is "none"."""
    return json.dumps("none" if x is None else x, ensure_ascii=False)


def _quoted(words: str) -> str:
    return json.dumps(words, ensure_ascii=False)


def main() -> None:
    """Read, write."""
    write_text(SETS, text(json.loads(SUMMARY.read_text(encoding="utf-8"))))


if __name__ == "__main__":
    main()
