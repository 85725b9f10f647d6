"""A walk under one's own hand: that of its scenario, pushed as a scenario pushes, and repeated bit for bit."""

import math

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.errors import BipedError, InputError
from biped_adrc.live.hand import Spring
from biped_adrc.live.live_walk import revised
from biped_adrc.live.session import GHOST, WALK, Session

IDEAL = {"hardware": "ideal", "impacts": 2}


def nodes(walk):
    arcs = walk.trajectory.arcs
    return np.concatenate([arc.t for arc in arcs]), np.vstack([arc.x for arc in arcs])


@pytest.mark.parametrize(
    "values",
    [
        {"controller": "ADRC"},
        {"controller": "NPD", "hardware": "rabbit", "delay": 2e-3, "lag": 1e-3},
        {"controller": "NPD", "touchdown": "kinematics", "delay": 4e-4},
        {"controller": "NPD", "plant": "mujoco", "pushes": "q1=20@1:0.05-0.1", "period": 7e-4},
        {"controller": "finite time", "own": {"alpha": 0.9, "eps": 0.1}, "delay": 3e-4},
    ],
    ids=lambda values: ",".join(map(str, values.values())),
)
def test_untouched_it_is_the_walk_of_its_scenario_bit_for_bit(values):
    s = ba.Scenario(**(IDEAL | {"impacts": 1} | values))
    t, x = nodes(ba.walk_scenario(s))
    session, samples = Session(s), []
    while session.walking[WALK].now.mode.step == 1:
        samples += [flown.arc for flown in session.sample()[WALK]]
    n = 10 if "plant" in values else x.shape[1]  # what MuJoCo keeps for itself is not in the walk
    assert np.array_equal(np.concatenate([arc.t for arc in samples]), t)
    assert np.array_equal(np.vstack([arc.x for arc in samples])[:, :n], x[:, :n])


TORQUES = {"pushes": "q1,q5=25@1:0.1-0.2"}
PULSE = {"push": "pulse", "on": "link right_shin", "force": 40.0, "direction": math.pi}
PULSE |= {"onset": 0.1, "duration": 0.1, "pushed_step": 1}


@pytest.mark.parametrize(
    ("as_scenario", "by_hand"),
    [
        (TORQUES, {"torque": {"q1": 25.0, "q5": 25.0}}),
        (PULSE, {"force": (-40.0, 0.0), "link": "right_shin"}),
    ],
    ids=["torque", "force"],
)
def test_it_pushes_as_the_scenario_of_the_same_push(as_scenario, by_hand):
    one = IDEAL | {"impacts": 1}
    walk = ba.walk_scenario(ba.Scenario("NPD", **one | as_scenario)).trajectory
    session = Session(ba.Scenario("NPD", **one))
    session.advance(0.1)
    session.push(**by_hand, seconds=0.1)
    states = []
    for t in (0.15, 0.22):
        session.advance(t - session.t)
        states.append(session.walking[WALK].now.x[:10])
        assert session.t == pytest.approx(t, abs=1e-12)
        assert states[-1] == pytest.approx(walk(t)[:10], abs=1e-9)
    session.back()
    session.advance(0.22)
    assert np.max(np.abs(states[-1] - session.walking[WALK].now.x[:10])) > 1e-3


@pytest.mark.parametrize("plant", ["rigid", "mujoco"])
def test_a_hand_against_the_push_of_the_scenario_leaves_the_walk_as_it_was(plant):
    s = ba.Scenario("NPD", plant=plant, **IDEAL | PULSE)
    sessions = [Session(ba.Scenario("NPD", plant=plant, **IDEAL)), Session(s), Session(s)]
    for session in sessions:
        session.advance(0.1)
    sessions[1].push(force=(40.0, 0.0), link="right_shin", seconds=0.1)
    for session in sessions:
        session.advance(0.08)
    still, held, pushed = (session.walking[WALK].now.x[:14] for session in sessions)
    assert held == pytest.approx(still, abs=1e-9)
    assert np.max(np.abs(pushed - still)) > 1e-3


def test_the_energy_gained_is_the_work_of_motors_and_hand():
    session = Session(ba.Scenario("NPD", **IDEAL))
    session.advance(0.05)
    session.pull("torso", (0.0, 0.3), (0.6, 1.3))
    session.advance(0.15)
    session.push({"q2": 20.0}, seconds=0.05)
    session.advance(0.15)
    s = session.walk().signals.of_step(1)
    power = np.sum(s.v[:, :4] * s.u, axis=1) + np.sum(s.v * s.zeta, axis=1)
    energy = s.kinetic + s.potential
    work = np.sum(0.5 * (power[1:] + power[:-1]) * np.diff(s.t))
    assert np.max(np.abs(s.zeta)) > 50.0
    assert np.ptp(energy) > 10.0
    assert work == pytest.approx(energy[-1] - energy[0], abs=2e-4 * np.ptp(energy))


