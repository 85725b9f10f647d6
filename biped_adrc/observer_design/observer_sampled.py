"""The linear loop of one joint in sampled time: what is stable, and how an encoder disturbs the
torque.

With T the period, the torque held between sample instants and acting (j + f) T after its instant, 0
<= f < 1,

    e_(k+1)    = e_k + T e'_k + T^2 (g alpha + xi) / 2,     T e'_(k+1) = T e'_k + T^2 (g alpha + xi)

where alpha changes from a_(k-j-1) to a_(k-j) at t_k + f T, and

    Z <- Z + L (e + n - Z_1),  a = -F Z,  Z <- Phi Z + Gamma a       as `SampledGPIObserver`

X = (e, T e', Z, torques on their way) obeys X <- X + M X + B (xi, n). M is formed without its unit matrix: at
short periods all eigenvalues gather at 1, and what distinguishes them would be lost in round-off.
The observer is fed with a_k, or, when the delay is known, with the mean of what acts until the next
sample instant, which is exact for whole periods alone.

`observer_choice` asks it for stability and for the noise of the torque, `observer_report` for the
largest period and delay.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.errors import InputError
from biped_adrc.hardware.motors import whole_and_part
from biped_adrc.observer_design.observer_loop import first_gains
from biped_adrc.observers.gpi import GPIObserver, SampledGPIObserver
from biped_adrc.timing import SampledTime
from biped_adrc.types import Array

SHORTEST, LONGEST = 1e-6, 0.1
"""[s]: periods among which the largest stable one is looked for."""
RATIO = 1.05
"""Ratio of one period of that search to the one before."""
PARTS, MOST_PERIODS = 20, 50
"""Parts of a period by which the largest delay is looked for, and how many periods far."""
HIGHEST = 14
"""Largest m: with more, round-off moves poles of the discrete observer by more than the loop does."""


@dataclass(frozen=True)
class SampledLoop:
    """The loop of one joint in sampled time. Make it with `sampled_loop`.

    Raises InputError for what `SampledTime` refuses, and an m above HIGHEST.
    """

    observer: GPIObserver
    """The GPI observer in continuous time; its sampled form has the poles exp(s T)."""
    period: float
    """T [s]."""
    K_p: float = 5000.0
    """[1/s^2]."""
    K_d: float = 50.0
    """[1/s]."""
    delay: float = 0.0
    """From a sample instant to its torque [s]."""
    known: bool = False
    """Whether the observer is fed with what acts rather than with the command."""
    kappa_ratio: float = 1.0
    """g, the robot's kappa over the model's, dimensionless."""

    def __post_init__(self) -> None:
        SampledTime(self.period, delay=self.delay)
        if self.observer.m > HIGHEST:
            raise InputError(
                f"the sampled loop of an observer with m = {self.observer.m} was asked for, expected m <= "
                f"{HIGHEST}: above it round-off decides what is stable"
            )

    # -- the step ------------------------------------------------------------------------------------
    @cached_property
    def _system(self) -> tuple[Array, Array, Array, Array]:
        """M (s, s) and B (s, 2) of one step, and the rows of T^2 a in X (s,) and in (T^2 xi, n) (2,).

        Every quantity is a row in (X, T^2 xi, n): the step is composed from rows as the equations
        read.
        """
        k, T = self.observer.order, self.period
        queue, f = whole_and_part(self.delay, T)
        waits = int(f > 0.0)
        size = 2 + k + queue + waits
        unit = np.hstack((np.eye(size), np.zeros((size, 2))))  # the rows of X in (X, T^2 xi, n)
        y, rate, Z, line = unit[0].copy(), unit[1], unit[2 : 2 + k], unit[2 + k :]
        y[-1] = 1.0
        xi = np.zeros(size + 2)
        xi[-2] = 1.0

        dZ, a = self._tick(Z, y)
        sent = [*line[: queue + waits], a] if waits else [*line[:queue], a]
        # torques in the order in which they act: with f > 0 the first acts until t_k + f T
        before, after = (sent[0], sent[1]) if waits else (sent[0], sent[0])
        moved = sent[1:]
        g = self.kappa_ratio
        push = g * (before * (f - 0.5 * f**2) + after * 0.5 * (1.0 - f) ** 2) + 0.5 * xi
        kick = g * (before * f + after * (1.0 - f)) + xi
        fed = f * before + (1.0 - f) * after if self.known else a
        dZ = dZ + self._sampled.Gamma[:, np.newaxis] / T**2 * fed
        rest = np.array(moved).reshape(-1, size + 2) - line
        increments = np.vstack((rate + push, kick, dZ, rest))
        return increments[:, :size], increments[:, size:], a[:size], a[size:]

    def _tick(self, Z: Array, y: Array) -> tuple[Array, Array]:
        """The change of Z in one period without its input, and T^2 a, as rows; y is the measured
        angle's row.
        """
        k = self._sampled
        corrected = np.outer(k.L, y - Z[0])
        Z_k = Z + corrected
        return corrected + (k.Phi - np.eye(k.order)) @ Z_k, self._feedback @ Z_k

    @cached_property
    def _sampled(self) -> SampledGPIObserver:
        """The observer that walks."""
        return SampledGPIObserver.from_poles(self.observer.poles, self.period)

    @cached_property
    def _feedback(self) -> Array:
        """The row -F T^2 (m + 2,) of T^2 a in the observer's scaled states."""
        T = self.period
        w = 1.0 / T
        row = np.zeros(self.observer.order)
        row[0], row[1] = self.K_p, self.K_d * w
        if self.observer.m > 0:
            row[2] = w**2
        return -(T**2) * row

    # -- what it says --------------------------------------------------------------------------------
    @property
    def matrix(self) -> Array:
        """The matrix (s, s) of X_(k+1) = matrix X_k, dimensionless."""
        M = self._system[0]
        return M + np.eye(len(M))

    @cached_property
    def spectral_radius(self) -> float:
        """Largest |eigenvalue| of one period, 1 + one of M; below 1 for a stable loop."""
        return float(np.max(np.abs(1.0 + np.linalg.eigvals(self._system[0]))))

    @property
    def stable(self) -> bool:
        """Whether the spectral radius is below 1."""
        return self.spectral_radius < 1.0

    def rms(self, sigma: float) -> float:
        """Standard deviation of a [rad/s^2] under independent errors sigma [rad] of the measured angles.

        Exact, by the discrete Lyapunov equation; NaN for an unstable loop, which has none.
        """
        if not self.stable:
            return np.nan
        _, B, C, D = self._system
        P = covariance(self.matrix, np.outer(B[:, 1], B[:, 1]))
        return float(np.sqrt(C @ P @ C + D[1] ** 2)) * sigma / self.period**2


