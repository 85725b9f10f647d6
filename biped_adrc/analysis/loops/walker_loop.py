"""The sampled loops of a walker at frozen phases of its gait, with robots of several inertias, as matrices.

One period, for small changes of the state at a phase of the gait:

    z+ = Z z + Y (q, q'),     u = C z + E (q, q')                   the tick, `frozen_gait`
    (q, q', u_m)+ = Phi (q, q', u_m) + Gamma_1 u_(k-j-1) + Gamma_2 u_(k-j)       robot and motors

    q, u           the n coordinates [rad] and the torques (p,) [N m] of the motors
    z              what controller, observer and sensors keep from tick to tick; a tick is a sample instant
    u_k, u_m       torque that is computed at tick k, and the one that lagging motors produce
    (j + f) T      delay, j whole periods T [s] and a part 0 <= f < 1 of one: the clock's plus an unknown delay,
                   which is the same in all motors

Phi and Gamma are exact for robot and lagging motors under a torque that changes at f T. A mode is exp(s t) with
lambda = exp(s T) an eigenvalue over one period; modes with |s| <= `slow` are the gait's own, for a robot falls
over its foot, and do not count. All loops of a walker are computed together.
"""

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any, Self

import numpy as np
from scipy.linalg import eig, expm

from biped_adrc.analysis.loops.frozen_gait import TickMatrices
from biped_adrc.analysis.observer.loop import StepMatrices, covariance
from biped_adrc.core.types import Array, ComplexArray
from biped_adrc.hardware.motors import whole_and_part

TINY = 1e-12
"""Eigenvalues below this magnitude count as zero: their modes vanish within a period."""
FREQUENCIES = 100
"""Number of frequencies of the sensitivity, in geometric order, beside those of the loop's modes."""


def robot_step(A: Array, B: Array, T: float, f: float, lag: float) -> tuple[Array, Array, Array]:
    """Phi (.., s, s), Gamma_1 and Gamma_2 (.., s, p) of robot and motors over a period T [s] whose torque
    changes at f T, f a share of the period: Gamma_1 belongs to the torque before, Gamma_2 to the one after.

    A (.., m, m), B (.., m, p): of (q, q')' = A (q, q') + B u. lag [s]: time constant of the motors, 0 for none;
    else their p torques are the last of the s states.
    """
    *axes, m, p = B.shape
    rows = m + (p if lag > 0.0 else 0)
    whole = np.zeros((*axes, rows + p, rows + p))
    whole[..., :m, :m], whole[..., :m, m : m + p] = A, B
    if lag > 0.0:
        whole[..., m:rows, m:rows], whole[..., m:rows, rows:] = -np.eye(p) / lag, np.eye(p) / lag
    # the exponential of [[A, B], [0, 0]] has Phi and Gamma in its upper rows, for a constant torque
    after = expm(whole * ((1.0 - f) * T))
    on = after[..., :rows, :rows]  # Phi of the time after f T
    if f == 0.0:
        return on, np.zeros((*axes, rows, p)), after[..., :rows, rows:]
    before = expm(whole * (f * T))
    return on @ before[..., :rows, :rows], on @ before[..., :rows, rows:], after[..., :rows, rows:]


