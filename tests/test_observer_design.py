"""The observer design assistant: margins, sampled loops, noise, impacts, and the robot's own word on them.

An observer of order m has m + 2 poles and estimates the disturbance xi of one joint, q'' = kappa u + xi;
Table I is the paper's, with nine poles from 180 to 19836 rad/s. The loop is linear: a = -K_p x1^ - K_d x2^ -
xi^ is asked for and acts after a delay. The delay is known where the observer is fed with what acts, else
hidden. Z are the observer's states, scaled by the geometric mean w of its poles. The laws that the robot runs
are the independent side. FIRST is the observer of order 1 at 500 rad/s; K_P = 5000, K_D = 50. `delayed_loop` is
the matrix of the loop by the robot's laws in continuous time, `tick_by_tick` a period of it in sampled time.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.observer import choice
from biped_adrc.analysis.observer.choice import Hardware, count_error, recommend
from biped_adrc.analysis.observer.impact import impact_peak, orbit_impact
from biped_adrc.analysis.observer.loop import (
    ObserverLoop,
    SampledLoop,
    covariance,
    largest_delay,
    largest_period,
    last_true,
)
from biped_adrc.analysis.observer.report import observer_report
from biped_adrc.control.base import Measurement
from biped_adrc.control.delayed import Delayed, DelayState
from biped_adrc.core.errors import InputError
from biped_adrc.hardware.motors import IDEAL, Line, whole_and_part

TABLE_I = ba.GPIObserver.from_poles()
FIRST = ba.GPIObserver.from_bandwidth(500.0, 1)
OBSERVERS = {
    "table 1": TABLE_I,
    "m = 1": FIRST,
    "m = 0": ba.GPIObserver.from_bandwidth(300.0, 0),
    "complex": ba.GPIObserver.from_poles((-300 + 200j, -300 - 200j, -400.0, -80.0)),
}
K_P, K_D = 5000.0, 50.0


@pytest.fixture(params=OBSERVERS.values(), ids=list(OBSERVERS))
def observer(request):
    return request.param


@dataclass(frozen=True)
class Asks(ba.Controller):
    """The torque that stands in place of the angles."""

    def output(self, s, m):
        return m.q


def asking(u):
    """A measurement at which `Asks` asks for u (p,)."""
    # at 0 s in single support 1, which begins there
    return Measurement(0.0, 1, 0.0, u, np.zeros_like(u), SimpleNamespace(kappa=np.eye(len(u))))


def line_flow(line, R, u):
    """R' (order, p) while u (p,) is asked for."""
    return line.flow(DelayState(None, R), asking(u), u).R


# -- the loop in continuous time ---------------------------------------------------------------------
def delayed_loop(observer, delay, known, order=8):
    """The loop with an approximant of the delay, column by column from the laws that the robot runs."""
    w, k = observer.scale, observer.order
    line = Delayed(Asks(), delay, order)

    def flow(X):
        y, rate, Z, R = X[0], X[1], X[2 : 2 + k], X[2 + k :]  # rate in units of w
        xi = Z[2] * w**2 if k > 2 else 0.0
        a = -K_P * Z[0] - K_D * w * Z[1] - xi
        late = line.output(DelayState(None, R), asking(R[0]))
        dZ = observer.flow(Z, y, late if known else a)
        return np.vstack((w * rate, late / w, dZ, line_flow(line, R, a)))

    return flow(np.eye(2 + k + order))


@pytest.mark.parametrize("known", [False, True], ids=["hidden", "known"])
def test_delay_margin_is_where_a_root_crosses_the_axis(observer, known):
    """The margin comes from the loop's frequency response; with the robot's own laws and an approximant of
    the delay all roots are on the left 0.1 % below it and one is on the right above it, at the frequency
    `at`."""
    margin, at = ObserverLoop(observer).delay_margin(known)
    for share, sign in ((0.999, -1), (1.001, 1)):
        roots = np.linalg.eigvals(delayed_loop(observer, share * margin, known))
        assert np.sign(np.max(roots.real)) == sign
    roots = np.linalg.eigvals(delayed_loop(observer, margin, known))
    assert np.min(np.abs(roots - 1j * at)) < 1e-5 * at