def test_with_the_recorded_hand_as_a_disturbance_ba_walk_walks_the_same():
    session = Session(ba.Scenario("NPD", **IDEAL))
    session.advance(0.05)
    session.push({"q1": 20.0}, force=(-20.0, 5.0), link="left_shin", seconds=0.03)
    session.advance(0.04)
    session.pull("torso", (0.0, 0.3), (0.4, 1.1))
    session.advance(0.03)
    session.let_go()
    while session.walking[WALK].now.mode.step == 1:
        session.sample()
    walk = session.walk()
    again = ba.walk(walk.walker, walk.gait, impacts=1, method=ba.RK4(1e-3))
    # called in Python, sample by sample: as no session calls it
    assert again.trajectory.settings["engine"] == "compiled plant"
    for t in (0.06, 0.09, 0.12, 0.3):
        q_v = again.trajectory(t)[:10]
        assert walk.trajectory(t)[:10] == pytest.approx(q_v, rel=0.0, abs=1e-11)
    struck, by_itself = (x.trajectory.events()[0] for x in (walk, again))
    assert struck.t == pytest.approx(by_itself.t, abs=1e-11)
    assert struck.x_minus[:10] == pytest.approx(by_itself.x_minus[:10], rel=0.0, abs=1e-10)


def busy(ghost=None):
    """A session with all that one can do."""
    session = Session(ba.Scenario("ADRC", **IDEAL), ghost)
    session.advance(0.2)
    session.push({"q1": 30.0}, seconds=0.05)
    session.advance(0.1)
    session.change(controller="NPD")
    session.pull("right_thigh", (0.0, -0.1), (0.3, 0.9))
    session.advance(0.4)
    session.let_go()
    session.back()
    session.change(controller="ADRC", bandwidth=300.0, order=1)
    session.push(force=(-60.0, 10.0), seconds=math.inf)
    session.advance(0.1)
    return session


def test_a_stored_session_is_walked_again_bit_for_bit(tmp_path):
    session = busy({"controller": "NPD"})
    path = session.save(tmp_path / "me.npz")
    found = ba.replay_session(path)
    assert found.same
    assert found.record == session.record
    for walk, live in zip((found.walk, found.ghost), session.walking, strict=True):
        last = walk.trajectory.arcs[-1]
        assert last.t[-1] == live.now.t
        assert np.array_equal(last.x[-1, :10], live.now.x[:10])
    stored = ba.load_walk(path)
    assert np.array_equal(stored.signals.zeta, found.walk.signals.zeta)
    assert np.diff(stored.signals.t).min() >= 0.0
    assert stored.signals.foothold[-1] == pytest.approx(session.walking[WALK].foot[0], abs=1e-12)
    assert session.walking[WALK].foot[0] > 0.2
    assert "NPD -> ADRC" in found.walk.remarks[0]
    stored.animate(tmp_path / "me.html")
    assert (tmp_path / "me.html").stat().st_size > 1e5


def test_another_hand_is_noticed(tmp_path):
    session = Session(ba.Scenario("NPD", **IDEAL))
    session.push({"q1": 1.0}, seconds=0.01)
    session.advance(0.05)
    path = session.save(tmp_path / "me.npz")
    with np.load(path) as file:
        arrays = dict(file)
    arrays["beside.hand"] = np.array(str(arrays["beside.hand"]).replace(",1.0,", ",1.0000000001,"))
    np.savez(path, **arrays)
    found = ba.replay_session(path)
    assert not found.same
    assert 0.0 < found.gap < 1e-6
    arrays["x0"] = arrays["x0"][:-1]
    arrays["dx0"], arrays["t0"] = arrays["dx0"][:-1], arrays["t0"][:-1]
    arrays["beside.signal.u"] = arrays["beside.signal.u"][:-1]
    np.savez(path, **arrays)
    assert ba.replay_session(path).gap == math.inf


def test_back_is_where_the_single_support_began_and_the_same_again_is_the_same():
    session = Session(ba.Scenario("NPD", **IDEAL))
    session.advance(0.6)
    began = session.walking[WALK].now.mode.start
    states = []
    for _ in range(2):
        session.back()
        assert session.t == began
        session.push({"q3": 15.0}, seconds=0.1)
        session.advance(0.15)
        states.append(session.walking[WALK].now.x)
    assert np.array_equal(*states)
    session.back()
    session.back()
    assert session.t == 0.0
    session.change(controller="NPID")
    session.advance(0.1)
    session.back()
    assert session.walking[WALK].scenario.controller == "NPID"
    session.reset()
    assert session.record.samples == 0
    assert session.record.scenario.controller == "NPID"


