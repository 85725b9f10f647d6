"""What a scenario's numbers become: start, plant, hardware, and the columns of its walk.

build(scenario) makes the walker; RobotAndGait.of(scenario) has its robot, gait and start; plant_of makes the
robot with model errors.
"""

from __future__ import annotations

import math
import operator
import re
from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.cli.options import scenario_from
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.core.registry import REGISTRY, takes
from biped_adrc.model.ground import StepDown, StepUp
from biped_adrc.scenario.build import RobotAndGait, build, plant_of
from biped_adrc.scenario.controllers import ControllerRecord
from biped_adrc.scenario.cycle import cycle_of, specification_of
from biped_adrc.scenario.integration import WalkPart, methods_of, refined
from biped_adrc.scenario.push import Push
from biped_adrc.scenario.scenario import Scenario, drawn, read_scenario
from biped_adrc.scenario.units import unit_of
from biped_adrc.scenario.walk import halved, walk_scenario
from biped_adrc.studies.run import run_trials


def drawn_start(seed: int, **values: object) -> np.ndarray:
    """Angles and rates (10,) with which the walk of a seed starts; its speed is spread by 2 % unless said."""
    s = Scenario(run={"seed": seed}, **{"start.speed_spread": 0.02, **values})
    return np.concatenate(RobotAndGait.of(s).start(s))


@pytest.mark.parametrize("name", ["start.speed_spread", "start.spread", "start.rate_spread"])
def test_every_seed_has_its_own_start_which_all_controllers_share(name: str) -> None:
    """name: what is spread, by 2 % or 0.02 rad, rad/s. Six seeds give six starts, and a seed gives the same one
    with another controller, so that controllers can be compared pair by pair.
    """
    values = {"start.speed_spread": 0.0, name: 0.02}
    starts = np.array([drawn_start(seed, **values) for seed in range(6)])
    assert len(np.unique(starts.round(12), axis=0)) == 6
    np.testing.assert_array_equal(drawn_start(3, controller="NPD", **values), starts[3])


def test_the_speed_of_the_start_is_the_last_number_drawn() -> None:
    """Rates are those of the orbit times 1 + 0.1 (speed) + 0.02 (spread) times the last normal number, which
    comes after those of n angles and n rates: so a spread of these changes no speed.
    """
    s = Scenario(run={"seed": 3}, start={"speed": 0.1, "speed_spread": 0.02})
    scene = RobotAndGait.of(s)
    q, v = scene.on_orbit
    *_, last = np.random.default_rng(drawn(s, "start")).standard_normal(len(q) + len(v) + 1)
    np.testing.assert_allclose(scene.start(s)[1], v * (1.1 + 0.02 * last), rtol=1e-15)


def test_the_load_of_the_trunk_is_a_share_of_its_mass() -> None:
    """A load of 0.3 adds 0.3 of the torso's mass to the robot."""
    biped = ba.Biped.load("rabbit")
    torso = biped.tree.links[biped.description.trunk].inertial.mass
    loaded = plant_of(Scenario(errors={"trunk_load": 0.3}), biped)
    assert loaded.mass - biped.mass == pytest.approx(0.3 * torso, rel=1e-12)


def test_an_error_of_friction_is_the_same_in_all_joints() -> None:
    """-0.5 halves the friction torque of every joint; on a robot without friction the error is refused."""
    rubbing = ba.Biped.load("rabbit", friction=True)
    halved, v = plant_of(Scenario(errors={"friction": -0.5}), rubbing), np.linspace(-1.0, 1.0, 5)
    assert halved.friction_torque(v) == pytest.approx(0.5 * rubbing.friction_torque(v), rel=1e-12)
    with pytest.raises(ba.BipedError, match="friction=True"):
        plant_of(Scenario(errors={"friction": -0.5}), ba.Biped.load("rabbit"))