def test_margins_of_the_paper_and_of_the_linear_observer():
    """Table I bears a delay of only 85 us, and m = 1 at 500 rad/s one of 4.6 ms: the reason to prefer the
    latter on a real robot."""
    assert ObserverLoop(TABLE_I).delay_margin().delay == pytest.approx(85e-6, rel=0.05)
    assert ObserverLoop(FIRST).delay_margin().delay == pytest.approx(4.6e-3, rel=0.05)


def test_known_delay_leaves_the_textbook_margin_of_the_gains(observer):
    """The loop's characteristic function is s^2 + (K_d s + K_p) exp(-s d): |L| = 1 at w^4 = K_d^2 w^2 + K_p^2,
    d = atan(K_d w / K_p) / w.
    """
    w = math.sqrt(0.5 * (K_D**2 + math.sqrt(K_D**4 + 4.0 * K_P**2)))
    margin = ObserverLoop(observer).delay_margin(known=True)
    assert margin.delay == pytest.approx(math.atan(K_D * w / K_P) / w, rel=1e-9)
    assert margin.frequency == pytest.approx(w, rel=1e-9)


def response(A, B, C, D, frequencies):
    """C (i w - A)^-1 B + D at frequencies w [rad/s], (K, outputs, inputs)."""
    return np.array([C @ np.linalg.solve(1j * w * np.eye(len(A)) - A, B) + D for w in frequencies])


def error_system(observer):
    """A, B of (19) in scaled errors E, with inputs xi and n (measurement error); rows of E: e1, e2, -xi^."""
    A, w, k = observer.error_system().A, observer.scale, observer.order
    B, C = np.zeros((k, 2)), np.zeros((3, k))
    B[1, 0], B[:, 1] = 1.0 / w, -w * observer.scaled_gains
    for i in range(min(k, 3)):
        C[i, i] = w**i
    return A, B, C


def test_transfer_functions_are_those_of_the_state_space(observer):
    """The closed formulas of `ObserverLoop` are compared with C (i w - A)^-1 B of (21) to (23), e_q'' = -K_d
    (e_q' - e2) - K_p (e_q - e1) + xi - xi^, beside the observer's errors (19), at six frequencies.
    """
    frequencies = np.array([3.0, 30.0, 100.0, 300.0, 1e3, 1e4])
    A_e, B_e, C_e = error_system(observer)
    k = len(A_e)
    A, B, C = np.zeros((k + 2, k + 2)), np.zeros((k + 2, 2)), np.zeros((2, k + 2))
    A[0, 1] = B[1, 0] = C[0, 0] = 1.0
    A[1] = C[1] = np.concatenate(([-K_P, -K_D], np.array([K_P, K_D, 1.0]) @ C_e))
    A[2:, 2:], B[2:] = A_e, B_e
    values = response(A, B, C, np.zeros((2, 2)), frequencies)
    xi_error = 1.0 + response(A_e, B_e, C_e, np.zeros((3, 2)), frequencies)[:, 2, 0]
    loop = ObserverLoop(observer)
    # the state space finds e / xi by differences of up to xi / K_p: round-off of that size is its own
    floor = 1e-12 / K_P
    np.testing.assert_allclose(loop.tracking_error(frequencies), values[:, 0, 0], 1e-6, floor)
    np.testing.assert_allclose(loop.noise(frequencies), values[:, 1, 1], 1e-6)
    np.testing.assert_allclose(loop.estimate(frequencies), 1.0 - xi_error, 1e-6, 1e-9)


# -- sampled time ------------------------------------------------------------------------------------
def tick_by_tick(observer, T, delay, known):
    """One period of the loop by the laws of observer and line, for columns of (e, T e', Z, torques T^2)."""
    k, form = observer.order, observer.sampled(T)
    queue, f = whole_and_part(delay, T)
    motors, _ = IDEAL.sampled(1, delay, T)

    def step(X, noise):
        y, rate, Z, rest = X[0], X[1] / T, X[2 : 2 + k], X[2 + k :] / T**2
        p = X.shape[1]
        z = form.correct(Z, y + noise)
        x = form.estimate(z)
        a = -K_P * x.position - K_D * x.velocity - x.disturbance
        # what acts is rest[0] where a part of a period is waited for; the queue follows it
        old = rest[0] if f > 0.0 else np.zeros(p)
        waiting = old.copy() if f > 0.0 else None
        line = motors.send(Line(rest[int(f > 0.0) :], None, waiting, old), a)
        first, then = (line.u, line.waiting) if f > 0.0 else (line.u, line.u)
        Z = form.predict(z, motors.mean_command(line) if known else a)
        for u, h in ((first, f * T), (then, (1.0 - f) * T)):
            y, rate = y + h * rate + 0.5 * h**2 * u, rate + h * u
        held = [then[np.newaxis]] if f > 0.0 else []
        left = np.vstack((*held, line.queue))
        return np.vstack((y, T * rate, Z, T**2 * left)), a

    return step, 2 + k + queue + int(f > 0.0)


