"""A robot from one URDF: the same physics in all frames and senses, guesses said, refusals that help."""

import itertools
import math
import re
from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.cli import app
from biped_adrc.errors import InputError, ModelError, OutputError
from biped_adrc.gait.conventions import AngleMap
from biped_adrc.model import physical
from biped_adrc.resources import data_folder
from biped_adrc.robot_import import import_checks
from biped_adrc.robot_import.import_checks import checks
from biped_adrc.robot_import.import_robot import Hints, biped_from_urdf, derive
from validation.frost_urdf import (
    HUNG,
    LIMIT,
    TURNED,
    bodies,
    body,
    joint,
)
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
    ],
    ids=["frost", "hanging", "hanging-2", "upside-down", "sideways", "no-base", "paper"],
)
def test_physics_is_that_of_rabbit(urdf, text, to_paper):
    """D, Omega, energies, feet and impact in any frames and senses, at random states, to 1e-10."""
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
    """From the URDF alone, against the hand-written record."""
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
    """Thigh and shin unequal: c is d(angle of hip to foot)/dq at the straight leg, and l_k / L."""
    own = biped_from_urdf(urdf(rabbit(thigh=0.5, shin=0.3)))
    assert own.phase == pytest.approx([-1.0, 0.0, -0.375, 0.0, -1.0], abs=1e-15)
    straight, h = np.array([3.3, 2.9, 0.0, 0.4, -0.1]), 1e-6

    def angle(q):
        x, z = -own.hip(q)
        return math.atan2(-x, z) % (2.0 * math.pi)

    slope = [(angle(straight + h * e) - angle(straight - h * e)) / (2 * h) for e in np.eye(5)]
    np.testing.assert_allclose(own.phase, slope, atol=1e-8)


def test_a_stiff_robot_that_leans_forwards_falls_forwards(urdf):
    """Joints locked, D_NN q_N'' = -G_N: gravity takes the hip to +x, and Theta falls."""
    own = biped_from_urdf(urdf(rabbit()))
    q = np.array([math.pi, math.pi - 0.1, 0.0, 0.0, 0.2])  # leans by 0.2 rad
    assert own.hip(q)[0] > 0
    a = np.zeros(5)
    a[-1] = -own.gravity(q)[-1] / own.inertia(q)[-1, -1]
    assert own.hip_velocity(q, a)[0] > 0
    assert own.phase @ a < 0


def test_published_gait_walks_in_other_senses(urdf):
    """The gait of RABBIT in the angles of FROST: q_b' = A_b^-1 (q_b - b_b), Theta' = Theta - c b."""
    paper = ba.Biped.load("rabbit", "identified-bare")
    own, known = biped_from_urdf(urdf(rabbit())), ba.load_gait("published", paper)
    constraint, shift = known.constraint, float(paper.phase @ TURNED.b)
    rows = np.linalg.solve(
        TURNED.A[:4, :4], constraint.curve.coefficients - TURNED.b[:4, np.newaxis]
    )
    mapped = ba.VirtualConstraint(
        type(constraint.curve)(rows),
        own.phase,
        constraint.theta_plus - shift,
        constraint.theta_minus - shift,
    )
    zero = ba.ZeroDynamics.of(own, mapped)
    orbit = zero.orbit(zero.sigma_minus * zero.delta)
    assert orbit.period == pytest.approx(known.period, rel=1e-9)
    before = zero.end_state(zero.sigma_minus)
    gait = ba.Gait("mapped", "own", own.preset, mapped, *before, orbit.period, {}).check(own)
    walk = ba.walk(ba.Walker(own, ba.NPDController(mapped)), gait, impacts=2)
    assert walk.trajectory.status is ba.Status.COMPLETED
    for step in walk.certificates:
        assert step.duration == pytest.approx(known.period, abs=1e-6)
        assert step.violations() == ()