def test_rabbit_s_hardware_is_what_was_published_for_it() -> None:
    """Period 1.5 ms, 8192 counts, rates by differences, 150 N m, and joints that rub: at +0.3 rad/s each of the
    four motor joints is braked.
    """
    s = Scenario(hardware="rabbit")
    h = s.hardware
    found = (h.period, h.encoders.counts, h.encoders.velocity, h.torque_limit, h.friction)
    assert found == (1.5e-3, 8192.0, "differences", 150.0, True)
    rubbing = RobotAndGait.of(s).biped.friction_torque(np.full(5, 0.3))
    assert np.all(rubbing[:4] < 0.0)


def test_the_columns_of_a_walk_are_means_over_ticks_and_joints() -> None:
    """rms values of a row against the trapezoid rule over the stored nodes of the same walk, which lie on the
    ticks; a mean over ticks and one by trapezoids are not the same, hence 5 %, and 1 % for the outcome's.
    Distance, speeds and work by their definitions. A walk that starts at 1e4 rad/s ends at once: no speed, no
    cost.
    """
    values = {
        "controller.name": "NPD",
        "run.impacts": 3,
        "hardware.period": 1e-3,
        "start.speed": 0.05,
    }
    row, ended = run_trials([values, values | {"start.v5": 1e4}])
    walked = ("status", "impacts", "distance", "speed", "last_speed", "cost_of_transport")
    assert [ended[x] for x in walked] == ["RAN_AWAY", 0, 0.0, None, None, None]
    s = Scenario(**values)
    walk, scene = walk_scenario(s), RobotAndGait.of(s)
    signals, gait = walk.signals, scene.walked
    for name, of in (("rms_error", signals.error), ("rms_torque", signals.u)):
        mean = np.trapezoid(np.mean(of**2, axis=1), signals.t) / np.ptp(signals.t)
        assert row[name] == pytest.approx(np.sqrt(mean), rel=0.05)
    mean = np.trapezoid(np.mean(signals.error**2, axis=1), signals.t) / np.ptp(signals.t)
    assert walk.outcome.rms_error == pytest.approx(np.sqrt(mean), rel=0.01)
    lengths = [c.step_length for c in walk.certificates]
    assert row["distance"] == pytest.approx(sum(lengths), rel=1e-6)
    usual = scene.biped.swing_foot(gait.q_minus)[0] / gait.period
    speed = sum(lengths) / sum(c.duration for c in walk.certificates)
    assert row["speed"] == pytest.approx(speed, rel=1e-6)
    last = sum(lengths[1:]) / sum(c.duration for c in walk.certificates[1:])
    assert row["last_speed"] == pytest.approx(last, rel=1e-6)
    m_g_L = scene.biped.mass * 9.81 * row["distance"]
    assert row["cost_of_transport"] == pytest.approx(row["work"] / m_g_L, rel=1e-12)
    assert row["speed_change"] == pytest.approx((speed - usual) / usual, abs=1e-6)


@pytest.mark.parametrize(
    ("said", "idle", "with_effect"),
    [
        ("hardware.delay", {"hardware.delay": 1e-3}, {"hardware.period": 1e-3}),
        ("observer.order", {"controller.observer": {"poles": (-1, -2), "order": 0}}, None),
        ("pushes.0.step", {"pushes": "q1=3@30:0-0.1"}, {"run.impacts": 30}),
    ],
)
def test_a_value_that_cannot_act_is_refused(said, idle, with_effect) -> None:
    """idle: a value that can have no effect, as a delay without a clock; said: its name in the error.
    with_effect: the value beside it with which it acts; None where there is none. The scenario with both equals
    that of its own record; no walker is built of it.
    """
    with pytest.raises(ba.BipedError, match=said):
        build(Scenario(**idle))
    if with_effect is not None:
        s = Scenario(**idle | with_effect)
        assert Scenario(**s.record()) == s


