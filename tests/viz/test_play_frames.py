"""What a page is told of a live walk: poses, signals, the worst of all samples, and the hand."""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.live.driver import Driver
from biped_adrc.live.frame import ROWS, frame, named
from biped_adrc.live.messages import Message
from biped_adrc.viz.meshcat.frames import pose
from biped_adrc.viz.placement import WalkScene


def walked(seconds, **scenario):
    """A driver whose session has walked for so long."""
    driver = Driver(
        ba.Session(ba.Scenario(**{"controller": "NPD", "hardware": "ideal"} | scenario))
    )
    driver.session.advance(seconds - 1e-3)
    driver.take(Message("step", {}))
    return driver


def test_a_frame_draws_what_the_finished_walk_draws_and_plots_its_signals():
    driver = walked(0.6)
    driver.take(Message("push", {"torque": {"q1": 20.0}}))
    driver.take(Message("step", {}))
    driver.take(Message("step", {}))
    found = frame(driver)["walks"][0]
    walk = driver.session.walk()
    scene = WalkScene.of(walk)
    last = len(walk.trajectory.arcs) - 1
    drawn = pose(scene, last, walk.trajectory.t_end)
    assert found["joints"] == pytest.approx(drawn.joints, abs=1e-12)
    assert found["points"] == pytest.approx(drawn.points, abs=1e-12)
    assert found["loads"][2:] == pytest.approx(drawn.loads[2:], abs=1e-12)
    assert found["loads"][3] == 20.0  # of the other leg
    assert found["contact"][:2] == pytest.approx(drawn.contact[:2], abs=1e-12)
    assert found["support"]["number"] == 2
    s = walk.signals
    seen = found["rows"][-1]
    assert seen["error"] == pytest.approx(s.error[-1], abs=1e-12)
    assert seen["friction"] == pytest.approx(
        abs(s.ground_reaction[-1, 0]) / s.ground_reaction[-1, 1], rel=1e-9
    )
    assert seen["xi_estimate"] == [None] * 4
    assert found["ending"] == ""


def test_signals_of_a_sample_before_a_change_are_not_read_with_the_controller_after_it():
    driver = walked(0.1)
    for message in (Message("change", {"values": {"controller": "ADRC"}}), Message("back", {})):
        driver.take(message)
        seen = frame(driver)["walks"][0]
        assert (seen["rows"], seen["worst"]) == ([], None)
        driver.take(Message("step", {}))
        (row,) = frame(driver)["walks"][0]["rows"]
        assert row["xi_estimate"][0] is not None


def test_the_worst_of_a_frame_is_of_all_its_samples_and_its_rows_are_of_some():
    driver = walked(0.1)
    driver.shown()
    driver.session.push({"q1": 150.0}, seconds=0.001)
    for _ in range(40):
        driver.take(Message("step", {}))
    found = frame(driver)["walks"][0]
    s, after = driver.session.walk().signals, driver.session.t - 0.04 + 1e-9
    last = s.t > after
    friction = np.abs(s.ground_reaction[:, 0]) / s.ground_reaction[:, 1]
    assert found["worst"]["torque"] == pytest.approx(np.abs(s.u[last]).max(), rel=1e-9)
    assert found["worst"]["torque"] > max(np.abs(row["u"]).max() for row in found["rows"])
    assert found["worst"]["normal"] <= min(s.ground_reaction[last, 1]) * (1 + 1e-9)
    assert found["worst"]["friction"] >= friction[last].max() * (1 - 1e-9)
    assert len(found["rows"]) == ROWS
    assert found["rows"][-1]["t"] == pytest.approx(driver.session.t)
    assert np.ptp(np.diff([row["t"] for row in found["rows"]])) < 1.1e-3
    driver.shown()
    assert frame(driver)["walks"][0] == found  # at rest
    driver.take(Message("step", {}))
    assert len(frame(driver)["walks"][0]["rows"]) == 1


def test_the_force_of_a_hand_is_drawn_where_it_acts_and_as_no_torque():
    driver = walked(0.3)
    driver.take(Message("push", {"force": (-50.0, 0.0), "link": "torso", "at": (0.0, 0.3)}))
    driver.take(Message("step", {}))
    found = frame(driver)
    live = driver.session.walking[0]
    p, _ = live.moving.points.place("torso", (0.0, 0.3), live.q, live.v)
    assert found["hand"] == {"at": pytest.approx(p), "force": [-50.0, 0.0], "anchor": None}
    assert found["walks"][0]["loads"][2:] == pytest.approx(np.zeros(5), abs=1e-10)


def test_a_link_that_is_seen_is_the_model_s_in_either_step():
    one, two = walked(0.1), walked(0.6)
    assert [d.session.walking[0].now.mode.step for d in (one, two)] == [1, 2]
    for link, other in (("left_shin", "right_shin"), ("torso", "torso")):
        assert named(one.session.walking[0], link) == link
        assert named(two.session.walking[0], link) == other


def test_a_walk_that_has_fallen_says_why():
    driver = walked(0.1)
    driver.take(Message("push", {"force": (-290.0, 0.0), "seconds": 2.0}))
    driver.session.advance(3.0)
    assert " at " in frame(driver)["walks"][0]["ending"]
    assert frame(driver)["hand"] is None
