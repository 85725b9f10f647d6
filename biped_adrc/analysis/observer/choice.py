"""The largest bandwidth that a robot's encoders, sampling and motors allow an observer, for each order m.

The observer estimates angle, velocity and total disturbance xi of a joint; m is the number of its states for xi
and derivatives of xi, so it has m + 2 poles. kappa is the input gain of the torques u, q_b'' = kappa u + xi,
with q_b the angles of the joints with motors; e is the tracking error, K_p and K_d the feedback's gains.

An encoder of N counts per revolution leaves an error between -pi / N and pi / N, of variance (2 pi / N)^2 / 12,
independent from one sample instant to the next while the joint moves by counts. Through observer and gains it
makes a commanded acceleration with the standard deviation sigma_a [rad/s^2] in each joint, and in joint i a
torque of

    rms u_i = sigma_a sqrt(sum_j (kappa^-1)_ij^2)

with sigma_a from the sampled loop. The part of the encoders' error that enters through the phase Theta and the
rates of the reference, which no observer filters, is not included; `analysis.loops` has it.

An observer is allowed on the `Hardware` if its sampled loop is stable for kappa 20 % off, and if the
torque noise ("ripple") of one count stays below a share of the torque limit. `OnHardware.recommended` has the
largest bandwidth for each m; `observer_report` shows it in its last table.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import dropwhile
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.observer.loop import ObserverLoop, SampledLoop, largest_delay, last_true
from biped_adrc.control.tracking import Gains
from biped_adrc.observers.gpi import GPIObserver

SHARE = 0.1
"""Share of the torque limit for the rms torque of one count: 108 of 150 N m leave three deviations."""
KAPPA_RATIOS = (0.8, 1.0, 1.25)
"""Ratios of the robot's kappa to the model's for which a recommended loop is stable: inertias known to 20 %."""
ORDERS = (0, 1, 2, 3, 5, 7)
"""Orders m of the disturbance model that are compared; an observer has m + 2 poles."""
LEAST, MOST = 10.0, 2e4
"""Range of the bandwidths that are tried [rad/s]; below it, the observer is slower than a step of the robot."""
BANDS = 120
"""Number of bandwidths, in geometric order, before the largest one is refined by bisection."""
REJECTED = 2.0 * math.pi * 5.0
"""Frequency [rad/s] at which orders are compared: the 5 Hz disturbance torque of the verification."""


class Hardware(NamedTuple):
    """Sampling, encoders and motors on which the loop runs."""

    period: float
    """Sampling period [s]."""
    delay: float
    """From a sample instant to the torque computed from it [s]."""
    known: bool
    """Whether the delay is known: the observer is then fed with the torque that acts, else with the command."""
    counts: float
    """Counts of the encoders per revolution."""
    torque_limit: float
    """Torque limit of every motor [N m]."""
    inertia: float
    """Largest sqrt(sum_j (kappa^-1)_ij^2) over joints i and the step [kg m^2]: torque per acceleration."""


class Recommended(NamedTuple):
    """The largest allowed bandwidth of an observer with m + 2 equal poles; NaN where none is allowed."""

    m: int
    """Order of the disturbance model."""
    bandwidth: float
    """Magnitude of the poles [rad/s]."""
    because: str
    """Obstacle to a larger bandwidth: "ripple" or "stability"; "" for none, or with no bandwidth allowed."""
    ripple: float
    """rms torque of one encoder count [N m]."""
    delay_margin: float
    """Largest stable delay [s] at this period, unknown or known to the observer as the hardware says."""
    rejection: float
    """|e / xi| at REJECTED [s^2]: tracking error per disturbance."""


def count_error(counts: float) -> float:
    """Standard deviation of the angle [rad] from an encoder with `counts` per revolution: uniform error."""
    return 2.0 * math.pi / counts / math.sqrt(12.0)


@dataclass(frozen=True)
class OnHardware:
    """An observer and the gains of the first joint, evaluated at the period and delay of the hardware."""

    hardware: Hardware
    observer: GPIObserver
    gains: Gains
    """K_p and K_d of (20) of the paper."""

    def sampled(self, ratio: float = 1.0) -> SampledLoop:
        """The sampled loop with `ratio` times the model's kappa, dimensionless."""
        k = self.hardware
        # known: whether the observer is fed with the torque that acts, else with the command
        return SampledLoop(self.observer, k.period, self.gains, k.delay, k.known, ratio)

    @cached_property
    def loop(self) -> ObserverLoop:
        """The loop of the joint in continuous time."""
        return ObserverLoop(self.observer, self.gains)

    @cached_property
    def ripple(self) -> float:
        """rms torque [N m] that the error of one encoder count makes; NaN for an unstable loop."""
        return self.sampled().rms(count_error(self.hardware.counts)) * self.hardware.inertia

    @cached_property
    def weakest(self) -> tuple[float, float]:
        """The ratio of the robot's kappa to the model's, of KAPPA_RATIOS (0.8, 1, 1.25), with the largest
        spectral radius of the sampled loop; that radius.
        """
        radii = {ratio: self.sampled(ratio).spectral_radius for ratio in KAPPA_RATIOS}
        return max(radii.items(), key=lambda found: found[1])

    @cached_property
    def obstacle(self) -> str:
        """The criterion that excludes this observer: "stability" (of the loop with the weakest kappa), "ripple"
        (rms torque of one count above the share SHARE = 0.1 of the torque limit, or NaN), or "" for none.
        """
        if not self.weakest[1] < 1.0:
            return "stability"
        return "" if self.ripple <= SHARE * self.hardware.torque_limit else "ripple"

    @cached_property
    def rejection(self) -> float:
        """|e / xi| at the frequency REJECTED [s^2], in continuous time: tracking error per disturbance."""
        return float(np.abs(self.loop.tracking_error(np.array([REJECTED])))[0])

    @property
    def without_observer(self) -> float:
        """|e / xi| at REJECTED [s^2] with K_p and K_d alone, 1 / |s^2 + K_d s + K_p|, for comparison."""
        (K_p, K_d), s = self.gains.first, 1j * REJECTED  # s = i w
        return float(1.0 / abs(s**2 + K_d * s + K_p))

    @cached_property
    def recommended(self) -> tuple[Recommended, ...]:
        """For each m of ORDERS the largest bandwidth that encoders, period and delay allow."""
        return tuple(recommend(self.hardware, self.gains, m) for m in ORDERS)


