"""What is given by mistake is one InputError that names it, what was found and what was expected."""

from __future__ import annotations

import re
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.campaign.workers import Threads
from biped_adrc.cli import app
from biped_adrc.control.clf_qp import CLFQPController
from biped_adrc.control.npid import NPIDController
from biped_adrc.control.super_twisting import SuperTwistingController
from biped_adrc.disturbances.recorded import RecordedTorque
from biped_adrc.gait.design.request import GaitRequest
from biped_adrc.gait.exchange.samples import read_csv
from biped_adrc.hardware.pitch_sensor import PitchSensor
from biped_adrc.observers.kalman import KalmanObserver
from biped_adrc.scenario.build import build
from biped_adrc.scenario.idle import idle
from biped_adrc.studies.cycle_stability import cycle_of


@pytest.fixture(scope="module")
def three():
    return ba.Biped.load("three_link")


class Silent(ba.Controller):
    """Its output forgets to return."""

    def output(self, s, m):
        pass


class Lazy(ba.Reference):
    """A reference written for four joints of five coordinates, with NumPy's own errors."""

    def __call__(self, t, q, v):
        return np.ones(5) @ q


OBSERVER = ba.GPIObserver.from_bandwidth(500.0)
PULSE = ba.TorquePulse([30.0] * 5)
CASES = {
    "a torque too few": (
        lambda s: s.walk(disturbance=ba.TorquePulse([30.0] * 4)),
        "an amplitude of 4 numbers, expected 5",
    ),
    "gains of five joints": (
        lambda s: s.walk(ba.NPDController(s.h, ba.Gains([1.0] * 5, [1.0] * 5))),
        "gain K_p has 5 numbers, expected 1 or 4",
    ),
    "gains inside another controller": (
        lambda s: s.walk(ba.ReferenceReset(ba.NPDController(s.h, ba.Gains(1.0, [1.0] * 3)))),
        "gain K_d has 3 numbers, expected 1 or 4",
    ),
    "gains in words": (lambda s: ba.Gains("a"), "gain K_p is 'a' (a str), expected numbers"),
    "a gait of another robot": (
        lambda s: ba.walk(ba.Walker(s.three, ba.NPDController(s.h)), s.gait, 1),
        "gait 'published' is of robot 'rabbit' with 5 coordinates, and the walker is 'three_link' with 3",
    ),
    "a constraint of another robot": (
        lambda s: ba.Walker(s.three, ba.NPDController(s.h)).initial_state(np.zeros(3), np.zeros(3)),
        "the VirtualConstraint of NPDController cannot be evaluated at the 3 coordinates of this robot",
    ),
    "a reference of other sizes": (
        lambda s: ba.Walker(s.three, ba.NPDController(Lazy())).initial_state(
            np.zeros(3), np.zeros(3)
        ),
        "the Lazy of NPDController cannot be evaluated at the 3 coordinates of this robot",
    ),
    "a gait in place of its constraint": (
        lambda s: ba.NPDController(s.gait),
        "reference of NPDController is a Gait, expected a Reference, such as gait.constraint",
    ),
    "a class in place of a controller": (
        lambda s: ba.Walker(s.biped, ba.NPDController),
        "controller of Walker is the class NPDController, not made as NPDController(...)",
    ),
    "a class in place of a push": (
        lambda s: ba.Walker(s.biped, ba.Passive(), ba.TorquePulse),
        "disturbance of Walker is the class TorquePulse",
    ),
    "a class in place of an observer": (
        lambda s: ba.ADRCController(s.h, ba.GPIObserver),
        "observer of ADRCController is the class GPIObserver",
    ),
    "a class in place of a method": (
        lambda s: ba.walk(s.walker, s.gait, 1, ba.RK4),
        "the method of the walk is the class RK4",
    ),
    "the name of a gait": (
        lambda s: ba.walk(s.walker, "published"),
        "the gait of the walk is 'published' (a str), expected a Gait, such as load_gait(",
    ),
    "swapped: walk": (lambda s: ba.walk(s.gait, s.walker), "is a Gait, expected a Walker"),
    "swapped: Walker": (
        lambda s: ba.Walker(ba.Passive(), s.biped),
        "plant of Walker is a Passive, expected a Biped",
    ),
    "swapped: load_gait": (lambda s: ba.load_gait(s.biped, "published"), "gait is a Biped"),
    "swapped: ADRCController": (
        lambda s: ba.ADRCController(OBSERVER, s.h),
        "reference of ADRCController is a GPIObserver, expected a Reference",
    ),
    "swapped: ZeroDynamics": (lambda s: ba.ZeroDynamics.of(s.h, s.biped), "biped is a VirtualCons"),
    "swapped: zero_report": (lambda s: ba.zero_report(s.gait, s.biped), "biped is a Gait"),
    "swapped: design_gait": (lambda s: ba.design_gait(0.8, s.biped), "robot is 0.8 (a float)"),
    "a list of pushes": (
        lambda s: ba.Walker(s.biped, ba.Passive(), [PULSE, PULSE]),
        "disturbance of Walker is a list, expected a Disturbance",
    ),
    "a bandwidth as the observer": (
        lambda s: ba.ADRCController(s.h, 500.0),
        "observer of ADRCController is 500.0 (a float), expected an Observer, such as "
        "GPIObserver.from_bandwidth(500.0)",
    ),
    "an observer as gains": (
        lambda s: ba.NPDController(s.h, OBSERVER),
        "gains of NPDController is a GPIObserver, expected a Gains",
    ),
    "degrees as the start": (
        lambda s: ba.walk(s.walker, s.gait, 1, start=tuple(map(np.degrees, s.gait.start(s.biped)))),
        "expected radians: np.radians(q)",
    ),
    "a start of another length": (
        lambda s: ba.walk(s.walker, s.gait, 1, start=(np.zeros(5), np.zeros(4))),
        "the start q' is [0. 0. 0. 0.], expected 5 finite numbers",
    ),
    "a start in words": (
        lambda s: ba.walk(s.walker, s.gait, 1, start=(["a"] * 5, np.zeros(5))),
        "the start q is ['a', 'a', 'a', 'a', 'a'] (a list), expected numbers",
    ),
    "a URDF as the robot": (lambda s: ba.Biped.load("x.urdf"), "biped_from_urdf('x.urdf') takes"),
    "a number as the robot": (lambda s: ba.Biped.load(5), "robot is 5 (an int), expected a str"),
    "an output of nothing": (
        lambda s: s.walk(Silent()),
        "Silent.output returned None, expected (4,), real numbers",
    ),
    "a speed in words": (
        lambda s: ba.design_gait(s.biped, speed="fast"),
        "speed of GaitRequest is 'fast' (a str), expected a number",
    ),
    "a period in words": (lambda s: ba.SampledTime("1ms"), "period of SampledTime is '1ms'"),
    "a slope in words": (
        lambda s: ba.Walker(s.biped, ba.Passive(), slope="5"),
        "slope of Walker is '5'",
    ),
    "a method in words": (
        lambda s: ba.walk(s.walker, s.gait, 1, "RK4"),
        "the method of the walk is 'RK4' (a str), expected an OneStepMethod, such as RK4(1e-3)",
    ),
    "a push in words": (lambda s: ba.TorquePulse("abc"), "torque amplitude is 'abc'"),
    "one number for errors of masses": (
        lambda s: s.biped.with_errors(mass=1.2),
        "mass is 1.2 (a float), expected a Mapping, such as {'torso': 1.2}",
    ),
    "a gait as a cycle": (lambda s: ba.cycle_stability(s.gait), "cycle is a Gait"),
    "a gait that is to go on": (lambda s: ba.continued(s.gait), "is a Gait, expected a Virtual"),
    "a constraint to export": (lambda s: ba.export_gait(s.h, "x.json"), "gait is a VirtualConst"),
    "a bias in words": (lambda s: PitchSensor("a"), "bias of PitchSensor is 'a' (a str)"),
    "an encoder in words": (lambda s: ba.Sensors("a"), "counts of Sensors is 'a' (a str)"),
    "a lag in words": (lambda s: ba.Motors(lag="a"), "lag of Motors is 'a' (a str)"),
    "a noise in words": (
        lambda s: KalmanObserver.from_noise("a", 1e-6),
        "the drift of a Kalman observer is a rad/s^2.5, expected a positive number",
    ),
    "a bandwidth in a list": (
        lambda s: ba.GPIObserver.from_bandwidth([500.0]),
        "observer bandwidth is [500.0] rad/s, expected a positive number",
    ),
    "a slope of a surface in words": (
        lambda s: SuperTwistingController(s.h, "a"),
        "slope of SuperTwistingController is 'a' (a str)",
    ),
    "integral gains by joint": (
        lambda s: NPIDController(s.h, ba.Gains(), [1, 2]),
        "K_i of NPIDController is [1, 2] (a list)",
    ),
    "gains by joint as one ADRC's": (
        lambda s: NPIDController.like_adrc(s.h, ba.Gains([1.0] * 4, 1.0)),
        "K_p of the ADRC is array([1., 1., 1., 1.]) (a ndarray), expected a number",
    ),
    "an integral gain that makes the loop unstable": (
        lambda s: NPIDController(s.h, ba.Gains(5000.0, 50.0), 5000.0 * 50.0),
        "unstable even on the exact model with K_p = 5000, K_d = 50, K_i = 250000",
    ),
    "a filter that makes the loop unstable": (
        lambda s: NPIDController(s.h, ba.Gains(5000.0, 50.0), filter_bandwidth=20.0),
        "and a filter of 20 rad/s",
    ),
    "a robot's name at a recording": (
        lambda s: RecordedTorque.read("x.csv", "rabbit"),
        "the robot of a recording is 'rabbit' (a str), expected a Biped",
    ),
    "a start of a recording in words": (
        lambda s: RecordedTorque.read("x.csv", s.biped, start="a"),
        "the start of a recording is 'a' (a str)",
    ),
    "a swapped recording": (
        lambda s: RecordedTorque.read(s.biped, "x.csv"),
        "is a Biped, expected",
    ),
    "a recording of words": (
        lambda s: RecordedTorque("a", "b"),
        "the times of the recording is 'a'",
    ),
    "a recording of one row": (
        lambda s: RecordedTorque([0.0], [[1.0] * 5]),
        "the recording has rows of numbers: 1, expected at least 2",
    ),
    "a class as a scenario": (
        lambda s: ba.walk_scenario(ba.NPDController),
        "what is to walk is the class NPDController, not made as NPDController(...), expected a Scenario",
    ),
    "a scenario as a walker": (
        lambda s: ba.walk(ba.Scenario("NPD")),
        "what is to walk is a Scenario, expected a Walker, such as Walker(biped, controller); a Scenario walks",
    ),
    "an observer registered as a controller": (
        lambda s: ba.register("controller", "wrong kind", ba.GPIObserver),
        "is registered as the class GPIObserver, expected a class below Controller, or a function",
    ),
    "a number as a registered name": (
        lambda s: ba.register("controller", 5, ba.NPDController),
        "the name of a controller is 5 (an int)",
    ),
    "a sensor's own value without the sensor": (
        lambda s: ba.walk_scenario(ba.Scenario("NPD", own={"bias": 0.1})),
        "sensor = 'pitch sensor' takes it, and is not chosen here",
    ),
    "an observer's own value without the observer": (
        lambda s: ba.walk_scenario(ba.Scenario("ADRC", own={"epsilon": 0.002})),
        "observer = 'high gain' takes it, and is not chosen here",
    ),
    "a push's own value without the push": (
        lambda s: ba.walk_scenario(ba.Scenario("NPD", own={"file": "x.csv"})),
        "push = 'recorded' takes it, and is not chosen here",
    ),
    "a curve of one's own by its module": (
        lambda s: ba.design_gait(s.biped, 0.7, curve="bz:Mine"),
        "a class of one's own gets a name with biped_adrc.register('curve', NAME, CLASS) first",
    ),
    "a controller with a __post_init__ of its own": (
        lambda s: Forgetful(5),
        "reference of Forgetful is 5 (an int), expected a Reference",
    ),
    "a number of impacts of a return map": (
        lambda s: cycle_of(ba.Scenario("NPD", impacts=3)),
        "takes no impacts: this would do nothing",
    ),
    "a step of the fixed method of a passive cycle": (
        lambda s: cycle_of(ba.Scenario("passive", robot="compass", h=1e-3)),
        "by a fixed method, and takes no h: this would do nothing",
    ),
    "an engine of a return map": (
        lambda s: cycle_of(ba.Scenario("NPD", engine="pinocchio")),
        "takes no engine: this would do nothing",
    ),
    "a step of the ground for a return map": (
        lambda s: cycle_of(ba.Scenario("NPD", ground_step=0.01)),
        "takes no ground_step: this would do nothing",
    ),
    "two slopes of a return map": (
        lambda s: cycle_of(ba.Scenario("NPD", slope=0.01), slope=0.02),
        "cycle on a slope of 0.02 rad and takes no slope: this would do nothing",
    ),
    "a gait for a passive cycle": (
        lambda s: ba.find_cycle("compass", gait="v0.8"),
        "robot 'compass' has no motors, so it takes no gait",
    ),
    "the outcome of a walk of a walker": (
        lambda s: s.walk().outcome,
        "this walk was made of a walker, and an outcome is a scenario's",
    ),
    "workers without end": (
        lambda s: Threads(10**30),
        "asks for 1000000000000000000000000000000 workers, expected at least 1 and at most 1024",
    ),
    "a gait as a walker": (lambda s: ba.ReturnMap(s.gait, ba.RK4()), "walker of ReturnMap is a Ga"),
}


