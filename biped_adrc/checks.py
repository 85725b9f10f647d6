"""What is asserted: a value that was computed, a limit, and whether it holds.

kind: "law" (physics and numerics), "consistency" (what was built in, such as a gait that was designed to close
on x*), "reproduced" (what could have failed).
"""

from __future__ import annotations

from dataclasses import dataclass

KINDS = ("law", "consistency", "reproduced")


@dataclass(frozen=True)
class Check:
    """One assertion; `limit` is a text such as "<= 0.01"."""

    name: str
    kind: str
    value: float
    limit: str
    holds: bool

    def __str__(self) -> str:
        return f"{self.name}: {self.value:.1e} {'' if self.holds else 'is not '}{self.limit}"


def at_most(name: str, kind: str, value: float, limit: float) -> Check:
    """value <= limit; NaN does not hold."""
    return Check(name, kind, float(value), f"<= {limit:g}", bool(value <= limit))


def at_least(name: str, kind: str, value: float, limit: float) -> Check:
    """value >= limit; NaN does not hold."""
    return Check(name, kind, float(value), f">= {limit:g}", bool(value >= limit))


def below(name: str, kind: str, value: float, limit: float) -> Check:
    """value < limit; NaN does not hold."""
    return Check(name, kind, float(value), f"< {limit:g}", bool(value < limit))


def between(name: str, kind: str, value: float, low: float, high: float) -> Check:
    """low <= value <= high."""
    return Check(name, kind, float(value), f"in [{low:g}, {high:g}]", bool(low <= value <= high))
