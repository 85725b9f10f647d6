"""The multiplier of the simplest walker with massless feet, by the equations of its authors."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from validation.passive import simplest, solved

SLOPE = 0.009


def limit_flow(t: float, y: np.ndarray) -> np.ndarray:
    """The simplest walker with massless feet in its own angles (theta, theta', phi, phi'), and what a change of
    the start (theta, theta') makes of them, (4, 2)."""
    th, dth, ph, _ = y[:4]
    s, c = math.sin, math.cos
    f = [y[1], s(th - SLOPE), y[3], s(th - SLOPE) + (dth**2 - c(th - SLOPE)) * s(ph)]
    A = np.zeros((4, 4))
    A[0, 1] = A[2, 3] = 1.0
    A[1, 0] = c(th - SLOPE)
    A[3, :3] = c(th - SLOPE) + s(th - SLOPE) * s(ph), 2 * dth * s(ph), f[3] - s(th - SLOPE)
    A[3, 2] = (dth**2 - c(th - SLOPE)) * c(ph)
    return np.concatenate((f, (A @ y[4:].reshape(4, 2)).ravel()))


def limit_multiplier() -> float:
    """|lambda| of the limit by the step map of Garcia et al. 1998, (theta, theta') from after one heel
    strike to after the next:

    theta+ = -theta, theta'+ = cos(2 theta) theta', phi+ = 2 theta+, phi'+ = (1 - cos(2 theta+)) theta'+.
    """
    s = np.array([0.200310901, -0.199832473])
    for _ in range(4):
        th, dth = s
        start = [th, dth, 2 * th, (1 - math.cos(2 * th)) * dth]
        tangent = [[1, 0], [0, 1], [2, 0], [2 * math.sin(2 * th) * dth, 1 - math.cos(2 * th)]]
        y0 = np.concatenate((start, np.ravel(tangent)))
        exact = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-14}
        swung = solve_ivp(limit_flow, (0.0, 3.0), y0, **exact).y[:, -1]  # past mid-stance

        def strike(t: float, y: np.ndarray) -> float:
            return float(y[2] - 2 * y[0])

        strike.terminal = True
        y = solve_ivp(limit_flow, (3.0, 5.0), swung, events=strike, **exact).y_events[0][0]
        f, M, dh = limit_flow(0.0, y)[:4], y[4:].reshape(4, 2), np.array([-2.0, 0.0, 1.0, 0.0])
        M = M - np.outer(f, dh @ M) / (dh @ f)
        th, dth = y[:2]
        c, d = math.cos(2 * th), -2 * math.sin(2 * th) * dth
        J = np.array([[-1.0, 0.0, 0.0, 0.0], [d, c, 0.0, 0.0]]) @ M
        s = s + np.linalg.solve(np.eye(2) - J, np.array([-th, c * dth]) - s)
    return float(np.max(np.abs(np.linalg.eigvals(J))))


def test_simplest_walker_against_its_own_equations() -> None:
    """0.589113 belongs to massless feet. |lambda| falls by 9.9 times their mass ratio, so 1e-7 alone is 1e-6
    off, and two mass ratios extrapolated to none give nine digits."""
    limit = limit_multiplier()
    assert limit == pytest.approx(0.589113, abs=5e-7)
    light, heavy, heavier = (abs(solved(simplest(m))[0].multipliers[0]) for m in (1e-7, 1e-6, 1e-5))
    assert heavy + (heavy - heavier) / 9.0 == pytest.approx(limit, abs=2e-9)
    slope = (limit - heavy) / 1e-6
    assert slope == pytest.approx(9.9, rel=1e-3)
    assert limit - light == pytest.approx(1e-7 * slope, abs=5e-9)
