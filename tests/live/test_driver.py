"""What a page may say, and the pace of a session: by a clock of the test's own."""

import json

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.errors import BipedError, InputError
from biped_adrc.live import driver
from biped_adrc.live.driver import Driver
from biped_adrc.live.messages import (
    MOST_AT_ONCE,
    MOST_BYTES,
    MOST_RATE,
    NEEDED,
    Allowance,
    message_of,
)


class Clock:
    """Goes on by hand, and by `tick` [s] whenever it is asked."""

    def __init__(self, tick=0.0):
        self.t, self.tick = 0.0, tick

    def __call__(self):
        self.t += self.tick
        return self.t


def driven(tick=0.0):
    clock = Clock(tick)
    made = Driver(ba.Session(ba.Scenario("NPD", hardware="ideal")), clock)
    return made, made.session, clock


def say(driver, **words):
    driver.take(message_of(json.dumps(words)))


@pytest.mark.parametrize("rate", [0.25, 1.0, 2.0])
def test_the_walk_keeps_pace_with_the_clock_to_a_sample(rate):
    driver, session, clock = driven()
    say(driver, do="rate", rate=rate)
    for k in range(1, 31):
        clock.t = k / 60.0
        assert driver.go_on() or rate < 1.0
        assert abs(session.t - rate * clock.t) < 2e-3
    assert driver.reached == pytest.approx(rate, rel=0.02)


def test_a_walk_that_cannot_keep_up_says_the_rate_that_it_reached():
    made, session, clock = driven(tick=0.01)  # a sample seems to take 10 ms
    for _ in range(100):
        clock.t += 0.02
        made.go_on()
    assert session.t < 0.15 * clock.t
    assert made.reached == pytest.approx(0.1, abs=0.05)
    assert made.kept == pytest.approx(session.t / clock.t, rel=0.05)
    assert made.owed <= 0.0


def test_after_a_long_rest_it_does_not_run_after_the_clock():
    made, session, clock = driven()
    clock.t = 100.0
    made.go_on()
    assert session.t == pytest.approx(driver.LONGEST, abs=2e-3)


def test_long_turns_are_counted_as_they_are_and_a_rest_is_not():
    made, session, clock = driven()
    for _ in range(100):
        clock.t += 4 * driver.LONGEST
        made.go_on()
    assert made.reached == pytest.approx(0.25, rel=0.02)
    assert made.kept == pytest.approx(0.25, rel=0.02)
    before = session.t
    clock.t += 100.0
    made.rest()
    assert not made.go_on()
    assert (session.t, made.kept) == (before, pytest.approx(0.25, rel=0.02))


def test_pause_step_and_go():
    driver, session, clock = driven()
    say(driver, do="pause")
    clock.t = 1.0
    assert not driver.go_on()
    say(driver, do="step")
    assert session.record.samples == 1
    clock.t = 2.0
    say(driver, do="go")
    clock.t = 2.05
    assert driver.go_on()
    assert session.t == pytest.approx(0.051, abs=2e-3)


