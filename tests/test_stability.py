"""Every robot's cycle: multipliers by the variational equation, by differences, in closed form, and by the
equations of the literature."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.integrate import solve_ivp

import biped_adrc as ba
from biped_adrc.analysis.return_map import ReturnMap, sorted_eigenvalues
from biped_adrc.analysis.stability import Cycle, StabilityMethod, cycle_stability
from biped_adrc.analysis.variational import (
    StepDerivative,
    periodic_orbit,
    torque_derivative,
)
from biped_adrc.gait.curves import Polynomial as PolynomialCurve
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.gait.zero_orbits import ZeroOrbits
from biped_adrc.paper.poincare import return_map_samples
from biped_adrc.scenario.cycle import find_cycle, gait_cycle, known_cycle
from biped_adrc.scenario.scenario import Scenario

LARGEST = 1e-6  # relative
OTHERS = 1e-7  # absolute
TIGHT = ba.Adaptive(1e-11, 1e-11)


def check(one: np.ndarray, other: np.ndarray) -> None:
    """The largest multiplier to 1e-6 of itself, the others to 1e-7, each with its own partner."""
    assert len(one) == len(other)
    left = list(other)
    for k, value in enumerate(one):
        near = min(left, key=lambda z: abs(z - value))
        left.remove(near)
        allowed = LARGEST * abs(value) if k == 0 else OTHERS
        assert abs(near - value) <= allowed, (k, value, near)


def solved(cycle: Cycle, tolerance: float = 1e-10) -> StepDerivative:
    return periodic_orbit(cycle.P, cycle.guess, tolerance)[1]


# -- robots without motors ---------------------------------------------------------------------------
def test_multipliers_of_the_literature() -> None:
    """McGeer 1990 in closed form; Goswami et al. 1998, recomputed from their model."""
    wheel = solved(find_cycle("rimless_wheel", slope=0.2))
    assert wheel.multipliers[0].real == pytest.approx(math.cos(math.pi / 4) ** 2, rel=1e-10)
    compass = solved(find_cycle("compass"))
    expected = np.array([-0.1997261 + 0.5444761j, -0.1997261 - 0.5444761j, 0.1315726])
    found = compass.multipliers[np.argsort(-compass.multipliers.imag)][[0, 2, 1]]
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-7)


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


def simplest(ratio: float) -> Cycle:
    """The simplest walker with feet of `ratio` of the hip's mass."""
    return known_cycle(ba.Biped.load("simplest").with_errors(mass={"leg": ratio / 1e-7}))


def test_simplest_walker_against_its_own_equations() -> None:
    """0.589113 belongs to massless feet. |lambda| falls by 9.9 times their mass ratio, so 1e-7 alone is 1e-6
    off, and two mass ratios extrapolated to none give nine digits."""
    limit = limit_multiplier()
    assert limit == pytest.approx(0.589113, abs=5e-7)
    light, heavy, heavier = (abs(solved(simplest(m)).multipliers[0]) for m in (1e-7, 1e-6, 1e-5))
    assert heavy + (heavy - heavier) / 9.0 == pytest.approx(limit, abs=2e-9)
    slope = (limit - heavy) / 1e-6
    assert slope == pytest.approx(9.9, rel=1e-3)
    assert limit - light == pytest.approx(1e-7 * slope, abs=5e-9)


# -- RABBIT ------------------------------------------------------------------------------------------
@pytest.mark.parametrize("name", ["published", "recipe"])
def test_multipliers_of_rabbit(biped: ba.Biped, name: str) -> None:
    """The stored gaits of all presets, and delta^2 where the impact keeps to the constraint."""
    cycle = gait_cycle(Scenario("NPD", robot={"preset": biped.preset}, gait=name))
    P = replace(cycle.P, method=ba.RK4(7e-4), difference=2e-5)
    step = solved(replace(cycle, P=P), 1e-7)
    check(step.multipliers, sorted_eigenvalues(P.jacobian(step.s)))
    delta2 = ZeroDynamics.of(biped, P.walker.controller.reference).delta ** 2
    gap = abs(step.multipliers[0].real / delta2 - 1.0)
    assert gap < 1e-6 if name == "published" else gap > 1e-4


# -- the three-link walker ---------------------------------------------------------------------------
def three_link() -> Cycle:
    """A torso that leans by 0.5 rad and legs that open alike under NPD, of the stance leg's angle theta1:

        theta3 = 0.5 rad,   theta2 = -theta1 + theta1^2 - theta1d^2,   theta1d = pi / 8

    These angles turn the other way than ours: a = pi - theta for the legs and -theta3 for the torso.
    """
    biped, end = ba.Biped.load("three_link"), math.pi / 8
    theta1 = Polynomial([-end, 2 * end])  # of the phase s in [0, 1]
    legs = math.pi - theta1 + 0.5, math.pi + theta1 - (theta1**2 - end**2) + 0.5
    rows = np.array([np.pad(c.coef, (0, 3 - len(c.coef))) for c in legs])
    h = ba.VirtualConstraint(PolynomialCurve(rows), biped.phase, math.pi + end, math.pi - end)
    q, v = ZeroDynamics.of(biped, h).end_state(1.0)
    v *= -1.59 / float(h.phase @ v)
    walker = ba.Walker(biped, ba.NPDController(h, ba.Gains(400.0, 40.0)))
    P = ReturnMap(walker, TIGHT, difference=1e-4, pitch=float(q[2]))
    return Cycle(P, np.concatenate((q, v)))


def test_samples_of_the_return_map_are_those_of_the_zero_dynamics(
    biped: ba.Biped, gait: ba.Gait
) -> None:
    """With its rates f times those of the gait a walker has f^2 zeta*, and rates go with sqrt(zeta)."""
    orbits = ZeroOrbits.of(ZeroDynamics.of(biped, gait.constraint))
    f = np.array([0.95, 1.05])
    rate = biped.phase @ gait.v_minus
    zeta = np.array([orbits.rho(k**2 * orbits.zeta_star) for k in f])
    before, after = return_map_samples(Scenario("NPD"), size=0.05, count=2)
    np.testing.assert_allclose(before, f * rate)
    np.testing.assert_allclose(after, rate * np.sqrt(zeta / orbits.zeta_star), rtol=1e-7)


@pytest.mark.parametrize("robot", ["rimless_wheel", "compass", "three_link"])
def test_table_of_a_robot(robot: str) -> None:
    """The impact of the three-link walker leaves its constraint, so that there is no delta^2."""
    table = cycle_stability(three_link() if robot == "three_link" else find_cycle(robot)).table
    assert [row.method for row in table.rows] == list(StabilityMethod)
    check(*(row.multipliers for row in table.rows))
    assert table.agree
    assert table.stable


# -- what is refused ---------------------------------------------------------------------------------
def test_a_law_of_ones_own_is_not_taken_for_npd(biped: ba.Biped, gait: ba.Gait) -> None:
    """A subclass may say anything: its torque is differenced."""

    class Halved(ba.NPDController):
        def output(self, s: np.ndarray, m: ba.Measurement) -> np.ndarray:
            return 0.5 * super().output(s, m)

    walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    halved = replace(walker, controller=Halved(gait.constraint))
    x = np.concatenate((gait.q_minus, 1.1 * gait.v_minus))
    one, other = (torque_derivative(w)(w.instant(0.0, x, ba.Mode())) for w in (walker, halved))
    np.testing.assert_allclose(other, 0.5 * one, rtol=0.0, atol=1e-9 * np.max(np.abs(one)))
