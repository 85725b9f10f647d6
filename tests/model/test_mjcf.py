"""Robots from MJCF: MuJoCo's own mass matrix and bias, projected on the joints that are kept.

The fixture own is the file of a robot of six joints, with soles, whose text is OWN. derive(file) imports a
robot: its result has the biped, notes on what was read or left out, and the laws that it breaks.
"""

from pathlib import Path

import gymnasium
import mujoco
import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import ModelError
from biped_adrc.model.robot_import.import_robot import Hints, derive

WALKER2D = Path(gymnasium.__file__).parent / "envs" / "mujoco" / "assets" / "walker2d_v5.xml"
LEG = """<body name="{s}_thigh" pos="0 {y} -0.1"><joint name="{s}_hip" range="-60 90"/>
<geom type="capsule" fromto="0 0 0 0.03 0 -0.4" size=".05"/>
<body name="{s}_shin" pos="0 0 -0.6"><joint name="{s}_knee" pos="0 0 0.2" range="-120 0" frictionloss="0.3"/>
<geom type="box" pos="0 0 -.02" size=".04 .05 .2"/>
<body name="{s}_sole" pos="0.05 0 -0.2" euler="0 20 0"><joint name="{s}_ankle" pos="-0.05 0 0"/>
<geom type="capsule" fromto="-.05 0 0 .1 0 0" size=".03"/></body></body></body>"""
OWN = f"""<mujoco model="own"><default><joint axis="0 -1 0" damping="0.2" armature="0.03" limited="true"
range="-45 45"/><motor ctrllimited="true" ctrlrange="-1 0.5"/></default><worldbody>
<geom type="plane" size="9 9 1"/>
<body name="trunk" pos="0 0 1.1"><joint name="up" type="slide" axis="0 0 1" limited="false" armature="0"/>
<joint name="ahead" type="slide" axis="1 0 0" limited="false" armature="0"/>
<joint name="pitch" axis="0 1 0" limited="false" armature="0"/>
<geom type="ellipsoid" size=".1 .1 .3" pos=".02 0 .2" euler="0 10 0"/>
{LEG.format(s="right", y=-0.1)}{LEG.format(s="left", y=0.1)}</body></worldbody><actuator>
<motor joint="right_hip" gear="80"/><motor joint="left_hip" gear="80"/><motor joint="right_knee" gear="60"/>
<motor joint="left_knee" gear="60"/><motor joint="right_ankle" gear="9"/></actuator></mujoco>"""


@pytest.fixture
def own(tmp_path):
    path = tmp_path / "own.xml"
    path.write_text(OWN)
    return path


def projected(path, biped, q, v):
    """D_s and Omega of MuJoCo with the axis of the stance ankle at rest: J' M J, J' (bias + M J' v)."""
    m = mujoco.MjModel.from_xml_path(str(path))
    d, joints = mujoco.MjData(m), biped.description.joints
    base = [m.joint(name).id for name in biped.description.base]
    foot = m.body(biped.description.stance_foot).id
    angles = [m.jnt_dofadr[m.joint(name).id] for name in joints]
    d.qpos[[m.jnt_qposadr[m.joint(name).id] for name in joints]] = q
    moved = m.qpos0 != 0.0
    d.qpos[moved] = m.qpos0[moved]  # the height of Walker2d, which does not matter
    mujoco.mj_forward(m, d)
    place, J_foot, rate = d.xanchor[m.body_jntadr[foot]], np.zeros((3, m.nv)), np.zeros((3, m.nv))
    mujoco.mj_jac(m, d, J_foot, None, place, foot)
    slides, rows = [m.jnt_dofadr[j] for j in base], [0, 2]
    J = np.zeros((m.nv, len(joints)))
    J[angles, range(len(joints))] = 1.0
    J[slides] = -np.linalg.solve(J_foot[np.ix_(rows, slides)], J_foot[np.ix_(rows, angles)])
    d.qvel[:] = J @ v
    mujoco.mj_forward(m, d)
    mujoco.mj_jacDot(m, d, rate, None, place, foot)
    drift = np.zeros(m.nv)
    drift[slides] = -np.linalg.solve(J_foot[np.ix_(rows, slides)], (rate @ d.qvel)[rows])
    M = np.zeros((m.nv, m.nv))
    mujoco.mj_fullM(m, d, M)
    return J.T @ M @ J, J.T @ (d.qfrc_bias + M @ drift)


