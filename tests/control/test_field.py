"""The controllers and observers of the field: what each promises, by a law that its code does not use.

y = q_b - q_d are the joint errors (4,), and (y, y', y'') come from `output_acceleration`, with the plant's own
acceleration; NPD makes y'' + K_d y' + K_p y = 0 with K_p = 5000 and K_d = 50, and `left_over` is the size of
that sum over that of y''. `off_orbit` is a state off the gait's orbit, and x[10:] the controller's part of the
state; `at_rest(q)` is the reference that stays at q.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.optimize import brentq

import biped_adrc as ba
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.adrc import ADRCController
from biped_adrc.control.around import Around
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.control.npd import NPDController
from biped_adrc.control.npid import FilterState, NPIDController
from biped_adrc.control.output_adrc import OutputADRCController
from biped_adrc.control.pd_gravity import PDGravityController
from biped_adrc.control.super_twisting import SuperTwistingController
from biped_adrc.core.errors import InputError
from biped_adrc.core.timing import SampledTime
from biped_adrc.core.tree import flatten
from biped_adrc.gait.reference import TimeReference
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.observers.high_gain import HighGainObserver

from .off_orbit import off_orbit, output_acceleration

K_P, K_D = 5000.0, 50.0
NO_STATE = np.zeros(0)
SLOW = GPIObserver.from_bandwidth(500.0)


def slow(kind):
    """A controller with the slow observer."""
    return lambda constraint: kind(constraint, SLOW)


# -- PD with gravity compensation --------------------------------------------------------------
def test_the_weight_is_the_slope_of_the_potential_energy(biped, gait):
    """At rest at its reference a PD with gravity compensation gives the weight alone: dV/dq_i, by differences
    of Pinocchio's energy.
    """
    q, h = gait.start(biped)[0] + 0.1, 1e-4
    walker = Walker(biped, PDGravityController(at_rest(q)))
    u = walker.law.output(NO_STATE, walker.measure(0.0, q, np.zeros(5), Mode()))
    for i, found in enumerate(u):
        step = h * np.eye(5)[i]
        slope = (biped.potential_energy(q + step) - biped.potential_energy(q - step)) / (2 * h)
        assert found == pytest.approx(slope, rel=1e-6)


def test_a_balanced_posture_is_held(biped, gait):
    """With the COM above the stance foot nothing moves, by the plant's own equations of motion. The torso's
    angle is the one at which gravity has no torque on the coordinate without a motor.
    """
    q = gait.start(biped)[0].copy()

    def leaning(torso):
        return biped.gravity(np.append(q[:4], torso))[4]

    q[4] = brentq(leaning, -1.0, 1.0, xtol=1e-14)
    walker = Walker(biped, PDGravityController(at_rest(q)))
    x = walker.initial_state(q, np.zeros(5))
    assert np.max(np.abs(biped.gravity(q)[:4])) > 1.0
    assert np.max(np.abs(walker.instant(0.0, x, Mode()).a)) < 1e-10


def at_rest(q):
    zero = np.zeros(4)
    return TimeReference(lambda t: (q[:4], zero, zero))


# -- ADRC in output form -----------------------------------------------------------------------


def left_over(walker, gait, x):
    """y'' + K_d y' + K_p y of the plant, over the size of y''."""
    y, dy, ddy = output_acceleration(walker, gait, x)
    return np.max(np.abs(ddy + K_D * dy + K_P * y)) / np.max(np.abs(ddy))


@pytest.mark.parametrize(
    "kind", [ADRCController, OutputADRCController, MomentumDOBController, slow(ADRCController)]
)
def test_with_exact_estimates_the_loop_is_npd_s(biped, gait, kind):
    """Observers start with the true disturbance, so every controller makes y'' + K_d y' + K_p y = 0 on the
    plant, and its torque is NPD's.
    """
    q, v = off_orbit(gait, biped)
    walker, npd = (Walker(biped, law(gait.constraint)) for law in (kind, NPDController))
    for each in (walker, npd):
        assert left_over(each, gait, each.initial_state(q, v)) < 1e-8
    u, expected = (w.instant(0.0, w.initial_state(q, v), Mode()).u for w in (walker, npd))
    assert u == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("seed", range(2))
