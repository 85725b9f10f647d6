"""What a scenario's numbers become: start, plant, hardware, and the columns of its walk."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.cli.options import scenario_from
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.core.registry import REGISTRY, takes
from biped_adrc.scenario.build import RobotAndGait, build, plant_of
from biped_adrc.scenario.scenario import Scenario, drawn, read_scenario
from biped_adrc.scenario.units import unit_of
from biped_adrc.scenario.walk import walk_scenario
from biped_adrc.studies.run import run_trials


def drawn_start(seed: int, **values: object) -> np.ndarray:
    """Angles and rates (10,) with which the walk of a seed starts; its speed is spread by 2 % unless said."""
    s = Scenario(run={"seed": seed}, **{"start.speed_spread": 0.02, **values})
    return np.concatenate(RobotAndGait.of(s).start(s))


@pytest.mark.parametrize("name", ["start.speed_spread", "start.spread", "start.rate_spread"])
def test_every_seed_has_its_own_start_which_all_controllers_share(name: str) -> None:
    values = {"start.speed_spread": 0.0, name: 0.02}
    starts = np.array([drawn_start(seed, **values) for seed in range(6)])
    assert len(np.unique(starts.round(12), axis=0)) == 6
    np.testing.assert_array_equal(drawn_start(3, controller="NPD", **values), starts[3])


def test_the_speed_of_the_start_is_the_last_number_drawn() -> None:
    s = Scenario(run={"seed": 3}, start={"speed": 0.1, "speed_spread": 0.02})
    scene = RobotAndGait.of(s)
    q, v = scene.on_orbit
    *_, last = np.random.default_rng(drawn(s, "start")).standard_normal(len(q) + len(v) + 1)
    np.testing.assert_allclose(scene.start(s)[1], v * (1.1 + 0.02 * last), rtol=1e-15)


def test_the_load_of_the_trunk_is_a_share_of_its_mass() -> None:
    biped = ba.Biped.load("rabbit")
    torso = biped.tree.links[biped.description.trunk].inertial.mass
    loaded = plant_of(Scenario(errors={"trunk_load": 0.3}), biped)
    assert loaded.mass - biped.mass == pytest.approx(0.3 * torso, rel=1e-12)


def test_an_error_of_friction_is_the_same_in_all_joints() -> None:
    rubbing = ba.Biped.load("rabbit", friction=True)
    halved, v = plant_of(Scenario(errors={"friction": -0.5}), rubbing), np.linspace(-1.0, 1.0, 5)
    assert halved.friction_torque(v) == pytest.approx(0.5 * rubbing.friction_torque(v), rel=1e-12)
    with pytest.raises(ba.BipedError, match="friction=True"):
        plant_of(Scenario(errors={"friction": -0.5}), ba.Biped.load("rabbit"))


def test_rabbit_s_hardware_is_what_was_published_for_it() -> None:
    s = Scenario(hardware="rabbit")
    h = s.hardware
    found = (h.period, h.encoders.counts, h.encoders.velocity, h.torque_limit, h.friction)
    assert found == (1.5e-3, 8192.0, "differences", 150.0, True)
    rubbing = RobotAndGait.of(s).biped.friction_torque(np.full(5, 0.3))
    assert np.all(rubbing[:4] < 0.0)


def test_the_columns_of_a_walk_are_means_over_ticks_and_joints() -> None:
    """Against the trapezoid rule over the stored nodes of the same walk, which lie on the ticks.

    A mean over ticks and one by trapezoids are not the same: hence 5 %, and 1 % for the outcome's.
    """
    values = {
        "controller.name": "NPD",
        "run.impacts": 2,
        "hardware.period": 1e-3,
        "start.speed": 0.05,
    }
    row = run_trials([values])[0]
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
    """And is taken with the value beside it that lets it act: no delay without a clock, for example."""
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
    if number is None:
        with pytest.raises(ba.BipedError, match=r"found .*, expected a (unit|number)"):
            Scenario(controller)
    else:
        assert [*Scenario(controller).dotted().values()][-1] == pytest.approx(number, rel=1e-15)


def test_a_whole_number_takes_no_unit() -> None:
    for text in ("8 ms", "8 %", "8 rad"):
        with pytest.raises(ba.BipedError, match=r"run.impacts: found .* without a unit"):
            Scenario(run={"impacts": text})


FROM_THE_SCENARIO = {
    *("period", "gait", "biped", "reference", "torque_limit", "stones", "prediction", "feedforward")
}
"""Values that reach a part from fields of the scenario, which have their own units."""


def test_each_number_of_a_packaged_part_has_a_unit() -> None:
    """A unit is given for every number that the part takes, and for nothing else.

    Shapes of pushes are not looked at: their numbers are fields of `Push`, which has units.
    """
    for kind in ("controller", "contact", "sensor", "touchdown"):
        for name, entry in REGISTRY[kind].items():
            assert not set(entry.units) - {"K_p", "K_d"} - set(takes(entry.load())), name
            for value, parameter in takes(entry.load()).items():
                number = re.search("loat", str(parameter.annotation))
                if (
                    number
                    and value not in FROM_THE_SCENARIO
                    and (kind, value) != ("contact", "window")
                ):
                    assert value in entry.units, (name, value)
                    unit_of(entry.units[value] or "1")


def test_every_value_has_a_text_a_unit_and_a_default_that_changes_nothing() -> None:
    for name in Scenario.names():
        what = Scenario.field_of(name)
        if {float, tuple, dict} & set(what.types) and name != "pushes":
            unit_of(what.unit)
        assert what.text, name
        if not name.startswith(("pushes", "controller.inner")):
            assert Scenario(**{name: what.default}) == Scenario()


def test_a_gait_of_another_robot_is_refused_unless_it_is_asked_for(tmp_path) -> None:
    gait = ba.load_gait("published", ba.Biped.load("rabbit"))
    path = tmp_path / "gait.json"
    gait.save(path)
    s = Scenario(robot={"preset": "tac2003"}, gait=str(path))
    with pytest.raises(ba.BipedError, match="made for robot 'rabbit', preset 'identified'"):
        RobotAndGait.of(s)
    assert RobotAndGait.of(s.replace({"gait.other_robot": True})).gait.preset == "identified"


def test_a_class_and_its_name_have_the_same_settings() -> None:
    """Each writes down its defaults, and they have to agree."""
    scene = RobotAndGait.of(Scenario("DOB"))
    named = build(Scenario("DOB"), scene).controller
    assert named == MomentumDOBController(scene.gait.constraint)


@pytest.mark.parametrize("name", ["q5", "v2"])
def test_an_angle_or_rate_of_the_start_is_added(name: str) -> None:
    usual, moved = (Scenario(start=x) for x in ({}, {name: 0.01}))
    scene = RobotAndGait.of(usual)
    change = np.array(scene.start(moved)) - np.array(scene.start(usual))
    expected = np.zeros((2, 5))
    expected["qv".index(name[0]), int(name[1]) - 1] = 0.01
    assert change == pytest.approx(expected, abs=1e-15)
