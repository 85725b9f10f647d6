"""Whether walks that the rigid model calls legal hold on soft ground, and those that it calls illegal slip.

Run: python benchmarks/soft/legality.py [OUT] [--number 200] [--quick] [--page docs/soft_limit.md]

Random walks of NPD on RABBIT: gait, friction, and one push in the second of four steps. Each is walked on the
rigid plant and judged there within its friction; the legal ones and those whose friction alone is too small are
walked again in MuJoCo on ground with that friction. Drawn until `number` of them are legal.

Rows are kept in OUT/soft_legality.jsonl, from where an interrupted run goes on. About 20 minutes.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report import Table, arguments
from soft.rows import Row, found, markdown, write_between

import biped_adrc as ba

SEED, STEPS, PERIOD, TORQUE = 17_001, 4, 1e-3, 150.0
GAITS = ("published", "v0.5", "v0.6", "v0.7", "v0.8", "v0.9", "v1")
SLIPS = 5e-3
"""Distance in one single support from which on a walk slips [m]."""
LEGAL, FRICTION, OTHER = "legal", "friction", "other"
"""How the rigid model judges a walk: legal, illegal by friction alone, or otherwise."""


@cache
def rabbit() -> ba.Biped:
    """The robot."""
    return ba.Biped.load("rabbit")


def drawn(k: int) -> tuple[ba.Gait, float, ba.TorquePulse]:
    """Gait, friction and push of walk k."""
    random = np.random.default_rng(np.random.SeedSequence([SEED, k]))
    gait = ba.load_gait(GAITS[random.integers(len(GAITS))], rabbit())
    friction = float(random.uniform(0.4, 1.0))
    sign = random.choice([-1.0, 0.0, 1.0], size=5)
    amplitude = float(np.exp(random.uniform(np.log(3.0), np.log(60.0))))
    start = float(random.uniform(0.02, 0.2))
    push = ba.TorquePulse(
        amplitude * sign, step=2, start=start, stop=start + random.uniform(0.05, 0.2)
    )
    return gait, friction, push


def judged(k: int) -> Row:
    """Walk k on the rigid plant and, where it is legal or its friction alone is too small, on soft ground."""
    gait, friction, push = drawn(k)
    npd, timing = ba.NPDController(gait.constraint), ba.SampledTime(PERIOD)
    walker = ba.Walker(rabbit(), npd, push, timing, torque_limit=TORQUE)
    walk = ba.walk(walker, gait, STEPS)
    legality = walk.legal_within(ba.Limits(friction=friction))
    row: Row = {
        "gait": gait.name,
        "friction": friction,
        "rigid": OTHER,
        "needed": legality.mean_friction,
        "impulse ratio": legality.impulse_ratio,
    }
    reasons = set(legality.reasons)
    if walk.trajectory.status is not ba.Status.COMPLETED or reasons - {"friction"}:
        return row
    row["rigid"] = FRICTION if reasons else LEGAL
    return row | on_soft_ground(gait, npd, friction, push)


def on_soft_ground(
    gait: ba.Gait, npd: ba.NPDController, friction: float, push: ba.TorquePulse
) -> Row:
    """How the walk ends there, and the largest slip, creep and time in the air of a single support."""
    plant = ba.MuJoCoPlant(rabbit(), ba.SoftGround(friction))
    loop = ba.SteppingLoop(plant, npd, rabbit(), ba.SampledTime(PERIOD), push, TORQUE)
    x0 = loop.initial_state(*gait.start(rabbit()))
    run = loop.run(x0, ba.RunOptions(2.0 * STEPS, stop_after=("foot_strike", STEPS)))
    steps = ba.soft_steps(loop, run, PERIOD)
    if 0.4 * SLIPS < max(sum(step.slip) for step in steps) < 2.5 * SLIPS:
        steps = ba.soft_steps(loop, run)  # at each step of the engine, where it decides
    return {
        "soft": run.status.name,
        "slip": max(sum(step.slip) for step in steps),
        "creep": max(sum(step.creep) for step in steps),
        "flight": max(step.flight for step in steps),
        "double support": max(step.double_support for step in steps),
    }


def walks(number: int, kept: Path | None) -> Iterator[Row]:
    """Rows of walks 0, 1, .. until `number` of them are legal."""
    legal, k = 0, 0
    while legal < number:
        (row,) = found([{"k": k}], judged, kept)
        legal, k = legal + (row["rigid"] == LEGAL), k + 1
        yield row


def summary(rows: list[Row]) -> str:
    """How many of each kind slip, by what the rigid model says."""
    kinds = {
        "legal": [r for r in rows if r["rigid"] == LEGAL],
        "legal, the impacts' impulses within the cone too": [
            r for r in rows if r["rigid"] == LEGAL and r["impulse ratio"] <= r["friction"]
        ],
        "illegal by friction": [r for r in rows if r["rigid"] == FRICTION],
        "illegal by friction, short by more than 0.1": [
            r for r in rows if r["rigid"] == FRICTION and r["needed"] > r["friction"] + 0.1
        ],
    }
    lines: list[list[object]] = []
    for name, those in kinds.items():
        made = [r for r in those if r["soft"] == ba.Status.COMPLETED.name]
        slips = sum(r["slip"] >= SLIPS for r in those)
        least, middle, most = np.quantile([1e3 * r["slip"] for r in those] or [np.nan], [0, 0.5, 1])
        share = f"{100 * (1 - slips / len(those)):.0f} %" if those else ""
        lines.append(
            [name, len(those), len(made), len(those) - slips, share,
             f"{least:.2f}, {middle:.2f}, {most:.2f} mm"]
        )  # fmt: skip
    head = ("the rigid model says", "walks", "make four steps in MuJoCo", "slip less than 5 mm", "share",
            "least, median, largest slip")  # fmt: skip
    others = sum(r["rigid"] == OTHER for r in rows)
    rest = f"Of {len(rows)} walks drawn, {others} fell, or broke another limit too, on the rigid plant."
    return f"{markdown(head, lines)}\n\n{rest}"


def main() -> None:
    """Draw, walk, show, and write."""
    parser = arguments(__doc__)
    parser.add_argument("--number", type=int, default=200, help="of legal walks")
    parser.add_argument("--page", type=Path, help="where the table is written, between marks")
    given = parser.parse_args()
    kept = given.out / "soft_legality.jsonl" if given.out else None
    rows = list(walks(5 if given.quick else given.number, kept))
    table = Table("Legality on soft ground", "m, s", __doc__ or "", ["mujoco-core"])
    for row in rows:
        result = {key.replace(" ", "_"): x for key, x in row.items() if key != "point"}
        table.add(str(row["point"]["k"]), **result)
    table.finish(given.out)
    text = summary(rows)
    print(text)
    if given.page:
        write_between(given.page, "legality", text)


if __name__ == "__main__":
    main()
