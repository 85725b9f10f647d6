"""A robot from one URDF: the same physics in all frames and senses, guesses said, refusals that help.

rabbit(...) and two_legs(...) are texts of URDFs, of RABBIT as FROST writes it and of a body on two legs without
knees; the fixture urdf writes such a text to a file. derive(file, hints) imports a robot: its result has the
biped, notes, and the laws that it breaks; biped_from_urdf gives the biped alone. states(n, count) yields random
angles and rates; close compares to 1e-10.
"""

import math
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.cli import app
from biped_adrc.core.errors import ModelError, OutputError, SingularError
from biped_adrc.core.files import data_folder
from biped_adrc.gait.conventions import AngleMap
from biped_adrc.model.biped import check_numbers
from biped_adrc.model.physical import physical_checks
from biped_adrc.model.robot_import.import_robot import Hints, biped_from_urdf, derive
from validation.frost_urdf import HUNG, LIMIT, TURNED, bodies, body, joint
from validation.frost_urdf import rabbit_urdf as rabbit

BODIES = bodies()


@pytest.fixture
def urdf(tmp_path):
    def write(text, name="own.urdf"):
        path = tmp_path / name
        path.write_text(text)
        return path

    return write


def states(n, count=20, seed=4):
    random = np.random.default_rng(seed)
    for _ in range(count):
        yield random.uniform(-math.pi, math.pi, n), random.normal(0.0, 3.0, n)


def close(found, expected, scale=0.0):
    expected = np.asarray(expected)
    size = max(float(np.max(np.abs(expected))), scale)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-10 * size)


# -- the same physics in other frames --------------------------------------------------------------
COUNTER = AngleMap(-TURNED.A, TURNED.b * 0.0)
SIDEWAYS = f"0 0 {math.pi / 2!r}"


@pytest.mark.parametrize(
    ("text", "to_paper"),
    [
        (rabbit(), TURNED),
        (rabbit(rpy=f"0 {math.pi!r} 0"), HUNG),
        (rabbit(rpy=f"{math.pi!r} 0 {math.pi!r}"), HUNG),
        (rabbit(rpy=f"{math.pi!r} 0 0", leg_axis="0 -1 0"), HUNG),
        (rabbit(rpy=SIDEWAYS, leg_axis="1 0 0", lateral="x"), TURNED),
        (rabbit(base=False), TURNED),
        (rabbit(axis="0 -1 0", base=False), COUNTER),
        # the left hip is 0.1 m to the side, along y, which does not enter planar motion
        (
            rabbit().replace(
                '<child link="left_thigh"/><origin xyz="0 0',
                '<child link="left_thigh"/><origin xyz="0 0.1',
            ),
            TURNED,
        ),
    ],
    ids=["frost", "hanging", "hanging-2", "upside-down", "sideways", "no-base", "paper", "wide"],
)
def test_physics_is_that_of_rabbit(urdf, text, to_paper):
    """text: RABBIT's URDF with frames and senses of another author; to_paper: the map q = A r + b of its angles
    r to the paper's. D, Omega, energies, feet and impact are those of the registered robot at random states, to
    1e-10; angles after impact up to whole turns.
    """
    own, paper = biped_from_urdf(urdf(text)), ba.Biped.load("rabbit", "identified-bare")
    A = to_paper.A
    np.testing.assert_array_equal(own.phase, paper.phase @ A)
    for q, v in states(5):
        Q, V = to_paper.angles(q), to_paper.rates(v)
        close(own.inertia(q), A.T @ paper.inertia(Q) @ A)
        close(own.bias(q, v), A.T @ paper.bias(Q, V))
        close(own.kinetic_energy(q, v), paper.kinetic_energy(Q, V))
        close(own.potential_energy(q), paper.potential_energy(Q), scale=paper.weight)
        close(own.swing_foot(q), paper.swing_foot(Q))
        close(own.swing_foot_velocity(q, v), paper.swing_foot_velocity(Q, V))
        close(own.hip(q), paper.hip(Q))
        hit, expected = own.impact(q, v), paper.impact(Q, V)
        close(to_paper.rates(hit.v), expected.v)
        close(hit.impulse, expected.impulse)
        turns = (to_paper.angles(hit.q) - expected.q) / (2.0 * math.pi)
        close(turns, np.round(turns), scale=1.0)


@pytest.mark.parametrize("name", ["compass", "three_link", "simplest"])
def test_classic_walkers_are_found_again(name):
    """The import of the bare URDF finds joints, relabelling and phase of the hand-written record, and the same
    dynamics. `hints` are what a URDF does not say: motors, a torque limit and gravity.
    """
    record = ba.Biped.load(name)
    gravity = record.description.gravity
    actuated = record.description.actuated
    hints = Hints(actuated=actuated, torque=100.0, gravity=gravity)
    own = derive(data_folder("urdf") / name / "floating.urdf", hints).biped
    assert own.description.joints == record.description.joints
    np.testing.assert_array_equal(own.R, record.R)
    np.testing.assert_array_equal(own.phase, record.phase)
    for q, v in states(record.n, 5):
        close(own.inertia(q), record.inertia(q))
        close(own.bias(q, v), record.bias(q, v))
        close(own.hip(q), record.hip(q))
        close(own.impact(q, v).v, record.impact(q, v).v)


