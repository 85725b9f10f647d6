"""The one table: every claim of the paper, and every law and consistency that its reproduction is held against.

`claims` are the statements of the paper from the abstract to its last section, each judged over all its
scenarios; of `checks` every scenario is a check of its own, whose kinds (`verdict.KINDS`) say what a broken one
means:

    law           the program is wrong: physics or numerics
    consistency   a gait does not do what it was designed for
    reproduced    the paper's statement does not hold for this robot

A check is a table of checks.toml, a claim one of claims.toml: its words, and by name the scenarios, the metric
and the values for its texts (functions of `ROOMS`, or members of `Results`). Limits, and the choices under
which claims are tried, are in admissible.toml, which was written before the runs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from operator import attrgetter, methodcaller
from typing import Any

from biped_adrc.core.files import packaged
from biped_adrc.core.verdict import Check, at_least, at_most, below, between
from biped_adrc.paper import metrics, physical_laws, values, verdict
from biped_adrc.paper.runs import Results
from biped_adrc.paper.scenarios import declared
from biped_adrc.paper.verdict import AtTwoSteps, Claim, Limit, Row, claim_checks, row_of, texts

ROOMS = (metrics, values, verdict, physical_laws)
"""Modules of functions that claims.toml and checks.toml name."""


def limit(text: str) -> Limit:
    """The limit "<= 0.01", "in 0.9 1.1", or "<= ratio" by its name in admissible.toml."""
    sign, *words = text.split()
    bounds = [_number(word) for word in words]
    if sign == "in":
        return partial(between, low=bounds[0], high=bounds[1])
    return partial({"<=": at_most, ">=": at_least, "<": below}[sign], limit=bounds[0])


def _number(text: str) -> float:
    """A number, or a limit by its name in admissible.toml."""
    return float(declared()["limits"].get(text, text))


def _function(text: str) -> Callable[..., Any]:
    """A function of `ROOMS` by its name, with the words behind it as its first arguments.

    Where there is none it is an attribute of what it is called with, with words a method.
    """
    name, *words = text.split()
    for room in ROOMS:
        if hasattr(room, name):
            return partial(getattr(room, name), *words)
    return methodcaller(name, *words) if words else attrgetter(name)


def claims() -> Iterator[Claim]:
    """The claims of the paper, in the order of the report; those that no run can decide have no scenarios."""
    for name, said in texts().items():
        if name in ("preface", "words", "notes"):
            continue
        names = {
            "scenarios": "scenarios",
            "measure": "metric",
            "variant": "variant",
            "values": "values",
        }
        result: dict[str, Any] = {
            to: _function(said[key]) for key, to in names.items() if key in said
        }
        if "round_off" in said:
            result["round_off"] = _number(said["round_off"])
        bound = limit(said.get("limit", "<= 0"))
        yield Claim(name, said["where"], said["claim"], limit=bound, **result)


def rows(r: Results) -> list[Row]:
    """Every claim of the paper with what became of it."""
    return [row_of(of, r) for of in claims()]


def checks(r: Results, of_claims: list[Row]) -> list[Check]:
    """All checks of a reproduction: those of checks.toml, and those of its claims."""
    result = []
    for said in packaged("biped_adrc.paper", "checks.toml")["check"]:
        bound = limit(said["limit"])
        metric = _function(said["measure"]) if "measure" in said else AtTwoSteps.of
        for name, x in _function(said["scenarios"])(r).items():
            text = ": ".join(filter(None, (name, said.get("statement"))))
            result.append(bound(text, said["kind"], AtTwoSteps.of(metric(x)).value))
    return [*result, *claim_checks(of_claims)]
