"""The linear loop of one joint under ADRC whose torque acts after a delay: loop gain and delay margin.

With chi(s) the observer's polynomial (19), a = kappa u - q_d'' and e = q_b - q_d, the robot and
(20) are

    e'' = a(t - d) + xi,    a = -K_p x1^ - K_d x2^ - xi^

Opened at the delay, the loop has the gain L(s), and roots on the imaginary axis where exp(i w d) = -L(i w):

    unknown  L = P / (s^(m+2) Q)           the observer is fed with a(t)
    known    L = (K_d s + K_p) / s^2       it is fed with a(t - d)

    Q = s^2 + (l_(m+1) + K_d) s + l_m + K_p + K_d l_(m+1)
    P = the terms of (s^2 + K_d s + K_p) chi below s^(m+2)

since s^(m+2) Q + P = (s^2 + K_d s + K_p) chi, which for d = 0 is the characteristic
polynomial. All coefficients of P and Q are sums of products of positive ones, so nothing cancels,
and s is counted in units of w, the geometric mean of the poles, which keeps the numbers near 1.
Without delay

    e / xi = s^m Q / ((s^2 + K_d s + K_p) chi)                    (23), corrected
    xi^ / xi = (chi - s^(m+2) - l_(m+1) s^(m+1) - l_m s^m) / chi
    a / n = -s^2 P / ((s^2 + K_d s + K_p) chi)                    n: error of the measured q_b

(22) and (23) print l_(m+1) in Q without its factor K_d. `sampled` has the same loop in sampled time.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.core.types import Array, ComplexArray
from biped_adrc.observers.gpi import GPIObserver

GRID = 2000
"""Number of frequencies of a response; crossovers are searched between them too."""


class DelayMargin(NamedTuple):
    """The smallest delay with a root on the imaginary axis, and that root."""

    delay: float
    """[s], infinite when there is none."""
    frequency: float
    """Frequency of the root [rad/s], infinite when there is none."""


@dataclass(frozen=True)
class ObserverLoop:
    """The loop of the first joint under ADRC in continuous time."""

    observer: GPIObserver
    gains: Gains = TABLE_II

    @property
    def frequencies(self) -> Array:
        """Grid of frequencies (GRID,) [rad/s], from far below the slowest pole to far above the fastest."""
        (K_p, K_d), rates = first_gains(self.gains), np.abs(self.observer.poles)
        slow, fast = min(rates.min(), np.sqrt(K_p)), max(rates.max(), K_d)
        return np.geomspace(0.01 * slow, 100.0 * fast, GRID)

    # -- polynomials in s / w, highest power first --------------------------------------------------
    @cached_property
    def _chi(self) -> Array:
        """Coefficients of chi (m + 3,), from the scaled gains."""
        return np.concatenate(([1.0], self.observer.scaled_gains))

    @cached_property
    def _feedback(self) -> Array:
        """Coefficients of s^2 + K_d s + K_p (3,)."""
        (K_p, K_d), w = first_gains(self.gains), self.observer.scale
        return np.array([1.0, K_d / w, K_p / w**2])

    def _Q(self, printed: bool = False) -> Array:
        """Coefficients of Q (3,), corrected or as printed."""
        (_, k_d, k_p), (l_1, l_2) = self._feedback, self._chi[1:3]
        factor = 1.0 / self.observer.scale if printed else k_d
        return np.array([1.0, l_1 + k_d, l_2 + k_p + factor * l_1])

    @cached_property
    def _P(self) -> Array:
        """Coefficients of P (m + 2,): the last ones of the product."""
        return np.asarray(np.polymul(self._feedback, self._chi)[3:], dtype=float)

    # -- frequency responses -------------------------------------------------------------------------
    def _response(self, numerator: Array, frequency: Array, feedback: bool = True) -> ComplexArray:
        """numerator / (chi (s^2 + K_d s + K_p)), or numerator / chi without `feedback`, at s = i w.

        frequency [rad/s]; chi is evaluated as a product over the poles, which loses no digits.
        """
        s = 1j * np.asarray(frequency, dtype=float) / self.observer.scale
        value: ComplexArray = np.asarray(np.polyval(numerator, s), dtype=complex)
        for pole in self.observer.poles:
            value = value / (s - pole / self.observer.scale)
        return value / np.polyval(self._feedback, s) if feedback else value

    def tracking_error(self, frequency: Array, printed: bool = False) -> ComplexArray:
        """e / xi (K,) [s^2] by (23), corrected or as printed, at frequencies (K,) [rad/s]."""
        numerator = np.concatenate((self._Q(printed), np.zeros(self.observer.m)))
        return self._response(numerator, frequency) / self.observer.scale**2

    def estimate(self, frequency: Array) -> ComplexArray:
        """xi^ / xi (K,), dimensionless, at frequencies (K,) [rad/s]; zero for m = 0, which has no xi^."""
        rest = self._chi[3:] if self.observer.m else np.zeros(1)
        return self._response(rest, frequency, feedback=False)

    def noise(self, frequency: Array) -> ComplexArray:
        """a / n (K,) [1/s^2] at frequencies (K,) [rad/s]: acceleration per error of the measured angle."""
        numerator = np.concatenate((self._P, [0.0, 0.0]))
        return -self._response(numerator, frequency) * self.observer.scale**2

    def gain(self, frequency: Array, known: bool = False) -> ComplexArray:
        """Loop gain L (K,), dimensionless, at frequencies (K,) [rad/s]; known: whether the
        observer is fed with a(t - d).
        """
        s = 1j * np.asarray(frequency, dtype=float) / self.observer.scale
        if known:
            return np.polyval(self._feedback[1:], s) / s**2
        bottom = np.concatenate((self._Q(), np.zeros(self.observer.order)))
        return np.polyval(self._P, s) / np.polyval(bottom, s)

    # -- stability -----------------------------------------------------------------------------------
    def delay_margin(self, known: bool = False) -> DelayMargin:
        """The smallest delay [s] that destabilises the loop, and the frequency of the root on the axis.

        known: the observer is fed with a(t - d). Roots are searched where |L| crosses 1.
        """

        def level(log_w: Array) -> Array:
            return np.log(np.abs(self.gain(np.exp(log_w), known)))

        grid = np.log(self.frequencies)
        turns = np.flatnonzero(np.diff(level(grid) > 0.0))
        if len(turns) == 0:
            return DelayMargin(np.inf, np.inf)
        at = np.exp([brentq(level, grid[i], grid[i + 1], xtol=1e-14) for i in turns])
        delays = np.mod(np.angle(-self.gain(at, known)), 2.0 * np.pi) / at
        first = int(np.argmin(delays))
        return DelayMargin(float(delays[first]), float(at[first]))


def first_gains(gains: Gains) -> tuple[float, float]:
    """K_p [1/s^2] and K_d [1/s] of the first joint."""
    return float(np.ravel(gains.K_p)[0]), float(np.ravel(gains.K_d)[0])
