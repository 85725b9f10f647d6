"""Whether a walk was feasible, step by step, and where it first was not.

`certificate` has the numbers of every single support. Here they decide about the walk: an outcome in one word,
the reasons in words, and the extreme numbers over all steps (`Feasibility`). `until_infeasible` cuts a walk at
its first violation, for studies that count feasible steps only. `scenario.walk` calls both.

A node is an instant at which the run keeps its state, an arc the nodes of one single support. A mean force is
that of the ground over a short window that ends at a node. F_N and F_T are the force of the ground out of it
and along it. "Broken" limits are those that a step does not keep, by their names in `certificate.REASONS`. On
soft ground a simulator with contacts limits the friction itself, and the distance that feet slip is judged in
its place.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.certificate import (
    AT_NODES,
    IMPULSE,
    OF_JOINTS,
    Support,
    after_last_impact,
    at_ends,
    ended_in_impact,
    joint_of,
    keeps,
    violation,
)
from biped_adrc.analysis.ground_force import Nodes, demands
from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.ground import SLIP, KnownLimits, Limits

OUTCOMES = {
    "fell": "it fell",
    "ended": "it ended otherwise",
    "infeasible": "it made all steps, not feasible",
    "but_impact": "it made all steps, feasible but for the impact",
    "feasible": "it made all steps, feasible",
}
"""Outcome of a walk: word in records -> its meaning in reports."""
COUNTED = ("feasible", "but_impact")
"""Outcomes of a walk that is feasible, or feasible except for the impulses at impact."""


def outcome_of(status: Status, broken: Collection[str]) -> str:
    """Outcome of a walk, a word in `OUTCOMES`, from its status and the broken limits, names in `REASONS`.

    A walk that was not completed and did not fall has "ended", whatever it broke.
    """
    if status is Status.FELL:
        return "fell"
    if status is not Status.COMPLETED:
        return "ended"
    # IMPULSE: name of the limit on the impulse at impact, which alone makes a walk "but_impact"
    if not set(broken) <= {IMPULSE}:
        return "infeasible"
    return "but_impact" if broken else "feasible"


def _over_steps(worst: Callable[[list[float]], float], name: str, text: str) -> property:
    """Make a property: the extreme, by `worst`, of the field `name` over the single
    supports; text: its docstring.

    `worst` is NumPy's function, since a NaN has to show in the result, which Python's
    `min` and `max` may drop.
    """

    def found(feasibility: Feasibility) -> float:
        return float(worst([getattr(s, name) for s in feasibility.supports]))

    return property(found, doc=text)


@dataclass(frozen=True)
class Feasibility(Shown):
    """Extremes of a walk's single supports, the last unfinished one included, and whether
    they are within the limits.

    The numbers below are extremes over all single supports, with the units of `Support`.
    """

    status: Status
    """How the simulation ended."""
    supports: tuple[Support, ...]
    """The single supports, in order."""
    touchdowns: int
    """Number of the supports that ended in a touchdown, the first ones."""

    @cached_property
    def broken(self) -> list[dict[str, str]]:
        """For each single support the limits that it breaks: name in `REASONS` -> sentence."""
        return [s.infeasible() for s in self.supports]

    @cached_property
    def reasons(self) -> dict[str, str]:
        """Why the walk is not feasible: for each name in `REASONS` the first text,
        with the number of its step.
        """
        result: dict[str, str] = {}
        for s, broken in zip(self.supports, self.broken, strict=True):
            for name, text in broken.items():
                result.setdefault(name, f"step {s.step}: {text}")
        return result

    @property
    def outcome(self) -> str:
        """The outcome, a word in `OUTCOMES`."""
        return outcome_of(self.status, self.reasons)

    @property
    def feasible_impacts(self) -> int:
        """Number of impacts before the first step that is not feasible; all of them where each step is."""
        infeasible = (k for k, broken in enumerate(self.broken[: self.touchdowns]) if broken)
        return next(infeasible, self.touchdowns)

    mean_normal_force = _over_steps(np.min, "mean_normal_force", "Least mean F_N [N].")
    mean_friction = _over_steps(np.max, "mean_friction", "Largest mean |F_T| / F_N [1].")
    scuffing = _over_steps(np.max, "scuffing", "Largest depth of scuffing [m].")
    riser = _over_steps(np.max, "riser", "Largest depth of scuffing before risers [m].")
    peak_torque = _over_steps(np.max, "peak_torque", "Largest |u_i| [N m].")
    impulse_ratio = _over_steps(
        np.max, "impulse_ratio", "Largest |F_T| / F_N of an impulse, 0 without impact."
    )

    def text(self) -> str:
        """The outcome in words, with the reasons."""
        # OUTCOMES: outcome -> its text
        return ": ".join(filter(None, (OUTCOMES[self.outcome], "; ".join(self.reasons.values()))))


class Violation(NamedTuple):
    """The first limit that a walk violates."""

    t: float
    """Time of the violation [s]."""
    support: int
    """Index of its single support, from 0."""
    what: str
    """The violation in words."""


def first_violation(
    walker: Walker, n: Nodes, k: KnownLimits, impacts: int, after: Array | None = None
) -> Violation | None:
    """Find the first node, impact, or end of a window of the mean force, at which a walk
    violates a limit; or None.

    n: its nodes. k: the limits. impacts: number of its single supports that ended in an impact. after (2,)
    [N s]: momentum just after the impact with which the walk ends, as no node follows it, else None.
    """
    # the first violation of each kind; a number that is one per single support counts at its end
    result = []
    # rows 0 to 5: the numbers of AT_NODES; rows 6 to 8: the joint that has each of the last three
    needed, _ = demands(walker, n, k.window, impacts)
    which = dict(zip(OF_JOINTS, needed[len(AT_NODES) :], strict=False)) if n.p else {}
    # numbers: what the limits apply to, by the limit's name; not strict: the rows of joints are left out
    numbers = dict(zip(AT_NODES, needed, strict=False)) | at_ends(walker, n, k, impacts, after)
    for name, x in numbers.items():
        # [:1]: the first only, if there is any
        for i in np.flatnonzero(~keeps(name, x, k))[:1]:
            # AT_NODES: names of the numbers that exist at each node, others at the end of a support
            at = i if name in AT_NODES else n.last[i]
            has = name in which  # whether the number belongs to one joint
            joint = joint_of(walker.plant, which[name][i], n.at.step[i]) if has else None
            support = int(np.searchsorted(n.last, at))
            text = violation(name, x[i], k, joint)
            result.append(Violation(float(n.at.t[at]), support, text))
    return min(result, default=None, key=lambda one: one.t)


def until_infeasible(
    walker: Walker,
    trajectory: Trajectory,
    signals: Signals,
    limits: Limits | None = None,
    slipped: Sequence[float] | None = None,
) -> Trajectory:
    """Cut a trajectory at its first violation, with the status INFEASIBLE; without one it is returned as it is.

    signals: those of the trajectory. limits: None for those of the robot's record. slipped: on soft ground, the
    time [s] in each single support when a foot has slipped by SLIP, infinite for never; it counts in place of
    the friction cone. Everything before the violation is unchanged; the arc ends at the last node that is not
    after it.
    """
    k, arcs = (limits or Limits()).of(walker.plant.description), trajectory.arcs
    if slipped is not None:
        k = k._replace(friction=math.inf)
    # first: the first violation at a node or impact; slips: those of the feet; the earlier one cuts the walk
    impacts, after = sum(map(ended_in_impact, arcs)), after_last_impact(walker, trajectory)
    first = first_violation(walker, Nodes.of(signals), k, impacts, after)
    text = f"a foot slips by more than {1e3 * SLIP:g} mm"
    slips = [Violation(t, i, text) for i, t in enumerate(slipped or ()) if t < math.inf]
    result = min((*slips, *([first] if first else ())), default=None, key=lambda one: one.t)
    if result is None:
        return trajectory
    arc = arcs[result.support]
    # number of the arc's nodes up to the violation; the arc then ends without an event
    kept = int(np.searchsorted(arc.t, result.t, side="right"))
    cut = replace(arc, t=arc.t[:kept], x=arc.x[:kept], dx=arc.dx[:kept], event=None)
    detail = f"single support {arc.mode.step}, {result.t:.4f} s: {result.what}"
    arcs = *arcs[: result.support], cut
    return replace(trajectory, arcs=arcs, status=Status.INFEASIBLE, detail=detail)