@dataclass(frozen=True)
class Forgetful(ba.Controller):
    """A __post_init__ that does not call the one above."""

    reference: ba.Reference

    def __post_init__(self):
        object.__setattr__(self, "half", 0.5)


class Parts:
    def __init__(self, biped, gait, three):
        self.biped, self.gait, self.three, self.h = biped, gait, three, gait.constraint

    @property
    def walker(self):
        return ba.Walker(self.biped, ba.NPDController(self.h))

    def walk(self, controller=None, disturbance=None):
        controller = ba.NPDController(self.h) if controller is None else controller
        return ba.walk(ba.Walker(self.biped, controller, disturbance), self.gait, 1)


@pytest.mark.parametrize("case", CASES)
def test_a_mistake_is_one_sentence(case, biped, gait, three):
    mistake, said = CASES[case]
    with pytest.raises(ba.BipedError) as caught:
        mistake(Parts(biped, gait, three))
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("command", [["animate"], ["plot"], ["plot", "--with"]])
def test_the_settings_beside_a_run_are_no_run(command, biped, gait, tmp_path):
    walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 1)
    walk.save(tmp_path / "run.npz")
    if "--with" in command:
        command = ["plot", str(tmp_path / "run.npz"), "--with"]
    done = CliRunner().invoke(app, [*command, str(tmp_path / "run.json")])
    assert isinstance(done.exception, ba.BipedError)
    assert f"it is no run, expected a .npz file; take '{tmp_path / 'run.npz'}'" in str(
        done.exception
    )
    assert "pickle" not in str(done.exception)


