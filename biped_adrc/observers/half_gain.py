"""The GPI observer with half of the gains that place all poles at -omega: less noise in the estimates.

    x1^' = x2^             + l_1 / 2 (y - x1^)
    x2^' = x3^ + kappa u   + l_2 / 2 (y - x1^)
     ...
    x_k^' =                  l_k / 2 (y - x1^),      s^k + l_1 s^(k-1) + ... + l_k = (s + omega)^k,   k = m + 2

x1^, x2^, x3^ estimate a joint's angle, velocity and disturbance, y [rad] is the measured angle, and kappa u
[rad/s^2] the acceleration that the torques give by the nominal model. omega [rad/s] is the bandwidth. The poles
solve (s + omega)^k = -s^k, so each has the real part -omega / 2, for every k:

    s = -omega / 2 (1 + i cot(phi / 2)),    phi = pi (2 j + 1) / k,   j = 0..k-1

In sampled time L / 2 takes the place of L, which puts all poles at beta = exp(-omega T). It is not the exact
discrete form of the poles s. Its poles solve (z - beta)^k = -(z - 1)^k, and lie on the line between beta and 1:

    z = (1 + beta) / 2 + i (1 - beta) / 2 cot(phi / 2),       stable for beta > 2 cos(pi / k) - 1

For k <= 3 this holds at every bandwidth, for k > 3 at low ones. Herbst, Hempel, Goehrt, Streif,
IFAC-PapersOnLine 53(2), 2020, arXiv 2003.03986; in sampled time Herbst, Hempel, Control Engineering Practice
164, 2025, 106501.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.observers.gpi import GPIObserver, InjectedChain, SampledChain


@dataclass(frozen=True)
class HalfGainObserver(InjectedChain):
    """The observer with half gains, the same for every joint; `scale` is omega [rad/s]. Make it with
    `from_bandwidth`.
    """

    MAKERS = ("from_bandwidth",)

    @classmethod
    def from_bandwidth(cls, bandwidth: float, m: int = 1) -> HalfGainObserver:
        """The observer with half of the gains for m + 2 poles at -bandwidth [rad/s].

        Raises InputError for a bandwidth or an order out of range.
        """
        return cls(GPIObserver.from_bandwidth(bandwidth, m).m, float(bandwidth))

    @cached_property
    def poles(self) -> tuple[complex, ...]:
        """Poles of the error dynamics (m + 2,) [rad/s]: omega / (exp(i phi) - 1)."""
        phi = np.pi * (2 * np.arange(self.order) + 1) / self.order
        return tuple(complex(s) for s in self.scale / np.expm1(1j * phi))

    def sampled(self, period: float) -> SampledChain:
        """The current discrete observer for ticks every `period` [s]. Raises InputError if it is unstable."""
        beta_min = 2.0 * np.cos(np.pi / self.order) - 1.0
        found = super().sampled(period)
        if self.m > 1 and np.exp(-self.scale * period) <= beta_min:
            raise InputError(
                f"a half-gain observer of {self.scale:g} rad/s with m = {self.m} is unstable at a period of "
                f"{period:g} s, expected a bandwidth below {-np.log(beta_min) / period:.4g} rad/s; try "
                "m = 1, which is stable at each"
            )
        return found

    def sampled_gains(self, Phi: Array, period: float) -> Array:
        """L / 2 (m + 2,), dimensionless; L places all poles at exp(-omega T). Phi: transition matrix."""
        whole = GPIObserver.from_bandwidth(self.scale, self.m)
        return whole.sampled_gains(Phi, period) / 2.0
