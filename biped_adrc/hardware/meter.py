"""What a walk costs and what it asks of ground and motors, counted at the ticks, so that nothing is stored.

The state g holds the numbers of a `Reading` over the ticks t_k of a run, with e = q_b - h(Theta) from the true
state and u the torque that acts, and behind them

    q_b at the last tick, the mean torque since,
    ticks in this single support, impulse from outside in it J_k, the last W of P_k = m v_com - J_k

dq_b is how far the joints move from tick to tick or to an impact: for a held torque u' dq_b is its work,
whatever q' does. By Newton's law the mean force of the ground over W ticks is

    F = (P_k - P_(k-W)) / (W T) + m g e_z

whatever it does between them. A peak is that of the joint where it is largest.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.disturbances.base import Disturbance
from biped_adrc.errors import InputError
from biped_adrc.gait.constraint import ConstraintParameters, VirtualConstraint, virtual_constraint
from biped_adrc.ground import ground_axes
from biped_adrc.model.biped import Biped
from biped_adrc.model.limits import Limits
from biped_adrc.model.reduction import Reduction, disturbance_parts
from biped_adrc.types import Array

READINGS = 18
"""Numbers in a `Reading`."""
LONGEST_WINDOW = 1000
"""Ticks in a window of the mean force; all of them are part of the state."""
LARGEST_RATIO = 1e6
"""What a ratio of forces reads at most, where hardly any normal force is left."""
LEAST_FORCE = 1e-12
"""[N] or [N s], below which a normal force is none."""


class MeterParameters(NamedTuple):
    """h, and the ground: unit vectors along it and out of it, mg [N], mu, the torque limit [N m]."""

    h: ConstraintParameters
    along: Array
    across: Array
    weight: float
    friction: float
    torque: float
    tan_slope: float
    period: float
    """[s]"""
    rate: float
    """1 / (W T) [1/s]."""
    lifting: float
    """[s]"""
    window: int
    """W, in ticks."""


def size(p: int, window: int) -> int:
    """Numbers in g, for p joints and a window of W ticks."""
    return READINGS + 2 * p + 3 + 2 * window


class Reading(NamedTuple):
    """g, one number each."""

    ticks: float
    peak_error: float
    """[rad]"""
    square_error: float
    peak_torque: float
    """[N m]"""
    square_torque: float
    work: float
    """sum |u|'|dq_b| [J]: what motors that cannot take energy back would need at least."""
    net_work: float
    """[J]"""
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


class Loads(NamedTuple):
    """Of the plant at a tick, forces as (x, z)."""

    momentum: Array
    """m v_com (2,) [N s]."""
    force: Array
    """Of the ground on the stance foot (2,) [N]."""
    impulse: Array
    """From outside since the last tick (2,) [N s]."""
    foot: Array
    """Swing foot from the stance foot (2,) [m]."""
    drop: float
    """How far this single support ends below its stance foot [m]."""


def loads(
    plant: Biped,
    push: Disturbance | None,
    since: tuple[float, float],
    mode: tuple[int, float],
    q: Array,
    v: Array,
    a: Array,
    drop: float,
) -> Loads:
    """What the plant asks of the ground at (q, v, q'').

    since: the last tick and this one [s]; mode: number of the single support and its start [s].
    """
    force, impulse = plant.ground_reaction(q, v, a), np.zeros(2)
    if push is not None:
        force = force - push.resultant(since[1], *mode)
        impulse = push.impulse(*since, *mode)
    return Loads(plant.momentum(q, v), force, impulse, plant.swing_foot(q), drop)


def metered(
    k: MeterParameters,
    g: Array,
    q: Array,
    v: Array,
    u: Array,
    mean: Array,
    unknown: Array,
    terms: Reduction,
    step: float,
    since: float,
    loads: Loads,
) -> Array:
    """g after a tick at (q, v) with terms there; u acts now, and `mean` in the mean until the next tick.

    unknown (n,) [N m]: the generalised force that the nominal model does not know. since [s]: the impact that
    began single support `step`.
    """
    p = len(u)
    e = q[:p] - virtual_constraint(k.h, q, v).q_d
    matched, unmatched = disturbance_parts(terms, unknown)
    before = worked(g, q[:p])
    at = READINGS + 2 * p
    ground = carried(k, g[at:], loads)
    F_T, F_N = k.along @ loads.force, k.across @ loads.force
    means = mean_force(k, g[at:], ground)
    N = k.across @ means
    judged = np.where(g[at] >= k.window, 1.0, 0.0)
    slides = judged * outside(k, k.along @ means, N)
    depth = np.where(since > k.lifting, scuffed(k, loads), 0.0)
    peak = largest(u)
    broken = greater(slides, np.where(peak > k.torque, 1.0, 0.0))
    broken = greater(broken, np.where(depth > 0.0, 1.0, 0.0))
    out = np.zeros(READINGS)
    out[0] = g[0] + 1.0
    out[1], out[2] = greater(g[1], largest(e)), g[2] + e @ e
    out[3], out[4] = greater(g[3], peak), g[4] + u @ u
    out[5], out[6] = before[5], before[6]
    out[7] = greater(g[7], largest(matched))
    out[8] = greater(g[8], largest(unmatched))
    out[9] = np.where(g[0] > 0.0, -greater(-g[9], -F_N), F_N)
    out[10] = greater(g[10], ratio(F_T, F_N))
    out[11] = g[11] + outside(k, F_T, F_N)
    out[12] = g[12] + judged
    least = np.where(g[12] > 0.0, -greater(-g[13], -N), N)
    out[13] = np.where(judged > 0.0, least, g[13])
    out[14] = greater(g[14], judged * ratio(k.along @ means, N))
    out[15] = greater(g[15], depth)
    out[16] = g[16]
    out[17] = np.where(g[17] > 0.0, g[17], broken * step)
    return np.concatenate((out, q[:p], mean, ground))