def test_phase_is_the_slope_of_the_virtual_leg(urdf):
    """The phase row of a robot with a thigh of 0.5 m and a shin of 0.3 m is the derivative of the angle of the
    line from hip to stance foot at a straight knee (q3 = 0): 0.375 = 0.3 / 0.8 for the knee.
    """
    own = biped_from_urdf(urdf(rabbit(thigh=0.5, shin=0.3)))
    assert own.phase == pytest.approx([-1.0, 0.0, -0.375, 0.0, -1.0], abs=1e-15)
    straight, h = np.array([3.3, 2.9, 0.0, 0.4, -0.1]), 1e-6

    def angle(q):
        x, z = -own.hip(q)
        return math.atan2(-x, z) % (2.0 * math.pi)

    slope = [(angle(straight + h * e) - angle(straight - h * e)) / (2 * h) for e in np.eye(5)]
    np.testing.assert_allclose(own.phase, slope, rtol=0.0, atol=1e-8)


def test_a_file_as_frost_writes_it(urdf):
    """No base, no limits, no feet, inertia about y alone, a zero axis on what is fixed."""
    text = rabbit(base=False).replace(LIMIT, "")
    text = re.sub(r'ixx="[^"]*" iyy="([^"]*)" izz="[^"]*"', r'ixx="0" iyy="\1" izz="0"', text)
    # a link that is called a toe would be taken for a foot
    text = text.replace("_toe", "_ankle").replace(
        'type="fixed">', 'type="fixed"><axis xyz="0 0 0"/>'
    )
    hints = Hints(feet=("right_shin", "left_shin"), tip=(0.0, 0.0, 0.4), torque=150.0)
    derived, full = derive(urdf(text), hints), biped_from_urdf(urdf(rabbit(), "full.urdf"))
    assert derived.broken == ()
    assert derived.biped.description.swing_foot == "left_shin_tip"
    for q, v in states(5, 5):
        close(derived.biped.inertia(q), full.inertia(q))
        close(derived.biped.bias(q, v), full.bias(q, v))
        close(derived.biped.swing_foot(q), full.swing_foot(q))


# -- files as others write them --------------------------------------------------------------------
HIP, COM, SHIN = 0.8, 0.3, 0.35  # [m]
SLIDES = """<joint name="x" type="prismatic"><parent link="world"/><child link="a"/><axis xyz="1 0 0"/></joint>
<link name="a"/><joint name="z" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
<link name="b"/><joint name="pitch" type="continuous"><parent link="b"/><child link="body"/><axis xyz="0 1 0"/>
</joint>"""
HEAVY = '<link name="world"><inertial><mass value="0"/><inertia iyy="3"/></inertial></link>'


def mass(name, kilograms, z, inertia='<inertia ixx="0.02" iyy="0.03" izz="0.01"/>', y=0.0):
    place = f'<origin xyz="0 {y} {z}"/>'
    return f'<link name="{name}"><inertial>{place}<mass value="{kilograms}"/>{inertia}</inertial></link>'


def two_legs(before="", inertia='<inertia ixx="0.02" iyy="0.03" izz="0.01"/>', axis="0 1 0"):
    """A body of 7 kg on two legs of 2 kg without knees."""
    text = mass("body", 7, 0.2, inertia)
    for side in ("left", "right"):
        turn = f'type="revolute"><axis xyz="{axis}"/><limit effort="30" velocity="8"/>'
        text += mass(f"{side}_leg", 2, -COM, inertia) + f'<link name="{side}_foot"/>'
        text += f'<joint name="{side}_hip" {turn}<parent link="body"/><child link="{side}_leg"/></joint>'
        text += f'<joint name="{side}_tip" type="fixed"><parent link="{side}_leg"/>'
        text += f'<child link="{side}_foot"/><origin xyz="0 0 {-HIP}"/></joint>'
    return f'<robot name="two"{" xmlns=" if before == "space" else ">"}' + (
        f'"https://example.org/x">{text}</robot>'
        if before == "space"
        else f"{before}{text}</robot>"
    )


def top(kind):
    ends = '<parent link="world"/><child link="body"/><axis xyz="0 1 0"/>'
    return f'<joint name="top" type="{kind}">{ends}</joint>'


def ramp(slope):
    """The slides on a ground that is turned about y and welded to a world which is not there."""
    weld = '<joint name="weld" type="fixed"><parent link="world"/><child link="ground"/>'
    turn = f'<origin rpy="0 {slope} 0"/></joint><link name="ground"/>'
    return weld + turn + SLIDES.replace('"world"', '"ground"')


@pytest.mark.parametrize(
    "text",
    [
        two_legs("space"),
        two_legs(SLIDES),
        two_legs(HEAVY + SLIDES),
        two_legs(ramp(0.0)),
        two_legs('<link name="world"/>' + top("planar")),
        two_legs(top("planar")),
        two_legs(top("floating")),
        two_legs(top("fixed")),
        two_legs(axis="-1 0 0", inertia='<inertia ixx="0.03" iyy="0.02" izz="0.01"/>'),
    ],
    ids=[
        "namespace",
        "world",
        "heavy world",
        "ground",
        "planar",
        "own world",
        "floating",
        "fixed",
        "along y",
    ],
)
def test_form_does_not_change_the_physics(urdf, text):
    """text: the same two-legged robot, written with another namespace, base, world or axis than two_legs(),
    whose base is free: inertia, bias, impact and swing foot are the same.
    """
    one, own = (biped_from_urdf(urdf(x, f"{k}.urdf")) for k, x in enumerate((two_legs(), text)))
    for q, v in states(3):
        for found, expected in (
            (own.inertia(q), one.inertia(q)),
            (own.bias(q, v), one.bias(q, v)),
            (own.impact(q, v).v, one.impact(q, v).v),
            (own.swing_foot(q), one.swing_foot(q)),
        ):
            size = np.max(np.abs(expected))
            np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * size)


