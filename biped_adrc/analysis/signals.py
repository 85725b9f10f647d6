"""Everything that can be read off a walk afterwards: references, errors, torques, estimates, forces.

Controllers have no hidden state, so the signals are computed again from the stored states.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from biped_adrc.analysis.quadrature import largest
from biped_adrc.control.outer_loop import OuterLoop, reference_in_force
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.reduction import disturbance_parts
from biped_adrc.types import Array
from biped_adrc.walker import Mode, Walker

LONG = 2000
"""Nodes from which on compiling pays off."""


@dataclass(frozen=True)
class Signals:
    """Rows are the stored nodes (K,); impacts and ticks repeat their time, before and after."""

    t: Array
    """(K,) [s]."""
    step: Array
    """(K,) single support, from 1."""
    q: Array
    """(K, n) [rad]."""
    v: Array
    """(K, n) [rad/s]."""
    a: Array
    """(K, n) [rad/s^2]."""
    theta: Array
    """(K,) Theta [rad]."""
    dtheta: Array
    """(K,) Theta' [rad/s]."""
    q_d: Array
    """(K, p) references [rad]."""
    dq_d: Array
    """(K, p) [rad/s]."""
    error: Array
    """(K, p) q_b - q_d [rad]."""
    u: Array
    """(K, p) torque applied [N m]."""
    zeta: Array
    """(K, n) external torque [N m]."""
    xi: Array
    """(K, p) total disturbance q_b'' - kappa u of the nominal model [rad/s^2]."""
    xi_estimate: Array
    """(K, p) estimate of xi [rad/s^2]; NaN without an observer."""
    xi_external: Array
    """(K, p) the part of xi that the nominal model does not know, matched and unmatched: what zeta makes, and
    errors of the model, friction among them [rad/s^2]. It is xi - xi_nominal."""
    xi_matched: Array
    """(K, p) kappa xi~_b, the matched part of it, with xi~ of (11): what a motor could cancel [rad/s^2]."""
    xi_nominal: Array
    """(K, p) (14) without xi~: the part of xi the nominal model knows [rad/s^2]."""
    zeta_estimate: Array
    """(K, p) kappa^-1 (xi^ - xi_nominal): the joint torque the estimate amounts to beyond the nominal
    model [N m]; NaN without an observer."""
    ground_reaction: Array
    """(K, 2), (F_T, F_N) [N], horizontal and vertical on any ground."""
    kinetic: Array
    """(K,) [J]."""
    potential: Array
    """(K,) [J], zero at the height of the first stance foot."""
    swing_foot: Array
    """(K, 2) from the stance foot [m]."""
    hip: Array
    """(K, 2) from the stance foot [m]."""
    foothold: Array
    """(K,) x of the stance foot in the world [m]."""
    foothold_height: Array
    """(K,) z of the stance foot in the world [m]."""

    @property
    def xi_unmatched(self) -> Array:
        """(K, p) the rest of `xi_external`: what comes through the unactuated row of (12) [rad/s^2]."""
        unmatched: Array = self.xi_external - self.xi_matched
        return unmatched

    @property
    def peak_error(self) -> float:
        """max |q_b - q_d| [rad], between the nodes too."""
        return largest(self.t, self.error, self.v[:, : self.error.shape[1]] - self.dq_d)

    def of_step(self, step: int) -> Signals:
        """The rows of one single support."""
        rows = self.step == step
        return Signals(**{f.name: getattr(self, f.name)[rows] for f in fields(self)})


def signals(walker: Walker, trajectory: Trajectory, reference: Reference) -> Signals:
    """Compute the signals of a walk; `reference` gives q_d (the controller's own, usually).

    Where outer loops correct the reference, q_d is the corrected one. Of a compiled run, and of a long one,
    they are computed in compiled code where that can be had.
    """
    seen = None
    nodes = sum(len(arc.t) for arc in trajectory.arcs)
    if trajectory.settings.get("engine") == "compiled" or nodes >= LONG:
        from biped_adrc.engine.seeing import see

        seen = see(walker, trajectory, reference)
    if seen is not None:
        return Signals(*seen)
    rows: list[tuple[object, ...]] = []
    foot = np.zeros(2)
    for arc in trajectory.arcs:
        for t, seen_at, x in zip(arc.t, arc.seen, arc.x, strict=True):
            row = _row(walker, reference, float(seen_at), x, arc.mode, foot)
            rows.append((float(t), *row[1:], *foot))
        if arc.event is not None and arc.event.x_plus is not None:
            foot = foot + walker.plant.swing_foot(arc.event.x_minus[: walker.plant.n])
    columns = (np.array(column) for column in zip(*rows, strict=True))
    return Signals(*columns)


def _row(
    walker: Walker, reference: Reference, t: float, x: Array, mode: Mode, foot: Array
) -> tuple[object, ...]:
    i = walker.instant(t, x, mode)
    m, b = i.measurement, walker.plant
    q, v, a, p = m.q, m.v, i.a, walker.plant.p
    if isinstance(walker.law, OuterLoop):
        reference = reference_in_force(walker.law, i.s)
    r = reference(t, q, v)
    estimate = walker.law.estimate(i.s, m)
    xi_estimate = np.full(p, np.nan) if estimate is None else estimate.disturbance
    matched, unmatched = disturbance_parts(m.terms, walker.unknown(m.terms, a, i.u, i.zeta))
    return (
        t,
        mode.step,
        q,
        v,
        a,
        float(b.phase @ q),
        float(b.phase @ v),
        r.q_d,
        r.dq_d,
        q[:p] - r.q_d,
        i.u,
        i.zeta,
        a[:p] - m.terms.kappa @ i.u,
        xi_estimate,
        matched + unmatched,
        matched,
        m.terms.xi,
        m.terms.kappa_inverse @ (xi_estimate - m.terms.xi),
        walker.ground_reaction(i, mode),
        b.kinetic_energy(q, v),
        b.potential_energy(q) + b.weight * float(foot[1]),
        b.swing_foot(q),
        b.hip(q),
    )
