"""A number at the integration step used and at half of it, and whether the two agree.

A number that changes when the step is halved says something of the method and nothing of the robot. Two values
agree when they differ by at most 1 %, or by the resolution of the quantity: tracking errors of undisturbed
walks are themselves round-off. "Step" is the integration step here.
"""

import math
from typing import NamedTuple, Self

AGREE, ROUND_OFF = 0.01, 1e-9
"""A number has converged if halving the integration step changes it by at most the share AGREE, or by at most
ROUND_OFF in its unit [rad, s, 1]."""


class AtTwoSteps(NamedTuple):
    """A number at the integration step used and at half of it."""

    value: float
    at_half: float

    @classmethod
    def of(cls, x: Self | float) -> Self:
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

    def over(self, other: Self) -> Self:
        """This number over the other, at each of the two steps; infinite over zero."""
        return type(self)._make(a / b if b else math.inf for a, b in zip(self, other, strict=True))


NEGLIGIBLE = 1e-6
"""A tracking error below this [rad] counts as none, so that its digits need not converge."""
PEAK_RESOLUTION = 1e-9
"""Peak errors that differ by less than this count as equal [rad]; for undisturbed walks halving the integration
step changes them by 6e-10 at most."""
WalkEnd = tuple[float, str, int]
"""What `error_text` says of a walk: largest tracking error [rad], status, number of impacts."""


def error_text(shorter: str, end: WalkEnd, half: WalkEnd) -> str:
    """Text of the largest tracking error at both integration steps, end: of the walk at the step used, half: at
    half of it; where the two walks do not agree, with the hint `shorter`, the options for a shorter step.
    """
    errors = AtTwoSteps(end[0], half[0])  # [0]: the error; behind it status and number of impacts
    text = f"{errors.value:.3e} rad ({errors.at_half:.3e} at half the step)"
    if end[1:] != half[1:]:
        ends = f"at half the step the walk ends as {half[1]} after {half[2]} impacts"
        return f"{text}; {ends}: shorten the step, as {shorter}"
    if errors.converged(PEAK_RESOLUTION) or max(errors) < NEGLIGIBLE:
        return text
    return f"{text}: the integration step decides its digits; shorten it, as {shorter}"
