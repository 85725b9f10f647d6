"""How much the figures of merit of a run depend on its integration step: each at the step used and at half of
it.

A number that changes when the step is halved says something of the method and nothing of the robot. Two values
agree when they differ by at most 1 %, or by the resolution of the quantity: tracking errors of undisturbed
walks are themselves round-off, and their relative change is without meaning. For a quantity of order k in the
step, three steps h, h/2, h/4 show

    k = log2 (|y(h) - y(h/2)| / |y(h/2) - y(h/4)|)

Takes outcomes (`scenario.outcome.Outcome`) that hold the run at half the step in `half`. Called by
`paper.table` (checks), by `paper.reproduction` (all quantities) and by the command `simulate`, which prints
the error.

For feasibility the two runs have to agree as well: a walk that is feasible at one step and not at the other has
no verdict.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.paper.verdict import AtTwoSteps
from biped_adrc.scenario.outcome import Outcome

AGREE = 0.01
"""Largest relative difference of two values that agree."""
NEGLIGIBLE = 1e-6
"""[rad]: a smaller tracking error is none, whatever its digits."""
PEAK_RESOLUTION = 1e-9
"""Peak errors nearer than this are not told apart [rad]; undisturbed walks differ by 6e-10 at most at both
steps.
"""
RMS_RESOLUTION = 2e-10
"""The same for the root mean square [rad], where they differ by 1.3e-10 at most."""
MULTIPLIER_ROUND_OFF = 1e-4
"""Accuracy of a multiplier from finite differences of 1e-5 over a walk; a smaller one is not told from zero."""


@dataclass(frozen=True)
class Quantity:
    """A figure of merit of an outcome."""

    unit: str
    """Of its value; empty for a ratio."""
    resolution: float
    """Values nearer than this agree, in the same unit."""
    of: Callable[[Outcome], float]
    """The value of an outcome."""


class WalkEnd(NamedTuple):
    """What `error_text` says of a walk."""

    peak_error: float
    """[rad]"""
    status: str
    impacts: int


QUANTITIES: dict[str, Quantity] = {
    "peak error": Quantity("rad", PEAK_RESOLUTION, lambda o: o.peak_error),
    "rms error": Quantity("rad", RMS_RESOLUTION, lambda o: o.rms_error),
    "peak torque": Quantity("N m", 0.0, lambda o: o.peak_torque),
    "longest step": Quantity("s", 0.0, lambda o: float(np.max(o.durations, initial=0.0))),
    "shortest step": Quantity("s", 0.0, lambda o: float(np.min(o.durations, initial=math.inf))),
    "joint work of the last step": Quantity("J", 1e-6, lambda o: _last(o, "joint_work")),
    "energy lost at the last impact": Quantity("J", 1e-6, lambda o: _last(o, "energy_lost")),
    "least mean F_N": Quantity("N", 0.0, lambda o: _normal(o)),
    "largest mean friction": Quantity("", 0.0, lambda o: _friction(o)),
    "impulse ratio": Quantity("", 0.0, lambda o: _impulse(o)),
}
"""The figures of merit that are compared, by name."""


def _normal(o: Outcome) -> float:
    """The least normal force averaged over a window [N]; 0 where no window is long enough to say."""
    return o.feasibility.mean_normal_force if o.feasibility.supports else 0.0


def _friction(o: Outcome) -> float:
    """Largest averaged |F_T| / F_N; 0 where F_N <= 0: the ratio has a pole there, and F_N alone decides."""
    return o.feasibility.mean_friction if _normal(o) > 0.0 else 0.0


def _impulse(o: Outcome) -> float:
    """Largest |F_T| / F_N of an impact; 0 where the ground would have had to pull, where the ratio
    is infinite.
    """
    ratio = o.feasibility.impulse_ratio if o.feasibility.supports else 0.0
    return 0.0 if ratio == math.inf else ratio


def _last(o: Outcome, name: str) -> float:
    """A value of the last step's certificate; 0 where no step was finished."""
    return float(getattr(o.certificates[-1], name)) if o.certificates else 0.0


@dataclass(frozen=True)
class Halved:
    """One quantity at the step used and at half of it."""

    name: str
    """As in `QUANTITIES`."""
    unit: str
    """Of its values."""
    value: float
    """At the step used."""
    half: float
    """At half of it."""
    resolution: float
    """Values nearer than this agree."""

    @property
    def gap(self) -> float:
        """Their difference relative to the second; 0 within the resolution, infinite where a value is not
        finite.
        """
        if abs(self.value - self.half) <= self.resolution:
            return 0.0
        change = AtTwoSteps(self.value, self.half).change
        return math.inf if math.isnan(change) else change

    @property
    def agrees(self) -> bool:
        """Whether the difference is at most `AGREE`: the result does not depend on the step."""
        return self.gap <= AGREE

    def record(self) -> dict[str, object]:
        """In plain values, for the summary."""
        return {**vars(self), "gap": self.gap, "agrees": self.agrees}


def halved(o: Outcome) -> tuple[Halved, ...]:
    """Every quantity of an outcome at both steps; empty where it was not run twice."""
    if o.half is None:
        return ()
    return tuple(
        Halved(name, q.unit, q.of(o), q.of(o.half), q.resolution) for name, q in QUANTITIES.items()
    )


def largest_gap(o: Outcome) -> float:
    """The largest relative change of a figure of merit when every step is halved.

    Infinite where the two runs end differently; "feasible" and "not feasible" are different endings. A run that
    falls before its last impact has no figures of merit: only its ending has to be the same.
    """
    if _ending(o) != _ending(o.half):
        return math.inf
    return float(np.max([found.gap for found in halved(o)])) if o.walked else 0.0


def _ending(o: Outcome | None) -> tuple[str, int, str] | None:
    """Status, impacts and feasibility of a run."""
    return None if o is None else (o.status, o.impacts, o.feasibility.outcome)


def error_text(end: WalkEnd, half: WalkEnd) -> str:
    """The largest tracking error at both steps, with a hint where the step is too long for it."""
    text = f"{end.peak_error:.3e} rad ({half.peak_error:.3e} at half the step)"
    if end[1:] != half[1:]:
        ends = f"at half the step the walk ends as {half.status} after {half.impacts} impacts"
        return f"{text}; {ends}: shorten the step"
    errors = end.peak_error, half.peak_error
    if Halved("peak error", "rad", *errors, PEAK_RESOLUTION).agrees or max(errors) < NEGLIGIBLE:
        return text
    return f"{text}, the step decides it: shorten it"


def observed_order(o: Outcome, of: Callable[[Outcome], float]) -> float:
    """Order k of a quantity from the run, its half and its quarter; NaN where a difference is zero."""
    assert o.half is not None
    assert o.half.half is not None
    first, second, third = of(o), of(o.half), of(o.half.half)
    if first == second or second == third:
        return math.nan
    return math.log2(abs(first - second) / abs(second - third))


def records(named: dict[str, Outcome]) -> Iterator[dict[str, object]]:
    """A row for every quantity of every run that was run twice, for the summary."""
    for name, o in named.items():
        for found in halved(o):
            yield {"run": name, **found.record()}
