"""Is the soft walk a stable cycle: multipliers of its return map by differences, and what noise hides of them.

Run: python benchmarks/soft/multipliers.py [OUT] [--quick] [--page docs/soft_limit.md]

A touchdown is noticed at a sample instant, so the step's duration jitters, and a derivative by small
differences drowns. Here walks start in the middle of a single support, in pairs beside the cycle, at a random
fraction of a sampling period; their states are taken where Theta passes SECTION, once in that support and once
in the next, between two nodes. `noisy_map` makes multipliers, their interval and the floor of these pairs.

The observer begins anew at the start of each walk, so that (q, q') at the section decides what follows; a
policy that holds it makes it begin anew after every touchdown too. Two parts, rows of which are kept in
OUT/soft_multipliers.jsonl, from where an interrupted run goes on. About 10 minutes.

    study      ground of docs/soft_walk.md, at two sampling periods and two sizes of the distance
    path       the path of limit.py, from soft to stiff
"""

from __future__ import annotations

import sys
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import brentq

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report import Table, arguments
from soft import limit
from soft.noisy_map import Pairs, fitted, magnitudes, multipliers
from soft.rows import Row, found, markdown, write_between

import biped_adrc as ba
from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.stepping_plant import PlantState
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.hybrid.trajectory import Arc
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.walk import default_method
from biped_adrc.types import Array

CONTROLLERS: dict[str, dict[str, Any]] = {
    "NPD": {"controller": "NPD"},
    "m = 1, 800 rad/s, hold 10 ms": {
        "controller": "LESO", "bandwidth": 800.0, "contact": "hold", "contact_window": 0.010,
    },
    "Table I, hold 15 ms": {"controller": "ADRC", "contact": "hold", "contact_window": 0.015},
}  # fmt: skip
ON_PATH = tuple(CONTROLLERS)[:2]
"""Controllers on the path."""
STEPS = 25
"""Of the walk to the cycle: 0.7^25 of the start is left."""
START, SECTION = 0.35, 0.70
"""Where walks start, and where the section is, as parts of a single support's duration."""
SCALE = np.repeat([5e-3, 5e-2], 5)
"""Largest distance of a start to the cycle, in angles [rad] and rates [rad/s]; coordinates are scaled by it."""
PITCH = 4
"""The coordinate that follows from Theta on the section."""
PAIRS, PLACEBO = 40, 20
SEED = 17_002
TORQUE = 150.0
"""Of every motor [N m]: without a limit the torque that takes 50 mrad/s away lifts the stance foot."""
REACH = 0.8
"""Longest time [s] of a walk to its section."""
Walked = tuple[ba.CompiledLoop, Arc]
"""A loop, and the last single support of its walk to the cycle."""


def study(quick: bool) -> list[Row]:
    """Every controller on the ground of the study, T = 2 ms."""
    periods, sizes = ((1e-3,), (1.0,)) if quick else ((1e-3, 2e-4), (1.0, 0.25))
    return [
        {"controller": name, "period": period, "size": size}
        for name, period, size in product(CONTROLLERS, periods, sizes)
    ]


def path(quick: bool) -> list[Row]:
    """NPD and m = 1 from T = 20 ms to 1 ms."""
    points = [point for point in limit.path(quick) if point["time_constant"] >= 1e-3]
    return [{"controller": name, "size": 1.0, **point} for name in ON_PATH for point in points]


def judged(**point: Any) -> Row:
    """Multipliers of a soft walk."""
    loop, arc, scatter = cycle(point)
    if arc is None:
        return {"status": "no cycle"}
    random = np.random.default_rng(SEED)
    scale = point["size"] * SCALE
    pairs, lost = passed_by(
        (loop, arc), [scale * random.uniform(-1.0, 1.0, 10) for _ in range(PAIRS)], random
    )
    placebo, _ = passed_by((loop, arc), [0.0 * scale] * PLACEBO, random)
    told = multipliers(pairs, placebo, SEED)
    return {
        "status": "cycle",
        "scatter": scatter,
        "lost": lost,
        "magnitudes": told.magnitudes.tolist(),
        "low": told.low,
        "high": told.high,
        "floor": told.floor,
        "left": told.left,
    }


@cache
def controlled(name: str, period: float) -> ba.Controller:
    """One of CONTROLLERS on gait `published`."""
    given = ba.Scenario(**CONTROLLERS[name], period=period)
    return build(given, RobotAndGait.of(given)).controller


