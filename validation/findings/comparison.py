"""The comparison's test walks: the settings that searches chose, under all conditions of the questions.

    tables_of(hardware, tuning, rows)   a study of `examples/studies`, from the settings
    rows_of(results, ..)                a row for each search under each condition, as the page reads them

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
from validation.findings.searches import PLAN, merge
from validation.findings.statistics import Side, first_seed, questions, text_hash

ROOT = Path(__file__).parents[2]
SETTINGS = ROOT / "docs" / "findings" / "settings.csv"
LATER = "1 ms more"
"""The condition of the common limit: a further 1 ms of delay that nobody knows."""
NINTH = 10
"""How many values of K_p, equal but for the ninth digit, `digit_tables` has."""
TABLE_I = "Table I"
"""The paper's own controller and gains, which stand outside: no search chose them."""


def settings() -> list[dict[str, str]]:
    """The rows of all searches."""
    with SETTINGS.open(newline="") as file:
        return list(csv.DictReader(file))


def name_of(hardware: str, tuning: str) -> str:
    """The name of the study and of its rows."""
    return f"comparison_{hardware}_{tuning}"


def tables_of(hardware: str, tuning: str, rows: list[dict[str, str]]) -> dict[str, Any]:
    """The tables of the study that walks all settings of a hardware and a tuning."""
    asked = questions()
    later = {"hardware": {"delay": PLAN["later"][hardware]}}
    cases = {
        f"{r['controller']} #{r['search']}, {r['gait']}": merge(
            PLAN["controllers"][r["controller"]],
            {"gait": {"name": PLAN["gaits"][r["gait"]]}},
            nest(json.loads(r["values"])),
        )
        for r in rows
        if (r["hardware"], r["tuning"]) == (hardware, tuning) and r["values"]
    }
    if tuning == "tracking":
        for gait, file in PLAN["gaits"].items():
            cases[f"{TABLE_I} #1, {gait}"] = {
                "controller": {"name": "ADRC"},
                "gait": {"name": file},
            }
    return {
        "name": f"comparison, {hardware}, tuned for {tuning}",
        "seeds": {"from": first_seed(), "count": asked["walks"]},
        "base": merge(
            PLAN["base"], PLAN["hardware"][hardware], {"run": {"impacts": asked["impacts"]}}
        ),
        "conditions": asked["conditions"] | {LATER: later},
        "cases": cases,
    }


def sign_of(tuning: str) -> float:
    """1 for a tuning whose objective is minimised, -1 for one that maximises."""
    return -1.0 if PLAN["tunings"][tuning]["objective"].get("goal") == "maximise" else 1.0


def best_of(rows: list[dict[str, str]]) -> list[dict[str, str]]:
    """The best search of each controller at each place, by its walks of choice."""
    best: dict[tuple[str, ...], dict[str, str]] = {}
    for r in rows:
        sign = sign_of(r["tuning"])
        key = r["hardware"], r["gait"], r["tuning"], r["controller"]
        if r["values"]:
            known = best.get(key)
            if known is None or sign * float(r["on choice"]) < sign * float(known["on choice"]):
                best[key] = r
    return list(best.values())


def soft_tables(rows: list[dict[str, str]]) -> dict[str, Any]:
    """The tables of the study on MuJoCo's ground: the best settings behind RABBIT's hardware, tuned for
    tracking on the gait for rough ground, under three conditions.
    """
    best = [r for r in best_of(rows) if r["gait"] == "rough"]
    tables = tables_of("rabbit", "tracking", best)
    ground = {"ground": {"plant": "mujoco", "time_constant": 0.005}}
    known = tables["conditions"]
    return tables | {
        "name": "comparison on MuJoCo's ground",
        "base": merge(tables["base"], ground),
        "conditions": {"level": {}, **{k: known[k] for k in ("80 N m", "trunk +30 %")}},
        "cases": {k: x for k, x in tables["cases"].items() if k.endswith(", rough")},
    }


def digit_tables(rows: list[dict[str, str]]) -> dict[str, Any]:
    """The tables of the study on last digits: the two settings of the first question, each with NINTH values of
    K_p that differ in the ninth digit.
    """
    tables = tables_of("rabbit", "tracking", best_of(rows))
    known = tables["conditions"]
    cases = {}
    for name, case in tables["cases"].items():
        controller, gait = name.partition(" #")[0], name.rpartition(", ")[2]
        if gait == "v0.6" and controller in ("m = 1", "NPD"):
            for i in range(NINTH):
                K_p = case["controller"]["K_p"] * (1.0 + 1e-9 * i)
                cases[f"{controller}, {i}"] = merge(case, {"controller": {"K_p": K_p}})
    return tables | {
        "name": "last digits of a gain",
        "conditions": {k: known[k] for k in ("80 N m", "hip, 2 N")},
        "cases": cases,
    }


def comment(name: str) -> str:
    """The first lines of a study that is written here."""
    return (
        "# Written by `make findings ARGS=--search` from docs/findings/settings.csv: what each search chose.\n"
        f"#     biped-adrc study examples/studies/{name}.toml --out {name}"
    )


def nest(values: dict[str, Any]) -> dict[str, Any]:
    """Tables of values by dotted name."""
    result: dict[str, Any] = {}
    for name, x in values.items():
        for part in reversed(name.split(".")):
            x = {part: x}
        result = merge(result, x)
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
    """A key of TOML, in quotes where it needs them."""
    return k if k.replace("_", "").isalnum() else json.dumps(k)


def rows_of(found: Results, hardware: str, tuning: str) -> Iterator[dict[str, Any]]:
    """A row for each setting under each condition; `question` is "changed" where the walks were made with
    other seeds than those of the questions' text.
    """
    question = text_hash() if found.study.seeds[0] == first_seed() else "changed"

    def place(x: Any) -> tuple[str, str]:
        return str(x.at["case"]), str(x.at.get("condition"))

    for (case, condition), some in groupby(found.results(), place):
        head, gait = case.rsplit(", ", 1)
        controller, search = head.split(" #")
        errors = [x.row["rms_error"] if x.row.get("feasible") == 1 else math.inf for x in some]
        yield {
            "question": question,
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
    searched = [r for r in chosen if tuple(r[k] for k in keys) == at]
    under = (r for r in rows if tuple(r[k] for k in keys) == at and r["condition"] == condition)
    errors = {r["search"]: errors_of(r) for r in under}
    if not errors:
        return None
    # a search that kept no limit has no setting
    sign = sign_of(at[2])
    none = np.full(len(next(iter(errors.values()))), math.inf)
    objective = [sign * float(r["on choice"]) if r["values"] else math.inf for r in searched]
    return Side(np.array(objective), np.array([errors.get(r["search"], none) for r in searched]))
