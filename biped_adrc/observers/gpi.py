"""The Generalized Proportional Integral (GPI) observer, equation (17) of the paper, of any order m >= 0.

    x1^' = x2^ + l_(m+1) (y - x1^)
    x2^' = x3^ + l_m     (y - x1^) + kappa u
    x3^' = x4^ + l_(m-1) (y - x1^)
     ...
    x_(m+2)^' = l_0 (y - x1^)

for each actuated joint. y [rad] is its measured angle, u (p,) [N m] are the torques, and kappa u [rad/s^2] is
the acceleration that they give to it by the nominal model. x1^, x2^, x3^ estimate angle, velocity and
disturbance [rad/s^2], the others the derivatives of the disturbance. l_k [1/s^(m+2-k)] are the gains.

The estimation error obeys equation (19) of the paper; its m + 2 poles are chosen, and the gains follow. In
continuous time the states are scaled by w [rad/s], the geometric mean of the magnitudes of the poles:
z_k = x_k^ / w^(k-1). The scaled gains l_(m+2-k) / w^k, k = 1..m+2, are the coefficients of the polynomial
whose roots are the poles divided by w. The injection is written l (y - x1^), never as the difference
l y - l x1^, which is lost in round-off with gains up to 1e29.

In discrete time, with the period T [s], the states are scaled by T instead: Z_k = x_k^ T^(k-1). The observer
has its *current* (filtered) form, in which y is the measurement of the same sample instant:

    Z <- Phi Z + Gamma kappa u       prediction over one period
    Z <- Z + L (y - Z_1)             correction at the sample instant

Phi is the transition matrix of a chain of integrators, Phi_ij = 1/(j - i)! for j >= i, else 0, and
Gamma = T^2 (1/2, 1, 0, ...). With one integrator between input and measurement instead of two (`momentum`),
Gamma is T (1, 0, ...), and a force takes the place of kappa u. L places the eigenvalues of (I - L C) Phi,
C = (1, 0, ...), at exp(s T) for each pole s, by Ackermann's formula. The continuous observer with y - x1^ held
over each period would be unstable with the paper's poles (Table I) at T = 1 ms; the current form is stable.

m = 0 estimates position and velocity alone, m = 1 is the linear extended state observer, and m extended states
follow a disturbance that is a polynomial of degree m - 1 in time without a steady error. `high_gain`
and `kalman` have the same observer with gains from other considerations.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import accumulate
from math import factorial

import numpy as np

from biped_adrc.core.errors import InputError, check_positive, check_whole
from biped_adrc.core.part import SETUP, derived
from biped_adrc.core.types import Array, read_only
from biped_adrc.observers.base import ChainObserver, ErrorSystem, equal_poles, stable_poles

TABLE_I = tuple(-180.0 * 1.8**k for k in range(9))
"""Table I [rad/s]; the paper rounds them ("-11.020" and "-19.836" use the dot for thousands).

