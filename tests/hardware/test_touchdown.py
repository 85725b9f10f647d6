"""A controller that has to notice touchdowns: what it believes meanwhile, in both engines.

T = 1 ms is the period of the ticks (sample instants). Labels say which leg is the stance leg. A touchdown
changes the plant's labels, a notice the controller's; its belief is (other, step, start, d): other = 1 while
both differ, the number and the start of the step that it believes in, and the detector's state.
`FaultyTouchdown` knows the touchdown and makes errors. `walker` has one of NPD with a detector, `run(system,
gait, t_end)` walks until t_end [s], with one touchdown at 0.416 s; `beliefs(system, x)` and `held_at(system,
x)` read the belief and all that is held from a state x.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.touchdowns import matched, touchdowns
from biped_adrc.closed_loop import semantics
from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.core.errors import InputError
from biped_adrc.engine.run import run_compiled
from biped_adrc.hardware.touchdown import ByForce, ByKinematics, FaultyTouchdown, Look
from biped_adrc.hybrid.simulator import RunOptions

T = 1e-3
CLOCK = ba.SampledTime(T, restart=False)


def walker(biped, gait, touchdown, controller=ba.NPDController, **more):
    more = {"timing": CLOCK, "torque_limit": 150.0} | more
    return ba.Walker(biped, controller(gait.constraint), touchdown=touchdown, **more)


def run(system, gait, t_end):
    x0 = system.initial_state(*gait.start(system.plant))
    return run_compiled(system, x0, Mode(), ba.RK4(1e-3), RunOptions(t_end))


def low_order(constraint):
    return ba.ADRCController(constraint, observer=ba.GPIObserver.from_bandwidth(300.0, m=1))


def held_at(system, x):
    return semantics.parts(system, x).tail


def beliefs(system, x):
    return held_at(system, x).belief


def ticks(arc):
    """Nodes just before and just after each sample instant of an arc."""
    before = np.flatnonzero(np.diff(arc.t) == 0.0)
    return before, before + 1


def by_hand(system, t, x):
    """s and u at a sample instant at x, by the law at the relabelled state with the old single support."""
    q, v, s = system.split_state(x)
    plant, b = system.plant, beliefs(system, x)
    m = system.measure(t, plant.relabel(q), plant.R @ v, Mode(int(b.step), b.start))
    s, u = semantics.command(system, s, m)
    return system.calls.predict(s, m, u), u[system.plant.swap]


@pytest.mark.parametrize("controller", [ba.NPDController, low_order])
def test_while_a_touchdown_is_unnoticed_the_law_acts_in_the_labels_before_it(
    biped, gait, controller
):
    """A detection that is 6.5 ms late leaves six ticks of 1 ms at which it is computed by hand (`by_hand`): the
    law at the state in the old labels, its torque back in the new ones. The last four numbers of x are the
    torque that is held.
    """
    system = walker(biped, gait, FaultyTouchdown(late=0.0065), controller)
    walked = run(system, gait, 0.43)
    (event,) = walked.events("foot_strike")
    arc = walked.arcs[1]
    count = 0
    for before, after in zip(*ticks(arc), strict=True):
        x, t = arc.x[before], arc.t[before]
        if t < event.t + 0.0065:
            s, u = by_hand(system, t, x)
            np.testing.assert_allclose(arc.x[after][-4:], u, rtol=1e-9, atol=1e-9)
            np.testing.assert_allclose(system.split_state(arc.x[after])[2], s, rtol=1e-9)
            assert beliefs(system, arc.x[after])[:3] == (1.0, 1.0, 0.0)
            count += 1
    assert count == 6


def test_noticed_at_the_first_tick_the_controller_jumps_and_acts_there(biped, gait):
    """Without an error the notice is at the first tick after the touchdown: there the controller's state jumps,
    and then it acts in step 2, which begins at that tick.
    """
    system = walker(biped, gait, FaultyTouchdown(), low_order)
    walked = run(system, gait, 0.43)
    (event,) = walked.events("foot_strike")
    arc = walked.arcs[1]
    # nodes just before and just after the first tick of the arc
    before, after = ticks(arc)[0][0], ticks(arc)[1][0]
    t, x = arc.t[before], arc.x[before]
    assert 0.0 <= t - event.t < T
    q, v, s = system.split_state(x)
    m = system.measure(t, q, v, Mode(2, t))
    s, u = semantics.command(system, system.calls.jump(s, m, system.plant.swap), m)
    np.testing.assert_allclose(arc.x[after][-4:], u, rtol=1e-9, atol=1e-9)
    s = system.calls.predict(s, m, u)
    np.testing.assert_allclose(system.split_state(arc.x[after])[2], s, rtol=1e-9)
    assert beliefs(system, arc.x[after])[:3] == (0.0, 2.0, t)


SENSORS = ba.Sensors(counts=2**18)


def test_two_touchdowns_of_which_none_is_noticed_leave_the_labels_right(biped, gait):
    """`other` is 0, 1, 0, and the torque is exchanged twice; the walk has one touchdown, so the second is made
    by hand. A touchdown that still waits for its notice is not missed.
    """
    system = walker(biped, gait, FaultyTouchdown(missed=1.0))
    walked = run(system, gait, 0.42)
    (event,) = walked.events("foot_strike")
    assert beliefs(system, event.x_minus)[:3] == (0.0, 1.0, 0.0)
    assert beliefs(system, event.x_plus)[:3] == (1.0, 1.0, 0.0)
    twice = semantics.strike(system, event.t, event.x_plus, Mode(3, event.t), system.gain)
    assert beliefs(system, twice)[:3] == (0.0, 1.0, 0.0)
    u = twice[-4:]
    np.testing.assert_array_equal(u, event.x_minus[-4:])
    found = touchdowns(system, walked)
    assert (found.waits, found.rates.missed_share) == (True, None)


@pytest.mark.parametrize(
    ("struck", "notices", "late", "false", "waits"),
    [
        ([1.0, 2.0], [1.1, 1.8], [0.1, -0.2], [], False),
        ([1.0, 2.0, 3.0], [3.1], [np.nan, np.nan, 0.1], [], False),
        ([1.0, 2.0, 3.0], [2.9], [np.nan, np.nan, -0.1], [], False),
        ([1.0], [], [np.nan], [], True),
        ([1.0], [0.4, 0.6, 1.1], [0.1], [0.4, 0.6], False),
        ([1.0], [1.1, 1.5], [0.1], [1.5], False),
        ([], [], [], [], False),
    ],
)
def test_late_early_missed_and_false_by_what_comes_first(struck, notices, late, false, waits):
    """Touchdowns `struck` and notices, in order of time, are paired: notice second is late, notice first early
    (late < 0), two touchdowns are both missed (NaN), two notices both false. A last touchdown without a notice
    still waits, and counts in no share.
    """
    found = matched(np.array(struck), np.array(notices))
    np.testing.assert_allclose(found.late, late, rtol=0.0, atol=1e-12)
    assert (found.false.tolist(), found.waits) == (false, waits)
    decided = late[: len(late) - waits]
    behind = [x for x in late if x >= 0.0]
    expected = (np.mean(behind), max(behind)) if behind else (None, None)
    assert found.rates[:2] == pytest.approx(expected)
    assert found.rates.missed_share == (np.mean(np.isnan(decided)) if decided else None)
    assert found.rates.early_share == (np.mean(np.array(decided) < 0.0) if decided else None)
    assert found.rates.false_notices == len(false)


def test_a_false_notice_comes_once_and_an_early_one_is_counted_as_early(biped, gait):
    """false_at = (step, s): a notice s [s] after the start of a step. Followed by its touchdown at 0.416 s it
    is early; alone, or at the very start, it is false.
    """
    # shortly before the touchdown at 0.416 s; the first tick from 0.4105 s on is at 0.411 s
    early = walker(biped, gait, FaultyTouchdown(false_at=(1, 0.4105)))
    # two touchdowns until 0.9 s: the first is noticed early, the second at the next tick
    found = touchdowns(early, run(early, gait, 0.9))
    assert found.rates.early_share == 0.5
    assert found.late[0] == pytest.approx(0.411 - found.t[0], abs=1e-9)
    assert len(found.false) == 0
    false = walker(biped, gait, FaultyTouchdown(false_at=(1, 0.1)))
    walked = run(false, gait, 0.12)
    np.testing.assert_allclose(touchdowns(false, walked).false, [0.1], rtol=0.0, atol=1e-9)
    at_once = walker(biped, gait, FaultyTouchdown(false_at=(1, 0.0)))
    np.testing.assert_array_equal(touchdowns(at_once, run(at_once, gait, 5e-3)).false, [0.0])


def test_missed_ones_come_with_their_probability():
    """Of 2000 touchdowns 20 % are missed, within four standard deviations; d[0] = 1 while a notice is due. A
    touchdown that makes the labels right (other = 0) is never due.
    """
    leaf = FaultyTouchdown(missed=0.2, seed=3)
    d, waits = leaf.start(), []
    for k in range(2000):
        d = leaf.touchdown(d, 1.0, float(k))
        waits.append(d[0])
    assert np.mean(waits) == pytest.approx(0.8, abs=4.0 * np.sqrt(0.16 / 2000))
    assert leaf.touchdown(d, 0.0, 0.0)[0] == 0.0


def test_by_kinematics_a_height_is_early_by_height_over_speed(biped, gait):
    """The notice is early by height over speed, up to one tick of 1 ms; the speed of the foot is taken at the
    touchdown, by differences, which leaves 0.1 to 0.2 ms. The foot is below the height for the first time at
    the notice.
    """
    height = 4e-3
    system = walker(biped, gait, ByKinematics(height=height))
    walked = run(system, gait, 0.43)
    found = touchdowns(system, walked)
    q, v = np.split(walked.events("foot_strike")[0].x_minus[:10], 2)
    h = 1e-7  # [s]
    speed = (biped.swing_foot(q - h * v)[1] - biped.swing_foot(q + h * v)[1]) / (2 * h)
    assert speed > 0.1
    assert -height / speed - 1e-4 < found.late[0] < -height / speed + T + 2e-4
    arc = walked.arcs[0]
    z = np.array([biped.swing_foot(x[:5])[1] for x in arc.x])
    at = np.flatnonzero(arc.t == found.t[0] + found.late[0])
    # nodes just before and just after the tick; the last node of the tick before is not below the height
    assert len(at) == 2
    assert z[at[0]] < height <= z[np.flatnonzero(arc.t < arc.t[at[0]] - 0.9 * T)[-1]]


@pytest.mark.parametrize("slope", [-0.1, 0.1])
def test_by_kinematics_the_height_is_over_a_ground_that_falls_ahead(slope):
    """The ground is z = -tan(slope) x. The foot comes down to 1 mm above the ground, then below it."""
    leaf, x = ByKinematics(slope=slope), 0.4
    d, found = np.inf, []
    for above in (2e-3, 1e-3, -1e-3):
        # 1.0: 1 s since the last detection; the numbers behind the place are not looked at
        look = Look(0.0, 1.0, np.array([x, above - math.tan(slope) * x]), 0.0, 0.0, 1.0, 0.0)
        d, fires = leaf.notice(d, look)
        found.append(fires)
        assert d == pytest.approx(above, abs=1e-12)
    assert found == [0.0, 0.0, 1.0]


def test_by_force_debounce_and_delay_add_up_after_the_first_tick(biped, gait):
    """The force acts from the touchdown on, so the first tick after it begins the 3 ms of debounce, and 2 ms of
    delay follow.
    """
    system, later = walker(biped, gait, ByForce(delay=2e-3, debounce=3e-3)), 5e-3
    found = touchdowns(system, run(system, gait, 0.43))
    first = np.ceil(found.t[0] / T) * T - found.t[0]
    assert found.late[0] == pytest.approx(first + later, abs=1e-9)
    assert len(found.late) == 1


def notices(leaf, forces, foot=(0.3, 0.0), other=0.0, t_step=0.5):
    """Times [ms] at which a row of forces, one a millisecond, is taken for a touchdown."""
    d, found = leaf.start(), []
    for k, force in enumerate(forces):
        look = Look(T * k, t_step, np.array(foot), force, other, 1.0, 0.0)
        d, fires = leaf.notice(d, look)
        found += [k] if fires > 0.5 else []
    return found


def test_by_force_has_hysteresis_debounce_and_a_gate():
    """Thresholds 20 and 50 N: free below the first, loaded above the second. The row of forces has one [N] for
    each ms, the result is the times [ms] of the notices. The last two rows have the foot too near, 0.05 m
    ahead, and the last detection too recent, 0.05 s ago.
    """
    up = [0.0, 60.0, 60.0, 60.0, 60.0]
    assert notices(ByForce(), up) == [1]
    assert notices(ByForce(debounce=2e-3), up) == [3]
    assert notices(ByForce(delay=2e-3), [0.0, 60.0, 0.0, 0.0, 0.0]) == [3]
    assert notices(ByForce(debounce=2e-3), [0.0, 60.0, 30.0, 30.0]) == [3]
    assert notices(ByForce(debounce=2e-3), [0.0, 60.0, 10.0, 60.0, 60.0, 60.0]) == [5]
    assert notices(ByForce(), [60.0, 30.0, 60.0, 10.0, 40.0, 60.0, 60.0]) == [5]
    assert notices(ByForce(), [0.0, 60.0, 30.0, 60.0, 0.0, 60.0]) == [1, 5]
    assert notices(ByForce(), up, foot=(0.05, 0.0)) == []
    assert notices(ByForce(), up, t_step=0.05) == []


def test_by_force_of_a_push_is_newton_s_law(biped, gait):
    """The stance foot carries weight plus d/dt of the vertical momentum, by differences of Pinocchio's, less
    the push of 40 N that lifts the hip; the swing foot carries nothing.
    """
    push = ba.HipForce(biped, (0.0, 40.0))
    system = walker(biped, gait, ByForce(), disturbance=push)
    x = system.initial_state(*gait.start(biped))
    q, v = x[:5], x[5:10]
    x[-4:] = [10.0, -20.0, 5.0, 15.0]  # torques that act
    stance, swing = system.foot_forces(0.1, q, v, semantics.parts(system, x).tail, Mode())
    a = system.flow(0.1, x, Mode())[5:10]
    h = 1e-5  # [s]
    pairs = [(q + s * v + 0.5 * s * s * a, v + s * a) for s in (h, -h)]
    rate = np.subtract(*(biped.momentum(*pair)[1] for pair in pairs)) / (2.0 * h)
    weight = 9.81 * biped.body_terms(q, v).mass
    assert stance == pytest.approx(rate + weight - 40.0, rel=1e-5)
    assert swing == 0.0


def test_encoders_go_through_a_late_notice_without_a_jump(biped, gait):
    """What they show of an unnoticed touchdown is in the old labels, so the angles go on, by no more per tick
    than the fastest joint turns. At the notice angles and rates change labels, and the first tick after it
    takes no difference. 2.4e-5 rad is a count of 2^18 a turn.
    """
    system = walker(biped, gait, FaultyTouchdown(late=5e-3), sensors=SENSORS)
    walked = run(system, gait, 0.43)
    (event,) = walked.events("foot_strike")
    w = [held_at(system, x).sensors.angle for x in (event.x_minus, event.x_plus)]
    np.testing.assert_array_equal(w[1], w[0])
    nodes = np.vstack([arc.x[ticks(arc)[1]] for arc in walked.arcs])
    seen = [held_at(system, x).sensors for x in nodes]
    angles, rates = np.array([w.angle for w in seen]), np.array([w.rate for w in seen])
    noticed = np.flatnonzero(np.diff([beliefs(system, x).step for x in nodes]) > 0.0) + 1
    assert len(noticed) == 1
    angles[noticed[0] :] = angles[noticed[0] :] @ biped.R.T
    fastest = np.max(np.abs(nodes[:, 5:10]))
    assert np.max(np.abs(np.diff(angles, axis=0))) < 1.1 * fastest * T
    k = noticed[0]
    expected = biped.R @ ((angles[k] - angles[k - 1]) / T)
    np.testing.assert_allclose(rates[k], expected, rtol=0.0, atol=2.0 * 2.4e-5 / T)
    np.testing.assert_array_equal(rates[k + 1], rates[k])


def test_wrong_values_and_clocks_of_touchdown_detectors_are_refused(biped, gait):
    """A clock that restarts at touchdowns knows them, and continuous time has no ticks; a negative delay, a
    probability of 1.5, step 0, a text; a threshold `on` below that of `off`, 20 N; NaN.
    """
    for timing in (ba.SampledTime(T), ba.ContinuousTime()):
        with pytest.raises(InputError, match="restart=False"):
            walker(biped, gait, FaultyTouchdown(), timing=timing)
    for make in (
        lambda: FaultyTouchdown(late=-1e-3),
        lambda: FaultyTouchdown(missed=1.5),
        lambda: FaultyTouchdown(false_at=(0, 0.1)),
        lambda: FaultyTouchdown(false_at="ab"),
        lambda: ByForce(on=10.0),
        lambda: ByForce(delay=np.nan),
        lambda: ByKinematics(height=np.nan),
    ):
        with pytest.raises(InputError):
            make()