def test_inertia_and_bias_are_those_of_mujoco(own):
    """D_s and Omega of the derived robot are compared with `projected`: MuJoCo's own mass matrix and bias with
    the stance ankle held at rest. The robots are Gymnasium's Walker2d and one of this file with other axes,
    gears, soles.
    """
    for path in (WALKER2D, own):
        derived = derive(path)
        biped, random = derived.biped, np.random.default_rng(3)
        assert derived.broken == ()
        assert (biped.n, biped.p) == (5, 4)
        for _ in range(10):
            q, v = random.uniform(-np.pi, np.pi, 5), random.normal(0.0, 3.0, 5)
            D, Omega = projected(path, biped, q, v)
            np.testing.assert_allclose(biped.inertia(q), D, rtol=0, atol=1e-9 * np.max(D))
            size = np.max(np.abs(Omega))
            np.testing.assert_allclose(biped.bias(q, v), Omega, rtol=0, atol=1e-9 * size)


def test_limits_friction_and_rotors_are_read_and_the_rest_is_said(own, tmp_path):
    """They are read as the file `OWN` states them: the weakest motor gives the torque limit. What a robot on
    points cannot have, ankles and their motor, and shapes, is remarked as left out; the written record is the
    same robot.
    """
    derived = derive(own)
    d = derived.biped.description
    # 60 N m times -1 to 0.5, the weakest
    assert (d.peak_torque, derived.biped.armature) == (30.0, 0.03)
    assert d.ranges["left_knee"] == pytest.approx((-2.0 * np.pi / 3.0, 0.0))
    assert d.viscous["right_hip"] == 0.2
    assert (d.static["right_knee"], d.static.get("right_hip", 0.0)) == (0.3, 0.0)
    left = "\n".join(note.text for note in derived.notes if note.kind == "left out")
    # shapes: the plane, the trunk's, and three of each leg
    for word in ("'right_ankle'", "'left_ankle'", "8 shapes"):
        assert word in left
    again = ba.Biped.load(derived.write(tmp_path / "robot"))
    q = np.array([0.3, -0.2, -0.5, -0.4, 0.1])
    np.testing.assert_array_equal(again.inertia(q), derived.biped.inertia(q))


@pytest.mark.parametrize(
    ("old", "new", "torque"),
    [
        ('knee" gear="60"', 'knee" gear="60" forcelimited="true" forcerange="-0.4 0.3"', 18.0),
        ('knee" gear="60"', 'knee" gear="-60" ctrlrange="-0.4 0.5"', 24.0),
        # replaced only to put the joint's own limit, -9 to 8 N m, into both knees
        ('frictionloss="0.3"', 'actuatorfrclimited="true" actuatorfrcrange="-9 8"', 8.0),
        # 30: the left knee, 60 x 0.5; the right one has 50 by both motors, and 20 by the new one alone
        (
            '<motor joint="right_ankle"',
            '<motor joint="right_knee" gear="40"/><motor joint="right_ankle"',
            30.0,
        ),
        ('knee" gear="60"', 'knee" gear="60" ctrllimited="false"', None),
    ],
)
def test_the_torque_limit_is_the_least_that_an_actuator_reaches(own, old, new, torque):
    """old -> new in the file, and the torque [N m] of the weakest joint: gear times the nearer end of force or
    control, of all motors of a joint together, at most the joint's own. None: a motor without any limit is
    refused.
    """
    assert old in OWN
    own.write_text(OWN.replace(old, new))
    if torque is None:
        with pytest.raises(ModelError, match="have no torque limit"):
            derive(own)
    else:
        assert derive(own).biped.description.peak_torque == pytest.approx(torque, rel=1e-12)


def test_the_robot_stands_on_the_point_of_its_sole_that_a_hint_names(own):
    """`Hints.tip` is a point of the sole's own frame, 0.1 m ahead of its origin; foot and hip, relative to the
    stance foot, are where MuJoCo has them at the zero of six joints and the pitch.
    """
    joints = [f"{side}_{joint}" for joint in ("hip", "knee", "ankle") for side in ("right", "left")]
    # torque: the left ankle has no motor in the file, hence no limit
    hints = Hints(("right_sole", "left_sole"), tuple(joints), torque=5.0, tip=(0.1, 0.0, 0.0))
    biped = derive(own, hints).biped
    m = mujoco.MjModel.from_xml_path(str(own))
    d = mujoco.MjData(m)
    mujoco.mj_forward(m, d)
    right, left = (
        d.xanchor[m.joint(f"{s}_ankle").id] + d.body(f"{s}_sole").xmat.reshape(3, 3) @ [0.1, 0, 0]
        for s in ("right", "left")
    )
    np.testing.assert_allclose(
        biped.swing_foot(np.zeros(7)), (left - right)[[0, 2]], rtol=0.0, atol=1e-12
    )
    torso = d.body("trunk").xpos  # 0.1 m above the hip, so that it cannot be taken for it
    hip = d.xanchor[m.joint("right_hip").id]
    assert torso[2] > hip[2]
    np.testing.assert_allclose(biped.hip(np.zeros(7)), (hip - right)[[0, 2]], rtol=0.0, atol=1e-12)


