"""The tables of a reproduction, every number taken from the runs.

Cells are numbers, texts, lists or None; the report decides how they are rounded. Called by
`paper.reproduction`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from biped_adrc.control.tracking import TABLE_II
from biped_adrc.gait.published import PUBLISHED_MULTIPLIERS, X_STAR
from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.paper.push_map import PushCell, counts
from biped_adrc.paper.results import Results
from biped_adrc.scenario.recording import Outcome

PRINTED_TABLE_I = (-180, -324, -583, -1050, -1890, -3401, -6122, -11020, -19836)
"""Table I as the paper prints it [rad/s]; its "-11.020" and "-19.836" have thousands separators."""

Table = dict[str, Sequence[object]]
"""`columns`: names; `rows`: one list of as many cells for each row."""


def tables(r: Results) -> dict[str, Table]:
    """All tables by title."""
    poles = {"paper, rounded": PRINTED_TABLE_I, "here, 180 x 1.8^k": TABLE_I}
    constants = [["K_p [1/s^2]", 5000, TABLE_II.K_p], ["K_d [1/s]", 50, TABLE_II.K_d]]
    return {
        "Table I: observer eigenvalues [rad/s]": {
            "columns": list(poles),
            "rows": list(zip(*poles.values(), strict=True)),
        },
        "Table II: controller constants": {
            "columns": ["constant", "paper", "here"],
            "rows": constants,
        },
        "Runs": _runs(r),
        "Stability: multipliers": _multipliers(r),
        "Gait (b), the paper's recipe": _recipe(r),
        "Numerics": table({"figure": k, "value": v} for k, v in r.figures.items()),
        "Map of pushes": _map(r.cells),
    }


def table(rows: Iterable[dict[str, object]]) -> Table:
    """A table of rows that are given by column name, at least one, all with the same columns."""
    rows = list(rows)
    return {"columns": list(rows[0]), "rows": [list(row.values()) for row in rows]}


def _runs(r: Results) -> Table:
    """Every walk: how it ended, errors, torques, forces.

    A walk that ended early has no peak error or torque in the table: they would be those of a fall.
    """
    return table(_run(name, o) for name, o in r.run_twice.items())


def _run(name: str, o: Outcome) -> dict[str, object]:
    """The row of one walk."""
    steps = o.certificates
    return {
        "run": name,
        "controller": o.run.controller.name,
        "preset": o.run.robot.preset,
        "status": o.status,
        "outcome": o.feasibility.outcome,
        "impacts": o.impacts,
        "peak error [rad]": o.peak_error if o.walked else None,
        "at half the step [rad]": o.half.peak_error if o.walked and o.half else None,
        "rms error [rad]": o.rms_error,
        "peak torque [N m]": o.peak_torque if o.walked else None,
        "median step [s]": float(np.median([s.duration for s in steps])) if steps else None,
        "mean friction": o.feasibility.mean_friction,
        "mean F_N [N]": o.feasibility.mean_normal_force,
        "impulse ratio": float(np.max([s.impulse_ratio for s in steps])) if steps else None,
        "method": o.method,
        "engine": o.engine,
    }


def _multipliers(r: Results) -> Table:
    """Multipliers by method: central differences, delta^2 of the zero dynamics, the regression
    (27), the paper.
    """
    result: dict[str, tuple[list[float], str]] = {}
    for name, x in r.multipliers.items():
        z, of = np.abs(x.orbit.multipliers), name.replace(" measured", ", reset 'measured'")
        remembers = "the observer's xi^ and its derivatives live on through the impact"
        remark = remembers if name.endswith("measured") else ""
        result[f"central differences, {of}, {len(z)} coordinates"] = z[:10].tolist(), remark
    result["delta^2 of the zero dynamics"] = [r.multipliers["NPD"].delta_squared], ""
    for c, test in r.regressions.items():
        result[f"regression (27) on the pushed walk, {c}"] = test.magnitudes.tolist(), test.warning
    result["printed in the paper"] = list(PUBLISHED_MULTIPLIERS), "from a regression: no target"
    return table(
        {"method": method, "magnitudes": z, "remark": remark}
        for method, (z, remark) in result.items()
    )


def _recipe(r: Results) -> Table:
    """The cycle of gait (b) by preset and controller, or why there is none; what its walks ask of ground and
    motors is in "Runs".
    """
    rows = []
    for name, x in r.cycles.items():
        if not name.startswith("gait (b)"):
            continue
        result = None if isinstance(x, str) else x.orbit
        row: dict[str, object] = {"gait": name, "stable": result and result.stable}
        row["largest multipliers"] = result and np.abs(result.multipliers[:3]).tolist()
        row["rate jump at impact [rad/s]"] = r.jumps[name.split(", ")[1]]["recipe"]
        row["x- minus x*"] = result and (result.x_minus[: len(X_STAR)] - X_STAR).tolist()
        rows.append(row | {"remark": x if isinstance(x, str) else ""})
    return table(rows)


def _map(cells: list[PushCell]) -> Table:
    """How many pushes of the map ended how, by preset, torque limit and controller."""
    return table(
        {"preset, torque limit": name, "controller": c, **words}
        for name, result in counts(cells).items()
        for c, words in result.items()
    )
