"""The hybrid machinery on the classic walkers of the literature: fixed points and multipliers.

The same walker, guard, impact and return map as for RABBIT; the robots are records under urdf/.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import SimulationError

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
        np.testing.assert_allclose(biped.swing_foot(new), -biped.swing_foot(q), atol=1e-12)
        np.testing.assert_allclose(biped.hip(new) - biped.swing_foot(new), biped.hip(q), atol=1e-12)


def test_a_wheel_rolls_on_to_its_next_spoke() -> None:
    wheel = ba.Biped.load("rimless_wheel")
    q = np.array([3.0])
    new = wheel.relabel(q)
    np.testing.assert_allclose(new, q + math.pi / 4)
    np.testing.assert_allclose(wheel.hip(q) - wheel.swing_foot(q), wheel.hip(new), atol=1e-12)


# -- published and closed-form results --------------------------------------------------------------


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