def test_a_known_force_is_rejected_whatever_it_acts_on(biped, gait, seed):
    """An observer that starts with the true disturbance leaves nothing of y'' + K_d y' + K_p y; one that does
    not know of the force leaves 1 % or more.

    Matched and unmatched: xi_y, for outputs, is y'' of the plant at u = 0, and for the momentum the force
    itself.
    """
    random = np.random.default_rng(seed)
    # SLOW: a GPI observer of 500 rad/s; NO_STATE below: no rate, as a momentum has none among the measurements
    zeta = ba.TorqueStep(40.0 * random.normal(size=5))
    q, v = off_orbit(gait, biped, seed)
    idle = Walker(biped, ba.Passive(), zeta)
    xi_y = output_acceleration(idle, gait, idle.initial_state(q, v))[2]

    walker = Walker(biped, OutputADRCController(gait.constraint, SLOW), zeta)
    x = walker.initial_state(q, v)
    assert left_over(walker, gait, x) > 1e-2
    y, dy, _ = output_acceleration(walker, gait, x)
    x[10:] = SLOW.initial_state(y, dy, xi_y).ravel()
    assert left_over(walker, gait, x) < 1e-8

    walker = Walker(biped, MomentumDOBController(gait.constraint), zeta)
    x = walker.initial_state(q, v)
    observer = walker.controller.observer
    x[10:] = observer.initial_state(biped.inertia(q) @ v, NO_STATE, zeta.amplitude).ravel()
    assert left_over(walker, gait, x) < 1e-8
    m = walker.measure(0.0, q, v, Mode())
    i = walker.instant(0.0, x, Mode())
    true_xi = i.a[:4] - m.terms.kappa @ i.u
    assert walker.law.estimate(walker.split_state(x)[2], m).disturbance == pytest.approx(
        true_xi, rel=1e-9
    )


def test_estimates_of_outputs_in_words_of_the_joints(biped, gait):
    """ADRC of the outputs y estimates (y, y', xi_y); what it reports is (q_b, q_b', xi) with xi = q_b'' - kappa
    u, as the joint form does. At the start both are exact.
    """
    walker = Walker(biped, OutputADRCController(gait.constraint))
    x = walker.initial_state(*off_orbit(gait, biped))
    i = walker.instant(0.0, x, Mode())
    found = walker.law.estimate(i.s, i.measurement)
    assert found.position == pytest.approx(i.measurement.q_b, rel=1e-12)
    assert found.velocity == pytest.approx(i.measurement.v_b, rel=1e-12)
    assert found.disturbance == pytest.approx(i.a[:4] - i.measurement.terms.kappa @ i.u, rel=1e-8)


# -- super-twisting and filtered PID ------------------------------------------------------------
SWAP = np.array([1, 0, 3, 2])


def started(walker, gait, biped, rows):
    """x off the orbit with rows (12,) or (4,) of the controller's state, as it starts with them, and m."""
    x = walker.initial_state(*off_orbit(gait, biped))
    first, x[10:] = x[10:].copy(), rows
    return x, first, walker.measure(0.0, x[:5], x[5:10], Mode())


def test_the_error_obeys_the_super_twisting_equations(biped, gait):
    """sigma' = -k_1 |sigma|^(1/2) sign(sigma) + z, z' = -k_2 sign(sigma), smooth within delta = 0.05; sigma =
    y' + 50 y. By default k_1 = 1.5 sqrt(1e4), k_2 = 1.1 1e4, for disturbances that change by up to 1e4. At a
    tick z moves by T z', at an impact it changes legs (SWAP).
    """
    z, law = np.array([10.0, -20.0, 30.0, -40.0]), SuperTwistingController(gait.constraint)
    walker = Walker(biped, law)
    x, first, m = started(walker, gait, biped, z)
    assert not np.any(first)  # z at the start
    y, dy, ddy = output_acceleration(walker, gait, x)
    sigma, delta = dy + 50.0 * y, 0.05
    root = sigma / np.sqrt(np.abs(sigma) + delta)
    assert ddy + 50.0 * dy == pytest.approx(z - 1.5 * np.sqrt(1e4) * root, rel=1e-8)
    slope = -1.1e4 * sigma / (np.abs(sigma) + delta)
    assert walker.flow(0.0, x, Mode())[10:] == pytest.approx(slope, rel=1e-9)
    tick = law.sampled(2e-3)
    assert tick.correct(z, m) == pytest.approx(z + 2e-3 * slope, rel=1e-9)
    assert np.array_equal(tick.jump(z, m, SWAP), z[SWAP])


