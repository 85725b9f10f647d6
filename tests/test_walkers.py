"""The hybrid machinery on the classic walkers of the literature: legs, wheel and the simplest walker.

The same walker, guard, impact and return map as for RABBIT; the robots are records under urdf/. At an impact
relabelling gives the coordinates in which the other leg is the stance leg.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import biped_adrc as ba
from biped_adrc.core.errors import InputError, SimulationError
from validation.passive import simplest, solved

METHOD = ba.Adaptive()


def orbit(walker: ba.Walker, guess: np.ndarray):
    return ba.ReturnMap(walker, METHOD, pitch=math.pi).fixed_point(guess)


# -- relabelling -----------------------------------------------------------------------------------
@pytest.mark.parametrize("name", ["rabbit", "three_link", "compass", "simplest"])
def test_relabelling_turns_one_leg_into_the_other(name: str) -> None:
    """The robot in new coordinates stands where it stood: feet exchanged, by forward kinematics."""
    biped = ba.Biped.load(name)
    rng = np.random.default_rng(2)
    for _ in range(10):
        q = rng.uniform(-3.0, 3.0, biped.n)
        new = biped.relabel(q)
        np.testing.assert_allclose(biped.relabel(new), q, atol=1e-14)
        np.testing.assert_allclose(
            biped.swing_foot(new), -biped.swing_foot(q), rtol=0.0, atol=1e-12
        )
        np.testing.assert_allclose(
            biped.hip(new) - biped.swing_foot(new), biped.hip(q), rtol=0.0, atol=1e-12
        )


def test_a_wheel_rolls_on_to_its_next_spoke() -> None:
    """The spokes of the rimless wheel are pi / 4 apart: in the new coordinate the hub is where it was, above
    the new foot."""
    wheel = ba.Biped.load("rimless_wheel")
    q = np.array([3.0])
    new = wheel.relabel(q)
    np.testing.assert_allclose(new, q + math.pi / 4)
    np.testing.assert_allclose(
        wheel.hip(q) - wheel.swing_foot(q), wheel.hip(new), rtol=0.0, atol=1e-12
    )


# -- published and closed-form results --------------------------------------------------------------


def test_a_wheel_on_too_gentle_a_slope_does_not_come_round() -> None:
    """Below the slope where a step's energy lifts the hub over the spoke there is no rolling cycle: the rate
    after impact of McGeer's closed form, in `square`, is too small, and the search for a cycle ends in a
    fall."""
    alpha, slope = math.pi / 8, 0.05
    square = 4.0 * math.sin(alpha) * math.sin(slope) / math.tan(2.0 * alpha) ** 2  # (l / g) rate^2
    assert square < 2.0 * (1.0 - math.cos(alpha - slope))
    wheel = ba.Biped.load("rimless_wheel")
    # 10 s: a step that is only slow is not stopped
    walker = ba.Walker(wheel, ba.Passive(), slope=slope, max_step_time=10.0)
    before = np.array([math.pi - slope - alpha, -math.sqrt(9.81 * square) / math.cos(2 * alpha)])
    with pytest.raises(SimulationError, match="no return to the section: FELL"):
        orbit(walker, before)


# -- the multiplier of the simplest walker ----------------------------------------------------------
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
    """`limit` comes from equations of its own for massless feet (0.589113 as published). |lambda| falls by
    9.9 times the feet's mass ratio, so the robot with 1e-7 is 1e-6 off, and 1e-6 and 1e-5 extrapolated to
    none give nine digits."""
    limit = limit_multiplier()
    assert limit == pytest.approx(0.589113, abs=5e-7)
    light, heavy, heavier = (abs(solved(simplest(m))[0].multipliers[0]) for m in (1e-7, 1e-6, 1e-5))
    assert heavy + (heavy - heavier) / 9.0 == pytest.approx(limit, abs=2e-9)
    slope = (limit - heavy) / 1e-6
    assert slope == pytest.approx(9.9, rel=1e-3)
    assert limit - light == pytest.approx(1e-7 * slope, abs=5e-9)


def test_a_walk_from_a_state_needs_no_gait(biped, gait):
    """A start in place of a gait: the controller's curve gives the reference, and the walk is bit by bit that
    with the gait. Without a start, or without a curve to track, a gait is missing."""
    walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    alone = ba.walk(walker, start=gait.start(biped), impacts=1)
    beside = ba.walk(walker, gait, impacts=1)
    assert np.array_equal(alone.trajectory.final_state, beside.trajectory.final_state)
    assert np.array_equal(alone.signals.error, beside.signals.error)
    assert alone.note == "NPD from a state, rabbit identified"
    for start, controller in ((None, walker.controller), (gait.start(biped), ba.Passive())):
        with pytest.raises(InputError, match="the gait of the walk is None, expected a Gait"):
            ba.walk(ba.Walker(biped, controller), start=start)