def cycle(point: Row) -> tuple[ba.CompiledLoop, Arc | None, float]:
    """The loop of a point, the last single support of its walk and by how much the last ten differ.

    That is the largest standard deviation of a rate where Theta passes the section [rad/s]. None and NaN for a
    walk that does not make its steps.
    """
    biped, gait, _ = limit.walker()
    ground = limit.ground_at(point) if "time_constant" in point else ba.SoftGround()
    plant = ba.MuJoCoPlant(biped, ground, h=point.get("h", 2e-4))
    loop = ba.CompiledLoop(
        plant,
        controlled(point["controller"], point["period"]),
        biped,
        ba.SampledTime(point["period"]),
        torque_limit=TORQUE,
    )
    x0 = loop.initial_state(*gait.start(biped))
    run = loop.run(x0, ba.RunOptions(1.0 * STEPS, stop_after=(FOOT_STRIKE, STEPS)))
    if run.status is not ba.Status.COMPLETED:
        return loop, None, np.nan
    level = phase_at(run.arcs[-1], SECTION)
    states = np.array([crossing(arc, level) for arc in run.arcs[-10:]])
    return loop, run.arcs[-1], float(np.max(np.std(states[:, 5:], axis=0)))


def passed_by(
    walked: Walked, distances: list[Array], random: np.random.Generator
) -> tuple[Pairs, int]:
    """Pairs of walks at plus and minus these distances (10,), and how many of them did not pass twice."""
    rows = []
    for d in distances:
        one, other = (passages(walked, sign * d, float(random.uniform())) for sign in (1.0, -1.0))
        if one is not None and other is not None:
            rows.append(0.5 * (one - other))
    half = np.delete(np.array(rows) / SCALE, PITCH, axis=2)
    return Pairs(half[:, 0], half[:, 1]), len(distances) - len(rows)


def passages(walked: Walked, distance: Array, fraction: float) -> Array | None:
    """States (2, 10) where a walk passes the section, at first and one step later; None where it does not.

    It starts `distance` (10,) beside the cycle, a fraction of a sampling period later than START.
    """
    loop, arc = walked
    level, mode = phase_at(arc, SECTION), arc.mode
    t0 = arc.t[0] + START * (arc.t[-1] - arc.t[0]) + fraction * loop.timing.period
    x0 = beside(loop, arc, t0, distance)
    first = loop.run(x0, ba.RunOptions(t0 + REACH, t0, stop_after=(FOOT_STRIKE, 1)), mode)
    event = first.arcs[0].event
    if not first.status.ok or event is None or event.x_plus is None:
        return None
    after = Mode(mode.step + 1, event.t)
    second = loop.run(event.x_plus, ba.RunOptions(event.t + (arc.t[-1] - arc.t[0]), event.t), after)
    if phase(second.arcs[0].x[-1]) > level:
        return None
    return np.array([crossing(first.arcs[0], level), crossing(second.arcs[0], level)])


def beside(loop: ba.CompiledLoop, arc: Arc, t0: float, distance: Array) -> Array:
    """x (nx,) at t0 [s] with (q, q') beside the arc's, the stance foot as it is, and a new observer."""
    there, n = arc(t0), loop.plant.n
    q, v = there[:n] + distance[:n], there[n : 2 * n] + distance[n:]
    on_cycle, x = (
        loop.initial_state(*at, arc.mode) for at in ((there[:n], there[n : 2 * n]), (q, v))
    )
    first = 2 * n + loop.controller_size(x)
    own = slice(first, first + loop.own)
    return loop.with_plant(x, PlantState(t0, q, v, there[own] + x[own] - on_cycle[own]))


def phase(x: Array) -> float:
    """Theta [rad] of a state x (nx,)."""
    return float(limit.walker()[1].constraint.phase @ x[:5])


def phase_at(arc: Arc, part: float) -> float:
    """Theta [rad] after that part of an arc."""
    return phase(arc(arc.t[0] + part * (arc.t[-1] - arc.t[0])))


def crossing(arc: Arc, level: float) -> Array:
    """State (10,) where Theta falls through a level [rad], between two nodes."""
    left = np.array([phase(x) for x in arc.x]) - level
    k = int(np.flatnonzero((left[:-1] > 0.0) & (left[1:] <= 0.0))[0])
    t = brentq(lambda t: phase(arc(t)) - level, arc.t[k], arc.t[k + 1], xtol=1e-14)
    x: Array = arc(t)[:10]
    return x


