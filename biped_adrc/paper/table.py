"""The one table: every claim of the paper, and every law and consistency by which its reproduction is checked.

A case is one scenario with the value of the metric at the integration step used and at half of it; it is
marginal if the number is not converged, or the limit is kept at one of the two and not at the other. A claim is
a statement of the paper, from the abstract to its last section, judged over all its cases, of which h hold and
m are marginal:

    no case, or all marginal    not testable
    h = all cases (m = 0)       replicated
    h = 0                       contradicted
    otherwise                   depends, on the variant of the scenario, which the share names

Claims are in claims.toml. Checks, by which the reproduction itself is checked, are in checks.toml: there every
scenario is a check of its own, whose kind (`core.verdict`) says what a broken check means:

    law           the program is wrong: physics or numerics
    consistency   a gait does not do what it was designed for
    reproduced    the paper's statement does not hold for this robot

The table of a claim or a check in its file (`said` in arguments) has its words, and by name the scenarios, the
metric ("measure") and the values for its texts. A name is that of a function in one of the modules `ROOMS`, or
of an attribute of the results `Runs`; words behind it are its first arguments. In braces of the words stand
{limit}, {found} (the least and the largest number of the cases) and those values. A variant is the choice in a
scenario on which a verdict may depend, in words. Limits, and the choices under which claims are tried, are in
admissible.toml, which was written before the runs.
"""

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from operator import attrgetter, methodcaller
from typing import Any, NamedTuple, Self

from biped_adrc.analysis.half_step import ROUND_OFF, AtTwoSteps
from biped_adrc.core.files import packaged
from biped_adrc.core.verdict import Check, at_least, at_most, below, between
from biped_adrc.paper import metrics, physical_laws, values
from biped_adrc.paper.runs import Runs
from biped_adrc.paper.scenarios import declared

ROOMS = (metrics, values, physical_laws)
"""Modules of functions that claims.toml and checks.toml name."""
CLAIM = "claim"
"""Kind of a statement of the paper, which is judged over all its cases."""
_SHOWN = 8
"""Most variants, on which a claim depends, that a text names."""
_Bound = Callable[[str, str, float], Check]
"""Makes the check of (name, kind, value), such as partial(at_most, limit=0.01)."""


class Probe(NamedTuple):
    """One scenario on which a claim was tried."""

    name: str
    """Name of the scenario, for a reader."""
    figure: AtTwoSteps
    """Value of the metric at both integration steps."""
    holds: bool
    """Whether the value at half of the integration step keeps the limit."""
    marginal: bool
    """Whether the value is not converged, or keeps the limit at one of the two integration steps alone."""
    variant: str
    """The choice in the scenario on which the verdict may depend, in words."""

    @classmethod
    def of(
        cls, name: str, figure: AtTwoSteps, limit: _Bound, round_off: float, variant: str | None
    ) -> Self:
        """Compare the metric of a scenario, `figure`, with a limit at both integration steps.

        limit: makes the check of a value. round_off: largest change by halving the step that counts as none, in
        the unit of the metric. variant: as the field; the scenario's name if None.
        """
        # of each check only whether it holds: name and kind have no effect on that
        used, half = (limit("", CLAIM, value).holds for value in figure)
        doubtful = used != half or not figure.converged(round_off)
        return cls(name, figure, half, doubtful, name if variant is None else variant)

    @property
    def kept(self) -> bool:
        """Whether the claim holds in this case, and not only marginally."""
        return self.holds and not self.marginal


class Claim(NamedTuple):
    """A claim of the paper with what became of it, in words."""

    claim: str
    """The statement."""
    where: str
    """Its place in the paper."""
    word: str
    """The verdict, one of the words in the head of this module."""
    number: str
    """Text with the values of the metric."""
    limit: str
    """Name of the metric, and the limit that it has to keep."""
    share: str
    """Text of how many cases hold; for a claim that depends, for each variant."""
    reason: str
    """Text of why the verdict is this one."""
    finding: str = ""
    """One line for the head of the report and the terminal, of a main finding."""
    asserted: float | None = None
    """Share of the cases that hold, for a claim of which a check demands that all hold; None for others."""
    marginal: int = 0
    """Number of its cases that are not converged."""


def all_texts() -> dict[str, Any]:
    """The tables of claims.toml."""
    return packaged("biped_adrc.paper", "claims.toml")


def word_of_claim(cases: Sequence[Probe]) -> str:
    """The verdict on a claim from its cases, as the head of this module says; "not testable" without a case."""
    # `all` of no case is true
    if all(case.marginal for case in cases):
        return "not testable"
    if all(case.kept for case in cases):
        return "replicated"
    return "depends" if any(case.kept for case in cases) else "contradicted"


def share_text(cases: Sequence[Probe], apart: bool) -> str:
    """Text of how many cases hold, such as "3 of 4", which names the marginal ones; empty without a case.

    apart: whether it also counts the cases of each variant, unless there are more than _SHOWN variants.
    """
    if not cases:
        return ""
    every = Counter(case.variant for case in cases)
    held = Counter(case.variant for case in cases if case.kept)
    text = f"{held.total()} of {len(cases)}"
    if apart and len(every) <= _SHOWN:
        text += ": " + "; ".join(f"{name} {held[name]} of {n}" for name, n in every.items())
    marginal = [case.name for case in cases if case.marginal]
    return f"{text}; marginal: {', '.join(marginal)}" if marginal else text