def test_a_base_that_slides_on_a_slope_turns_the_zero_of_the_pitch(urdf):
    """Slides on ground turned by 0.04 rad: the pitch counts from the slope, so q + turn is the same pose as on
    level ground, and that is remarked. A body on the ground is left out by name; one that slides with the robot
    and has more than 1 % of its mass is refused, and so are two parallel slides.
    """
    one, derived = (
        biped_from_urdf(urdf(two_legs())),
        derive(urdf(two_legs(ramp(0.04)), "ramp.urdf")),
    )
    own, turn = derived.biped, np.array([0.0, 0.0, 0.04])
    assert (own.description.base, own.description.unactuated) == (("x", "z"), "pitch")
    for q, v in states(3):
        np.testing.assert_allclose(own.inertia(q), one.inertia(q + turn), rtol=0, atol=1e-12)
        np.testing.assert_allclose(own.bias(q, v), one.bias(q + turn, v), rtol=0, atol=1e-11)
        np.testing.assert_allclose(own.swing_foot(q), one.swing_foot(q + turn), rtol=0, atol=1e-12)
    (said,) = (note.text for note in derived.notes if "slope" in note.text)
    assert "0.04 rad" in said
    box = (
        mass("box", 5, 0)
        + '<joint name="at" type="fixed"><parent link="{}"/><child link="box"/></joint>'
    )
    derived = derive(urdf(two_legs(ramp(0.04) + box.format("ground")), "box.urdf"))
    np.testing.assert_array_equal(derived.biped.inertia(q), own.inertia(q))
    assert any("'box': 5.0" in note.text for note in derived.notes if note.kind == "left out")
    with pytest.raises(
        ModelError, match=r"has mass in \{'box': 5.0\} kg.* 1% of the robot's 11 kg"
    ):
        derive(urdf(two_legs(ramp(0.04) + box.format("a")), "boom.urdf"))
    parallel = SLIDES.replace('"0 0 1"', '"1 0 0"')
    with pytest.raises(ModelError, match="two prismatic joints in the plane"):
        derive(urdf(two_legs(parallel), "parallel.urdf"))


def test_light_carriages_of_a_base_are_left_out_by_name(urdf):
    """Two carriages of 0.054 kg on a robot of 11 kg are left out and named; two of 0.056 kg are more than 1 %
    of it, and are refused.
    """

    def carried(m):
        text = two_legs(SLIDES)
        for name in ("a", "b"):
            text = text.replace(f'<link name="{name}"/>', mass(name, m, 0.1))
        return urdf(text, "carried.urdf")

    derived, one = derive(carried(0.054)), biped_from_urdf(urdf(two_legs()))
    for q, v in states(3, 3):
        np.testing.assert_allclose(derived.biped.inertia(q), one.inertia(q), rtol=0, atol=1e-12)
        np.testing.assert_allclose(derived.biped.bias(q, v), one.bias(q, v), rtol=0, atol=1e-11)
    (said,) = (x.text for x in derived.notes if x.kind == "left out" and "slide" in x.text)
    assert "{'a': 0.054, 'b': 0.054}" in said
    with pytest.raises(ModelError, match=r"'a': 0.056, 'b': 0.056\} kg"):
        derive(carried(0.056))


def leg(text, side, m=2.0, c=COM, yy=0.03, length=HIP):
    """The text of `two_legs` with another leg: mass, COM below the hip, moment and length."""
    moments = f'<inertia ixx="0.02" iyy="{yy}" izz="0.012"/>'
    foot = f'{side}_foot"/><origin xyz="0 0 {{}}"'
    changes = (
        (mass(f"{side}_leg", 2, -COM), mass(f"{side}_leg", m, -c, moments)),
        (foot.format(-HIP), foot.format(-length)),
    )
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return text


def test_legs_that_differ_slightly_are_the_mean_of_both(urdf):
    """The right leg has its mass, COM, inertia and length up to 1 % off: the robot is that whose legs have the
    mean of both, and the largest difference is remarked.
    """
    other = {"m": 1.984, "c": 0.3015, "yy": 0.0297, "length": 0.7952}
    mean = {"m": 1.992, "c": 0.30075, "yy": 0.02985, "length": 0.7976}
    derived = derive(urdf(leg(two_legs(), "right", **other)))
    one = biped_from_urdf(urdf(leg(leg(two_legs(), "right", **mean), "left", **mean), "mean.urdf"))
    for q, v in states(3, 5):
        np.testing.assert_allclose(derived.biped.inertia(q), one.inertia(q), rtol=0, atol=1e-12)
        np.testing.assert_allclose(derived.biped.bias(q, v), one.bias(q, v), rtol=0, atol=1e-11)
        np.testing.assert_allclose(
            derived.biped.swing_foot(q), one.swing_foot(q), rtol=0.0, atol=1e-12
        )
    (said,) = (note.text for note in derived.notes if "mean of both" in note.text)
    assert "1.00% at most, in ['left_leg', 'right_leg']" in said
    assert not any("mean of both" in note.text for note in derive(urdf(two_legs())).notes)


