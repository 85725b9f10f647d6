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

import numpy as np

from biped_adrc.analysis.certificate import IMPULSE, Support, after_last_impact, first_violation
from biped_adrc.analysis.ground_force import Nodes
from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Walker
from biped_adrc.core.shown import Shown
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.ground import Limits

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
    impacts, after = len(trajectory.events(FOOT_STRIKE)), after_last_impact(walker, trajectory)
    result = first_violation(walker, Nodes.of(signals), k, impacts, after, slipped or ())
    if result is None:
        return trajectory
    arc = arcs[result.support]
    # number of the arc's nodes up to the violation; the arc then ends without an event
    kept = int(np.searchsorted(arc.t, result.t, side="right"))
    cut = replace(arc, t=arc.t[:kept], x=arc.x[:kept], dx=arc.dx[:kept], event=None)
    detail = f"single support {arc.mode.step}, {result.t:.4f} s: {result.what}"
    arcs = *arcs[: result.support], cut
    return replace(trajectory, arcs=arcs, status=Status.INFEASIBLE, detail=detail)
