"""The comparison's test walks: the settings that searches chose, under all conditions of the questions.

    study_file(hardware, tuning)   a study of `examples/studies`, written from the settings
    rows_of(results, ..)           a row for each search under each condition, as the page reads them

A row has the hash of the questions with which it was walked, how many walks are feasible, and the rms errors
[urad] in the order of the seeds, "-" for a walk that is not feasible.
"""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from biped_adrc.studies.results import Results
from validation.findings.searches import PLAN, merged
from validation.findings.statistics import Side, first_seed, questions, text_hash

ROOT = Path(__file__).parents[2]
SETTINGS = ROOT / "docs" / "findings" / "settings.csv"
LATER = "1 ms more"


def settings() -> list[dict[str, str]]:
    """The rows of all searches."""
    with SETTINGS.open(newline="") as file:
        return list(csv.DictReader(file))


def name_of(hardware: str, tuning: str) -> str:
    """The name of the study and of its rows."""
    return f"compared_{hardware}_{tuning}"


def tables_of(hardware: str, tuning: str, rows: list[dict[str, str]]) -> dict[str, Any]:
    """The tables of the study that walks all settings of a hardware and a tuning."""
    asked = questions()
    later = {"hardware": {"delay": PLAN["later"][hardware]}}
    cases = {
        f"{r['controller']} #{r['search']}, {r['gait']}": merged(
            PLAN["controllers"][r["controller"]],
            {"gait": {"name": PLAN["gaits"][r["gait"]]}},
            nested(json.loads(r["values"])),
        )
        for r in rows
        if (r["hardware"], r["tuning"]) == (hardware, tuning) and r["values"]
    }
    return {
        "name": f"compared, {hardware}, tuned for {tuning}",
        "seeds": {"from": first_seed(), "count": asked["walks"]},
        "base": merged(
            PLAN["base"], PLAN["hardware"][hardware], {"run": {"impacts": asked["impacts"]}}
        ),
        "conditions": asked["conditions"] | {LATER: later},
        "cases": cases,
    }


def nested(values: dict[str, Any]) -> dict[str, Any]:
    """Tables of values by dotted name."""
    result: dict[str, Any] = {}
    for name, x in values.items():
        for part in reversed(name.split(".")):
            x = {part: x}
        result = merged(result, x)
    return result


def toml(tables: dict[str, Any], comment: str) -> str:
    """A study as TOML: one line for each case and condition."""
    lines = [comment, f'name = "{tables["name"]}"', f"seeds = {_inline(tables['seeds'])}"]
    for key in ("base", "conditions", "cases"):
        lines += ["", f"[{key}]", *(f"{_key(k)} = {_inline(x)}" for k, x in tables[key].items())]
    return "\n".join(lines) + "\n"


def _inline(x: Any) -> str:
    """A value of TOML on one line."""
    if isinstance(x, dict):
        return "{ " + ", ".join(f"{_key(k)} = {_inline(y)}" for k, y in x.items()) + " }"
    return json.dumps(x)


def _key(k: str) -> str:
    return k if k.replace("_", "").isalnum() else json.dumps(k)


def rows_of(found: Results, hardware: str, tuning: str) -> Iterator[dict[str, Any]]:
    """A row for each setting under each condition."""

    def place(x: Any) -> tuple[str, str]:
        return str(x.at["case"]), str(x.at.get("condition"))

    for (case, condition), some in groupby(found.results(), place):
        head, gait = case.rsplit(", ", 1)
        controller, search = head.split(" #")
        errors = [x.row["rms_error"] if x.row.get("feasible") == 1 else math.inf for x in some]
        yield {
            "question": text_hash(),
            "hardware": hardware,
            "gait": gait,
            "tuning": tuning,
            "controller": controller,
            "search": search,
            "condition": condition,
            "feasible": int(np.sum(np.isfinite(errors))),
            "errors": " ".join(f"{1e6 * e:.4g}" if math.isfinite(e) else "-" for e in errors),
        }


def errors_of(row: dict[str, str]) -> np.ndarray[Any, np.dtype[np.float64]]:
    """The rms errors [rad] of a row, infinite where a walk is not feasible."""
    return np.array([math.inf if x == "-" else 1e-6 * float(x) for x in row["errors"].split()])


def side(
    chosen: list[dict[str, str]],
    rows: list[dict[str, str]],
    at: tuple[str, str, str, str],
    condition: str,
) -> Side | None:
    """The searches of a controller at a place, (hardware, gait, tuning, controller), on the test walks under a
    condition; None where no search kept the limits.
    """
    keys = ("hardware", "gait", "tuning", "controller")
    mine = {r["search"]: r for r in chosen if tuple(r[k] for k in keys) == at and r["values"]}
    walked = [r for r in rows if tuple(r[k] for k in keys) == at and r["condition"] == condition]
    if not walked:
        return None
    # a tuning that maximises has the sign of its objective changed
    goal = PLAN["tunings"][at[2]]["objective"].get("goal", "minimise")
    sign = 1.0 if goal == "minimise" else -1.0
    choice = np.array([sign * float(mine[r["search"]]["on choice"]) for r in walked])
    return Side(choice, np.array([errors_of(r) for r in walked]))