@pytest.mark.parametrize(
    ("name", "text", "number"),
    [
        ("hardware.period", "1.5 ms", 0.0015),
        ("controller.observer.bandwidth", "3 krad/s", 3000.0),
        ("start.q5", "90 deg", math.pi / 2),
        ("pushes.0.torque", "30 Nm", 30.0),
        ("controller.K_p", "3000 1/s^2", 3000.0),
        ("controller.K_d", "0.1 1/ms", 100.0),
        ("errors.mass.torso", "10 %", 0.1),
        ("run.impacts", "8", 8),
    ],
)
def test_a_number_may_have_a_unit_wherever_it_is_given(name, text, number, tmp_path) -> None:
    """A text with a unit is the SI number, in Python, in a scenario file and on the command line."""
    by_text, by_number = Scenario(**{name: text}), Scenario(**{name: number})
    assert by_text == by_number
    assert by_text.dotted()[name] == pytest.approx(number, rel=1e-15)
    file = tmp_path / "walk.toml"
    file.write_text(f'{name} = "{text}"\n')
    assert read_scenario(file) == by_text
    assert scenario_from({}, [f"{name}={text}"]) == by_text


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"bandwidth": 3.0}, "did you mean 'controller.observer.bandwidth'"),
        ({"hardware": {"perod": 1e-3}}, "hardware.perod: .* 'hardware.period'"),
        ({"hardware.period": "1 m"}, "'m' is another dimension, expected a unit such as 's'"),
        ({"hardware.period": "1e999"}, "too large"),
        ({"controller.K_p": -1.0}, "controller.K_p: found -1.0, expected > 0"),
        ({"run.impacts": True}, "run.impacts: found True, expected a whole number"),
        ({"pushes.0.shape": "puls"}, "pushes.0.shape: .*did you mean 'pulse'"),
        ({"controller": {"observr": {"order": 1}}}, "controller.observr: unknown name"),
        ({"start.q": 1.0}, "start.q: expected"),
        ({"run.method": "rk5"}, "found 'rk5', expected rk4 or"),
        ({"hardware": 5}, "hardware: found 5"),
        ({"run": 5}, "run: found 5"),
        ({"run": {"method": "adaptive", "h": 1e-3}}, "run.h: is 0.001 s, and 'adaptive' chooses"),
        # `fine` is a step too, and the message is that of h
        (
            {"run": {"method": "adaptive", "fine": 1e-3}},
            "run.h: is 0.001 s, and 'adaptive' chooses",
        ),
    ],
)
def test_wrong_values_of_a_scenario_are_refused_by_name(values, message) -> None:
    with pytest.raises(ba.BipedError, match=message):
        Scenario(**values)


@pytest.mark.parametrize(
    ("controller", "number"),
    [
        ({"name": "PD", "K_p": "3 kN m/rad"}, 3000.0),
        ({"name": "super twisting", "slope": "0.05 1/ms"}, 50.0),
        ({"name": "foot barrier", "tolerance": "3 mm"}, 3e-3),
        ({"name": "stride PI", "inner": {"name": "PD", "K_d": "250 N m s/rad"}}, 250.0),
        # a class of one's own, which is not imported here: any unit is taken
        ({"name": "my_law:Mine", "width": "3 mm"}, 3e-3),
        ({"name": "NPD", "K_p": "4900 ms"}, None),
        ({"name": "NPD", "K_p": "4900 N m"}, None),
        ({"name": "NPD", "K_p": "4900 N m/rad"}, None),
        ({"name": "NPD", "K_d": "140 deg"}, None),
        ({"name": "PD", "K_p": "4900 1/s^2"}, None),
        ({"name": "npid", "K_i": "5e4 1/s^2"}, None),
        ({"name": "foot barrier", "tolerance": "3 ms"}, None),
        ({"observer": {"name": "Kalman", "drift": "3 rad/s"}}, None),
        ({"feedforward": "1 s"}, None),
    ],
)
def test_a_gain_has_the_unit_of_its_law_and_no_other(controller, number) -> None:
    """The last value of each controller is a gain; number: what it is in SI units, by the law's own dimension
    (PD: N m/rad, NPD: 1/s^2). None: its unit is of another dimension, and it is refused.
    """
    if number is None:
        with pytest.raises(ba.BipedError, match=r"found .*, expected a (unit|number)"):
            Scenario(controller)
    else:
        assert [*Scenario(controller).dotted().values()][-1] == pytest.approx(number, rel=1e-15)


