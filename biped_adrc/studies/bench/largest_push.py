"""The largest push survived, per direction and phase of the step, by bisection.

Survival need not be monotone in the amplitude: a ladder of amplitudes is walked first, and the interval between
the last rung below all falls and the first fall is halved until it is as narrow as asked. All searches go on in
step, so that each round is one batch of walks.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

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
PHASES = {"early": 0.02, "middle": 0.12, "late": 0.22}
"""Onset [s] in a step of about 0.42 s; pushes last 0.2 s."""

Carry = Callable[[Sequence[Mapping[str, Any]]], Sequence[Mapping[str, Any]]]
"""Walks trials and returns their rows, in order."""


@dataclass(frozen=True)
class Search:
    """One direction, phase, controller and seed; `low` survived, `high` did not; None for none yet."""

    controller: str
    direction: str
    phase: str
    seed: int
    low: float | None = None
    high: float | None = None

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
        }

    @property
    def open(self) -> bool:
        """Whether the interval is wider than asked."""
        if self.low is None or self.high is None:
            return False
        return self.high - self.low > RESOLUTION

    @property
    def largest(self) -> float:
        """The largest push survived; 0 where it falls without one."""
        return 0.0 if self.low is None else self.low


def searches(controllers: Sequence[str], seeds: int) -> list[Search]:
    """All of them, not yet begun."""
    return [
        Search(controller, direction, phase, seed)
        for controller in controllers
        for direction in DIRECTIONS
        for phase in PHASES
        for seed in range(seeds)
    ]


def largest_pushes(begun: Sequence[Search], carry: Carry) -> list[Search]:
    """The searches, done."""
    rows = iter(carry([s.record(a) for s in begun for a in LADDER]))
    found = [_laddered(s, [_survived(next(rows)) for _ in LADDER]) for s in begun]
    while still := [i for i, s in enumerate(found) if s.open]:
        middles = [0.5 * (found[i].low + found[i].high) for i in still]  # type: ignore[operator]
        records = [found[i].record(a) for i, a in zip(still, middles, strict=True)]
        for i, a, row in zip(still, middles, carry(records), strict=True):
            found[i] = replace(found[i], low=a) if _survived(row) else replace(found[i], high=a)
    return found


def _laddered(search: Search, survived: Sequence[bool]) -> Search:
    low: float | None = None
    for amplitude, walked in zip(LADDER, survived, strict=True):
        if not walked:
            return replace(search, low=low, high=amplitude)
        low = amplitude
    return replace(search, low=low)


def _survived(row: Mapping[str, Any]) -> bool:
    return row["survived"] == 1
