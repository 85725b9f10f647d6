"""From the cases of a claim to one word: "replicated", "depends", "contradicted" or "not testable".

A case is one admissible choice under which the claim was tried. It is marginal where its number is not
converged in the integration step, or its verdict is another at half of the step; no claim rests on marginal
cases. A claim is replicated only when every case declared is firm and holds, contradicted when none holds, and
depends on the choice otherwise. Called by the rows (`rows_*`); the words are defined for the reader in
claims.toml.

Of cases that were run, with h firm cases that hold and m marginal ones:

    no firm case             not testable
    h = all cases (m = 0)    replicated
    h = 0                    contradicted
    otherwise                depends
"""

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
    """A number at the integration step used and at half of it."""

    value: float
    at_half: float

    @property
    def change(self) -> float:
        """|value - at_half| / |at_half|; NaN where one of them is not finite."""
        if not (math.isfinite(self.value) and math.isfinite(self.at_half)):
            return math.nan
        gap = abs(self.value - self.at_half)
        return gap / abs(self.at_half) if self.at_half else (0.0 if gap == 0.0 else math.inf)

    def converged(self, convergence: float, round_off: float) -> bool:
        """Whether halving the step moves the number by at most the share `convergence`, or at most by
        `round_off`.

        Infinite at both steps counts as converged; NaN at either, such as of a search that failed, does not.
        """
        if self.value == self.at_half:
            return True
        return self.change <= convergence or abs(self.value - self.at_half) <= round_off


class ClaimCase(NamedTuple):
    """One of the choices under which a claim was tried."""

    name: str
    """For a reader."""
    figure: AtTwoSteps
    """The number on which the verdict rests."""
    holds: bool
    """The verdict, at half of the step."""
    marginal: bool = False
    """Whether the number is not converged, or the verdict at the step used is another."""


def below_limit(
    name: str, figure: AtTwoSteps, limit: float, bound: Sequence[float] | None = None
) -> ClaimCase:
    """A case that holds for a number <= limit; NaN does not hold.

    bound: (share, round-off) as of `AtTwoSteps.converged`, those of admissible.toml by default.
    """
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
    """A case that holds where `test` is true of its number at half of the step.

    It is marginal where the number is not converged, or the test has another result at the step used.
    """
    used, half = (bool(test(x)) for x in figure)
    doubtful = not figure.converged(*(bound or convergence())) or used != half
    return ClaimCase(name, figure, half, doubtful)


@dataclass(frozen=True)
class Tally:
    """The cases of a claim, and what they come to."""

    cases: tuple[ClaimCase, ...]
    """Those that were run."""
    declared: int = 0
    """How many cases the claim has, all presets included; a quick run has fewer."""

    @property
    def firm(self) -> tuple[ClaimCase, ...]:
        """The cases that are not marginal."""
        return tuple(case for case in self.cases if not case.marginal)

    @property
    def marginal(self) -> tuple[str, ...]:
        """Names of the marginal cases."""
        return tuple(case.name for case in self.cases if case.marginal)

    @property
    def held(self) -> int:
        """How many firm cases hold."""
        return sum(case.holds for case in self.firm)

    @property
    def word(self) -> str:
        """The verdict. A marginal case is none, so that "replicated" needs every case to be firm
        and to hold.
        """
        if not self.firm:
            return NOT_TESTABLE
        if self.held == len(self.cases):
            return REPLICATED
        return DEPENDS if self.held else CONTRADICTED

    @property
    def share(self) -> str:
        """How many cases hold, in words, with Wilson's interval, and the marginal cases by name."""
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
    """The remark on a run with fewer cases than were declared; empty for a full one."""
    return f"; {count} of the {declared} cases declared were run" if count < declared else ""


def changes(figures: Sequence[AtTwoSteps], relevant: float = 0.01) -> str:
    """The largest change of numbers when the step is halved, in words; empty for counts.

    Numbers that change by more than the share `relevant`, though they were taken as converged, are round-off:
    of these the absolute change is said.
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
    """The word for a claim that `found` of `count` cases speak against."""
    if found == 0:
        return NOT_TESTABLE
    return CONTRADICTED if found == count else DEPENDS
