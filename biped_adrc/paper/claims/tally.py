"""Cases of a claim, their numbers at a step and at half of it, and the word that they earn."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from biped_adrc.paper.claims.admissible import convergence

REPLICATED = "replicated"
DEPENDS = "depends"
CONTRADICTED = "contradicted"
NOT_TESTABLE = "not testable"


class AtTwoSteps(NamedTuple):
    """A number at the step used and at half of it."""

    value: float
    at_half: float

    @property
    def change(self) -> float:
        """|value - at_half| over |at_half|; NaN where one is not finite."""
        if not (math.isfinite(self.value) and math.isfinite(self.at_half)):
            return math.nan
        gap = abs(self.value - self.at_half)
        return gap / abs(self.at_half) if self.at_half else (0.0 if gap == 0.0 else math.inf)

    def converged(self, convergence: float, round_off: float) -> bool:
        """Whether halving the step moves it by less than a share or than round-off.

        What is infinite at both is; what is no number at one, such as of a search that failed, is not.
        """
        if self.value == self.at_half:
            return True
        return self.change <= convergence or abs(self.value - self.at_half) <= round_off


class ClaimCase(NamedTuple):
    """One of the choices under which a claim was tried."""

    name: str
    figure: AtTwoSteps
    """What the verdict rests on."""
    holds: bool
    marginal: bool = False
    """The figure is not converged, or the verdict at half of the step is another."""


def below_limit(
    name: str, figure: AtTwoSteps, limit: float, bound: Sequence[float] | None = None
) -> ClaimCase:
    """A case that holds for a number <= limit; NaN does not hold. bound: as of `AtTwoSteps.converged`."""
    return _limited(name, figure, lambda x: x <= limit, bound)


def above_limit(name: str, figure: AtTwoSteps, limit: float) -> ClaimCase:
    """A case that holds for a number >= limit; NaN does not hold."""
    return _limited(name, figure, lambda x: x >= limit)


def _limited(
    name: str,
    figure: AtTwoSteps,
    test: Callable[[float], bool],
    bound: Sequence[float] | None = None,
) -> ClaimCase:
    used, half = (bool(test(x)) for x in figure)
    doubtful = not figure.converged(*(bound or convergence())) or used != half
    return ClaimCase(name, figure, half, doubtful)


@dataclass(frozen=True)
class Tally:
    """What a set of cases comes to. No claim rests on the marginal ones."""

    cases: tuple[ClaimCase, ...]
    declared: int = 0
    """How many cases the set has, all presets included; a quick run has fewer."""

    @property
    def firm(self) -> tuple[ClaimCase, ...]:
        """Those that are not marginal."""
        return tuple(case for case in self.cases if not case.marginal)

    @property
    def marginal(self) -> tuple[str, ...]:
        """Names of the others."""
        return tuple(case.name for case in self.cases if case.marginal)

    @property
    def held(self) -> int:
        """How many firm cases hold."""
        return sum(case.holds for case in self.firm)

    @property
    def word(self) -> str:
        """Replicated only when every case declared is firm and holds."""
        if not self.firm:
            return NOT_TESTABLE
        if self.held == len(self.cases):
            return REPLICATED
        return DEPENDS if self.held else CONTRADICTED

    @property
    def share(self) -> str:
        """In words, with Wilson's interval, and the marginal cases by name."""
        from biped_adrc.analysis.statistics import share

        text = "no case is converged"
        if self.firm:
            found = share(self.held, len(self.firm))
            between = f"between {found.low:.2f} and {found.high:.2f} with 95 %"
            text = f"{self.held} of {len(self.firm)}, {between}"
        text += fewer(len(self.cases), self.declared)
        if self.marginal:
            text += f"; marginal: {'; '.join(self.marginal)}"
        return text

    @property
    def convergence(self) -> str:
        """The largest change when the step is halved, over the firm cases with finite numbers."""
        return changes([case.figure for case in self.firm])


def fewer(count: int, declared: int) -> str:
    """What a share says of a run with fewer cases than were declared."""
    return f"; {count} of the {declared} cases declared were run" if count < declared else ""


def changes(figures: Sequence[AtTwoSteps], relevant: float = 0.01) -> str:
    """The largest change of numbers when the step is halved, in words; nothing for counts.

    Numbers that change by more than the share `relevant` and were taken as converged are round-off: of them
    the change itself is said.
    """
    if all(f.value == f.at_half for f in figures):
        return ""
    known = [f for f in figures if math.isfinite(f.change)]
    if not known:
        return "no finite number"
    small = [abs(f.value - f.at_half) for f in known if f.change > relevant]
    parts = [f.change for f in known if f.change <= relevant]
    said = [f"at most {100.0 * max(parts):.2g} %"] if parts else []
    said += [f"round-off, at most {max(small):.1g}, in {len(small)}"] if small else []
    return f"half the step: {'; '.join(said)}"


def against(found: int, count: int) -> str:
    """The word for a claim against which so many of so many cases speak."""
    if found == 0:
        return NOT_TESTABLE
    return CONTRADICTED if found == count else DEPENDS
