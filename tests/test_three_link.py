"""The three-link walker of the literature: its model, and its cycle under three feedbacks of its outputs.

Model, outputs and cycle: validation.three_link. th are the absolute angles of the literature (stance leg,
swing leg, torso), q = TO_Q th + ZERO ours. The outputs y(q) are to be zero; a step ends where th1 is END, pi
/ 8.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.finite_time import FiniteTimeController
from biped_adrc.control.output_npd import OutputNPDController
from biped_adrc.gait.outputs import all_coordinates
from validation.three_link import END, P2, P3, TO_Q, ZERO, EndsAtPhase, cycle, outputs, robot, step

ROBOT = robot()


def test_model_is_the_published_one() -> None:
    """D and Omega are compared with the closed form for point masses in absolute angles: K_ij cos(th_i - th_j),
    and the like with sin; arms are the factors of the links' unit vectors in the place of each mass.
    """
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
        np.testing.assert_allclose(D, K * np.cos(d), rtol=0.0, atol=1e-7)
        bias = (K * np.sin(d)) @ rate**2 - g * (masses @ arms) * np.sin(th)
        np.testing.assert_allclose(TO_Q.T @ ROBOT.bias(q, v), bias, rtol=0.0, atol=1e-7)


def test_outputs_are_the_published_ones() -> None:
    """The torso and the swing leg as the published polynomials of the angle of the stance leg."""
    rng = np.random.default_rng(6)
    for th in rng.uniform(-1.0, 1.0, (5, 3)):
        o = outputs()(0.0, TO_Q @ th + ZERO, np.zeros(3))
        x = th[0]
        expected = [
            th[2] - (0.512 + 0.073 * x + 0.035 * x**2 - 0.819 * x**3),
            th[1] + x - (-2.27 + 3.26 * x + 3.11 * x**2 + 1.89 * x**3) * (x**2 - END**2),
        ]
        np.testing.assert_allclose(o.y, expected, atol=1e-14)


def test_cycle_under_finite_time_feedback() -> None:
    """alpha and eps are those published. omega [rad/s], period [s] and slope dP/domega of the cycle; the
    digits come from a separate integration in absolute angles with LSODA."""
    controller = FiniteTimeController(outputs(), alpha=0.9, eps=0.1)
    omega, period, slope = cycle(controller, ba.Adaptive(1e-6, 1e-8))
    assert omega == pytest.approx(1.549891, rel=1e-6)
    assert period == pytest.approx(1.121633, rel=1e-6)
    assert slope == pytest.approx(0.5771, abs=2e-4)


def test_joint_form_of_the_outputs() -> None:
    """The outputs can be solved for the joints, q_b = h(Theta): along h y = y' = 0, and since y = T (q_b - h)
    with a constant matrix T, NPD with the same gains makes the same step, from 1.5 rad/s."""
    y, gains = outputs(), ba.Gains(400.0, 40.0)
    d = y.desired
    q = all_coordinates(d.curve, y.H0, d.phase, (d.theta_plus, d.theta_minus))
    joints = replace(d, curve=type(q)(q.coefficients[:-1]))
    zero = ba.ZeroDynamics.of(ROBOT, joints)
    for q, dq in zip(zero.q, zero.dq, strict=True):
        o = y(0.0, q, dq)
        np.testing.assert_allclose(np.concatenate((o.y, o.dy)), 0.0, rtol=0.0, atol=1e-13)
    found = step(ba.NPDController(joints, gains), 1.5, ba.Adaptive())
    assert found == pytest.approx(step(OutputNPDController(y, gains), 1.5, ba.Adaptive()), rel=1e-8)


def test_finite_time_feedback_comes_to_rest_in_closed_form() -> None:
    """With x2 = eps y' and phi = y + sign(x2) |x2|^(2-a) / (2-a), on phi = 0, where the walk starts, x2' =
    -|x2|^a in the time t / eps: x2 = (x2(0)^(1-a) - (1-a) t/eps)^(1/(1-a)), a = alpha. Both outputs are at rest
    before 0.36 s, which the last times show."""
    alpha, eps, th1 = 0.9, 0.05, -END
    x2_0 = eps * np.array([0.5, -0.3])
    y_0 = -np.sign(x2_0) * np.abs(x2_0) ** (2.0 - alpha) / (2.0 - alpha)
    # y = (th3 - P3(th1), th1 + th2 - P2(th1)), solved for th2 and th3
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
        np.testing.assert_allclose(o.dy, dy, rtol=0.0, atol=1e-7)
