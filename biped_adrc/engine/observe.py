"""What can be read off a walk at one instant, as one compiled function; the columns of `analysis.signals`.

observe (t, step, t_start, x, zeta) -> the parts of `Seen`, in its order
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.engine.equations import At, Equations, Function, Make, Numbers, count, masked
from biped_adrc.engine.symbols import Vector, column
from biped_adrc.gait.constraint import ConstraintParameters, virtual_constraint
from biped_adrc.model import planar
from biped_adrc.model.reduction import disturbance_parts


class Seen(NamedTuple):
    """At N instants; shapes as in `analysis.signals.Signals`."""

    a: Any
    theta: Any
    dtheta: Any
    q_d: Any
    dq_d: Any
    u: Any
    xi: Any
    xi_estimate: Any
    xi_matched: Any
    xi_unmatched: Any
    xi_nominal: Any
    zeta_estimate: Any
    ground_reaction: Any
    kinetic: Any
    potential: Any
    swing_foot: Any
    hip: Any


def shapes(n: int, p: int) -> Seen:
    """Numbers in each part."""
    return Seen(n, 1, 1, p, p, p, p, p, p, p, p, p, 2, 1, 1, 2, 2)


class Watched(NamedTuple):
    """The walker's numbers, the reference h that is looked at, and the phase row c (n,)."""

    walker: Numbers
    h: ConstraintParameters
    c: Any


@dataclass(frozen=True)
class Observation:
    """`observe` for one make of walker and reference; `watched` are its symbols."""

    equations: Equations
    watched: Watched

    @classmethod
    def of(cls, make: Make, example: Watched) -> Observation:
        """With symbols for the floats of an example."""
        K = Vector("K", count(example))
        watched = K.like(example)
        return cls(Equations(make, K.symbol, masked(make, watched.walker)), watched)

    def observe(self) -> Function:
        """The function."""
        e, at = self.equations, self.equations.at()
        m = at.m
        u = at.u if e.make.sampled else e.saturated(e.law(at, "output", at.s))
        a = e.acceleration(m.terms, m.q, m.v, e.force(u, at.zeta))
        seen = column(*self._seen(at, u, a))
        return Function(e.K, at.inp.symbol, seen)

    def _seen(self, at: At, u: Any, a: Any) -> Seen:
        e, m, watched = self.equations, at.m, self.watched
        plant, r = e.numbers.plant, at.trace(virtual_constraint)(watched.h, m.q, m.v)
        robot, terms, p = e.make.robot, m.terms, e.make.robot.p
        t = planar.turned(robot, m.q)
        if e.make.laws.estimate is None:
            xi = np.full(p, float("nan"), dtype=object)
        else:
            xi = e.law(at, "estimate", at.s).disturbance
        matched, unmatched = at.trace(disturbance_parts)(terms, e.unknown(terms, a, u, at.zeta))
        D, _ = planar.inertia_and_bias(robot, plant, m.q, m.v)
        _, height = planar.point(t, plant.w_re, plant.w_im)
        return Seen(
            a,
            watched.c @ m.q,
            watched.c @ m.v,
            r.q_d,
            r.dq_d,
            u,
            a[:p] - terms.kappa @ u,
            xi,
            matched,
            unmatched,
            terms.xi,
            terms.kappa_inverse @ (xi - terms.xi),
            planar.ground_reaction(robot, plant, m.q, m.v, a),
            0.5 * (m.v @ (D @ m.v)),
            plant.gravity * height,
            np.array(planar.point(t, plant.foot_re, plant.foot_im)),
            np.array(planar.point(t, plant.hip_re, plant.hip_im)),
        )
