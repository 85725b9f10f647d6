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
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.certificate import (
    IMPULSE,
    Support,
    depths,
    ended_in_impact,
    forces,
    impulse_ratio,
    impulse_text,
    largest_ratio,
    outside,
)
from biped_adrc.analysis.quadrature import window_means
from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.robots.limits import ROUND_OFF, SLIP, KnownLimits, Limits
from biped_adrc.shown import Shown
from biped_adrc.types import Array

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
NUMBERS = (
    "share_outside",
    "least_normal_force",
    "friction",
    "mean_normal_force",
    "mean_friction",
    "scuffing",
    "slip",
    "impulse_ratio",
    "peak_torque",
)
"""Numbers of `Feasibility` that its record holds."""


def outcome_of(status: Status, broken: Collection[str]) -> str:
    """One of the words in `OUTCOMES`; broken: what is not within the limits, by the names in `REASONS`."""
    if status is Status.FELL:
        return "fell"
    if status is not Status.COMPLETED:
        return "ended"
    return verdict_of(broken)


def verdict_of(broken: Collection[str]) -> str:
    """One of the words in `VERDICTS`; broken as for `outcome_of`."""
    if not but_for_the_impact(broken):
        return "infeasible"
    return "but_impact" if broken else "feasible"


def because(words: str, broken: Mapping[str, str]) -> str:
    """Words, with the reasons behind where there are some."""
    return f"{words}: {'; '.join(broken.values())}" if broken else words


def but_for_the_impact(broken: Collection[str]) -> bool:
    """Whether no limit is broken, but for that on the impulse at impact."""
    return set(broken) <= {IMPULSE}


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

    @property
    def reasons(self) -> dict[str, str]:
        """Why it is not feasible: for each name in `REASONS` the first text, with the number of its step."""
        found: dict[str, str] = {}
        for s in self.supports:
            for name, text in s.infeasible().items():
                found.setdefault(name, f"step {s.step}: {text}")
        return found

    @property
    def outcome(self) -> str:
        """One of the words in `OUTCOMES`."""
        return outcome_of(self.status, self.reasons)

    @property
    def feasible_impacts(self) -> int:
        """Number of impacts before the first step that is not feasible."""
        broken = (k for k, s in enumerate(self.supports[: self.touchdowns]) if s.infeasible())
        return next(broken, self.touchdowns)

    least_normal_force = _over_steps(np.min, "least_normal_force", "F_N at any instant [N].")
    friction = _over_steps(
        np.max, "friction", "At any instant; infinite where in a step the ground never pushed."
    )
    mean_normal_force = _over_steps(np.min, "mean_normal_force", "Least of the means [N].")
    mean_friction = _over_steps(np.max, "mean_friction", "Largest of the means.")
    scuffing = _over_steps(np.max, "scuffing", "[m].")
    slip = _over_steps(np.max, "slip", "On soft ground [m].")
    peak_torque = _over_steps(np.max, "peak_torque", "[N m].")
    impulse_ratio = _over_steps(np.max, "impulse_ratio", "Of the impacts, 0 without one.")

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
            "feasible_impacts": self.feasible_impacts,
            **{name: x if math.isfinite(x) else None for name, x in numbers.items()},
            "reasons": self.reasons,
        }

    def text(self) -> str:
        """The outcome in words, with the reasons."""
        return because(OUTCOMES[self.outcome], self.reasons)


class Violation(NamedTuple):
    """The first violation in a single support."""

    t: float
    """[s]."""
    what: str
    """In words."""


def first_violation(
    walker: Walker, s: Signals, k: KnownLimits, finished: bool = True
) -> Violation | None:
    """The first node, or end of a window of the mean force, at which a single support is infeasible; or None.

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
    for number, arc in enumerate(arcs):
        t = math.inf if slipped is None else slipped[number]
        slips = Violation(t, f"a foot slips by more than {1e3 * SLIP:g} mm")
        force = first_violation(walker, signals.of_step(arc.mode.step), k, ended_in_impact(arc))
        every = (force, _at_impact(walker, arc, k), slips)
        found = min((one for one in every if one is not None), key=lambda one: one.t)
        if found.t == math.inf:
            continue
        kept = int(np.searchsorted(arc.t, found.t, side="right"))
        last = replace(arc, t=arc.t[:kept], x=arc.x[:kept], dx=arc.dx[:kept], event=None)
        detail = f"single support {arc.mode.step}, {found.t:.4f} s: {found.what}"
        return replace(
            trajectory, arcs=(*arcs[:number], last), status=Status.INFEASIBLE, detail=detail
        )
    return trajectory


def _at_impact(walker: Walker, arc: Arc, k: KnownLimits) -> Violation | None:
    """The impact that ends an arc, where its impulse leaves the friction cone; else None."""
    ratio = impulse_ratio(walker, arc)
    beyond = not ratio <= (1.0 + ROUND_OFF) * k.friction
    return Violation(float(arc.t[-1]), impulse_text(ratio, k)) if beyond else None
