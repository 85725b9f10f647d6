"""What a walk costs, counted at the ticks, so that nothing of it has to be stored.

The state g holds, over the ticks t_k of a run with e = q_b - h(Theta) from the true state, u the torque that
acts and the parts of zeta in (12):

    ticks, max |e|, sum e'e, max |u|, sum u'u, sum |u|'|dq_b|, sum u' dq_b, max |matched|, max |unmatched|

and, behind them, q_b at the last tick and the mean torque since. dq_b is how far the joints move from tick to
tick or to an impact: for a torque that is held u' dq_b is its work, whatever q' does. A peak is that of the
joint where it is largest.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.gait.constraint import ConstraintParameters, VirtualConstraint, virtual_constraint
from biped_adrc.model.reduction import Reduction, disturbance_parts
from biped_adrc.types import Array

READINGS = 9
"""Numbers in a `Reading`."""


def size(p: int) -> int:
    """Numbers in g, for p joints."""
    return READINGS + 2 * p


class MeterParameters(NamedTuple):
    """h."""

    h: ConstraintParameters


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
    """[rad/s^2]"""
    peak_unmatched: float
    """[rad/s^2]"""


def metered(
    k: MeterParameters,
    g: Array,
    q: Array,
    v: Array,
    u: Array,
    mean: Array,
    zeta: Array,
    terms: Reduction,
) -> Array:
    """g after a tick at (q, v) with terms there; u acts now, and `mean` in the mean until the next tick."""
    p = len(u)
    e = q[:p] - virtual_constraint(k.h, q, v).q_d
    matched, unmatched = disturbance_parts(terms, zeta)
    before = worked(g, q[:p])
    out = np.zeros(9)
    out[0] = g[0] + 1.0
    out[1], out[2] = np.maximum(g[1], largest(e)), g[2] + e @ e
    out[3], out[4] = np.maximum(g[3], largest(u)), g[4] + u @ u
    out[5], out[6] = before[5], before[6]
    out[7] = np.maximum(g[7], largest(matched))
    out[8] = np.maximum(g[8], largest(unmatched))
    return np.concatenate((out, q[:p], mean))


def metered_impact(g: Array, q_minus: Array, q_plus: Array, swap: Array) -> Array:
    """g after an impact between the joints' angles q_minus and q_plus (p,), which `swap` relabels."""
    p = len(q_minus)
    out = worked(g, q_minus)
    return np.concatenate((out, q_plus, g[9 + p :][swap]))


def worked(g: Array, q_b: Array) -> Array:
    """The readings (9,) with the work since the last tick."""
    p = len(q_b)
    moved = np.minimum(g[0], 1.0) * (q_b - g[9 : 9 + p])
    work = g[9 + p :] * moved
    out = np.zeros(9)
    for i in range(9):
        out[i] = g[i]
    out[5] = g[5] + np.abs(work) @ np.ones(p)
    out[6] = g[6] + work @ np.ones(p)
    return out


def largest(x: Array) -> float:
    """max |x|."""
    found = 0.0 * x[0]
    for i in range(len(x)):
        found = np.maximum(found, np.abs(x[i]))
    return found


@dataclass(frozen=True)
class Meter:
    """Measures the error from this constraint."""

    constraint: VirtualConstraint

    @property
    def parameters(self) -> MeterParameters:
        """What the law `metered` needs."""
        return MeterParameters(self.constraint.parameters)


def reading(g: Array) -> Reading:
    """What g says."""
    return Reading(*(float(x) for x in g[:READINGS]))
