"""The GPI observer that knows one frequency of its disturbance: a sine of it leaves no steady error.

    x1^' = x2^            + l_1 (y - x1^)
    x2^' = x3^ + kappa u  + l_2 (y - x1^)
     ...
    x_k^' = -omega^2 x_(k-1)^ + l_k (y - x1^),       k = m + 2,   m >= 2

x1^, x2^, x3^ estimate a joint's angle, velocity and disturbance xi, y [rad] is the measured angle, and kappa u
[rad/s^2] the acceleration that the torques give by the nominal model. So xi obeys

    s^(m-2) (s^2 + omega^2) xi = 0,

and is a polynomial of degree m - 3 and a sine of omega [rad/s], such as 2 pi over the time of a walking step.
The reset at impact decides what is left of it there: RELABEL and MEASURED keep the sine of each leg's part in
the step, NONE that of each joint, for which two steps are the period; MODEL begins anew in each step.
The error has the polynomial s^k + a_1 s^(k-1) + ... + a_k with all roots at -w, w the bandwidth [rad/s]; from
a_j = l_j + omega^2 l_(j-2) the gains follow, l_0 = 1.

In sampled time the model is exact, not held over the period T: with Z_j = x_j^ T^(j-1),

    Z <- Phi Z + Gamma kappa u,   Phi = exp(N),      N_j,j+1 = 1,   N_k,k-1 = -(omega T)^2,

whose last two rows and columns turn by omega T. kappa u is held, so that Gamma = T^2 (1/2, 1, 0, ..) as
without the sine. L places all poles at exp(-w T), by Ackermann's formula. For m = 2 the model has no constant,
for m = 3 a constant too.

Cortes-Romero, Ramos, Coral-Enriquez, ISA Transactions 53(6), 2014; Pan, Wang, arXiv 1603.03734, 2016.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.linalg import expm

from biped_adrc.core.checks import PositiveFloat
from biped_adrc.core.errors import InputError, check_positive, check_whole
from biped_adrc.core.part import SETUP, derived
from biped_adrc.core.types import Array
from biped_adrc.observers.base import ErrorSystem, equal_poles
from biped_adrc.observers.gpi import InjectedChain, SampledChain


@dataclass(frozen=True)
class InternalModelObserver(InjectedChain):
    """The observer with a sine in its model, the same for every joint; `scale` is the bandwidth w [rad/s]. Make
    it with `from_bandwidth`.
    """

    omega: PositiveFloat
    """Frequency of the sine [rad/s]."""

    MAKERS = ("from_bandwidth",)

    def __post_init__(self) -> None:
        super().__post_init__()
        check_whole(self.m, f"an observer with a sine has m = {self.m} extended states", 2)

    @classmethod
    def from_bandwidth(cls, bandwidth: float, omega: float, m: int = 1) -> InternalModelObserver:
        """The observer with all poles at -bandwidth [rad/s] for a sine of omega [rad/s] and a polynomial.

        m: number of the polynomial's coefficients, 1 for a constant; with the sine m + 2 states are extended.
        Raises InputError for values out of range.
        """
        check_whole(m, f"observer order m is {m!r}")
        equal_poles(bandwidth, m + 4)
        return cls(int(m) + 2, float(bandwidth), omega)

    @derived
    def scaled_gains(self) -> Array:
        """l_j / w^j (m + 2,), dimensionless: the series of a(s) / (1 + (omega / w)^2 / s^2), to 1 / s^k."""
        a = np.poly(-np.ones(self.order))
        series, _ = np.polydiv([*a, 0.0, 0.0], [1.0, 0.0, (self.omega / self.scale) ** 2])
        return np.ascontiguousarray(series[1:])

    def flow(self, z: Array, y: Array, input: Array) -> Array:
        """z' of the scaled states z (m + 2, p) for the angles y (p,) [rad] and input kappa u (p,) [rad/s^2]."""
        dz = super().flow(z, y, input)
        dz[-1] -= self.omega**2 / self.scale * z[-2]
        return dz

    def error_system(self) -> ErrorSystem:
        """Error dynamics e' = A e + b (q_b'' - kappa u) in scaled states."""
        found = super().error_system()
        found.A[-1, -2] -= self.omega**2 / self.scale
        return found

    def sampled(self, period: float) -> SampledChain:
        """The current discrete observer for ticks every `period` [s]. Raises InputError for omega T >= pi."""
        check_positive(period, f"the sampling period is {period} s")
        angle = self.omega * period
        if angle >= np.pi:
            raise InputError(
                f"a sine of {self.omega:g} rad/s is sampled every {period:g} s, expected less than pi / T = "
                f"{np.pi / period:.4g} rad/s; give a lower omega, or a shorter period"
            )
        return SampledInternalModel(self.m, 1.0 / period, self, period, angle)


@dataclass(frozen=True)
class SampledInternalModel(SampledChain):
    """The discrete form of `InternalModelObserver` for one period T [s]."""

    angle: float = field(metadata=SETUP)
    """omega T [rad], by which the sine turns in a period."""

    @derived
    def Phi(self) -> Array:
        """Transition matrix exp(N) (k, k) of the scaled states over one period, dimensionless."""
        N = np.eye(self.order, k=1)
        N[-1, -2] = -(self.angle**2)
        return np.asarray(expm(N))