def recommend(hardware: Hardware, gains: Gains, m: int) -> Recommended:
    """Find the largest bandwidth of m + 2 equal poles within the lowest range of bandwidths that are allowed.

    gains: K_p and K_d, of which those of the first joint count. m: order of the disturbance model. Only the
    lowest range counts: a loop that is unstable at some bandwidth and stable again above it would be a bad
    recommendation. The bandwidth is NaN where none is allowed.
    """

    def candidate(w: float) -> OnHardware:
        return OnHardware(hardware, GPIObserver.from_bandwidth(float(w), m), gains)

    # BANDS bandwidths from LEAST to MOST
    bands = np.geomspace(LEAST, MOST, BANDS)
    # last_true finds by bisection the number up to which a condition holds. It gets the bandwidths from the
    # first allowed one on, so that the condition holds at the first
    allowed = dropwhile(lambda w: candidate(w).obstacle, bands)
    w = last_true(lambda w: not candidate(w).obstacle, allowed)
    # last_true returns infinity where it finds no bandwidth that is not allowed
    if math.isinf(w):  # none of the bands is allowed, or all above the first
        w = math.nan if candidate(MOST).obstacle else MOST
    if math.isnan(w):
        return Recommended(m, math.nan, "", math.nan, math.nan, math.nan)
    # w is known to 1e-6 of it, so at 2e-6 above it the criterion that excludes larger ones holds for certain
    best, because = candidate(w), candidate(w * (1.0 + 2e-6)).obstacle
    return Recommended(m, w, because, best.ripple, largest_delay(best.sampled()), best.rejection)
