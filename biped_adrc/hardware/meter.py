"""What a walk costs and what it asks of ground and motors, counted at the ticks, so that nothing is stored.

The state g holds the numbers of a `Reading` over the ticks t_k of a run, with e = q_b - h(Theta) from the true
state and u the torque that acts, and behind them

    q_b at the last tick, the mean torque since,
    of this single support: ticks, time of the last, whether the swing foot has been above the ground, impulse
    from outside J_k, force from outside, the last W + 1 of P_k = m v_com - J_k

dq_b is how far the joints move from tick to tick or to an impact: for a held torque u' dq_b is its work,
whatever q' does. By Newton's law the mean force of the ground over W ticks is

    F = (P_k - P_(k-W)) / (W T) + m g e_z

whatever it does between them. The last window of a single support ends at its impact; it begins within a
period, in which P is taken as linear. A single support that is shorter than W T is averaged as a whole. A peak
is that of the joint where it is largest. Forces at a tick are those just after it.

Why means beside the force at a tick: a stiff sampled controller makes the force jump from tick to tick, and a
foot slides by what acts over some milliseconds. `Limits.window` says how long. The mean is exact, since it
comes from momentum, and needs nothing between the ticks.

A campaign runs thousands of walks, whose trajectories nobody keeps; their readings are all there is. So the
meter is a part of the state, and its function `metered` runs in both engines. `closed_loop.walker` calls it
behind the controller at each tick, `hardware.sample_hold` keeps g, and `scenario.outcome` reads it at the end.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.ground import ground_axes
from biped_adrc.hardware.loads import Loads
from biped_adrc.model.biped import Biped
from biped_adrc.model.reduction import Reduction, disturbance_parts
from biped_adrc.robots.limits import ROUND_OFF, Limits
from biped_adrc.shown import Shown
from biped_adrc.types import Array, Indices, relabelled

Number: TypeAlias = float | Array
"""One number: a float, or an array of shape () as NumPy gives."""

READINGS = 18
"""Numbers in a `Reading`."""
LONGEST_WINDOW = 1000
"""Ticks in a window of the mean force; all of them are part of the state."""
LARGEST_RATIO = 1e6
"""What a ratio of forces reads at most, where hardly any normal force is left."""
LEAST_FORCE = 1e-12
"""[N] or [N s], below which a normal force is none."""
SHORTEST = 1e-9
"""[s], of a window that is judged."""
SUPPORT = 7
"""Numbers kept of a single support, in front of the P_k."""


def size(p: int, window: int) -> int:
    """Numbers in g, for p joints and a window of W ticks."""
    return READINGS + 2 * p + SUPPORT + 2 * (window + 1)


class Reading(NamedTuple):
    """g, one number each."""

    ticks: float
    """Sample instants counted."""
    peak_error: float
    """[rad]"""
    square_error: float
    """Sum of |e|^2 over the ticks [rad^2]; over ticks it is the mean square."""
    peak_torque: float
    """[N m]"""
    square_torque: float
    """Sum of |u|^2 over the ticks [N^2 m^2]."""
    work: float
    """sum |u|'|dq_b| [J]: what motors that cannot take energy back would need at least."""
    net_work: float
    """sum u' dq_b [J], which motors give and take back."""
    peak_matched: float
    """Of what the nominal model does not know, from outside or of its own error [rad/s^2]."""
    peak_unmatched: float
    """[rad/s^2]"""
    least_normal_force: float
    """F_N at a tick [N]."""
    friction: float
    """Largest |F_T| / F_N of the ticks with F_N > 0; 0 where there was none."""
    outside: float
    """Ticks with the force of the ground outside the friction cone."""
    windows: float
    """Windows over which the force was averaged."""
    mean_normal_force: float
    """Least of the means [N]; 0 without a window."""
    mean_friction: float
    """Largest of the ratios of the means with F_N > 0; 0 where there was none."""
    scuffing: float
    """How deep the swing foot was in the ground [m]."""
    impulse_ratio: float
    """Largest |F_T| / F_N of the impulses at impact."""
    illegal_step: float
    """Single support in which a limit was broken first; 0 for none. Impulses do not count."""


class Hit(NamedTuple):
    """An impact."""

    t: float
    """[s]"""
    step: float
    """The single support that it ends."""
    momentum: Array
    """m v_com before it (2,) [N s]."""
    impulse: Array
    """Of the ground on the foot that strikes (2,) [N s]."""


def ratio(F_T: Number, F_N: Number) -> Number:
    """|F_T| / F_N of forces [N] or impulses [N s], 0 where the ground does not push; at most LARGEST_RATIO."""
    found = np.minimum(np.abs(F_T) / greater(F_N, LEAST_FORCE), LARGEST_RATIO)
    return np.where(F_N > 0.0, found, 0.0)


