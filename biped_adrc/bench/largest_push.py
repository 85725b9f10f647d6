"""The largest push under which a walk makes all steps, and that under which it is legal, by bisection.

Per direction and phase. Neither need be monotone in the amplitude: a ladder of amplitudes is walked first, and
the interval between the last rung below all failures and the first failure is halved until it is as narrow as
asked, for both criteria. All searches go on in step, so that each round is one batch of walks. What is found is
an interval of one seed: over seeds it stays one, open above where the highest rung was passed.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.bench.cell import is_legal, is_made
from biped_adrc.bench.conditions import BASE, SAID

LADDER = (0.0, 20.0, 40.0, 80.0, 160.0, 320.0)
"""[N m] or [N]."""
RESOLUTION = 2.5
"""[N m] or [N], of the answer."""
DIRECTIONS: Mapping[str, str] = SAID["directions"]
"""Joint patterns; the last two are unmatched."""
MATCHED = tuple(DIRECTIONS)[:4]
PHASES: Mapping[str, float] = SAID["phases"]
"""Onset [s] in a step of about 0.42 s; pushes last 0.2 s."""

Carry = Callable[[Sequence[Mapping[str, Any]]], Sequence[Mapping[str, Any]]]
"""Walks trials and returns their rows, in order."""


class Bracket(NamedTuple):
    """Where the largest push lies: `low` passed, `high` did not [N m]; None for none yet."""

    low: float | None = None
    high: float | None = None

    def walked(self, amplitude: float, passed: bool) -> Bracket:
        """After a walk; one that is not inside says nothing."""
        above = self.low is None or amplitude > self.low
        if not (above and (self.high is None or amplitude < self.high)):
            return self
        return self._replace(low=amplitude) if passed else self._replace(high=amplitude)

    @property
    def middle(self) -> float | None:
        """What to walk next; None where the interval is narrow enough, or open."""
        if self.low is None or self.high is None or self.high - self.low <= RESOLUTION:
            return None
        return 0.5 * (self.low + self.high)

    @property
    def ends(self) -> tuple[float, float]:
        """The largest push lies between them: (0, 0) where none passes, infinity where all do."""
        if self.low is None:
            return 0.0, 0.0
        return self.low, math.inf if self.high is None else self.high


NOTHING = Bracket()


@dataclass(frozen=True)
class Search:
    """One controller, direction, phase and seed."""

    controller: str
    direction: str
    phase: str
    seed: int
    survived: Bracket = NOTHING
    legal: Bracket = NOTHING
    setting: Mapping[str, Any] = field(default_factory=dict)
    """Values of the trial in place of the controller's own."""

    def record(self, amplitude: float) -> dict[str, Any]:
        """The trial with this amplitude."""
        push = {"onset": PHASES[self.phase], "on": DIRECTIONS[self.direction]}
        who = {"amplitude": amplitude, "controller": self.controller, "seed": self.seed}
        return {**BASE, **SAID["push"], **push, **who, **self.setting}

    def middles(self) -> list[float]:
        """The amplitudes to walk next."""
        found = {b.middle for b in (self.survived, self.legal)}
        return sorted(a for a in found if a is not None)

    def walked(self, amplitude: float, row: Mapping[str, Any]) -> Search:
        """After a walk with this amplitude."""
        survived = self.survived.walked(amplitude, is_made(row))
        return replace(self, survived=survived, legal=self.legal.walked(amplitude, is_legal(row)))


def searches(
    controllers: Sequence[str],
    seeds: int,
    setting: Callable[[str], Mapping[str, Any]] = lambda controller: {},
) -> list[Search]:
    """All of them, not yet begun; setting: of a controller, in place of its own."""
    every = itertools.product(controllers, DIRECTIONS, PHASES, range(seeds))
    return [Search(*one, setting=setting(one[0])) for one in every]


def largest_pushes(begun: Sequence[Search], carry: Carry) -> list[Search]:
    """The searches, done."""
    found = list(begun)

    def walk(asked: Sequence[tuple[int, float]]) -> None:
        """Walk search i with amplitude a for all (i, a) asked, and narrow its intervals."""
        rows = carry([found[i].record(a) for i, a in asked]) if asked else []
        for (i, a), row in zip(asked, rows, strict=True):
            found[i] = found[i].walked(a, row)

    for rung in LADDER:
        walk([(i, rung) for i, s in enumerate(found) if s.survived.high is None])
    while asked := [(i, a) for i, s in enumerate(found) for a in s.middles()]:
        walk(asked)
    return found


class Span(NamedTuple):
    """Between what a number lies [N m]; infinity for "at least"."""

    low: float
    high: float

    def plain(self) -> list[float | None]:
        """For JSON: None for infinity."""
        return [self.low, None if math.isinf(self.high) else self.high]


def median_span(brackets: Sequence[Bracket]) -> Span:
    """Between what the median over seeds lies, whatever the values inside their intervals."""
    lows, highs = zip(*(b.ends for b in brackets), strict=True)
    return Span(float(np.median(lows)), float(np.median(highs)))


def whole_span(brackets: Sequence[Bracket]) -> Span:
    """Between what all seeds lie."""
    return Span(min(b.ends[0] for b in brackets), max(b.ends[1] for b in brackets))


class Largest(NamedTuple):
    """The largest push of one controller, over seeds: all steps made (`survived`), and legal."""

    controller: str
    direction: str
    phase: str
    bandwidth: float | None
    """Of the observer [rad/s]; None for the controller's own settings."""
    survived: tuple[Bracket, ...]
    legal: tuple[Bracket, ...]

    def row(self) -> dict[str, Any]:
        """As plain values; beyond: seeds that passed the highest rung."""
        found = self._asdict()
        kinds = {kind: found.pop(kind) for kind in ("survived", "legal")}
        return {
            **found,
            "seeds": len(self.legal),
            **{
                kind: {
                    "median": median_span(b).plain(),
                    "seeds": whole_span(b).plain(),
                    "beyond": sum(math.isinf(x.ends[1]) for x in b),
                    "none": sum(x.low is None for x in b),
                }
                for kind, b in kinds.items()
            },
        }


def gathered(done: Sequence[Search]) -> list[Largest]:
    """The searches by controller, direction, phase and bandwidth."""
    found: dict[tuple[str, str, str, float | None], list[Search]] = {}
    for s in done:
        key = (s.controller, s.direction, s.phase, s.setting.get("bandwidth"))
        found.setdefault(key, []).append(s)
    return [
        Largest(*key, tuple(s.survived for s in here), tuple(s.legal for s in here))
        for key, here in found.items()
    ]