def limit(text: str) -> _Bound:
    """A function (name, kind, value) -> `Check` with the limit that a text such as "<= 0.01" or "in 0.9 1.1"
    (between these) means; of "<= ratio" the number is the entry "ratio" of the limits in admissible.toml.
    """
    sign, *words = text.split()
    bounds = [_number(word) for word in words]
    if sign == "in":
        return partial(between, low=bounds[0], high=bounds[1])
    return partial({"<=": at_most, ">=": at_least, "<": below}[sign], limit=bounds[0])


def _number(text: str) -> float:
    """The number that a text is, or the limit that it names in admissible.toml."""
    return float(declared()["limits"].get(text, text))


def _function(text: str) -> Callable[..., Any]:
    """The function of `ROOMS` that the first word of a text names, with the other words as its first arguments.

    If none of these modules has it, the name is an attribute of the object with which the result is called; if
    other words follow, a method of that object.
    """
    name, *words = text.split()
    for room in ROOMS:
        if hasattr(room, name):
            return partial(getattr(room, name), *words)
    return methodcaller(name, *words) if words else attrgetter(name)


def cases(said: Mapping[str, Any], r: Runs) -> tuple[Probe, ...]:
    """The cases of a claim or a check: each of its scenarios with its metric and whether that keeps the limit.

    said: its table in the file. Empty without scenarios, as of a claim that no run can decide. A scenario
    without a measure is itself its number.
    """
    if "scenarios" not in said:
        return ()
    # _function: the function that a text names
    measure = _function(said["measure"]) if "measure" in said else AtTwoSteps.of
    # without a variant `Probe.of` takes the scenario's name
    variant = _function(said["variant"]) if "variant" in said else None
    bound, round_off = limit(said["limit"]), _number(said.get("round_off", str(ROUND_OFF)))
    return tuple(
        Probe.of(name, AtTwoSteps.of(measure(x)), bound, round_off, variant and variant(x))
        for name, x in _function(said["scenarios"])(r).items()
    )


def row_of(said: Mapping[str, Any], r: Runs) -> Claim:
    """Judge a claim of the paper and fill in its texts; said: its table in claims.toml.

    A word that this table has, as for a claim that no run can decide, replaces the verdict of the cases.
    """
    of_claim = cases(said, r)
    word = said.get("word") or word_of_claim(of_claim)
    # a check without name and value, made for the text of its limit alone, such as "<= 0.01"
    bound = limit(said["limit"])("", CLAIM, math.nan).limit if "limit" in said else ""
    values = {"limit": bound, "found": metrics.Extremes.of(case.figure for case in of_claim)}
    # more numbers for the texts, by name, from the function that the table names
    values |= _function(said["values"])(r) if "values" in said else {}
    # names: the texts of the table that have places for these values; share: of the cases that are kept
    names = ("claim", "number", "reason", "finding")
    share = sum(c.kept for c in of_claim) / max(len(of_claim), 1)
    return Claim(
        where=said["where"],
        word=word,
        limit=f"{said['metric']} {bound}" if bound else "",
        share=share_text(of_claim, word == "depends"),
        asserted=share if said.get("asserted") else None,
        marginal=sum(c.marginal for c in of_claim),
        **{name: str(said.get(name, "")).format(**values) for name in names},
    )


def rows(r: Runs) -> list[Claim]:
    """Every claim of claims.toml with what became of it, in the order of that file and of the report."""
    # other tables of the file, such as [words], have no "claim"
    named = (said for said in all_texts().values() if isinstance(said, dict))
    return [row_of(said, r) for said in named if "claim" in said]


def findings(r: Runs, of_claims: Iterable[Claim]) -> list[str]:
    """One line for each main finding: those of the judged claims `of_claims`, then those of the table [beyond]
    of claims.toml, of which the paper says nothing. r: the results, from which the latter have their numbers.
    """
    beyond = all_texts()["beyond"].values()
    of_others = [said["finding"].format(**_function(said["values"])(r)) for said in beyond]
    return [row.finding for row in of_claims if row.finding] + of_others


def checks(r: Runs, of_claims: list[Claim]) -> list[Check]:
    """All checks of a reproduction: those of checks.toml, judged at the integration step used, and those of the
    judged claims `of_claims`.
    """
    result = []
    for said in packaged("biped_adrc.paper", "checks.toml")["check"]:
        for case in cases(said, r):
            text = ": ".join(filter(None, (case.name, said.get("statement"))))
            # limit(..) reads a text such as "<= 0.01" and returns the function (name, kind, value) -> `Check`
            result.append(limit(said["limit"])(text, said["kind"], case.figure.value))
    return [*result, *claim_checks(of_claims)]


def claim_checks(rows: Sequence[Claim]) -> list[Check]:
    """The checks of the claims, for the exit code of the reproduction.

    Of a claim that claims.toml marks as `asserted` all cases have to hold. And no case of any claim may change
    its number or verdict at half of the step: their number has to be 0.
    """
    doubtful = "claims: cases whose number or verdict is another at half the step"
    result = [at_most(doubtful, "law", sum(row.marginal for row in rows), 0)]
    for row in rows:
        if row.asserted is not None:
            name = f"claim, {row.where}: {row.claim}: share of its cases"
            result.append(at_least(name, "reproduced", row.asserted, 1.0))
    return result


def tally(rows: Iterable[Claim]) -> str:
    """Text of how many claims have each verdict, such as "replicated 9, depends 2", in the order of the table
    [words] of claims.toml.
    """
    result = Counter(row.word for row in rows)
    return ", ".join(f"{word} {result[word]}" for word in all_texts()["words"])