def test_a_file_as_frost_writes_it(urdf):
    """No base, no limits, no feet, inertia about y alone, a zero axis on what is fixed."""
    text = rabbit(base=False).replace(LIMIT, "")
    text = re.sub(r'ixx="[^"]*" iyy="([^"]*)" izz="[^"]*"', r'ixx="0" iyy="\1" izz="0"', text)
    text = text.replace("_toe", "_ankle").replace(
        'type="fixed">', 'type="fixed"><axis xyz="0 0 0"/>'
    )
    hints = Hints(feet=("right_shin", "left_shin"), tip=(0.0, 0.0, 0.4), torque=150.0)
    derived, full = derive(urdf(text), hints), biped_from_urdf(urdf(rabbit(), "full.urdf"))
    assert derived.broken == ()
    assert derived.biped.description.swing_foot == "left_shin_tip"
    assert any("slender" in sentence for sentence in derived.said)
    for q, v in states(5, 5):
        close(derived.biped.inertia(q), full.inertia(q))
        close(derived.biped.bias(q, v), full.bias(q, v))
        close(derived.biped.swing_foot(q), full.swing_foot(q))


def test_links_and_joints_may_share_a_name(urdf):
    """A foot called as a knee joint is the link, not the joint's frame."""
    own, other = (
        biped_from_urdf(urdf(text))
        for text in (rabbit(), rabbit().replace("left_toe", "q2_left").replace("torso", "q1_left"))
    )
    for q, _ in states(5, 3):
        close(other.swing_foot(q), own.swing_foot(q))
        close(other.hip(q), own.hip(q))


# -- what is said ----------------------------------------------------------------------------------
def test_guesses_are_said_and_laws_hold(urdf):
    derived = derive(urdf(rabbit(base=False)))
    d = derived.biped.description
    assert (d.stance_foot, d.swing_foot, d.hip, d.trunk) == (
        "right_toe",
        "left_toe",
        "torso",
        "torso",
    )
    assert d.joints == ("q1_right", "q1_left", "q2_right", "q2_left", "base_pitch")
    assert d.peak_torque == 150.0
    assert derived.broken == ()
    said = "\n".join(derived.said)
    for part in (
        "base_x",
        "right_toe",
        "'torso'",
        "Theta = -1 q1_right",
        "q2 = 'q1_left'",
        "150 N m",
    ):
        assert part in said
    assert derived.biped.mass == pytest.approx(32.0)
    assert "sticks" in said
    (stick, ball) = derived.biped.tree.links["left_thigh"].visuals
    assert (stick.size[1], stick.origin) == (0.4, (0.0, 0.0, 0.2))
    assert 7800 * 4 / 3 * math.pi * ball.size[0] ** 3 == pytest.approx(6.8)


LINK = '<link name="left_thigh"><inertial>'
MESH = '<visual><geometry><mesh filename="thigh.stl"/></geometry></visual>'
MOMENTS = r'ixx="[^"]*" iyy="([^"]*)" izz="[^"]*"'
FRICTION = "dry friction of the feet: 0.6, as of RABBIT; a URDF does not say"
ROTORS = "rotor inertia: none; a URDF does not say"
TORQUE = "torque limit: 150 N m, of every motor"
READ = "joint friction: read from <dynamics>, off unless asked for"


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """What is said of RABBIT as it is written."""
    path = tmp_path_factory.mktemp("plain") / "own.urdf"
    path.write_text(rabbit())
    return derive(path).said


@pytest.mark.parametrize(
    ("text", "hints", "gone", "new"),
    [
        (rabbit(), Hints(friction_coefficient=0.5), FRICTION, None),
        (rabbit(), Hints(armature=0.1), ROTORS, None),
        (rabbit(), Hints(torque=90.0), TORQUE, None),
        (rabbit().replace(LIMIT, LIMIT + '<dynamics damping="0.1"/>'), Hints(), None, READ),
        (rabbit().replace(LIMIT, LIMIT + '<dynamics friction="2"/>'), Hints(), None, READ),
        (
            re.sub(MOMENTS, r'ixx="0" iyy="\1" izz="0"', rabbit()),
            Hints(),
            None,
            r"moments about x and z of \['torso', .*'left_shin'\]: those of slender links",
        ),
        (
            rabbit().replace(LINK, LINK.replace("<inertial>", MESH + "<inertial>")),
            Hints(),
            None,
            r"shapes of \['left_thigh'\] are meshes or stand oblique, and are not drawn",
        ),
        (
            re.sub(r'("q2_.*)"150"', r'\1"80"', rabbit()),
            Hints(),
            TORQUE,
            "torque limit: 80 N m, of the weakest of {.*'q1_left': 150.0, .*'q2_left': 80.0",
        ),
    ],
    ids=["friction", "rotors", "torque", "damping", "dry", "flat", "mesh", "weakest"],
)
def test_each_remark_is_made_where_it_applies_and_only_there(urdf, plain, text, hints, gone, new):
    found = derive(urdf(text), hints).said
    assert [sentence for sentence in plain if sentence not in found] == ([gone] if gone else [])
    more = [sentence for sentence in found if sentence not in plain]
    assert len(more) == (new is not None)
    assert not more or re.match(new, more[0])