def test_a_run_that_does_not_begin_as_one_is_damaged(tmp_path):
    (tmp_path / "run.npz").write_text("hello")
    with pytest.raises(ba.BipedError, match="is damaged and cannot be read") as caught:
        ba.load_walk(tmp_path / "run.npz")
    assert "pickle" not in str(caught.value)


def test_the_clearance_of_a_design_says_which_part_of_the_step_it_is_of(biped, gait):
    """The least between 3 and 97 % of the step, and the text says so."""
    c = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 1).certificates[0]
    request = GaitRequest(speed=1.0)
    text = ba.DesignedGait(gait, request, 1.0, c, 0.5, 0.0, 1, 0.0).text()
    assert f"{1e3 * c.clearance:.1f} mm, between the first and the last 3 % of the step" in text


@pytest.mark.parametrize(("name", "near"), [("PDController", "NPDController"), ("wlak", "walk")])
def test_a_public_name_that_is_not_there_has_a_nearest_one(name, near):
    with pytest.raises(AttributeError, match=f"no attribute '{name}'; did you mean '{near}'"):
        getattr(ba, name)


def test_a_controller_that_is_unknown_to_compare(tmp_path):
    done = CliRunner().invoke(
        app, ["compare", "--controllers", "SMC", "--seeds", "1", "-o", str(tmp_path / "out")]
    )
    assert isinstance(done.exception, ba.BipedError)
    assert "['SMC']" in str(done.exception)
    assert "'ADRC'" in str(done.exception)


