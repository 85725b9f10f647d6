"""The largest bandwidth that a robot's encoders, clock and motors allow an observer, for each order.

An encoder of N counts per revolution leaves an error between -pi / N and pi / N, of variance (2 pi / N)^2 / 12,
independent from tick to tick while the joint moves by counts. In joint i it makes a torque of

    rms u_i = sigma_a sqrt(sum_j (kappa^-1)_ij^2)

with sigma_a from the sampled loop. The encoders' part in Theta and in the rates of the reference, which no
observer filters, is not in it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.observer_loop import observer_loop
from biped_adrc.analysis.observer_sampled import (
    SampledLoop,
    largest_delay,
    last_true,
    sampled_loop,
)
from biped_adrc.control.tracking import Gains
from biped_adrc.observers.gpi import GPIObserver

SHARE = 0.1
"""Of the torque limit that the rms torque of one count may have. The published gait takes 108 of RABBIT's 150
N m at its peak: three standard deviations of 15 N m are what is left."""
KAPPA_RATIOS = (0.8, 1.0, 1.25)
"""Of the robot's kappa to the model's, under which a recommended loop is stable: inertias known to 20 %."""
ORDERS = (0, 1, 2, 3, 5, 7)
"""m, of the observers that are compared."""
LEAST, MOST = 10.0, 2e4
"""[rad/s]: bandwidths that are looked among; below, the observer is slower than a step of the robot."""
BANDS = 120
"""How many, in geometric order, before the largest is found by bisection."""
REJECTED = 2.0 * math.pi * 5.0
"""[rad/s]: frequency at which orders are compared, that of the 5 Hz torque of the verification."""


class Hardware(NamedTuple):
    """What the loop runs on."""

    period: float
    """[s]."""
    delay: float
    """[s], from a tick to its torque."""
    known: bool
    """Whether the observer is fed with the torque that acts."""
    counts: float
    """Of the encoders per revolution."""
    torque_limit: float
    """[N m]."""
    inertia: float
    """Largest sqrt(sum_j (kappa^-1)_ij^2) over joints and the step [kg m^2]."""


class Recommended(NamedTuple):
    """The largest bandwidth of m + 2 equal poles that is allowed; nan where none is."""

    m: int
    bandwidth: float
    """[rad/s]."""
    because: str
    """What forbids a larger one: "ripple" or "stability"; "" where nothing does, or none is allowed."""
    ripple: float
    """rms [N m]."""
    delay_margin: float
    """[s], at this period, hidden or known as the hardware says."""
    rejection: float
    """|e / xi| at REJECTED [s^2]."""


def count_error(counts: float) -> float:
    """Standard deviation of the angle [rad] from an encoder of that many counts per revolution."""
    return 2.0 * math.pi / counts / math.sqrt(12.0)


def loop_on(
    hardware: Hardware, observer: GPIObserver, gains: Gains, joint: int = 0, ratio: float = 1.0
) -> SampledLoop:
    """The sampled loop at this period and delay, with kappa off by a ratio."""
    return sampled_loop(
        observer,
        hardware.period,
        gains,
        joint=joint,
        delay=hardware.delay,
        known=hardware.known,
        kappa_ratio=ratio,
    )


def ripple(hardware: Hardware, observer: GPIObserver, gains: Gains, joint: int = 0) -> float:
    """rms torque [N m] of one encoder count; infinite for an unstable loop."""
    sigma_a = loop_on(hardware, observer, gains, joint).rms(count_error(hardware.counts))
    return sigma_a * hardware.inertia


def weakest(
    hardware: Hardware, observer: GPIObserver, gains: Gains, joint: int = 0
) -> tuple[float, float]:
    """The one of KAPPA_RATIOS with the largest spectral radius, and that radius."""
    radii = {
        ratio: loop_on(hardware, observer, gains, joint, ratio).spectral_radius
        for ratio in KAPPA_RATIOS
    }
    return max(radii.items(), key=lambda found: found[1])


def obstacle(hardware: Hardware, observer: GPIObserver, gains: Gains, joint: int = 0) -> str:
    """ "ripple", "stability", or "" for an observer that is allowed."""
    if not weakest(hardware, observer, gains, joint)[1] < 1.0:
        return "stability"
    allowed = SHARE * hardware.torque_limit
    return "" if ripple(hardware, observer, gains, joint) <= allowed else "ripple"


def recommend(hardware: Hardware, gains: Gains, m: int, joint: int = 0) -> Recommended:
    """The largest bandwidth of the lowest range of bandwidths that are allowed."""

    def against(w: float) -> str:
        return obstacle(hardware, GPIObserver.from_bandwidth(w, m), gains, joint)

    low, because = math.nan, ""
    for w in np.geomspace(LEAST, MOST, BANDS):
        found = against(float(w))
        if found and math.isfinite(low):
            because = found
            low = last_true(lambda w: not against(w), low, float(w))
            break
        low = low if found else float(w)
    if not math.isfinite(low):
        return Recommended(m, math.nan, "", math.nan, math.nan, math.nan)
    observer = GPIObserver.from_bandwidth(low, m)
    margin = largest_delay(observer, hardware.period, gains, joint=joint, known=hardware.known)
    torque, error = ripple(hardware, observer, gains, joint), rejection(observer, gains, joint)
    return Recommended(m, low, because, torque, margin, error)


def rejection(observer: GPIObserver, gains: Gains, joint: int = 0) -> float:
    """|e / xi| at REJECTED [s^2]."""
    error = observer_loop(observer, gains, joint).tracking_error(np.array([REJECTED]))
    return float(np.abs(error[0]))


def without_observer(gains: Gains, joint: int = 0) -> float:
    """|e / xi| at REJECTED [s^2] of K_p and K_d alone: 1 / |s^2 + K_d s + K_p|."""
    loop = observer_loop(GPIObserver.from_bandwidth(1.0, 0), gains, joint)
    s = 1j * REJECTED
    return float(1.0 / abs(s**2 + loop.K_d * s + loop.K_p))