@pytest.mark.parametrize(
    ("key", "value", "gap"),
    [("m", 2.03, 0.0148), ("c", 0.305, 0.0164), ("yy", 0.0304, 0.0132), ("length", 0.81, 0.0123)],
)
def test_legs_that_differ_by_more_than_one_percent_are_refused_with_the_number(
    urdf, key, value, gap
):
    """key: what differs in the right leg (m mass, c COM, yy inertia); value: its number, where the left leg has
    2, 0.3, 0.03 and 0.8; gap: the difference over the larger one, which the message states.
    """
    with pytest.raises(ModelError, match=f"legs differ.*_(leg|foot)', '{gap}'"):
        derive(urdf(leg(two_legs(), "right", **{key: value})))


@pytest.mark.parametrize("inertia", ["", '<inertia ixx="0" iyy="0" izz="0"/>'])
def test_point_masses_have_the_inertia_of_points(urdf, inertia):
    """D_s = sum m Re(d* d') with d the derivative of the place z = i exp(-i a) l of each point."""
    derived = derive(urdf(two_legs(inertia=inertia)))
    assert derived.broken == ()
    for q, _ in states(3, 5):
        stance, swing, trunk = np.exp(-1j * np.array([q[0] + q[2], q[1] + q[2], q[2]]))
        hip = HIP * stance * np.array([1.0, 0.0, 1.0])
        points = (
            (7.0, hip + 0.2 * trunk * np.array([0.0, 0.0, 1.0])),
            (2.0, (HIP - COM) * stance * np.array([1.0, 0.0, 1.0])),
            (2.0, hip - COM * swing * np.array([0.0, 1.0, 1.0])),
        )
        D = sum(m * np.real(np.outer(d.conj(), d)) for m, d in points)
        np.testing.assert_allclose(derived.biped.inertia(q), D, rtol=0, atol=1e-12)
    # a missing tag is remarked, zeros that the file states are not
    said = [note for note in derived.notes if "<inertia>" in note.text]
    assert len(said) == (inertia == "")


def test_rotors_of_transmissions_are_reflected_by_their_gears(urdf):
    """D_s has N^2 J on its diagonal, by joint; either leg has an equal rotor, 40^2 x 2e-4 = 0.32. A rotor in
    one leg alone, and an inertia that is no number, are refused.
    """
    gear = "<mechanicalReduction>40</mechanicalReduction>"
    left, right = (
        f'<transmission><joint name="{side}_hip"/><actuator name="m">{x}</actuator></transmission>'
        for side, x in (
            ("left", gear + "<motorInertia>2e-4</motorInertia>"),
            ("right", "<motorInertia>0.32</motorInertia>"),
        )
    )
    one = biped_from_urdf(urdf(two_legs()))
    derived = derive(urdf(two_legs(left + right), "geared.urdf"))
    for q, _ in states(3, 5):
        rotor = derived.biped.inertia(q) - one.inertia(q)
        np.testing.assert_allclose(rotor, np.diag([0.32, 0.32, 0.0]), rtol=0, atol=1e-12)
    (said,) = (note for note in derived.notes if "rotor" in note.text)
    assert said.kind == "read"
    assert "0.32 kg m^2 on 'left_hip'" in said.text
    with pytest.raises(ModelError, match="legs differ"):
        derive(urdf(two_legs(left), "lame.urdf"))
    with pytest.raises(ModelError, match="motorInertia"):
        derive(urdf(two_legs(left.replace("2e-4", "much")), "text.urdf"))


def test_rotors_that_differ_are_kept_by_the_record(tmp_path):
    """Inertias of rotors by joint [kg m^2]: 0.83 on the diagonal of D_s becomes hip 0.5 and knee 0.2."""
    text = (data_folder("urdf") / "rabbit" / "robot.toml").read_text()
    one = ba.Biped.load("rabbit")
    (tmp_path / "robot.toml").write_text(
        text.replace("armature = 0.83", "armature = [0.5, 0.5, 0.2, 0.2]")
    )
    (tmp_path / "floating.urdf").write_text(
        (data_folder("urdf") / "rabbit" / "floating.urdf").read_text()
    )
    own = ba.Biped.load(tmp_path / "robot.toml")
    q = np.array([3.3, 3.6, -0.5, -0.6, 0.1])
    gap = own.inertia(q) - one.inertia(q)
    np.testing.assert_allclose(
        gap, np.diag([-0.33, -0.33, -0.63, -0.63, 0.0]), rtol=0.0, atol=1e-12
    )


def hung(root):
    """A body on two legs with knees, hung from `root` of its left leg; "pinned": to the world at its foot."""
    turn = '<axis xyz="0 1 0"/><limit effort="30" velocity="8"/>'
    heads = (
        ("left_knee", "left_thigh", "left_shin"), ("left_hip", "body", "left_thigh"),
        ("right_hip", "body", "right_thigh"), ("right_knee", "right_thigh", "right_shin"),
    )  # fmt: skip
    # the frames: of the body at the hip, or of a link hung the other way at the joint that carries it
    up = root != "body"
    text = mass("body", 7, 0.2)
    for side in ("left", "right"):
        turned = up and side == "left"
        foot = SHIN if turned else 0.0  # the left shin's frame lies at the foot
        text += mass(f"{side}_thigh", 3, HIP - SHIN - 0.2 if turned else -0.2)
        text += mass(f"{side}_shin", 2, foot - 0.15)
        if not turned:
            text += f'<link name="{side}_foot"/><joint name="{side}_end" type="fixed">'
            text += f'<parent link="{side}_shin"/>'
            text += f'<child link="{side}_foot"/><origin xyz="0 0 {-SHIN}"/></joint>'
    for name, parent, child in heads:
        if up and name.startswith("left"):
            z = SHIN if name == "left_knee" else HIP - SHIN
            parent, child = child, parent
        else:
            z = SHIN - HIP if name.endswith("knee") else 0.0
        text += (
            f'<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/>'
        )
        text += f'<origin xyz="0 0 {z}"/>{turn}</joint>'
    if root == "left_foot":
        text += (
            '<link name="left_foot"/><joint name="left_end" type="fixed"><parent link="left_foot"/>'
        )
        text += '<child link="left_shin"/></joint>'
    if root == "pinned":
        text += (
            '<joint name="pin" type="continuous"><parent link="world"/><child link="left_shin"/>'
        )
        text += '<axis xyz="0 1 0"/></joint>'
    return f'<robot name="hung">{text}</robot>'