def worked(g: Array, q_b: Array) -> Array:
    """The readings (READINGS,) with the work [J] since the last tick, for the joints' angles q_b (p,) [rad]."""
    p = len(q_b)
    moved = np.minimum(g[0], 1.0) * (q_b - g[READINGS : READINGS + p])
    work = g[READINGS + p : READINGS + 2 * p] * moved
    out = np.zeros(READINGS)
    for i in range(READINGS):
        out[i] = g[i]
    out[5] = g[5] + np.abs(work) @ np.ones(p)
    out[6] = g[6] + work @ np.ones(p)
    return out


def largest(x: Array) -> Number:
    """max |x| of x (p,), in the unit of x; the loop is unrolled in machine code."""
    found = 0.0 * x[0]
    for i in range(len(x)):
        found = greater(found, np.abs(x[i]))
    return found


def greater(a: Number, b: Number) -> Number:
    """The greater of two numbers; in machine code half of what `np.maximum` costs. NaN where one is NaN."""
    return np.where(a <= b, b, np.where(b <= a, a, a + b))


@dataclass(frozen=True)
class SampledMeter:
    """The meter on a plant, for ticks every `period` [s].

    h: the constraint that errors are measured from. along, across (2,): unit vectors along the ground and out
    of it. weight: m g [N]. friction: mu. torque: the limit on a joint [N m].
    """

    h: VirtualConstraint
    along: Array
    across: Array
    weight: float
    friction: float
    """Largest |F_T| / F_N at which a foot does not slide."""
    torque: float
    tan_slope: float
    """Of the ground, which falls or rises in the direction of walking."""
    period: float
    """[s]"""
    rate: float
    """1 / (W T) [1/s]."""
    lifting: float
    """How long after an impact the swing foot may be in the ground [s]."""
    window: int
    """W, in ticks."""

    def measure(
        self,
        g: Array,
        q: Array,
        v: Array,
        u: Array,
        mean: Array,
        unknown: Array,
        terms: Reduction,
        t: float,
        step: float,
        since: float,
        loads: Loads,
    ) -> Array:
        """g after a tick at t [s] in q (n,), v (n,); u (p,) acts now, `mean` (p,) on average until the next.

        terms: of the nominal model there. unknown (n,) [N m]: the generalised force that it does not know.
        since [s]: of this single support, `step`, from the impact that began it. loads: of the plant.
        """
        p = len(u)
        e = q[:p] - self.h(t, q, v).q_d
        matched, unmatched = disturbance_parts(terms, unknown)
        at = READINGS + 2 * p
        ground = self.carried(g[at:], loads, t)
        F_T, F_N = self.along @ loads.force, self.across @ loads.force
        means = (ground[-2:] - ground[SUPPORT : SUPPORT + 2]) * self.rate + self.weight_force()
        N = self.across @ means
        judged = np.where(g[at] >= self.window, 1.0, 0.0)
        slides = judged * self.outside(self.along @ means, N)
        depth = np.where(since > self.lifting, ground[2] * greater(-self.height(loads), 0.0), 0.0)
        peak = largest(u)
        broken = greater(slides, np.where(peak > self.torque, 1.0, 0.0))
        broken = greater(broken, np.where(depth > 0.0, 1.0, 0.0))
        out = worked(g, q[:p])
        out[0] = g[0] + 1.0
        out[1], out[2] = greater(g[1], largest(e)), g[2] + e @ e
        out[3], out[4] = greater(g[3], peak), g[4] + u @ u
        out[7] = greater(g[7], largest(matched))
        out[8] = greater(g[8], largest(unmatched))
        out[9] = np.where(g[0] > 0.0, -greater(-g[9], -F_N), F_N)
        out[10] = greater(g[10], ratio(F_T, F_N))
        out[11] = g[11] + self.outside(F_T, F_N)
        self.judge(out, g, judged, means)
        out[15] = greater(g[15], depth)
        out[17] = np.where(g[17] > 0.0, g[17], broken * step)
        return np.concatenate((out, q[:p], mean, ground))

    def carried(self, g: Array, loads: Loads, t: float) -> Array:
        """What is kept of this single support after a tick at t [s], (SUPPORT + 2 (W + 1),), as g before.

        At its first tick all P_k are the same, so a window that reaches behind it begins there.
        """
        first = g[0] < 1.0
        J = g[3:5] + np.minimum(g[0], 1.0) * loads.outside.impulse
        P = loads.momentum - J
        out = np.zeros(len(g))
        out[0], out[1] = g[0] + 1.0, t
        out[2] = greater(g[2], np.where(self.height(loads) > 0.0, 1.0, 0.0))
        out[3:5], out[5:7] = J, loads.outside.force
        for i in range(self.window):
            out[SUPPORT + 2 * i] = np.where(first, P[0], g[SUPPORT + 2 * i + 2])
            out[SUPPORT + 2 * i + 1] = np.where(first, P[1], g[SUPPORT + 2 * i + 3])
        out[len(g) - 2 :] = P
        return out

    def weight_force(self) -> Array:
        """m g e_z (2,) [N]."""
        return self.weight * np.array([0.0, 1.0])

    def last_mean(self, g: Array, hit: Hit) -> tuple[Array, Number]:
        """Mean force of the ground (2,) [N] up to an impact, and 1, or 0 where there is no time to judge.

        g: what is kept of the single support. The window has W periods as all others, and ends between two
        ticks: P where it begins is interpolated between the P_k.
        """
        since, periods = hit.t - g[1], g[0] - 1.0
        P = hit.momentum - g[3:5] - since * g[5:7]
        part = np.where(periods >= self.window, since / self.period, 0.0)
        base = (1.0 - part) * g[SUPPORT : SUPPORT + 2] + part * g[SUPPORT + 2 : SUPPORT + 4]
        length = (np.minimum(periods, 1.0 * self.window) - part) * self.period + since
        judged = np.where(g[0] > 0.0, np.where(length > SHORTEST, 1.0, 0.0), 0.0)
        return (P - base) / greater(length, SHORTEST) + self.weight_force(), judged

    def judge(self, out: Array, g: Array, judged: Number, means: Array) -> None:
        """Write a mean force `means` (2,) [N] into the readings `out` (READINGS,) where `judged` is 1.

        g: the readings before.
        """
        N = self.across @ means
        least = np.where(g[12] > 0.0, -greater(-g[13], -N), N)
        out[12] = g[12] + judged
        out[13] = np.where(judged > 0.0, least, g[13])
        out[14] = greater(g[14], judged * ratio(self.along @ means, N))

    def outside(self, F_T: Number, F_N: Number) -> Number:
        """1 outside the friction cone, where the ground would have to pull too, 0 inside."""
        edge = self.friction * (1.0 + ROUND_OFF)
        return np.where(F_N > 0.0, np.where(np.abs(F_T) > edge * F_N, 1.0, 0.0), 1.0)

    def height(self, loads: Loads) -> Number:
        """Of the swing foot above the lower of the footholds, measured along the vertical [m]."""
        return loads.foot[1] + self.tan_slope * loads.foot[0] + greater(loads.outside.drop, 0.0)

    def impact(
        self,
        g: Array,
        q_minus: Array,
        q_plus: Array,
        swap: Indices,
        hit: Hit,
    ) -> Array:
        """g after an impact between the joints' angles q_minus, q_plus (p,) [rad], which `swap` (p,) relabels.

        The last window of the single support is judged here, and what is kept of it is emptied for the next.
        """
        p = len(q_minus)
        out = worked(g, q_minus)
        means, judged = self.last_mean(g[READINGS + 2 * p :], hit)
        self.judge(out, g, judged, means)
        broken = judged * self.outside(self.along @ means, self.across @ means)
        out[17] = np.where(g[17] > 0.0, g[17], broken * hit.step)
        found = np.abs(self.along @ hit.impulse) / greater(self.across @ hit.impulse, LEAST_FORCE)
        out[16] = greater(out[16], np.minimum(found, LARGEST_RATIO))
        behind = g[READINGS + p : READINGS + 2 * p]
        return np.concatenate(
            (out, q_plus, relabelled(behind, swap), np.zeros(SUPPORT + 2 * (self.window + 1)))
        )


