"""A biped in MuJoCo: its equations are Pinocchio's without contact, and Newton's laws hold with it.

placed(plant, q, v, own, ...) puts MuJoCo in a state: own is the time of the last touchdown, place and velocity
of the floating base. loop_on makes a loop around the plant, run_of simulates it; the fixture walk is such a run
of three steps under NPD.
"""

from __future__ import annotations

import sys

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.protocols import Load
from biped_adrc.core.errors import InputError
from biped_adrc.extras.mujoco import robot as mujoco_robot
from biped_adrc.extras.mujoco.plant import TOUCHING, MuJoCoPlant
from biped_adrc.extras.mujoco.robot import model_of, mujoco, pinned_mjcf
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.model.ground import SoftGround, ground_axes

from .loops import loop_on, run_of

ROBOTS = [("rabbit", "identified"), ("rabbit", "tac2003"), ("three_link", None)]
"""Robots with motors, and their presets."""


@pytest.fixture(params=ROBOTS, ids=lambda robot: "-".join(filter(None, robot)))
def robot(request):
    name, preset = request.param
    return ba.Biped.load(name, preset) if preset else ba.Biped.load(name)


@pytest.fixture(scope="module")
def plant(biped):
    return MuJoCoPlant(biped)


def in_joints_of(model, biped):
    """T with qpos = T q for the pinned model."""
    ours = list(biped.pinned.model.names)[1:]
    return biped.pinned.T[[ours.index(model.joint(j).name) for j in range(model.njnt)]]


def test_the_plant_on_a_pinned_foot_accelerates_as_pinocchio_computes(robot):
    """The robot is pinned at its foot, at random states under random forces: MuJoCo's accelerations, mapped by
    T to our joints, are those of Pinocchio, to round-off.
    """
    # 1e-3: an integration step, which is not used
    mj, model, random = mujoco(), model_of(pinned_mjcf(robot, 1e-3)), np.random.default_rng(3)
    data, T = mj.MjData(model), in_joints_of(model, robot)
    for _ in range(20):
        q, v = random.uniform(-np.pi, np.pi, robot.n), random.normal(size=robot.n)
        force = random.normal(scale=50.0, size=robot.n)
        data.qpos[:], data.qvel[:] = T @ q, T @ v
        data.qfrc_applied[:] = np.linalg.solve(T.T, force)
        mj.mj_forward(model, data)
        expected = robot.acceleration(q, v, force)
        gap = np.linalg.solve(T, data.qacc) - expected
        assert np.max(np.abs(gap)) < 1e-12 * np.max(np.abs(expected))


def placed(plant, q, v, own, u=0.0, load=None):
    """MuJoCo in that state, under u (p,) [N m] and a load."""
    plant.engine.place(np.concatenate((q, v, own)))
    plant.engine.push(u, q, load)


def test_motors_and_pushes_give_the_power_that_they_give_on_the_rigid_plant(plant, gait):
    """The power of all of MuJoCo's forces at its rates is u' q_b' + zeta' q', although the base floats; and the
    state that was placed is read back.
    """
    q, v = gait.start(plant.biped)
    f, random = plant.biped.floating, np.random.default_rng(5)
    speed = (f.velocity_map(q)[:, :5] @ v)[f.base]  # of the base, with the stance foot at rest
    own = np.array([0.0, *f.configuration(q)[f.base], *speed])
    u = random.normal(size=4)
    load = Load(random.normal(size=5), random.normal(size=2))
    placed(plant, q, v, own, u, load)
    data = plant.engine.data
    mujoco().mj_forward(plant.engine.model, data)
    power = (data.qfrc_actuator + data.qfrc_applied) @ data.qvel
    assert power == pytest.approx(u @ v[:4] + load.zeta @ v, rel=1e-12)
    read = plant.engine.read(np.zeros(15))  # a row of zeros that is filled
    np.testing.assert_allclose(read, np.concatenate((q, v, own)), rtol=0.0, atol=1e-14)


