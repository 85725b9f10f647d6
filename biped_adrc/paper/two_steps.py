"""The figures of merit of a walk at the integration step used and at half of it.

The numbers of a walk are an `Outcome`, which has the same walk at half the step in `half`. "Step" is the
integration step here, "impact" the end of a walking step. `analysis.half_step` has one such number, and says
when its two values agree.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from biped_adrc.analysis.half_step import PEAK_RESOLUTION, AtTwoSteps
from biped_adrc.scenario.recording import Outcome


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
