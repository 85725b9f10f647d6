"""The tables of the reproduction, from its outcomes."""

from __future__ import annotations

from typing import Any

import numpy as np

from biped_adrc.control.tracking import TABLE_II
from biped_adrc.gait.published import PUBLISHED_MULTIPLIERS
from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.scenario.outcome import Outcome
from biped_adrc.studies.pair import CONTROLLERS
from biped_adrc.studies.plan import BOTH, POLICIES, Plan, RecipeResult
from biped_adrc.studies.push_map import WORDS, counts
from biped_adrc.studies.verdicts import Results, distance

PRINTED_TABLE_I = (-180, -324, -583, -1050, -1890, -3401, -6122, -11020, -19836)
"""As the paper prints them, with its thousands separators ("-11.020", "-19.836") read as such."""


def tables(plan: Plan, r: Results, cells: list[Any], figures: dict[str, float]) -> dict[str, Any]:
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
        "Numerics": {"columns": ["figure", "value"], "rows": [[k, v] for k, v in figures.items()]},
    }
    if not plan.quick:
        found["Literal equation and resets at impact"] = _literal(r)
        found["Map of pushes"] = _map(cells)
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
    named = {
        k: v
        for k, v in r.items()
        if isinstance(v, Outcome) and not k.startswith(("reset", "engines"))
    }
    heads = {f"push {c}": r[f"headline {c}"].outcome for c in BOTH}
    rows = [[name, *_row(o)] for name, o in {**heads, **named}.items()]
    return {"columns": columns, "rows": rows}


def _multipliers(r: Results) -> dict[str, Any]:
    rows: list[list[Any]] = [
        [
            f"central differences, {c}, {len(r[f'multipliers {c}'].orbit.multipliers)} coordinates",
            np.abs(r[f"multipliers {c}"].orbit.multipliers)[:10].tolist(),
            "",
        ]
        for c in BOTH
        if f"multipliers {c}" in r
    ]
    if "multipliers ADRC measured" in r:
        measured = r["multipliers ADRC measured"].orbit.multipliers
        rows.append(
            [
                f"central differences, ADRC, reset 'measured', {len(measured)} coordinates",
                np.abs(measured)[:10].tolist(),
                "the observer's xi^ and its derivatives live on through the impact",
            ]
        )
    rows.append(["delta^2 of the zero dynamics", [r["multipliers NPD"].delta_squared], ""])
    for c in BOTH:
        test = r[f"regression {c}"].regression
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
    rows = []
    for preset in plan.presets:
        for c in BOTH:
            found: RecipeResult = r[f"recipe {preset} {c}"]
            record = found.record
            certificate = record.get("certificate", {})
            rows.append(
                [
                    preset,
                    c,
                    found.closes,
                    record.get("stable"),
                    record.get("multipliers", [])[:3],
                    record.get("impacts"),
                    record.get("peak_error"),
                    record.get("peak_torque"),
                    certificate.get("friction"),
                    certificate.get("impulse_ratio"),
                    "; ".join(record.get("violations", [])),
                    record.get("impact_rate_jump"),
                    record.get("distance_to_x_star"),
                    found.reason,
                ]
            )
    return {"columns": columns, "rows": rows}


def _literal(r: Results) -> dict[str, Any]:
    columns = ["variant", "status", "impacts", "peak error [rad]", "at half the step [rad]"]
    columns += ["peak torque [N m]", "median step [s]", "distance to x*"]
    names = [f"as printed {c}" for c in BOTH]
    names += [f"reset {p}, {limit}" for p in POLICIES for limit in ("unlimited", "150 N m")]
    rows = []
    for name in names:
        o: Outcome = r[name]
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