@pytest.mark.parametrize("known", [False, True], ids=["hidden", "known"])
@pytest.mark.parametrize("delay", [0.0, 0.4, 1.0, 2.3])
@pytest.mark.parametrize("T", [1.5e-3, 2e-4])
def test_sampled_loop_is_the_one_of_the_laws_tick_by_tick(observer, T, delay, known):
    """Columns of the unit matrix go through one period of the robot's own laws and give the loop's matrix.
    delay: in periods; 0.4 and 2.3 have a part of a period, in which the torque changes between ticks."""
    loop = SampledLoop(observer, T, delay=delay * T, known=known)
    step, size = tick_by_tick(observer, T, delay * T, known)
    matrix, _ = step(np.eye(size), 0.0)  # without noise of the angle
    found = loop.step.M + np.eye(size)  # `step` has the change of the state
    np.testing.assert_allclose(found, matrix, rtol=1e-9, atol=1e-9 * np.max(np.abs(matrix)))


@pytest.mark.parametrize(("T", "delay"), [(1.5e-3, 0.0), (1.5e-3, 0.7), (1e-3, 1.0)])
def test_ripple_of_a_count_is_that_of_many_noisy_loops(T, delay):
    """The rms torque by a covariance against 4000 loops with uniform errors of one encoder count (8192 per
    turn), sampled after they have settled; 2 % is the scatter of so many."""
    # FIRST: an observer of order 1 and 500 rad/s; step(X, n) is a period of many loops, in columns of X
    loop, sigma = SampledLoop(FIRST, T, delay=delay * T), count_error(8192)
    step, size = tick_by_tick(FIRST, T, delay * T, False)
    random, loops = np.random.default_rng(3), 4000
    X, torques = np.zeros((size, loops)), []
    for tick in range(700):
        count = math.sqrt(12.0) * sigma
        X, a = step(X, random.uniform(-0.5 * count, 0.5 * count, loops))
        if tick >= 400 and tick % 30 == 0:
            torques.append(a)
    assert np.std(torques) == pytest.approx(loop.rms(sigma), rel=0.02)


@pytest.mark.parametrize("observer_", [TABLE_I, FIRST], ids=["table 1", "m = 1"])
def test_largest_period_parts_stable_from_unstable(observer_):
    """With a delay of one period the loop is stable 0.1 % below the largest period, and unstable 0.1 % above
    that.
    """
    T = largest_period(SampledLoop(observer_, 1e-3), delay_periods=1.0)
    for share, stable in ((0.999, True), (1.001, False)):
        loop = SampledLoop(observer_, share * T, delay=share * T)
        assert loop.stable is stable


@pytest.mark.parametrize("observer_", [TABLE_I, FIRST], ids=["table 1", "m = 1"])
def test_sampled_margin_tends_to_the_continuous_one(observer_):
    """A held torque is late by half a period; the observer knows that, so the margin is not even less."""
    margin = ObserverLoop(observer_).delay_margin().delay
    gaps = [abs(largest_delay(SampledLoop(observer_, margin / n)) - margin) for n in (8, 32)]
    assert gaps[1] < 0.5 * gaps[0]
    assert gaps[1] < 0.02 * margin


# -- the delayed controller --------------------------------------------------------------------------
@pytest.mark.parametrize("k", [1, 2, 3, 4])
def test_approximant_is_of_order_2k(k):
    """N(s) / D(s) of degrees k - 1 and k approximates exp(-s) up to s^(2k): the error at half the argument is
    2^(2k) times smaller. Poles on the left, so the line itself is stable."""
    N, D = Delayed(ba.Passive(), 1.0, k).pade

    def error(x):
        s = 1j * x
        return abs(np.polyval(N[::-1], s) / np.polyval(D[::-1], s) - np.exp(-s))

    assert math.log2(error(0.5) / error(0.25)) == pytest.approx(2 * k, abs=0.15)
    assert np.max(np.roots(D[::-1]).real) < 0.0


