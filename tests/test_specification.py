"""The specification of a candidate against walks, laws that were not used in it, and python-control.

A candidate is a walker: controller, sensors, clock and motors. Its specification is computed without a walk,
from the sampled loop linearised at phases of its gait: matrices M of a period, growth [1/s] of the fastest
mode, delay margin [s], disk margin, ripple [N m] of the torque by encoder counts. `loop_of(**values)` has a
walker, its gait, and the loop at the first phase; `candidate(values)` the first two, `specified` the
specification.
"""

from __future__ import annotations

from dataclasses import replace

import control
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import minimize

import biped_adrc as ba
from biped_adrc.analysis.loops.frozen_gait import FrozenGait, linear_twin
from biped_adrc.analysis.loops.specification import (
    balanced_bound,
    disk_margin,
    specification,
    structured_value,
)
from biped_adrc.analysis.loops.walker_loop import FREQUENCIES, response, robot_step
from biped_adrc.analysis.return_map import ReturnMap
from biped_adrc.analysis.tick_derivative import _differenced, tick_derivative
from biped_adrc.core.errors import BipedError
from biped_adrc.hardware.sensors import PitchSensor, Sensors
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.cycle import specification_of
from tests.plain import Undecorated

# -- walks, without a torque limit and, for multipliers, without counts: neither has a linear loop -----
SETTLING = 4
"""Steps before Newton's method looks for the cycle, after the first one."""


def candidate(values):
    """The walker of a scenario's values, with its gait."""
    s = ba.Scenario(**values)
    scene = RobotAndGait.of(s)
    return build(s, scene), scene.walked


def specified(walker, gait):
    """The specification with the plant alone and no other inertias, as the walks are of one robot."""
    frozen = FrozenGait.of(walker.plant, gait, walker.nominal, spread=0.0)
    return specification(walker, frozen)


def multiplier(walker, gait):
    """The largest |multiplier| of the walk, infinite for a walker that does not come back to the section."""
    step = 2.5e-4 if walker.motors is not None and walker.motors.lag else 1e-3
    P = ReturnMap(walker, ba.RK4(step))
    try:
        x = walker.initial_state(*gait.start(walker.plant))
        run = ba.simulate(walker, x, ba.Mode(), P.method, t_end=2.0, stop_after=("foot_strike", 1))
        if not run.status.ok:
            return np.inf
        s = P.project(run.events("foot_strike")[-1].x_minus)
        for _ in range(SETTLING):
            s = P(s)
        return float(abs(P.fixed_point(P.lift(s), tolerance=1e-7).multipliers[0]))
    except BipedError:
        return np.inf


def torques(walker, gait, end):
    """The torque held after each sample instant from 50 ms to `end` [s] of the first step (K, p) [N m]."""
    x, T = walker.initial_state(*gait.start(walker.plant)), walker.timing.period
    arc = ba.simulate(walker, x, ba.Mode(), ba.RK4(0.5 * T), t_end=end).arcs[0]
    middle = np.arange(round(0.05 / T), int(end / T) - 1) * T + 0.5 * T
    return np.asarray(arc.x[np.searchsorted(arc.t, middle - 1e-9), -walker.plant.p :])


def rippled(values):
    """Ripple [N m] of the motor with most on RABBIT's hardware, by the specification and in a walk."""
    walker, gait = candidate(
        {
            "hardware.profile": "rabbit",
            "hardware.friction": False,
            "hardware.torque_limit": 1e6,
            "run.impacts": 2,
            **values,
        }
    )
    spec = specified(walker, gait)
    exact = replace(walker, sensors=walker.sensors.smooth())
    end = 0.9 * gait.period
    difference = torques(walker, gait, end) - torques(exact, gait, end)
    return spec.ripple, float(np.max(np.std(difference, axis=0)))


def loop_of(**values):
    """The walker of some values, its gait, and the loop at the first phase."""
    walker, gait = candidate({"run.impacts": 2, "hardware.period": 1.5e-3, **values})
    return walker, gait, specified(walker, gait).loops[0, 0]


# -- against walks ---------------------------------------------------------------------------------
LOOP = {
    "controller.name": "LESO",
    "hardware.period": 1e-3,
    "hardware.encoders.velocity": "differences",
    "hardware.encoders.filter_time": 2e-3,
}
"""Values of a scenario with one structure, which is compiled once for the test."""


