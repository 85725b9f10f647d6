"""The searches of the comparison: for each hardware, gait and tuning every controller is searched five times.

    python -m validation.findings.searches out [exact-v0.6-tracking ..]

A place is (hardware, gait, tuning). What is chosen is written to settings.csv, one row for each search, with
what stopped it. A search that was stopped goes on with the same command.
"""

from __future__ import annotations

import csv
import itertools
import json
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import biped_adrc as ba
from biped_adrc.studies.study import read_study

PLAN = tomllib.loads((Path(__file__).parent / "comparison.toml").read_text())
SEARCH, CHOICE, REHEARSAL = 0, 100, 900
"""First seeds of the three sets of walks; test walks have seeds of their own, see `questions`."""


def places() -> Iterator[tuple[str, str, str]]:
    """Yield (hardware, gait, tuning) of all searches."""
    yield from itertools.product(PLAN["hardware"], PLAN["gaits"], PLAN["tunings"])


def merged(*tables: dict[str, Any]) -> dict[str, Any]:
    """Nested tables put together, later ones over earlier ones."""
    result: dict[str, Any] = {}
    for table in tables:
        for key, x in table.items():
            inside = isinstance(x, dict) and isinstance(result.get(key), dict)
            result[key] = merged(result[key], x) if inside else x
    return result


def study_of(
    hardware: str, gait: str, tuning: str, cases: list[str] | None = None
) -> dict[str, Any]:
    """The tables of the study that searches all controllers at a place."""
    t = PLAN["tunings"][tuning]
    base = merged(
        PLAN["base"],
        PLAN["hardware"][hardware],
        {"gait": {"name": PLAN["gaits"][gait]}, "run": {"impacts": t["impacts"]}},
    )
    later = {"hardware": {"delay": PLAN["later"][hardware]}}
    conditions = {
        name: {"1 ms more": later, **PLAN["conditions"]}[name] for name in t["conditions"]
    }
    behind = PLAN["variables_behind_encoders"] if hardware == "rabbit" else {}
    sets = {"search": (SEARCH, t["seeds"]), "choice": (CHOICE, 20), "test": (REHEARSAL, 2)}
    return {
        "name": f"{hardware}, {gait}, {tuning}",
        "base": base,
        "conditions": conditions,
        "cases": {
            f"{name} #{i + 1}": values
            for name, values in PLAN["controllers"].items()
            for i in range(PLAN["searches"])
            if cases is None or name in cases
        },
        "search": {
            **PLAN["search"],
            "budget": t["budget"],
            "objective": t["objective"],
            "limits": t["limits"],
            "variables": merged(PLAN["variables"], behind),
            "walks": {k: {"seeds": {"from": a, "count": n}} for k, (a, n) in sets.items()},
        },
    }


def searched(
    folder: Path, hardware: str, gait: str, tuning: str, workers: int | None
) -> list[dict[str, Any]]:
    """Search all controllers at a place; returns a row for each search."""
    tables = study_of(hardware, gait, tuning)
    at = {"hardware": hardware, "gait": gait, "tuning": tuning}
    asked = read_study(tables)
    assert asked.search is not None
    out = folder / "-".join(at.values())
    found = ba.study(
        asked, out, workers, progress=lambda p: print(p.note, flush=True) if p.note else None
    )
    rows = []
    for case in tables["cases"]:
        controller, _, number = case.partition(" #")
        row = {**at, "controller": controller, "search": int(number)}
        choice = found.choices.get(case)
        if choice is None:
            why = next(x for x in found.failures if f", {case}:" in x)
            rows.append(row | {"stop": "no candidate within the limits", "values": "", "why": why})
            continue
        best = choice.selected[0]
        values = {n: x for n, x in best.values.items() if n in asked.search.variables}
        rows.append(
            row
            | {
                "candidates": sum(c.walked for c in choice.candidates),
                "on search": choice.candidates[best.number].objective,
                "on choice": best.objective,
                "stop": choice.stop,
                "values": json.dumps({n: float(f"{x:.4g}") for n, x in values.items()}),
            }
        )
    return rows


COLUMNS = (
    "hardware",
    "gait",
    "tuning",
    "controller",
    "search",
    "candidates",
    "on search",
    "on choice",
    "stop",
    "values",
    "why",
)


def main(out: str, *names: str) -> None:
    """Search at the places named, or at all; `out` gets a folder and a CSV for each."""
    for at in places():
        if names and "-".join(at) not in names:
            continue
        rows = searched(Path(out), *at, workers=1 if names else None)
        with open(Path(out) / ("-".join(at) + ".csv"), "w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS)
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main(*sys.argv[1:])
