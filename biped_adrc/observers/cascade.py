"""The cascade of extended state observers: the first and slowest alone sees the noise of the measurement.

    x_i1' = x_i2                                  + l_i1 e_i,     e_1 = y - x_11,  e_i = x_(i-1)1 - x_i1
    x_i2' = x_i3 + x_13 + ... + x_(i-1)3 + kappa u + l_i2 e_i                             level i = 1..r
    x_i3' =                                         l_i3 e_i,     all poles at -alpha^(i-1) omega

    q_b^ = x_r1,   q_b'^ = x_r2,   xi^ = x_13 + ... + x_r3

y [rad] is the measured angle of a joint, kappa u [rad/s^2] the acceleration that the torques give by the
nominal model, omega [rad/s] the bandwidth of the first level. Each level observes the angle of the one before
it, alpha times faster, and its x_i3 is what is left of the disturbance. With more extended states all of them
are left-overs. At high frequencies noise in y enters xi^ by the gain l_13 of the first level alone, which is
alpha^(3 (r-1)) times less than that of one observer with the bandwidth alpha^(r-1) omega.

States here are the sums xi_i = x_13 + ... + x_i3, so that each level is a GPI observer of the whole xi:

    x_i1' = x_i2 + l_i1 e_i,   x_i2' = xi_i + kappa u + l_i2 e_i,   xi_i' = l_13 e_1 + ... + l_i3 e_i

and the estimates are the states of the last level. In sampled time each level has its current form: the
correction of a level uses the corrected angle of the one before it at the same instant, and hands what it adds
to xi_i on to the next. Then a disturbance by the model is followed without an error for each m.

Lakomy, Madonski, ISA Transactions 109, 2021, arXiv 2004.01483. When it pays: Benyahia, Stankovic, Madonski,
Babayomi, Manojlovic, IEEE/CAA J. Automatica Sinica, 2024, 124995.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import InputError, check_count, check_positive
from biped_adrc.core.types import Array, Indices
from biped_adrc.observers.base import ChainObserver, Estimate, Observer, ResetPolicy, check_chain
from biped_adrc.observers.gpi import GPIObserver, mean_bandwidth


@dataclass(frozen=True)
class CascadeObserver(Observer):
    """The cascade, the same for every joint; its state z is (r, m + 2, p). Make it with `from_bandwidth`.

    chains: an observer for each level, the slowest first, with one m and one `scale`.
    """

    chains: tuple[ChainObserver, ...]

    MAKERS = ("from_bandwidth",)
    lead = 2
    """Number of integrators between disturbance and measurement, as of each level."""

    def __post_init__(self) -> None:
        check_part(self.chains, "the levels of a cascade", tuple)
        for chain in self.chains:
            check_part(chain, "a level of a cascade", ChainObserver)
        alike = {(chain.m, chain.scale) for chain in self.chains}
        if len(alike) != 1 or any(chain.lead != self.lead for chain in self.chains):
            raise InputError(
                f"the levels of a cascade are {self.chains}, expected at least one, with one m and one scale, "
                "of angles; try CascadeObserver.from_bandwidth"
            )

    @classmethod
    def from_bandwidth(
        cls, bandwidth: float, m: int = 1, levels: int = 2, ratio: float = 3.0
    ) -> CascadeObserver:
        """The cascade with m extended states, whose level i has all poles at -ratio^(i-1) bandwidth [rad/s].

        levels: their number r. ratio: alpha. Raises InputError for values out of range.
        """
        check_positive(bandwidth, f"the bandwidth of a cascade is {bandwidth!r} rad/s")
        check_count(m, f"the order m of a cascade is {m!r}")
        check_count(levels, f"the number of levels of a cascade is {levels!r}")
        check_positive(ratio, f"the ratio of a cascade's bandwidths is {ratio}", ", such as 3")
        found = [GPIObserver.from_bandwidth(bandwidth * ratio**i, m) for i in range(levels)]
        scale = mean_bandwidth([pole for chain in found for pole in chain.poles])
        check_chain(levels * (m + 2), scale, "a cascade")
        return cls(tuple(replace(chain, scale=scale) for chain in found))

    def initial_state(self, y: Array, dy: Array, xi: Array) -> Array:
        """State z of which each level estimates y, dy and xi, each (p,): only the first one has a x_i3."""
        return np.array([chain.initial_state(y, dy, xi) for chain in self.chains])

    def estimate(self, z: Array) -> Estimate:
        """Estimates of the last level, each (p,)."""
        return self.chains[-1].estimate(z[-1])

    def reset(
        self, z: Array, policy: ResetPolicy, swap: Indices, y: Array, dy: Array, xi: Array
    ) -> Array:
        """State z after impact: each level is reset by the policy, as `ChainObserver` is."""
        levels = zip(self.chains, z, strict=True)
        return np.array([chain.reset(x, policy, swap, y, dy, xi) for chain, x in levels])

    def flow(self, z: Array, y: Array, input: Array) -> Array:
        """z' (r, m + 2, p) for the angles y (p,) [rad] and the input kappa u (p,) [rad/s^2]."""
        result, added = [], 0.0 * z[0][2:]
        for chain, x in zip(self.chains, z, strict=True):
            dx, free = chain.flow(x, y, input), chain.flow(x, x[0], input)  # free: for e_i = 0
            dx[2:] += added
            result.append(dx)
            added, y = dx[2:] - free[2:], x[0]
        return np.array(result)

    def correct(self, z: Array, y: Array) -> Array:
        """State z at the sample instant, corrected by the angles y (p,) [rad]."""
        result, added = [], 0.0 * z[0][2:]
        for chain, x in zip(self.chains, z, strict=True):
            after = chain.correct(x, y)
            after[2:] += added
            result.append(after)
            added, y = after[2:] - x[2:], after[0]
        return np.array(result)

    def predict(self, z: Array, input: Array) -> Array:
        """State z one period later under a constant input (p,) [rad/s^2]."""
        return np.array([chain.predict(x, input) for chain, x in zip(self.chains, z, strict=True)])

    def sampled(self, period: float) -> CascadeObserver:
        """The cascade of the levels' current forms for ticks every `period` [s]."""
        return CascadeObserver(tuple(chain.sampled(period) for chain in self.chains))  # type: ignore[misc]