def test_known_feeds_what_acts_and_hidden_what_was_asked(bare, published):
    """The inner observer's flow gets the torque u that acts if the delay is known, else its own output."""
    inner = ba.ADRCController(published.constraint, FIRST)
    q, v = published.start(bare)
    m = Measurement(0.0, 1, 0.0, q, v, bare.reduction(q, v))
    z, u = inner.initial_state(m) + 1e-4, np.array([1.0, -2.0, 3.0, 4.0])
    for known, fed in ((False, inner.output(z, m)), (True, u)):
        # 1 ms, by an approximant of order 2, which has two states for each of four motors
        controller = Delayed(inner, 1e-3, 2, known)
        s = DelayState(z, np.ones((2, 4)))
        flow = controller.flow(s, m, u)
        np.testing.assert_array_equal(flow.inner, inner.flow(z, m, fed))
        assert not np.array_equal(controller.output(s, m), inner.output(z, m))


# -- the robot's word --------------------------------------------------------------------------------
def late(biped, gait, observer_, share, order=4):
    """Status of a walk whose torque acts `share` of the delay margin late, and max |q_b - q_d| of its steps."""
    delay = share * ObserverLoop(observer_).delay_margin().delay
    inner = ba.ADRCController(gait.constraint, observer_)
    walker = ba.Walker(biped, Delayed(inner, delay, order))
    walk = ba.walk(walker, gait, 6, ba.RK4(1e-4 if observer_ is FIRST else 1e-5))
    steps = (walk.signals.of_step(k + 1).error for k in range(len(walk.trajectory.arcs)))
    return walk.trajectory.status, np.array([np.max(np.abs(error)) for error in steps])


def test_robot_tracks_below_the_margin_and_diverges_above(biped, gait):
    """The margin of the linear loop of one joint holds for the whole nonlinear robot: at 95 % of it errors do
    not grow from step to step, at 105 % the walk runs away. An approximant of order 6 instead of 4 changes
    nothing."""
    # late: a walk with this share of the margin as delay, its status and the largest error of each step
    (below, errors), (_, finer) = (late(biped, gait, FIRST, 0.95, order) for order in (4, 6))
    assert below is ba.Status.COMPLETED
    assert np.max(errors[-2:]) < 3.0 * errors[1]
    assert late(biped, gait, FIRST, 1.05)[0] is ba.Status.RAN_AWAY
    np.testing.assert_allclose(errors, finer, rtol=0.0, atol=1e-6)


def test_table_1_falls_by_one_count_where_the_linear_observer_walks(biped, gait):
    """At RABBIT's 1.5 ms both observers walk with exact angles; with 8192 counts only m = 1 at 500 rad/s
    (FIRST) does.
    """
    statuses = {}
    for observer in (TABLE_I, FIRST):
        for counts in (None, 8192):
            walker = ba.Walker(
                biped,
                ba.ADRCController(gait.constraint, observer),
                timing=ba.SampledTime(1.5e-3),
                torque_limit=150.0,
                sensors=ba.Sensors(counts=counts, velocity="measured"),
            )
            statuses[observer, counts] = ba.walk(walker, gait).trajectory.status
    assert statuses == {
        (TABLE_I, None): ba.Status.COMPLETED,
        (TABLE_I, 8192): ba.Status.FELL,
        (FIRST, None): ba.Status.COMPLETED,
        (FIRST, 8192): ba.Status.COMPLETED,
    }


def test_ripple_on_the_robot_is_the_one_of_the_linear_loop(biped, gait):
    """The rms of the stance hip's torque in a walk of 25 steps, with and without encoder counts: their
    squares differ by the square of the ripple, which the report has from the linear loop of one joint."""
    from biped_adrc.hardware.sensors import Sensors

    observer, rms = ba.GPIObserver.from_bandwidth(200.0, 1), []
    for counts in (None, 8192):
        walker = ba.Walker(
            biped,
            ba.ADRCController(gait.constraint, observer),
            timing=ba.SampledTime(1.5e-3),
            sensors=Sensors(counts=counts, velocity="measured"),
        )
        run = ba.walk(walker, gait, 25, ba.RK4(5e-4), engine="compiled").trajectory
        assert run.status is ba.Status.COMPLETED
        # x[-4]: the torque of the stance hip, first of the four at the end
        rms.append(np.sqrt(np.mean(np.concatenate([arc.x[:, -4] for arc in run.arcs]) ** 2)))
    report = observer_report(observer, robot=biped, gait=gait)
    assert math.sqrt(rms[1] ** 2 - rms[0] ** 2) == pytest.approx(report.ripple, rel=0.2)


