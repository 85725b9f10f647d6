"""The three-link walker of the literature: its model, and its cycle under three feedbacks of its outputs.

Grizzle, Abba, Plestan, IEEE TAC 46(1), 2001; Westervelt et al., Feedback Control of Dynamic Bipedal Robot
Locomotion, 2007. Absolute angles th = (stance leg, swing leg, torso), clockwise from the vertical:

    y1 = th3 - p3(th1),   y2 = th2 + th1 - p2(th1) (th1^2 - th1d^2),   th1d = pi / 8

A step ends at th1 = th1d, as in the source: with this constraint the swing foot passes below the ground.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.optimize import newton

import biped_adrc as ba
from biped_adrc.control.finite_time import FiniteTimeController
from biped_adrc.control.output_npd import OutputNPDController
from biped_adrc.errors import InputError
from biped_adrc.gait.curves import Polynomial as PolynomialCurve
from biped_adrc.gait.outputs import LinearOutputs
from biped_adrc.hybrid.system import Guard, HybridSystem

ROBOT = ba.Biped.load("three_link")
END = math.pi / 8
A = (0.512, 0.073, 0.035, -0.819, -2.27, 3.26, 3.11, 1.89)
P3 = Polynomial(A[:4])
P2 = Polynomial(A[4:]) * Polynomial([-(END**2), 0.0, 1.0])

# q = TO_Q th + ZERO: absolute angles counter-clockwise, a hanging leg at pi; hips from the torso
TO_Q = np.array([[-1.0, 0.0, 1.0], [0.0, -1.0, 1.0], [0.0, 0.0, -1.0]])
ZERO = np.array([math.pi, math.pi, 0.0])


def outputs() -> LinearOutputs:
    """y = H0 q - h_d(Theta), Theta = pi - th1, s = (th1 + th1d) / (2 th1d)."""
    th1 = Polynomial([-END, 2.0 * END])
    torso, swing = P3(th1), P2(th1) - 2.0 * math.pi
    a = np.zeros((2, 6))
    a[0, : len(torso.coef)], a[1, : len(swing.coef)] = torso.coef, swing.coef
    desired = ba.VirtualConstraint(PolynomialCurve(a), ROBOT.phase, math.pi + END, math.pi - END)
    return LinearOutputs(np.array([[0.0, 0.0, -1.0], [-1.0, -1.0, -2.0]]), desired)


def before_impact(omega: float) -> tuple[np.ndarray, np.ndarray]:
    """(q-, q'-) with y = y' = 0 at th1 = th1d, th1' = omega."""
    th = np.array([END, P2(END) - END, P3(END)])
    slope = np.array([1.0, P2.deriv()(END) - 1.0, P3.deriv()(END)])
    return TO_Q @ th + ZERO, TO_Q @ slope * omega


@dataclass(frozen=True)
class EndsAtPhase(HybridSystem):
    """The walker, with impact where the stance leg has come to th1d."""

    walker: ba.Walker

    def flow(self, t, x, mode):
        return self.walker.flow(t, x, mode)

    def guards(self, mode):
        return (
            Guard(
                "impact",
                lambda t, x: float(ROBOT.phase @ x[:3]) - (math.pi - END),
                lambda t, x: self.walker.strike(t, x, mode),
            ),
        )


def step(controller: ba.Controller, omega: float, method: ba.Adaptive) -> tuple[float, float]:
    """P(omega) [rad/s] and the period [s]."""
    walker = ba.Walker(ROBOT, controller)
    impact = ROBOT.impact(*before_impact(omega))
    x = walker.initial_state(impact.q, impact.v)
    run = ba.simulate(
        EndsAtPhase(walker), x, ba.Mode(), method, t_end=3.0, stop_after=("impact", 1)
    )
    assert run.status is ba.Status.COMPLETED
    (end,) = run.events("impact")
    return -float(ROBOT.phase @ end.x_minus[3:6]), end.t


def cycle(controller: ba.Controller, method: ba.Adaptive) -> tuple[float, float, float]:
    """omega*, period and dP/domega."""
    omega = newton(lambda w: step(controller, w, method)[0] - w, 1.55, tol=1e-8)
    high, low = (step(controller, omega + h, method)[0] for h in (1e-3, -1e-3))
    returned, period = step(controller, omega, method)
    assert returned == pytest.approx(omega, abs=1e-8)
    return omega, period, (high - low) / 2e-3


def test_model_is_the_published_one() -> None:
    """D and Omega against the closed form for point masses in absolute angles, K o cos and K o sin."""
    r, m, M_H, M_T, L, g = 1.0, 5.0, 15.0, 10.0, 0.5, 9.8
    arms = [[r / 2, 0, 0], [r, 0, 0], [r, -r / 2, 0], [r, 0, L]]
    masses, arms = np.array([m, M_H, m, M_T]), np.array(arms)
    K = arms.T @ np.diag(masses) @ arms
    rng = np.random.default_rng(5)
    for _ in range(5):
        th, rate = rng.uniform(-1.5, 1.5, 3), rng.uniform(-3.0, 3.0, 3)
        d = th[:, np.newaxis] - th
        q, v = TO_Q @ th + ZERO, TO_Q @ rate
        D = TO_Q.T @ ROBOT.inertia(q) @ TO_Q
        np.testing.assert_allclose(D, K * np.cos(d), atol=1e-7)
        bias = (K * np.sin(d)) @ rate**2 - g * (masses @ arms) * np.sin(th)
        np.testing.assert_allclose(TO_Q.T @ ROBOT.bias(q, v), bias, atol=1e-7)


def test_outputs_are_the_published_ones() -> None:
    rng = np.random.default_rng(6)
    for th in rng.uniform(-1.0, 1.0, (5, 3)):
        o = outputs()(0.0, TO_Q @ th + ZERO, np.zeros(3))
        x = th[0]
        expected = [
            th[2] - (0.512 + 0.073 * x + 0.035 * x**2 - 0.819 * x**3),
            th[1] + x - (-2.27 + 3.26 * x + 3.11 * x**2 + 1.89 * x**3) * (x**2 - END**2),
        ]
        np.testing.assert_allclose(o.y, expected, atol=1e-14)


def test_cycle_under_proportional_derivative_feedback() -> None:
    """Both poles at -20 rad/s; digits from a separate derivation in absolute angles."""
    controller = OutputNPDController(outputs(), ba.Gains(400.0, 40.0))
    omega, period, slope = cycle(controller, ba.Adaptive())
    assert omega == pytest.approx(1.545015, rel=1e-6)
    assert period == pytest.approx(1.145869, rel=1e-6)
    assert slope == pytest.approx(0.5748, abs=1e-4)


def test_cycle_under_finite_time_feedback() -> None:
    """alpha and eps as published; digits from a separate integration in absolute angles with LSODA."""
    controller = FiniteTimeController(outputs(), alpha=0.9, eps=0.1)
    omega, period, slope = cycle(controller, ba.Adaptive(1e-6, 1e-8))
    assert omega == pytest.approx(1.549891, rel=1e-6)
    assert period == pytest.approx(1.121633, rel=1e-6)
    assert slope == pytest.approx(0.5771, abs=2e-4)


def test_joint_form_of_the_outputs() -> None:
    """q_b = h(Theta): y = y' = 0 along it, and NPD walks the same step: y = T (q_b - h), T constant."""
    y, gains = outputs(), ba.Gains(400.0, 40.0)
    joints = y.as_virtual_constraint()
    zero = ba.ZeroDynamics.of(ROBOT, joints)
    for q, dq in zip(zero.q, zero.dq, strict=True):
        o = y(0.0, q, dq)
        np.testing.assert_allclose(np.concatenate((o.y, o.dy)), 0.0, atol=1e-13)
    found = step(ba.NPDController(joints, gains), 1.5, ba.Adaptive())
    assert found == pytest.approx(step(OutputNPDController(y, gains), 1.5, ba.Adaptive()), rel=1e-8)


def test_finite_time_feedback_comes_to_rest_in_closed_form() -> None:
    """On phi = 0, x2' = -|x2|^alpha in the time t / eps: x2 = (x2(0)^(1-a) - (1-a) t/eps)^(1/(1-a))."""
    alpha, eps, th1 = 0.9, 0.05, -END
    x2_0 = eps * np.array([0.5, -0.3])
    y_0 = -np.sign(x2_0) * np.abs(x2_0) ** (2.0 - alpha) / (2.0 - alpha)
    th = np.array([th1, y_0[1] - th1 + P2(th1), y_0[0] + P3(th1)])
    dy_0 = x2_0 / eps
    rate = np.array([1.2, dy_0[1] + 1.2 * (P2.deriv()(th1) - 1.0), dy_0[0] + 1.2 * P3.deriv()(th1)])
    walker = ba.Walker(ROBOT, FiniteTimeController(outputs(), alpha, eps))
    x = walker.initial_state(TO_Q @ th + ZERO, TO_Q @ rate)
    run = ba.simulate(EndsAtPhase(walker), x, ba.Mode(), ba.Adaptive(1e-10, 1e-10), t_end=0.4)
    rest = eps * np.abs(x2_0) ** (1.0 - alpha) / (1.0 - alpha)
    assert np.all(rest < 0.36)
    for t in (0.05, 0.15, 0.25, 0.36, 0.4):
        o = outputs()(t, run(t)[:3], run(t)[3:])
        left = np.maximum((1.0 - alpha) * (rest - t) / eps, 0.0)
        dy = np.sign(x2_0) * left ** (1.0 / (1.0 - alpha)) / eps
        np.testing.assert_allclose(o.dy, dy, atol=1e-7)


@pytest.mark.parametrize(("alpha", "eps"), [(0.0, 0.1), (1.0, 0.1), (math.nan, 0.1), (0.9, 0.0)])
def test_exponents_and_times_that_cannot_be(alpha: float, eps: float) -> None:
    with pytest.raises(InputError, match=r"alpha is|eps is"):
        FiniteTimeController(outputs(), alpha, eps)
