"""The searches of the comparison: for each hardware, gait and tuning every controller is searched five times.

    python -m validation.findings.searches out [exact-v0.6-tracking ..]

A place is (hardware, gait, tuning). What is chosen is written to settings.csv, one row for each search, with
what stopped it. Its objective on the walks of choice is there before and after the last doubling, and at the
end, after `steps`. A search that was stopped goes on with the same command.
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
from biped_adrc.studies.results import Results
from biped_adrc.studies.study import read_study
from validation.findings.statistics import questions
from validation.findings.steps import Searches, digits, move_all, stop_in_words

PLAN = tomllib.loads((Path(__file__).parent / "comparison.toml").read_text())
SEARCH, CHOICE, REHEARSAL = 0, 100, 900
"""First seeds of the three sets of walks; test walks have seeds of their own, see `questions`."""


COLUMNS = (
    "hardware",
    "gait",
    "tuning",
    "controller",
    "search",
    "candidates",
    "before",
    "doubled",
    "on choice",
    "stop",
    "values",
    "why",
)


def places() -> Iterator[tuple[str, str, str]]:
    """Yield (hardware, gait, tuning) of all searches."""
    yield from itertools.product(PLAN["hardware"], PLAN["gaits"], PLAN["tunings"])


def merge(*tables: dict[str, Any]) -> dict[str, Any]:
    """Nested tables put together, later ones over earlier ones."""
    result: dict[str, Any] = {}
    for table in tables:
        for key, x in table.items():
            inside = isinstance(x, dict) and isinstance(result.get(key), dict)
            result[key] = merge(result[key], x) if inside else x
    return result


def study_of(
    hardware: str, gait: str, tuning: str, more: dict[str, int] | None = None
) -> dict[str, Any]:
    """The tables of the study that searches all controllers at a place. more: controller -> number of searches,
    for the ones beyond those that all have; these have other seeds of the sampler.
    """
    least = PLAN["searches"]
    numbers = {n: range(least) for n in PLAN["controllers"]}
    if more is not None:
        numbers = {n: range(least, count) for n, count in more.items()}
    t = PLAN["tunings"][tuning]
    base = merge(
        PLAN["base"],
        PLAN["hardware"][hardware],
        {"gait": {"name": PLAN["gaits"][gait]}, "run": {"impacts": t["impacts"]}},
    )
    later = {"hardware": {"delay": PLAN["later"][hardware]}}
    conditions = {
        name: {"1 ms more": later, **PLAN["conditions"]}[name] for name in t["conditions"]
    }
    beside = PLAN[f"variables_{hardware}"]
    asked = PLAN["search"] | PLAN["search_more"].get(f"{hardware}, {gait}, {tuning}", {})
    beyond = asked.pop("more")
    sets = {"search": (SEARCH, t["seeds"]), "choice": (CHOICE, 20), "test": (REHEARSAL, 2)}
    return {
        "name": f"{hardware}, {gait}, {tuning}",
        "base": base,
        "conditions": conditions,
        "cases": {
            f"{name} #{i + 1}": PLAN["controllers"][name]
            for name, some in numbers.items()
            for i in some
        },
        "search": {
            **asked,
            "seed": asked["seed"] if more is None else beyond,
            "objective": t["objective"],
            "limits": t["limits"],
            "variables": merge(PLAN["variables"], beside),
            "walks": {k: {"seeds": {"from": a, "count": n}} for k, (a, n) in sets.items()},
        },
    }


def search_at(
    folder: Path,
    at: tuple[str, str, str],
    more: dict[str, int] | None = None,
    workers: int | None = None,
) -> list[dict[str, Any]]:
    """Search all controllers at a place, or some more often; returns a row for each search."""
    tables = study_of(*at, more)
    out = folder / "-".join((*at, *(["more"] if more else [])))
    most = tables["search"]["doublings"]

    def carried(doublings: int) -> Results:
        """The study with at most so many doublings, which goes on from what the ones before have walked."""
        asked = merge(tables, {"search": {"doublings": doublings}})
        return ba.study(
            asked, out, workers, progress=lambda p: print(p.note, flush=True) if p.note else None
        )

    # what each search had chosen before its last doubling
    path = folder / f"{out.name}.json"
    if not path.exists():
        chosen = {k: x.selected[0].objective for k, x in carried(most - 1).choices.items()}
        path.write_text(json.dumps(chosen))
    before, found = json.loads(path.read_text()), carried(most)
    rows = [
        dict(zip(COLUMNS, at, strict=False))
        | row_of(case, found)
        | {"before": rounded(before[case]) if case in before else ""}
        for case in tables["cases"]
    ]
    move_all(Searches(read_study(tables), folder / f"{out.name}-steps", workers), rows)
    return rows


def row_of(case: str, found: Results) -> dict[str, Any]:
    """The columns of a case: its setting, its objective on the walks of choice, and what stopped its search."""
    controller, _, number = case.partition(" #")
    row: dict[str, Any] = {"controller": controller, "search": int(number)}
    if case not in found.choices:
        why = next(x for x in found.failures if f", {case}:" in x)
        return row | {"stop": "no candidate within the limits", "values": "", "why": why}
    choice = found.choices[case]
    best, variables = choice.selected[0], found.study.search.variables  # type: ignore[union-attr]
    values = {n: digits(x) for n, x in best.values.items() if n in variables}
    return row | {
        "candidates": sum(c.walked for c in choice.candidates),
        "doubled": rounded(best.objective),
        "stop": stop_in_words(choice.stop),
        "values": json.dumps(values),
    }


def rounded(x: float) -> float:
    """An objective that is compared with another one of its search."""
    return float(f"{x:.5g}")


def every_row(folder: Path) -> Iterator[dict[str, str]]:
    """The rows of all searches, place by place."""
    for at in places():
        for path in (folder / f"{'-'.join(at)}.csv", folder / f"{'-'.join(at)}-more.csv"):
            if path.exists():
                with path.open(newline="") as file:
                    yield from csv.DictReader(file)


def main(out: str, *names: str) -> None:
    """Search at the places named, or at all, with one worker for each name; "-more" after a name: the further
    searches of the first question. `out` gets a folder and a CSV for each.
    """
    runs: dict[str, tuple[tuple[str, str, str], dict[str, int] | None]]
    runs = {"-".join(at): (at, None) for at in places()}
    for at, more in questions()["more"].items():
        a, b, c = at.split(", ")
        runs[f"{a}-{b}-{c}-more"] = (a, b, c), more
    for name in names or runs:
        at, more = runs[name]
        rows = search_at(Path(out), at, more, 1 if names else None)
        with open(Path(out) / f"{name}.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS)
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main(*sys.argv[1:])