def test_the_error_obeys_the_filtered_pid(biped, gait):
    """y'' = -K_d e_f' - K_p e_f - K_i s, e_f'' = w^2 (y - e_f) - 2 w e_f' with w = 1000 rad/s, K_i = 5e4, s' =
    e_f. The filter starts at (y, y', 0), and at an impact it begins anew, or keeps s, which changes legs.
    """
    e_f, de_f, s = rows = np.arange(1.0, 13.0).reshape(3, 4) * [[1e-3], [1e-2], [1e-4]]
    walker = Walker(biped, NPIDController(gait.constraint))
    x, first, m = started(walker, gait, biped, rows.ravel())
    y, dy, ddy = output_acceleration(walker, gait, x)
    assert first == pytest.approx(np.concatenate((y, dy, np.zeros(4))), abs=1e-12)
    assert ddy == pytest.approx(-K_D * de_f - K_P * e_f - 5e4 * s, rel=1e-8)
    expected = np.concatenate((de_f, 1e6 * (y - e_f) - 2e3 * de_f, e_f))
    assert walker.flow(0.0, x, Mode())[10:] == pytest.approx(expected, rel=1e-9)
    for reset, kept in ((ba.ResetPolicy.MEASURED, s[SWAP]), (ba.ResetPolicy.MODEL, 0.0 * s)):
        after = replace(walker.law, reset=reset).jump(FilterState(*rows), m, SWAP)
        assert flatten(after) == pytest.approx(np.concatenate((y, dy, kept)), abs=1e-12)


def test_a_tick_of_the_filtered_pid_is_its_flow_under_a_held_error(biped, gait):
    """Two ticks of T / 2 are one of T, and a short one is T times the slope: both hold for the exact solution
    alone. The torque that acts is the one asked for.
    """
    # a filter that oscillates; by default it has a double pole
    law = NPIDController(gait.constraint, damping=0.3)
    m = Walker(biped, law).measure(0.0, *off_orbit(gait, biped), Mode())
    s, T = FilterState(*np.linspace(-1.0, 1.0, 12).reshape(3, 4)), 2e-3
    whole, half, short = (law.sampled(t) for t in (T, T / 2, 1e-9))
    first = half.correct(s, m)
    twice = half.correct(half.predict(first, m, half.output(first, m)), m)
    assert flatten(whole.correct(s, m)) == pytest.approx(flatten(twice), rel=1e-12)
    change = flatten(short.correct(s, m)) - flatten(s)
    slope = flatten(law.flow(s, m, law.output(s, m)))
    assert change == pytest.approx(1e-9 * slope, rel=1e-5, abs=1e-12)


@pytest.mark.parametrize("timing", [None, ba.SampledTime(1e-3)])
@pytest.mark.parametrize("reset", ba.ResetPolicy)
def test_a_pid_like_adrc_is_one_loop_with_it(biped, gait, timing, reset):
    """Impacts and ends of a walk under a push and a torque limit are those of ADRC in output form to 1e-9, by
    each reset policy, in both time bases: start, filter, what acts beyond the limit and impact agree.
    """
    h, push = gait.constraint, ba.TorquePulse([20.0, -10.0, 5.0, 0.0, 0.0], 2, 0.1, 0.2)
    laws = (
        OutputADRCController(h, GPIObserver.from_bandwidth(500.0, 1), reset=reset),
        NPIDController.like_adrc(h, bandwidth=500.0, reset=reset),
    )
    timing = {"timing": timing} if timing else {}
    walkers = [Walker(biped, law, push, torque_limit=70.0, **timing) for law in laws]
    walks = [ba.walk(walker, gait, 3, ba.RK4(2e-4)).trajectory for walker in walkers]
    ends = [np.append(x.final_state[:10], x.t_end) for x in walks]
    assert ends[1] == pytest.approx(ends[0], abs=1e-9)
    assert walks[0].status is walks[1].status
    free = ba.walk(Walker(biped, laws[0], push, **timing), gait, 3, ba.RK4(2e-4)).trajectory
    assert abs(free.t_end - walks[0].t_end) > 1e-6  # the limit acted


@pytest.mark.parametrize("wT", [5.0, 12.5, 40.0])
def test_a_pid_like_adrc_starts_where_its_observer_does(biped, gait, wT):
    """At any bandwidth times period the first torques and those after an impact are ADRC's to 1e-9: no inverse
    of the nearly singular correction of a fast observer is taken.
    """
    h, T = gait.constraint, 5e-3
    adrc = OutputADRCController(h, GPIObserver.from_bandwidth(wT / T, 1)).sampled(T)
    pid = NPIDController.like_adrc(h, bandwidth=wT / T).sampled(T)
    m = Walker(biped, NPDController(h)).measure(0.0, *off_orbit(gait, biped), Mode())
    states = [law.initial_state(m) for law in (adrc, pid)]
    for _ in range(2):
        states = [law.correct(s, m) for law, s in zip((adrc, pid), states, strict=True)]
        u, v = (law.output(s, m) for law, s in zip((adrc, pid), states, strict=True))
        assert v == pytest.approx(u, rel=1e-9)
        states = [law.jump(s, m, SWAP) for law, s in zip((adrc, pid), states, strict=True)]


