"""One verdict: a statement, the scenarios on which it is tried, a metric, its limit, and the word they give.

    Claim(name, where, statement, limit, metric, scenarios)

`paper.table` has all of them: what the paper claims, and the laws and consistencies that every run is held
against. A case is one scenario with the value of the metric at the integration step used and at half of it; it
is marginal where the number is not converged, or the limit is kept at one step and not at the other. Of the
cases of a claim, h that hold and m marginal ones:

    no case, or all marginal    not testable
    h = all cases (m = 0)       replicated
    h = 0                       contradicted
    otherwise                   depends, on the variant of the scenario, which the share names

A number that changes when the step is halved says something of the method and nothing of the robot. Two values
agree when they differ by at most 1 %, or by the resolution of the quantity: tracking errors of undisturbed
walks are themselves round-off. Outcomes (`scenario.recording.Outcome`) hold the run at half the step in `half`.

Words for a reader are in claims.toml. In braces stand {limit}, {found} (the least and the largest number of the
cases) and what `Claim.values` gives.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from biped_adrc.analysis.feasibility import Feasibility
from biped_adrc.core.files import packaged
from biped_adrc.core.verdict import Check, at_least, at_most
from biped_adrc.scenario.recording import Outcome

if TYPE_CHECKING:
    from biped_adrc.paper.runs import Results


REPLICATED, DEPENDS, CONTRADICTED = "replicated", "depends", "contradicted"
NOT_TESTABLE = "not testable"
CLAIM = "claim"
"""Kind of a statement of the paper, which is judged over all its cases."""
AGREE, ROUND_OFF = 0.01, 1e-9
"""A number moves by less than this share when the step is halved, or by less than this [rad], [s], [1]."""
SHOWN = 8
"""Variants on which a claim may depend that are named."""
Limit = Callable[[str, str, float], Check]
"""Makes the check of (name, kind, value), such as partial(at_most, limit=0.01)."""


class AtTwoSteps(NamedTuple):
    """A number at the integration step used and at half of it."""

    value: float
    at_half: float

    @classmethod
    def of(cls, x: AtTwoSteps | float) -> AtTwoSteps:
        """A number; one without a step is the same at both."""
        return x if isinstance(x, AtTwoSteps) else cls(float(x), float(x))

    def gap(self, resolution: float = 0.0) -> float:
        """|value - at_half| / |at_half|; 0 within the resolution, infinite where one of them is not finite."""
        gap, size = abs(self.value - self.at_half), abs(self.at_half)
        if gap <= resolution:
            return 0.0
        return gap / size if size and math.isfinite(gap) else math.inf

    def converged(self, round_off: float = ROUND_OFF) -> bool:
        """Whether halving the step moves it by at most the share `AGREE`, or at most by `round_off`.

        Infinite at both steps counts as converged; NaN at either, such as of a search that failed, does not.
        """
        return self.value == self.at_half or self.gap(round_off) <= AGREE

    def over(self, other: AtTwoSteps) -> AtTwoSteps:
        """One over the other at either step; infinite over zero."""
        return AtTwoSteps(*(a / b if b else math.inf for a, b in zip(self, other, strict=True)))


class Case(NamedTuple):
    """One scenario on which a claim was tried."""

    name: str
    """For a reader."""
    figure: AtTwoSteps
    """The metric."""
    holds: bool
    """Whether it keeps the limit, at half of the step."""
    marginal: bool
    """Whether it is not converged, or keeps the limit at one of the steps alone."""
    variant: str
    """What of the scenario the verdict may depend on."""

    @property
    def kept(self) -> bool:
        """Whether it holds, and is not marginal."""
        return self.holds and not self.marginal


@dataclass(frozen=True)
class Claim:
    """A statement, the scenarios on which it is tried, and the limit that its metric has to keep."""

    name: str
    """Of its texts in claims.toml."""
    where: str
    """Place in the paper."""
    statement: str
    """What is claimed."""
    limit: Limit
    """That the number has to keep."""
    metric: Callable[[Any], AtTwoSteps | float] = lambda x: x
    """The number of one scenario, which may be its own."""
    scenarios: Callable[[Results], Mapping[str, Any]] = lambda _: {}
    """What was computed of each scenario, by its name for a reader; none where no run can decide."""
    variant: Callable[[str, Any], str] = lambda name, _: name
    """What of (name, scenario) the verdict may depend on; a few words for all scenarios together."""
    values: Callable[[Results], Mapping[str, object]] = lambda _: {}
    """Numbers for the texts."""
    round_off: float = ROUND_OFF
    """Change at half of the step that is none, in the unit of the metric."""

    def cases(self, r: Results) -> tuple[Case, ...]:
        """All scenarios with the metric and what it comes to."""
        return tuple(self._case(name, x) for name, x in self.scenarios(r).items())

    def _case(self, name: str, x: Any) -> Case:
        figure = AtTwoSteps.of(self.metric(x))
        used, half = (self.limit("", CLAIM, value).holds for value in figure)
        doubtful = used != half or not figure.converged(self.round_off)
        return Case(name, figure, half, doubtful, self.variant(name, x))


@dataclass(frozen=True)
class Row:
    """A claim of the paper with what became of it, in words."""

    claim: str
    where: str
    word: str
    number: str
    """The numbers found."""
    limit: str
    """What the metric has to keep."""
    share: str
    """How many cases hold, in words, by variant where it depends."""
    reason: str
    """Why the word is what it is."""
    finding: str = ""
    """One line for the head of the report and the terminal, of a main finding."""
    asserted: float | None = None
    """Share of the cases that hold, of a claim that a check asks to hold in all; else None."""
    marginal: int = 0
    """Number of its cases that are not converged."""


def texts() -> dict[str, Any]:
    """The tables of claims.toml."""
    return packaged("biped_adrc.paper", "claims.toml")


def word_of(cases: Sequence[Case]) -> str:
    """The word for the cases of a claim, as in the head of this module."""
    if all(case.marginal for case in cases):
        return NOT_TESTABLE
    if all(case.kept for case in cases):
        return REPLICATED
    return DEPENDS if any(case.kept for case in cases) else CONTRADICTED


def row_of(claim: Claim, r: Results) -> Row:
    """The row of a claim of the paper; of one without scenarios, with the word that claims.toml has for it."""
    words, cases = texts()[claim.name], claim.cases(r)
    word = words.get("word") or word_of(cases)
    limit = claim.limit("", CLAIM, math.nan).limit if "metric" in words else ""
    figures = Extremes.of(case.figure for case in cases)
    values = {"limit": limit, "found": figures, **claim.values(r)}
    number, reason, finding = (
        str(words.get(key, "")).format(**values) for key in ("number", "reason", "finding")
    )
    return Row(
        claim.statement.format(**values),
        claim.where,
        word,
        number,
        f"{words['metric']} {limit}" if limit else "",
        share_text(cases, word == DEPENDS),
        reason,
        finding,
        sum(case.kept for case in cases) / max(len(cases), 1) if words.get("asserted") else None,
        sum(case.marginal for case in cases),
    )


def share_text(cases: Sequence[Case], apart: bool) -> str:
    """How many cases hold; apart: by variant too. Marginal ones are named."""
    if not cases:
        return ""
    every = Counter(case.variant for case in cases)
    held = Counter(case.variant for case in cases if case.kept)
    text = f"{held.total()} of {len(cases)}"
    if apart and len(every) <= SHOWN:
        text += ": " + "; ".join(f"{name} {held[name]} of {n}" for name, n in every.items())
    marginal = [case.name for case in cases if case.marginal]
    return f"{text}; marginal: {', '.join(marginal)}" if marginal else text


def claim_checks(rows: Sequence[Row]) -> list[Check]:
    """The checks of the claims, for the exit code of the reproduction.

    Claims that are said to be replicated have to stay so: all of their cases hold. And no case of any claim may
    change its number or verdict at half of the step.
    """
    doubtful = "claims: cases whose number or verdict is another at half the step"
    shares = (
        at_least(
            f"claim, {row.where}: {row.claim}: share of its cases", "reproduced", row.asserted, 1.0
        )
        for row in rows
        if row.asserted is not None
    )
    return [at_most(doubtful, "law", sum(row.marginal for row in rows), 0), *shares]


def tally(rows: Iterable[Row]) -> str:
    """How many claims have which word, in the order of the words."""
    result = Counter(row.word for row in rows)
    return ", ".join(f"{word} {result[word]}" for word in texts()["words"])


class Extremes(tuple[float, ...]):
    """Numbers of which a text names the smallest and the largest: "{peaks:.2g}" becomes "0.011 to 0.034"."""

    @classmethod
    def of(cls, figures: Iterable[AtTwoSteps]) -> Extremes:
        """The numbers at half of the step."""
        return cls(f.at_half for f in figures)

    def __format__(self, form: str) -> str:
        """NaN is counted and said."""
        known = [v for v in self if not math.isnan(v)]
        if not known:
            return "none"
        low, high = (f"{v:{form or '.3g'}}" for v in (min(known), max(known)))
        text = low if low == high else f"{low} to {high}"
        unknown = len(self) - len(known)
        return f"{text} ({unknown} are no numbers)" if unknown else text


NEGLIGIBLE = 1e-6
"""[rad]: a smaller tracking error is none, whatever its digits."""
PEAK_RESOLUTION = 1e-9
"""Peak errors nearer than this are not told apart [rad]; undisturbed walks differ by 6e-10 at most at both
steps.
"""
RMS_RESOLUTION = 2e-10
"""The same for the root mean square [rad], where they differ by 1.3e-10 at most."""


def _of_supports(of: Callable[[Feasibility], float]) -> Callable[[Outcome], float]:
    """A number of the judged steps; 0 where no window is long enough to say, and for a ratio at its pole."""

    def value(o: Outcome) -> float:
        x = of(o.feasibility) if o.feasibility.supports else 0.0
        return 0.0 if x == math.inf else x

    return value


def _last(name: str) -> Callable[[Outcome], float]:
    """A value of the last step's certificate; 0 where no step was finished."""
    return lambda o: float(getattr(o.certificates[-1], name)) if o.certificates else 0.0


