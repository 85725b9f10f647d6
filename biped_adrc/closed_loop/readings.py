"""What can be read off a closed loop at one instant; NumPy and compiled code share this source."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.closed_loop.semantics import Loop, Mode, instant, unknown
from biped_adrc.control.base import Measurement
from biped_adrc.gait.reference import ReferencePoint
from biped_adrc.model.reduction import disturbance_parts
from biped_adrc.types import Array


class Reading(NamedTuple):
    """At one instant, or at N of them with N rows; meanings as in `analysis.signals.Signals`."""

    a: Any
    q_d: Any
    dq_d: Any
    u: Any
    zeta: Any
    xi: Any
    xi_estimate: Any
    xi_external: Any
    xi_matched: Any
    xi_nominal: Any
    zeta_estimate: Any
    ground_reaction: Any
    """Forces from outside not yet taken off."""
    kinetic: Any
    potential: Any
    """Zero at the height of this stance foot."""
    swing_foot: Any
    hip: Any


def reading(
    loop: Loop,
    t: float,
    x: Array,
    mode: Mode,
    reference: Callable[[Array, Measurement], ReferencePoint],
) -> Reading:
    """At (t, x); reference(s, m) is what is looked at, usually what the controller tracks."""
    i = instant(loop, t, x, mode)
    m, plant, terms, p = i.measurement, loop.plant, i.measurement.terms, loop.plant.p
    r, estimate = reference(i.s, m), loop.law.estimate(i.s, m)
    xi_estimate = np.full(p, np.nan) if estimate is None else estimate.disturbance
    matched, unmatched = disturbance_parts(terms, unknown(loop, terms, i.a, i.u, i.zeta))
    return Reading(
        a=i.a,
        q_d=r.q_d,
        dq_d=r.dq_d,
        u=i.u,
        zeta=i.zeta,
        xi=i.a[:p] - terms.kappa @ i.u,
        xi_estimate=xi_estimate,
        xi_external=matched + unmatched,
        xi_matched=matched,
        xi_nominal=terms.xi,
        zeta_estimate=terms.kappa_inverse @ (xi_estimate - terms.xi),
        ground_reaction=plant.ground_reaction(m.q, m.v, i.a),
        kinetic=plant.kinetic_energy(m.q, m.v),
        potential=plant.potential_energy(m.q),
        swing_foot=plant.swing_foot(m.q),
        hip=plant.hip(m.q),
    )