def test_back_at_a_sample_where_the_hand_has_changed_twice_it_is_the_first_again():
    session, still = (Session(ba.Scenario("NPD", **IDEAL)) for _ in range(2))
    for each in (session, still):
        while each.walking[WALK].now.mode.step == 1:
            each.sample()
    session.push({"q1": 5.0}, seconds=0.01)
    session.let_go()
    session.pull("torso", (0.0, 0.0), (1.0, 1.0))
    session.advance(0.02)
    session.back()
    for each in (session, still):
        each.advance(0.02)
    x = session.walking[WALK].now.x
    assert np.array_equal(x, still.walking[WALK].now.x)
    assert np.array_equal(x, session.walk().trajectory.arcs[-1].x[-1])


def test_another_controller_begins_as_after_an_impact():
    session = Session(ba.Scenario("NPD", **IDEAL))
    session.advance(0.2)
    before = session.walking[WALK]
    session.change(controller="ADRC")
    after = session.walking[WALK]
    q, v, u = before.q, before.v, before.moving.torque(before.now)
    assert np.array_equal(after.q, q)
    assert np.array_equal(after.v, v)
    assert np.array_equal(after.moving.torque(after.now), u)
    fresh = after.moving.walker.initial_state(q, v, before.now.mode)
    assert np.array_equal(after.now.x[:-4], fresh[:-4])
    session.advance(0.01)
    assert not np.array_equal(after.moving.torque(session.walking[WALK].now), u)


def test_with_another_controller_the_plant_goes_on_as_it_is():
    session = Session(ba.Scenario("NPD", plant="mujoco", **IDEAL))
    while session.walking[WALK].now.mode.step == 1:  # the swing foot is in the ground just after
        session.sample()
    before = session.walking[WALK]
    session.change(controller="NPID")
    after = session.walking[WALK]
    own = before.moving.own(before.now)
    assert len(own) == 5
    assert np.array_equal(after.moving.own(after.now), own)
    session.advance(0.05)
    assert session.walks


def test_the_scenario_of_a_walk_that_has_fallen_may_change_for_the_next():
    session = Session(ba.Scenario("NPD", K_p=1.0, K_d=0.1, **IDEAL))
    session.pull("torso", (0.0, 0.0), (0.5, 1.0))
    assert not session.advance(2.0)
    session.change(K_p=None, K_d=None)
    assert not session.walks
    session.reset()
    assert session.advance(0.5)


def test_with_another_controller_its_observer_goes_and_what_is_given_comes():
    session = Session(ba.Scenario("ADRC", bandwidth=200.0, order=1, **IDEAL))
    session.change(controller="NPD")
    assert session.walking[WALK].scenario.bandwidth is None
    session.change(controller="ADRC", bandwidth=250.0)
    session.change(K_p=500.0)
    s = session.walking[WALK].scenario
    assert (s.bandwidth, s.order, s.K_p) == (250.0, None, 500.0)
    session.change(controller="ADRC assisted", bandwidth=250.0)
    values = session.record.changes[-1].values
    assert revised(s, values) == session.walking[WALK].scenario


def test_a_spring_stays_at_the_metal_that_it_holds():
    session = Session(ba.Scenario("NPD", **IDEAL))
    session.advance(0.3)
    session.pull("right_shin", (0.0, -0.2), (0.2, 0.3))
    while session.walking[WALK].now.mode.step == 1:
        before = session.pulled()[0]
        session.sample()
    assert session.spring.link == "left_shin"
    fastest = np.max(np.abs(session.walking[WALK].v))
    assert np.linalg.norm(session.pulled()[0] - before) < 1e-3 * fastest


def test_a_spring_pulls_towards_the_hand_and_not_more_than_it_may():
    spring = Spring("torso", (0.0, 0.0), (1.0, 0.5), stiffness=100.0, damping=10.0, most=50.0)
    still = np.zeros(2)
    assert spring.force(np.array([0.8, 0.5]), still) == pytest.approx((20.0, 0.0))
    assert spring.force(np.array([1.0, 0.5]), np.array([0.0, 2.0])) == pytest.approx((0.0, -20.0))
    assert spring.force(np.array([-2.0, -3.5]), still) == pytest.approx((30.0, 40.0))
    assert spring.force(np.array([1.0, 0.5]), still) == (0.0, 0.0)