def covariance(A: Array, Q: Array) -> Array:
    """P (s, s) of P = A P A' + Q for a stable A (s, s), as the sum of A^i Q A'^i, doubling its terms.

    For a matrix Q that is positive semidefinite all terms add up, so nothing is lost where the
    equation itself is badly conditioned. P has the units of Q, such as [rad^2] for angles.
    """
    P = Q
    while True:
        more = A @ P @ A.T
        P, A = P + more, A @ A
        if not np.max(np.abs(more)) > 1e-16 * np.max(np.abs(P)):
            return P


def sampled_loop(
    observer: GPIObserver,
    period: float,
    gains: Gains = TABLE_II,
    *,
    delay: float = 0.0,
    known: bool = False,
    kappa_ratio: float = 1.0,
) -> SampledLoop:
    """The loop of one joint with its gains, at a period [s] and a delay [s]. Raises InputError as
    `SampledLoop`.
    """
    return SampledLoop(observer, period, *first_gains(gains), delay, known, kappa_ratio)


def largest_period(loop: SampledLoop, delay_periods: float = 0.0) -> float:
    """The largest T [s] below which the loop is stable at every period, with a delay of that many periods.

    NaN when SHORTEST is unstable already, infinite when all up to LONGEST are stable.
    """

    def stable(T: float) -> bool:
        return replace(loop, period=T, delay=delay_periods * T).stable

    low = SHORTEST
    if not stable(low):
        return np.nan
    while stable(low * RATIO):
        low *= RATIO
        if low > LONGEST:
            return float(np.inf)
    return last_true(stable, low, low * RATIO)


def largest_delay(loop: SampledLoop) -> float:
    """The largest delay [s] below which the loop is stable with every delay.

    NaN when the loop is unstable without one, infinite when all up to MOST_PERIODS are stable.
    """

    def stable(d: float) -> bool:
        return replace(loop, delay=d).stable

    if not stable(0.0):
        return np.nan
    step = loop.period / PARTS
    for i in range(1, MOST_PERIODS * PARTS + 1):
        if not stable(i * step):
            return last_true(stable, (i - 1) * step, i * step)
    return float(np.inf)


def last_true(holds: Callable[[float], bool], low: float, high: float) -> float:
    """The end of the range where `holds` is true, by bisection to 1e-6 of high.

    It holds at low and does not hold at high.
    """
    while high - low > 1e-6 * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low