@pytest.mark.parametrize("root", ["left_shin", "left_foot", "pinned"])
def test_a_tree_that_hangs_from_a_leg_is_the_same_robot(urdf, root):
    """Joints that are walked backwards keep their angles, with the other sign."""
    end = "left_foot" if root == "left_foot" else "left_shin"
    one = biped_from_urdf(urdf(hung("body")))
    derived = derive(urdf(hung(root), "leg.urdf"), Hints((end, "right_foot")))
    own = derived.biped
    assert derived.broken == ()
    assert (own.description.trunk, own.n) == ("body", 5)
    order = [own.description.joints.index(name) for name in one.description.joints]
    for q, v in states(5, 5):
        Q, V = np.empty(5), np.empty(5)
        sign = np.array([-1.0, 1.0, -1.0, 1.0, 1.0])
        Q[order], V[order] = sign * q, sign * v
        close(own.inertia(Q)[np.ix_(order, order)] * np.outer(sign, sign), one.inertia(q))
        close(own.bias(Q, V)[order] * sign, one.bias(q, v))
        close(own.swing_foot(Q), one.swing_foot(q))
        close(own.impact(Q, V).v[order] * sign, one.impact(q, v).v)


def test_each_foot_may_have_a_tip_of_its_own(urdf):
    """The frame of the left shin lies at its foot, that of the right one at its knee."""
    text = hung("left_shin")
    legs, tip = ("left_shin", "right_shin"), (0.0, 0.0, 0.0, 0.0, 0.0, -SHIN)
    one = derive(urdf(text), Hints(("left_shin", "right_foot"))).biped
    own = derive(urdf(text), Hints(legs, tip=tip)).biped
    for q, v in states(5, 3):
        close(own.swing_foot(q), one.swing_foot(q))
        close(own.impact(q, v).v, one.impact(q, v).v)
    for wrong in (tip[:4], (0.0, math.nan, 1.0)):
        with pytest.raises(ModelError, match="of one after the other"):
            derive(urdf(text), Hints(legs, tip=wrong))


def test_a_hip_that_is_welded_to_one_leg_is_a_compass(urdf):
    """D_s is Goswami's of a compass: points m at a from the foot, b from the hip, and M at the hip."""
    text = mass("hip", 9, 0, "") + mass("left_leg", 4, -0.4, "") + mass("right_leg", 4, -0.4, "")
    for side, kind in (("left", "fixed"), ("right", "continuous")):
        axis = '<axis xyz="0 -1 0"/><limit effort="20" velocity="9"/>'
        text += f'<joint name="{side}" type="{kind}">{axis}<parent link="hip"/>'
        text += f'<child link="{side}_leg"/></joint>'
        text += f'<link name="{side}_foot"/><joint name="{side}_tip" type="fixed">'
        text += f'<parent link="{side}_leg"/>'
        text += f'<child link="{side}_foot"/><origin xyz="0 0 -0.9"/></joint>'
    check_compass(biped_from_urdf(urdf(f'<robot name="welded">{text}</robot>')))


def test_a_compass_that_hangs_from_its_stance_foot_has_equal_legs(urdf):
    """The base is at the foot; the legs are equal, although they hang on it in different ways."""
    text = mass("hip", 9, 0, "") + mass("stance", 4, 0.5, "") + mass("swing", 4, -0.4, "")
    turn = '<axis xyz="0 -1 0"/><limit effort="20" velocity="9"/>'
    for name, kind, parent, child, z in (
        ("weld", "fixed", "stance", "hip", 0.9),
        ("pin", "continuous", "hip", "swing", 0.0),
    ):
        text += f'<joint name="{name}" type="{kind}">{turn}<parent link="{parent}"/>'
        text += f'<child link="{child}"/><origin xyz="0 0 {z}"/></joint>'
    hints = Hints(("stance", "swing"), tip=(0.0, 0.0, 0.0, 0.0, 0.0, -0.9))
    derived = derive(urdf(f'<robot name="foot">{text}</robot>'), hints)
    assert derived.broken == ()
    check_compass(derived.biped)


def check_compass(own):
    """Its D_s and Goswami's, for points of 4 kg at a from the foot, b from the hip, and 9 kg at the hip."""
    a, b, length = 0.5, 0.4, 0.9
    for q, _ in states(2, 5):
        both = -4 * length * b * math.cos(q[0])
        D = np.array([[4 * b**2, both], [both, 13 * length**2 + 4 * a**2]])
        T = np.array([[1.0, 1.0], [0.0, 1.0]])  # swing leg absolute, stance leg absolute
        np.testing.assert_allclose(own.inertia(q), T.T @ D @ T, rtol=0, atol=1e-12)


