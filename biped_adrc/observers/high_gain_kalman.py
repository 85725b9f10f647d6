"""The observer (17) with gains from other considerations: one small number, or the intensities of two noises.

*High gain*: gains alpha_i / eps^i, with one number eps [s] to choose.

    x1^' = x2^      + alpha_1 / eps   (y - x1^)
    x2^' = x3^ + kappa u + alpha_2 / eps^2 (y - x1^)
     ...
    x_(m+2)^' =       alpha_(m+2) / eps^(m+2) (y - x1^)

s^(m+2) + alpha_1 s^(m+1) + ... + alpha_(m+2) is Hurwitz; its roots divided by eps are the poles. As eps falls
the loop recovers what it does with the state and the disturbance known, and the peaking of the estimates
after a jump grows as eps^-(k-1): limit the torque, and start again at impact. Freidovich, Khalil, IEEE TAC
53(10), 2008; Khalil, High-Gain Observers in Nonlinear Feedback Control, SIAM, 2017. It is the GPI observer (17)
in another parametrisation, with states scaled by 1 / eps.

*Kalman*: the gains of a steady-state filter, from the intensities of two noises.

    x_1' = x_2,   x_2' = x_3 + kappa u,   ...,   x_(m+2)' = w,      y = x_1 + r

w and r are white with the intensities W [rad^2/s^(2 m + 3)] and R [rad^2 s]. The estimate of least variance is
the observer (17) with the gains of the algebraic Riccati equation, which for a chain are known in closed form:
the poles are those of a Butterworth filter of order m + 2 with the bandwidth

    omega = (W / R)^(1 / (2 (m + 2))).

In sampled time the gains L of the current (filtered) form solve the discrete Riccati equation for the noise
that w adds up to over a period T, and a measurement of variance R / T,

    Q_ij = W T^(2 k - i - j + 1) / ((k - i)! (k - j)! (2 k - i - j + 1)),   k = m + 2,   i, j = 1..k.

Kalman, Bucy, J. Basic Engineering 83(1), 1961; for the poles Kwakernaak, Sivan, Linear Optimal Control Systems,
1972, 4.4.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import comb, factorial

import numpy as np
from scipy.linalg import solve_discrete_are

from biped_adrc.core.checks import numbers
from biped_adrc.core.errors import InputError, check_positive, check_whole
from biped_adrc.core.part import derived
from biped_adrc.core.types import Array
from biped_adrc.observers.gpi import InjectedChain


@dataclass(frozen=True)
class HighGainObserver(InjectedChain):
    """The extended high-gain observer, the same for every joint. Make it with `from_epsilon`."""

    alpha: tuple[float, ...] = ()

    @classmethod
    def from_epsilon(
        cls, epsilon: float, alpha: Sequence[float] | None = None, m: int = 1
    ) -> HighGainObserver:
        """The observer with epsilon [s] and alpha_1 .. alpha_(m+2), dimensionless; those
        of (s + 1)^(m+2) if None.

        Raises InputError for an epsilon that is not positive, m below 1, and alphas that are not those of a
        stable polynomial of degree m + 2.
        """
        check_positive(epsilon, f"epsilon is {epsilon} s", " as 0.002")
        check_whole(m, f"the order m of a high-gain observer is {m!r}", 1)
        if alpha is None:
            alpha = [comb(m + 2, i) for i in range(1, m + 3)]
        return cls(int(m), 1.0 / float(epsilon), _hurwitz(alpha, m))

    @property
    def epsilon(self) -> float:
        """eps [s]: all poles are of the order of 1 / eps."""
        return 1.0 / self.scale

    @cached_property
    def poles(self) -> tuple[complex, ...]:
        """Poles of the error dynamics (m + 2,) [rad/s]; round-off scatters m + 2 equal ones."""
        return tuple(complex(root) * self.scale for root in np.roots([1.0, *self.alpha]))

    @derived
    def scaled_gains(self) -> Array:
        """The coefficients alpha (m + 2,)."""
        return np.array(self.alpha)


def _hurwitz(alpha: Sequence[float], m: int) -> tuple[float, ...]:
    """alpha as floats. Raises InputError unless they are the coefficients of a Hurwitz
    polynomial of degree m + 2.
    """
    a = numbers(alpha, "alpha")
    if a.shape != (m + 2,) or not np.isfinite(a).all() or np.roots([1.0, *a]).real.max() >= 0.0:
        raise InputError(
            f"alpha is {a}, expected {m + 2} numbers for m = {m}: the roots of s^{m + 2} + alpha_1 "
            f"s^{m + 1} + ... must have negative real parts; try those of (s + 1)^{m + 2}"
        )
    return tuple(a.tolist())


@dataclass(frozen=True)
class KalmanObserver(InjectedChain):
    """The observer with gains of a steady-state Kalman filter; `scale` is omega [rad/s].
    Make it with `from_noise`.
    """

    measurement: float = 0.0
    """Intensity R of the measurement noise [rad^2 s]."""

    @classmethod
    def from_noise(cls, drift: float, measurement: float, m: int = 1) -> KalmanObserver:
        """The observer for noises: drift = sqrt(W) [rad/s^(m + 3/2)], measurement = sqrt(R) [rad s^(1/2)].

        sqrt(W) is the drift of x_(m+2) in the root of a second. An encoder with errors of standard
        deviation s at ticks of T seconds has the measurement s T^(1/2). Raises InputError for numbers that
        are not positive, and for m below 1.
        """
        check_whole(m, f"the order m of a Kalman observer is {m!r}", 1)
        check_positive(drift, f"the drift of a Kalman observer is {drift} rad/s^{m + 1.5:g}")
        check_positive(measurement, f"its measurement noise is {measurement} rad s^(1/2)")
        return cls(int(m), float(drift / measurement) ** (1.0 / (m + 2)), float(measurement) ** 2)

    @property
    def intensity(self) -> float:
        """Intensity W = R omega^(2 (m + 2)) [rad^2/s^(2 m + 3)] of the noise that drives the
        chain, from bandwidth and R.
        """
        return self.measurement * self.scale ** (2 * self.order)

    @cached_property
    def poles(self) -> tuple[complex, ...]:
        """Poles of the Butterworth filter (m + 2,) [rad/s]."""
        k = self.order
        angles = np.pi * (0.5 + (np.arange(k) + 0.5) / k)
        return tuple(complex(pole) for pole in self.scale * np.exp(1j * angles))

    def sampled_gains(self, Phi: Array, period: float) -> Array:
        """L (m + 2,) of the steady-state filter, dimensionless.

        The Riccati equation is solved with Q / R in scaled states: in physical ones its numbers cover so many
        decades that the solver fails.
        """
        k, T = self.order, period
        R = self.measurement / T
        Q = accumulated(k) * self.intensity * T ** (2 * k - 1) / R
        P = solve_discrete_are(Phi.T, np.eye(1, k).T, Q, np.ones((1, 1)))
        return P[:, 0] / (P[0, 0] + 1.0)


def accumulated(order: int) -> Array:
    """Covariance Q (k, k) that white noise of intensity W = 1 adds to k = `order`
    integrators in a period T = 1.

    It is Q in states scaled by powers of T, without its factor T^(2 k - 1).
    """
    left = [order - i for i in range(1, order + 1)]
    rows = [[1.0 / (factorial(a) * factorial(b) * (a + b + 1)) for b in left] for a in left]
    return np.array(rows)
