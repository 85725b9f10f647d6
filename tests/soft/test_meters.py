"""What the feet do on soft ground: forces against momentum, slip and penetration against closed forms.

Readings are force, place and velocity of both feet, computed after a run for each stored instant; feet_of(arc)
has them (K, 2, 2): instant, stance and other foot, (x, z). steps_of has slip, support and depth of each step.
under_npd makes a loop in MuJoCo; the fixture walk is such a loop with its run of two steps. STILL is no push.
"""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.soft_steps import feet_of, slip_times, spans, step_of
from biped_adrc.closed_loop.other_plant import FEET, with_readings
from biped_adrc.closed_loop.protocols import Load, Mode
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.extras.mujoco.robot import mujoco
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.hybrid.storage import load, save
from biped_adrc.hybrid.trajectory import Arc
from biped_adrc.model.ground import SLIP, SoftGround

from .loops import loop_on, run_of, steps_of

STILL = Load(np.zeros(5), np.zeros(2))
FLAT = np.array([1.0, 0.0]), np.array([0.0, 1.0])


def under_npd(plant, gait, **more):
    """A loop that is sampled, and keeps its state, at every step of the engine."""
    law, tick = ba.NPDController(gait.constraint), ba.SampledTime(plant.h)
    return loop_on(plant, law, **{"timing": tick} | more)


@pytest.fixture(scope="module")
def walk(biped, gait):
    """Two steps, pushed in the second."""
    push = ba.TorquePulse([30.0, 30.0, 0.0, 0.0, 0.0], step=2, start=0.1004, stop=0.2)
    loop = under_npd(
        MuJoCoPlant(biped, SoftGround(time_constant=4e-3), h=4e-4), gait, disturbance=push
    )
    return loop, run_of(loop, gait, impacts=2)


def momentum(loop, arc, k):
    """Momentum (x, z) [N s] of the whole robot at node k, by MuJoCo's own sum over its bodies."""
    plant, x = loop.plant, arc.x[k]
    plant.footing(loop.row(x), x[-plant.p :], STILL)
    mujoco().mj_subtreeVel(plant.engine.model, plant.engine.data)
    return plant.engine.model.body_subtreemass[0] * plant.engine.data.subtree_linvel[0, [0, 2]]


@pytest.mark.parametrize("force", [(0.0, 0.0), (60.0, 40.0)])
def test_the_readings_carry_what_the_momentum_asks_for(biped, gait, force):
    """Impulse of the ground's recorded forces on both feet = change of momentum, by MuJoCo's own sum over
    bodies, + m g T - impulse of the force at the hip. From node 100 on, when the first contact has settled.
    """
    plant = MuJoCoPlant(biped)
    loop = under_npd(plant, gait, disturbance=ba.HipForce(biped, force))
    (arc,) = with_readings(loop, run_of(loop, gait, 0.1)).arcs
    a, b, t = 100, len(arc.t) - 1, arc.t
    # spans: weights of the trapezoidal rule
    impulse = spans(t[a:]) @ feet_of(arc)[0][a:].sum(axis=1)
    outside = np.array([0.0, biped.weight]) - force
    change = momentum(loop, arc, b) - momentum(loop, arc, a)
    np.testing.assert_allclose(impulse, change + outside * (t[b] - t[a]), rtol=3e-3)


def test_the_point_that_touches_moves_as_the_places_say(walk):
    """The recorded velocity is d(place)/dt of the recorded places, up to the rolling of the foot of 1 mm
    radius; 1 % of the nodes, where contact jumps, are left out. The swing foot reaches more than 1 m/s.
    """
    arc = with_readings(*walk).arcs[1]
    _, place, speed = feet_of(arc)
    # a time stands twice where something jumps
    inside = np.flatnonzero(np.diff(arc.t) > 0.0)
    h = np.diff(arc.t)[inside, np.newaxis, np.newaxis]
    slope = (place[inside + 1] - place[inside]) / h
    middle = 0.5 * (speed[inside + 1] + speed[inside])
    rolling = 1e-3 * 8.0  # radius times the largest rate of a shin
    assert np.quantile(np.abs(slope - middle), 0.99) < rolling
    assert np.max(np.abs(speed)) > 1.0


def test_a_large_foot_rolls_and_the_point_that_touches_rests(biped, gait):
    """A sphere of 5 cm whose centre moves at its radius times the shin's rate has a contact point at rest. The
    meter reads the place of the centre and the velocity of the point that touches.
    """
    plant = MuJoCoPlant(biped, SoftGround(friction=1.0, foot_radius=0.05))
    q, v = gait.start(biped)
    state = plant.start(0.0, q, v)
    pinned = plant.footing(state, np.zeros(4), STILL)
    # the ground lies a radius below the centre, which starts where the point foot is
    np.testing.assert_allclose(pinned.place[0], [0.0, 0.0], rtol=0.0, atol=1e-5)
    shin = v @ [1.0, 0.0, 1.0, 0.0, 1.0]  # rate of the stance shin, counter-clockwise
    centre = np.array([-shin * 0.05, 0.0])  # rolls forwards where it turns clockwise
    # numbers 13 and 14 of a state are the velocity (x, z) of the base
    rolling = state + np.array([*np.zeros(13), *centre])
    np.testing.assert_allclose(
        plant.footing(rolling, np.zeros(4), STILL).speed[0], 0.0, rtol=0.0, atol=1e-12
    )


