"""The linear loop of one joint under ADRC whose torque acts after a delay: loop gain and delay margin.

Numbers such as (19) are equations of the paper.

    q_b, q_d       the joint's angle and its reference [rad], e = q_b - q_d
    kappa u        acceleration that the torque u gives to the joint; a = kappa u - q_d'' is the commanded one
    xi             total disturbance [rad/s^2], q_b'' = kappa u + xi
    x1^, x2^, xi^  estimates of e, e' and xi
    d              delay from the command to its effect [s]
    m, l_k         number of the observer's states for xi and its derivatives, and the observer's gains
    chi(s)         the observer's polynomial (19), s^(m+2) + l_(m+1) s^(m+1) + ... + l_0
    K_p, K_d       gains of the feedback (20)

The robot and the feedback are

    e'' = a(t - d) + xi,    a = -K_p x1^ - K_d x2^ - xi^

Opened at the delay, the loop has the gain L(s), and roots i w on the imaginary axis where exp(i w d) = -L(i w):

    unknown  L = P / (s^(m+2) Q)           the observer is fed with a(t)
    known    L = (K_d s + K_p) / s^2       it is fed with a(t - d)

    Q = s^2 + (l_(m+1) + K_d) s + l_m + K_p + K_d l_(m+1)
    P = the terms of (s^2 + K_d s + K_p) chi below s^(m+2)

since s^(m+2) Q + P = (s^2 + K_d s + K_p) chi, which for d = 0 is the characteristic polynomial. All
coefficients of P and Q are sums of products of positive ones, so nothing cancels. In the code s is counted in
units of the observer's `scale`, the geometric mean of the poles, there called w too. Without delay

    e / xi = s^m Q / ((s^2 + K_d s + K_p) chi)                    (23), corrected
    xi^ / xi = (chi - s^(m+2) - l_(m+1) s^(m+1) - l_m s^m) / chi
    a / n = -s^2 P / ((s^2 + K_d s + K_p) chi)                    n: error of the measured q_b

(22) and (23) print l_(m+1) in Q without its factor K_d. `SampledLoop` is the same loop in sampled time.

In sampled time, with T the period, the torque held between sample instants and acting (j + f) T
after its instant, 0 <= f < 1,

    e_(k+1)    = e_k + T e'_k + T^2 (g alpha + xi) / 2,     T e'_(k+1) = T e'_k + T^2 (g alpha + xi)

where alpha changes from a_(k-j-1) to a_(k-j) at t_k + f T, and

    Z <- Z + L (e + n - Z_1),  a = -F Z,  Z <- Phi Z + Gamma a       as `SampledChain`

Here Z are the observer's scaled states, L, Phi and Gamma its correction gains, transition matrix and input
vector, F the feedback's gains, g the robot's kappa over the model's, and n the error of the measured angle. X =
(e, T e', Z, torques on their way) obeys X <- X + M X + B (xi, n). M is formed without its unit matrix: at short
periods all eigenvalues gather at 1, and what distinguishes them would be lost in round-off. With an unknown
delay the observer is fed with a_k; with a known one, as the controllers are, with the mean of the torque that
acts until the next sample instant. For f > 0 the mean has the right effect on the velocity and an error f (1 -
f) T^2 / 2 per change of the torque in the angle. For fast observers that error can be worse than an unknown
delay.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.core.errors import InputError
from biped_adrc.core.timing import SampledTime
from biped_adrc.core.types import Array, ComplexArray
from biped_adrc.hardware.motors import whole_and_part
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
        (K_p, K_d), rates = self.gains.first, np.abs(self.observer.poles)
        slow, fast = min(rates.min(), np.sqrt(K_p)), max(rates.max(), K_d)
        return np.geomspace(0.01 * slow, 100.0 * fast, GRID)

    # -- polynomials in s / w, highest power first --------------------------------------------------
    @cached_property
    def _chi(self) -> Array:
        """Coefficients (m + 3,) of the observer's polynomial chi, highest power first, dimensionless."""
        return np.concatenate(([1.0], self.observer.scaled_gains))

    @cached_property
    def _feedback(self) -> Array:
        """Coefficients (3,) of the feedback's polynomial s^2 + K_d s + K_p, dimensionless."""
        (K_p, K_d), w = self.gains.first, self.observer.scale
        return np.array([1.0, K_d / w, K_p / w**2])

    def _Q(self, printed: bool = False) -> Array:
        """Coefficients (3,) of the polynomial Q of the loop gain, highest power first, dimensionless.

        printed: without the factor K_d of l_(m+1), as the paper prints it; else corrected. s is counted in
        units of w, the observer's scale.
        """
        # k_d = K_d / w, k_p = K_p / w^2, l_1 = l_(m+1) / w, l_2 = l_m / w^2
        (_, k_d, k_p), (l_1, l_2) = self._feedback, self._chi[1:3]
        # the printed factor 1 of l_(m+1) [1/s] is 1 / w in units of w
        factor = 1.0 / self.observer.scale if printed else k_d
        return np.array([1.0, l_1 + k_d, l_2 + k_p + factor * l_1])

    @cached_property
    def _P(self) -> Array:
        """Coefficients (m + 2,) of the polynomial P of the loop gain, highest power first, dimensionless: those
        of the product of chi and the feedback below s^(m+2).
        """
        # the product begins with the powers m + 4, m + 3 and m + 2, which Q has
        return np.asarray(np.polymul(self._feedback, self._chi)[3:], dtype=float)

    # -- frequency responses -------------------------------------------------------------------------
    def _response(self, numerator: Array, frequency: Array, feedback: bool = True) -> ComplexArray:
        """numerator / (chi (s^2 + K_d s + K_p)), or numerator / chi without `feedback`, (K,), at s = i
        frequency.

        numerator: coefficients of a polynomial in s / w, highest power first. frequency (K,) [rad/s]. chi is
        evaluated as a product over the poles, which loses no digits.
        """
        s = 1j * np.asarray(frequency, dtype=float) / self.observer.scale
        value: ComplexArray = np.asarray(np.polyval(numerator, s), dtype=complex)
        for pole in self.observer.poles:
            value = value / (s - pole / self.observer.scale)
        return value / np.polyval(self._feedback, s) if feedback else value

    def tracking_error(self, frequency: Array, printed: bool = False) -> ComplexArray:
        """e / xi (K,) [s^2] at frequencies (K,) [rad/s] by (23), corrected, or `printed` as in the paper."""
        # zeros behind the coefficients multiply by s^m; 1 / scale^2 goes back from s / w to s
        numerator = np.concatenate((self._Q(printed), np.zeros(self.observer.m)))
        return self._response(numerator, frequency) / self.observer.scale**2

    def estimate(self, frequency: Array) -> ComplexArray:
        """xi^ / xi (K,), dimensionless, at frequencies (K,) [rad/s]; zero for m = 0, which has no xi^."""
        # chi without its three highest powers, of which nothing is left for m = 0
        return self._response(self._chi[3:], frequency, feedback=False)

    def noise(self, frequency: Array) -> ComplexArray:
        """a / n (K,) [1/s^2] at frequencies (K,) [rad/s]: commanded acceleration per error of the angle."""
        # two zeros behind the coefficients multiply by s^2; scale^2 goes back from s / w to s
        numerator = np.concatenate((self._P, [0.0, 0.0]))
        return -self._response(numerator, frequency) * self.observer.scale**2

    def gain(self, frequency: Array, known: bool = False) -> ComplexArray:
        """Loop gain L (K,), dimensionless, at frequencies (K,) [rad/s]; known: whether the
        observer is fed with a(t - d).
        """
        s = 1j * np.asarray(frequency, dtype=float) / self.observer.scale
        if known:
            return np.polyval(self._feedback[1:], s) / s**2
        # the observer's order is m + 2: Q s^(m+2)
        bottom = np.concatenate((self._Q(), np.zeros(self.observer.order)))
        return np.polyval(self._P, s) / np.polyval(bottom, s)

    # -- stability -----------------------------------------------------------------------------------
    def delay_margin(self, known: bool = False) -> DelayMargin:
        """The smallest delay [s] that destabilises the loop, and the frequency of the root on the axis.

        known: the observer is fed with a(t - d). A root exp(i w d) = -L(i w) needs |L| = 1, so w is searched
        where |L| crosses 1; d [s] is then the angle of -L, from 0 to 2 pi, over w.
        """

        def level(log_w: Array) -> Array:
            return np.log(np.abs(self.gain(np.exp(log_w), known)))

        grid = np.log(self.frequencies)
        turns = np.flatnonzero(np.diff(level(grid) > 0.0))
        if len(turns) == 0:
            return DelayMargin(np.inf, np.inf)
        # turns: intervals of the grid in which |L| crosses 1; at: the frequencies [rad/s] of these crossings
        at = np.exp([brentq(level, grid[i], grid[i + 1], xtol=1e-14) for i in turns])
        delays = np.mod(np.angle(-self.gain(at, known)), 2.0 * np.pi) / at
        first = int(np.argmin(delays))
        return DelayMargin(float(delays[first]), float(at[first]))


