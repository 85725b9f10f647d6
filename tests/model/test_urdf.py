"""Robots are read strictly: what is not physical is refused with one message that names it.

FLOATING is RABBIT's own URDF, whose base floats; read(file) reads its tree of links and joints; reroot hangs a
tree from a foot.
"""

import shutil
from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import GaitError, InputError, ModelError, NotFiniteError
from biped_adrc.core.files import data_folder
from biped_adrc.gait.gait import gait_names
from biped_adrc.gait.published import passive_cycle
from biped_adrc.model.pinned import frame_index, reroot
from biped_adrc.model.robots import urdf
from biped_adrc.model.robots.robot_toml import robot_names
from biped_adrc.model.robots.urdf_reader import read

FLOATING = data_folder("urdf") / "rabbit" / "floating.urdf"
TORSO_MASS = '<mass value="12.0"/>'
HIP = '<joint name="left_hip" type="revolute">\n    <parent link="torso"/>'
FIRST_AXIS = '<axis xyz="0 -1 0"/>'
THIGH_INERTIA = 'ixx="0.47" ixy="0" ixz="0" iyy="0.47"'


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (TORSO_MASS, '<mass value="-12"/>', "mass -12 kg"),
        (TORSO_MASS, '<mass value="nan"/>', "nan"),
        (THIGH_INERTIA, 'ixx="0.47" ixy="0" ixz="0" iyy="4.7"', "triangle inequality"),
        (THIGH_INERTIA, 'ixx="-0.47" ixy="0" ixz="0" iyy="0.47"', "positive semidefinite"),
        (THIGH_INERTIA, THIGH_INERTIA.replace('ixy="0"', 'ixy="-0.48"'), "positive semidefinite"),
        (FIRST_AXIS, '<axis xyz="0 -2 0"/>', "length 2"),
        (
            FIRST_AXIS,
            FIRST_AXIS + '<limit lower="-1.57." upper="1.57"/>',
            "joint 'torso_pitch' <limit>: lower='-1.57.', expected 1 number",
        ),
        ('name="left_hip" type="revolute"', 'name="left_hip" type="screw"', "'screw'"),
        ('name="left_hip"', 'name="right_hip"', "two joints are named 'right_hip'"),
        (HIP, HIP.replace("torso", "pelvis"), "links ['pelvis'] that are not there"),
        (
            '<child link="left_thigh"/>',
            '<child link="right_thigh"/>',
            "two parent joints ['right_thigh']",
        ),
        ("</robot>", "", "ParseError"),
        (
            "</robot>",
            "<xacro:leg/></robot>",
            "it holds xacro macros, expected the URDF they expand",
        ),
    ],
)
def test_bad_urdf_is_refused(tmp_path, old, new, message):
    """old -> new in RABBIT's URDF, one mistake each; the message names the file and what is wrong."""
    text = FLOATING.read_text()
    assert old in text
    path = tmp_path / "bad.urdf"
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(ModelError) as caught:
        read(path)
    assert message in str(caught.value)
    assert "bad.urdf" in str(caught.value)


def test_stored_pinned_urdf_is_the_floating_one_rerooted():
    """pinned.urdf, which the package stores beside it, is the floating robot hung from its left foot: the same
    tree, link by link and joint by joint.
    """
    stored = read(FLOATING.with_name("pinned.urdf")).tree
    derived = reroot(read(FLOATING).tree, "left_foot", "torso")
    assert stored.links == derived.links
    assert stored.joints == derived.joints


def test_the_default_preset_is_what_the_urdf_says(biped):
    """Compared are mass, COM and moment about y (index 3 of ixx, ixy, ixz, iyy, iyz, izz) of each link."""
    for name, link in read(FLOATING).tree.links.items():
        if link.inertial is not None:
            one, other = link.inertial, biped.description.tree().links[name].inertial
            assert (one.mass, one.com, one.inertia[3]) == (other.mass, other.com, other.inertia[3])


