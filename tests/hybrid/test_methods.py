"""One-step methods: order of convergence, energy, and the exponential method's own functions.

`order(errors, steps)` is the slope of log error over log step. The exponential method integrates E' = A E + N
exactly in A, which a system names in its `split`; phi_j are its functions of the matrix h A.
"""

import math

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.special import ellipk

import biped_adrc as ba
from biped_adrc.engine.run import simulate_by
from biped_adrc.hybrid.exponential import Exponential, phi_levels
from biped_adrc.hybrid.integrators import RK4, Adaptive
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.hybrid.system import Guard, HybridSystem, Relaxing, Split
from biped_adrc.observers.gpi import TABLE_I


class Pendulum(HybridSystem):
    """theta'' = -sin(theta)."""

    def flow(self, t, x, mode):
        return np.array([x[1], -math.sin(x[0])])

    def guards(self, mode):
        return (Guard("bottom", lambda t, x: x[0], lambda t, x: (x, mode)),)


def order(errors, steps):
    return float(np.polyfit(np.log(steps), np.log(errors), 1)[0])


@pytest.mark.parametrize("method", [RK4(1e-3), Adaptive(rtol=1e-11, atol=1e-11)])
def test_pendulum_period_by_elliptic_integral(method):
    """From rest at 2 rad the pendulum is at the bottom after a quarter of the period, and again on the same way
    after a whole one; the event is where the angle falls through zero.
    """
    amplitude = 2.0
    run = simulate(Pendulum(), np.array([amplitude, 0.0]), 0, method, t_end=20.0)
    period = 4.0 * ellipk(math.sin(amplitude / 2) ** 2)
    times = [event.t for event in run.events("bottom")]
    assert times[0] == pytest.approx(period / 4, abs=1e-7)
    assert times[1] - times[0] == pytest.approx(period, abs=1e-7)


class Driven(HybridSystem):
    """x'' = -w^2 x + y, y' = -(y - u) / tau: state (x, x', y, u); its closed form is `exact`."""

    W, U, Y = 3.0, 2.0, -40.0

    def __init__(self, tau):
        self.tau = tau

    def flow(self, t, x, mode):
        return np.array([x[1], -(self.W**2) * x[0] + x[2], (x[3] - x[2]) / self.tau, 0.0])

    def relaxing(self):
        return Relaxing(slice(2, 3), slice(3, 4), 1.0 / self.tau)

    def exact(self, t, x=0.3, v=-0.5):
        w, tau = self.W, self.tau
        forced = (self.Y - self.U) * tau**2 / (1.0 + (w * tau) ** 2)  # of e^(-t / tau)
        a, b = x - self.U / w**2 - forced, (v + forced / tau) / w
        decay = math.exp(-t / tau)
        return np.array(
            [
                a * math.cos(w * t) + b * math.sin(w * t) + self.U / w**2 + forced * decay,
                -a * w * math.sin(w * t) + b * w * math.cos(w * t) - forced / tau * decay,
                self.U + (self.Y - self.U) * decay,
            ]
        )


@pytest.mark.parametrize("tau", [1e-9, 1e-5, 2e-3, 0.1])
def test_what_relaxes_in_a_step_is_exact_and_the_motion_of_order_four(tau):
    """y' = -(y - u) / tau drives an oscillator. y is exact to round-off for any time constant, also far below
    the step; the oscillator is of order four, up to what the jump of y at the start leaves.
    """
    system, steps = Driven(tau), np.array([4e-2, 2e-2, 1e-2])
    x0, end = np.array([0.3, -0.5, system.Y, system.U]), 0.4
    runs = [simulate(system, x0, 0, RK4(float(h)), t_end=end) for h in steps]
    exact = system.exact(end)
    assert all(abs(run.final_state[2] - exact[2]) < 1e-12 for run in runs)
    errors = np.array([np.max(np.abs(run.final_state[:2] - exact[:2])) for run in runs])
    # h^4 of the motion, and tau h^2 that the jump Y - U leaves; runs reach at most a third of this bound
    gap = abs(system.Y - system.U) * system.W**2
    assert np.all(errors < 0.1 * gap * steps**4 + gap * tau * steps**2 / 20.0)
    if tau < 1e-7 or tau > 9e-3:  # between them the second error hides the order
        assert 3.7 < order(errors, steps) < 4.3
    between = runs[-1](0.3 * steps[-1])[2]
    assert system.Y - 0.4 <= between <= system.U + 0.4  # overshoots by 1 % of the jump at most


@pytest.mark.parametrize("h", [0.3, 5.0])
def test_the_matrices_of_each_length_against_matrix_exponentials(h):
    """phi_0 to phi_3 are the first row of one exponential of a block matrix (`phi_functions`); the table has
    their sums as in the method's weights, for steps h, h / 2, h / 4. h = 5 s needs doubling, where the series
    does not converge.
    """
    A = np.random.default_rng(0).normal(size=(4, 4))
    for level, table in enumerate(phi_levels(h, A)[:3]):
        step = h * 0.5**level
        half, (full, p1, p2, p3) = (phi_functions(c * step * A) for c in (0.5, 1.0))
        weights = (p1 - 3 * p2 + 4 * p3, 2 * p2 - 4 * p3, 4 * p3 - p2)
        expected = (half[0], 0.5 * step * half[1], full, *(step * w for w in weights))
        for found, one in zip(table, expected, strict=True):
            np.testing.assert_allclose(found, one, rtol=0, atol=1e-13 * np.max(np.abs(full)))