@dataclass(frozen=True)
class Meter(Shown):
    """Measures the error from this constraint, and forces against `limits` on the plant's own ground.

    limits: of friction, torque and the window [s] of the mean force; what it leaves open is the robot's.
    lifting [s]: how long after an impact the swing foot may still be in the ground, 3 % of a step of 0.4 s. A
    certificate excuses 3 % of each step at both of its ends: at a tick nobody knows when the step will end, so
    that here nothing is excused before the impact.
    """

    constraint: VirtualConstraint
    limits: Limits = Limits()  # noqa: RUF009
    lifting: float = 0.012

    def window(self, period: float) -> int:
        """Ticks in the window of the mean force: the nearest whole number of periods, at least one.

        Raises InputError for more than the state should hold.
        """
        ticks = max(1, round(self.limits.window / period))
        if ticks > LONGEST_WINDOW:
            raise InputError(
                f"the force window of {self.limits.window} s has {ticks} ticks of {period} s, expected at "
                f"most {LONGEST_WINDOW}; average over less"
            )
        return ticks

    def sampled(self, plant: Biped, period: float, slope: float) -> SampledMeter:
        """The meter on this plant, for ticks every `period` [s]."""
        limits, window = self.limits.of(plant.description), self.window(period)
        return SampledMeter(
            self.constraint,
            *ground_axes(slope),
            float(plant.weight),
            limits.friction,
            limits.torque,
            math.tan(slope),
            float(period),
            1.0 / (window * period),
            float(self.lifting),
            window,
        )


def reading(g: Array) -> Reading:
    """What the state g of the meter, (size,) with `size(p, window)`, says: its first numbers, by name."""
    return Reading(*(float(x) for x in g[:READINGS]))
