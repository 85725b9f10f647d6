"""Whether a walk was feasible, step by step, and where it first was not.

`certificate` says what every single support needed. Here the walk is judged by it: an outcome in
one word, the reasons in words, and the extreme numbers over all steps (`Feasibility`). `until_infeasible`
cuts a walk at its first violation, for studies that count feasible steps only. `scenario.walk` calls
both.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.certificate import (
    IMPULSE,
    Support,
    after_last_impact,
    ended_in_impact,
    keeps,
    series,
    violation,
)
from biped_adrc.analysis.ground_force import Nodes
from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.robots.limits import SLIP, KnownLimits, Limits

VERDICTS = {
    "infeasible": "not feasible",
    "but_impact": "feasible but for the impact",
    "feasible": "feasible",
}
"""What steps that were all made are: word in records, and its meaning in reports."""
OUTCOMES = {
    "fell": "it fell",
    "ended": "it ended otherwise",
    **{word: f"it made all steps, {text}" for word, text in VERDICTS.items()},
}
"""Outcome of a walk: word in records, and its meaning in reports."""
COUNTED = ("feasible", "but_impact")
"""Outcomes of a walk that is feasible, the impact at most aside."""


def outcome_of(status: Status, broken: Collection[str]) -> str:
    """One of the words in `OUTCOMES`; broken: what is not within the limits, by the names in `REASONS`."""
    if status is Status.FELL:
        return "fell"
    if status is not Status.COMPLETED:
        return "ended"
    return verdict_of(broken)


def verdict_of(broken: Collection[str]) -> str:
    """One of the words in `VERDICTS`; broken as for `outcome_of`."""
    if not set(broken) <= {IMPULSE}:
        return "infeasible"
    return "but_impact" if broken else "feasible"


def because(words: str, broken: Mapping[str, str]) -> str:
    """Words, with the reasons behind where there are some."""
    return f"{words}: {'; '.join(broken.values())}" if broken else words


def _over_steps(worst: Callable[[list[float]], float], name: str, text: str) -> property:
    """A property: the least or largest value of one number over the single supports.

    By NumPy's functions, since a NaN has to show in the result, which Python's `min` and `max` may
    drop.
    """

    def found(feasibility: Feasibility) -> float:
        return float(worst([getattr(s, name) for s in feasibility.supports]))

    return property(found, doc=text)


@dataclass(frozen=True)
class Feasibility(Shown):
    """What the single supports of a walk needed, the last unfinished one included, compared with limits.

    The numbers below are extremes over all single supports, with the units of `Support`.
    """

    status: Status
    """How the simulation ended."""
    supports: tuple[Support, ...]
    """In order."""
    limits: KnownLimits
    """The limits that `reasons` refers to."""
    touchdowns: int
    """How many of the supports ended in one."""

    @cached_property
    def reasons(self) -> dict[str, str]:
        """Why it is not feasible: for each name in `REASONS` the first text, with the number of its step."""
        result: dict[str, str] = {}
        for s in self.supports:
            for name, text in s.infeasible().items():
                result.setdefault(name, f"step {s.step}: {text}")
        return result

    @property
    def outcome(self) -> str:
        """One of the words in `OUTCOMES`."""
        return outcome_of(self.status, self.reasons)

    @property
    def feasible_impacts(self) -> int:
        """Number of impacts before the first step that is not feasible."""
        broken = (k for k, s in enumerate(self.supports[: self.touchdowns]) if s.infeasible())
        return next(broken, self.touchdowns)

    mean_normal_force = _over_steps(np.min, "mean_normal_force", "Least of the means [N].")
    mean_friction = _over_steps(np.max, "mean_friction", "Largest of the means.")
    scuffing = _over_steps(np.max, "scuffing", "[m].")
    impulse_ratio = _over_steps(np.max, "impulse_ratio", "Of the impacts, 0 without one.")

    def text(self) -> str:
        """The outcome in words, with the reasons."""
        return because(OUTCOMES[self.outcome], self.reasons)


class Violation(NamedTuple):
    """Where a walk is infeasible first."""

    t: float
    """[s]."""
    support: int
    """In which of its single supports, from 0."""
    what: str
    """In words."""


def first_violation(
    walker: Walker, n: Nodes, k: KnownLimits, impacts: int, after: Array | None = None
) -> Violation | None:
    """The first node, impact, or end of a window of the mean force, at which a walk is infeasible; or None.

    impacts: how many of its single supports ended in one; after: as of `impulse_ratios`.
    """
    result = []
    for name, (t, of, x) in series(walker, n, k, impacts, after).items():
        for i in np.flatnonzero(~keeps(name, x, k))[:1]:
            result.append(Violation(float(t[i]), int(of[i]), violation(name, x[i], k)))
    return min(result, default=None, key=lambda one: one.t)


def until_infeasible(
    walker: Walker,
    trajectory: Trajectory,
    signals: Signals,
    limits: Limits | None = None,
    slipped: Sequence[float] | None = None,
) -> Trajectory:
    """The trajectory up to its first violation, with the status INFEASIBLE; itself where there is none.

    slipped: on soft ground, when in each single support a foot has slipped by SLIP [s], infinite for never.
    Everything before the violation is unchanged; the arc ends at the last node that is not after
    it.
    """
    k, arcs = (limits or Limits()).of(walker.plant.description), trajectory.arcs
    if slipped is not None:
        k = k._replace(friction=math.inf)
    impacts, after = sum(map(ended_in_impact, arcs)), after_last_impact(walker, trajectory)
    first = first_violation(walker, Nodes.of(signals), k, impacts, after)
    text = f"a foot slips by more than {1e3 * SLIP:g} mm"
    slips = [Violation(t, i, text) for i, t in enumerate(slipped or ()) if t < math.inf]
    result = min((*slips, *([first] if first else ())), default=None, key=lambda one: one.t)
    if result is None:
        return trajectory
    arc = arcs[result.support]
    kept = int(np.searchsorted(arc.t, result.t, side="right"))
    cut = replace(arc, t=arc.t[:kept], x=arc.x[:kept], dx=arc.dx[:kept], event=None)
    detail = f"single support {arc.mode.step}, {result.t:.4f} s: {result.what}"
    return replace(
        trajectory,
        arcs=(*arcs[: result.support], cut),
        status=Status.INFEASIBLE,
        detail=detail,
    )