QUANTITIES: tuple[tuple[Callable[[Outcome], float], float], ...] = (
    (lambda o: o.peak_error, PEAK_RESOLUTION),
    (lambda o: o.rms_error, RMS_RESOLUTION),
    (lambda o: o.peak_torque, 0.0),
    (lambda o: float(np.max(o.durations, initial=0.0)), 0.0),
    (lambda o: float(np.min(o.durations, initial=math.inf)), 0.0),
    (_last("joint_work"), 1e-6),  # [J]
    (_last("energy_lost"), 1e-6),  # [J]
    (_of_supports(lambda f: f.mean_normal_force), 0.0),
    # friction has its pole at F_N = 0
    (_of_supports(lambda f: f.mean_friction if f.mean_normal_force > 0.0 else 0.0), 0.0),
    (_of_supports(lambda f: f.impulse_ratio), 0.0),
)
"""The figures of merit that are compared: of an outcome, and the resolution within which two values agree."""


def largest_gap(o: Outcome) -> float:
    """The largest relative change of a figure of merit when every step is halved.

    Infinite where the two runs end differently; "feasible" and "not feasible" are different endings. A run that
    falls before its last impact has no figures of merit: only its ending has to be the same.
    """
    assert o.half is not None
    one, half = ((x.status, x.impacts, x.feasibility.outcome) for x in (o, o.half))
    if one != half:
        return math.inf
    gaps = (AtTwoSteps(of(o), of(o.half)).gap(resolution) for of, resolution in QUANTITIES)
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
    """Order k of a quantity from the run, its half and its quarter; NaN where a difference is zero.

    k = log2 (|y(h) - y(h/2)| / |y(h/2) - y(h/4)|)
    """
    assert o.half is not None
    assert o.half.half is not None
    first, second, third = of(o), of(o.half), of(o.half.half)
    if first == second or second == third:
        return math.nan
    return math.log2(abs(first - second) / abs(second - third))