def test_a_whole_number_takes_no_unit() -> None:
    """run.impacts counts: a time, a share and an angle are refused."""
    for text in ("8 ms", "8 %", "8 rad"):
        with pytest.raises(ba.BipedError, match=r"run.impacts: found .* without a unit"):
            Scenario(run={"impacts": text})


FROM_THE_SCENARIO = {
    *("period", "gait", "biped", "reference", "torque_limit", "stones", "prediction", "feedforward")
}
"""Values that reach a part from fields of the scenario, which have their own units."""


def test_each_number_of_a_packaged_part_has_a_unit() -> None:
    """A unit is given for every number that a controller, contact, sensor or touchdown takes, and for nothing
    else. Shapes of pushes are not looked at: their numbers are fields of `Push`, which has units.
    """
    for kind in ("controller", "contact", "sensor", "touchdown"):
        for name, entry in REGISTRY[kind].items():
            # K_p and K_d are no arguments of their own, but numbers of the argument `gains`
            assert not set(entry.units) - {"K_p", "K_d"} - set(takes(entry.load())), name
            for value, parameter in takes(entry.load()).items():
                number = re.search("loat", str(parameter.annotation))  # float, PositiveFloat, ..
                # a contact's window is a field of the scenario, with a unit there
                if (
                    number
                    and value not in FROM_THE_SCENARIO
                    and (kind, value) != ("contact", "window")
                ):
                    assert value in entry.units, (name, value)
                    unit_of(entry.units[value] or "1")


def test_every_value_has_a_text_a_unit_and_a_default_that_changes_nothing() -> None:
    """A scenario with one value set to the default that is printed for it is the scenario without it. Units are
    asked for where the value may be a number; pushes and inner controllers begin with none, so they have no
    such default.
    """
    for name in Scenario.names():
        what = Scenario.field_of(name)
        if {float, tuple, dict} & set(what.types) and name != "pushes":
            unit_of(what.unit)
        assert what.text, name
        if not name.startswith(("pushes", "controller.inner")):
            assert Scenario(**{name: what.default}) == Scenario()


PERIOD = 0.4164
"""[s] of the published gait."""
TICKS = {"hardware.period": 1e-3}
HIGH = {"link": "torso", "force": 10.0, "direction": math.pi / 2, "onset": 0.1}
LATE = {"shape": "noise", "torque": 2.0, "joints": "q1", "step": 4, "onset": 0.1}