def test_the_ghost_gets_the_same_push_and_goes_on_where_the_walk_has_fallen():
    session = Session(ba.Scenario("NPD", K_p=1.0, K_d=0.1, **IDEAL), {"K_p": None, "K_d": None})
    session.push(force=(30.0, 0.0), seconds=0.1)
    session.advance(0.2)
    session.pull("torso", (0.0, 0.0), (0.5, 1.0))
    session.advance(1.3)
    assert session.hand is None
    walk, ghost = session.walking
    assert not walk.walks
    assert ghost.walks
    assert session.t == ghost.now.t > 1.4 > walk.now.t
    found = [session.walk(which) for which in (WALK, GHOST)]
    assert found[WALK].trajectory.status is walk.status
    for each in found:
        assert each.walker.disturbance.resultant(0.05, 1, 0.0) == pytest.approx([30.0, 0.0])
        assert each.walker.disturbance.resultant(0.11, 1, 0.0) == pytest.approx([0.0, 0.0])


@pytest.mark.parametrize("do", [Session.reset, Session.back])
def test_where_it_cannot_walk_from_there_nothing_has_been_done(do):
    pytest.importorskip("mujoco")
    session = Session(ba.Scenario("NPD", **IDEAL), {"K_p": 4000.0})
    session.push({"q1": 5.0}, seconds=1.0)
    session.advance(0.2)
    session.change(plant="mujoco", slope=0.01)  # at its start the foot would be in that ground
    session.advance(0.01)
    before, walking, hand = session.record, [*session.walking], session.hand
    with pytest.raises(InputError, match="inside the ground"):
        do(session)
    assert session.record == before
    assert session.walking == walking
    assert session.hand == hand
    assert session.walk().trajectory.t_end == session.t


@pytest.mark.parametrize(
    ("do", "message"),
    [
        (lambda s: s.change(robot="compass"), "robot cannot change while it walks"),
        (lambda s: s.change(bandwidth=-5.0), "bandwidth"),
        (lambda s: s.change(controller="nonsense"), "nonsense"),
        (lambda s: s.change(period=None), "sample"),
        (lambda s: s.change(colour=1), "colour"),
        (lambda s: s.change(1), "walk 1"),
        (lambda s: s.change(walk=1), "walk: unknown"),
        (lambda s: s.change(self=1), "self"),
        (lambda s: s.push({"q9": 1.0}), "q9"),
        (lambda s: s.push({"q1": math.nan}), "finite"),
        (lambda s: s.push({"q1": 1e4}), "at most 200"),
        (lambda s: s.push(force=(1e4, 0.0)), "at most 300"),
        (lambda s: s.push(force=(1.0, 0.0), link="tail"), "tail"),
        (lambda s: s.push({"q1": 1.0}, seconds=0.0), "positive"),
        (lambda s: s.push(force=(1.0, 0.0), at=(1e9, 0.0)), "within 3 m"),
        (lambda s: s.pull("torso", (math.nan, 0.0), (0.0, 0.0)), "within 3 m"),
        (lambda s: s.pull("torso", (0.0, 0.0), (math.inf, 0.0)), "numbers within"),
        (lambda s: s.pull("tail", (0.0, 0.0), (0.0, 0.0)), "tail"),
        (lambda s: s.advance(-1.0), "0 s or more"),
        (lambda s: s.save("me.npz"), "nothing has been walked"),
    ],
)
def test_what_is_none_is_refused_and_changes_nothing(do, message):
    session = Session(ba.Scenario("ADRC", **IDEAL))
    before = session.record, [*session.walking], session.hand, session.spring
    with pytest.raises(BipedError, match=message):
        do(session)
    assert before == (session.record, session.walking, session.hand, session.spring)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({}, "controlled at sample instants"),
        ({"hardware": "ideal", "fine": 1e-4}, "fine"),
        ({"robot": "compass", "controller": "passive"}, "motors"),
    ],
)
def test_a_scenario_that_cannot_walk_live_is_refused(values, message):
    with pytest.raises(InputError, match=message):
        Session(ba.Scenario(**values))


def test_a_ghost_that_is_no_mapping_is_refused():
    with pytest.raises(InputError, match="the ghost is 'NPD'"):
        Session(ba.Scenario("ADRC", **IDEAL), "NPD")


def test_a_run_that_is_no_session_is_refused(tmp_path):
    path = ba.walk_scenario(ba.Scenario("NPD", impacts=1)).save(tmp_path / "walk.npz")
    with pytest.raises(InputError, match="no session"):
        ba.replay_session(path)


def test_on_another_slope_the_ground_turns_about_the_stance_foot():
    session = ba.Session(ba.Scenario("ADRC", hardware="ideal"))
    session.advance(0.6)  # the swing foot is high
    session.change(slope=-0.03)
    before = session.walking[0].foot.copy()
    while session.walking[0].now.mode.step == 2:
        session.sample()
    stride = session.walking[0].foot - before
    assert stride[1] / stride[0] == pytest.approx(np.tan(0.03), rel=1e-9)