@pytest.mark.parametrize(
    ("change", "law"),
    [
        (lambda b: replace(b, description=replace(b.description, offset=(0.1,) * 5)), "exchang"),
        (lambda b: replace(b, description=replace(b.description, phase=(1.0,) * 5)), "Theta falls"),
        (lambda b: b.with_errors(mass={"left_shin": 1.1}), "alike in mass"),
        (lambda b: replace(b, description=replace(b.description, hip="right_thigh")), "hip"),
    ],
    ids=["offset", "phase", "mass", "hip"],
)
def test_a_broken_law_is_found(urdf, change, law):
    """Each check can fail. The stance thigh's origin moves in re-rooting, so it is no hip."""
    biped = biped_from_urdf(urdf(rabbit()))
    broken = [check.name for check in checks(change(biped)) if not check.holds]
    assert any(law in name for name in broken)
    assert all(check.holds for check in checks(biped))


def test_written_record_is_loaded_again(urdf, tmp_path):
    derived = derive(urdf(rabbit(rpy=f"0 {math.pi!r} 0")), Hints(armature=0.1))
    record = derived.write(tmp_path / "mine")
    own, again = derived.biped, ba.Biped.load(record)
    assert replace(again.description, urdf=own.description.urdf) == own.description
    for q, v in states(5, 3):
        np.testing.assert_array_equal(again.inertia(q), own.inertia(q))
        np.testing.assert_array_equal(again.bias(q, v), own.bias(q, v))
    with pytest.raises(OutputError, match=r"floating\.urdf' exists already"):
        derived.write(tmp_path / "mine")


# -- refusals --------------------------------------------------------------------------------------
MASS = f'<mass value="{BODIES["thigh"].mass}"/>'
KNEE = '<joint name="q2_left" type="revolute"><parent link="left_thigh"/><child link="left_shin"/>'
KNEE_AXIS = 'xyz="0 0 0.4" rpy="0 0 0"/><axis xyz="0 1 0"/>'
KNEE_PLACE = '<child link="left_shin"/><origin xyz="0 0 0.4"'
TOE = joint("left_end", "fixed", "left_shin", "left_toe", xyz="0 0 0.4")
PLACE = '<origin xyz="0 0 0" rpy="0 0 0"/>'
HIP_AXIS = '<axis xyz="0 1 0"/>' + LIMIT


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            KNEE_AXIS,
            KNEE_AXIS.replace("0 1 0", "1 0 0"),
            r"'q2_right'.*axis is \(1, 0, 0\).*along y.*'fixed'",
        ),
        (KNEE_PLACE, KNEE_PLACE.replace("0 0 0.4", "0 0.1 0.4"), "'q2_left'.*0.1 m beside.*y = 0"),
        ('<origin xyz="0 0 0.11"/>', '<origin xyz="0 0.02 0.11"/>', "'right_thigh'.*COM.*y = 0"),
        (MASS, '<mass value="0"/>', "'right_thigh': mass 0 kg"),
        (MASS, '<mass value="-1"/>', "'right_thigh': mass -1 kg"),
        (MASS, '<mass value="nan"/>', "'right_thigh'.*nan"),
        (MASS, '<mass value="1.5kg"/>', "'right_thigh'.*1.5kg"),
        (MASS, '<mass value="6.9"/>', "mass.*6.9 of 'right_thigh'.*6.8 of 'left_thigh'"),
        (KNEE_PLACE, KNEE_PLACE.replace("0.4", "0.5"), r"\(0, 0.4\) of 'q2_right'.*\(0, 0.5\)"),
        (KNEE, KNEE.replace('"left_thigh"', '"left_shin"'), "in a circle"),
        (TOE, TOE + joint("loop", "fixed", "right_toe", "left_toe"), "two parent joints"),
        (TOE, '<link name="orphan"/>', "root links"),
        ('type="revolute"', 'type="floating"', "'floating'.*base is added"),
        (KNEE, KNEE + '<mimic joint="q2_right"/>', "'q2_left'.*mimics"),
        (PLACE + HIP_AXIS, PLACE + HIP_AXIS.replace("150", "-1"), "effort is -1"),
        ("</robot>", "", "not well-formed"),
        ('<link name="cart"/>', body("cart", "shin"), "'cart'.*have mass.*trunk"),
        ('"BasePosZ" type="prismatic"', '"BasePosZ" type="fixed"', "slides by.*remove it"),
        ('name="q2_left"', 'name="stance_pin"', "'stance_pin'.*rename"),
    ],
)
def test_refusals_name_the_thing_and_the_way_out(urdf, old, new, message):
    text = rabbit()
    assert old in text
    with pytest.raises(ModelError, match=message) as caught:
        derive(urdf(text.replace(old, new, 1)))
    assert "own.urdf" in str(caught.value)