def test_every_message_reaches_the_session():
    driver, session, _ = driven()
    say(driver, do="push", torque={"q1": 20}, force=[5, 0], link="torso", seconds=0.01)
    assert session.hand.torque[0] == 20.0
    assert session.hand.force == (5.0, 0.0)
    say(driver, do="pull", link="torso", at=[0, 0.3], anchor=[0.5, 1.2])
    say(driver, do="step")
    assert session.hand.force[0] > 10.0
    say(driver, do="let_go")
    assert session.hand is None
    say(driver, do="change", values={"controller": "ADRC", "bandwidth": 300.0})
    assert session.walking[0].scenario.bandwidth == 300.0
    say(driver, do="back")
    assert session.record.samples == 0
    say(driver, do="reset", values={"order": 1})
    assert session.record.changes == ()
    assert session.record.scenario.order == 1
    assert session.record.scenario.controller == "ADRC"
    assert all(hasattr(driver, f"_{name}") for name in NEEDED if name != "save")  # by the stage


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "no JSON"),
        ("[" * 1500, "no JSON|expected"),
        ('{"do": "rate", "rate": NaN}', "no JSON"),
        ('{"do": "rate", "rate": 1e999}', "finite"),
        ('{"do": "rate", "rate": true}', "finite"),
        ('{"do": "rate", "rate": 1%s}' % (400 * "0"), "finite"),
        ("[]", "does None"),
        ("7", "does None"),
        ('{"do": ["go"]}', "does"),
        ('{"do": "__init__"}', "does '__init__'"),
        ('{"do": "take"}', "does 'take'"),
        ('{"do": "go", "x": 1}', "has or lacks"),
        ('{"do": "pull", "link": "torso"}', "has or lacks"),
        ('{"do": "push", "force": [1]}', "two finite numbers"),
        ('{"do": "push", "torque": {"q1": "a"}}', "finite numbers by name"),
        ('{"do": "change", "values": {"own": {"a": 1}}}', "by name"),
        ('{"do": "change", "values": []}', "by name"),
        ('{"do": "rate", "rate": 50}', "0.01 to 10"),
        ('{"do": "change", "values": {"bandwidth": -1}}', "bandwidth"),
        ('{"do": "change", "values": {"walk": 1}}', "no field"),
        ('{"do": "change", "values": {"self": 1}}', "no field"),
        ('{"do": "reset", "values": {"self": 1}}', "expected fields"),
        ('{"do": "reset", "values": {"robot": "compass"}}', "robot cannot change"),
        ('{"do": "change", "values": {"controller": "os:getcwd"}}', "no path and no class"),
        ('{"do": "ghost", "values": {"robot": "/etc/robot.toml"}}', "no path and no class"),
        ('{"do": "push", "link": "\\ud800"}', "a text"),
        ('{"do": "pull", "link": "torso", "at": [0, 0], "anchor": [1e300, 1e300]}', "within 1e"),
        ('{"do": "change", "walk": 0.5, "values": {}}', "whole number"),
        ('{"do": "push", "torque": {"q1": 999}}', "at most 200"),
        (" " * MOST_BYTES + "{}", "at most 2000"),
    ],
)
def test_another_message_is_refused_in_words_and_does_nothing(text, message):
    driver, session, _ = driven()
    before = session.record, driver.rate, driver.paused
    with pytest.raises(BipedError, match=message) as raised:
        driver.take(message_of(text))
    assert len(str(raised.value)) < 500
    assert before == (session.record, driver.rate, driver.paused)


def test_bytes_that_are_no_text_are_refused():
    with pytest.raises(InputError, match="no JSON"):
        message_of(b"\xff\xfe{")


def test_a_page_that_says_too_much_is_not_heard():
    allowance = Allowance()
    at_once = sum(allowance.taken(10.0) for _ in range(1000))
    assert at_once == MOST_AT_ONCE
    later = sum(allowance.taken(10.0 + k * 1e-3) for k in range(1, 2001))
    assert later == pytest.approx(2.0 * MOST_RATE, abs=1.0)


def test_back_brings_a_walk_that_has_fallen_to_where_its_last_single_support_began():
    """Also while the ghost walks on, whose steps are none of the walk's."""
    encoders = {"velocity": "differences", "counts": 8192.0, "torque_limit": 150.0}
    scenario = ba.Scenario("ADRC", hardware="ideal", **encoders)
    session = ba.Session(scenario, {"controller": "NPD", "velocity": "measured", "counts": None})
    session.advance(1.5)
    walk, ghost = session.walking
    assert (walk.status, ghost.walks) == (ba.Status.FELL, True)
    session.back()
    walk, ghost = session.walking
    assert walk.walks
    assert session.t == walk.now.mode.start == 0.0
    assert ghost.now.t == 0.0


def test_a_hand_on_the_stance_foot_changes_nothing_but_the_ground_s_force():
    """The foot stands: no torque comes of a force there, which the ground takes."""
    sessions = [ba.Session(ba.Scenario("NPD", hardware="ideal")) for _ in range(2)]
    foot = sessions[0].walking[0].moving.walker.plant.description.stance_foot
    sessions[0].push(force=(50.0, -20.0), link=foot, seconds=0.1)
    for session in sessions:
        session.advance(0.1)
    one, other = (session.walking[0].now.x for session in sessions)
    assert np.max(np.abs(one - other)) < 1e-9