def test_a_filter_too_fast_for_its_ticks_is_refused(gait):
    """At 1 kHz a filter of 3000 rad/s is taken, one of 8000 rad/s refused: its rate has decayed by the next
    tick, and on a double integrator the loop with v held over a period is unstable.
    """
    NPIDController(gait.constraint, filter_bandwidth=3000.0).sampled(1e-3)
    with pytest.raises(InputError, match=r"unstable at a period of 0.001 s .* below 3000 rad/s"):
        NPIDController(gait.constraint, filter_bandwidth=8000.0).sampled(1e-3)


def test_the_integral_of_a_pid_follows_the_torque_that_acts(biped, gait):
    """Where no torque acts, K_i s approaches what makes v that of no torque with the time constant T_t: after
    three of them e^-3 of the way is left, with e = e_f = 0.
    """
    law = NPIDController(gait.constraint)
    m = Walker(biped, law).measure(0.0, *gait.start(biped), Mode())
    s, none, T_t = FilterState(*np.zeros((3, 4))), np.zeros(4), law.tracking_time
    first, tick = law.shortfall(s, m, none)[2], law.sampled(1e-4)
    for _ in range(round(3.0 * T_t / 1e-4)):
        s = tick.predict(s, m, none)
    left = law.shortfall(s, m, none)[2] / first
    assert left == pytest.approx(np.full(4, np.exp(-3.0)), rel=0.01)


def test_a_pid_like_adrc_has_the_transfer_function_of_its_observer():
    """C(s) = (K_d s^2 + K_p s + K_i) / (s (s^2 / w^2 + 2 zeta s / w + 1)) of the filtered PID is k (s I - A + L
    C + B k)^-1 L of ADRC with u = -k z and a triple pole of its observer at -w_o, here at some s.
    """
    w_o, k_p, k_d, s = 300.0, 900.0, 40.0, 70.0 + 200.0j
    pid = NPIDController.like_adrc(at_rest(np.zeros(5)), ba.Gains(k_p, k_d), w_o)
    l_1, l_2, l_3 = 3.0 * w_o, 3.0 * w_o**2, w_o**3
    observer = np.array([[s + l_1, -1.0, 0.0], [l_2 + k_p, s + k_d, 0.0], [l_3, 0.0, s]])
    C = np.array([k_p, k_d, 1.0]) @ np.linalg.solve(observer, [l_1, l_2, l_3])
    w, zeta, (K_p, K_d) = pid.filter_bandwidth, pid.damping, (pid.gains.K_p, pid.gains.K_d)
    found = (K_d * s * s + K_p * s + pid.K_i) / (s * (s * s / w**2 + 2.0 * zeta * s / w + 1.0))
    assert found == pytest.approx(C, rel=1e-12)


def test_the_largest_integral_gain_is_that_of_routh(gait):
    """K_i < K_p K_d = 250000 for a filter without a lag, here of 1e7 rad/s: 1 % less is accepted, 1 % more
    refused.
    """
    limit, fast = K_P * K_D, 1e7
    assert NPIDController(gait.constraint, K_i=0.99 * limit, filter_bandwidth=fast)
    with pytest.raises(
        InputError, match=r"K_i = 252500 and a filter of 1e\+07 .* K_d = 250000 1/s"
    ):
        NPIDController(gait.constraint, K_i=1.01 * limit, filter_bandwidth=fast)


# -- linear ADRC and the high-gain observer ----------------------------------------------------
@pytest.mark.parametrize("alpha", [None, (4.0, 6.0, 4.0)])
def test_the_high_gain_observer_is_gpi_with_the_same_poles(alpha):
    """Gains, flow and discrete form are those of GPI with the poles of the high-gain observer: the roots of s^3
    + alpha_1 s^2 + alpha_2 s + alpha_3, over epsilon.

    Both scale their states by powers of their own `scale`. By default the root is triple, which leaves a third
    of the digits: hence 1e-4, and `clean` drops imaginary parts that are round-off.
    """
    epsilon, random = 0.004, np.random.default_rng(1)
    observer = HighGainObserver.from_epsilon(epsilon, alpha)
    gpi = GPIObserver.from_poles([complex(pole) for pole in clean(observer.poles)])
    assert observer.gains == pytest.approx(gpi.gains, rel=1e-4)
    y, u = random.normal(size=(2, 4))
    x = random.normal(size=(3, 4))
    one, other = (o.flow(o.initial_state(*x), y, u) for o in (observer, gpi))
    weights = [(o.scale ** np.arange(3))[:, np.newaxis] for o in (observer, gpi)]
    physical = [dz * w for dz, w in zip((one, other), weights, strict=True)]
    assert physical[0] == pytest.approx(physical[1], rel=1e-3)
    A = observer.error_system().A
    assert np.poly(A * epsilon) == pytest.approx([1.0, *observer.alpha], rel=1e-9)
    made, expected = (o.sampled(1e-3).L for o in (observer, gpi))
    assert made == pytest.approx(expected, rel=1e-4)