SHORTEST, LONGEST = 1e-6, 0.1
"""Range of the periods that are tried for the largest stable one [s]."""
RATIO = 1.05
"""Ratio of one period of that search to the one before."""
PARTS, MOST_PERIODS = 20, 50
"""Delays that are tried per period in the search for the largest one, and the longest of them in periods."""
_HIGHEST = 14
"""Largest m: above it round-off moves the poles of the discrete observer by more than the loop does."""


class StepMatrices(NamedTuple):
    """Matrices of one period for a state X (s,) with an input w (w,), and an output C X + D w.

    M X + B w is the change of X over the period in a `SampledLoop`, and X+ itself in `loops.walker_loop`.
    """

    M: Array
    """(.., s, s)."""
    B: Array
    """(.., s, w)."""
    C: Array
    """(s,), or (.., p, s)."""
    D: Array
    """(w,), or (.., p, w)."""


@dataclass(frozen=True)
class SampledLoop:
    """The loop of the first joint under ADRC in sampled time.

    Raises InputError for a period or delay that `SampledTime` refuses, and an m above 14 (_HIGHEST).
    """

    observer: GPIObserver
    """The GPI observer in continuous time; its sampled form has the poles exp(s T)."""
    period: float
    """T [s]."""
    gains: Gains = TABLE_II
    delay: float = 0.0
    """Delay from a sample instant to its torque [s]."""
    known: bool = False
    """Whether the observer is fed with the torque that acts, or with the command."""
    kappa_ratio: float = 1.0
    """g, the robot's kappa over the model's, dimensionless."""

    def __post_init__(self) -> None:
        SampledTime(self.period, delay=self.delay)
        if self.observer.m > _HIGHEST:
            raise InputError(
                f"the sampled loop of an observer with m = {self.observer.m} was asked for, expected m <= "
                f"{_HIGHEST}: above it round-off decides what is stable"
            )

    @cached_property
    def step(self) -> StepMatrices:
        """X <- X + M X + B w and T^2 a = C X + D w over one period, with w = (T^2 xi, n).

        a in X is scaled by T^2 too. Each variable is a row of coefficients of (X, T^2 xi, n), so the lines
        below read as the equations do.
        """
        k, T, g = self.observer.order, self.period, self.kappa_ratio
        # queue is j; late: 1 if a part f of a period remains, so that one more torque is on its way
        queue, f = whole_and_part(self.delay, T)
        late = int(f > 0.0)
        size = 2 + k + queue + late
        rows = np.eye(size + 2)
        e, rate, xi, n = rows[[0, 1, size, size + 1]]
        # line: the torques on their way, the oldest first
        Z, line = rows[2 : 2 + k], rows[2 + k : size]
        o = self.observer.sampled(T)  # its sampled form, with L, Phi and Gamma
        correction = np.outer(o.L, e + n - Z[0])
        Z_k = Z + correction
        K_p, K_d = self.gains.first
        F = np.zeros(k)
        # F = T^2 (K_p, K_d / T, 1 / T^2), for Z = (x1^, T x2^, T^2 xi^, ..); without xi^ for m = 0, where k = 2
        F[:3] = (T**2 * np.array([K_p, K_d / T, T**-2]))[:k]
        a = -F @ Z_k
        sent = np.vstack((line, a))  # in the order in which they act; the first until t_k + f T
        before, after = sent[0], sent[late]
        # what the two torques of the period and xi add to e and to T e', beside T e' itself
        push = g * (before * (f - 0.5 * f**2) + after * 0.5 * (1.0 - f) ** 2) + 0.5 * xi
        kick = g * (before * f + after * (1.0 - f)) + xi
        u = f * before + (1.0 - f) * after if self.known else a
        dZ = correction + (o.Phi - np.eye(k)) @ Z_k + np.outer(o.Gamma / T**2, u)
        # sent[1:] - line: the torques on their way move up by one place
        changes = np.vstack((rate + push, kick, dZ, sent[1:] - line))
        return StepMatrices(changes[:, :size], changes[:, size:], a[:size], a[size:])

    @cached_property
    def spectral_radius(self) -> float:
        """Largest |eigenvalue| over one period; below 1 for a stable loop."""
        return float(np.max(np.abs(1.0 + np.linalg.eigvals(self.step.M))))

    @property
    def stable(self) -> bool:
        """Whether the spectral radius of the loop over one period is below 1."""
        return self.spectral_radius < 1.0

    def rms(self, sigma: float) -> float:
        """Standard deviation of the commanded acceleration a [rad/s^2] under errors n of the measured angle,
        which are independent from tick to tick, with the standard deviation sigma [rad].

        Exact, by the discrete Lyapunov equation; NaN for an unstable loop, which has none.
        """
        if not self.stable:
            return np.nan
        # column 1 of the inputs (T^2 xi, n) is n; the output is T^2 a
        M, B, C, D = self.step
        P = covariance(M + np.eye(len(M)), np.outer(B[:, 1], B[:, 1]))
        return float(np.sqrt(C @ P @ C + D[1] ** 2)) * sigma / self.period**2


