"""Gait design from a cold start: the speed asked for is reached, the step certified, within seconds.

Every gait is walked two steps under NPD, and its certificate is taken from that walk.
"""

from __future__ import annotations

from time import process_time

import numpy as np

from biped_adrc.gait.design.request import StepLimits
from biped_adrc.gait.gait import Gait, load_gait
from biped_adrc.gait.published import X_STAR
from biped_adrc.gait.through_state import onto_section
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.studies.gait_design import DesignedGait, design_gait
from biped_adrc.studies.verification.row import Measure, Row, at_most

SPEEDS = tuple(round(0.4 + 0.1 * k, 1) for k in range(8))
"""[m/s]."""
SECONDS = 10.0
ASKED, CERTIFICATE = "as asked", "certificate of the walk"
OWN = "this package's own limit"


def design_rows(preset: str, speed: float) -> tuple[Row, ...]:
    """The gait of least torque at this speed [m/s]."""
    begin = process_time()
    found = design_gait("rabbit", speed, preset=preset)
    spent, name = process_time() - begin, f"RABBIT {preset}, {speed:g} m/s"
    reached = Row(name, "speed [m/s]", speed, found.speed, 1e-6, ASKED)
    return (reached, *_common(name, found, spent))


def through_rows(preset: str) -> tuple[Row, ...]:
    """The gait through x* of the paper, beside the stored one, which another optimiser found.

    Its impulse is what x* makes it, so that it has no limit.
    """
    biped = Biped.load("rabbit", preset)
    q, v = onto_section(biped, X_STAR[: biped.n]), np.array(X_STAR[biped.n :])
    begin, limits = process_time(), StepLimits(impulse_friction=float("inf"))
    found = design_gait(biped, through=(q, v), limits=limits)
    spent, name = process_time() - begin, f"RABBIT {preset}, through x*"
    gap = float(np.max(np.abs(found.gait.v_minus - v)))
    rates = "rates of the orbit: gap to x* [rad/s]"
    least = torque_squared(biped, load_gait("published", biped))
    flat = "the minimum is flat"
    other = "stored gait, found by another optimiser"
    return (
        Row(name, rates, 0.0, gap, 1e-6, ASKED, Measure.ABSOLUTE),
        Row(name, "int u'u dt / step [N^2 m s]", least, found.objective, 1e-3, other, note=flat),
        *_common(name, found, spent),
    )


def torque_squared(biped: Biped, gait: Gait) -> float:
    """int u'u dt / step [N^2 m s] on the zero dynamics."""
    zero = ZeroDynamics.of(biped, gait.constraint)
    orbit = zero.orbit(zero.sigma_minus * zero.delta)
    length = float(np.hypot(*biped.swing_foot(gait.q_minus)))
    return float(orbit.time_weights @ np.sum(orbit.u**2, axis=1)) / length


def _common(name: str, found: DesignedGait, spent: float) -> tuple[Row, ...]:
    broken = float(len(found.certificate.violations()))
    return (
        at_most(name, "broken limits of its certificate", 0.0, broken, CERTIFICATE),
        at_most(name, "left after two steps [rad, rad/s]", 1e-6, found.gap, "periodicity"),
        at_most(name, "processor time from a cold start [s]", SECONDS, spent, OWN),
    )
