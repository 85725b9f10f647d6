"""Steps of the ground in MuJoCo: where the foot comes down, when, and that nothing else changes.

walker_on(biped, gait, *steps) is RABBIT under NPD with these steps of the ground, walked(walker, gait) its loop
and run in MuJoCo; the fixture level is both on level ground. StepDown(k, h): single support k ends h [m] lower.
steps_of has what the feet did in each single support, SOFT the values of a scenario in MuJoCo.
"""

from __future__ import annotations

import pickle
from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.engine.on_plant import fastest_loop
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.extras.mujoco.robot import mujoco
from biped_adrc.model.ground import SoftGround, StepUp, ground_axes

from .loops import SOFT, TICK, run_of, steps_of


def walker_on(biped, gait, *steps):
    law = ba.NPDController(gait.constraint)
    return ba.Walker(biped, law, timing=TICK, torque_limit=150.0, ground_steps=steps)


def walked(walker, gait, impacts=3):
    loop = fastest_loop(walker, MuJoCoPlant(walker.plant))
    return loop, run_of(loop, gait, impacts=impacts)


def first(arc, k):
    """The first k nodes of an arc, as its fields."""
    read = {name: rows[:k] for name, rows in arc.read.items()}
    return {"t": arc.t[:k], "x": arc.x[:k], "dx": arc.dx[:k], "read": read, "event": None}


@pytest.fixture(scope="module")
def level(biped, gait):
    return walked(walker_on(biped, gait), gait)


@pytest.mark.parametrize("step", [ba.StepDown(2, 5e-3), StepUp(2, 5e-3)], ids=["down", "up"])
def test_the_foot_comes_down_on_the_step_as_on_the_rigid_plant(biped, gait, level, step):
    """In single support 2 the foot lands 5 mm lower or higher, to the penetration of both feet, and the step
    lasts longer or shorter by as much as on the rigid plant, to a tick. Single support 3 ends on even ground
    again, and its stance foot is pressed in about as deep as on level ground.
    """
    walker = walker_on(biped, gait, step)
    loop, run = walked(walker, gait)
    assert run.status is ba.Status.COMPLETED
    foot = biped.swing_foot(run.arcs[1].x[-1, :5])[1]
    assert foot == pytest.approx(-step.drop, abs=4e-4)  # penetration of both feet
    rigid = ba.walk(walker, gait, impacts=2).trajectory.events("foot_strike")
    flat = ba.walk(replace(walker, ground_steps=()), gait, impacts=2).trajectory.events(
        "foot_strike"
    )
    longer = rigid[1].t - flat[1].t
    assert longer * step.drop > 0.0
    found = run.events("foot_strike")[1].t - level[1].events("foot_strike")[1].t
    assert found == pytest.approx(longer, abs=1.5e-3)
    assert biped.swing_foot(run.arcs[2].x[-1, :5])[1] == pytest.approx(0.0, abs=4e-4)
    # of single support 3 its first 40 nodes alone, in which the foot lands
    after = replace(run, arcs=tuple(replace(arc, **first(arc, 40)) for arc in run.arcs[2:]))
    (landing,) = steps_of(loop, after)
    assert 0.2e-3 < landing.depth < 0.45e-3  # 0.41 mm on level ground


def test_a_plane_that_moves_gives_no_kick(biped, gait, level):
    """Until the foot is at the ground (below 5.5 mm, more than 0.35 s after its start) the motion is that on
    level ground, bit for bit; before 0.2 s it is low since it has just left the ground. Columns are q, q' (10),
    touchdown and base (5), number of the single support, levels. Column 17 is the level under the swing foot:
    it changes once the foot is ahead of the stance foot, where it is high enough.
    """
    for step in (ba.StepDown(2, 5e-3), StepUp(2, 5e-3)):
        _, run = walked(walker_on(biped, gait, step), gait, 2)
        ours, theirs = run.arcs[1], level[1].arcs[1]
        low = [biped.swing_foot(x[:5])[1] < 5.5e-3 for x in theirs.x]
        late = ours.mode.start + 0.2
        until = next(k for k, t in enumerate(theirs.t) if low[k] and t > late)
        assert theirs.t[until] - ours.mode.start > 0.35
        np.testing.assert_array_equal(ours.x[:until, :10], theirs.x[:until, :10])
        np.testing.assert_array_equal(run.arcs[0].x[:, :15], level[1].arcs[0].x[:, :15])
        moved = ours.x[:until, 17] == -step.drop
        ahead = np.array([biped.swing_foot(x[:5])[0] > 0.0 for x in ours.x[:until]])
        np.testing.assert_array_equal(moved, ahead)


def test_a_step_up_that_is_not_cleared_is_not_there(biped, gait, level):
    """A step of 0.2 m is higher than the foot, which lands on the level from which it came, as without it."""
    _, run = walked(walker_on(biped, gait, StepUp(1, 0.2)), gait, 1)
    np.testing.assert_array_equal(run.arcs[0].x[:, :10], level[1].arcs[0].x[:, :10])


@pytest.mark.parametrize("slope", [0.0, 0.1])
def test_each_foot_touches_its_own_level_along_the_vertical(biped, gait, slope):
    """Depths of both feet in MuJoCo are the distances to their levels [m], which are written into the state
    (16: stance, 17: swing foot), along the normal `out` of the slope; also after other levels, and in a plant
    that was sent to another process (pickle).
    """
    ground = SoftGround(foot_radius=5e-3)
    # any step of the ground gives each foot a plane of its own
    plant = MuJoCoPlant(biped, ground, slope, ground_steps=(ba.StepDown(1, 0.01),))
    q, out = gait.start(biped)[0], ground_axes(slope)[1]
    q = q - [0.0, 0.0, 0.0, 0.6, 0.0]  # the swing foot in the air
    state = plant.start(0.0, q, np.zeros(5))
    foot = float(biped.swing_foot(q) @ out)
    for levels in ((0.0, foot / out[1] + 1e-3), (2e-3, foot / out[1] + 3e-3)):
        state[16:18] = levels
        for p in (plant, pickle.loads(pickle.dumps(plant))):
            p.engine.place(state)
            mujoco().mj_forward(p.engine.model, p.engine.data)
            depths = [-contact.dist for contact in p.engine.data.contact]
            expected = [x * out[1] for x in (levels[0], levels[1] - foot / out[1])]
            np.testing.assert_allclose(depths, expected, rtol=0.0, atol=2e-6)


def test_uneven_ground_of_a_scenario_is_that_of_the_rigid_plant():
    """Each foot lands as much lower than the other as the rigid ground of the same seed is there (`drop`), to
    the penetration of 0.5 mm; the steps differ by more than 2 mm.
    """
    walk = ba.walk_scenario(
        ba.Scenario("NPD", run={"impacts": 3, "seed": 4}, ground={"rms": 2e-3}, **SOFT)
    )
    assert walk.trajectory.status is ba.Status.COMPLETED
    # (x, z) of the stance foot, then of the other, at the end of each single support
    feet = [arc.read["foot_place"][-1] for arc in walk.trajectory.arcs]
    falls = [foot[1] - foot[3] for foot in feet]
    np.testing.assert_allclose(falls, [walk.walker.drop(k) for k in (1, 2, 3)], atol=5e-4)
    assert np.ptp(falls) > 2e-3
    # the steps are stored with the walk
    kept = walk.trajectory.settings["plant"]["ground_steps"]
    assert kept[0]["height"] == walk.walker.ground_steps[0].height