def test_a_walk_bears_nine_tenths_of_the_delay_margin_and_not_eleven():
    """The delay margin of the linear loop against simulated walks: with 0.9 of it as delay the return map's
    largest |multiplier| is below 1, with 1.1 of it above, or the walk does not come back at all (infinite)."""
    walker, gait = candidate({"run.impacts": 2, "controller.observer.bandwidth": 300.0, **LOOP})
    spec = specified(walker, gait)
    found = []
    for share in (0.9, 1.1):
        late = replace(walker.timing, delay=share * spec.delay_margin)
        late = replace(walker, timing=late)
        found.append(multiplier(late, gait))
        assert specified(late, gait).stable == (share < 1.0)
    assert found[0] < 1.0 < found[1]


FILTERED = {
    "controller.name": "LESO",
    "controller.observer.bandwidth": 160.0,
    "controller.observer.order": 2,
    "hardware.encoders.filter_time": 5e-3,
}


@pytest.mark.parametrize("values", [{"controller": "NPD"}, FILTERED], ids=["NPD", "LESO"])
def test_ripple_is_that_of_a_walk_with_counts(values):
    """The rms torque by the linear loop against a simulated step on RABBIT's hardware, with encoder counts
    minus without; 25 % is left to the motion and to a nonlinear walk."""
    by_specification, by_walk = rippled(values)
    assert by_walk / 1.25 < by_specification < 1.25 * by_walk


def missed(T, **values):
    """By how much the matrices miss two walks that begin a little apart, over ten periods T [s], relatively.

    The walks are those of the walker itself; what lasts a while in `values` is given in periods.
    """
    times = ("delay", "lag", "filter_time", "prediction")
    lasting = {name: x * T for name, x in values.items() if name.endswith(times)}
    walker, gait, loop = loop_of(**{**values, **lasting, "hardware.period": T})
    n, p = walker.plant.n, walker.plant.p
    frozen = FrozenGait.of(walker.plant, gait, spread=0.0)
    point = frozen.points[0]
    # a pendulum upside down: z theta'' = g theta, theta = exp(rate t)
    z = walker.plant.hip(point.q)[1]
    assert frozen.falling**2 * z == pytest.approx(9.81, rel=1e-12)
    deviation = 1e-6 * np.array(
        [1.0, -2.0, 0.5, 1.5, -1.0, *np.array([5.0, 9, -3, 7, 4]) * 1e-3 / T]
    )
    twin, on = linear_twin(walker), np.concatenate((point.q, point.v))
    x = twin.tick(0.0, twin.initial_state(point.q - T * point.v, point.v), ba.Mode())
    x[: 2 * n] = on
    if walker.motors is not None:  # their torque stands before what waits and what acts
        x = np.concatenate((x[: -2 * p], x[-p:], x[-2 * p :]))
    starts = (x, x + np.pad(deviation, (0, len(x) - 2 * n)))
    runs = [
        ba.simulate(walker, y, ba.Mode(), ba.RK4(T / 6), t_end=10.5 * T).arcs[0] for y in starts
    ]
    at = np.searchsorted(runs[0].t, (np.arange(10) + 1) * T - 1e-3 * T)
    found = (runs[1].x[at] - runs[0].x[at])[:, :n]
    M = loop.matrices().M
    X = np.pad(deviation, (0, len(M) - 2 * n))
    expected = np.array([(X := M @ X)[:n] for _ in range(10)])
    return np.max(np.abs(found - expected)) / np.max(np.abs(expected))


LESO = {"controller.name": "LESO", "controller.observer.bandwidth": 200.0, "hardware.delay": 1.6}
DOB = {"controller.name": "DOB", "hardware.delay": 2, "hardware.encoders.filter_time": 1.5}
NPD = {"controller.name": "NPD", "hardware.delay": 0.5, "hardware.friction": True}
DIFFERENCES = {"hardware.encoders.velocity": "differences"}


