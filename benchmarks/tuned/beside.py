"""What the leaves of tuned settings are worth, and the largest push that they walk legally.

    python benchmarks/tuned/alike.py out/tuned
    python benchmarks/tuned/beside.py out/tuned

Of the searches of the first optimiser seed that are finished and found a setting:

    linear     its delay margin [s], disk margin and ripple [N m]
    without    the setting with one leaf taken away and not tuned again, on the test set of its place
    halved     its walks under the first condition of the test set, with every step of integration half as long
    pushes     brackets of the largest legal push, at the places and gaits of [push] in contest.toml

and of each setting in [unsearched] its walks of the test set and its delay margin. No search knows of it. Rows
of walks are kept in the folder, so that what was interrupted goes on; docs/write_tuned.py takes beside.json.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from alike import NOTE, Entry, contest, entries, of_place, tables
from goal import LINEAR, Walked, largest
from goal_numbers import plain

from biped_adrc.bench.parameters import read, trial
from biped_adrc.bench.study import record_of
from biped_adrc.campaign.chunk import Row
from biped_adrc.files import write_text
from biped_adrc.scenario.run import halved
from biped_adrc.tuning.study import TuningStudy
from biped_adrc.tuning.study_file import read_tuning
from biped_adrc.tuning.variables import Values
from biped_adrc.tuning.without_walk import numbers_without_walk

KEPT = ("rms_error", "rms_torque", "cost_of_transport", "legal")
"""Columns of a walk."""
FIRST = 1
"""The optimiser seed whose settings are looked at."""


def chosen(c: Mapping[str, Any], out: Path) -> Iterator[tuple[Entry, TuningStudy, dict[str, Any]]]:
    """The finished searches of the first optimiser seed with a setting, their studies, and what was chosen."""
    for e in entries(c):
        note = out / e.folder / NOTE
        if e.seed == FIRST and note.is_file():
            told = json.loads(note.read_text(encoding="utf-8"))
            if told["found"]:
                yield e, read_tuning(tables(c, e), e.folder), told["chosen"]


def linear(values: Values) -> dict[str, float | None]:
    """The numbers of a setting that need no walk, to four digits."""
    return {
        k: None if x is None else float(f"{x:.4g}")
        for k, x in numbers_without_walk(LINEAR, values).items()
    }


def without(
    c: Mapping[str, Any], e: Entry, study: TuningStudy, picked: Values, walk: Walked
) -> Iterator[dict[str, Any]]:
    """The walks without each leaf of the place; a leaf that the setting has not chosen is left out."""
    for leaf in c["places"][e.place]["leaves"]:
        off = {name: read(name, x) for name, x in c["leaves"][leaf]["off"].items()}
        if any(picked[name] != x for name, x in off.items()):
            values = study.values({**picked, **off})
            yield {**e._asdict(), "leaf": leaf, "walks": tested(study, values, walk)}


def tested(study: TuningStudy, values: Values, walk: Walked) -> list[Any]:
    """The kept columns of a setting on the test set of a study, each a list of seeds for each condition."""
    return kept(walk([p.record for p in study.test.points(values, {})]), len(study.test.seeds))


def kept(rows: list[Row], n: int) -> list[Any]:
    """The kept columns of rows, each a list of n seeds for each condition."""
    sets = [rows[i : i + n] for i in range(0, len(rows), n)]
    return [[[short(row, column) for row in rows] for rows in sets] for column in KEPT]


def with_half_steps(study: TuningStudy, values: Values, walk: Walked) -> list[Any]:
    """The kept columns under the first condition of the test set, with every step half as long."""
    first = study.test.named[0].values
    records = [record_of({**values, **first, "seed": i}) for i in study.test.seeds]
    rows = walk([halved(trial(r)).record() for r in records])
    return kept(rows, len(rows))


def short(row: Row, column: str) -> float | int | None:
    """A number of a walk to four digits; None where it has none."""
    x = row.get(column)
    return float(f"{x:.4g}") if isinstance(x, float) else x  # type: ignore[return-value]


def pushed(
    c: Mapping[str, Any], found: list[tuple[Entry, TuningStudy, dict[str, Any]]], walk: Walked
) -> Iterator[dict[str, Any]]:
    """The brackets of the largest legal push of each setting [N m], one for each seed."""
    asked = {(place, gait) for place, gaits in c["push"]["places"].items() for gait in gaits}
    for spot in sorted(asked):
        here = [x for x in found if (x[0].place, x[0].gait) == spot]
        sides = {e.contestant: {"values": record_of(s.values(x))} for e, s, x in here}
        done = largest({"condition": {}, "push": c["push"]}, sides, walk)
        for e, _, _ in here:
            yield {**e._asdict(), "ends": done[e.contestant]}


def unsearched(c: Mapping[str, Any], walk: Walked) -> Iterator[dict[str, Any]]:
    """The settings that no search has made, on the test set of their place."""
    for name, given in c["unsearched"].items():
        for gait in c["places"][given["place"]]["seeds"]:
            e = Entry(given["place"], gait, next(iter(c["contestants"])), FIRST)
            place = c["places"][e.place]["values"]
            values = {**of_place(c, e.place, "walk"), **place, **given["values"], "gait": gait}
            told = {"place": e.place, "gait": gait, "name": name}
            margin = linear(values)["delay_margin"]
            study = read_tuning(tables(c, e), e.folder)
            yield {**told, "margin": margin, "walks": tested(study, values, walk)}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    out = parser.parse_args().out
    c, walk = contest(), Walked(out / "beside.jsonl")
    found = list(chosen(c, out))
    told: dict[str, list[Any]] = {"unsearched": list(unsearched(c, walk)), "without": []}
    told["linear"] = [e._asdict() | linear(study.values(x)) for e, study, x in found]
    told["halved"] = []
    for e, study, picked in found:
        told["without"] += without(c, e, study, picked, walk)
        steps = with_half_steps(study, study.values(picked), walk)
        told["halved"].append({**e._asdict(), "walks": steps})
        print(e.folder, flush=True)
    told["pushes"] = list(pushed(c, found, walk))
    text = json.dumps(plain(told), allow_nan=False)
    write_text(out / "beside.json", text + "\n")


if __name__ == "__main__":
    main()
