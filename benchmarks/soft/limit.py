"""The rigid walk as the limit of the soft one: NPD on gait `published`, against stiffness, friction and foot.

Run: python benchmarks/soft/limit.py [OUT] [--quick] [--page docs/soft_limit.md]

Both walks have the same sample instants and no limit of the torque, and go on from the start of the gait
until they nearly repeat: means over the last four of fourteen steps, when 3 % of a transient is left. A soft
touchdown is noticed at a sample instant, so steps are not quite alike. The state before an impact is taken
where the swing foot crosses the ground, between two sample instants. Two parts:

    path       all that is soft is made stiff together, the engine's step a tenth of the time constant; at
               critical damping, where a foot rebounds with e^-2 of its speed however stiff the ground is, and
               with four times the damping ratio
    shares     one parameter at a time, from the usual ground on

Rows are kept in OUT/soft_limit.jsonl, from where an interrupted run goes on. About 10 minutes.
"""

from __future__ import annotations

import math
import sys
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report import Table, arguments
from soft.rows import Row, found, markdown, write_between

import biped_adrc as ba
from biped_adrc.closed_loop.feet import readings
from biped_adrc.hybrid.trajectory import Arc
from biped_adrc.types import Array

STEPS, LAST = 14, 4
"""Steps of a walk, and how many of them count."""
FRICTION = 1.0
"""No foot of this gait slips here: slipping is another question (legality.py)."""
USUAL = {
    "time_constant": 2e-3, "slack": 0.01, "slip": 0.05, "foot_radius": 1e-3, "h": 2e-4, "period": 4e-4,
}  # fmt: skip
"""slack: 1 - d, the same at every depth; slip: 1 / impratio; period: between two sample instants [s]."""
HALVED = {
    "time_constant": (8e-3, 4e-3, 2e-3),
    "slack": (0.08, 0.04, 0.02, 0.01, 0.005, 0.0025),
    "slip": (0.4, 0.2, 0.1, 0.05, 0.025, 0.0125),
    "foot_radius": (8e-3, 4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4),
    "h": (4e-4, 2e-4, 1e-4, 5e-5),
    "period": (1.6e-3, 8e-4, 4e-4, 2e-4),
}
"""Values of one parameter, each half of the one before, all others as usual."""


def path(quick: bool) -> list[Row]:
    """From soft to stiff: all goes with the time constant T, but for a sampling period of at most 1 ms."""
    times = (20e-3, 10e-3, 5e-3) if quick else (20e-3, 10e-3, 5e-3, 2e-3, 1e-3, 5e-4, 2.5e-4)
    return [
        {
            "time_constant": T, "slack": 5.0 * T, "slip": 25.0 * T, "foot_radius": 0.5 * T,
            "h": min(0.1 * T, 1e-3), "period": min(0.2 * T, 1e-3),
        }
        for T in times
    ]  # fmt: skip


def damped(points: list[Row]) -> list[Row]:
    """The same with four times the damping ratio, down to 0.5 ms."""
    return [{**point, "spring": 0.25} for point in points if point["time_constant"] >= 5e-4]


def shares(quick: bool) -> dict[str, list[Row]]:
    """By parameter, the points of `HALVED`."""
    found = {name: [{**USUAL, name: x} for x in values] for name, values in HALVED.items()}
    return {} if quick else found


@cache
def walker() -> tuple[ba.Biped, ba.Gait, ba.NPDController]:
    """Robot, gait and controller."""
    biped = ba.Biped.load("rabbit")
    gait = ba.load_gait("published", biped)
    return biped, gait, ba.NPDController(gait.constraint)


@cache
def rigid(period: float) -> tuple[float, Array]:
    """Period [s] and state before impact (10,) of the rigid walk, sampled each `period` [s]."""
    biped, gait, npd = walker()
    run = ba.walk(ba.Walker(biped, npd, timing=ba.SampledTime(period)), gait, STEPS).trajectory
    events = run.events("foot_strike")
    return cycle(np.array([e.t for e in events]), np.array([e.x_minus[:10] for e in events]))


def soft(**point: float) -> Row:
    """The walk on soft ground beside the rigid one: period, and state before impact."""
    biped, gait, npd = walker()
    plant = ba.MuJoCoPlant(biped, ground_at(point), h=point["h"])
    loop = ba.SteppingLoop(plant, npd, biped, ba.SampledTime(point["period"]))
    x0 = loop.initial_state(*gait.start(biped))
    run = loop.run(x0, ba.RunOptions(20.0, stop_after=("foot_strike", STEPS)))
    if run.status is not ba.Status.COMPLETED:
        return {"status": run.status.name}
    before = [crossing(loop, arc) for arc in run.arcs]
    T, x = cycle(np.array([t for t, _ in before]), np.array([x for _, x in before]))
    T_r, x_r = rigid(point["period"])
    return {
        "status": run.status.name,
        "period": T,
        "rigid period": T_r,
        "period gap": T / T_r - 1.0,
        "angle gap": float(np.max(np.abs((x - x_r)[:5]))),
        "rate gap": float(np.linalg.norm((x - x_r)[5:]) / np.linalg.norm(x_r[5:])),
    }


