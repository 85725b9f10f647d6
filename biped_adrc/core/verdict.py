"""Checks: a computed value, its limit, and whether the value keeps it.

The command `biped-adrc reproduce`, which repeats the numbers of the paper, writes its checks into summary.json
and a report; `biped-adrc robot check` prints those of a URDF. The verdict is stored beside value and limit, so
that a reader of the file need not parse the limit. Each check is of one kind:

    law            physics and numerics that hold whatever a paper says, such as conservation of energy
    consistency    what was built in has to come out, such as a gait that was designed to return to its start
    reproduced     a claim of the paper, which could have failed

Make a check with `at_most`, `at_least`, `below` or `between`; they write the limit as text and
compare, and a value of NaN never holds.
"""

from typing import NamedTuple

_KINDS = ("law", "consistency", "reproduced")
"""The kinds of a check, in the order of the list above."""


class Check(NamedTuple):
    """One check that was carried out.

    name: what was computed, with its unit. kind: one of `_KINDS`. value: the number found. limit:
    its bound as text, such as "<= 0.01". holds: whether the value keeps it.
    """

    name: str
    kind: str
    value: float
    limit: str
    holds: bool

    def __str__(self) -> str:
        """The check on one line, such as "residual of the orbit: 3.1e-12 <= 1e-09"; if it does not hold, with
        "is not" before the limit.
        """
        return f"{self.name}: {self.value:.1e} {'' if self.holds else 'is not '}{self.limit}"


def at_most(name: str, kind: str, value: float, limit: float) -> Check:
    """The Check value <= limit, of a kind in `_KINDS`, both in the unit in `name`; it does not hold for NaN."""
    return Check(name, kind, float(value), f"<= {limit:g}", bool(value <= limit))


def at_least(name: str, kind: str, value: float, limit: float) -> Check:
    """The Check value >= limit, of a kind in `_KINDS`, both in the unit in `name`; it does not hold for NaN."""
    return Check(name, kind, float(value), f">= {limit:g}", bool(value >= limit))


def below(name: str, kind: str, value: float, limit: float) -> Check:
    """The Check value < limit, of a kind in `_KINDS`, both in the unit in `name`; it does not hold for NaN."""
    return Check(name, kind, float(value), f"< {limit:g}", bool(value < limit))


def between(name: str, kind: str, value: float, low: float, high: float) -> Check:
    """The Check low <= value <= high, of a kind in `_KINDS`, all in the unit in `name`; NaN does not hold."""
    return Check(name, kind, float(value), f"in [{low:g}, {high:g}]", bool(low <= value <= high))