def test_a_force_on_a_link_moves_the_centre_of_mass_as_newton_says(plant, gait):
    """Off the ground, F = m a of the centre for a force that the pinned coordinates feel as J' F."""
    biped = plant.biped
    q, _ = gait.start(biped)
    own = np.array([0.0, 0.0, 9.0, 0.0, 0.0])
    force = np.array([30.0, -20.0])
    hip = biped.floating.velocity_map(q)[biped.floating.base, :5]
    placed(plant, q, np.zeros(5), own, load=Load(hip.T @ force, force))
    mujoco().mj_forward(plant.engine.model, plant.engine.data)
    mujoco().mj_rnePostConstraint(plant.engine.model, plant.engine.data)
    masses = plant.model.body_mass
    jacobian, total = np.zeros((3, plant.model.nv)), np.zeros(3)
    for body in np.flatnonzero(masses):
        mujoco().mj_jacBodyCom(plant.engine.model, plant.engine.data, jacobian, None, body)
        total += masses[body] * (jacobian @ plant.engine.data.qacc)
    np.testing.assert_allclose(total[[0, 2]], force - [0.0, biped.weight], rtol=1e-10)


def test_feet_and_hip_are_where_pinocchio_has_them(robot):
    """The places agree with the stance foot at (3, 2) m, at random angles."""
    plant, random = MuJoCoPlant(robot), np.random.default_rng(6)
    f, at = robot.floating, np.array([3.0, 2.0])
    for _ in range(5):
        q = random.uniform(-np.pi, np.pi, robot.n)
        base = f.configuration(q)[f.base] + at
        placed(plant, q, np.zeros(robot.n), np.array([0.0, *base, 0.0, 0.0]))
        expected = at + np.array((np.zeros(2), robot.swing_foot(q), robot.hip(q)))
        found = np.array(plant.engine.points())[:, [0, 2]]
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-12)


@pytest.fixture(scope="module")
def walk(plant, gait):
    return run_of(loop_on(plant, ba.NPDController(gait.constraint)), gait, impacts=3)


def test_feedback_linearisation_walks(walk):
    """The periods are near that on rigid ground, 0.416 s: contact takes a time constant or two."""
    assert walk.status is ba.Status.COMPLETED
    assert [arc.mode.step for arc in walk.arcs] == [1, 2, 3]
    times = [event.t for event in walk.events("foot_strike")]
    assert np.diff(times) == pytest.approx(0.416, abs=0.012)


def test_the_same_walk_bit_for_bit(plant, gait, walk):
    """The walk is the same in the same engine again, whatever that did before, and in a new one: the work space
    of an engine is no state.
    """
    law = ba.NPDController(gait.constraint)
    again = run_of(loop_on(plant, law), gait, impacts=1)
    np.testing.assert_array_equal(again.arcs[0].x, walk.arcs[0].x)
    other = run_of(loop_on(MuJoCoPlant(plant.biped), law), gait, impacts=1)
    np.testing.assert_array_equal(other.arcs[0].x, walk.arcs[0].x)


@pytest.mark.parametrize("slope", [0.0, 0.1])
def test_a_foot_touches_where_a_point_would_and_slides_with_its_friction(biped, gait, slope):
    """A foot of 5 mm radius begins 1e-6 m (TOUCHING) deep in the ground, on a slope too; moved along it, its
    force is -0.4 times the normal force, 0.4 the friction.
    """
    plant = MuJoCoPlant(biped, SoftGround(friction=0.4, foot_radius=5e-3), slope)
    q = gait.start(biped)[0] - [0.0, 0.0, 0.0, 0.6, 0.0]  # the swing foot in the air
    along, out = ground_axes(slope)
    row = plant.start(0.0, q, np.zeros(5))
    row[13:15] = 0.5 * along  # velocity of the base [m/s]
    plant.engine.place(row)
    mujoco().mj_forward(plant.engine.model, plant.engine.data)
    assert plant.engine.data.contact[0].dist == pytest.approx(-TOUCHING, abs=1e-12)
    F = plant.forces()[0]
    assert F @ along / (F @ out) == pytest.approx(-0.4, rel=0.01)


