"""What a walk costs, counted at the ticks, so that nothing of it has to be stored.

The state g holds, over the ticks t_k of a run with e = q_b - h(Theta) from the true state, u the torque that
acts and the parts of zeta in (12):

    ticks, max |e|, sum e'e, max |u|, sum u'u, T sum |u|'|q_b'|, T sum u' q_b', max |matched|, max |unmatched|

A peak is that of the joint where it is largest.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.gait.constraint import ConstraintParameters, VirtualConstraint, virtual_constraint
from biped_adrc.model.reduction import Reduction, disturbance_parts
from biped_adrc.types import Array

SIZE = 9
"""Numbers in g."""


class MeterParameters(NamedTuple):
    """h, and T [s]."""

    h: ConstraintParameters
    period: float


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
    """T sum |u|'|q_b'| [J]: what motors that cannot take energy back would need at least."""
    net_work: float
    """[J]"""
    peak_matched: float
    """[rad/s^2]"""
    peak_unmatched: float
    """[rad/s^2]"""


def metered(
    k: MeterParameters, g: Array, q: Array, v: Array, u: Array, zeta: Array, terms: Reduction
) -> Array:
    """g after a tick at (q, v) with terms there."""
    p = len(u)
    e = q[:p] - virtual_constraint(k.h, q, v).q_d
    matched, unmatched = disturbance_parts(terms, zeta)
    power = u * v[:p]
    out = np.zeros(9)
    out[0] = g[0] + 1.0
    out[1], out[2] = np.maximum(g[1], largest(e)), g[2] + e @ e
    out[3], out[4] = np.maximum(g[3], largest(u)), g[4] + u @ u
    out[5] = g[5] + k.period * (np.abs(power) @ np.ones(p))
    out[6] = g[6] + k.period * (power @ np.ones(p))
    out[7] = np.maximum(g[7], largest(matched))
    out[8] = np.maximum(g[8], largest(unmatched))
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

    def parameters(self, period: float) -> MeterParameters:
        """What the law `metered` needs."""
        return MeterParameters(self.constraint.parameters, float(period))