@dataclass(frozen=True)
class WalkerLoops:
    """The loops of one walker: at each phase with each robot's inertias, as leading axes of all arrays.

    `loops[i, j]` is the one at phase i with robot j, `loops[:, :1]` those with the first robot; of a single
    loop the leading axes are gone.
    """

    tick: TickMatrices
    """(phases, 1, ..): the same for all robots."""
    A: Array
    """(phases, robots, 2 n, 2 n)."""
    B: Array
    """(phases, robots, 2 n, p)."""
    period: float
    """T [s]."""
    delay: float
    """Delay from a sample instant to its torque [s], of the clock."""
    lag: float
    """Time constant of the motors [s], 0 for none."""
    slow: float
    """|s| [1/s] up to which a mode belongs to the gait and not to the loop; see `specification`."""

    def __getitem__(self, at: Any) -> Self:
        """Select loops by indices or slices along (phases, robots)."""
        return self._each(lambda x: x[at])

    def _each(self, f: Callable[[Array], Array]) -> Self:
        """The loops whose matrices are f of these."""
        axes = self.B.shape[:-2]
        # the tick has one entry along the axis of robots, which is repeated for each
        tick = (f(np.broadcast_to(x, (*axes, *x.shape[-2:]))) for x in self.tick)
        return replace(self, tick=TickMatrices(*tick), A=f(self.A), B=f(self.B))

    def matrices(self, unknown: float = 0.0) -> StepMatrices:
        """Matrices of one period, X+ = M X + B w and u = C X + D w, with an unknown delay [s] in all motors.

        X is (q, q'), u_m of lagging motors, z, and the torques u_(k-1), u_(k-2), .. that still wait. w (2 n +
        p,) is an error of the sensors in (q, q'), then an error that is added to u, so D ends with a unit
        matrix.
        """
        # k, m, r, p: sizes of z, (q, q'), (q, q', u_m) and u; waiting: how many torques wait for their turn
        j, f = whole_and_part(self.delay + unknown, self.period)
        Phi, G_1, G_2 = robot_step(self.A, self.B, self.period, f, self.lag)
        Z, Y, C_z, E = self.tick
        k, m, r, p = Z.shape[-1], Y.shape[-1], Phi.shape[-1], G_2.shape[-1]
        waiting = j + int(f > 0.0)
        line = r + k  # where the torques u_(k-1), u_(k-2), .. stand in X
        size = line + p * waiting
        C, D = (np.zeros((*G_2.shape[:-2], p, x)) for x in (size, m + p))
        C[..., :m], C[..., r:line], D[..., :m], D[..., m:] = E, C_z, E, np.eye(p)
        M, B = (np.zeros((*G_2.shape[:-2], size, x)) for x in (size, m + p))
        M[..., :r, :r] = Phi
        # i: age in periods of the torque that acts through G; i = 0 is the one of this tick, C X + D w
        for i, G in ((j, G_2), (j + 1, G_1)) if f > 0.0 else ((j, G_2),):
            if i == 0:
                M[..., :r, :] += G @ C
                B[..., :r, :] += G @ D
            else:
                M[..., :r, line + p * (i - 1) : line + p * i] += G
        M[..., r:line, :m], M[..., r:line, r:line], B[..., r:line, :m] = Y, Z, Y
        # the torques move up by one place, and u of this tick becomes the first
        if waiting:
            M[..., line : line + p, :], B[..., line : line + p, :] = C, D
            M[..., line + p :, line : size - p] = np.eye(size - p - line)
        return StepMatrices(M, B, C, D)

    @cached_property
    def rates(self) -> ComplexArray:
        """s = log(lambda) / T [1/s] of all modes, without an unknown delay; see `modes`."""
        return self.modes(0.0)  # 0 s of unknown delay

    def modes(self, unknown: float) -> ComplexArray:
        """s = log(lambda) / T [1/s] of all modes, as many as entries of X, with an unknown delay [s] in all
        motors.

        Real parts are very negative for modes that vanish within a period.
        """
        values = np.linalg.eigvals(self.matrices(unknown).M).astype(complex)
        return np.asarray(self._rates(values))

    def _rates(self, values: ComplexArray) -> ComplexArray:
        """s = log(lambda) / T [1/s] of eigenvalues lambda; TINY in place of smaller ones, whose log is -inf."""
        return np.asarray(np.log(np.where(np.abs(values) > TINY, values, TINY)) / self.period)

    def growth(self, unknown: float = 0.0) -> Array:
        """Growth rate of the fastest growing mode that is not the gait's own, for each loop (..) [1/s].

        Below 0 for a stable loop, -inf where all modes are the gait's own. unknown [s]: delay in all motors.
        """
        rates = self.modes(unknown) if unknown else self.rates
        own = np.abs(rates) <= self.slow
        return np.asarray(np.max(np.where(own, -np.inf, rates.real), axis=-1, initial=-np.inf))

    def delay_margin(self, most: float) -> float:
        """The smallest unknown delay [s] with which a mode of one of the loops grows; `most` [s]
        where there is none up to it.

        0 where a loop is unstable without it. The loop whose torques move the robot most is searched first; of
        the others only those that are unstable with the delay found so far.
        """
        if not np.all(self.growth() < 0.0):
            return 0.0
        count = math.prod(self.B.shape[:-2])
        # left: the loops that are still to be searched, along one axis
        left = self._each(lambda x: x.reshape(count, *x.shape[-2:]))
        growth, least = np.linalg.norm(left.B, axis=(-2, -1)), most
        # `growth` is at first the order in which loops are searched, then their growth with the delay `least`
        while np.any(growth >= 0.0):
            worst = int(np.argmax(growth))
            # upwards from 0, as long as no loop was found that is unstable below `most`
            least = left[worst]._first_unstable(least, upwards=least == most)
            left = left[(growth >= 0.0) & (np.arange(len(growth)) != worst)]
            growth = left.growth(least)
        return least

    def _first_unstable(self, most: float, upwards: bool) -> float:
        """The unknown delay [s], at most `most` [s], at which a mode of one loop begins to grow.

        Delays are tried from a quarter of a period on, each 1.25 times the one before; the first that is
        unstable is refined. Not `upwards`: from `most`, where it is unstable, down to the first that is not,
        which is sooner found if the margin is just below `most`; of a loop that is unstable in between and
        stable again this finds the last change. Without an unknown delay the loop is stable.
        """
        from scipy.optimize import brentq  # here, since loading it takes half a second

        tried = [0.0, 0.25 * self.period]
        while tried[-1] < most:
            tried.append(1.25 * tried[-1])
        pairs = [(low, min(high, most)) for low, high in itertools.pairwise(tried) if low < most]
        # growth of the fastest growing mode at a delay [1/s], below 0 if stable
        growth = cache(self.growth)
        # the pair of delays between which it becomes unstable; (most, most) where it does not up to `most`
        if upwards:
            low, high = next((x for x in pairs if not growth(x[1]) < 0.0), (most, most))
        else:
            low, high = next(x for x in reversed(pairs) if x[0] == 0.0 or growth(x[0]) < 0.0)
        return most if low == most else float(brentq(growth, low, high, xtol=1e-9, rtol=1e-6))

    def sensitivity(self) -> ComplexArray:
        """S (.., F, p, p) at F frequencies: the total torque (controller's plus error) per error that is added
        to the controller's torque, S = (1 - K P)^-1 with P the robot with its delay, K the controller.

        The frequencies are FREQUENCIES in geometric order and those of the loop's modes, between `slow` and
        half the sampling frequency.
        """
        nyquist, own = np.pi / self.period, self.rates.imag
        inside = (own > self.slow) & (own < nyquist)
        # loops have different numbers of modes in the band; rows are filled up with the frequency `slow`
        own = -np.sort(-np.where(inside, own, self.slow), axis=-1)
        own = own[..., : int(np.max(np.sum(inside, axis=-1)))]
        grid = np.geomspace(self.slow, nyquist, FREQUENCIES)
        grid = grid.reshape(*(1 for _ in own.shape[:-1]), -1)
        result = []
        for angles in (grid * self.period, own * self.period):
            K, P = self.parts(np.exp(1j * angles)[..., np.newaxis, np.newaxis])
            result.append(np.linalg.inv(np.eye(P.shape[-1]) - K @ P))
        return np.concatenate(result, axis=-3)

    def parts(self, z: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
        """K (.., F, p, 2 n) of the controller, u = K (q, q'), and P (.., F, 2 n, p) of the robot with delay and
        motors, (q, q') = P u, at z = exp(i w T) (.., F, 1, 1).
        """
        (j, f), p = whole_and_part(self.delay, self.period), self.B.shape[-1]
        Phi, G_1, G_2 = robot_step(self.A, self.B, self.period, f, self.lag)
        # of_plant picks (q, q') out of the states of robot and motors
        G, of_plant = np.concatenate((G_2, G_1), axis=-1), np.eye(self.A.shape[-1], Phi.shape[-1])
        P = response(z, Phi, G, of_plant)
        # Gamma_2 acts j periods late, Gamma_1 one period more
        return tick_response(z, self.tick), (P[..., :p] + P[..., p:] / z) / z**j

    def covariance_of_torque(self, errors: Array) -> Array:
        """Covariance (p, p) [N^2 m^2] of the torques of one loop under independent errors of
        the sensors at every tick.

        errors (2 n,): standard deviations of the errors of (q, q') [rad, rad/s]. The gait's own modes, which
        may grow, are removed by their projections. For a stable loop only.
        """
        M, B, C, D = self.matrices()
        # of the inputs w only the first m, errors of (q, q'), are used
        m = len(errors)
        values, left, right = eig(M, left=True)
        # _rates: s = log(lambda) / T of the eigenvalues, by which the gait's own modes are found
        # `one` projects on mode i along all others: after this its eigenvalue is 0, and no error reaches it
        for i in np.flatnonzero(np.abs(self._rates(values)) <= self.slow):
            one = np.outer(right[:, i], left[:, i].conj()) / (left[:, i].conj() @ right[:, i])
            M, B = M - values[i] * one, B - one @ B
        shaken, direct = np.real(B)[:, :m] * errors, D[:, :m] * errors
        P = covariance(np.real(M), shaken @ shaken.T)
        return np.asarray(C @ P @ C.T + direct @ direct.T)


def tick_response(z: ComplexArray, tick: TickMatrices) -> ComplexArray:
    """Frequency response C (z - Z)^-1 Y + E (.., F, p, m) of the tick at z = exp(i w T) (.., F, 1, 1), from the
    m numbers that it reads to the torques.
    """
    Z, Y, C, E = tick
    return response(z, Z, Y, C) + E[..., np.newaxis, :, :]


def response(z: ComplexArray, M: Array, B: Array, C: Array) -> ComplexArray:
    """Frequency response C (z - M)^-1 B (.., F, p, m) of many sampled systems at z = exp(i w T) (.., F, 1, 1).

    M (.., s, s), B (.., s, m), C (p, s) or (.., p, s), for s states, m inputs and p outputs.
    """
    M, B = M[..., np.newaxis, :, :], B[..., np.newaxis, :, :]
    # 0 z gives B the axis of frequencies
    states = np.linalg.solve(z * np.eye(M.shape[-1]) - M, B + 0.0 * z)
    return np.asarray(C[..., np.newaxis, :, :] @ states)