def test_annotations_that_say_more_are_not_looked_at(gait):
    """Numbers of NumPy are numbers, None is one where the annotation says so, and own text is left alone."""
    from dataclasses import dataclass

    @dataclass(frozen=True)
    class Own(ba.Controller):
        reference: ba.Reference
        law: "not a name of any module"  # noqa: F722
        gain: float = 1.0

    assert Own(5, "anything", "word").gain == "word"
    assert ba.SampledTime(np.float64(1e-3)).period == 1e-3
    assert ba.SampledTime(np.array(1e-3)).period == 1e-3
    assert CLFQPController(gait.constraint, torque_limit=None).torque_limit is None


LINES = {
    "t,q1\n0,1\n\n1,x\n": "line 4, column 'q1': found 'x', expected a finite number",
    "t,q1\n0,1\n\n1,nan\n": "line 4, column 'q1': found 'nan', expected a finite number",
    "t,q1\n0,1\n1\n": "line 3 has 1 entries, expected 2: ['t', 'q1']",
}


@pytest.mark.parametrize("text", LINES)
def test_a_table_with_a_mistake_names_line_and_column(text, biped, tmp_path):
    file = tmp_path / "table.csv"
    file.write_text(text)
    for read in (lambda: RecordedTorque.read(file, biped), lambda: read_csv(file)):
        with pytest.raises(ba.BipedError) as caught:
            read()
        assert LINES[text] in str(caught.value)
        assert str(file) in str(caught.value)


