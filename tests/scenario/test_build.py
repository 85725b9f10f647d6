"""What a scenario's numbers become: start, plant, hardware, and the columns of its walk."""

from __future__ import annotations

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.scenario.build import RobotAndGait, build, plant_of, start
from biped_adrc.scenario.run import walk_scenario
from biped_adrc.scenario.scenario import Scenario, drawn
from biped_adrc.study.run import run_trial


def drawn_start(seed: int, **values: object) -> np.ndarray:
    s = Scenario(seed=seed, **{"start_speed_spread": 0.02, **values})
    return np.concatenate(start(s, RobotAndGait.of(s)))


@pytest.mark.parametrize("name", ["start_speed_spread", "start_spread", "start_rate_spread"])
def test_every_seed_has_its_own_start_which_all_controllers_share(name: str) -> None:
    values = {"start_speed_spread": 0.0, name: 0.02}
    starts = np.array([drawn_start(seed, **values) for seed in range(6)])
    assert len(np.unique(starts.round(12), axis=0)) == 6
    np.testing.assert_array_equal(drawn_start(3, controller="NPD", **values), starts[3])


def test_the_speed_of_the_start_is_the_last_number_drawn() -> None:
    s = Scenario(seed=3, start_speed=0.1, start_speed_spread=0.02)
    scene = RobotAndGait.of(s)
    q, v = scene.on_orbit
    *_, last = np.random.default_rng(drawn(s, "start")).standard_normal(len(q) + len(v) + 1)
    np.testing.assert_allclose(start(s, scene)[1], v * (1.1 + 0.02 * last), rtol=1e-15)


def test_the_load_of_the_trunk_is_a_share_of_its_mass() -> None:
    biped = ba.Biped.load("rabbit")
    torso = biped.tree.links[biped.description.trunk].inertial.mass
    loaded = plant_of(Scenario(trunk_load=0.3), biped)
    assert loaded.mass - biped.mass == pytest.approx(0.3 * torso, rel=1e-12)


def test_rabbit_s_hardware_is_what_was_published_for_it() -> None:
    s = Scenario(hardware="rabbit")
    found = (s.period, s.counts, s.velocity, s.torque_limit, s.friction)
    assert found == (1.5e-3, 8192.0, "differences", 150.0, True)
    rubbing = RobotAndGait.of(s).biped.friction_torque(np.full(5, 0.3))
    assert np.all(rubbing[:4] < 0.0)


def test_the_columns_of_a_walk_are_means_over_ticks_and_joints() -> None:
    """By the stored nodes of the same walk, which lie on the ticks."""
    values = {"controller": "NPD", "impacts": 2, "period": 1e-3, "start_speed": 0.05}
    row = run_trial(values)
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
        (
            "rate_noise with rates from differences",
            {"period": 1e-3, "rate_noise": 1e-3, "velocity": "differences"},
            {"velocity": "measured"},
        ),
        ("amplitude or force without a push", {"amplitude": 9.0}, {"push": "pulse"}),
        ("a tolerance without the method adaptive", {"tolerance": 1e-8}, {"method": "adaptive"}),
    ],
)
def test_a_value_that_would_do_nothing_is_refused(
    said: str, idle: dict[str, object], with_effect: dict[str, object]
) -> None:
    with pytest.raises(ValueError, match=said):
        Scenario(**idle)
    s = Scenario(**idle | with_effect)
    assert Scenario(**s.record()) == s


def test_a_class_and_its_name_have_the_same_settings() -> None:
    """A default that both write down."""
    scene = RobotAndGait.of(Scenario("DOB"))
    named = build(Scenario("DOB"), scene).controller
    assert named == MomentumDOBController(scene.gait.constraint)
