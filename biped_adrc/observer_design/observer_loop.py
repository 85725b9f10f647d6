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

`observer_sampled` has the same loop in sampled time, `analysis.linear_loop` (23) as printed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.errors import InputError
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.types import Array, ComplexArray

GRID = 2000
"""Number of frequencies between which crossovers are searched, besides the roots of their polynomial."""


class DelayMargin(NamedTuple):
    """The smallest delay with a root on the imaginary axis, and that root."""

    delay: float
    """[s], infinite when there is none."""
    frequency: float
    """[rad/s], as the delay infinite."""


@dataclass(frozen=True)
class ObserverLoop:
    """The loop of one joint in continuous time. Make it with `observer_loop`."""

    observer: GPIObserver
    K_p: float
    """[1/s^2]."""
    K_d: float
    """[1/s]."""

    # -- polynomials in s / w, highest power first --------------------------------------------------
    @cached_property
    def _chi(self) -> Array:
        """chi (m + 3,), from the scaled gains."""
        return np.concatenate(([1.0], self.observer.scaled_gains))

    @cached_property
    def _feedback(self) -> Array:
        """s^2 + K_d s + K_p (3,)."""
        w = self.observer.scale
        return np.array([1.0, self.K_d / w, self.K_p / w**2])

    @cached_property
    def _Q(self) -> Array:
        """Q (3,)."""
        (_, k_d, k_p), (l_1, l_2) = self._feedback, self._chi[1:3]
        return np.array([1.0, l_1 + k_d, l_2 + k_p + k_d * l_1])

    @cached_property
    def _P(self) -> Array:
        """P (m + 2,): the last coefficients of the product."""
        full = np.polymul(self._feedback, self._chi)
        return np.asarray(full[3:], dtype=float)

    def _broken(self, known: bool) -> tuple[Array, Array]:
        """Numerator and denominator of L, for a delay that the observer knows or not."""
        if known:
            return self._feedback[1:], np.array([1.0, 0.0, 0.0])
        return self._P, np.concatenate((self._Q, np.zeros(self.observer.order)))

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

    def tracking_error(self, frequency: Array) -> ComplexArray:
        """e / xi (K,) [s^2] at frequencies (K,) [rad/s]: the tracking error per total disturbance."""
        numerator = np.concatenate((self._Q, np.zeros(self.observer.m)))
        return self._response(numerator, frequency) / self.observer.scale**2

    def estimate(self, frequency: Array) -> ComplexArray:
        """xi^ / xi (K,), dimensionless, at frequencies (K,) [rad/s]; zero for m = 0, which has no xi^."""
        rest = self._chi[3:] if self.observer.m else np.zeros(1)
        return self._response(rest, frequency, feedback=False)

    def noise(self, frequency: Array) -> ComplexArray:
        """a / n (K,) [1/s^2] at frequencies (K,) [rad/s]: commanded acceleration per error of the
        measured angle.
        """
        numerator = np.concatenate((self._P, [0.0, 0.0]))
        return -self._response(numerator, frequency) * self.observer.scale**2

    def gain(self, frequency: Array, known: bool = False) -> ComplexArray:
        """L (K,), dimensionless, at frequencies (K,) [rad/s]."""
        s = 1j * np.asarray(frequency, dtype=float) / self.observer.scale
        top, bottom = self._broken(known)
        return np.polyval(top, s) / np.polyval(bottom, s)

    # -- stability -----------------------------------------------------------------------------------
    def crossovers(self, known: bool = False) -> Array:
        """All frequencies [rad/s] at which |L| = 1, in ascending order.

        The roots of |numerator|^2 - |denominator|^2 say where to look; a sign change of log |L| on
        a fine grid is then refined by Brent's method, because the roots themselves are badly
        conditioned.
        """
        top, bottom = self._broken(known)
        roots = np.roots(np.polysub(_squared(top), _squared(bottom)))
        near = np.sqrt(np.abs(roots[np.abs(roots) > 0.0])) * self.observer.scale
        grid = np.geomspace(0.1 * near.min(), 10.0 * near.max(), GRID)
        grid = np.unique(np.concatenate((grid, *(near * f for f in (0.999, 1.001)))))

        def excess(log_w: float) -> float:
            return float(np.log(np.abs(self.gain(np.exp(log_w), known))))

        level, logs = np.log(np.abs(self.gain(grid, known))), np.log(grid)
        turns = np.flatnonzero((level[:-1] > 0.0) != (level[1:] > 0.0))
        found = (brentq(excess, logs[i], logs[i + 1], xtol=1e-14) for i in turns)
        return np.exp(np.fromiter(found, dtype=float))

    def delay_margin(self, known: bool = False) -> DelayMargin:
        """The smallest delay [s] that destabilises the loop, and the frequency of the root on the axis.

        known: the observer is fed with a(t - d).
        """
        at = self.crossovers(known)
        if len(at) == 0:
            return DelayMargin(np.inf, np.inf)
        delays = np.mod(np.angle(-self.gain(at, known)), 2.0 * np.pi) / at
        first = int(np.argmin(delays))
        return DelayMargin(float(delays[first]), float(at[first]))


def observer_loop(observer: GPIObserver, gains: Gains = TABLE_II) -> ObserverLoop:
    """The loop of the first joint with its gains. Raises InputError for another observer."""
    if not isinstance(observer, GPIObserver):
        raise InputError(
            f"the linear loop of a {type(observer).__name__} was asked for, expected a GPIObserver in "
            "continuous time"
        )
    return ObserverLoop(observer, *first_gains(gains))


def bandwidth(response: Callable[[Array], ComplexArray], low: float, high: float) -> float:
    """The first frequency between low and high [rad/s] at which |response| is 3 dB below its value at low.

    `high` where it does not fall so far. `response` maps frequencies (K,) [rad/s] to values (K,).
    """
    grid = np.geomspace(low, high, GRID)
    level = np.abs(response(grid))
    below = np.flatnonzero(level < level[0] / np.sqrt(2.0))
    return float(grid[below[0]]) if len(below) else high


def _squared(p: Array) -> Array:
    """|p(i w)|^2 as a polynomial in w^2, highest power first: even and odd part, squared and added."""
    rising = p[::-1]
    even, odd = (
        half * (-1.0) ** np.arange(len(half)) if len(half) else np.zeros(1)
        for half in (rising[0::2], rising[1::2])
    )
    return np.polyadd(
        np.polymul(even[::-1], even[::-1]), np.append(np.polymul(odd[::-1], odd[::-1]), 0.0)
    )


def first_gains(gains: Gains) -> tuple[float, float]:
    """K_p [1/s^2] and K_d [1/s] of the first joint."""
    return float(np.ravel(gains.K_p)[0]), float(np.ravel(gains.K_d)[0])