def test_unknown_names_are_answered_with_the_known_ones(biped):
    """An unknown robot, preset or joint: the message has a known one; of a frame and a body it has the name."""
    for make, known in (
        (lambda: ba.Biped.load("atlas"), "rabbit"),
        (lambda: ba.Biped.load("rabbit", "heavy"), "tac2003"),
        (lambda: biped.description.joint_index("q9"), "torso_pitch"),
        (lambda: frame_index(biped.pinned.model, "hand"), "hand"),
        (lambda: ba.ModelErrors(mass={"arm": 1.0}).apply(biped), "arm"),
    ):
        with pytest.raises(ModelError, match=known):
            make()
    # which are these, in the order of their names
    assert robot_names() == ("compass", "rabbit", "rimless_wheel", "simplest", "three_link")


def test_wrong_states_links_and_joints_are_refused_in_words_of_the_robot(biped):
    """A state of 4 numbers for 5 coordinates, one with NaN, a foot that is no link of the leg, and joints of
    which one leg has more than the other.
    """
    with pytest.raises(InputError, match=r"shape \(5,\)"):
        biped.inertia(np.zeros(4))
    with pytest.raises(ModelError, match="foot 'torso' does not hang below 'left_thigh'"):
        reroot(biped.tree, "torso", "left_thigh")
    joints = ("left_hip", "right_hip", "left_knee", "torso_pitch")
    with pytest.raises(ModelError, match="are not built alike, so they cannot change over"):
        urdf.relabelling(biped.tree, joints, biped.description.feet)
    with pytest.raises(NotFiniteError, match="nan"):
        biped.reduction(np.zeros(5), np.full(5, np.nan))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("phase = [1.0, 0.0, 0.5, 0.0, 1.0]", "phase = [1.0]", "expected 5 finite numbers"),
        ("0.5, 0.0, 1.0]", "0.5, 0.0, 0.0]", r"phase is \[.*\]; the last number must not be 0"),
        ("mass = 12.0", "mass = -12.0", "torso.mass: found -12"),
        ('unactuated = "torso_pitch"\n', "", "'unactuated' is missing"),
        ('urdf = "floating.urdf"', 'urdf = "../floating.urdf"', "in its own folder or below"),
        ('urdf = "floating.urdf"', 'urdf = "/proc/version"', "in its own folder or below"),
        ('urdf = "floating.urdf"', 'urdf = "linked.urdf"', "in its own folder or below"),
        ('"left_knee", "right_knee"]', '"left_knee", "left_knee"]', "a list of different names"),
        ('"right_knee"]', '"right_knee", "left_hip"]', "the joints are .* different names"),
        ('["left_thigh", "right_thigh"]', '["left_thigh", "thigh"]', r"\['thigh'\] in its links"),
        ('torso = ["torso"]', "torso = []", "links.torso.*at least 1"),
        ('"left_shin", "right_shin"', '"left_shin", "left_thigh"', "the links are"),
        ('swing_foot = "right_foot"', 'swing_foot = "left_foot"', "the feet are"),
        ("mass = 12.0", "mass = true", "torso.mass.*True"),
        ("peak_torque = 150.0", "peak_torque = true", "peak_torque.*True"),
        ("friction_coefficient = 0.6", "friction_coefficient = true", "friction_coefficient.*True"),
        ('urdf = "floating.urdf"', "urdf = { a = 1 }", "urdf: .*not a valid path"),
        ("peak_torque =", "peek_torque =", "'peek_torque' in the record.*'peak_torque'"),
        (
            "inertia = 1.33",
            "inertia = 1.33, mas = 3.0",
            "'mas' in presets.identified.torso.*'mass'",
        ),
        ("viscous = {", "viscuous = {", "'viscuous' in friction.*'viscous'"),
        ("torso = { mass", "torzo = { mass", "'torzo' in presets.identified.*'torso'"),
    ],
)
def test_bad_robot_record_is_refused(tmp_path, old, new, message):
    """old -> new in RABBIT's robot.toml: wrong numbers and names, keys with a typing error (the message names
    the right one), and paths and links that lead out of the record's folder.
    """
    folder = data_folder("urdf") / "rabbit"
    text = (folder / "robot.toml").read_text()
    assert old in text
    (tmp_path / "floating.urdf").write_text(FLOATING.read_text())
    (tmp_path / "robot.toml").write_text(text.replace(old, new, 1))
    (tmp_path / "linked.urdf").symlink_to(FLOATING)
    with pytest.raises(ba.BipedError, match=message):
        ba.Biped.load(tmp_path / "robot.toml")