def carried(k: MeterParameters, g: Array, loads: Loads) -> Array:
    """Ticks of this single support, J and the last W of P after a tick."""
    out = np.zeros(len(g))
    out[0] = g[0] + 1.0
    J = g[1:3] + np.minimum(g[0], 1.0) * loads.impulse
    out[1:3] = J
    out[3 : len(g) - 2] = g[5:]
    out[len(g) - 2 :] = loads.momentum - J
    return out


def mean_force(k: MeterParameters, before: Array, now: Array) -> Array:
    """Of the ground over the last W ticks (2,) [N]: `before` this one P reached back to it."""
    change = now[len(now) - 2 :] - before[3:5]
    return change * k.rate + k.weight * np.array([0.0, 1.0])


def ratio(F_T: Any, F_N: Any) -> Any:
    """|F_T| / F_N, 0 where the ground does not push."""
    found = np.minimum(np.abs(F_T) / greater(F_N, LEAST_FORCE), LARGEST_RATIO)
    return np.where(F_N > 0.0, found, 0.0)


def outside(k: MeterParameters, F_T: Any, F_N: Any) -> Any:
    """1 outside the friction cone, where the ground would have to pull too, 0 inside."""
    return np.where(F_N > 0.0, np.where(np.abs(F_T) > k.friction * F_N, 1.0, 0.0), 1.0)


def scuffed(k: MeterParameters, loads: Loads) -> Any:
    """How deep the swing foot is below the lower of the footholds, measured along the vertical [m]."""
    height = loads.foot[1] + k.tan_slope * loads.foot[0]
    return greater(-(height + greater(loads.drop, 0.0)), 0.0)


def metered_impact(
    k: MeterParameters, g: Array, q_minus: Array, q_plus: Array, swap: Array, impulse: Array
) -> Array:
    """g after an impact between the joints' angles q_minus and q_plus (p,), which `swap` relabels.

    impulse (2,) [N s]: of the ground on the foot that strikes, as (x, z).
    """
    p = len(q_minus)
    out = worked(g, q_minus)
    found = np.abs(k.along @ impulse) / greater(k.across @ impulse, LEAST_FORCE)
    out[16] = greater(out[16], np.minimum(found, LARGEST_RATIO))
    behind = g[READINGS + p : READINGS + 2 * p]
    return np.concatenate((out, q_plus, behind[swap], np.zeros(3 + 2 * k.window)))


def worked(g: Array, q_b: Array) -> Array:
    """The readings with the work since the last tick."""
    p = len(q_b)
    moved = np.minimum(g[0], 1.0) * (q_b - g[READINGS : READINGS + p])
    work = g[READINGS + p : READINGS + 2 * p] * moved
    out = np.zeros(READINGS)
    for i in range(READINGS):
        out[i] = g[i]
    out[5] = g[5] + np.abs(work) @ np.ones(p)
    out[6] = g[6] + work @ np.ones(p)
    return out


def largest(x: Array) -> Any:
    """max |x|."""
    found = 0.0 * x[0]
    for i in range(len(x)):
        found = greater(found, np.abs(x[i]))
    return found


def greater(a: Any, b: Any) -> Any:
    """The greater of two numbers; in machine code half of what `np.maximum` costs. NaN where one is NaN."""
    return np.where(a <= b, b, np.where(b <= a, a, a + b))


@dataclass(frozen=True)
class Meter:
    """Measures the error from this constraint, and forces against `limits` on the plant's own ground.

    lifting [s]: how long after an impact the swing foot may still be in the ground.
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

    def parameters(self, plant: Biped, period: float, slope: float) -> MeterParameters:
        """What the law `metered` needs."""
        limits, window = self.limits.of(plant.description), self.window(period)
        return MeterParameters(
            self.constraint.parameters,
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
    """What g says."""
    return Reading(*(float(x) for x in g[:READINGS]))
