"""A trial walked on a plant other than the rigid one, as a row of the same columns.

Nothing is counted by a meter there: the row is read off the walk's signals, which are recorded from tick to
tick. A friction is what the ground gave, so it is never above that of the ground; what a walk asked in vain
is in `slip`, `flight` and how it ended.
"""

from __future__ import annotations

import math

import numpy as np

from biped_adrc.analysis.contact_errors import contact_errors
from biped_adrc.analysis.legality import Legality
from biped_adrc.analysis.signals import Signals
from biped_adrc.engine.batch import BatchWalk
from biped_adrc.hybrid.status import Status
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.run import walk_scenario
from biped_adrc.scenario.scenario import Scenario

SoftRow = dict[str, float | int | str | None]
"""Results by column name."""


def soft_walk(s: Scenario) -> tuple[Walk, BatchWalk]:
    """The walk of a scenario and its impacts.

    Raises InputError for values that do not fit together, and what a controller raises.
    """
    made = walk_scenario(s)
    run = made.trajectory
    strikes = run.events("foot_strike")
    return made, BatchWalk(
        run.status,
        run.detail,
        np.array([event.t for event in strikes]),
        run.before("foot_strike"),
        run.final_state,
        run.t_end,
        str(run.settings["engine"]),
    )


def counted(made: Walk, distance: float) -> SoftRow:
    """Errors, torques, work, legality and touchdowns of a walk; distance [m]."""
    x = made.signals
    ticks = np.flatnonzero(np.diff(x.t) > 0.0)
    moved = np.abs(np.diff(x.q[:, : x.u.shape[1]], axis=0))[ticks]
    forward = np.diff(x.q[:, : x.u.shape[1]], axis=0)[ticks]
    work = float(np.sum(np.abs(x.u[ticks]) * moved))
    weight = made.walker.plant.weight
    return {
        "peak_error": _largest(x.error),
        "rms_error": _rms(x.error[ticks]),
        "peak_torque": _largest(x.u),
        "rms_torque": _rms(x.u[ticks]),
        "work": work,
        "net_work": float(np.sum(x.u[ticks] * forward)),
        "peak_matched": _largest(x.xi_matched),
        "peak_unmatched": _largest(x.xi_unmatched),
        "cost_of_transport": work / (weight * distance) if distance > 0.0 else None,
        **contact_errors(x)._asdict(),
        **_on_the_ground(made),
        **({} if made.walker.touchdown is None else made.touchdowns.rates._asdict()),
        **_legality(made.legality, x),
    }


def _on_the_ground(made: Walk) -> SoftRow:
    """What the feet did, of the step in which it was largest; nothing on a plant that does not say it."""
    steps = made.soft_steps
    if not steps:
        return {}
    return {
        "slip": max(max(step.slip) for step in steps),
        "flight": max(step.flight for step in steps),
        "double_support": max(step.double_support for step in steps),
        "penetration": max(step.depth for step in steps),
    }


def _legality(found: Legality, x: Signals) -> SoftRow:
    """The columns of legality; impulses of an impact are not told apart from the forces after it."""
    illegal = found.reasons
    completed = found.status is Status.COMPLETED
    return {
        "outcome": found.outcome,
        "legal": int(completed and not illegal),
        "legal_impacts": found.legal_impacts,
        "least_normal_force": found.least_normal_force,
        "friction": _finite(found.friction),
        "share_outside": found.share_outside,
        "mean_normal_force": found.mean_normal_force,
        "mean_friction": _finite(found.mean_friction),
        "scuffing": found.scuffing,
        **{f"bad_{name}": int(name in illegal) for name in ("normal_force", "friction", "torque")},
        "bad_scuffing": int("scuffing" in illegal),
    }


def _largest(x: np.ndarray) -> float:
    """Largest absolute value, 0 of nothing."""
    return float(np.max(np.abs(x), initial=0.0))


def _rms(x: np.ndarray) -> float:
    """Root of the mean square, 0 of nothing."""
    return math.sqrt(float(np.mean(x**2))) if x.size else 0.0


def _finite(x: float) -> float | None:
    """x, or None where it is infinite."""
    return x if math.isfinite(x) else None