WITHOUT_TOES = rabbit().replace(TOE, "").replace('<link name="left_toe"/>', "")
RIGID = rabbit(base=False).replace("continuous", "fixed").replace("revolute", "fixed")
SENSOR = joint("mount", "fixed", "left_shin", "sensor", xyz="0 0 0.1") + '<link name="sensor"/>'


@pytest.mark.parametrize(
    ("text", "hints", "message"),
    [
        (WITHOUT_TOES, Hints(), "'left_shin' lies on the axis.*'q2_left'.*--feet"),
        (rabbit(), Hints(feet=("toe", "left_toe")), r"no link 'toe'.*right_toe.*left_toe"),
        (rabbit(), Hints(feet=("left_toe",)), "expected two different links"),
        (rabbit(), Hints(feet=("left_toe", "left_shin")), "different legs"),
        (rabbit(), Hints(feet=("left_toe", "world")), "'world' does not hang on the trunk"),
        (rabbit().replace("_toe", "_end"), None, "sensor.*not certain.*--feet"),
        (rabbit(), Hints(tip=(0.0, 0.0, 0.4)), "links by feet="),
        (rabbit(), Hints(("toe", "left_shin"), tip=(0.0, 0.0, 0.4)), "no link 'toe'"),
        (rabbit(), Hints(hip="pelvis"), "no link 'pelvis'.*torso"),
        (rabbit(), Hints(hip="right_thigh"), "'right_thigh' carries the stance foot.*swing leg"),
        (rabbit(), Hints(actuated=("q1_left", "elbow")), "elbow.*at most once and from.*q2_left"),
        (rabbit(), Hints(actuated=("q1_left",)), "only one has a motor.*--actuated"),
        (rabbit(), Hints(torque=-5.0), "peak_torque is -5"),
        (rabbit(), Hints(armature=math.nan), "armature is nan"),
        (rabbit(), Hints(armature=-0.1), "armature is -0.1, expected a number >= 0"),
        (rabbit().replace(' effort="150"', ""), Hints(), "no torque limit.*--torque"),
        (RIGID, Hints(), "no revolute joint below the trunk 'torso'"),
        ("this is no XML", Hints(), "not well-formed XML"),
        ("<sdf/>", Hints(), "<sdf>, expected <robot>"),
        ('<robot name="x"><xacro:leg side="left"/></robot>', Hints(), "xacro.*robot.urdf"),
    ],
)
def test_what_cannot_be_guessed_is_asked_for(urdf, text, hints, message):
    if hints is None:
        text, hints = text.replace("</robot>", SENSOR + "</robot>"), Hints()
    with pytest.raises(ModelError, match=message):
        derive(urdf(text), hints)


def test_feet_are_known_by_name_where_the_chains_do_not_tell(urdf):
    derived = derive(urdf(rabbit().replace("</robot>", SENSOR + "</robot>")))
    assert derived.biped.description.swing_foot == "left_toe"
    assert "called feet" in derived.said[1]


def test_files_that_are_none(tmp_path):
    with pytest.raises(ModelError, match="not found; give the path"):
        derive(tmp_path / "nowhere.urdf")
    with pytest.raises(ModelError, match="not found"):
        derive(tmp_path)
    macros = tmp_path / "robot.xacro"
    macros.write_text(rabbit())
    with pytest.raises(InputError, match="xacro"):
        derive(macros)


# -- the command -----------------------------------------------------------------------------------
def robot(*arguments):
    return CliRunner().invoke(app, ["robot", *map(str, arguments)])