@pytest.mark.parametrize("policy", ["relabel", "measured"])
def test_peak_after_impact_is_the_one_of_a_walk(bare, published, policy):
    """The largest torque in the 15 ms after an impact, by linear error dynamics and in a simulated walk,
    whose torque has the gait's own (`usual`) besides. policy: what the observer's states become at an
    impact."""
    policy = ba.ResetPolicy(policy)
    impact = orbit_impact(bare, published, TABLE_I.order)
    controller = ba.ADRCController(published.constraint, TABLE_I, reset=policy)
    walker = ba.Walker(bare, controller)
    run = ba.walk(walker, published, 2, ba.RK4(1e-5), engine="compiled").trajectory
    arc = run.arcs[1]
    # over 15 ms, every 0.05 ms
    u = np.array([walker.instant(arc.t[i], arc.x[i], arc.mode).u for i in range(0, 1500, 5)])
    peak = impact_peak(TABLE_I, impact, policy).torque
    usual = np.max(np.abs(u[-1]))  # the gait's own torque, which the linear response leaves out
    assert abs(np.max(np.abs(u)) - peak) < usual + 0.03 * peak


def test_exact_reset_leaves_only_what_was_not_known(bare, published):
    """MODEL sets all states that an m = 1 observer has; NONE is off by the swap of the legs in the angles,
    RELABEL by the jump of the velocities.
    """
    impact = orbit_impact(bare, published, FIRST.order)
    assert impact_peak(FIRST, impact, ba.ResetPolicy.MODEL).torque == 0.0
    none, relabel = (
        impact_peak(FIRST, impact, policy)
        for policy in (ba.ResetPolicy.NONE, ba.ResetPolicy.RELABEL)
    )
    q, v = published.start(bare)
    assert none.position == pytest.approx(np.max(np.abs(q[:4] - published.q_minus[:4])))
    jump = v[:4] - published.v_minus[[1, 0, 3, 2]]  # with the legs exchanged
    assert relabel.velocity == pytest.approx(np.max(np.abs(jump)), rel=1e-3)


@pytest.mark.parametrize(
    ("observer_", "counts", "ratio"),
    [
        (TABLE_I, 2e7, 1.25),  # quiet with so many counts per turn alone
        (ba.GPIObserver.from_bandwidth(45.0, 5), 8192.0, 0.8),
        (ba.GPIObserver.from_bandwidth(30.0, 7), 8192.0, 0.8),
    ],
    ids=["table 1", "m = 5", "m = 7"],
)
def test_an_observer_for_exact_inertias_alone_cannot_run(biped, gait, observer_, counts, ratio):
    """Stable and quiet (ripple below the 15 N m allowed) with the model's kappa; with `ratio` times it the
    laws, tick by tick, diverge from 1e-3 to above 1e3, so the report has to say that it cannot run."""
    report = observer_report(observer_, robot=biped, gait=gait, counts=counts)
    assert report.sampled().spectral_radius < 1.0
    assert report.ripple < 15.0
    assert not report.runs
    assert "cannot run" in report.verdict
    assert f"{ratio:g} times the model's kappa the sampled loop is unstable" in report.verdict
    assert error_after(observer_, ratio, 4000) > 1e3
    assert error_after(observer_, 1.0, 4000) < 1e-6


def error_after(observer, ratio, ticks, T=1.5e-3):
    """|e| by the laws from e = 1e-3 on, for a robot with that ratio of the model's kappa; it ends at 1e6."""
    form, y, rate = observer.sampled(T), np.array([1e-3]), np.zeros(1)
    z = np.zeros(observer.order)
    for _ in range(ticks):
        z = form.correct(z, y)
        x = form.estimate(z)
        a = -K_P * x.position - K_D * x.velocity - x.disturbance
        z = form.predict(z, a)
        y, rate = y + T * rate + 0.5 * T**2 * ratio * a, rate + T * ratio * a
        if abs(y[0]) > 1e6:
            break
    return abs(y[0])