def test_a_sole_is_a_point_at_its_ankle_unless_its_joint_is_named(urdf):
    """The foot keeps its mass; its joint is welded, and a note for each foot, the left one first, says so. With
    the joints of the feet named among the motors, the point of the sole has to be named too.
    """
    axis = '<axis xyz="0 1 0"/><limit effort="30" velocity="8"/>'
    text = two_legs().replace('_tip" type="fixed">', f'_tip" type="revolute">{axis}')
    for side in ("left", "right"):
        text = text.replace(f'<link name="{side}_foot"/>', mass(f"{side}_foot", 1, -0.05))
    derived = derive(urdf(text))
    assert derived.biped.description.actuated == ("left_hip", "right_hip")
    assert derived.biped.mass == pytest.approx(13.0)
    assert ["left_tip" in n.text for n in derived.notes if n.kind == "left out"] == [True, False]
    named = ("left_hip", "right_hip", "left_tip", "right_tip")
    with pytest.raises(ModelError, match="--set tip="):
        derive(urdf(text), Hints(actuated=named))
    feet = Hints(("left_foot", "right_foot"), named, tip=(0.0, 0.0, -0.1))
    assert derive(urdf(text), feet).biped.n == 5


def test_parts_of_a_urdf_that_are_left_out_are_in_the_notes(urdf):
    """The notes have the tags, with how often each occurs, and the joint of the base, which the package makes
    anew.
    """
    text = two_legs('<link name="world"/><gazebo/><gazebo/>' + top("planar")).replace(
        '<link name="left_foot"/>', '<link name="left_foot"><collision/></link>'
    )
    left = [note.text for note in derive(urdf(text)).notes if note.kind == "left out"]
    assert any("<gazebo> x 2" in said and "<collision> x 1" in said for said in left)
    assert any("'top'" in said for said in left)


# -- what is said ----------------------------------------------------------------------------------


def test_guesses_are_said_and_laws_hold(urdf):
    """In a URDF without base the feet, hip, joints, torque limit and base are guessed, each is remarked, and no
    law of physics is broken.
    """
    derived = derive(urdf(rabbit(base=False)))
    d = derived.biped.description
    assert (d.stance_foot, d.swing_foot, d.hip) == ("right_toe", "left_toe", "torso")
    assert d.joints == ("q1_right", "q1_left", "q2_right", "q2_left", "base_pitch")
    assert d.peak_torque == 150.0
    assert derived.broken == ()
    said = "\n".join(note.text for note in derived.notes)
    # balls are drawn, as the links have no shapes
    for part in ("base_x", "right_toe", "150 N m", "balls"):
        assert part in said
    assert derived.biped.mass == pytest.approx(32.0)


def test_legs_that_are_not_alike_are_refused():
    """By angles: relabelling with an offset of 0.1 rad in one hip and knee does not give the same pose back. By
    mass: one shin is 10 % heavier.
    """
    rabbit = ba.Biped.load("rabbit")
    offset = replace(
        rabbit, description=replace(rabbit.description, offset=(0.1, 0.0) * 2 + (0.0,))
    )
    heavier = ba.ModelErrors(mass={"left_shin": 0.1})
    for check in (offset.check, lambda: heavier.apply(rabbit)):
        with pytest.raises(ModelError, match="legs differ"):
            check()


@pytest.mark.parametrize(
    ("change", "law"),
    [
        (lambda b: replace(b, description=replace(b.description, phase=(1.0,) * 5)), "Theta falls"),
        (lambda b: replace(b, description=replace(b.description, hip="right_thigh")), "hip"),
    ],
    ids=["phase", "hip"],
)
def test_a_broken_law_is_found(urdf, change, law):
    """Each check can fail: a wrong phase row breaks "Theta falls", and the thigh breaks the law of the hip, as
    its origin moves when the tree is hung from the foot. The robot itself keeps all nine laws.
    """
    biped = biped_from_urdf(urdf(rabbit()))
    broken = [check.name for check in physical_checks(change(biped)) if not check.holds]
    assert any(law in name for name in broken)
    assert len(physical_checks(biped)) == 9
    assert all(check.holds for check in physical_checks(biped))


def test_a_body_of_an_imported_robot_has_the_links_of_both_legs(urdf):
    """Each link with mass is in one body, so errors are drawn for all of them; thighs 10 % heavier are two."""
    own = biped_from_urdf(urdf(rabbit()))
    heavy = [name for name, link in own.tree.links.items() if link.inertial is not None]
    bodies = own.description.links
    assert sorted(name for links in bodies.values() for name in links) == sorted(heavy)
    assert set(ba.ModelErrors.drawn(own, seed=1).mass) == set(bodies) == set(BODIES)
    heavier = ba.ModelErrors(mass={"thigh": 0.1}).apply(own)
    assert heavier.mass - own.mass == pytest.approx(2 * 0.1 * BODIES["thigh"].mass)


def test_written_record_is_loaded_again(urdf, tmp_path):
    """The robot is the same to the last bit, but for the path of its URDF; files that exist are not
    overwritten.
    """
    derived = derive(urdf(rabbit(rpy=f"0 {math.pi!r} 0")), Hints(armature=0.1))
    record = derived.write(tmp_path / "mine")
    own, again = derived.biped, ba.Biped.load(record)
    assert replace(again.description, urdf=own.description.urdf) == own.description
    for q, v in states(5, 3):
        np.testing.assert_array_equal(again.inertia(q), own.inertia(q))
        np.testing.assert_array_equal(again.bias(q, v), own.bias(q, v))
    with pytest.raises(OutputError, match=r"floating\.urdf.* exist already"):
        derived.write(tmp_path / "mine")


