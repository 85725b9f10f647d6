"""Angle conventions against positions and energies computed from each convention's own definition.

`convention(name).to_paper` maps angles and rates of a convention (q_own, v_own) to the paper's.
random_states(n, count) yields random angles and rates.
"""

from typing import NamedTuple

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import InputError
from biped_adrc.gait.conventions import CONVENTIONS, convention

RNG = np.random.default_rng(7)
L = 0.4  # [m], thigh and shin of RABBIT


class Pose(NamedTuple):
    """Points (x, z) from the stance foot, and the directions of the links away from the hip."""

    stance_knee: np.ndarray
    hip: np.ndarray
    swing_knee: np.ndarray
    swing_foot: np.ndarray
    torso: np.ndarray


def vector(x, z):
    return np.array([x, z])


def paper(q, length=L):
    """Links along (-sin a, cos a) from the hip outwards; hips from the torso, knees from the thigh."""
    q1, q2, q3, q4, q5 = q

    def along(a):
        return length * vector(-np.sin(a), np.cos(a))

    stance_knee = -along(q5 + q1 + q3)
    hip = stance_knee - along(q5 + q1)
    swing_knee = hip + along(q5 + q2)
    torso = vector(-np.sin(q5), np.cos(q5))
    return Pose(stance_knee, hip, swing_knee, swing_knee + along(q5 + q2 + q4), torso)


def tac2003(q, length=L):
    """femur = q31 + q1, tibia = femur + q41, from the vertical in the trigonometric sense."""
    q31, q32, q41, q42, q1 = q
    femur1, femur2 = q31 + q1, q32 + q1
    tibia1, tibia2 = femur1 + q41, femur2 + q42
    hip = length * vector(np.sin(femur1), -np.cos(femur1))
    hip = hip + length * vector(np.sin(tibia1), -np.cos(tibia1))
    knee1 = hip + length * vector(-np.sin(femur1), np.cos(femur1))
    knee2 = hip + length * vector(-np.sin(femur2), np.cos(femur2))
    foot2 = knee2 + length * vector(-np.sin(tibia2), np.cos(tibia2))
    return Pose(knee1, hip, knee2, foot2, vector(-np.sin(q1), np.cos(q1)))


def frost(q, length=L):
    """Right-handed rotations about +y, links along +z of their frames; the right leg stands."""
    base, hip_right, knee_right, hip_left, knee_left = q

    def z_axis(phi):  # third column of R_y(phi), without y
        return vector(np.sin(phi), np.cos(phi))

    right = length * z_axis(base + hip_right)
    right_toe = right + length * z_axis(base + hip_right + knee_right)
    left = length * z_axis(base + hip_left)
    left_toe = left + length * z_axis(base + hip_left + knee_left)
    return Pose(right - right_toe, -right_toe, left - right_toe, left_toe - right_toe, z_axis(base))


def optimtraj(q, length=L):
    """e = cos(q) j - sin(q) i upwards along stance leg and torso, downwards along the swing leg."""
    i, j = vector(1.0, 0.0), vector(0.0, 1.0)
    e = [np.cos(angle) * j - np.sin(angle) * i for angle in q]
    P1 = length * e[0]
    P2 = P1 + length * e[1]
    P4 = P2 - length * e[3]
    return Pose(P1, P2, P4, P4 - length * e[4], e[2])


POSES = {"paper": paper, "tac2003": tac2003, "frost": frost, "optimtraj": optimtraj}


def with_straight_knees(name, q):
    """The five-link coordinates of a walker without knees, from each definition."""
    if name == "frost":  # base, right hip, left hip
        return np.array([q[0], q[1], 0.0, q[2], 0.0])
    if name == "optimtraj":  # stance leg, torso, swing leg
        return np.array([q[0], q[0], q[1], q[2], q[2]])
    return np.array([q[0], q[1], 0.0, 0.0, q[2]])


def random_states(n, count=20):
    return RNG.uniform(-np.pi, np.pi, (count, n)), RNG.normal(size=(count, n))


@pytest.mark.parametrize("name", CONVENTIONS)
def test_knees_hip_and_foot_are_where_the_definition_says(name, biped):
    """Angles of a convention, mapped to the paper's, put knees, hip and foot where the convention's own
    definition puts them. POSES has that definition, written by hand in this file; a wrong sign or order moves a
    point.
    """
    model, position = biped.pinned.model, biped.pinned.position
    knees = [model.getFrameId(frame) for frame in ("left_knee", "right_knee")]
    assert max(knees) < model.nframes  # an unknown name would get the index nframes
    for q_own, _ in zip(*random_states(5), strict=True):
        pose, q = POSES[name](q_own), convention(name).to_paper.angles(q_own)
        found = position(q, knees[0]), biped.hip(q), position(q, knees[1]), biped.swing_foot(q)
        np.testing.assert_allclose(found, pose[:4], rtol=0.0, atol=1e-13)