@pytest.mark.parametrize("m", [1, 5])
def test_verdict_and_recommendation_agree(biped, gait, m):
    """What is recommended runs; a little above it, where the table says why not, it does not."""
    made = observer_report(ba.GPIObserver.from_bandwidth(50.0, m), robot=biped, gait=gait)
    found = recommend(made.hardware, ba.Gains(), m)
    for share, allowed in ((0.999, True), (1.002, False)):
        observer_ = ba.GPIObserver.from_bandwidth(share * found.bandwidth, m)
        report = observer_report(observer_, robot=biped, gait=gait)
        assert report.runs is allowed
        assert report.obstacle == ("" if allowed else found.because)
        assert ("cannot run" in report.verdict or "not well" in report.verdict) is not allowed


def test_tables_of_an_observer(biped, gait):
    """The tables are compared whole, as printed: gains in physical units and scaled, and the peak of the
    estimate; the four poles are put into the name.
    """
    report = observer_report(
        ba.GPIObserver.from_poles((-300.0, -200.0, -400.0, -80.0)), robot=biped, gait=gait
    )
    assert report.name == "m = 2 with poles of 80 to 400 rad/s"
    assert [*report._gains().lines(), *report._estimate().lines()] == TABLES.split("\n")


def test_words_on_an_observer(biped, gait):
    """Observers of each kind that the verdict knows: m = 0, which estimates no disturbance; Table I, whose
    ripple is above the torque limit; m = 1 with a delay beyond its margin; and m = 15, which is refused."""
    for observer_, hardware, words in (
        (OBSERVERS["m = 0"], {}, ("m = 0 at 300 rad/s can run, but is worse than no observer,",)),
        (
            OBSERVERS["m = 0"],
            {},
            ("; with m = 0 no disturbance is estimated, and the weight is not",),
        ),
        (TABLE_I, {}, ("Table I cannot run on", "N m rms, 1", " times the limit of 150 N m")),
        (
            FIRST,
            {"delay": 5e-3},
            ("with a delay of 5 ms and 1.25 times", "margin at this period is"),
        ),
    ):
        report = observer_report(observer_, robot=biped, gait=gait, **hardware)
        assert [x for x in words if x not in report.verdict] == [], report.verdict
    with pytest.raises(InputError, match="observer with m = 15 was asked for, expected m <= 14"):
        SampledLoop(ba.GPIObserver.from_bandwidth(50.0, 15), 1e-3)


def test_recommendations_at_both_ends_of_the_range(monkeypatch):
    """Encoders of 1e-3 counts allow no bandwidth at all, ideal ones the largest tried, 2e4 rad/s. `last_true`
    is the bisection in between; P = 0.25 P + 3 has the solution 4, and an unstable loop (50 periods late)
    no rms."""
    monkeypatch.setattr(choice, "BANDS", 8)
    # period of 1 ms, no delay, encoders of n counts, motors of 150 N m, inertia of 1 kg m^2
    blunt, ideal = (Hardware(1e-3, 0.0, False, n, 150.0, 1.0) for n in (1e-3, 1e30))
    assert math.isnan(recommend(blunt, ba.Gains(), 0).bandwidth)
    # bandwidth, and what bounds it: nothing
    assert recommend(ideal, ba.Gains(), 0)[1:3] == (2e4, "")
    assert last_true(lambda x: x <= 3.0, [1.0, 2.0, 4.0, 5.0]) == pytest.approx(3.0, rel=2e-6)
    assert math.isnan(last_true(lambda x: False, [1.0]))
    assert last_true(lambda x: True, [1.0]) == math.inf
    assert covariance(np.array([[0.5]]), np.array([[3.0]])) == pytest.approx(4.0, rel=1e-15)
    assert math.isnan(SampledLoop(FIRST, 1e-3, delay=0.05).rms(1.0))


TABLES = """\
Gains of the observer; states scaled by w = 209.327 rad/s
               physical  scaled
  l_3 [1/s^1]  980       4.68167
  l_2 [1/s^2]  332000    7.57683
  l_1 [1/s^3]  4.48e+07  4.8843
  l_0 [1/s^4]  1.92e+09  1
Estimate of the disturbance
              peak                  -3 dB
  |xi^ / xi|  1.319 at 84.61 rad/s  258.5 rad/s"""