>>> [round(pole) for pole in ba.TABLE_I[:4]]
[-180, -324, -583, -1050]
"""


def mean_bandwidth(poles: Sequence[complex]) -> float:
    """Geometric mean of the magnitudes of the poles [rad/s]."""
    return float(np.exp(np.mean(np.log(np.abs(poles)))))


@dataclass(frozen=True)
class InjectedChain(ChainObserver):
    """Base of the observers (17), whatever their gains; a subclass may define other `poles`.

    k = lead + m is the number of states per coordinate: m + 2 for the GPI observer, m + 1 for the momentum
    observer, which has one integrator between input and measurement (lead = 1). w is `scale`.
    """

    @property
    def poles(self) -> tuple[complex, ...]:
        """Poles of the error dynamics (k,) [rad/s], all at -w."""
        return equal_poles(self.scale, self.order)

    @derived
    def scaled_gains(self) -> Array:
        """l_(m+1)/w, l_m/w^2, ... (k,), dimensionless: coefficients of the polynomial of the poles divided by
        w, without its leading 1.
        """
        return np.ascontiguousarray(np.real(np.poly(np.array(self.poles) / self.scale))[1:])

    @property
    def gains(self) -> Array:
        """l_(m+1), l_m, ..., l_0 of (17) in physical units (k,): [1/s], [1/s^2], ..., [1/s^k]."""
        # self.order is k, the number of states
        return self.scaled_gains * self.scale ** np.arange(1, self.order + 1)

    def flow(self, z: Array, y: Array, input: Array) -> Array:
        """z' of the scaled states z (k, p), for the measurement y (p,) [rad] and input kappa u (p,) [rad/s^2].

        With one integrator y is a momentum and the input a force, each (n,).
        """
        w = self.scale
        dz = w * np.outer(self.scaled_gains, y - z[0])
        dz[:-1] += w * z[1:]
        # the input drives the state one above the disturbance: the velocity, with one integrator the momentum
        dz[self.lead - 1] += input / w ** (self.lead - 1)
        return dz

    def sampled(self, period: float) -> SampledChain:
        """The current (filtered) discrete observer for ticks every `period` [s]."""
        check_positive(period, f"the sampling period is {period} s")
        return SampledChain(self.m, 1.0 / period, self, period, lead=self.lead)

    def sampled_gains(self, Phi: Array, period: float) -> Array:
        """L (k,), dimensionless, which places the eigenvalues of (I - L C) Phi at exp(s T), s the `poles`.

        Ackermann's formula: L = p(Phi) O^-1 (0, .., 0, 1), where p is the polynomial of these eigenvalues and
        the rows of O are C Phi, C Phi^2, .. Phi (k, k): transition matrix over the period T [s].
        """
        k = self.order
        N = Phi - np.eye(k)
        roots = np.exp(np.array(self.poles) * period)
        p_of_Phi = np.eye(k, dtype=complex)
        for root in roots:  # factors (1 - root) I + N: no cancellation for real roots in (0, 1)
            p_of_Phi = p_of_Phi @ ((1.0 - root) * np.eye(k) + N)
        rows = [*accumulate([Phi] * (k - 1), np.matmul, initial=Phi[0])]
        last = np.linalg.solve(np.array(rows), np.eye(k)[-1])
        # complex poles come in pairs, so the imaginary part is round-off
        return np.ascontiguousarray(np.real(p_of_Phi @ last))

    def error_system(self) -> ErrorSystem:
        """Error dynamics (19) in scaled states, e' = A e + b (q_b'' - kappa u): A (m + 2, m + 2) [1/s], and 1/w
        [s], the factor of velocities in e and the only entry of b, in the row of the velocity.
        """
        A = self.scale * np.eye(self.order, k=1)
        A[:, 0] = -self.scale * self.scaled_gains
        return ErrorSystem(A, 1.0 / self.scale)


@dataclass(frozen=True)
class GPIObserver(InjectedChain):
    """The GPI observer (17) with the same m + 2 poles for every joint. Make it with
    `from_poles` or `from_bandwidth`.

    m: number of the extended states. scale [rad/s]: near the bandwidth, by which states are scaled. poles (m +
    2,) [rad/s]: of the error dynamics. lead: number of integrators between disturbance and measurement, 2 from
    an acceleration to an angle.

    >>> ba.GPIObserver.from_bandwidth(300.0, m=1).gains
    array([9.0e+02, 2.7e+05, 2.7e+07])
    """

    poles: tuple[complex, ...] = ()

    MAKERS = ("from_bandwidth", "from_poles")

    @classmethod
    def from_poles(cls, poles: Sequence[complex] = TABLE_I, m: int | None = None) -> GPIObserver:
        """The observer with m + 2 stable poles [rad/s]; complex ones in conjugate pairs.

        m: follows from their number; an m other than None is compared with it. Raises InputError where they
        differ, and as `stable_poles`.
        """
        poles = stable_poles(poles, "a GPI observer")
        if m is not None and len(poles) != m + 2:
            raise InputError(
                f"a GPI observer with m = {m} has {m + 2} poles, found {len(poles)}; give its bandwidth too"
            )
        return cls(len(poles) - 2, mean_bandwidth(poles), poles)

    @classmethod
    def from_bandwidth(cls, bandwidth: float, m: int = 1) -> GPIObserver:
        """The observer with all m + 2 poles at -bandwidth [rad/s]; m = 1 is the linear
        extended state observer.

        Raises InputError for a bandwidth or an order out of range.
        """
        check_whole(m, f"observer order m is {m!r}")
        return cls.from_poles(equal_poles(bandwidth, m + 2))


@cache
def transition(k: int) -> Array:
    """Transition matrix (k, k) of k integrators in a chain over one unit of time."""
    rows = [[1.0 / factorial(j - i) if j >= i else 0.0 for j in range(k)] for i in range(k)]
    return read_only(np.array(rows))


@dataclass(frozen=True)
class SampledChain(ChainObserver):
    """The discrete form of an observer for one period T [s]; `scale` is 1/T, so that Phi does not contain T.

    continuous: the observer in continuous time, which computes L. period: T. k = lead + m is the number of
    states per coordinate, z (k, p). The input is held between ticks. Where it changes within a period, as the
    known force beta of the momentum observer, this looks like a part of the disturbance: the estimate has an
    error of about (T / 2) dbeta/dt.
    """

    continuous: InjectedChain = field(metadata=SETUP)
    period: float

    @property
    def Phi(self) -> Array:
        """Transition matrix (k, k) of the scaled states over one period, dimensionless."""
        # no derived number: k alone decides it, and in machine code its zeros and ones cost nothing
        return transition(self.order)

    @derived
    def Gamma(self) -> Array:
        """Input vector (k,) [s^2]: T^2 (1/2, 1, 0, ..); for one integrator T (1, 0, ..) [s]."""
        Gamma, lead = np.zeros(self.order), self.lead
        Gamma[:lead] = [self.period**lead / factorial(lead - i) for i in range(lead)]
        return Gamma

    @derived
    def L(self) -> Array:
        """Correction gains (k,), dimensionless."""
        return self.continuous.sampled_gains(self.Phi, self.period)

    def correct(self, z: Array, y: Array) -> Array:
        """State z at the sample instant, corrected by the measurement y (p,)."""
        return z + np.outer(self.L, y - z[0])

    def predict(self, z: Array, input: Array) -> Array:
        """State z one period later under a constant input (p,) [rad/s^2], a force [N m] for one integrator."""
        moved, lead = self.Phi @ z, self.lead  # Gamma is zero behind its first `lead` numbers
        return np.concatenate((moved[:lead] + np.outer(self.Gamma[:lead], input), moved[lead:]))