# -- refusals --------------------------------------------------------------------------------------
MASS = f'<mass value="{BODIES["thigh"].mass}"/>'
KNEE = '<joint name="q2_left" type="revolute"><parent link="left_thigh"/><child link="left_shin"/>'
KNEE_AXIS = 'xyz="0 0 0.4" rpy="0 0 0"/><axis xyz="0 1 0"/>'
KNEE_PLACE = '<child link="left_shin"/><origin xyz="0 0 0.4"'
TOE = joint("left_end", "fixed", "left_shin", "left_toe", xyz="0 0 0.4")


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        (KNEE_AXIS, KNEE_AXIS.replace("0 1 0", "1 0 0"), "q2_right"),
        (KNEE_PLACE, KNEE_PLACE.replace("0.4", "0.5"), "left_shin"),
        (MASS, '<mass value="-1"/>', "right_thigh"),
        (MASS, '<mass value="6.9"/>', "right_thigh"),
        (KNEE, KNEE.replace('"left_thigh"', '"left_shin"'), "circle"),
        (KNEE, KNEE + '<mimic joint="q2_right"/>', "q2_left"),
        ('<link name="cart"/>', body("cart", "shin"), "cart"),
        ("</robot>", "", "ParseError"),
    ],
)
def test_what_is_no_biped_is_refused_by_name(urdf, old, new, named):
    """old -> new in RABBIT's URDF: an axis out of the plane, legs that differ in length or mass, a negative
    mass, a circle of links, a mimic joint, a body that slides along, and broken XML; named: what the message
    has to name.
    """
    text = rabbit()
    assert old in text
    with pytest.raises(ModelError, match=named) as caught:
        derive(urdf(text.replace(old, new, 1)))
    assert "own.urdf" in str(caught.value)


SHOULDER = joint("shoulder", "revolute", "torso", "arm", axis="0 1 0")
HAND = joint("elbow", "revolute", "arm", "hand", xyz="0 0 0.3", axis="0 1 0")
EMPTY = rabbit().replace("</robot>", f'{SHOULDER}<link name="arm"/></robot>')
ARM = body("arm", "thigh") + body("hand", "shin") + SHOULDER + HAND
ARM = rabbit().replace("_toe", "_tip").replace("</robot>", f"{ARM}</robot>")
STILL = re.sub('type="(continuous|revolute)"', 'type="fixed"', rabbit(base=False))
COMPASS = (data_folder("urdf") / "compass" / "floating.urdf").read_text()
WITHOUT_TOES = rabbit().replace(TOE, "").replace('<link name="left_toe"/>', "")


@pytest.mark.parametrize(
    ("text", "hints", "word"),
    [
        (WITHOUT_TOES, Hints(), "--feet"),
        (rabbit(), Hints(feet=("toe", "left_toe")), "toe"),
        (rabbit(), Hints(hip="right_thigh"), "right_thigh"),
        (rabbit(), Hints(actuated=("q1_left",)), "--actuated"),
        (rabbit(), Hints(torque=-5.0), "peak_torque"),
        (rabbit(), Hints(armature=math.nan), "armature"),
        (rabbit().replace(' effort="150"', ""), Hints(), "--torque"),
        ("<sdf/>", Hints(), "robot"),
        (rabbit(), Hints(actuated=("q1_left", "q9")), r"motors \['q1_left', 'q9'\], expected"),
        (rabbit(), Hints(actuated=("q1_left",) * 2), "expected each at most once and from"),
        (rabbit(), Hints(tip=(0.0, 0.0, 0.1)), "give the links with this tip by .* found None"),
        (rabbit(), Hints(("world", "left_toe")), "'world' lies on the axis of its own joint"),
        # an arm with a hand is a third end of the tree, and no end has the name of a foot
        (ARM, Hints(), r"which two of the links \['right_tip', 'left_tip', 'hand'\] are the feet"),
        (STILL, Hints(), "no revolute joint below the trunk 'torso'; a biped"),
        # "ground" and "stance_pin" are the package's own link and joint at the stance foot
        (rabbit().replace('left_shin"', 'ground"'), Hints(), "joint 'q2_left': link 'ground' and"),
        (rabbit().replace("q1_left", "stance_pin"), Hints(), "'stance_pin': .* rename it"),
        # an arm without mass
        (EMPTY, Hints(), "'shoulder': it moves no mass; give link 'arm' an <inertial>, or make it"),
        # the right leg hangs on the left one, so the left foot has to be the stance foot, named first
        (COMPASS, Hints(("right_foot", "left_foot")), r"feet=\('left_foot', 'right_foot'\)"),
    ],
)
def test_what_cannot_be_guessed_is_asked_for(urdf, text, hints, word):
    """text: a URDF; hints: the options given with it; word: what the message asks for or names."""
    with pytest.raises(ModelError, match=word):
        derive(urdf(text), hints)


def test_a_motor_that_is_combined_with_another_one_is_refused(urdf):
    """A torso that counts from the stance leg counts from the other one after an impact: q2+ = q2 - q1."""
    text = (data_folder("urdf") / "compass" / "floating.urdf").read_text()
    turns = 'name="torso" type="revolute"><axis xyz="0 -1 0"/>'
    for old, new in (
        ('name="hip_mount" type="fixed">', turns),
        # its mass off its axis: without inertia about the new joint D_s would be refused first
        ('"0 0 0"/>\n      <mass value="10"', '"0 0 0.5"/>\n      <mass value="10"'),
    ):
        assert old in text
        text = text.replace(old, new)
    hints = Hints(("left_foot", "right_foot"), ("hip_joint", "torso"), torque=100.0)
    with pytest.raises(ModelError, match=r"\['torso'\] are combined"):
        derive(urdf(text), hints)