def test_a_shape_that_is_called_a_foot_is_its_point(tmp_path):
    """A shin that ends with a ball, as walkers of courses have it, on a free joint."""
    leg = (
        '<body name="{s}" pos="0 {y} 0"><joint name="{s}_hip"/><geom type="capsule" size=".02" '
        'fromto="0 0 0 0 0 -.6"/><geom name="{s}_foot" type="sphere" size=".02" pos=".1 0 -.6"/></body>'
    )
    path = tmp_path / "balls.xml"
    path.write_text(
        '<mujoco><default><joint axis="0 1 0"/></default><worldbody><body name="trunk"><freejoint/>'
        f'<geom type="sphere" size=".1" pos="0 0 .2"/>{leg.format(s="r", y=-0.1)}{leg.format(s="l", y=0.1)}'
        '</body></worldbody><actuator><motor joint="r_hip" ctrllimited="true" ctrlrange="-7 7"/>'
        '<motor joint="l_hip" ctrllimited="true" ctrlrange="-7 7"/></actuator></mujoco>'
    )
    biped = derive(path).biped
    assert biped.description.feet == ("r_foot", "l_foot")
    q = np.array([0.2, -0.3, 0.1])
    # x - i z of either foot from the hip
    foot = [0.1 + 0.6j, 0.1 + 0.6j] * np.exp(1j * (q[:2] + q[2]))
    np.testing.assert_allclose(
        biped.swing_foot(q) @ [1, -1j], foot[1] - foot[0], rtol=0.0, atol=1e-12
    )


def test_a_leg_without_an_end_is_asked_for_by_the_format_of_its_file(tmp_path):
    """Two thin legs of 0.8 m below a trunk: with the places of their ends they are a compass."""
    leg = (
        '<body name="{0}"><joint name="{0}h" axis="0 1 0"/>'
        '<geom type="capsule" size=".03" fromto="0 0 0 0 0 -.8"/></body>'
    )
    slides = '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>'
    path = tmp_path / "legs.xml"
    path.write_text(
        f'<mujoco><worldbody><body name="trunk">{slides}<joint axis="0 1 0"/>'
        f'<geom size=".1" pos="0 0 .3"/>{leg.format("l")}{leg.format("r")}</body></worldbody></mujoco>'
    )
    with pytest.raises(ModelError, match=r"legs\.xml \(MJCF\)'.*--set tip=x,y,z"):
        derive(path)
    derived = derive(path, Hints(("l", "r"), tip=(0.0, 0.0, -0.8)))
    q = np.array([0.3, -0.2, 0.1])
    place = 0.8 * (np.exp(0.4j) - np.exp(-0.1j))  # z + i x of the feet below the hip
    np.testing.assert_allclose(
        derived.biped.swing_foot(q), [place.imag, place.real], rtol=0.0, atol=1e-12
    )
    assert derived.record["urdf"] == "legs.xml"  # the record's key for a file of any format


@pytest.mark.parametrize(
    ("old", "new", "word"),
    [
        ('range="-120 0"', 'range="-120 0.1."', "'range' Element 'joint'"),
        ("</actuator>", "</actuator><equality><joint joint1='left_hip'/></equality>", "equality"),
        ('"left_knee" pos', '"left_knee" axis="1 0 0" pos', "left_knee"),
        # limited="false": MuJoCo itself refuses a ball joint with the range that is OWN's default
        (
            '<joint name="left_ankle"',
            '<joint type="ball" limited="false" name="left_ankle"',
            "left_ankle",
        ),
        ('joint="left_hip"', 'joint="nobody"', "nobody"),
    ],
)
def test_what_is_no_planar_biped_is_refused_in_one_sentence(own, old, new, word):
    """old -> new in the file: a number that is none, an equality constraint, an axis out of the plane, a ball
    joint, and a motor on a joint that is not there; word: what the message names.
    """
    assert old in OWN
    own.write_text(OWN.replace(old, new))
    with pytest.raises(ModelError, match=word) as caught:
        derive(own)
    assert "\n" not in str(caught.value)
