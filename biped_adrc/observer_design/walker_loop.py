"""The sampled loop of a walker at frozen phases of its gait: what its laws do, as matrices.

One period, for small changes of the state at a phase of the gait:

    z+ = Z z + Y (q, q'),     u = C z + E (q, q')                   the tick, d z+ / d(z, q, q')
    (q, q', u_m)+ = Phi (q, q', u_m) + Gamma_1 u_(k-j-1) + Gamma_2 u_(k-j)       robot and motors

z is all that the walker keeps from tick to tick: controller, observer, sensors with their filter, and the
torques that the controller knows of. The derivative of the tick is taken of the laws themselves
(`engine.tick_derivative`), so that the path of an encoder's error through Theta and Theta' is in it, and
no controller has a formula here. The delay (j + f) T is the clock's and a hidden one beside it, the same
in all motors; robot and lagging motors are exact for a torque that changes at f T.

Torque and rate limits are left out, and counts are an error that is independent from tick to tick.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.linalg import eig, expm
from scipy.optimize import brentq

from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.engine.tick_derivative import tick_derivative
from biped_adrc.errors import InputError
from biped_adrc.hardware.motors import whole_and_part
from biped_adrc.hardware.sample_hold import HeldSizes
from biped_adrc.observer_design.disk_margin import response
from biped_adrc.observer_design.frozen_gait import FrozenPoint
from biped_adrc.observer_design.observer_sampled import covariance
from biped_adrc.timing import SampledTime
from biped_adrc.types import Array, ComplexArray

TICKS_BEFORE = 2
"""Ticks before the one that is differentiated: after them every sensor has a difference of its angles."""
TINY = 1e-12
"""Eigenvalues below it are gone within a period."""
FREQUENCIES = 100
"""At which the sensitivity is taken, in geometric order, beside those at which the loop swings."""


class TickMatrices(NamedTuple):
    """The tick at one phase: k numbers in z, n coordinates, p motors."""

    Z: Array
    """(k, k)."""
    Y: Array
    """(k, 2 n)."""
    C: Array
    """(p, k)."""
    E: Array
    """(p, 2 n)."""


class LoopMatrices(NamedTuple):
    """X+ = M X + B w of one period, and u = C X + D w; w is (q, q') as an error of the sensors, then of u."""

    M: Array
    """(s, s)."""
    B: Array
    """(s, 2 n + p)."""
    C: Array
    """(p, s)."""
    D: Array
    """(p, 2 n + p): the last p columns are 1, for the torque behind the error."""


def linear_twin(walker: Walker) -> Walker:
    """The walker without what has no derivative: limits, counts, noise, meter, pushes.

    Raises InputError for one in continuous time, or that has to notice touchdowns.
    """
    if not isinstance(walker.timing, SampledTime):
        raise InputError(
            f"the sampled loop of a walker was asked for, found {walker.timing}; give "
            "timing=SampledTime(period)"
        )
    if walker.touchdown is not None:
        raise InputError(
            "the walker has to notice touchdowns, which is no linear part; expected touchdown=None"
        )
    return replace(
        walker,
        sensors=None if walker.sensors is None else walker.sensors.smooth(),
        torque_limit=None,
        motors=None,
        meter=None,
        disturbance=None,
    )


def tick_matrices(twin: Walker, points: Sequence[FrozenPoint]) -> list[TickMatrices]:
    """The tick of a `linear_twin` at points of the gait. Raises NotFiniteError as `tick_derivative`."""
    assert isinstance(twin.timing, SampledTime)
    assert twin.held is not None
    n, T, sizes, mode = twin.plant.n, twin.timing.period, twin.held.sizes, Mode()
    found, ticked = [], None
    for point in points:
        x, J = (
            twin.initial_state(point.q - TICKS_BEFORE * T * point.v, point.v, mode),
            np.zeros((0, 0)),
        )
        ticked = ticked or tick_derivative(twin, len(x))
        for before in range(TICKS_BEFORE, -1, -1):
            x[:n], x[n : 2 * n] = point.q - before * T * point.v, point.v
            x, J = ticked(point.t - before * T, x, mode)
        u, z = J[_newest(sizes, len(x))], _released(sizes, J)[2 * n :]
        found.append(
            _acting(TickMatrices(z[:, 2 * n :], z[:, : 2 * n], u[:, 2 * n :], u[:, : 2 * n]))
        )
    return found


def _acting(tick: TickMatrices) -> TickMatrices:
    """Without the numbers of z on which neither the torque nor the rest of z depends."""
    while True:
        k = np.any(tick.Z, axis=0) | np.any(tick.C, axis=0)
        if np.all(k):
            return tick
        tick = TickMatrices(tick.Z[np.ix_(k, k)], tick.Y[k], tick.C[:, k], tick.E)


def _newest(sizes: HeldSizes, end: int) -> slice:
    """Where in x, of `end` numbers, the torque stands that this tick has sent: at the end of the queue,
    else where it waits, else where it is asked of the motors.
    """
    if sizes.queue:
        end -= sizes.p * (1 + sizes.waiting)
    elif sizes.waiting:
        end -= sizes.p
    return slice(end - sizes.p, end)


def _released(sizes: HeldSizes, J: Array) -> Array:
    """J (nx, nx) once the torque that waits for a part of the period acts, as `semantics.release`."""
    if not sizes.waiting:
        return J
    p, J = sizes.p, J.copy()
    J[-p:] = J[-2 * p : -p]
    return J


def robot_step(A: Array, B: Array, T: float, f: float, lag: float) -> tuple[Array, Array, Array]:
    """Phi (s, s), Gamma_1 and Gamma_2 (s, p) of a period T [s] whose torque changes at f T.

    A (m, m), B (m, p): of (q, q'). lag [s]: time constant of the motors, 0 for none, else their torque is
    among the s states.
    """
    (m, p), rows = B.shape, B.shape[0] + (B.shape[1] if lag > 0.0 else 0)
    whole = np.zeros((rows + p, rows + p))
    whole[:m, :m], whole[:m, m : m + p] = A, B
    if lag > 0.0:
        whole[m:rows, m:rows], whole[m:rows, rows:] = -np.eye(p) / lag, np.eye(p) / lag
    after = expm(whole * ((1.0 - f) * T))
    if f == 0.0:
        return after[:rows, :rows], np.zeros((rows, p)), after[:rows, rows:]
    before, on = expm(whole * (f * T)), after[:rows, :rows]
    return on @ before[:rows, :rows], on @ before[:rows, rows:], after[:rows, rows:]


@dataclass(frozen=True)
class WalkerLoop:
    """The loop of one walker at one phase with one robot's inertias."""

    tick: TickMatrices
    A: Array
    """(2 n, 2 n) of the robot."""
    B: Array
    """(2 n, p)."""
    period: float
    """T [s]."""
    delay: float
    """From a sample instant to its torque [s]: the clock's."""
    lag: float
    """Time constant of the motors [s], 0 for none."""
    slow: float
    """|s| [1/s] up to which a mode belongs to the gait, not to the loop; see `specification`."""

    def matrices(self, hidden: float = 0.0) -> LoopMatrices:
        """One period with a hidden delay [s] in all motors."""
        j, f = whole_and_part(self.delay + hidden, self.period)
        Phi, G_1, G_2 = robot_step(self.A, self.B, self.period, f, self.lag)
        Z, Y, C_z, E = self.tick
        (k, m), (r, p) = Y.shape, G_2.shape
        waiting = j + int(f > 0.0)
        size, w = r + k + p * waiting, m + p
        # rows in (X, w): the error of the sensors, of the torque
        unit = np.eye(size + w)
        robot, z, line = unit[:r], unit[r : r + k], unit[r + k : size]
        seen = robot[:m] + unit[size : size + m]
        u = C_z @ z + E @ seen + unit[size + m :]
        sent = np.vstack((u, line))  # u_k, u_(k-1), ..
        moved = Phi @ robot + G_2 @ sent[p * j : p * (j + 1)]
        if f > 0.0:
            moved = moved + G_1 @ sent[p * (j + 1) : p * (j + 2)]
        rows = np.vstack((moved, Z @ z + Y @ seen, sent[: p * waiting]))
        return LoopMatrices(rows[:, :size], rows[:, size:], u[:, :size], u[:, size:])

    def growth(self, hidden: float = 0.0) -> float:
        """Of the fastest growing mode that is not the gait's own [1/s], below 0 for a stable loop.

        hidden [s]: a delay in all motors.
        """
        values = np.linalg.eigvals(self.matrices(hidden).M).astype(complex)
        rates = self._rates(values)
        return float(np.max(rates[np.abs(rates) > self.slow].real, initial=-np.inf))

    def _rates(self, values: ComplexArray) -> ComplexArray:
        """log(lambda) / T [1/s] of eigenvalues; very negative for those that are gone within a period."""
        kept = np.where(np.abs(values) > TINY, values, TINY)
        return np.asarray(np.log(kept) / self.period, dtype=complex)

    def delay_margin(self, most: float) -> float:
        """The smallest hidden delay [s] with which a mode grows, `most` [s] where none up to it does.

        0 for an unstable loop. Delays are tried from a quarter of a period on, each 1.25 times the one
        before; the first that is unstable is refined.
        """
        if not self.growth() < 0.0:
            return 0.0
        low = 0.0
        while low < most:
            high = min(most, max(0.25 * self.period, 1.25 * low))
            if not self.growth(high) < 0.0:
                return float(brentq(self.growth, low, high, xtol=1e-9, rtol=1e-6))
            low = high
        return most

    def sensitivity(self) -> ComplexArray:
        """S (F, p, p): torque of the controller and an error of it, per that error, at FREQUENCIES and
        at the loop's own, between `slow` and half the sampling frequency.
        """
        M, B, C, D = self.matrices()
        p, nyquist = len(C), np.pi / self.period
        own = np.abs(self._rates(np.linalg.eigvals(M).astype(complex)).imag)
        w = np.concatenate((np.geomspace(self.slow, nyquist, FREQUENCIES), own))
        w = np.unique(w[(w >= self.slow) & (w <= nyquist)])
        return response(M, B[:, -p:], C, D[:, -p:], w * self.period)

    def covariance_of_torque(self, errors: Array) -> Array:
        """Of the torques (p, p) [N^2 m^2] under independent errors of (q, q') at every tick, of standard
        deviations errors (2 n,) [rad, rad/s]; the gait's own modes are taken out. Of a stable loop only.
        """
        M, B, C, D = self.matrices()
        m = len(errors)
        values, left, right = eig(M, left=True)
        for i in np.flatnonzero(np.abs(self._rates(values)) <= self.slow):
            one = np.outer(right[:, i], left[:, i].conj()) / (left[:, i].conj() @ right[:, i])
            M, B = M - values[i] * one, B - one @ B
        shaken, direct = np.real(B)[:, :m] * errors, D[:, :m] * errors
        P = covariance(np.real(M), shaken @ shaken.T)
        return np.asarray(C @ P @ C.T + direct @ direct.T)
