"""The rows of the table of claims: the texts of claims.toml with the values of the runs in them.

Wording is kept apart from computing: claims.toml has for each claim where the paper says it, what the number
means and why the word is what it is, with braces for values; "like" takes the texts of another claim. The rows
(`rows_*`) compute values and call `limited`, `row` or `told`.

An entry of claims.toml, whose check is part of the reproduction since it is asserted:

    [unaffected]
    claim = "Figure 6: the limit cycle of ADRC 'has not been affected by the external disturbances'"
    where = "VI"
    number = "change of Theta' at the impact after the push: ADRC at most {adrc:.1e} rad/s, ..."
    reason = "holds up to {limit[cycle]:g} rad/s. ..."
    asserted = true
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from biped_adrc.checks import Check, at_least, at_most
from biped_adrc.paper.claims.admissible import declared
from biped_adrc.paper.claims.tally import AtTwoSteps, Tally, below_limit
from biped_adrc.resources import packaged
from biped_adrc.viz.pages import CLAIM_COLUMNS


@cache
def texts() -> dict[str, Any]:
    """The tables of claims.toml by name of the claim, each text on one line."""
    said = packaged("biped_adrc.paper.claims", "claims.toml")
    return {name: _joined(x) for name, x in said.items()}


def _joined(value: object) -> object:
    """The value with the lines of each text joined to one."""
    if isinstance(value, dict):
        return {name: _joined(x) for name, x in value.items()}
    return " ".join(value.split()) if isinstance(value, str) else value


PREFACE: str = texts()["preface"]
"""What the report says before the table."""
MEANINGS: dict[str, str] = texts()["words"]
"""Every word of a verdict, and what it says of a claim."""


@dataclass(frozen=True)
class Claim:
    """One row of the table. Raises ValueError for a word that is not defined."""

    claim: str
    """What the paper says."""
    where: str
    """Its section."""
    word: str
    """The verdict, one of `MEANINGS`."""
    number: str
    """The numbers found."""
    reason: str
    """Why the word is what it is."""
    share: str = ""
    """How many cases hold, in words."""
    convergence: str = ""
    """How far the numbers change at half of the step."""
    asserted: float | None = None
    """Share of the cases that hold, of a claim that a check of the reproduction asks to hold in
    all; else None.
    """
    marginal: int = 0
    """Number of its cases that are not converged."""

    def __post_init__(self) -> None:
        if self.word not in MEANINGS:
            raise ValueError(f"word '{self.word}' is none of {list(MEANINGS)}")

    def record(self) -> dict[str, object]:
        """In plain values, the columns of the table."""
        return {key: getattr(self, key) for key in CLAIM_COLUMNS}


def limited(
    name: str,
    figures: Iterable[tuple[str, AtTwoSteps]],
    limit: float,
    declared: int,
    bound: Sequence[float] | None = None,
    **values: object,
) -> Claim:
    """The row of a claim whose cases (name, number) hold for a number <= limit.

    bound: as of `AtTwoSteps.converged`; values: in the texts.
    """
    cases = tuple(below_limit(case, figure, limit, bound) for case, figure in figures)
    return row(name, Tally(cases, declared), **values)


def judged(
    claim: str, where: str, tally: Tally, number: str, reason: str, asserted: bool = False
) -> Claim:
    """The row of a claim that was tried on cases; `asserted` makes a check of it."""
    value = tally.held / len(tally.cases) if tally.cases else math.nan
    said = (tally.word, number, reason, tally.share, tally.convergence)
    return Claim(claim, where, *said, value if asserted else None, len(tally.marginal))


def row(name: str, tally: Tally, **values: object) -> Claim:
    """The row of claims.toml by name, with the verdict of a tally and these values in its texts."""
    x = _said(name, values)
    asserted = bool(x.get("asserted"))
    return judged(x["claim"], x["where"], tally, x["number"], x["reason"], asserted=asserted)


def told(
    name: str,
    word: str = "",
    values: Mapping[str, object] | None = None,
    *,
    share: str = "",
    convergence: str = "",
    marginal: int = 0,
) -> Claim:
    """The row of claims.toml by name, with a word that no tally gives.

    word: that of the file if empty. values: in its texts. share, convergence, marginal: as of `Claim`.
    """
    x = _said(name, values or {})
    word = word or x["word"]
    return Claim(
        *(x["claim"], x["where"], word, x["number"], x["reason"]),
        *(share, convergence),
        marginal=marginal,
    )


def _said(name: str, values: Mapping[str, object]) -> dict[str, Any]:
    """The texts of a claim with the values in them, and what it takes from another claim by "like".

    Limits of admissible.toml are known to every text as {limit[name]}.
    """
    found = texts()[name]
    found = {**texts().get(found.get("like"), {}), **found}
    of = {"limit": declared()["limits"], **values}
    return {key: x.format(**of) if isinstance(x, str) else x for key, x in found.items()}


def claim_checks(claims: Sequence[Claim]) -> list[Check]:
    """The checks of the claims, for the exit code of the reproduction.

    Claims that are said to be replicated have to stay so: all of their cases hold. And no case of any claim may
    change its number or verdict at half of the step.
    """
    kind = "reproduced"
    doubtful = "claims: cases whose number or verdict is another at half the step"
    shares = (
        at_least(f"claim, {c.where}: {c.claim}: share of its cases", kind, c.asserted, 1.0)
        for c in claims
        if c.asserted is not None
    )
    return [at_most(doubtful, "law", sum(c.marginal for c in claims), 0), *shares]


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