@pytest.mark.parametrize(
    "values",
    [
        {**LESO, "hardware.lag": 0.7},
        {**LESO, "hardware.delay_known": True},
        {**LESO, "controller.prediction": 1.6},
        {**DOB, **DIFFERENCES},
        {**NPD, "controller.feedforward": 0.8},
    ],
)
def test_a_small_deviation_goes_as_the_matrices_say(values):
    """Two walks of the robot that start a little apart are compared with the powers of M, over ten periods. M
    is frozen at a phase: what it misses (`missed`, relative) is the gait's motion in ten periods, which falls
    with the period T. Delays, lags and filter times in `values` are in periods.
    """
    coarse, fine = (missed(T, **values) for T in (1e-3, 2.5e-4))
    assert fine < 0.15 * coarse < 1e-3


# -- the matrices ----------------------------------------------------------------------------------
def test_the_derivative_of_a_tick_is_that_of_differences():
    """The derivative of a sample instant by the compiled code is compared with central differences of it, for
    an observer with a delay and rates by differences; 1e-5 is the accuracy of these.
    """
    walker, gait, _ = loop_of(**{"controller": "LESO", "hardware.delay": 1e-3, **DIFFERENCES})
    twin = linear_twin(walker)
    q, v = gait.start(walker.plant)
    x = twin.tick(0.0, twin.initial_state(q, v), ba.Mode())
    after, J = tick_derivative(twin, twin.layout_of(x))(1.5e-3, x, ba.Mode())
    expected, K = _differenced(twin, 1.5e-3, x, ba.Mode())
    np.testing.assert_allclose(after, expected, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(J, K, rtol=1e-5, atol=1e-5 * np.max(np.abs(K)))


def test_a_controller_in_plain_python_has_a_specification():
    """NPD hidden in a class that cannot be compiled (`Undecorated`) is differenced at its ticks: the growth of
    its worst mode agrees to 30 %, enough to tell stable from unstable.
    """
    walker, gait, _ = loop_of(controller={"name": "NPD", "solve_theta": False})
    one = replace(walker, controller=Undecorated(walker.controller))
    by_differences, by_laws = (specified(w, gait) for w in (one, walker))
    assert by_differences.worst.growth == pytest.approx(by_laws.worst.growth, rel=0.3)
    assert by_differences.stable


def test_the_torque_moves_the_outputs_by_L(biped, gait):
    """y'' = (S - h' c) q'' is L u with L = (I - H_b - H_N A_N) kappa. B[0] is of the plant, B[3] of a robot
    with a heavier trunk and lighter legs: its error is a matrix that couples the joints, not one factor for
    all, which would be a multiple of the unit matrix."""
    frozen = FrozenGait.of(biped, gait)
    n, p, h = biped.n, biped.p, gait.constraint
    heavy = ba.ModelErrors(mass={"torso": 0.2}, inertia={"torso": 0.2}).apply(biped)
    assert heavy.p == p  # other masses leave the number of motors
    for point in frozen.points:
        H = np.outer(h.h(float(h.phase @ point.q))[1], h.phase)
        r = biped.reduction(point.q, point.v)
        L = (np.eye(p) - H[:, :p] - H[:, p:] @ r.A_N) @ r.kappa
        outputs = np.eye(p, n) - H
        np.testing.assert_allclose(
            outputs @ point.B[0, n:], L, rtol=0.0, atol=1e-12 * np.abs(L).max()
        )
        wrong = (outputs @ point.B[3, n:]) @ np.linalg.inv(L)
        assert np.abs(wrong - np.trace(wrong) / p * np.eye(p)).max() > 0.05  # no scalar


def test_a_torque_that_changes_within_the_period():
    """The torque changes at the share f of a period T, as after a delay of a part of it: a double integrator in
    closed form, and with lagging motors against SciPy, from 5 to -7 N m."""
    A, B, T, f = np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([[0.0], [1.0]]), 2e-3, 0.3
    Phi, G_1, G_2 = robot_step(A, B, T, f, 0.0)
    np.testing.assert_allclose(Phi, [[1.0, T], [0.0, 1.0]])
    np.testing.assert_allclose(G_1[:, 0], [(f - f**2 / 2) * T**2, f * T])
    np.testing.assert_allclose(G_2[:, 0], [(1 - f) ** 2 / 2 * T**2, (1 - f) * T])
    lag, x = 1e-3, np.array([0.1, -0.2, 3.0])

    def flow(t, x):
        return [x[1], x[2], ((5.0 if t < f * T else -7.0) - x[2]) / lag]

    Phi, G_1, G_2 = robot_step(A, B, T, f, lag)
    options = {"rtol": 1e-12, "atol": 1e-14}
    half = solve_ivp(flow, (0.0, f * T * (1 - 1e-12)), x, **options).y[:, -1]
    end = solve_ivp(flow, (f * T, T), half, **options).y[:, -1]
    np.testing.assert_allclose(Phi @ x + G_1[:, 0] * 5.0 - G_2[:, 0] * 7.0, end, rtol=1e-9)


def test_a_hidden_delay_is_as_one_of_the_clock_that_the_controller_does_not_know():
    """1.7 ms unknown beside the clock's 1 ms is a clock with 2.7 ms: the same growth. The margin parts stable
    from unstable to 0.1 %; it is at most the delay up to which it is looked for."""
    _, _, loop = loop_of(controller="LESO", hardware={"delay": 1e-3})
    _, _, later = loop_of(controller="LESO", hardware={"delay": 2.7e-3})
    assert loop.growth(1.7e-3) == pytest.approx(later.growth(), rel=1e-6)
    margin = loop.delay_margin(0.05)
    assert loop.growth(0.999 * margin) < 0.0 < loop.growth(1.001 * margin)
    assert loop.delay_margin(0.5 * margin) == 0.5 * margin  # looked for up to there


# -- sensors ---------------------------------------------------------------------------------------
def test_errors_of_sensors_are_those_of_what_they_show():
    """The standard deviations by formula are compared with 3000 simulated readings at random angles, 6 % for
    their scatter. Rates that are not measured have no error, `smooth()` has none at all; a second sensor
    replaces the pitch.
    """
    n, p = 5, 4
    sensors = Sensors(counts=1000.0, noise=1e-3, velocity="gyro", rate_noise=0.1)
    sampled = sensors.sampled(n, p, 1e-3)
    random, w = np.random.default_rng(0), sampled.start(np.zeros(n), np.zeros(n))
    rows = []
    for q in random.uniform(-1.0, 1.0, (3000, n)):
        w = sampled.sense(w, q, np.zeros(n))
        rows.append(np.append(w.angle - q, w.rate[-1]))
    errors = sensors.errors(n, p, np.zeros(2 * n))
    # of the five angles, and of the last rate, which the gyroscope measures
    np.testing.assert_allclose(np.std(rows, axis=0), errors[[0, 1, 2, 3, 4, 9]], rtol=0.06)
    assert not np.any(errors[n : 2 * n - 1])
    assert not np.any(sensors.smooth().errors(n, p, np.zeros(2 * n)))
    both = sensors + PitchSensor(noise=0.5)
    shown = both.errors(n, p, np.zeros(2 * n))
    assert shown[n - 1] == 0.5
    assert shown[-1] == 0.0
    np.testing.assert_array_equal(shown[: n - 1], errors[: n - 1])
    assert not both.smooth().noisy


# -- the disk margin -------------------------------------------------------------------------------
def sensitivity(L, w):
    S = control.feedback(control.ss([], [], [], np.eye(L.ninputs), dt=L.dt), L)
    r = S.frequency_response(w, squeeze=False)
    return (r.magnitude * np.exp(1j * r.phase)).transpose(2, 0, 1)


@pytest.mark.parametrize("dt", [0, 0.05])
def test_one_loop_as_python_control(dt):
    """The loop is in continuous time, and sampled at 0.05 s: the disk margin of the library is ours, from the
    same frequencies.
    """
    L = control.tf([25.0], [1.0, 10.0, 10.0, 10.0])
    L = control.ss(L) if dt == 0 else control.c2d(control.ss(L), dt)
    w = np.geomspace(0.1, 60.0, 300)
    expected = control.disk_margins(L, w)[0]
    assert disk_margin(sensitivity(L, w)) == pytest.approx(expected, rel=1e-6)


def test_two_loops_of_a_spinning_body():
    """The body is the example of python-control's `disk_margins`; 0.3769872637 is what it gives with SLICOT's
    AB13MD.
    """
    P = control.ss([[0, 10], [-10, 0]], np.eye(2), [[1, 10], [-10, 1]], 0)
    K = control.ss([], [], [], [[1, -2], [0, 1]])
    S = sensitivity(P * K, np.geomspace(0.1, 1e3, 1001))
    assert disk_margin(S) == pytest.approx(0.37698726369443553, rel=1e-6)


@pytest.mark.parametrize("p", [1, 2, 3])
def test_the_structured_value_is_reached_by_a_diagonal_matrix(p):
    """mu = max over phases of the spectral radius of diag(exp(i phi)) M, the bound from below."""
    random = np.random.default_rng(p)
    M = random.normal(size=(p, p)) + 1j * random.normal(size=(p, p))

    def radius(phi):
        turned = np.exp(1j * np.append(phi, 0.0))[:, np.newaxis] * M
        return -np.max(np.abs(np.linalg.eigvals(turned)))

    options = {"xatol": 1e-10, "fatol": 1e-13, "maxiter": 2000}
    starts = random.uniform(-3.0, 3.0, (6, p - 1)) if p > 1 else []
    found = [-minimize(radius, x, method="Nelder-Mead", options=options).fun for x in starts]
    value = structured_value(M)
    assert value == pytest.approx(max(found, default=abs(M[0, 0])), rel=1e-7)
    assert value <= balanced_bound(M[np.newaxis])[0] * (1 + 1e-9)


@pytest.mark.parametrize(
    "late",
    [{"hardware.delay": 1.2e-3, "hardware.lag": 1e-3}, {"hardware.encoders.velocity": "measured"}],
)
def test_sensitivity_of_a_walker_is_that_of_its_open_loop(late):
    """S = 1 / (1 - G), with G from the torque to the torque that the controller then asks for, by cutting the
    loop's matrix M open at the torques (M - B C); the product with 1 - G has to be the unit matrix, and S
    what the loop says."""
    _, _, loop = loop_of(controller="LESO", **late)
    # the last p inputs of B and D are errors that are added to the torques
    M, B, C, D = loop.matrices()
    p, nyquist = len(C), np.pi / loop.period
    # the frequencies of `loop.sensitivity`, which has those of the modes behind them
    w = np.geomspace(loop.slow, nyquist, FREQUENCIES)
    z = np.exp(1j * w * loop.period)[:, np.newaxis, np.newaxis]
    S = response(z, M, B[:, -p:], C) + D[:, -p:]
    G = response(z, M - B[:, -p:] @ C, B[:, -p:], C)
    np.testing.assert_allclose(S @ (np.eye(p) - G), [np.eye(p)] * len(w), rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(
        loop.sensitivity()[: len(w)], S, rtol=0.0, atol=1e-9 * np.max(np.abs(S))
    )


# -- all loops together ----------------------------------------------------------------------------
def test_loops_together_are_the_loops_one_by_one():
    """4 phases times 5 robots of other inertias, computed at once, are compared with each alone: with a filter
    and old angles in the state z, and a torque that changes within the period. The margin is the least of all
    20.
    """
    s = ba.Scenario(
        {"name": "LESO", "observer": {"bandwidth": 160.0}},
        hardware={"profile": "rabbit", "encoders": {"filter_time": 2e-3}, "delay": 1e-3},
    )
    loops = specification_of(s).loops
    each = [loops[i, j] for i in range(4) for j in range(5)]
    np.testing.assert_allclose(loops.growth().ravel(), [one.growth() for one in each], rtol=1e-9)
    # delays are searched up to 0.05 s
    margins = [one.delay_margin(0.05) for one in each]
    assert loops.delay_margin(0.05) == pytest.approx(min(margins), abs=2e-9)
    assert np.ptp(margins) > 1e-4
    # the first 100 frequencies are the same for all; those of a loop's own modes follow
    np.testing.assert_allclose(loops[2, 3].sensitivity()[:100], loops.sensitivity()[2, 3, :100])


def test_a_controller_without_a_state_has_a_delay_margin():
    """NPD has no state of its own, unlike ADRC. At the margin the first of its loops grows, and none before."""
    # delays are searched up to 0.05 s
    loops = specification_of(ba.Scenario("NPD", hardware={"period": 1e-3})).loops
    margin = loops.delay_margin(0.05)
    assert np.max(loops.growth(0.999 * margin)) < 0.0 < np.max(loops.growth(1.001 * margin))
