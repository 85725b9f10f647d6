"""The largest push under which a walk makes all steps, and that under which it is legal, by bisection.

Per direction and phase. Neither need be monotone in the amplitude: a ladder of amplitudes is walked first, and
the interval between the last rung below all failures and the first failure is halved until it is as narrow as
asked, for both criteria. All searches go on in step, so that each round is one batch of walks. What is found is
an interval of one seed: over seeds it stays one, open above where the highest rung was passed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.studies.bench.cell import is_legal, is_made
from biped_adrc.studies.bench.conditions import BASE

LADDER = (0.0, 20.0, 40.0, 80.0, 160.0, 320.0)
"""[N m] or [N]."""
RESOLUTION = 2.5
"""[N m] or [N], of the answer."""
STEP = 3
IMPACTS = 9
"""Walked in all, seven of them from the push on."""

DIRECTIONS: dict[str, Mapping[str, Any]] = {
    "all joints +": {"on": "q1,q2,q3,q4"},
    "all joints -": {"on": "-q1,-q2,-q3,-q4"},
    "hips apart": {"on": "q1,-q2"},
    "swing knee": {"on": "q4"},
    "torso +": {"on": "q5"},
    "torso -": {"on": "-q5"},
}
"""Joint patterns; the last two are unmatched."""
MATCHED = tuple(DIRECTIONS)[:4]
PHASES = {"early": 0.02, "middle": 0.12, "late": 0.22}
"""Onset [s] in a step of about 0.42 s; pushes last 0.2 s."""

Carry = Callable[[Sequence[Mapping[str, Any]]], Sequence[Mapping[str, Any]]]
"""Walks trials and returns their rows, in order."""


@dataclass(frozen=True)
class Bracket:
    """Where the largest push lies: `low` passed, `high` did not [N m]; None for none yet."""

    low: float | None = None
    high: float | None = None

    def climbed(self, amplitude: float, passed: bool) -> Bracket:
        """After the next rung of the ladder."""
        if self.high is not None:
            return self
        return replace(self, low=amplitude) if passed else replace(self, high=amplitude)

    def halved(self, amplitude: float, passed: bool) -> Bracket:
        """After a walk; one that is not inside says nothing."""
        if self.low is None or self.high is None or not self.low < amplitude < self.high:
            return self
        return replace(self, low=amplitude) if passed else replace(self, high=amplitude)

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


@dataclass(frozen=True)
class Search:
    """One controller, direction, phase and seed."""

    controller: str
    direction: str
    phase: str
    seed: int
    survived: Bracket = Bracket()
    legal: Bracket = Bracket()
    setting: Mapping[str, Any] = field(default_factory=dict)
    """Values of the trial in place of the controller's own."""

    def record(self, amplitude: float) -> dict[str, Any]:
        """The trial with this amplitude."""
        return {
            **BASE,
            "impacts": IMPACTS,
            "push": "pulse",
            "duration": 0.2,
            "pushed_step": STEP,
            "onset": PHASES[self.phase],
            **DIRECTIONS[self.direction],
            "amplitude": amplitude,
            "controller": self.controller,
            "seed": self.seed,
            **self.setting,
        }

    def middles(self) -> list[float]:
        """The amplitudes to walk next."""
        found = {b.middle for b in (self.survived, self.legal)}
        return sorted(a for a in found if a is not None)


def searches(
    controllers: Sequence[str],
    seeds: int,
    setting: Callable[[str], Mapping[str, Any]] = lambda controller: {},
) -> list[Search]:
    """All of them, not yet begun; setting: of a controller, in place of its own."""
    return [
        Search(controller, direction, phase, seed, setting=setting(controller))
        for controller in controllers
        for direction in DIRECTIONS
        for phase in PHASES
        for seed in range(seeds)
    ]


def largest_pushes(begun: Sequence[Search], carry: Carry) -> list[Search]:
    """The searches, done."""
    found = list(begun)
    for rung in LADDER:
        asked = [(i, rung) for i, s in enumerate(found) if s.survived.high is None]
        _walk(found, asked, carry, Bracket.climbed)
    while asked := [(i, a) for i, s in enumerate(found) for a in s.middles()]:
        _walk(found, asked, carry, Bracket.halved)
    return found


def _walk(
    found: list[Search],
    asked: Sequence[tuple[int, float]],
    carry: Carry,
    after: Callable[[Bracket, float, bool], Bracket],
) -> None:
    """Walk search i with amplitude a for all (i, a) asked, and narrow its intervals."""
    if not asked:
        return
    rows = carry([found[i].record(a) for i, a in asked])
    for (i, a), row in zip(asked, rows, strict=True):
        s = found[i]
        found[i] = replace(
            s, survived=after(s.survived, a, is_made(row)), legal=after(s.legal, a, is_legal(row))
        )


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


@dataclass(frozen=True)
class Largest:
    """The largest push of one controller, over seeds: all steps made (`survived`), and legal."""

    controller: str
    direction: str
    phase: str
    survived: tuple[Bracket, ...]
    legal: tuple[Bracket, ...]
    bandwidth: float | None = None
    """Of the observer [rad/s]; None for the controller's own settings."""

    def row(self) -> dict[str, Any]:
        """As plain values; beyond: seeds that passed the highest rung."""
        kinds = {"survived": self.survived, "legal": self.legal}
        return {
            "controller": self.controller,
            "direction": self.direction,
            "phase": self.phase,
            "bandwidth": self.bandwidth,
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
        Largest(
            controller,
            direction,
            phase,
            tuple(s.survived for s in here),
            tuple(s.legal for s in here),
            bandwidth,
        )
        for (controller, direction, phase, bandwidth), here in found.items()
    ]