@pytest.mark.parametrize(
    ("values", "name", "expected"),
    [
        ({**TICKS, "hardware.lag": 2e-3}, "motors", ba.Motors(None, 2e-3)),
        ({**TICKS, "hardware.rate_limit": 3e4}, "motors", ba.Motors(3e4, 0.0)),
        ({**TICKS, "hardware.delay": 2e-3}, "timing", ba.SampledTime(1e-3, True, 2e-3, False)),
        ({**TICKS, "hardware.touchdown": "force"}, "timing", ba.SampledTime(1e-3, False)),
        ({"pushes": "q1,-q5=3@4:0.1-0.3"}, "disturbance.amplitude", (3, 0, 0, 0, -3)),
        ({"pushes": "q1=3@4:0.1-0.3"}, "disturbance.step", 4),
        ({"pushes": "q1=3@4:0.1-0.3"}, "disturbance.stop", 0.3),
        ({"pushes": [HIGH]}, "disturbance.wave.amplitude", (0, 10, 0)),
        (
            {"pushes": [LATE | {"across_impacts": True}], "run.first_step": 2},
            "disturbance.start",
            2 * PERIOD + 0.1,
        ),
        (
            {"pushes": [LATE | {"across_impacts": True}], "run.first_step": 2},
            "disturbance.stop",
            2 * PERIOD + 0.3,
        ),
        ({"pushes": [LATE | {"across_impacts": False}]}, "disturbance.start", 0.1),
        ({"ground.drop": 0.01, "ground.drop_step": 2}, "ground_steps", (StepDown(2, 0.01),)),
        ({"ground.drop": -0.01}, "ground_steps", (StepUp(3, 0.01),)),
        ({"ground.stones": [0.4, 0.3], "ground.stone_tolerance": 0.02}, "stones.tolerance", 0.02),
        ({"run.max_step_time": 3.0}, "max_step_time", 3.0),
        ({"run.runaway_speed": 3.0}, "runaway_speed", 3.0),
        ({"run.runaway_torque": 3.0}, "runaway_torque", 3.0),
        ({"hardware.torque_limit": 90.0}, "torque_limit", 90.0),
    ],
)
def test_each_value_is_that_of_a_part_of_the_walker(values, name, expected) -> None:
    """name: the attribute of the built walker in which the values of a scenario have to arrive; expected: what
    it is then. Noise across impacts begins two periods of the gait later in the walk's time, hence PERIOD.
    """
    found = operator.attrgetter(name)(build(Scenario("NPD", **values)))
    if isinstance(expected, tuple | float) and name != "ground_steps":
        # rtol: PERIOD has four digits
        np.testing.assert_allclose(found, expected, rtol=1e-4, atol=1e-12)
    else:
        assert found == expected


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"ground.friction": 0.1}, "ground.friction: is of soft ground; give ground.plant too"),
        ({"controller.contact.window": 0.01}, "window: is that of a policy; give its name too"),
        (
            {"hardware.period": 1e-3, "hardware.encoders.filter_time": 1e-3},
            'encoders.filter_time: acts on velocity = "differences" or "gyro" only',
        ),
    ],
)
def test_a_value_that_would_do_nothing_is_refused(values, message) -> None:
    with pytest.raises(ba.BipedError, match=message):
        Scenario("NPD", **values)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"pushes": "q1=3@6:0-0.1"}, "pushes.0.step: is 6, the walk has 2 to 5"),
        ({"pushes": "q1=3@1:0-0.1"}, "pushes.0.step: is 1, the walk has 2 to 5"),
        (
            {"pushes": [{"force": 3.0}]},
            "pushes.0.force: the push 'pulse' is a torque; name the link",
        ),
        (
            {"pushes": [LATE | {"rise": 0.1}]},
            "pushes.0.rise: the push 'noise' has no edges; only a",
        ),
        (
            {"pushes": [{"shape": "hip force", "torque": 3.0}]},
            "torque: .*'hip force' takes no torque",
        ),
        (
            {"pushes": [{"shape": "hip force", "force": 3.0, "step": 4}]},
            "pushes.0.step: the push 'hip force' acts all the time; give steps",
        ),
        (
            {"pushes": [{"shape": "hip force", "force": 3.0, "duration": 0.3}]},
            "pushes.0.duration: the push 'hip force' acts all the time",
        ),
        # no push: a controller without torque on a robot with motors
        ({"controller": "passive"}, "'passive' does not fit robot 'rabbit' with 4 motors"),
    ],
)
def test_a_push_that_cannot_act_is_refused(values, message) -> None:
    """The walk has single supports 2 to 5, and pushes in 2 and 5, or without an end, are taken; each of the
    others is refused with the reason.
    """
    run = {"run.first_step": 2, "run.impacts": 4}
    held = [
        {"shape": "hip force", "force": 3.0}
    ]  # all the time, also in a walk shorter than the default step
    for fits in ("q1=3@2:0-0.1", "q1=3@5:0-0.1", "q1=3@1:0.1-", held):
        build(Scenario("NPD", pushes=fits, **run))
    build(Scenario("NPD", pushes=held, run={"impacts": 1}))
    with pytest.raises(ba.BipedError, match=message):
        build(Scenario(**{"controller": "NPD"} | run | values))


