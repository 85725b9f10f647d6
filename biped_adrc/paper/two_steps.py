"""Numbers at the integration step used and at half of it, and what their difference says.

A number that changes when the step is halved says something of the method and nothing of the robot. Two values
agree when they differ by at most 1 %, or by the resolution of the quantity: tracking errors of undisturbed
walks are themselves round-off. The numbers of a walk are an `Outcome`, which has the same walk at half the step
in `half`. "Step" is the integration step here, "impact" the end of a walking step.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from biped_adrc.scenario.recording import Outcome

AGREE, ROUND_OFF = 0.01, 1e-9
"""A number has converged if halving the integration step changes it by at most the share AGREE, or by at most
ROUND_OFF in its unit [rad, s, 1]."""


class AtTwoSteps(NamedTuple):
    """A number at the integration step used and at half of it."""

    value: float
    at_half: float

    @classmethod
    def of(cls, x: AtTwoSteps | float) -> AtTwoSteps:
        """x itself, or a number that needs no integration, which is the same at both steps."""
        return x if isinstance(x, AtTwoSteps) else cls(float(x), float(x))

    def gap(self, resolution: float = 0.0) -> float:
        """|value - at_half| / |at_half| [1]; 0 if they differ by at most `resolution`, in the unit of the
        number; infinite where one of them is not finite, or at_half is 0.
        """
        gap, size = abs(self.value - self.at_half), abs(self.at_half)
        if gap <= resolution:
            return 0.0
        return gap / size if size and math.isfinite(gap) else math.inf

    def converged(self, round_off: float = ROUND_OFF) -> bool:
        """Whether halving the step changes the number by at most the share `AGREE`, or by at most `round_off`,
        in the number's unit.

        Infinite at both steps counts as converged; NaN at either, such as of a search that failed, does not.
        """
        return self.value == self.at_half or self.gap(round_off) <= AGREE

    def over(self, other: AtTwoSteps) -> AtTwoSteps:
        """This number over the other, at each of the two steps; infinite over zero."""
        return AtTwoSteps(*(a / b if b else math.inf for a, b in zip(self, other, strict=True)))


class Extremes(tuple[float, ...]):
    """Numbers of which a text names the smallest and the largest: "{peaks:.2g}" becomes "0.011 to 0.034"."""

    @classmethod
    def of(cls, figures: Iterable[AtTwoSteps]) -> Extremes:
        """The values at half of the integration step, the more accurate ones."""
        return cls(f.at_half for f in figures)

    def __format__(self, form: str) -> str:
        """Text of the smallest and the largest value, each by the format `form`, ".3g" if empty; one number
        where both give the same text, "none" without a number. It also says how many values are NaN.
        """
        known = [v for v in self if not math.isnan(v)]
        if not known:
            return "none"
        low, high = (f"{v:{form or '.3g'}}" for v in (min(known), max(known)))
        text = low if low == high else f"{low} to {high}"
        unknown = len(self) - len(known)
        return f"{text} ({unknown} are no numbers)" if unknown else text


NEGLIGIBLE = 1e-6
"""A tracking error below this [rad] counts as none, so that its digits need not converge."""
PEAK_RESOLUTION = 1e-9
"""Peak errors that differ by less than this count as equal [rad]; for undisturbed walks halving the integration
step changes them by 6e-10 at most."""
RMS_RESOLUTION = 2e-10
"""Root mean squares this near count as equal [rad]; undisturbed walks change by 1.3e-10 at most."""


def compared(o: Outcome) -> tuple[tuple[float, float], ...]:
    """The figures of merit of a walk that are compared at two integration steps: pairs (value, resolution),
    both in the unit of the value; two values agree when they differ by at most the resolution.

    Numbers that would not converge are replaced by 0: forces that are infinite, as where no single support is
    long enough for a mean, and the friction where F_N <= 0, as the ratio F_T / F_N has its pole at F_N = 0. F_T
    and F_N are the force of the ground along it and out of it. A resolution of 0 asks for 1 % alone.
    """
    # f: extremes over the walk; last: work and energy of the last finished walking step
    f, last = o.feasibility, o.certificates[-1] if o.certificates else None
    forces = (f.mean_normal_force, f.mean_friction, f.impulse_ratio) if f.supports else (0.0,) * 3
    normal, friction, impulse = (0.0 if x == math.inf else x for x in forces)
    return (
        (o.peak_error, PEAK_RESOLUTION),
        (o.rms_error, RMS_RESOLUTION),
        (o.peak_torque, 0.0),
        (float(np.max(o.durations, initial=0.0)), 0.0),
        (float(np.min(o.durations, initial=math.inf)), 0.0),
        (last.joint_work if last else 0.0, 1e-6),  # [J]
        (last.energy_lost if last else 0.0, 1e-6),  # [J]
        (normal, 0.0),
        (friction if normal > 0.0 else 0.0, 0.0),
        (impulse, 0.0),
    )


def largest_gap(o: Outcome) -> float:
    """The largest relative change [1] of a figure of merit from o to o.half, which has half the integration
    steps.

    Infinite where the two runs end differently; "feasible" and "not feasible" are different endings. A run that
    falls before its last impact has no figures of merit: only its ending has to be the same.
    """
    assert o.half is not None
    one, half = ((x.status, x.impacts, x.feasibility.outcome) for x in (o, o.half))
    if one != half:
        return math.inf
    # near: the difference below which two values count as equal
    pairs = zip(compared(o), compared(o.half), strict=True)
    return max(AtTwoSteps(x, y).gap(near) for (x, near), (y, _) in pairs) if o.walked else 0.0


WalkEnd = tuple[float, str, int]
"""What `error_text` says of a walk: largest tracking error [rad], status, number of impacts."""


def error_text(end: WalkEnd, half: WalkEnd) -> str:
    """Text of the largest tracking error at both integration steps, end: of the walk at the step used, half: at
    half of it; with a hint to shorten the step where the two walks do not agree.
    """
    errors = AtTwoSteps(end[0], half[0])  # [0]: the error; behind it status and number of impacts
    text = f"{errors.value:.3e} rad ({errors.at_half:.3e} at half the step)"
    if end[1:] != half[1:]:
        ends = f"at half the step the walk ends as {half[1]} after {half[2]} impacts"
        return f"{text}; {ends}: shorten run.h"
    if errors.converged(PEAK_RESOLUTION) or max(errors) < NEGLIGIBLE:
        return text
    return f"{text}: the step decides it, shorten run.h"


def order_of_error(o: Outcome) -> float:
    """Observed order k [1] in which the peak tracking error e converges with the integration step h; NaN if two
    of the errors are equal.

    k = log2 (|e(h) - e(h/2)| / |e(h/2) - e(h/4)|), from the outcomes o, o.half and o.half.half of the same walk
    """
    assert o.half is not None
    assert o.half.half is not None
    first, second, third = (x.peak_error for x in (o, o.half, o.half.half))
    if first == second or second == third:
        return math.nan
    return math.log2(abs(first - second) / abs(second - third))
