"""The GPI observer of an angle that a low-pass has smoothed, which it knows.

    f^'  = (x1^ - f^) / tau + l_1 (y - f^)
    x1^' = x2^              + l_2 (y - f^) / tau ..
     ...
    x_k^' =                   l_(k+1) (y - f^) ..,       k = m + 2

y = f [rad] is the angle of a joint behind a low-pass of the time constant tau [s], as the encoders have it
(`hardware.encoders.angle_filter`); x1^, x2^, x3^ estimate the angle before it, its rate, and the disturbance.
In x^ / tau the chain has one integrator more than (17), of which the first one leaks: so l_1 = a_1 - 1 / tau
and l_j = a_j, with a_j the coefficients of the polynomial of all m + 3 poles.

In sampled time f_k = (1 - s) f_(k-1) + s q_k with s = 1 - exp(-T / tau), as the encoders compute it. With
Z = (f^, s x1^, s T x2^, s T^2 x3^ ..)

    Z <- Phi Z + Gamma kappa u,     Z <- Z + L (y - Z_1)

where the first row of Phi is (1 - s, 1, 1, 1/2, 1/6 ..), and L places all poles at exp(-omega T). An observer
that does not know the filter takes its lag for a motion of the joint.
"""

from dataclasses import dataclass, field
from typing import Annotated, Self

import numpy as np

from biped_adrc.core.checks import Range
from biped_adrc.core.errors import InputError, check_positive, check_whole
from biped_adrc.core.part import derived
from biped_adrc.core.types import Array, Indices
from biped_adrc.observers.base import ChainObserver, ErrorSystem, Estimate, ResetPolicy, equal_poles
from biped_adrc.observers.gpi import InjectedChain, SampledChain, transition

MOST_SHARE = 0.95
"""Largest share [1] of a new sample behind the low-pass: beyond it there is no filter, and no L."""


class BehindChain(ChainObserver):
    """Start, estimates and resets with z = (f^, c x1^, c x2^ / scale, ..), c the `share`."""

    share: float

    def initial_state(self, y: Array, dy: Array, xi: Array) -> Array:
        z = np.zeros((self.order, len(y)))
        z[0], z[1], z[2] = y, self.share * y, self.share * dy / self.scale
        if self.m > 0:
            z[3] = self.share * xi / self.scale**2
        return z

    def estimate(self, z: Array) -> Estimate:
        x = z[1:] / self.share
        xi = x[2] * self.scale**2 if self.m > 0 else 0.0 * x[0]
        return Estimate(x[0], x[1] * self.scale, xi)

    def reset(
        self, z: Array, policy: ResetPolicy, swap: Indices, y: Array, dy: Array, xi: Array
    ) -> Array:
        """State z after impact, as `ChainObserver` has it; MEASURED takes y for f^ and x1^, as the filter of
        the encoders begins anew there.
        """
        new = self.initial_state(y, dy, xi)
        if policy is ResetPolicy.MODEL:
            return new
        z = super().reset(z, ResetPolicy.RELABEL, swap, y, dy, xi) if policy.value != "none" else z
        return np.concatenate((new[:3], z[3:])) if policy is ResetPolicy.MEASURED else z


@dataclass(frozen=True)
class BehindFilterObserver(BehindChain, InjectedChain):
    """The observer with all m + 3 poles at -scale [rad/s], the same for every joint. Make it with
    `from_bandwidth`.
    """

    filter_time: Annotated[
        float, Range("a time [s], above 0 and at most 1", lambda x: 0.0 < x <= 1.0)
    ]
    """Time constant tau of the low-pass that it knows [s]."""
    lead: int = field(default=3, kw_only=True)

    MAKERS = ("from_bandwidth",)

    @classmethod
    def from_bandwidth(cls, bandwidth: float, filter_time: float, m: int = 1) -> Self:
        """The observer with all m + 3 poles at -bandwidth [rad/s] behind a low-pass of filter_time [s].

        Raises InputError for values out of range.
        """
        check_whole(m, f"observer order m is {m!r}")
        equal_poles(bandwidth, m + 3)
        return cls(int(m), float(bandwidth), filter_time)

    @derived
    def share(self) -> float:
        """1 / (w tau) [1], w the `scale`."""
        return 1.0 / (self.scale * self.filter_time)

    def flow(self, z: Array, y: Array, input: Array) -> Array:
        """z' (m + 3, p) for the angles y (p,) [rad] behind the filter and the input kappa u (p,) [rad/s^2]."""
        dz = super().flow(z, y, input / self.filter_time)
        # the leak of the filter; `scaled_gains` place the poles as if there were none, so l_1 is less by it
        dz[0] -= y / self.filter_time
        return dz

    def error_system(self) -> ErrorSystem | None:  # type: ignore[override]
        """None: the angle behind the filter is no state of the robot."""
        return None

    def sampled(self, period: float) -> SampledChain:
        """The current discrete observer for ticks every `period` [s]."""
        check_positive(period, f"the sampling period is {period} s")
        share = float(-np.expm1(-period / self.filter_time))
        if share > MOST_SHARE:
            raise InputError(
                f"a low-pass of {self.filter_time:g} s is none at a period of {period:g} s, expected a third "
                "of it or more; take the observer GPI"
            )
        return SampledBehindFilter(self.m, 1.0 / period, self, period, share, lead=3)


@dataclass(frozen=True)
class SampledBehindFilter(BehindChain, SampledChain):
    """The discrete form of `BehindFilterObserver` for one period T [s]."""

    share: float
    """s = 1 - exp(-T / tau) [1]."""

    @derived
    def Phi(self) -> Array:
        """Transition matrix (m + 3, m + 3) of the module over one period, dimensionless."""
        Phi = np.zeros((self.order, self.order))
        Phi[1:, 1:] = transition(self.order - 1)
        Phi[0] = Phi[1]
        Phi[0, 0] = 1.0 - self.share
        return Phi

    @derived
    def Gamma(self) -> Array:
        """Input vector (m + 3,): s T^2 (1/2, 1/2, 1, 0, ..) [s^2]."""
        Gamma = np.zeros(self.order)
        Gamma[:3] = self.share * self.period**2 * np.array([0.5, 0.5, 1.0])
        return Gamma
