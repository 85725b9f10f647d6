"""The hybrid machinery on the classic walkers of the literature: fixed points and multipliers.

The same walker, guard, impact and return map as for RABBIT; the robots are records under urdf/.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.variational import periodic_orbit
from biped_adrc.core.errors import SimulationError
from biped_adrc.hybrid.trajectory import Trajectory

METHOD = ba.Adaptive()


def walk(walker: ba.Walker, q: np.ndarray, v: np.ndarray, impacts: int) -> Trajectory:
    found = ba.simulate(
        walker,
        walker.initial_state(q, v),
        ba.Mode(),
        METHOD,
        t_end=60.0,
        stop_after=("foot_strike", impacts),
    )
    assert found.status is ba.Status.COMPLETED
    return found


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
        np.testing.assert_allclose(biped.swing_foot(new), -biped.swing_foot(q), atol=1e-12)
        np.testing.assert_allclose(biped.hip(new) - biped.swing_foot(new), biped.hip(q), atol=1e-12)


def test_relabelling_of_a_hip_that_counts_from_the_stance_leg() -> None:
    np.testing.assert_array_equal(ba.Biped.load("compass").R, [[-1.0, 0.0], [1.0, 1.0]])


def test_a_wheel_rolls_on_to_its_next_spoke() -> None:
    wheel = ba.Biped.load("rimless_wheel")
    q = np.array([3.0])
    new = wheel.relabel(q)
    np.testing.assert_allclose(new, q + math.pi / 4)
    np.testing.assert_allclose(wheel.hip(q) - wheel.swing_foot(q), wheel.hip(new), atol=1e-12)


# -- published and closed-form results --------------------------------------------------------------
@pytest.mark.parametrize("slope", [0.08, 0.12, 0.2])
def test_rimless_wheel(slope: float) -> None:
    """McGeer 1990, all mass at the hub: the fixed point and the multiplier cos^2 2 alpha in closed form."""
    wheel, alpha = ba.Biped.load("rimless_wheel"), math.pi / 8
    walker = ba.Walker(wheel, ba.Passive(), slope=slope, max_step_time=10.0)
    rate = math.sqrt(4.0 * 9.81 * math.sin(alpha) * math.sin(slope)) / math.tan(2.0 * alpha)
    before = np.array([math.pi - slope - alpha, -rate / math.cos(2.0 * alpha)])
    found = orbit(walker, before * [1.0, 1.05])
    after = wheel.impact(found.x_minus[:1], found.x_minus[1:])
    assert after.v[0] == pytest.approx(-rate, rel=1e-9)
    assert found.multipliers[0].real == pytest.approx(math.cos(2.0 * alpha) ** 2, rel=1e-6)
    assert found.stable


def test_a_wheel_on_too_gentle_a_slope_does_not_come_round() -> None:
    """Below the slope where a step's energy lifts the hub over the spoke there is no rolling cycle."""
    alpha, slope = math.pi / 8, 0.05
    square = 4.0 * math.sin(alpha) * math.sin(slope) / math.tan(2.0 * alpha) ** 2  # (l / g) rate^2
    assert square < 2.0 * (1.0 - math.cos(alpha - slope))
    wheel = ba.Biped.load("rimless_wheel")
    walker = ba.Walker(wheel, ba.Passive(), slope=slope, max_step_time=10.0)
    before = np.array([math.pi - slope - alpha, -math.sqrt(9.81 * square) / math.cos(2 * alpha)])
    with pytest.raises(SimulationError, match="no return to the section: FELL"):
        orbit(walker, before)


def test_compass_gait() -> None:
    """Goswami et al. 1998, 3 degrees: the state after impact and all three multipliers."""
    biped, slope = ba.Biped.load("compass"), math.radians(3.0)
    walker = ba.Walker(biped, ba.Passive(), slope=slope)
    stance, rate, swing_rate = -0.2186688, 1.0923836, 0.3773740  # clockwise, as published
    q = np.array([-2.0 * slope + 2.0 * stance, math.pi - stance])
    v = np.array([-swing_rate + rate, -rate])
    run = walk(walker, q, v, 3)
    found = orbit(walker, run.events("foot_strike")[-1].x_minus)
    after = biped.impact(found.x_minus[:2], found.x_minus[2:])
    assert math.pi - after.q[1] == pytest.approx(stance, abs=1e-7)
    assert -after.v[1] == pytest.approx(rate, abs=1e-7)
    assert -(after.v[0] + after.v[1]) == pytest.approx(swing_rate, abs=1e-7)
    pair = found.multipliers[:2]
    np.testing.assert_allclose(pair.real, -0.1997261, atol=1e-6)
    np.testing.assert_allclose(np.abs(pair.imag), 0.5444761, atol=1e-6)
    assert found.multipliers[2] == pytest.approx(0.1315726, abs=1e-6)


def test_compass_gait_on_its_slope_balances_its_energy() -> None:
    """On a periodic passive walk gravity gives in a step what the impact takes: m g (fall of a step)."""
    biped, slope = ba.Biped.load("compass"), math.radians(3.0)
    walker = ba.Walker(biped, ba.Passive(), slope=slope)
    q = np.array([-2.0 * slope - 2.0 * 0.2186688, math.pi + 0.2186688])
    run = walk(walker, q, np.array([1.0923836 - 0.3773740, -1.0923836]), 3)
    x = orbit(walker, run.events("foot_strike")[-1].x_minus).x_minus
    after = biped.impact(x[:2], x[2:])
    lost = biped.kinetic_energy(x[:2], x[2:]) - biped.kinetic_energy(after.q, after.v)
    fall = -float(biped.swing_foot(x[:2])[1])
    assert biped.mass * 9.81 * fall == pytest.approx(lost, rel=1e-8)


def test_simplest_walking_model() -> None:
    """Garcia et al. 1998, slope 0.009, in the limit of vanishing feet (here 1e-7 of the hip's mass)."""
    biped, slope, unit = ba.Biped.load("simplest"), 0.009, math.sqrt(9.81)
    walker = ba.Walker(biped, ba.Passive(), slope=slope, max_step_time=4.0)
    theta, rate = 0.200310901, -0.199832473
    q = np.array([-2.0 * theta, math.pi - slope + theta])
    v = np.array([-(1.0 - math.cos(2.0 * theta)) * rate, rate]) * unit
    run = walk(walker, q, v, 2)
    found = orbit(walker, run.events("foot_strike")[-1].x_minus)
    after = biped.impact(found.x_minus[:2], found.x_minus[2:])
    assert after.q[1] - math.pi + slope == pytest.approx(theta, rel=1e-6)
    assert after.v[1] / unit == pytest.approx(rate, rel=1e-6)
    period = walk(walker, after.q, after.v, 1).t_end
    assert period * unit == pytest.approx(3.882464, rel=1e-6)
    # central differences through a mass ratio of 1e-7 end at 1e-5; the feet themselves change 1e-6
    P = ba.ReturnMap(walker, METHOD, pitch=math.pi)
    multipliers = periodic_orbit(P, found.x_minus, 1e-8)[0].multipliers
    assert abs(multipliers[0]) == pytest.approx(0.589113, rel=2e-6)
