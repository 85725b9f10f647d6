"""The words for claims, and the rules by which cases earn them; pure functions of numbers."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple

from biped_adrc.checks import Check, at_least, at_most
from biped_adrc.resources import packaged
from biped_adrc.studies.claims.admissible import convergence, declared
from biped_adrc.viz.report import CLAIM_COLUMNS

REPLICATED = "replicated"
DEPENDS = "depends"
CONTRADICTED = "contradicted"
NOT_TESTABLE = "not testable"


@cache
def texts() -> dict[str, Any]:
    """The file claims.toml: the rows of the table in words, by name."""
    return dict(_joined(packaged("biped_adrc.studies.claims", "claims.toml")))


def _joined(value: Any) -> Any:
    """Texts of several lines as one."""
    if isinstance(value, dict):
        return {name: _joined(x) for name, x in value.items()}
    return " ".join(value.split()) if isinstance(value, str) else value


PREFACE: str = texts()["preface"]
"""What the report says before the table."""
MEANINGS: dict[str, str] = texts()["words"]
"""Every word, and what it says of a claim."""


class Figure(NamedTuple):
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


class Case(NamedTuple):
    """One of the choices under which a claim was tried."""

    name: str
    figure: Figure
    """What the verdict rests on."""
    holds: bool
    marginal: bool = False
    """The figure is not converged, or the verdict at half of the step is another."""


def below_limit(
    name: str, figure: Figure, limit: float, bound: Sequence[float] | None = None
) -> Case:
    """A case that holds for a number <= limit; NaN does not hold. bound: as of `Figure.converged`."""
    return _limited(name, figure, lambda x: x <= limit, bound)


def above_limit(name: str, figure: Figure, limit: float) -> Case:
    """A case that holds for a number >= limit; NaN does not hold."""
    return _limited(name, figure, lambda x: x >= limit)


def _limited(
    name: str, figure: Figure, test: Callable[[float], bool], bound: Sequence[float] | None = None
) -> Case:
    used, half = (bool(test(x)) for x in figure)
    doubtful = not figure.converged(*(bound or convergence())) or used != half
    return Case(name, figure, half, doubtful)


@dataclass(frozen=True)
class Tally:
    """What a set of cases comes to. No claim rests on the marginal ones."""

    cases: tuple[Case, ...]
    declared: int = 0
    """How many cases the set has, all presets included; a quick run has fewer."""

    @property
    def firm(self) -> tuple[Case, ...]:
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
        from biped_adrc.studies.bench.statistics import share

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


def changes(figures: Sequence[Figure], relevant: float = 0.01) -> str:
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


@dataclass(frozen=True)
class Claim:
    """One row of the table.

    asserted: share of the cases that hold, of a claim that a check of the reproduction asks to hold in all.
    marginal: number of its cases that are not converged.
    """

    claim: str
    where: str
    word: str
    number: str
    reason: str
    share: str = ""
    convergence: str = ""
    asserted: float | None = None
    marginal: int = 0

    def __post_init__(self) -> None:
        if self.word not in MEANINGS:
            raise ValueError(f"word '{self.word}' is none of {list(MEANINGS)}")

    def record(self) -> dict[str, Any]:
        """As plain values, the columns of the table."""
        return {key: getattr(self, key) for key in CLAIM_COLUMNS}


def limited(
    name: str,
    figures: Iterable[tuple[str, Figure]],
    limit: float,
    declared: int,
    bound: Sequence[float] | None = None,
    **values: Any,
) -> Claim:
    """The row of a claim whose cases, (name, figure) each, hold for a number <= limit; further as of `row`."""
    cases = tuple(below_limit(case, figure, limit, bound) for case, figure in figures)
    return row(name, Tally(cases, declared), **values)


def judged(
    claim: str, where: str, tally: Tally, number: str, reason: str, asserted: bool = False
) -> Claim:
    """The row of a claim that was tried on cases; `asserted` makes a check of it."""
    value = tally.held / len(tally.cases) if tally.cases else math.nan
    said = (tally.word, number, reason, tally.share, tally.convergence)
    return Claim(claim, where, *said, value if asserted else None, len(tally.marginal))


def against(found: int, count: int) -> str:
    """The word for a claim against which so many of so many cases speak."""
    if found == 0:
        return NOT_TESTABLE
    return CONTRADICTED if found == count else DEPENDS


def row(name: str, tally: Tally, **values: Any) -> Claim:
    """The row of claims.toml for a claim that was tried on cases, with these values in its texts."""
    x = _said(name, values)
    asserted = bool(x.get("asserted"))
    return judged(x["claim"], x["where"], tally, x["number"], x["reason"], asserted=asserted)


def told(name: str, word: str = "", values: Mapping[str, Any] | None = None, **rest: Any) -> Claim:
    """The row of claims.toml with these values in its texts, and a word that no tally gives.

    word: that of the file by default. rest: of `Claim`.
    """
    said = _said(name, values or {})
    word = word or said["word"]
    return Claim(said["claim"], said["where"], word, said["number"], said["reason"], **rest)


def _said(name: str, values: Mapping[str, Any]) -> dict[str, Any]:
    found = texts()[name]
    found = {**texts().get(found.get("like"), {}), **found}
    of = {"limit": declared()["limits"], **values}
    return {key: x.format(**of) if isinstance(x, str) else x for key, x in found.items()}


def claim_checks(claims: Sequence[Claim]) -> list[Check]:
    """Every claim that is said to be replicated has to stay so: all of its cases hold, none is marginal.

    And no case of any claim may be marginal.
    """
    kind = "reproduced"
    doubtful = "claims: cases whose number or verdict is another at half the step"
    shares = (
        at_least(f"claim, {c.where}: {c.claim}: share of its cases", kind, c.asserted, 1.0)
        for c in claims
        if c.asserted is not None
    )
    return [at_most(doubtful, "law", sum(c.marginal for c in claims), 0), *shares]


class Span(tuple[float, ...]):
    """Numbers of which a text names the smallest and the largest."""

    @classmethod
    def of(cls, figures: Iterable[Figure]) -> Span:
        """At half of the step."""
        return cls(f.at_half for f in figures)

    def __format__(self, form: str) -> str:
        return span(self, form or ".3g")


def span(values: Sequence[float], form: str = ".3g") -> str:
    """From the smallest to the largest; NaN is said."""
    known = [v for v in values if not math.isnan(v)]
    if not known:
        return "none"
    low, high = f"{min(known):{form}}", f"{max(known):{form}}"
    text = low if low == high else f"{low} to {high}"
    return text + (
        f" ({len(values) - len(known)} are no numbers)" if len(known) < len(values) else ""
    )