def test_check_explains_and_says_by_its_exit_code_what_is_wrong(urdf, tmp_path):
    good = robot("check", urdf(rabbit()), "--feet", "left_toe,right_toe", "--armature", "0.1")
    assert good.exit_code == 0
    for part in ("q1 = q1_left (motor)", "Theta = -1 q1 -0.5 q3 -1 q5", "holds", "32 kg"):
        assert part in good.stdout
    bad = robot("check", tmp_path / "nowhere.urdf")
    assert isinstance(bad.exception, ba.BipedError)
    assert "not found" in str(bad.exception)
    worse = robot("check", urdf(rabbit()), "--feet", "left_shin,right_shin", "--tip", "0,0")
    assert "three numbers x,y,z" in str(worse.exception)


def test_new_robot_is_listed_shown_and_not_overwritten(urdf, tmp_path):
    path, folder = urdf(rabbit()), tmp_path / "folder"
    done = robot("new", path, "--out", folder, "--torque", 80)
    assert done.exit_code == 0
    shown = robot("show", folder / "robot.toml")
    assert shown.exit_code == 0
    assert "torque limit 80 N m" in shown.stdout
    assert "right_thigh: 6.8 kg" in shown.stdout
    assert isinstance(robot("new", path, "--out", folder).exception, OutputError)
    listed = robot("list")
    assert listed.exit_code == 0
    for name in ("rabbit", "tac2003", "compass"):
        assert name in listed.stdout


def test_one_motor_between_the_legs_is_refused_with_the_reason(tmp_path):
    """A compass with a motor at the hip: the angle changes its sign at impact, no motor takes its place."""
    path = data_folder("urdf") / "compass" / "floating.urdf"
    hip = ba.Biped.load("compass").description.joints[0]
    with pytest.raises(
        ba.BipedError, match=r"are not exchanged with others at impact.*torso with two"
    ):
        derive(path, Hints(actuated=(hip,), torque=100.0))
    for words in (["check"], ["new", "-o", str(tmp_path / "out")]):
        given = ["--actuated", hip, "--torque", "100"]
        done = CliRunner().invoke(app, ["robot", words[0], str(path), *given, *words[1:]])
        assert done.exit_code != 0
        assert "are not exchanged" in f"{done.exception} {done.output}"
    record = data_folder("urdf") / "compass" / "robot.toml"
    text = record.read_text().replace("actuated = []", f'actuated = ["{hip}"]')
    text = text.replace(f'passive = ["{hip}"]', "passive = []")
    (tmp_path / "robot.toml").write_text(text)
    (tmp_path / "floating.urdf").write_text(path.read_text())
    motor = ba.Biped.load(tmp_path / "robot.toml")
    assert motor.p == 1
    with pytest.raises(ba.BipedError, match="are not exchanged"):
        ba.design_gait(motor, 0.5)
    with pytest.raises(ba.BipedError, match="are not exchanged"):
        ba.Walker(motor, ba.Passive())


@pytest.mark.parametrize(("gap", "holds"), [(0.9e-9, True), (1.1e-9, False), (np.nan, False)])
def test_a_law_of_a_urdf_is_kept_to_a_billionth(monkeypatch, gap, holds):
    rabbit = ba.Biped.load("rabbit")
    assert all(check.holds for check in import_checks.checks(rabbit))
    monkeypatch.setattr(import_checks, "_exchange", lambda *_: iter([("a law", gap)]))
    (found,) = (check for check in import_checks.checks(rabbit) if check.name == "a law")
    assert found.holds is holds


def test_an_inertia_matrix_that_is_not_definite_is_refused():
    from types import SimpleNamespace

    rabbit = ba.Biped.load("rabbit")
    D = np.diag([1.0, 1.0, 1.0, 1.0, -1e-3])
    odd = SimpleNamespace(floating=SimpleNamespace(projected=lambda q, v: (D, np.ones(5))))
    wrong = SimpleNamespace(inertia=lambda q: D, bias=lambda q, v: np.ones(5), **vars(odd))
    laws = import_checks._single_support(wrong, np.zeros(5), np.zeros(5))
    assert dict(itertools.islice(laws, 3))[import_checks.DEFINITE] == np.inf
    with pytest.raises(ba.BipedError, match="expected positive ones"):
        physical._check_definite(D, "here")
    wrong = SimpleNamespace(
        n=5, tree=rabbit.tree, description=rabbit.description, impact=rabbit.impact,
        inertia=lambda q: D, bias=rabbit.bias,
    )  # fmt: skip
    with pytest.raises(ba.BipedError, match="expected positive ones"):
        physical.check_numbers(wrong)