def phi_functions(Z):
    k = len(Z)
    block = np.kron(np.eye(4, k=1), np.eye(k))
    block[:k, :k] = Z
    return np.hsplit(expm(block)[:k], 4)


class StiffPlusSmooth(HybridSystem):
    """E' = a E + c p, p' = cos(t) - p E: a stiff linear part and a nonlinear one."""

    a = -2000.0

    def flow(self, t, x, mode):
        p, E = x
        return np.array([math.cos(t) - p * E, self.a * E + 50.0 * p])

    def split(self, mode):
        return Split(
            lambda x: (x[:1], x[1:].reshape(1, 1)),
            lambda p, E: np.concatenate((p, E.ravel())),
            np.array([[self.a]]),
            lambda t, p, E: (np.array([math.cos(t) - p[0] * E[0, 0]]), np.array([[50.0 * p[0]]])),
        )


def test_exponential_method_is_stable_where_rk4_is_not_and_right():
    """With a stiff pole of -2000 1/s and steps of 5 ms the method is within 1e-5 of the solution with step
    control, where RK4 diverges or ends.
    """
    system, x0 = StiffPlusSmooth(), np.array([0.5, 0.0])
    exact = simulate(system, x0, 0, Adaptive(1e-11, 1e-12), t_end=1.0).final_state
    error = np.max(
        np.abs(simulate(system, x0, 0, Exponential(5e-3), t_end=1.0).final_state - exact)
    )
    assert error < 1e-5
    # h |a| = 10 is far outside RK4's region, which ends at 2.8
    unstable = simulate(system, x0, 0, RK4(5e-3), t_end=1.0)
    assert not (unstable.status.ok and np.max(np.abs(unstable.final_state - exact)) < 1e-2)


@pytest.mark.parametrize("engine", ["pinocchio", "compiled"])
def test_order_of_the_exponential_method_on_a_smooth_closed_loop(biped, gait, engine):
    """The method is of order four with poles of Table I times 0.05, slow beside the steps, over the first 0.16
    of 0.42 s of a walking step. The exact end is that with an eighth of the shortest step, in machine code.
    """
    observer = ba.GPIObserver.from_poles([0.05 * pole for pole in TABLE_I])
    walker = ba.Walker(biped, ba.ADRCController(gait.constraint, observer))
    x0 = walker.initial_state(*gait.start(biped))

    def end(h, engine=engine):
        run = simulate_by(engine, walker, x0, ba.Mode(), Exponential(h), t_end=0.16)
        return run.final_state[:10]  # (q, q') without the observer's state

    steps = np.array([4e-3, 2e-3, 1e-3])
    exact = end(1.25e-4, "compiled")
    assert order([np.max(np.abs(end(h) - exact)) for h in steps], steps) == pytest.approx(
        4.0, abs=0.3
    )


@pytest.mark.parametrize("length", [0.4, 1.96])
def test_a_step_of_another_length_has_its_own_phi_functions(length):
    """For E' = a E + c, p' = 1 the method is exact, also for 0.4 h and 1.96 h, which are made of sub-steps. The
    state is (p, E); both are compared to 1e-7 of themselves, NumPy's rtol.
    """
    h, a, c = 1e-3, -700.0, 3.0

    class Linear(HybridSystem):
        def flow(self, t, x, mode):
            return np.array([1.0, a * x[1] + c])

        def split(self, mode):
            return Split(
                lambda x: (x[:1], x[1:].reshape(1, 1)),
                lambda p, E: np.concatenate((p, E.ravel())),
                np.array([[a]]),
                lambda t, p, E: (np.ones(1), np.array([[c]])),
            )

    end = length * h
    found = simulate(Linear(), np.array([0.0, 2.0]), 0, Exponential(h), t_end=end).final_state
    exact = 2.0 * math.exp(a * end) + c * math.expm1(a * end) / a
    np.testing.assert_allclose(found, [end, exact], rtol=0.0, atol=1e-13)


def test_the_tolerance_decides_the_error():
    """A pendulum is back after its period, the elliptic integral; without a longest step (10 s here) rtol alone
    decides: a thousandth of it leaves less than 3 % of the error.
    """

    class Free(Pendulum):
        def guards(self, mode):
            return ()

    x0, T = np.array([0.5 * math.pi, 0.0]), 4.0 * ellipk(0.5)
    ends = [
        simulate(Free(), x0, 0, Adaptive(rtol, 1e-12, 10.0), t_end=T).final_state
        for rtol in (1e-3, 1e-6)
    ]
    rough, fine = (np.max(np.abs(x - x0)) for x in ends)
    assert fine < 1e-4
    assert fine < 0.03 * rough