def clean(poles):
    """Poles without the imaginary parts that round-off gives equal ones."""
    return [pole.real if abs(pole.imag) < 1e-3 * abs(pole) else pole for pole in poles]


# -- anti-windup -------------------------------------------------------------------------------
@dataclass(frozen=True)
class Unlimited(Around):
    """A controller whose observer is told the torque asked for, not the one applied."""

    def predict(self, s, m, u):
        return self.inner.predict(s, m, self.inner.output(s, m))


@pytest.mark.parametrize("kind", [slow(OutputADRCController), MomentumDOBController])
def test_the_observer_is_told_the_torque_applied(biped, gait, kind):
    """A push that the motors cannot answer: the estimate stays near q_b'' - kappa u, and the walk goes on. Told
    the torque asked for (`Unlimited`), the same observer is off by five times xi.
    """
    push = ba.TorquePulse([110.0, -110.0, 110.0, -110.0, 0.0], step=2, start=0.1, stop=0.2)
    law, errors = kind(gait.constraint), []
    for told in (law, Unlimited(law)):
        walker = Walker(biped, told, push, SampledTime(1e-3), torque_limit=100.0)
        walk = ba.walk(walker, gait, 4, ba.RK4(1e-3), engine="compiled")
        s = walk.signals.of_step(2)
        during = (s.t - s.t[0] > 0.12) & (s.t - s.t[0] < 0.2)
        assert np.max(np.abs(s.u[during])) == 100.0
        wrong = np.linalg.norm((s.xi_estimate - s.xi)[during], axis=1)
        errors.append(np.median(wrong) / np.median(np.linalg.norm(s.xi[during], axis=1)))
        if told is law:
            assert walk.trajectory.status.ok
            late = walk.signals.of_step(4)
            assert np.max(np.abs(late.error)) < 5e-3
        else:
            assert not walk.trajectory.status.ok
    near, off = errors
    assert near < 0.05, errors
    assert off > 5.0, errors


# -- ADRC told the nominal xi -----------------------------------------------------------------------
KIND = {"controller.name": "ADRC assisted", "gait.name": "v0.5", "run.impacts": 2}
PUSHED = {"pushes": "q1,q2,q3,q4=10@1:0-9", "hardware.period": 1e-3, "run.engine": "compiled"}


def settled(**more):
    found = ba.walk_scenario(ba.Scenario(**KIND, **PUSHED, **more)).signals
    return found, (found.t > 0.2) & (found.t < 0.3)


@pytest.mark.parametrize("order", [0, 1])
def test_on_the_exact_model_adrc_walks_as_npd(order):
    """ADRC "assisted" adds the model's xi to the estimate: in continuous time nothing is left for the observer,
    so (q, q') at the end is that of NPD to integration accuracy. order: m, of the observer.
    """
    law = {"name": "ADRC assisted", "observer": {"order": order, "bandwidth": 200.0}}
    npd, told = (
        ba.walk_scenario(
            ba.Scenario(
                controller,
                gait="v0.5",
                start={"speed": 0.02},
                run={"method": "rk4", "h": 5e-4, "impacts": 2},
            )
        ).trajectory
        for controller in ("NPD", law)
    )
    n = 10
    assert np.max(np.abs(told.final_state[:n] - npd.final_state[:n])) < 1e-8


def test_the_estimate_is_the_whole_disturbance():
    """Under 10 N m on all joints the estimate of ADRC assisted, the model's xi plus that of the rest with m =
    1, is xi of the plant. From 0.2 to 0.3 s (`late`), when it has settled, it misses less than 10 % of
    xi_external, the part of xi that the model does not know.
    """
    found, late = settled(**{"controller.observer.bandwidth": 300.0})
    missed = np.abs(found.xi_estimate - found.xi)[late]
    assert np.max(missed) < 0.1 * np.max(np.abs(found.xi_external)[late])
