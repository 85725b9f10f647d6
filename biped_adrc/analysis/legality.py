"""Whether a walk was legal, step by step, and where it first was not.

`certificate` says what every single support needed. Here the walk is judged by it: an outcome in
one word, the reasons in words, and the extreme numbers over all steps (`Legality`). `until_illegal`
cuts a walk at its first violation, for studies that count legal steps only. `scenario.walk` calls
both.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.certificate import (
    Certificate,
    Support,
    depths,
    ended_in_impact,
    forces,
    largest_ratio,
    outside,
)
from biped_adrc.analysis.quadrature import window_means
from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.robots.limits import KnownLimits, Limits
from biped_adrc.shown import Shown
from biped_adrc.types import Array

OUTCOMES = {
    "fell": "it fell",
    "ended": "it ended otherwise",
    "made": "it made all steps, not all of them legally",
    "legal": "it made all steps legally",
}
"""Outcome of a walk: word in records, and its meaning in reports."""
NUMBERS = (
    "share_outside",
    "least_normal_force",
    "friction",
    "mean_normal_force",
    "mean_friction",
    "scuffing",
    "impulse_ratio",
    "peak_torque",
)
"""Numbers of `Legality` that its record holds."""


def outcome_of(status: Status, legal: bool) -> str:
    """One of the words in `OUTCOMES`."""
    if status is Status.FELL:
        return "fell"
    if status is not Status.COMPLETED:
        return "ended"
    return "legal" if legal else "made"


def _over_steps(worst: Callable[[list[float]], float], name: str, text: str) -> property:
    """A property: the least or largest value of one number over the single supports.

    By NumPy's functions, since a NaN has to show in the result, which Python's `min` and `max` may
    drop.
    """

    def found(legality: Legality) -> float:
        return float(worst([getattr(s, name) for s in legality.supports]))

    return property(found, doc=text)


@dataclass(frozen=True)
class Legality(Shown):
    """What the single supports of a walk needed, the last unfinished one included, compared with limits.

    The numbers below are extremes over all single supports, with the units of `Support`.
    """

    status: Status
    """How the simulation ended."""
    supports: tuple[Support, ...]
    """In order, finished ones as certificates."""
    impulse_ratio: float
    """Largest |F_T| / F_N of the impacts, 0 without one; it makes no step illegal."""
    limits: KnownLimits
    """The limits that `reasons` refers to."""
    touchdowns: int | None = None
    """How many of the supports ended in one; None: those that are certificates."""

    @property
    def reasons(self) -> dict[str, str]:
        """Why it is not legal: for each name in `REASONS` the first text, with the number of its step."""
        found: dict[str, str] = {}
        for s in self.supports:
            for name, text in s.illegal().items():
                found.setdefault(name, f"step {s.step}: {text}")
        return found

    @property
    def outcome(self) -> str:
        """One of the words in `OUTCOMES`."""
        return outcome_of(self.status, not self.reasons)

    @property
    def legal_impacts(self) -> int:
        """Number of impacts before the first step that is not legal."""
        ended = self.touchdowns
        if ended is None:
            ended = sum(isinstance(s, Certificate) for s in self.supports)
        broken = (k for k, s in enumerate(self.supports[:ended]) if s.illegal())
        return next(broken, ended)

    least_normal_force = _over_steps(np.min, "least_normal_force", "F_N at any instant [N].")
    friction = _over_steps(
        np.max, "friction", "At any instant; infinite where in a step the ground never pushed."
    )
    mean_normal_force = _over_steps(np.min, "mean_normal_force", "Least of the means [N].")
    mean_friction = _over_steps(np.max, "mean_friction", "Largest of the means.")
    scuffing = _over_steps(np.max, "scuffing", "[m].")
    peak_torque = _over_steps(np.max, "peak_torque", "[N m].")

    @property
    def share_outside(self) -> float:
        """Share of the time of the whole walk outside the friction cone, from 0 to 1."""
        time, share = zip(*((s.duration, s.share_outside) for s in self.supports), strict=True)
        return float(np.average(share, weights=time) if any(time) else np.max(share))

    def record(self) -> dict[str, object]:
        """Outcome, numbers and reasons as plain values; None where a number is not finite, such as a
        friction without contact.
        """
        numbers = {name: float(getattr(self, name)) for name in NUMBERS}
        return {
            "outcome": self.outcome,
            "legal_impacts": self.legal_impacts,
            **{name: x if math.isfinite(x) else None for name, x in numbers.items()},
            "reasons": self.reasons,
        }

    def text(self) -> str:
        """The outcome in words, with the reasons and the impulse ratio."""
        words = f"{OUTCOMES[self.outcome]} ({self.outcome})"
        reasons = "; ".join(self.reasons.values())
        if self.touchdowns is not None:
            return f"{words}: {reasons}" if reasons else words
        ratio = self.impulse_ratio
        impulse = f"{ratio:.2f}" if math.isfinite(ratio) else "no contact"
        beside = f"impulses at impact ask for friction {impulse}, limit {self.limits.friction:g}"
        return f"{words}: {reasons}; {beside}" if reasons else f"{words}; {beside}"


class Violation(NamedTuple):
    """The first violation in a single support."""

    t: float
    """[s]."""
    what: str
    """In words."""


def first_violation(
    walker: Walker, s: Signals, k: KnownLimits, finished: bool = True
) -> Violation | None:
    """The first node, or end of a window of the mean force, at which a single support is illegal; or None.

    s: the signals of this single support alone; finished: whether it ended in an impact.
    """
    ends, means = window_means(s.t, forces(walker, s), k.window)
    found: list[Violation] = []
    bad = np.flatnonzero(outside(means, k.friction))
    if len(bad):
        F, over = means[bad[0]], f"over {1e3 * k.window:g} ms"
        text = f"F_N = {F[1]:.3g} N {over}"
        if F[1] > 0.0:
            text = f"friction {largest_ratio(F[np.newaxis]):.3g} > {k.friction:g} {over}"
        found.append(Violation(float(ends[bad[0]]), text))
    torque = np.max(np.abs(s.u), axis=1, initial=0.0)
    found += _first(s.t, torque, k.torque, f"torque {{:.4g}} N m > {k.torque:g}")
    depth = depths(walker, s, finished)
    found += _first(s.t, depth, 0.0, "the swing foot scuffs by {:.2g} m")
    return min(found, default=None, key=lambda one: one.t)


def _first(t: Array, x: Array, limit: float, text: str) -> list[Violation]:
    """The first time t (K,) [s] at which x (K,) is above its limit or NaN, with its text; empty or one."""
    beyond = np.flatnonzero(~(x <= limit))
    return [Violation(float(t[i]), text.format(x[i])) for i in beyond[:1]]


def until_illegal(
    walker: Walker, trajectory: Trajectory, signals: Signals, limits: Limits | None = None
) -> Trajectory:
    """The trajectory up to its first violation, with the status ILLEGAL; itself where there is none.

    Everything before the violation is unchanged; the arc ends at the last node that is not after
    it.
    """
    k = (limits or Limits()).of(walker.plant.description)
    for number, arc in enumerate(trajectory.arcs):
        found = first_violation(walker, signals.of_step(arc.mode.step), k, ended_in_impact(arc))
        if found is None:
            continue
        kept = int(np.searchsorted(arc.t, found.t, side="right"))
        last = replace(arc, t=arc.t[:kept], x=arc.x[:kept], dx=arc.dx[:kept], event=None)
        detail = f"single support {arc.mode.step}, {found.t:.4f} s: {found.what}"
        arcs = (*trajectory.arcs[:number], last)
        return replace(trajectory, arcs=arcs, status=Status.ILLEGAL, detail=detail)
    return trajectory