def test_a_robot_without_motors_stalls_when_a_step_takes_too_long() -> None:
    """A step of the compass takes 0.734 s; 2 s is the default."""
    walk = ba.walk_scenario(Scenario("passive", robot="compass", run={"max_step_time": 0.1}))
    assert walk.trajectory.status is ba.Status.STALLED


RANGES = """
controller.K_p none >0 1/s^2; controller.K_d none >0 1/s; controller.observer.bandwidth none >0
<=1e+06 rad/s; controller.observer.order none >=0 <=12; controller.contact.window none >=0 <=1 s;
controller.prediction 0 >=0 <=0.1 s; controller.feedforward 0 >=0 <=2 1; hardware.period none
>=1e-05 <=0.1 s; hardware.delay 0 >=0 <=1 s; hardware.encoders.counts none >=1 1;
hardware.encoders.noise 0 >=0 <=1 rad; hardware.encoders.pitch_noise 0 >=0 <=1 rad;
hardware.encoders.rate_noise 0 >=0 <=100 rad/s; hardware.encoders.filter_time 0 >=0 <=1 s;
hardware.encoders.angle_filter 0 >=0 <=1 s;
hardware.torque_limit none >0 N m; hardware.rate_limit none >0 N m/s; hardware.lag 0 >=0 <=1 s;
pushes.0.force 0 >=0 <=100000 N; pushes.0.direction 0 >=-7 <=7 rad; pushes.0.step 3 >=1 <=100000;
pushes.0.onset none >=0 <=100 s; pushes.0.duration 0.2 >0 <=100 s; pushes.0.rise 0 >=0 <=10 s;
pushes.0.frequency 5 >0 <=1000 Hz; errors.mass_width 0 >=0 <1 1; errors.com_width 0 >=0 <1 1;
errors.inertia_width 0 >=0 <1 1; errors.friction_width 0 >=0 <1 1; errors.trunk_load 0 >-1 <=10 1;
errors.friction 0 >=-1 <=10 1; errors.impact_width 0 >=0 <1 1; ground.friction 0.6 >0 <=10 1;
ground.time_constant 0.002 >=1e-05 <=1 s; ground.damping_ratio 1 >0 <=100 1; ground.plant_step none
>=1e-06 <=0.01 s; ground.slope none >=-0.5 <=0.5 rad; ground.drop 0 >=-0.2 <=0.2 m; ground.drop_step
3 >=1 <=100000; ground.rms 0 >=0 <=0.1 m; ground.step_height 0 >=0 <=0.1 m; ground.stone_tolerance
0.025 >0 <=1 m; start.speed 0 >-1 <=2 1; start.speed_spread 0 >=0 <=1 1; start.spread 0 >=0 <=1 rad;
start.rate_spread 0 >=0 <=10 rad/s; limits.friction none >0 <=1 1; limits.window 0.005 >0 <=0.1 s;
run.impacts 25 >=1 <=10000; run.first_step 1 >=1 <=100000; run.seed 0 >=0 <=9.22337e+18; run.h none
>=1e-06 <=0.1 s; run.fine none >=1e-06 <=0.1 s; run.tolerance 1e-09 >0 <=1 1; run.max_step_time 2 >0
<=100 s; run.runaway_speed 20 >0 <=1e+09 1; run.runaway_torque 1000 >0 <=1e+09 1
"""
"""Of each number with a range: its default, the range and the unit."""
SIGNS = {"gt": ">", "ge": ">=", "lt": "<", "le": "<="}