def test_tables_that_lack_something(biped, tmp_path):
    file = tmp_path / "table.csv"
    for text, said in {
        "t,q1\n0,1\n\n0,2\n": "line 4 of the recording has t = 0 s",
        "t,q1\n0,1\n": "the recording has rows of numbers: 1",
    }.items():
        file.write_text(text)
        with pytest.raises(ba.BipedError, match=said):
            RecordedTorque.read(file, biped)
    for text, said in {
        "q1,q2\n0,1\n": "no column 't'",
        "t,x1\n0,1\n": "no column 'q1'",
        "t,q1\n": "no row of numbers",
        "": "no column 't'",
    }.items():
        file.write_text(text)
        with pytest.raises(ba.BipedError, match=said):
            read_csv(file)


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"seed": 5}, "seed = 5 does nothing: nothing in this walk is random"),
        ({"pushed_step": 2}, "pushed_step = 2 does nothing: there is neither a push nor a step"),
        ({"fine": 1e-4}, "fine = 0.0001 does nothing: no push switches"),
    ],
)
def test_values_that_do_nothing_are_said(values, said):
    assert any(said in remark for remark in idle(ba.Scenario("NPD", **values)))
    pushed = {"push": "noise", "amplitude": 2.0, "onset": 0.1, "impacts": 3}
    assert idle(ba.Scenario("NPD", **pushed, **values)) == ()
    assert idle(ba.Scenario("NPD")) == ()


def test_what_does_nothing_is_among_the_remarks_of_the_walk():
    walk = ba.walk_scenario(ba.Scenario("NPD", impacts=1, seed=5))
    assert walk.remarks == ("seed = 5 does nothing: nothing in this walk is random",)


def test_a_return_map_takes_the_method_and_step_of_the_scenario():
    def steps(**values):
        return cycle_of(ba.Scenario("NPD", **values)).P.method

    assert steps() == ba.RK4(5e-4)
    assert steps(h=2e-4) == ba.RK4(2e-4)
    assert steps(method="adaptive") == ba.Adaptive(1e-9, 1e-9)


def test_a_passive_cycle_takes_the_slope_of_the_scenario():
    level, beside = (
        cycle_of(ba.Scenario("passive", robot="compass", slope=x)).P.walker.slope for x in (0, 0.01)
    )
    assert beside == pytest.approx(level + 0.01, abs=1e-15)


def test_poincare_judges_by_the_limits_given_and_says_what_does_nothing(monkeypatch):
    """At the guess of the cycle, which is close; Newton's iteration takes seconds."""

    def guessed(cycle, samples):
        orbit = SimpleNamespace(x_minus=cycle.guess, residual=0.0)
        return SimpleNamespace(orbit=orbit, table=SimpleNamespace(text=str))

    monkeypatch.setattr("biped_adrc.studies.cycle_stability.cycle_stability", guessed)
    values = ("--set", "friction_limit=0.3", "--set", "force_window=0.02", "--set", "seed=5")
    found = CliRunner().invoke(app, ["poincare", *values])
    said = " ".join(found.output.split())
    assert found.exit_code == 0
    assert re.search(r"mean of 20 ms .*, limit 0\.3; not legal: .*> 0\.3 over 20 ms", said)
    assert "note: seed = 5 does nothing: nothing in this walk is random" in said


def test_the_pitch_sensors_noise_is_named_apart_and_drawn_apart():
    """Encoders' noise and the sensor's own, each by a stream of its own, so that they are independent."""
    s = ba.Scenario(
        "NPD", period=1e-3, noise=1e-4, sensor="pitch sensor", own={"sensor_noise": 2e-3}
    )
    encoders, pitch = build(s).sensors.parts
    assert (encoders.noise, pitch.noise) == (1e-4, 2e-3)
    assert encoders.seed != pitch.seed
