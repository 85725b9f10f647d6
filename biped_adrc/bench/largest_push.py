"""The largest push under which a walk makes all steps, and under which all are legal, by bisection.

For each controller, direction, phase of the step and seed. Neither criterion need be monotone in the
amplitude, so a coarse ladder of amplitudes is walked first; then the interval between the last rung below all
failures and the first failure is halved until it is narrower than `RESOLUTION`. Both criteria share walks.
All searches advance together: each round is one batch of walks, which keeps all workers busy.

A search returns an interval and not a number. The median over seeds is therefore an interval too: its ends
are the medians of the lower and of the upper ends, open above where the highest rung was passed.

Called by `bench.comparison`; `carry` walks the trials, here or anywhere.

One search: passed at 0, 20 and 40, failed at 80 N m (rungs); then 60 passes, 70, 65 and 62.5 fail, and the
result is the interval (60, 62.5) N m.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from biped_adrc.bench.cell import is_legal, is_made
from biped_adrc.bench.conditions import BASE, PUSH, SAID
from biped_adrc.campaign.chunk import Record, Row

LADDER = (0.0, 20.0, 40.0, 80.0, 160.0, 320.0)
"""Amplitudes walked first: torques [N m] on joints, or a force [N]."""
RESOLUTION = 2.5
"""Width of the intervals returned [N m] or [N]."""
DIRECTIONS: Mapping[str, str] = SAID["directions"]
"""Joint patterns by name, as the scenario's `on`; the last two act on the torso, where no motor is
(unmatched).
"""
MATCHED = tuple(DIRECTIONS)[:4]
"""Names of the patterns on actuated joints."""
PHASES: Mapping[str, float] = SAID["phases"]
"""Onset of the push in the step [s] by name; a step takes about 0.42 s and a push 0.2 s."""

Carry = Callable[[Sequence[Record]], Sequence[Row]]
"""A function that walks trials and returns their rows, in order."""


class Bracket(NamedTuple):
    """The interval of the largest push of one search: `low` passed, `high` did not [N m]; None for none yet."""

    low: float | None = None
    high: float | None = None

    def walked(self, amplitude: float, passed: bool) -> Bracket:
        """The interval after one more walk; a walk outside of the interval changes nothing."""
        above = self.low is None or amplitude > self.low
        if not (above and (self.high is None or amplitude < self.high)):
            return self
        return self._replace(low=amplitude) if passed else self._replace(high=amplitude)

    @property
    def middle(self) -> float | None:
        """The amplitude to walk next [N m]; None where the interval is narrow enough, or open at one end."""
        if self.low is None or self.high is None or self.high - self.low <= RESOLUTION:
            return None
        return 0.5 * (self.low + self.high)

    @property
    def ends(self) -> tuple[float, float]:
        """Bounds of the largest push [N m]: (0, 0) where no amplitude passes, infinity above where all do."""
        if self.low is None:
            return 0.0, 0.0
        return self.low, math.inf if self.high is None else self.high


NOTHING = Bracket()
"""No walk yet."""


@dataclass(frozen=True)
class Search:
    """The search of one controller, direction, phase and seed, with its two intervals."""

    controller: str
    """Its name."""
    direction: str
    """One of `DIRECTIONS`."""
    phase: str
    """One of `PHASES`."""
    seed: int
    """Of the scenario."""
    survived: Bracket = NOTHING
    """Interval of the largest push with which all steps are made."""
    legal: Bracket = NOTHING
    """Interval of the largest push with which all steps are legal."""
    setting: Record = field(default_factory=dict)
    """Values of the trial besides, such as those of a tuned set; its `controller` goes before the name."""
    bandwidth: float | None = None
    """Of all observer poles [rad/s] where they are made equal; None for the controller's own settings."""

    def record(self, amplitude: float) -> dict[str, object]:
        """The values of the trial with this amplitude [N m]."""
        push = {"onset": PHASES[self.phase], "on": DIRECTIONS[self.direction]}
        who = {"amplitude": amplitude, "controller": self.controller, "seed": self.seed}
        return {**BASE, **PUSH, **push, **who, **self.setting}

    def middles(self) -> list[float]:
        """The amplitudes to walk next, at most one for each criterion; empty when the search is done."""
        found = {b.middle for b in (self.survived, self.legal)}
        return sorted(a for a in found if a is not None)

    def walked(self, amplitude: float, row: Row) -> Search:
        """The search after a walk with this amplitude [N m] and this row."""
        survived = self.survived.walked(amplitude, is_made(row))
        return replace(self, survived=survived, legal=self.legal.walked(amplitude, is_legal(row)))


def searches(
    controllers: Sequence[str],
    seeds: int,
    setting: Callable[[str], Record] = lambda controller: {},
    bandwidth: float | None = None,
) -> list[Search]:
    """All searches of these controllers, not yet begun; setting: values of the trial by controller.

    bandwidth: of all observer poles [rad/s] where the settings make them equal.
    """
    every = itertools.product(controllers, DIRECTIONS, PHASES, range(seeds))
    return [Search(*one, setting=setting(one[0]), bandwidth=bandwidth) for one in every]


def largest_pushes(begun: Sequence[Search], carry: Carry) -> list[Search]:
    """Carry the searches out; returns them in their order, done."""
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


class PushSpan(NamedTuple):
    """Bounds of a number over seeds [N m]; an infinite `high` reads "at least low"."""

    low: float
    high: float

    def plain(self) -> list[float | None]:
        """[low, high] for JSON, which has no infinity: None in its place."""
        return [self.low, None if math.isinf(self.high) else self.high]


def median_span(brackets: Sequence[Bracket]) -> PushSpan:
    """Bounds of the median over seeds, wherever in its interval each largest push lies."""
    lows, highs = zip(*(b.ends for b in brackets), strict=True)
    return PushSpan(float(np.median(lows)), float(np.median(highs)))


def whole_span(brackets: Sequence[Bracket]) -> PushSpan:
    """Bounds that hold for every seed."""
    return PushSpan(min(b.ends[0] for b in brackets), max(b.ends[1] for b in brackets))


class Largest(NamedTuple):
    """The largest pushes of one controller in one direction and phase, over seeds."""

    controller: str
    """Its name."""
    direction: str
    """One of `DIRECTIONS`."""
    phase: str
    """One of `PHASES`."""
    bandwidth: float | None
    """Of all observer poles [rad/s]; None for the controller's own settings."""
    survived: tuple[Bracket, ...]
    """One interval per seed: all steps made."""
    legal: tuple[Bracket, ...]
    """One interval per seed: all steps legal."""

    def row(self) -> dict[str, object]:
        """In plain values; `beyond`: seeds that passed the highest rung, `none`: seeds that passed none."""
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
    """The searches grouped by controller, direction, phase and bandwidth, in the order of their
    first search.
    """
    found: dict[tuple[str, str, str, float | None], list[Search]] = {}
    for s in done:
        key = (s.controller, s.direction, s.phase, s.bandwidth)
        found.setdefault(key, []).append(s)
    return [
        Largest(*key, tuple(s.survived for s in here), tuple(s.legal for s in here))
        for key, here in found.items()
    ]
