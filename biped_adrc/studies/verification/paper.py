"""What the paper prints: its fixed point x*, and the poles of its Table I.

x* is met by construction, as the published gait is designed through it; that the walk comes back to it, and
with which multiplier, is not. The angular momentum about the stance foot gives that from the printed digits,

    delta^2 = (sigma+ / sigma-)^2,   sigma+ after the impact of x*, about the new foot
"""

from __future__ import annotations

import numpy as np

from biped_adrc.analysis.variational import periodic_orbit
from biped_adrc.gait.published import X_STAR
from biped_adrc.model.biped import Biped
from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.studies.cycle_stability import gait_cycle
from biped_adrc.studies.tables import PRINTED_TABLE_I
from biped_adrc.studies.verification.row import Measure, Row

SOURCE = "the paper, section VI"


def poles_row() -> tuple[Row, ...]:
    """Table I is printed in whole rad/s."""
    gap = np.abs(np.array(PRINTED_TABLE_I, dtype=float) - np.array(TABLE_I))
    quantity = "180 x 1.8^k, k = 0..8: largest gap to Table I [rad/s]"
    worst = float(np.max(gap))
    return (Row("observer", quantity, 0.0, worst, 0.5, "the paper, Table I", Measure.ABSOLUTE),)


def fixed_point_rows(preset: str) -> tuple[Row, ...]:
    """The published gait under NPD: x* within half a unit of its last printed digits, and its multiplier."""
    biped, (q, v) = Biped.load("rabbit", preset), np.split(X_STAR, 2)
    cycle = gait_cycle(Scenario("NPD", preset=preset))
    _, step = periodic_orbit(cycle.P, cycle.guess, 1e-8)
    gap = np.abs(cycle.P.lift(step.image) - X_STAR)
    name = f"RABBIT {preset}, published gait"
    built = "the gait is designed through x*; half a unit of the last printed digit"
    height = abs(float(biped.swing_foot(q)[1]))
    gaps = (
        ("q1..q4 after a simulated step: largest gap to x* [rad]", float(np.max(gap[:4])), 5e-4),
        ("q5: gap to x* [rad]", float(gap[4]), 5e-5),
        ("rates: largest gap to x* [rad/s]", float(np.max(gap[5:])), 5e-4),
    )
    after = biped.impact(q, v)
    delta = biped.angular_momentum(after.q, after.v) / biped.angular_momentum(q, v)
    multiplier = float(step.multipliers[0].real)
    momenta = "(sigma+ / sigma-)^2 at the printed x*"
    foot, digits = "height of the swing foot at x* as printed [m]", "the angles have three decimals"
    return (
        Row(name, foot, 0.0, height, 5e-4, SOURCE, Measure.ABSOLUTE, digits),
        *(
            Row(name, quantity, 0.0, found, limit, SOURCE, Measure.ABSOLUTE, built)
            for quantity, found, limit in gaps
        ),
        Row(name, "largest multiplier of the walk", delta**2, multiplier, 1e-3, momenta),
    )
