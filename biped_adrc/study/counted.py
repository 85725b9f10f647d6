"""What is counted in a walk, as columns of a row: read off the signals at the nodes of its trajectory.

A walk on the rigid plant is judged by its certificate, one on soft ground by how far its feet slip
(`analysis.feasibility`). On soft ground a friction is what the ground gave, so it is never above that of the
ground, and impulses of an impact are not told apart from the forces after it.

A number may be infinite or NaN here; `study.run` leaves out what is not finite.
"""

from __future__ import annotations

import math

import numpy as np

from biped_adrc.analysis.certificate import IMPULSE, REASONS
from biped_adrc.analysis.contact_errors import contact_errors
from biped_adrc.scenario.build import limits
from biped_adrc.scenario.recording import Walk
from biped_adrc.types import Array

WalkRow = dict[str, float | int | str | None]
"""Results by column name."""

OF_FEASIBILITY = (
    "least_normal_force",
    "friction",
    "share_outside",
    "mean_normal_force",
    "mean_friction",
    "scuffing",
)
"""Columns that `Feasibility` has under the same names."""


def counted(made: Walk) -> WalkRow:
    """Errors, torques, work and feasibility of a scenario's walk, what its feet did on soft ground, and when
    touchdowns were noticed.

    Root mean squares are over nodes and joints.
    """
    assert made.scenario is not None
    x, found = made.signals, made.feasible_within(limits(made.scenario))
    held = np.flatnonzero(np.diff(x.t) > 0.0)
    u, turned = x.u[held], np.diff(x.q[:, : x.u.shape[1]], axis=0)[held]
    outcome, judged = found.outcome, set(REASONS) - {IMPULSE if made.soft else "slip"}
    return {
        "peak_error": _largest(x.error),
        "rms_error": _rms(x.error[held]),
        "peak_torque": _largest(x.u),
        "rms_torque": _rms(u),
        "work": float(np.sum(np.abs(u) * np.abs(turned))),
        "net_work": float(np.sum(u * turned)),
        "peak_matched": _largest(x.xi_matched),
        "peak_unmatched": _largest(x.xi_unmatched),
        **(_on_the_ground(made) if made.soft else {}),
        **({} if made.walker.touchdown is None else made.touchdowns.rates._asdict()),
        "outcome": outcome,
        "feasible": int(outcome == "feasible"),
        "but_impact": int(outcome == "but_impact"),
        "feasible_impacts": found.feasible_impacts,
        **{f"bad_{name}": int(name in found.reasons) for name in judged},
        **{name: getattr(found, name) for name in OF_FEASIBILITY},
        "impulse_ratio": found.impulse_ratio if found.touchdowns and not made.soft else None,
    }


def _on_the_ground(made: Walk) -> WalkRow:
    """The errors that touchdowns and pushes leave, and what the feet did, of the step in which it was largest.

    The latter is missing on a plant that does not say it.
    """
    row, steps = contact_errors(made.signals)._asdict(), made.soft_steps
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