# -- the command -----------------------------------------------------------------------------------
def robot(*arguments):
    return CliRunner().invoke(app, ["robot", *map(str, arguments)])


def test_a_robot_is_checked_written_and_not_overwritten(urdf, tmp_path, monkeypatch):
    """`robot check` prints the mass and draws a picture, and fails for a tip of two numbers; `robot new` writes
    a record with the torque that is asked for, and only once.
    """
    monkeypatch.chdir(tmp_path)
    path, folder = urdf(rabbit()), tmp_path / "folder"
    good = robot("check", path, "--feet", "left_toe,right_toe", "--set", "armature=0.1")
    assert (good.exit_code, "32 kg" in good.stdout) == (0, True)
    assert "written to own.png" in good.stdout
    assert robot("check", path, "--feet", "left_shin,right_shin", "--set", "tip=0,0").exit_code == 1
    assert robot("new", path, "--out", folder, "--torque", 80).exit_code == 0
    assert ba.Biped.load(folder / "robot.toml").description.peak_torque == 80.0
    assert isinstance(robot("new", path, "--out", folder).exception, OutputError)


def test_the_laws_check_a_record_too(urdf, tmp_path, monkeypatch):
    """A record that `robot new` wrote holds. With each axis reversed in its URDF nothing is refused, but the
    robot falls the wrong way.
    """
    monkeypatch.chdir(tmp_path)
    record, model = tmp_path / "own" / "robot.toml", tmp_path / "own" / "floating.urdf"
    assert robot("new", urdf(rabbit()), "--out", record.parent).exit_code == 0
    assert robot("check", record).exit_code == 0
    tree = ET.parse(model)
    for axis in tree.iter("axis"):
        x, y, z = map(float, axis.attrib["xyz"].split())
        axis.attrib["xyz"] = f"{x} {-y} {z}"
    tree.write(model)
    wrong = robot("check", record)
    assert (wrong.exit_code, "BROKEN   Theta falls" in wrong.stdout) == (1, True)


@pytest.mark.parametrize("name", ["rabbit", "compass"])
def test_each_coordinate_is_said_with_its_joint_and_whether_a_motor_turns_it(name):
    """A line for each of q1 to qN, in order: joints with a motor, those without, and the pitch."""
    d, lines = ba.Biped.load(name).description, robot("list", name).stdout.splitlines()
    roles = ["motor"] * len(d.actuated) + ["free"] * len(d.passive) + ["absolute pitch"]
    said = [f"  q{i} = {x} ({y})" for i, (x, y) in enumerate(zip(d.joints, roles, strict=True), 1)]
    assert [line for line in lines if re.match(r"  q\d+ = ", line)] == said


NUMBERS = ("n", "tree", "description", "impact", "inertia", "bias")


@pytest.mark.parametrize(
    ("name", "number"),
    [("inertia", np.diag([1.0, 1.0, 1.0, 1.0, x])) for x in (-1e-3, 1e-16, np.nan)]
    + [("bias", np.full(5, np.inf)), ("impact", SingularError("the impact (7) is singular"))],
)
def test_numbers_of_a_robot_that_cannot_be_used_are_refused(name, number):
    """A stand-in with RABBIT's numbers passes the check. With an inertia that is indefinite, singular or NaN,
    an infinite bias, or an impact without solution in their place it is refused.
    """

    def wrong(*_):
        if isinstance(number, SingularError):
            raise number
        return number

    right = {x: getattr(ba.Biped.load("rabbit"), x) for x in NUMBERS}
    check_numbers(SimpleNamespace(**right))
    with pytest.raises(ModelError, match="expected positive ones"):
        check_numbers(SimpleNamespace(**right | {name: wrong}))


def test_what_a_urdf_states_of_its_joints_is_read_said_and_written(urdf, tmp_path):
    """A continuous joint, a whole turn, and a missing end state no range; 1000 and 0 state no rate."""
    limits = {
        "q2_left": '<limit effort="80" velocity="7" lower="-1.5" upper="2"/>',
        "q2_right": '<limit effort="80" velocity="0" lower="-3.2" upper="3.2"/>',
        "q1_left": '<limit effort="80" velocity="9" lower="-1.5" upper="2"/>',
        "q1_right": '<limit effort="80" velocity="1000" upper="2"/>',
    }
    text = rabbit()
    for name, limit in limits.items():
        at = text.index("<limit", text.index(f'name="{name}"'))
        text = text[:at] + limit + text[text.index("/>", at) + 2 :]
    # revolute, so that the missing end alone is why q1_right has no range
    text = text.replace('name="q1_right" type="continuous"', 'name="q1_right" type="revolute"')
    derived, free = derive(urdf(text)), (-math.inf, math.inf)
    # [1]: the joints of odd single supports, in which the left leg stands as in the file
    assert {j.name: (j.speed, j.range) for j in derived.biped.motor_joints[1]} == {
        "q2_left": (7.0, (-1.5, 2.0)),
        "q2_right": (math.inf, free),
        "q1_left": (9.0, free),
        "q1_right": (math.inf, free),
    }
    assert set(derived.biped.description.ranges) == {"q2_left"}
    again = ba.Biped.load(derived.write(tmp_path / "again"))
    assert again.motor_joints == derived.biped.motor_joints
    said = robot("list", tmp_path / "again" / "robot.toml").stdout
    assert "q2_left: rate 7 rad/s, range -1.5 to 2 rad" in said
    assert "q1_right: rate not stated, range not stated" in said