def test_a_push_shorter_than_a_period_gives_the_momentum_that_it_has(biped, gait):
    """In free flight a torque A on the torso for T = 0.2 ms within a period of 1 ms changes the spin by A T."""
    # a run usually ends where the stance foot is 2 cm up; here it may be at 99 m
    plant, (q, v) = MuJoCoPlant(biped, flight_height=99.0), gait.start(biped)
    push = ba.TorquePulse([0.0, 0.0, 0.0, 0.0, 500.0], start=1.4e-3, stop=1.6e-3)
    system = loop_on(plant, ba.Passive(), disturbance=push)
    lifted = plant.start(0.0, q, v)
    lifted[12] += 9.0  # height of the base [m]
    run = system.run(system.with_plant(system.initial_state(q, v), lifted), RunOptions(3e-3))
    assert run.status is ba.Status.COMPLETED

    def spin(t):
        x = run(t)
        placed(plant, x[:5], x[5:10], x[10:15])
        mujoco().mj_forward(plant.engine.model, plant.engine.data)
        mujoco().mj_subtreeVel(plant.engine.model, plant.engine.data)
        return -plant.engine.data.subtree_angmom[0, 1]  # about -y, counter-clockwise in (x, z)

    assert spin(3e-3) - spin(1e-3) == pytest.approx(500.0 * 0.2e-3, rel=1e-3)
    assert np.any(run.arcs[0].read["zeta"] == 500.0)


def test_a_robot_in_the_air_is_told_from_one_that_fell(plant, gait):
    """A force of 900 N upwards at the hip, nearly three times the weight, lifts it off; without motors and
    force it falls.
    """
    system = loop_on(plant, ba.Passive(), disturbance=ba.HipForce(plant.biped, (0.0, 900.0)))
    run = run_of(system, gait, 1.0)
    assert run.status is ba.Status.INFEASIBLE
    assert run.arcs[-1].event.guard == "stance_foot_in_the_air"
    assert run_of(loop_on(plant, ba.Passive()), gait, 2.0).status is ba.Status.FELL


def test_a_foot_inside_the_ground_is_no_start(biped, gait):
    """A gait for level ground is put on a slope: its swing foot would begin inside the ground."""
    downhill = loop_on(MuJoCoPlant(biped, slope=0.02), ba.NPDController(gait.constraint))
    with pytest.raises(InputError, match="inside the ground"):
        downhill.initial_state(*gait.start(biped))


def test_wrong_values_and_a_missing_mujoco_are_refused(biped, monkeypatch):
    """Values out of range, a robot without motors (compass), a method and a step that do not exist. None in
    sys.modules makes the import fail, as where MuJoCo is not installed: the message says how to install it.
    """
    for make in (
        lambda: SoftGround(friction=-1.0),
        lambda: SoftGround(impedance=(0.9, 1.0)),
        lambda: MuJoCoPlant(biped, slope=float("nan")),
        lambda: MuJoCoPlant(ba.Biped.load("compass")),
        lambda: MuJoCoPlant(biped, integrator="euler"),
        lambda: MuJoCoPlant(biped, ground_steps=(1.0,)),
    ):
        with pytest.raises(InputError):
            make()
    with pytest.warns(UserWarning, match="time constant"):  # a step too long for the contact
        MuJoCoPlant(biped, h=1e-3)
    mujoco_robot.mujoco.cache_clear()  # which keeps the module once it was imported
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(InputError, match=r"biped-adrc\[mujoco\]"):
        MuJoCoPlant(biped)
    mujoco_robot.mujoco.cache_clear()
