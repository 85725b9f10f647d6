"""What is counted in a walk, as columns of a row: of the meter of a rigid walk, of the signals of a soft one.

On the rigid plant the meter counts at sample instants while the robot walks (`hardware.meter`), so that a
trajectory is stored only where touchdowns have to be noticed. On another plant the row is read off the signals,
which are recorded from tick to tick. There a friction is what the ground gave, so it is never above that of the
ground; what a walk asked in vain is in `slip`, `flight` and how it ended; and impulses of an impact are not
told apart from the forces after it.

A number may be infinite or NaN here; `bench.run` leaves out what is not finite.
"""

from __future__ import annotations

import math

import numpy as np

from biped_adrc.analysis.certificate import REASONS
from biped_adrc.analysis.contact_errors import contact_errors
from biped_adrc.analysis.legality import outcome_of
from biped_adrc.engine.batch import BatchWalk, Case
from biped_adrc.hardware.meter import LARGEST_RATIO, Reading, reading
from biped_adrc.hybrid.status import Status
from biped_adrc.scenario.recording import Walk
from biped_adrc.types import Array

WalkRow = dict[str, float | int | str | None]
"""Results by column name."""

BY_METER = ("peak_error", "peak_torque", "work", "net_work", "peak_matched", "peak_unmatched")
"""Columns that the meter counts under the same names: errors [rad], torques [N m], work [J], xi [rad/s^2]."""
OF_LEGALITY = (
    "least_normal_force",
    "friction",
    "share_outside",
    "mean_normal_force",
    "mean_friction",
    "scuffing",
)
"""Columns that `Legality` has under the same names."""


def by_meter(made: Case, walked: BatchWalk) -> WalkRow:
    """What the meter counted: root mean squares over ticks and joints, and legality.

    Forces averaged over the window of `Limits` decide; peaks at single ticks are reported beside them. A ratio
    F_T / F_N without a positive normal force has no number.
    """
    w = made.walker
    g = reading(w.held_at(walked.final_state).g)
    count, legal, known = max(g.ticks, 1.0), g.illegal_step == 0.0, g.windows > 0.0
    of_joints = count * w.plant.p
    before = walked.impacts if legal else int(min(g.illegal_step - made.mode.step, walked.impacts))
    impulse = walked.impacts > 0 and g.impulse_ratio < LARGEST_RATIO
    return {
        **{name: getattr(g, name) for name in BY_METER},
        "rms_error": math.sqrt(g.square_error / of_joints),
        "rms_torque": math.sqrt(g.square_torque / of_joints),
        **_judged(walked.status, legal, before, _broken(made, g)),
        "least_normal_force": g.least_normal_force if g.ticks > 0.0 else None,
        "friction": g.friction if 0.0 < g.friction < LARGEST_RATIO else None,
        "share_outside": g.outside / count,
        "mean_normal_force": g.mean_normal_force if known else None,
        "mean_friction": g.mean_friction if known and g.mean_friction > 0.0 else None,
        "scuffing": g.scuffing,
        "impulse_ratio": g.impulse_ratio if impulse else None,
    }


def _broken(made: Case, g: Reading) -> dict[str, bool]:
    """Whether each limit of the robot's record was broken, by what the meter says."""
    k = made.walker.meter.limits.of(made.walker.plant.description)  # type: ignore[union-attr]
    return {
        "normal_force": g.windows > 0.0 and not g.mean_normal_force > 0.0,
        "friction": not g.mean_friction <= k.friction,
        "torque": not g.peak_torque <= k.torque,
        "scuffing": not g.scuffing <= 0.0,
        "impulse": not g.impulse_ratio <= k.friction,
    }


def by_signals(made: Walk) -> WalkRow:
    """The same of the signals of a walk, and what its feet did and when touchdowns were noticed."""
    x, found = made.signals, made.legality
    ticks = np.flatnonzero(np.diff(x.t) > 0.0)
    u, turned = x.u[ticks], np.diff(x.q[:, : x.u.shape[1]], axis=0)[ticks]
    broken = {name: name in found.reasons for name in REASONS}
    return {
        "peak_error": _largest(x.error),
        "rms_error": _rms(x.error[ticks]),
        "peak_torque": _largest(x.u),
        "rms_torque": _rms(u),
        "work": float(np.sum(np.abs(u) * np.abs(turned))),
        "net_work": float(np.sum(u * turned)),
        "peak_matched": _largest(x.xi_matched),
        "peak_unmatched": _largest(x.xi_unmatched),
        **contact_errors(x)._asdict(),
        **_on_the_ground(made),
        **({} if made.walker.touchdown is None else made.touchdowns.rates._asdict()),
        **_judged(found.status, not any(broken.values()), found.legal_impacts, broken),
        **{name: getattr(found, name) for name in OF_LEGALITY},
    }


def _on_the_ground(made: Walk) -> WalkRow:
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


def _judged(status: Status, legal: bool, legal_impacts: int, broken: dict[str, bool]) -> WalkRow:
    """The columns of legality that are no measure; broken: whether each limit was, by name."""
    outcome = outcome_of(status, legal)
    return {
        "outcome": outcome,
        "legal": int(outcome == "legal"),
        "legal_impacts": legal_impacts,
        **{f"bad_{name}": int(bad) for name, bad in broken.items()},
    }


def _largest(x: Array) -> float:
    """Largest absolute value, 0 of nothing."""
    return float(np.max(np.abs(x), initial=0.0))


def _rms(x: Array) -> float:
    """Root of the mean square, 0 of nothing."""
    return math.sqrt(float(np.mean(x**2))) if x.size else 0.0
