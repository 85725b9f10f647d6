"""The tables of the reproduction, from its outcomes."""

from __future__ import annotations

from typing import Any

import numpy as np

from biped_adrc.control.tracking import TABLE_II
from biped_adrc.gait.published import PUBLISHED_MULTIPLIERS
from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.scenario.outcome import Outcome
from biped_adrc.studies.pair import CONTROLLERS
from biped_adrc.studies.plan import BOTH, POLICIES, Plan
from biped_adrc.studies.push_map import WORDS, counts
from biped_adrc.studies.results import Results
from biped_adrc.studies.verdicts import distance

PRINTED_TABLE_I = (-180, -324, -583, -1050, -1890, -3401, -6122, -11020, -19836)
"""As the paper prints them, with its thousands separators ("-11.020", "-19.836") read as such."""


def tables(plan: Plan, r: Results) -> dict[str, Any]:
    """What is reported beside the checks."""
    found = {
        "Table I: observer eigenvalues [rad/s]": {
            "columns": ["paper, rounded", "here, 180 x 1.8^k"],
            "rows": [
                [printed, pole] for printed, pole in zip(PRINTED_TABLE_I, TABLE_I, strict=True)
            ],
        },
        "Table II: controller constants": {
            "columns": ["constant", "paper", "here"],
            "rows": [["K_p [1/s^2]", 5000, TABLE_II.K_p], ["K_d [1/s]", 50, TABLE_II.K_d]],
        },
        "Runs": _runs(r),
        "Stability: multipliers": _multipliers(r),
        "Gait (b), the paper's recipe": _recipe(plan, r),
        "Numerics": {
            "columns": ["figure", "value"],
            "rows": [[k, v] for k, v in r.figures.items()],
        },
    }
    if not plan.quick:
        found["Literal equation and resets at impact"] = _literal(r)
        found["Map of pushes"] = _map(r.cells)
    return found


def _row(o: Outcome) -> list[Any]:
    steps = o.certificates
    return [
        o.run.controller,
        o.run.preset,
        o.status,
        o.legality.outcome,
        o.impacts,
        o.peak_error,
        None if o.half is None else o.half.peak_error,
        o.rms_error,
        o.peak_torque,
        float(np.median([s.duration for s in steps])) if steps else None,
        o.legality.mean_friction,
        o.legality.mean_normal_force,
        float(np.max([s.impulse_ratio for s in steps])) if steps else None,
        o.method,
        o.engine,
    ]


def _runs(r: Results) -> dict[str, Any]:
    columns = ["run", "controller", "preset", "status", "outcome", "impacts", "peak error [rad]"]
    columns += ["at half the step [rad]", "rms error [rad]", "peak torque [N m]", "median step [s]"]
    columns += ["mean friction", "mean F_N [N]", "impulse ratio", "method", "engine"]
    named = {k: o for k, o in r.runs.items() if not k.startswith("reset")}
    heads = {f"push {c}": r.heads[c].outcome for c in BOTH}
    rows = [[name, *_row(o)] for name, o in {**heads, **named}.items()]
    return {"columns": columns, "rows": rows}


def _multipliers(r: Results) -> dict[str, Any]:
    rows: list[list[Any]] = []
    for name in ("NPD", "ADRC", "ADRC measured"):
        if name in r.multipliers:
            multipliers = r.multipliers[name].orbit.multipliers
            measured = name.endswith("measured")
            of = name.replace(" measured", ", reset 'measured'")
            remark = "the observer's xi^ and its derivatives live on through the impact"
            shown = np.abs(multipliers)[:10].tolist()
            said = f"central differences, {of}, {len(multipliers)} coordinates"
            rows.append([said, shown, remark if measured else ""])
    rows.append(["delta^2 of the zero dynamics", [r.multipliers["NPD"].delta_squared], ""])
    for c, found in r.regressions.items():
        test = found.regression
        rows.append(
            [f"regression (27) on the pushed walk, {c}", test.magnitudes.tolist(), test.warning]
        )
    rows.append(
        ["printed in the paper", list(PUBLISHED_MULTIPLIERS), "from a regression: no target"]
    )
    return {"columns": ["method", "magnitudes", "remark"], "rows": rows}


def _recipe(plan: Plan, r: Results) -> dict[str, Any]:
    columns = ["preset", "controller", "closes", "stable", "largest multipliers", "impacts"]
    columns += ["peak error [rad]", "peak torque [N m]", "friction needed", "impulse ratio"]
    columns += ["violations", "rate jump at impact [rad/s]", "x- minus x*", "remark"]
    rows = [
        [
            x.preset,
            x.controller,
            x.closes,
            x.record.get("stable"),
            x.record.get("multipliers", [])[:3],
            x.record.get("impacts"),
            x.record.get("peak_error"),
            x.record.get("peak_torque"),
            x.record.get("certificate", {}).get("friction"),
            x.record.get("certificate", {}).get("impulse_ratio"),
            "; ".join(x.record.get("violations", [])),
            x.record.get("impact_rate_jump"),
            x.record.get("distance_to_x_star"),
            x.reason,
        ]
        for x in r.recipes(plan)
    ]
    return {"columns": columns, "rows": rows}


def _literal(r: Results) -> dict[str, Any]:
    columns = ["variant", "status", "impacts", "peak error [rad]", "at half the step [rad]"]
    columns += ["peak torque [N m]", "median step [s]", "distance to x*"]
    names = [f"as printed {c}" for c in BOTH]
    names += [f"reset {p}, {limit}" for p in POLICIES for limit in ("unlimited", "150 N m")]
    rows = []
    for name in names:
        o = r.runs[name]
        period = float(np.median(o.durations)) if len(o.durations) else None
        half = None if o.half is None else o.half.peak_error
        figures = [o.peak_error, half] if o.walked else [None, None]
        torque = o.peak_torque if o.walked else None
        rows.append([name, o.status, o.impacts, *figures, torque, period, distance(o)])
    return {"columns": columns, "rows": rows}


def _map(cells: list[Any]) -> dict[str, Any]:
    found = counts(cells)
    rows = [
        [name, c, *(found[name][c][word] for word in WORDS)] for name in found for c in CONTROLLERS
    ]
    return {"columns": ["preset, torque limit", "controller", *WORDS], "rows": rows}
