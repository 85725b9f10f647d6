"""The linear loop of one joint under ADRC whose torque acts after a delay: loop gain and delay margin.

With chi(s) the observer's polynomial (19), a = kappa u - q_d'' and e = q_b - q_d, the robot and
(20) are

    e'' = g a(t - d) + xi,    a = -K_p x1^ - K_d x2^ - xi^

g is kappa of the robot over that of the model, 1 where the model is right. Opened at the delay, the
loop has the gain L(s), and roots on the imaginary axis where exp(i w d) = -L(i w):

    unknown  L = g P / (s^(m+2) Q)         the observer is fed with a(t)
    known    L = g (K_d s + K_p) / s^2 + (g - 1) (chi - s^m Q) / chi       it is fed with a(t - d)

    Q = s^2 + (l_(m+1) + K_d) s + l_m + K_p + K_d l_(m+1)
    P = the terms of (s^2 + K_d s + K_p) chi below s^(m+2)

since s^(m+2) Q + P = (s^2 + K_d s + K_p) chi, which for g = 1 and d = 0 is the characteristic
polynomial. All coefficients of P and Q are sums of products of positive ones, so nothing cancels,
and s is counted in units of w, the geometric mean of the poles, which keeps the numbers near 1.
Without delay and with g = 1

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
from biped_adrc.errors import InputError, check_positive
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.types import Array, ComplexArray

GRID = 2000
"""Number of frequencies between which crossovers are searched, besides the roots of their polynomial."""


class DelayMargin(NamedTuple):
    """The smallest delay with a root on the imaginary axis, and that root."""

    delay: float
    """[s], infinite when there is none, NaN for a loop that is unstable without a delay."""
    frequency: float
    """[rad/s], as the delay infinite or NaN."""


class Conditioning(NamedTuple):
    """Condition number of the observer matrix (19) in the 2-norm."""

    physical: float
    """In the states of (17), whose units differ."""
    scaled: float
    """In the scaled states that the observer integrates."""


@dataclass(frozen=True)
class ObserverLoop:
    """The loop of one joint in continuous time. Make it with `observer_loop`."""

    observer: GPIObserver
    K_p: float
    """[1/s^2]."""
    K_d: float
    """[1/s]."""
    kappa_ratio: float = 1.0
    """g, kappa of the robot over that of the model, dimensionless."""

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
        g, order = self.kappa_ratio, self.observer.order
        if not known:
            return g * self._P, np.concatenate((self._Q, np.zeros(order)))
        (_, k_d, k_p), l_1 = self._feedback, self._chi[1]
        unseen = np.concatenate(([-k_d, -(k_p + k_d * l_1)], self._chi[3:], [0.0, 0.0]))
        tracked = g * np.polymul([k_d, k_p], self._chi)
        top = np.asarray(np.polyadd(tracked, (g - 1.0) * unseen), dtype=float)
        return top, np.concatenate((self._chi, [0.0, 0.0]))

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
        if self.kappa_ratio != 1.0:  # where it is 1 all roots of 1 + L have negative real parts
            roots = np.roots(np.polyadd(*self._broken(known)))
            if not np.max(roots.real) < 0.0:
                return DelayMargin(np.nan, np.nan)
        at = self.crossovers(known)
        if len(at) == 0:
            return DelayMargin(np.inf, np.inf)
        delays = np.mod(np.angle(-self.gain(at, known)), 2.0 * np.pi) / at
        first = int(np.argmin(delays))
        return DelayMargin(float(delays[first]), float(at[first]))


def observer_loop(
    observer: GPIObserver, gains: Gains = TABLE_II, joint: int = 0, kappa_ratio: float = 1.0
) -> ObserverLoop:
    """The loop of one joint with its gains; kappa_ratio is g, dimensionless.

    Raises InputError for another observer, a joint without gains, or a kappa_ratio that is not
    positive.
    """
    if not isinstance(observer, GPIObserver):
        raise InputError(
            f"the linear loop of a {type(observer).__name__} was asked for, expected a GPIObserver in "
            "continuous time"
        )
    check_positive(kappa_ratio, f"kappa_ratio is {kappa_ratio}")
    return ObserverLoop(observer, *joint_gains(gains, joint), float(kappa_ratio))


def conditioning(observer: GPIObserver) -> Conditioning:
    """Condition number of the matrix of (19) in its own and in scaled states, by the inverse in closed form.

    With ones above the diagonal and -l in the first column, A e = f has the solution e_1 = -f_k /
    l_k, e_(i+1) = f_i + l_i e_1. The smallest singular value of a matrix with entries up to 1e29 is
    lost in round-off, its inverse is not.
    """

    def condition(l: Array, w: float) -> float:  # noqa: E741
        k = len(l)
        A = w * np.eye(k, k=1)
        A[:, 0] -= l
        inverse = np.eye(k, k=-1) / w
        inverse[:, -1] -= np.concatenate(([1.0], l[:-1] / w)) / l[-1]
        return float(np.linalg.norm(A, 2) * np.linalg.norm(inverse, 2))

    w = observer.scale
    return Conditioning(condition(observer.gains, 1.0), condition(w * observer.scaled_gains, w))


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


def joint_gains(gains: Gains, joint: int) -> tuple[float, float]:
    """K_p [1/s^2] and K_d [1/s] of one joint. Raises InputError for a joint that has none."""
    K_p, K_d = (_of_joint(np.atleast_1d(gain), joint) for gain in (gains.K_p, gains.K_d))
    return K_p, K_d


def _of_joint(values: Array, joint: int) -> float:
    """The joint's number, or the one number for all joints. Raises InputError for a joint that has none."""
    if len(values) == 1:
        return float(values[0])
    if not 0 <= joint < len(values):
        raise InputError(
            f"joint {joint} was asked for, found gains of joints 0 to {len(values) - 1}"
        )
    return float(values[joint])