@pytest.mark.parametrize("name", CONVENTIONS)
def test_conventions_place_the_feet_of_a_robot_without_knees(name):
    """Hip and foot are where the convention's definition (POSES) puts them, for legs of 1 m without a knee: its
    thigh and shin are 0.5 m each, and its knee is straight. The row of the paper's phase is the robot's own.
    """
    biped = ba.Biped.load("three_link")
    c = convention(name, knees=False)
    for q_own, _ in zip(*random_states(3), strict=True):
        pose, q = POSES[name](with_straight_knees(name, q_own), 0.5), c.to_paper.angles(q_own)
        assert biped.hip(q) == pytest.approx(pose.hip, abs=1e-13)
        assert biped.swing_foot(q) == pytest.approx(pose.swing_foot, abs=1e-13)
    assert c.paper_phase == pytest.approx(biped.phase)


def energies(p, bodies):
    """Kinetic and potential energy [J] of five links, whose pose is q + 1e-30 i v."""
    kinetic = potential = 0.0
    for name, joint, direction in (
        ("torso", p.hip, p.torso),
        ("thigh", p.hip, (p.stance_knee - p.hip) / L),
        ("thigh", p.hip, (p.swing_knee - p.hip) / L),
        ("shin", p.stance_knee, -p.stance_knee / L),
        ("shin", p.swing_knee, (p.swing_foot - p.swing_knee) / L),
    ):
        body, com = bodies[name], joint + bodies[name].com * direction
        velocity, turning = 1e30 * com.imag, 1e30 * direction.imag
        kinetic += 0.5 * (body.mass * velocity @ velocity + body.inertia * turning @ turning)
        potential += 9.81 * body.mass * com.real[1]
    return kinetic, potential


@pytest.mark.parametrize("name", CONVENTIONS)
def test_energies_are_those_of_the_definition(name, bare):
    """Kinetic and potential energy of the mapped state are those of the links as the definition places them.
    Unlike hip, knees and feet, they depend on where the torso points too. Velocities of the definition are
    exact derivatives by a complex step: at q + 1e-30 i v the imaginary part of a place is 1e-30 times its
    velocity.
    """
    to_paper, bodies = convention(name).to_paper, bare.description.preset("identified-bare").bodies
    for q_own, v_own in zip(*random_states(5, 5), strict=True):
        kinetic, potential = energies(POSES[name](q_own + 1e-30j * v_own), bodies)
        q, v = to_paper.angles(q_own), to_paper.rates(v_own)
        assert bare.kinetic_energy(q, v) == pytest.approx(kinetic, rel=1e-12)
        assert bare.potential_energy(q) == pytest.approx(potential, abs=1e-11)


@pytest.mark.parametrize("name", CONVENTIONS)
def test_the_phase_of_a_convention_is_the_paper_s_up_to_sign_and_constant(name, biped):
    """c q of a convention is the paper's Theta less a constant, with the sign `sense`: -1 where the phase grows
    in a walk to +x.
    """
    c = convention(name)
    assert c.paper_phase == pytest.approx(biped.phase)
    constant = c.paper_phase @ c.to_paper.b
    for q_own, _ in zip(*random_states(5, 5), strict=True):
        q = c.to_paper.angles(q_own)
        assert c.phase @ q_own == pytest.approx(c.sense * (biped.phase @ q - constant), abs=1e-13)


def test_what_the_sources_print():
    """Rows c and the order of coordinates are those of the sources, where these state them."""
    assert convention("tac2003").phase.tolist() == [-1.0, 0.0, -0.5, 0.0, -1.0]
    assert convention("tac2003").coordinates == ("q31", "q32", "q41", "q42", "q1")
    assert convention("frost").phase.tolist() == [1.0, 1.0, 0.5, 0.0, 0.0]
    assert convention("optimtraj").phase.tolist() == [0.5, 0.5, 0.0, 0.0, 0.0]
    # both robots stand upright: the legs, which point down, are at pi in the paper's angles
    upright = convention("optimtraj").to_paper.angles(np.zeros(5))
    assert upright == pytest.approx([np.pi, np.pi, 0, 0, 0], abs=1e-15)
    standing = convention("frost").to_paper.angles(np.array([0, np.pi, 0, np.pi, 0]))
    assert standing == pytest.approx([np.pi, np.pi, 0, 0, 0], abs=1e-15)


def test_maps_go_back_and_bad_ones_are_refused():
    """The inverse map gives each angle back, to round-off; a name that is no convention is refused."""
    for name in CONVENTIONS:
        there = convention(name).to_paper
        for q, _ in zip(*random_states(5, 3), strict=True):
            assert there.inverse.angles(there.angles(q)) == pytest.approx(q, abs=1e-14)
    with pytest.raises(InputError):
        convention("kelly")