def covariance(A: Array, Q: Array) -> Array:
    """Solve P = A P A' + Q for P (s, s), with a stable A (s, s), as the sum of A^i Q A'^i, i = 0, 1, ..

    Each pass of the loop doubles the number of its terms, until they no longer change it.

    For a matrix Q that is positive semidefinite all terms add up, so nothing is lost where the equation itself
    is badly conditioned. P has the units of Q, such as [rad^2] for angles.
    """
    P = Q
    while True:
        more = A @ P @ A.T
        P, A = P + more, A @ A
        if not np.max(np.abs(more)) > 1e-16 * np.max(np.abs(P)):
            return P


def largest_period(loop: SampledLoop, delay_periods: float = 0.0) -> float:
    """The largest T [s] below which the loop is stable at every period, with a delay of `delay_periods` T.

    loop: its own period and delay do not count. NaN when SHORTEST is unstable already, infinite when all up to
    LONGEST are stable.
    """
    # from SHORTEST to LONGEST, each RATIO times the one before
    count = math.ceil(math.log(LONGEST / SHORTEST) / math.log(RATIO))
    periods = SHORTEST * RATIO ** np.arange(count + 1)
    return last_true(lambda T: replace(loop, period=T, delay=delay_periods * T).stable, periods)


def largest_delay(loop: SampledLoop) -> float:
    """The largest delay [s] below which the loop is stable with every delay.

    loop: its own delay does not count. NaN when the loop is unstable without one, infinite when all up to
    MOST_PERIODS are stable.
    """
    # PARTS delays per period, up to MOST_PERIODS periods
    delays = loop.period / PARTS * np.arange(MOST_PERIODS * PARTS + 1)
    return last_true(lambda delay: replace(loop, delay=delay).stable, delays)


def last_true(holds: Callable[[float], bool], tried: Iterable[float]) -> float:
    """The number up to which `holds` is true, by bisection to 1e-6 of it.

    tried: increasing numbers; bisection goes on between the first at which it does not hold and the one before.
    Where it does not hold at the first, `low` stays NaN and the bisection ends at once. NaN when it does not
    hold at the first, infinite when it holds at all of them.
    """
    low = math.nan
    for x in tried:
        if holds(high := float(x)):
            low = high
            continue
        while high - low > 1e-6 * high:
            middle = 0.5 * (low + high)
            low, high = (middle, high) if holds(middle) else (low, middle)
        return low
    return math.inf