def ground_at(point: Row) -> ba.SoftGround:
    """The ground of a point."""
    d = 1.0 - point["slack"]
    return ba.SoftGround(
        FRICTION, point["time_constant"], impedance=(d, d), impratio=1.0 / point["slip"],
        foot_radius=point["foot_radius"], damping_ratio=1.0 / point.get("spring", 1.0),
    )  # fmt: skip


def crossing(loop: ba.SteppingLoop, arc: Arc) -> tuple[float, Array]:
    """Time [s] and state (10,) where the swing foot comes to the ground, from the last node above it."""
    end = slice(len(arc.t) - min(len(arc.t), 60), None)
    last = Arc(arc.mode, arc.t[end], arc.x[end], arc.dx[end], None, {"u": arc.read["u"][end]})
    r = readings(loop, last)
    k = int(np.flatnonzero(r.place[:, 1, 1] > 0.0)[-1])
    k -= 1 - k % 2  # the end of a piece, so that its slope is that of the flight before
    left = float(r.place[k, 1, 1] / -r.speed[k, 1, 1])
    a = (r.v[k] - r.v[k - 1]) / (r.t[k] - r.t[k - 1])
    return r.t[k] + left, np.concatenate((r.q[k] + left * r.v[k], r.v[k] + left * a))


def cycle(times: Array, before: Array) -> tuple[float, Array]:
    """Period [s] and state before impact (10,) from impacts at (K,) [s] and states before them (K, 10)."""
    return float(np.mean(np.diff(times)[-LAST:])), np.mean(before[-LAST:], axis=0)


def orders(values: list[float]) -> str:
    """Observed orders from values of which each belongs to half the parameter of the one before."""
    found = pairwise(np.abs(np.diff(values)))
    return ", ".join(f"{math.log2(a / b):.1f}" for a, b in found)


def path_table(rows: list[Row]) -> str:
    """Gaps along the path, and the order of each between two rows."""
    lines: list[list[object]] = []
    for k, row in enumerate(rows):
        T, gaps = row["point"]["time_constant"], [row["period gap"], row["rate gap"]]
        told = [f"{100 * gap:.2f} %" for gap in gaps]
        if k > 0:
            before, T_before = rows[k - 1], rows[k - 1]["point"]["time_constant"]
            for i, name in enumerate(("period gap", "rate gap")):
                order = math.log(abs(before[name] / gaps[i])) / math.log(T_before / T)
                told[i] += f" ({order:.1f})"
        lines.append([f"{1e3 * T:g} ms", *told, f"{1e3 * row['angle gap']:.3f} mrad"])
    head = ("T", "period (order)", "rates before impact (order)", "angles")
    return markdown(head, lines)


def share_table(rows: dict[str, list[Row]]) -> str:
    """What each parameter changes in the period from its usual value to its finest, and its order; of the time
    constant, whose finest is the usual one, to zero by the line through the last two.
    """
    lines: list[list[object]] = []
    for name, found_ in rows.items():
        values = [row["point"][name] for row in found_]
        gaps = [100.0 * row["period gap"] for row in found_]
        usual, last = gaps[values.index(USUAL[name])], gaps[-1]
        if values[-1] == USUAL[name]:
            last = 2.0 * last - gaps[-2]  # of first order, to zero
        share = f"{usual - last:+.2f} %"
        told = ", ".join(f"{gap:.3f}" for gap in gaps)
        given = ", ".join(f"{x:g}" for x in values)
        lines.append([name, given, told, orders(gaps), share])
    head = ("parameter", "values", "period gap [%]", "orders", "share")
    return markdown(head, lines)


def main() -> None:
    """Walk, show, and write."""
    parser = arguments(__doc__)
    parser.add_argument("--page", type=Path, help="where the tables are written, between marks")
    given = parser.parse_args()
    kept = given.out / "soft_limit.jsonl" if given.out else None
    along = found(path(given.quick), soft, kept)
    overdamped = found(damped(path(given.quick)), soft, kept)
    single = {name: found(points, soft, kept) for name, points in shares(given.quick).items()}
    table = Table("Rigid walk as limit of the soft one", "s", __doc__ or "", ["mujoco-core"])
    for part, rows in {"path": along, "damped": overdamped, **single}.items():
        for row in rows:
            result = {key.replace(" ", "_"): x for key, x in row.items() if key != "point"}
            table.add(part, **{f"at_{key}": x for key, x in row["point"].items()}, **result)
    table.finish(given.out)
    if given.page:
        write_between(given.page, "limit path", path_table(along))
        write_between(given.page, "limit damped", path_table(overdamped))
        write_between(given.page, "limit shares", share_table(single))


if __name__ == "__main__":
    main()
