"""The chain of integrators with the gains of a steady-state Kalman filter, from the intensities of two noises.

    x_1' = x_2,   x_2' = x_3 + kappa u,   ...,   x_(m+2)' = w,      y = x_1 + r

x_1 is a joint's angle, x_2 its velocity, x_3 its disturbance, kappa u the acceleration that the torques give by
the nominal model, and y the measured angle. w and r are white with the intensities W [rad^2/s^(2 m + 3)] and R
[rad^2 s]. The estimate of least variance is the observer (17) of the paper with the gains of the algebraic
Riccati equation, which for a chain are known in closed form: the poles are those of a Butterworth filter of
order m + 2 with the bandwidth

    omega = (W / R)^(1 / (2 (m + 2))).

In sampled time the gains L of the current (filtered) form solve the discrete Riccati equation for the noise
that w adds up to over a period T, and a measurement of variance R / T,

    Q_ij = W T^(2 k - i - j + 1) / ((k - i)! (k - j)! (2 k - i - j + 1)),   k = m + 2,   i, j = 1..k.

Kalman, Bucy, J. Basic Engineering 83(1), 1961; for the poles Kwakernaak, Sivan, Linear Optimal Control Systems,
1972, 4.4.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import factorial

import numpy as np
from scipy.linalg import solve_discrete_are

from biped_adrc.core.errors import check_positive, check_whole
from biped_adrc.core.types import Array
from biped_adrc.observers.gpi import InjectedChain


@dataclass(frozen=True)
class KalmanObserver(InjectedChain):
    """The observer with gains of a steady-state Kalman filter; `scale` is omega [rad/s]. Make it with
    `from_noise`, whose `measurement` is sqrt(R), while the field `measurement` is R.
    """

    measurement: float = 0.0
    """Intensity R of the measurement noise [rad^2 s]."""

    MAKERS = ("from_noise",)

    @classmethod
    def from_noise(cls, drift: float, measurement: float, m: int = 1) -> KalmanObserver:
        """The observer for noises: drift = sqrt(W) [rad/s^(m + 3/2)], measurement = sqrt(R) [rad s^(1/2)].

        sqrt(W) is the standard deviation by which x_(m+2) drifts in one second. An encoder whose errors have
        the standard deviation s [rad], at sample instants every T [s], has measurement = s T^(1/2). Raises
        InputError for numbers that are not positive, and for m below 1.
        """
        check_whole(m, f"the order m of a Kalman observer is {m!r}", 1)
        check_positive(drift, f"the drift of a Kalman observer is {drift} rad/s^{m + 1.5:g}")
        check_positive(measurement, f"its measurement noise is {measurement} rad s^(1/2)")
        # order, bandwidth omega = (sqrt(W) / sqrt(R))^(1 / (m + 2)), and R
        return cls(int(m), float(drift / measurement) ** (1.0 / (m + 2)), float(measurement) ** 2)

    @property
    def intensity(self) -> float:
        """Intensity W = R omega^(2 (m + 2)) [rad^2/s^(2 m + 3)] of the noise that drives the
        chain, from bandwidth and R.
        """
        # self.order is m + 2, the number of states
        return self.measurement * self.scale ** (2 * self.order)

    @cached_property
    def poles(self) -> tuple[complex, ...]:
        """Poles of the Butterworth filter (m + 2,) [rad/s]."""
        k = self.order
        angles = np.pi * (0.5 + (np.arange(k) + 0.5) / k)
        return tuple(complex(pole) for pole in self.scale * np.exp(1j * angles))

    def sampled_gains(self, Phi: Array, period: float) -> Array:
        """L (m + 2,) of the steady-state filter, dimensionless. Phi (m + 2, m + 2): transition matrix over the
        period [s].

        The Riccati equation is solved in states scaled by powers of T, for P, the covariance of the prediction
        over R / T: in physical states its numbers cover so many decades that the solver fails.
        """
        k, T = self.order, period
        R = self.measurement / T
        # rows: Q of the module for W = T = 1; in states scaled by powers of T, Q is W T^(2 k - 1) times these
        left = range(k - 1, -1, -1)  # k - i and k - j of the module, for i, j = 1 .. k
        rows = [[1.0 / (factorial(a) * factorial(b) * (a + b + 1)) for b in left] for a in left]
        Q = np.array(rows) * self.intensity * T ** (2 * k - 1) / R
        # C = (1, 0, ..) measures the first state, and in units of R / T its noise has the variance 1
        P = solve_discrete_are(Phi.T, np.eye(1, k).T, Q, np.ones((1, 1)))
        # the gain P C^T / (C P C^T + 1)
        return P[:, 0] / (P[0, 0] + 1.0)