def test_numbers_have_these_defaults_and_ranges() -> None:
    """RANGES, written by hand above, has for each number of a scenario that is bounded: name, default, limits
    and unit. A change of any of them shows here.
    """
    texts = []
    for what in map(Scenario.field_of, Scenario.names()):
        usual = "none" if what.default is None else what.default
        usual = usual if isinstance(usual, str | tuple | dict) else f"{usual:g}"
        limits = [f"{SIGNS[kind]}{x:g}" for kind, x in what.limits]
        texts += [" ".join(filter(None, (what.name, usual, *limits, what.unit)))] if limits else []
    assert "; ".join(texts).split() == RANGES.split()


def test_a_gait_of_another_robot_is_refused_unless_it_is_asked_for(tmp_path) -> None:
    """The gait's file names the preset "identified"; the scenario's robot is "tac2003"."""
    gait = ba.load_gait("published", ba.Biped.load("rabbit"))
    path = tmp_path / "gait.json"
    gait.save(path)
    s = Scenario(robot={"preset": "tac2003"}, gait=str(path))
    with pytest.raises(ba.BipedError, match="made for robot 'rabbit', preset 'identified'"):
        RobotAndGait.of(s)
    assert RobotAndGait.of(s.replace({"gait.other_robot": True})).gait.preset == "identified"


NOTICED = {"hardware": {"profile": "rabbit", "touchdown": {"name": "kinematics"}}}
FINE = {"pushes": "q1=3@2:0.1-0.3", "run": {"fine": 1e-4, "h": 1e-3, "impacts": 6}}


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: build(Scenario({"inner": "PD"})), r"controller.inner: .*'ADRC' is no outer loop"),
        (
            lambda: build(Scenario({"name": "footstep", "contact": "hold"})),
            r"controller.contact.name: .*'footstep' is an outer loop; write controller.inner.contact.name",
        ),
        (
            lambda: build(Scenario({"name": "reference reset", "prediction": 2e-3})),
            r"controller.prediction: .* write controller.inner.prediction",
        ),
        (
            lambda: cycle_of(Scenario(start={"speed": 0.1})),
            "return map takes no start.speed; leave",
        ),
        (lambda: specification_of(Scenario(ground="mujoco")), "'mujoco', expected 'rigid'"),
        # fine steps make three parts of the walk; a clock with a touchdown detector does not restart
        (
            lambda: walk_scenario(Scenario(**NOTICED, **FINE)),
            "of 3 parts needs a clock that restarts",
        ),
        (lambda: walk_scenario(Scenario(start={"q5": 6.8})), "rad, beyond a whole turn; give np"),
        (lambda: Scenario.field_of("limits"), "is a record; name a value, as limits.friction"),
    ],
)
def test_what_has_no_meaning_is_refused(call, message) -> None:
    """Values that are right alone and contradict one another, or the function that is called with them."""
    with pytest.raises(ba.BipedError, match=message):
        call()


def test_a_scenario_is_the_same_by_records_by_names_and_by_numpy() -> None:
    """A push or a controller by its record, by a text or by dotted names, and numbers of NumPy, which become
    Python's: equal scenarios.
    """
    push = Push(joints="q1", torque=3.0, step=1, onset=0.1)
    assert Scenario(pushes=push) == Scenario(pushes="q1=3@1:0.1-0.3")
    law, bandwidth = ControllerRecord(name="LESO"), {"controller.observer.bandwidth": 3.0}
    assert Scenario(law, **bandwidth) == Scenario("LESO").replace(bandwidth)
    plain, of_numpy = (
        Scenario(**{"controller.observer.poles": poles, "run.seed": seed})
        for poles, seed in (((-1.0, -2.0), 3), (np.array([-1.0, -2.0]), np.int64(3)))
    )
    assert of_numpy.dotted() == plain.dotted()
    assert type(of_numpy.run.seed) is int


