"""A run on a plant that moves by itself ends as run away, as a walker's does, and never as a crash.

The plant is MuJoCo's. LOOPS are the same closed loop in Python and in machine code; run_of simulates one of
them.
"""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.system import RUNAWAY_RATE
from biped_adrc.core.errors import InputError
from biped_adrc.engine.on_plant import CompiledLoop
from biped_adrc.extras.mujoco.engine import MuJoCoEngine
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.hybrid.integrators import StepFailed
from biped_adrc.hybrid.simulator import RunOptions
from tests.test_numerics import all_finite

from .loops import TICK, run_of

LOOPS = [SteppingLoop, CompiledLoop]


class Explodes(ba.Controller):
    """Torques e times as large every millisecond, in plain Python."""

    def output(self, s, m):
        return np.full(4, math.exp(1e3 * m.t))


@pytest.fixture(scope="module")
def plant(biped):
    return MuJoCoPlant(biped)


@pytest.mark.parametrize("made", LOOPS)
def test_a_controller_that_explodes_ends_as_run_away(made, plant, gait):
    """The walk ends by its torque: e^(1e3 t) passes 1000 times 150 N m after 11.9 ms, at the tick of 12 ms.
    With a bound of 0.5 x RUNAWAY_RATE on the rates these end the run before. Both are statuses with finite
    numbers in both loops (`made`).
    """
    # in a loop None is the push: there is none
    free = run_of(
        made(plant, Explodes(), None, TICK, plant.biped, runaway_speed=math.inf), gait, 0.05
    )
    assert free.status is ba.Status.RAN_AWAY
    assert "above 1.5e+05 N m" in free.detail
    assert free.t_end == pytest.approx(12e-3)
    assert all_finite(free)
    found = run_of(made(plant, Explodes(), None, TICK, plant.biped, runaway_speed=0.5), gait, 0.05)
    assert found.status is ba.Status.RAN_AWAY
    assert "rad/s, above" in found.detail
    assert found.t_end < 12e-3
    assert all_finite(found)
    assert np.all(np.abs(found.arcs[-1].x[:, 5:10]) <= 0.5 * RUNAWAY_RATE)


@pytest.mark.parametrize("made", LOOPS)
def test_the_bounds_are_those_of_the_loop(made, plant, gait):
    """A bound 1 % below the peak of a walk ends it where the torque or rate passes it, one 1 % above does not.
    A torque ends the run at its tick, a rate at the end of the last stretch in which it is within the bound.
    """
    parts = plant, ba.NPDController(gait.constraint), None, TICK, plant.biped  # None: no push
    arc = run_of(made(*parts), gait, 0.05).arcs[0]
    # as shares of the robot's peak torque, 150 N m, and of the rate that the bound counts in
    peak = np.max(np.abs(arc.read["u"]), axis=1) / 150.0
    fast = np.max(np.abs(arc.x[:, 5:10]) / RUNAWAY_RATE, axis=1)
    for bound, course in (("runaway_torque", peak), ("runaway_speed", fast)):
        limit = float(0.99 * np.max(course))
        found = run_of(made(*parts, **{bound: limit}), gait, 0.05)
        assert found.status is ba.Status.RAN_AWAY
        assert found.t_end == pytest.approx(arc.t[np.argmax(course > limit) - ("speed" in bound)])
        whole = run_of(made(*parts, **{bound: float(1.01 * np.max(course))}), gait, 0.05)
        assert whole.status is ba.Status.COMPLETED
    with pytest.raises(InputError, match="runaway_speed is nan"):
        made(*parts, runaway_speed=math.nan)


@pytest.mark.parametrize(
    ("lost", "status", "engine", "after"),
    [
        ("nan", "NOT_FINITE", "compiled", 0.43),
        ("fast", "RAN_AWAY", "pinocchio", 0.0),
        ("raise", "STEP_FAILED", "compiled", 0.0),
    ],
)
def test_a_walk_that_the_engine_loses_can_be_read(
    monkeypatch, tmp_path, engine, lost, status, after
):
    """The engine is replaced by one that fails from `after` [s] on (0.43 s: in the second single support) in
    the way `lost`: NaN, rates of 1e4, or an error. The walk is recorded up to there, finite, and can be stored
    and judged.
    """
    moved = MuJoCoEngine.moved

    def fails(self, t, row, u, load, until):
        if t < after:
            return moved(self, t, row, u, load, until)
        if lost == "raise":
            raise StepFailed("lost")
        return row + (math.nan if lost == "nan" else 1e4)

    monkeypatch.setattr(MuJoCoEngine, "moved", fails)
    s = ba.Scenario(
        "NPD", ground="mujoco", hardware={"period": 1e-3}, run={"impacts": 2, "engine": engine}
    )
    walk = ba.walk_scenario(s)
    assert walk.trajectory.status.name == status
    assert all_finite(walk.trajectory)
    nodes = sum(len(arc.t) for arc in walk.trajectory.arcs)
    assert len(walk.signals.ground_reaction) == nodes
    again = ba.load_walk(walk.save(tmp_path / "walk.npz"))
    for each in (walk, again):
        assert each.outcome.impacts == (1 if after else 0)
        assert len(each.soft_steps) == len(walk.trajectory.arcs)
    assert np.all(np.isfinite(walk.trajectory.arcs[-1].read["foot_force"]))


def test_one_loop_walks_alike_in_many_threads(plant, gait):
    """Each thread has MuJoCo's data of its own; in shared data two walks would end the process. Eight runs in
    four threads end in the same state as one alone.
    """
    # None: no push
    loop = CompiledLoop(plant, ba.NPDController(gait.constraint), None, TICK, plant.biped)
    begin = loop.initial_state(*gait.start(plant.biped))
    with ThreadPoolExecutor(4) as pool:
        runs = list(pool.map(lambda _: loop.run(begin, RunOptions(0.05)), range(8)))
    alone = loop.run(begin, RunOptions(0.05))
    assert all(np.array_equal(run.final_state, alone.final_state) for run in runs)