def test_a_robot_of_links_into_one_folder_loads(tmp_path):
    """URDF and robot.toml are links to files elsewhere, as made by installers that link instead of copying."""
    for name in ("floating.urdf", "robot.toml"):
        (tmp_path / name).symlink_to(data_folder("urdf") / "rabbit" / name)
    assert ba.Biped.load(tmp_path / "robot.toml").n == 5


def test_a_name_of_a_robot_is_no_way_out_of_the_package(tmp_path, biped):
    """A gait and a cycle lie in a folder by whose path the robot, or its preset, calls itself: names are no
    paths, and neither file is found.
    """
    shutil.copy(data_folder("gaits") / "rabbit" / "v0.5-identified.json", tmp_path)
    for name in (str(tmp_path), "../rabbit", ".."):
        named = replace(biped, description=replace(biped.description, name=name))
        assert gait_names(name, "identified") == ()
        with pytest.raises(GaitError, match="there is no gait"):
            ba.load_gait("v0.5", named)
    compass = ba.Biped.load("compass")
    shutil.copy(data_folder("gaits") / "compass" / "goswami1998.toml", tmp_path)
    elsewhere = replace(compass, preset=f"{tmp_path}/goswami1998")
    with pytest.raises(GaitError, match="no walking cycle"):
        passive_cycle(elsewhere)


def test_twins_that_differ_are_named(biped):
    """A knee in another place than its twin is refused; one that turns in the other sense is relabelled with
    its sign.
    """
    d, tree = biped.description, biped.tree

    def changed(**change):
        joints = tuple(replace(j, **change) if j.name == "right_knee" else j for j in tree.joints)
        return replace(biped, tree=replace(tree, joints=joints))

    assert urdf.unlike(tree, d.feet) == {}
    with pytest.raises(ModelError, match=r"legs differ.*'right_shin'"):
        changed(origin=(0.0, 0.0, 0.5)).check()
    other = changed(axis=(0.0, 1.0, 0.0))
    other.check()
    q, v = np.array([0.1, 0.4, -0.3, -0.6, 0.2]), np.array([1.0, -2.0, 0.5, 3.0, 0.7])
    sign = np.array([1.0, 1.0, 1.0, -1.0, 1.0])
    np.testing.assert_allclose(other.impact(q * sign, v * sign).q, biped.impact(q, v).q * sign)
    np.testing.assert_allclose(other.impact(q * sign, v * sign).v, biped.impact(q, v).v * sign)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "<robot name='a'>" + "<link>" * 200_000 + "</link>" * 200_000 + "</robot>",
            "<link> has name=''",
        ),
        (
            "<robot name='a'>" + "<link name='l'/>" * 1501 + "</robot>",
            "1501 links, expected .* at most 200",
        ),
        ("<?xml version='1.0' encoding='utf-7'?><robot name='a'/>", "multi-byte encodings"),
    ],
    ids=["nested", "links", "utf-7"],
)
def test_files_that_crashed_a_parser_are_refused(text, said, tmp_path):
    """Tags nested 200000 deep, more links than the 200 that are read, and an encoding that XML parsers lack."""
    path = tmp_path / "a.urdf"
    path.write_text(text)
    with pytest.raises(ModelError, match=rf"a\.urdf.*{said}"):
        read(path)