def test_a_block_that_slides_to_rest():
    """With v' = -mu g the slip is (v0^2 - s^2) / (2 mu g) until v = s, the speed up to which a foot counts as
    sticking. At rest the stance foot has half the friction that it could have; the other foot is free.
    """
    mu, g, v0, mass, s = 0.3, 9.81, 0.4, 30.0, 5e-3
    t = np.linspace(0.0, 0.5, 20001)
    v = np.maximum(0.0, v0 - mu * g * t)
    force, speed = np.zeros((len(t), 2, 2)), np.zeros((len(t), 2, 2))
    force[:, 0, 1] = mass * g
    force[:, 0, 0] = np.where(v > 0.0, -mu * mass * g, -0.5 * mu * mass * g)
    speed[:, 0, 0] = v
    place = np.full((len(t), 2, 2), -2e-4)
    none = np.zeros((len(t), 2))
    feet = (x.reshape(-1, 4) for x in (force, place, speed))
    read = dict(zip(FEET, (*feet, none), strict=True))
    arc = Arc(Mode(), t, none, none, read=read)
    found = step_of(arc, mu, FLAT)  # axes of level ground
    assert found.slip == pytest.approx(((v0**2 - s**2) / (2 * mu * g), 0.0), rel=1e-3)
    assert (found.friction_used, found.depth) == pytest.approx((mu, 2e-4))
    # a second arc that is 1000 times shorter: no foot slips as far as SLIP in it
    run = SimpleNamespace(arcs=(arc, replace(arc, t=1e-3 * t)))
    far = (v0 - np.sqrt(v0**2 - 2.0 * mu * g * SLIP)) / (mu * g)  # v0 t - mu g t^2 / 2 = SLIP
    assert slip_times(run, mu, FLAT) == pytest.approx((far, np.inf), rel=5e-3)


def test_less_friction_slips_and_flies(biped, gait):
    """With friction 0.2 the stance foot slips and uses all of it, with 1.0 none slips. Both feet are in the air
    for more than 5 ms where the robot slips, for less where it does not. A step lasts as long as its arc.
    """
    # SoftGround: friction and time constant [s]
    rough = under_npd(MuJoCoPlant(biped, SoftGround(1.0, 4e-3), h=4e-4), gait)
    holds = steps_of(rough, run_of(rough, gait, impacts=1))
    smooth = under_npd(MuJoCoPlant(biped, SoftGround(0.2, 4e-3), h=4e-4), gait)
    slips = steps_of(smooth, run := run_of(smooth, gait, impacts=1))
    assert sum(holds[0].slip) == 0.0
    assert slips[0].slip[0] > 3e-4
    assert slips[0].friction_used == pytest.approx(0.2, rel=1e-3)
    assert slips[0].flight > 5e-3 > holds[0].flight
    for step, arc in zip(slips, run.arcs, strict=True):
        assert step.duration == pytest.approx(arc.t[-1] - arc.t[0], abs=1e-15)
        assert 0.0 < step.single_support < step.duration


def standing(biped, time_constant, impedance=(0.9, 0.9)):
    """A robot on both feet, with joints that static friction holds; no swing foot is ahead."""
    d = biped.description
    held = replace(
        biped, description=replace(d, static=dict.fromkeys(d.actuated, 1e4)), friction=True
    )
    ground = SoftGround(1.0, time_constant, impedance=impedance)
    plant = MuJoCoPlant(held, ground, h=0.1 * time_constant, ahead=9.0)
    loop = SteppingLoop(plant, ba.Passive(), None, ba.SampledTime(4e-3), held)
    q = ba.load_gait("published", biped).start(biped)[0]
    return loop, loop.run(loop.initial_state(q, np.zeros(5)), RunOptions(0.6))


@pytest.mark.parametrize(
    ("time_constant", "impedance", "index"),
    [(4e-3, (0.9, 0.9), 0), (8e-3, (0.9, 0.9), 1), (4e-3, (0.9, 0.92), 0), (1.2e-2, (0.5, 0.6), 1)],
)
def test_feet_at_rest_stand_as_deep_as_the_reported_stiffness_says(
    biped, time_constant, impedance, index
):
    """Weight over depth is the stiffness that the plant reports: index 0 at the surface, for hard ground, and 1
    below 1 mm, for soft ground, where the impedance has its second value. Both feet together carry the weight:
    soft ground still rocks a little, which loads one of them.
    """
    # standing: on both feet without motors, its joints held by static friction
    loop, run = standing(biped, time_constant, impedance)
    force, place_of, _ = feet_of(with_readings(loop, run).arcs[-1])
    plant, depth = loop.plant, -place_of[-1, :, 1]
    load = force[-1, :, 1].sum()
    assert load == pytest.approx(biped.weight, rel=5e-3)
    assert load / depth.sum() == pytest.approx(plant.stiffness[index], rel=5e-3)
    if impedance[0] == impedance[1]:  # d = 0.9: depth r = (1 - d) T^2 F / m
        expected = 0.1 * time_constant**2 * force[-1, :, 1] / plant.foot_mass
        np.testing.assert_allclose(depth, expected, rtol=5e-3)
    step = steps_of(loop, run)[-1]
    assert step.depth >= np.max(depth) * 0.99
    assert step.double_support > 0.9 * step.duration


def test_a_run_carries_its_readings_through_a_file(walk, tmp_path):
    """All readings of feet, torques and loads are equal after saving, with a row per node."""
    loop, run = walk
    told = with_readings(loop, run)
    back = load(save(told, tmp_path / "run.npz"))
    for arc, other in zip(told.arcs, back.arcs, strict=True):
        assert {"u", "zeta", "foot_force", "foot_place", "foot_speed"} <= set(other.read)
        for name, rows in arc.read.items():
            np.testing.assert_array_equal(other.read[name], rows)
        assert all(len(rows) == len(arc.t) for rows in arc.read.values())
