"""How much the figures of merit of a run depend on its integration step: each at the step used and at half of
it.

A number that changes when the step is halved says something of the method and nothing of the robot. Two values
agree when they differ by at most 1 %, or by the resolution of the quantity: tracking errors of undisturbed
walks are themselves round-off, and their relative change is without meaning. For a quantity of order k in the
step, three steps h, h/2, h/4 show

    k = log2 (|y(h) - y(h/2)| / |y(h/2) - y(h/4)|)

Takes outcomes (`scenario.recording.Outcome`) that hold the run at half the step in `half`. Called by
`paper.table` (checks) and by the command `simulate`, which prints the error.

For feasibility the two runs have to agree as well: a walk that is feasible at one step and not at the other has
no verdict.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.feasibility import Feasibility
from biped_adrc.paper.verdict import AtTwoSteps
from biped_adrc.scenario.recording import Outcome

NEGLIGIBLE = 1e-6
"""[rad]: a smaller tracking error is none, whatever its digits."""
PEAK_RESOLUTION = 1e-9
"""Peak errors nearer than this are not told apart [rad]; undisturbed walks differ by 6e-10 at most at both
steps.
"""
RMS_RESOLUTION = 2e-10
"""The same for the root mean square [rad], where they differ by 1.3e-10 at most."""


class Quantity(NamedTuple):
    """A figure of merit of an outcome."""

    of: Callable[[Outcome], float]
    """The value of an outcome."""
    resolution: float = 0.0
    """Values nearer than this agree."""


def _of_supports(of: Callable[[Feasibility], float]) -> Callable[[Outcome], float]:
    """A number of the judged steps; 0 where no window is long enough to say, and for a ratio at its pole."""

    def value(o: Outcome) -> float:
        x = of(o.feasibility) if o.feasibility.supports else 0.0
        return 0.0 if x == math.inf else x

    return value


def _last(name: str) -> Callable[[Outcome], float]:
    """A value of the last step's certificate; 0 where no step was finished."""
    return lambda o: float(getattr(o.certificates[-1], name)) if o.certificates else 0.0


QUANTITIES = (
    Quantity(lambda o: o.peak_error, PEAK_RESOLUTION),
    Quantity(lambda o: o.rms_error, RMS_RESOLUTION),
    Quantity(lambda o: o.peak_torque),
    Quantity(lambda o: float(np.max(o.durations, initial=0.0))),
    Quantity(lambda o: float(np.min(o.durations, initial=math.inf))),
    Quantity(_last("joint_work"), 1e-6),  # [J]
    Quantity(_last("energy_lost"), 1e-6),  # [J]
    Quantity(_of_supports(lambda f: f.mean_normal_force)),
    # friction has its pole at F_N = 0
    Quantity(_of_supports(lambda f: f.mean_friction if f.mean_normal_force > 0.0 else 0.0)),
    Quantity(_of_supports(lambda f: f.impulse_ratio)),
)
"""The figures of merit that are compared."""


def largest_gap(o: Outcome) -> float:
    """The largest relative change of a figure of merit when every step is halved.

    Infinite where the two runs end differently; "feasible" and "not feasible" are different endings. A run that
    falls before its last impact has no figures of merit: only its ending has to be the same.
    """
    assert o.half is not None
    one, half = ((x.status, x.impacts, x.feasibility.outcome) for x in (o, o.half))
    if one != half:
        return math.inf
    gaps = (AtTwoSteps(q.of(o), q.of(o.half)).gap(q.resolution) for q in QUANTITIES)
    return max(gaps) if o.walked else 0.0


WalkEnd = tuple[float, str, int]
"""What `error_text` says of a walk: largest tracking error [rad], status, number of impacts."""


def error_text(end: WalkEnd, half: WalkEnd) -> str:
    """The largest tracking error at both steps, with a hint where the step is too long for it."""
    errors = end[0], half[0]
    text = f"{errors[0]:.3e} rad ({errors[1]:.3e} at half the step)"
    if end[1:] != half[1:]:
        ends = f"at half the step the walk ends as {half[1]} after {half[2]} impacts"
        return f"{text}; {ends}: shorten the step"
    errors = AtTwoSteps(end[0], half[0])
    if errors.converged(PEAK_RESOLUTION) or max(errors) < NEGLIGIBLE:
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