@pytest.mark.parametrize(
    ("joints", "values", "text"),
    [
        (
            "q1, -q2,q3",
            {"rise": 0.01},
            "q1, q3 and -2 N m on q2 from 0.1 to 0.3 s{}, each edge taking 0.01 s",
        ),
        ("q1", {"shape": "step"}, "q1 from 0.1 s on{}"),
        ("q1", {"shape": "sine", "frequency": 3.0}, "q1, a sine of 3 Hz, from 0.1 to 0.3 s{}"),
    ],
)
def test_a_push_is_said_in_words(joints, values, text) -> None:
    """{} in `text` is where the words name the single support; a force on a link has no words and is shown by
    its values.
    """
    push = Push(joints=joints, torque=2.0, step=4, onset=0.1, **values)
    assert push.in_words() == "2 N m on " + text.format(" in single support 4")
    push = Push(link="torso", force=3.0, step=1, onset=0.0)
    assert push.in_words() == "Push(force=3.0, link='torso', step=1, onset=0.0)"


def test_the_method_of_a_walk_and_where_its_steps_are_fine() -> None:
    """The rows have the integration method by controller, clock and engine, and the step `fine` [s] beside the
    edges of a push. The push is in single support 3 of 6: fine in it and in the next, with the usual method in
    two before and two after.
    """
    push = "q1=3@3:0.1-0.3"
    for values, method, fine in (
        ({"controller": "NPD"}, ba.RK4(1e-3), None),
        ({"controller": "NPD", "hardware": "rabbit"}, ba.RK4(2.5e-4), None),
        ({"controller": "ADRC"}, ba.Exponential(5e-4), 5e-5),
        ({"controller": "ADRC", "run.engine": "pinocchio"}, ba.Exponential(5e-4), None),
        ({"controller": "ADRC", "run.h": 2e-3}, ba.Exponential(2e-3), None),
        ({"controller": "ADRC", "run.fine": 2e-4}, ba.Exponential(5e-4), 2e-4),
    ):
        s = Scenario(**values, pushes=push)
        walker = build(s)
        assert methods_of(s.run, walker) == (method, fine)
        twice, parts = WalkPart(2, method), (WalkPart(6, method),)
        if fine is not None:
            parts = twice, WalkPart(2, replace(method, h=fine)), twice
        assert refined(walker, 6, 1, method, fine) == parts


@pytest.mark.parametrize("method", ["adaptive", None])
def test_half_a_step_is_half_or_a_hundredth_of_the_tolerance(method) -> None:
    """The scenario that estimates the error of integration: both steps halved, or, for the adaptive method,
    which has no step to halve, a hundredth of the tolerance.
    """
    by_step = {"h": 1e-3, "fine": 1e-4}, {"h": 5e-4, "fine": 5e-5}
    by_tolerance = {"tolerance": 1e-6, "method": method}, {"tolerance": 1e-8, "method": "adaptive"}
    run, half = by_tolerance if method else by_step
    s = Scenario("NPD", run={"engine": "pinocchio", **run})
    assert halved(s, build(s)).run.record() == half


def test_a_class_and_its_name_have_the_same_settings() -> None:
    """The controller by its name in a scenario equals that of its class without arguments: both have defaults
    of their own, which have to agree.
    """
    scene = RobotAndGait.of(Scenario("DOB"))
    named = build(Scenario("DOB"), scene).controller
    assert named == MomentumDOBController(scene.gait.constraint)


@pytest.mark.parametrize("name", ["q5", "v2"])
def test_an_angle_or_rate_of_the_start_is_added(name: str) -> None:
    """start.q5 adds to angle 5 alone, start.v2 to rate 2 alone, whatever the start is without it."""
    usual, moved = (Scenario(start=x) for x in ({}, {name: 0.01}))
    scene = RobotAndGait.of(usual)
    change = np.array(scene.start(moved)) - np.array(scene.start(usual))
    expected = np.zeros((2, 5))
    expected["qv".index(name[0]), int(name[1]) - 1] = 0.01
    assert change == pytest.approx(expected, abs=1e-15)
