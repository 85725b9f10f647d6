"""What is counted in a walk, as columns of a row: read at its nodes, or in the table of a compiled walk.

A walk on the rigid plant is judged by its certificate, one on soft ground by how far its feet slip
(`analysis.feasibility`). On soft ground a friction is what the ground gave, so it is never above that of the
ground, and impulses of an impact are not told apart from the forces after it.

A number may be infinite or NaN here; `study.run` leaves out what is not finite.
"""

from __future__ import annotations

import math

import numpy as np

from biped_adrc.analysis.certificate import IMPULSE, REASONS
from biped_adrc.analysis.feasibility import Feasibility
from biped_adrc.analysis.ground_force import Nodes
from biped_adrc.analysis.soft_steps import contact_errors
from biped_adrc.core.types import Array
from biped_adrc.model.robots.limits import Limits
from biped_adrc.scenario.recording import Walk

WalkRow = dict[str, float | int | str | None]
"""Results by column name."""

OF_FEASIBILITY = ("feasible_impacts", "mean_normal_force", "mean_friction", "scuffing")
"""Columns that `Feasibility` has under the same names."""


def counted(n: Nodes, found: Feasibility, soft: bool = False) -> WalkRow:
    """Errors, torques, work and feasibility of a walk; soft: whether it was made on soft ground.

    Root mean squares are over nodes and joints.
    """
    held = np.flatnonzero(np.diff(n.t) > 0.0)
    error, u, turned = (np.take(x, held, axis=0) for x in (n.error, n.u, np.diff(n.q_b, axis=0)))
    outcome, judged = found.outcome, set(REASONS) - {IMPULSE if soft else "slip"}
    return {
        "peak_error": _largest(n.error),
        "rms_error": _rms(error),
        "peak_torque": _largest(n.u),
        "rms_torque": _rms(u),
        "work": float(np.sum(np.abs(u) * np.abs(turned))),
        "net_work": float(np.sum(u * turned)),
        "outcome": outcome,
        "feasible": int(outcome == "feasible"),
        "but_impact": int(outcome == "but_impact"),
        **{f"bad_{name}": int(name in found.reasons) for name in judged},
        **{name: getattr(found, name) for name in OF_FEASIBILITY},
        "impulse_ratio": found.impulse_ratio if found.touchdowns and not soft else None,
    }


def counted_in(walk: Walk, limits: Limits) -> WalkRow:
    """As `counted`, of a walk with all its nodes; what its feet did on soft ground, and when touchdowns were
    noticed.
    """
    return {
        **counted(Nodes.of(walk.signals), walk.feasible_within(limits), walk.soft),
        **(_on_the_ground(walk) if walk.soft else {}),
        **({} if walk.walker.touchdown is None else walk.touchdowns.rates._asdict()),
    }


def _on_the_ground(walk: Walk) -> WalkRow:
    """The errors that touchdowns and pushes leave, and what the feet did, of the step in which it was largest.

    The latter is missing on a plant that does not say it.
    """
    row, steps = contact_errors(walk.signals)._asdict(), walk.soft_steps
    if not steps:
        return row
    return row | {
        "slip": max(max(step.slip) for step in steps),
        "flight": max(step.flight for step in steps),
        "double_support": max(step.double_support for step in steps),
        "penetration": max(step.depth for step in steps),
    }


def _largest(x: Array) -> float:
    """Largest absolute value, 0 of nothing."""
    return float(np.max(np.abs(x), initial=0.0))


def _rms(x: Array) -> float:
    """Root of the mean square, 0 of nothing."""
    return math.sqrt(float(np.mean(x**2))) if x.size else 0.0