def rigid(controller: str, period: float, size: float) -> Row:
    """The largest |multiplier| of the rigid walk: of pairs as far apart as those of the soft one, and nearby.

    The sampled map bends where an impact passes a sample instant; nearby is between two of these bends.
    """
    biped, gait, _ = limit.walker()
    walker = ba.Walker(biped, controlled(controller, period), timing=ba.SampledTime(period))
    P = ba.ReturnMap(walker, default_method(walker), controller_states=False)
    orbit = P.fixed_point(ba.walk(walker, gait, 10).trajectory.before(FOOT_STRIKE)[-1])
    return {
        "rigid": float(magnitudes(fitted(images(P, P.project(orbit.x_minus), size)))[0]),
        "nearby": float(np.abs(orbit.multipliers[0])),
    }


def images(P: ba.ReturnMap, s: Array, size: float) -> Pairs:
    """Pairs of a return map beside its fixed point s (9,), as far from it as those of soft walks of a size."""
    scale = np.delete(SCALE, PITCH)
    d = np.random.default_rng(SEED).uniform(-size, size, (PAIRS, len(scale)))
    ends = np.array(P.images([s + sign * x * scale for x in d for sign in (1.0, -1.0)]))
    return Pairs(d, 0.5 * (ends[0::2] - ends[1::2]) / scale)


HEAD = (
    "largest",
    "95 %",
    "rigid",
    "rigid, nearby",
    "floor",
    "second largest",
    "left / noise",
    "scatter",
)


def told(row: Row) -> list[str]:
    """What was found at a point, as cells of a table."""
    if row["status"] != "cycle":
        return ["no cycle", *["–"] * (len(HEAD) - 1)]
    largest, second = row["magnitudes"][:2]
    below = "" if second > row["floor"] else " (below)"
    return [
        f"{largest:.4f}",
        f"{row['low']:.4f} to {row['high']:.4f}",
        f"{row['rigid']:.4f}",
        f"{row['nearby']:.4f}",
        f"{row['floor']:.4f}",
        f"{second:.4f}{below}",
        f"{row['left']:.1f}",
        f"{1e3 * row['scatter']:.2f} mrad/s",
    ]


def with_rigid(rows: list[Row], kept: Path | None) -> list[Row]:
    """The rows with what the rigid walk of the same controller, sampling period and distance has."""
    names = ("controller", "period", "size")
    points = [{name: row["point"][name] for name in names} for row in rows]
    other = kept.with_name("soft_multipliers_rigid.jsonl") if kept else None
    return [beside | row for row, beside in zip(rows, found(points, rigid, other), strict=True)]


def study_table(rows: list[Row]) -> str:
    """Of the ground of the study."""
    head = ("controller", "sampled each", "distance", *HEAD)
    lines = [
        [
            p["controller"],
            f"{1e3 * p['period']:g} ms",
            f"{1e3 * SCALE[0] * p['size']:g} mrad",
            *told(row),
        ]
        for row in rows
        for p in [row["point"]]
    ]
    return markdown(head, lines)


def path_table(rows: list[Row]) -> str:
    """Along the path."""
    lines = [
        [row["point"]["controller"], f"{1e3 * row['point']['time_constant']:g} ms", *told(row)]
        for row in rows
    ]
    return markdown(("controller", "T", *HEAD), lines)


def main() -> None:
    """Walk, show, and write."""
    parser = arguments(__doc__)
    parser.add_argument("--page", type=Path, help="where the tables are written, between marks")
    given = parser.parse_args()
    kept = given.out / "soft_multipliers.jsonl" if given.out else None
    parts = {
        name: with_rigid(found(points(given.quick), judged, kept), kept)
        for name, points in (("study", study), ("path", path))
    }
    table = Table("Multipliers of the soft walk", "1", __doc__ or "", ["mujoco-core"])
    for part, rows in parts.items():
        for row in rows:
            table.add(part, **row["point"], **{k: x for k, x in row.items() if k != "point"})
    table.finish(given.out)
    if given.page:
        write_between(given.page, "multipliers study", study_table(parts["study"]))
        write_between(given.page, "multipliers path", path_table(parts["path"]))


if __name__ == "__main__":
    main()
