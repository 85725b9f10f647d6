"""Controllers x conditions x seeds: which controller survives what, at what error, torque and cost.

Every controller meets the same draws. Shares have Wilson's intervals, medians are over the walks that made all
their steps and have bootstrap intervals (`bench.statistics`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from biped_adrc.errors import InputError
from biped_adrc.studies.bench.catalogue import CONTROLLERS
from biped_adrc.studies.bench.chunk import NO_WALK
from biped_adrc.studies.bench.conditions import CONDITIONS, record
from biped_adrc.studies.bench.largest_push import (
    DIRECTIONS,
    PHASES,
    Carry,
    Search,
    largest_pushes,
    searches,
)
from biped_adrc.studies.bench.statistics import Interval, median, share

PUSH_SEEDS = 5
"""Seeds of the largest pushes, at most."""
MEASURES = {
    "peak_error": "largest tracking error [rad]",
    "rms_torque": "torque, root mean square [N m]",
    "cost_of_transport": "cost of transport",
    "speed_change": "change of speed",
    "peak_matched": "matched part of the push [rad/s^2]",
    "peak_unmatched": "unmatched part [rad/s^2]",
}
"""Columns of a row of which the median is shown."""


@dataclass(frozen=True)
class Cell:
    """One controller under one condition."""

    controller: str
    condition: str
    survived: Interval
    """Share of the walks."""
    falls: Mapping[str, int]
    """How the others ended: status and number."""
    medians: Mapping[str, Interval | None]
    """By `MEASURES`."""

    def row(self) -> dict[str, Any]:
        """As plain values."""
        found = {name: None if x is None else list(x) for name, x in self.medians.items()}
        return {
            "controller": self.controller,
            "condition": self.condition,
            "survived": list(self.survived),
            "falls": dict(self.falls),
            **found,
        }


@dataclass(frozen=True)
class Largest:
    """The largest push survived by one controller, over seeds."""

    controller: str
    direction: str
    phase: str
    push: Interval
    """[N m]"""
    beyond: bool
    """Whether a seed survived the highest rung."""

    def row(self) -> dict[str, Any]:
        """As plain values."""
        named = {"controller": self.controller, "direction": self.direction, "phase": self.phase}
        return {**named, "push": list(self.push), "beyond": self.beyond}


@dataclass(frozen=True)
class Comparison:
    """What a comparison found."""

    controllers: tuple[str, ...]
    conditions: tuple[str, ...]
    seeds: int
    cells: tuple[Cell, ...]
    pushes: tuple[Largest, ...]

    def cell(self, controller: str, condition: str) -> Cell:
        """Of the table."""
        at = self.controllers.index(controller) * len(self.conditions)
        return self.cells[at + self.conditions.index(condition)]


def check(controllers: Sequence[str], conditions: Sequence[str], seeds: int) -> None:
    """Raise InputError for a name that there is not, twice the same, or no seeds."""
    for kind, given, known in (
        ("controller", controllers, CONTROLLERS),
        ("condition", conditions, CONDITIONS),
    ):
        wrong = [name for name in given if name not in known]
        if wrong or not given or len(set(given)) < len(given):
            raise InputError(
                f"the comparison names the {kind}s {list(given)}, expected different ones of {list(known)}"
            )
    if seeds < 1:
        raise InputError(f"the comparison asks for {seeds} seeds, expected at least 1")


def compare(
    carry: Carry,
    controllers: Sequence[str] = tuple(CONTROLLERS),
    conditions: Sequence[str] = tuple(CONDITIONS),
    seeds: int = 20,
    pushes: bool = True,
) -> Comparison:
    """The whole comparison; `carry` walks trials, here or anywhere. Raises InputError as `check`."""
    check(controllers, conditions, seeds)
    pairs = [(c, d) for c in controllers for d in conditions]
    rows = walked_rows(carry([record(d, c, seed) for c, d in pairs for seed in range(seeds)]))
    cells = [_cell(c, d, rows[i * seeds : (i + 1) * seeds]) for i, (c, d) in enumerate(pairs)]
    found: list[Largest] = []
    if pushes:
        begun = searches(controllers, min(seeds, PUSH_SEEDS))
        done = largest_pushes(begun, lambda records: walked_rows(carry(records)))
        found = _largest(controllers, done)
    return Comparison(tuple(controllers), tuple(conditions), seeds, tuple(cells), tuple(found))


def walked_rows(rows: Sequence[Mapping[str, Any]]) -> Sequence[Mapping[str, Any]]:
    """The rows themselves. Raises InputError for one that is no walk, with what it says."""
    for row in rows:
        if row["status"] in NO_WALK:
            raise InputError(
                f"a trial of the comparison was no walk: {row['status']}: {row['detail']}; shares of walks "
                "that survive would mean nothing with it"
            )
    return rows


def _cell(controller: str, condition: str, rows: Sequence[Mapping[str, Any]]) -> Cell:
    walked = [row for row in rows if row["survived"] == 1]
    ended = [str(row["status"]) for row in rows if row["survived"] != 1]
    falls = {status: ended.count(status) for status in sorted(set(ended))}
    medians = {name: median([row[name] for row in walked]) for name in MEASURES}
    return Cell(controller, condition, share(len(walked), len(rows)), falls, medians)


def _largest(controllers: Sequence[str], done: Sequence[Search]) -> list[Largest]:
    found = []
    for controller in controllers:
        for direction in DIRECTIONS:
            for phase in PHASES:
                key = (controller, direction, phase)
                here = [s for s in done if (s.controller, s.direction, s.phase) == key]
                push = median([s.largest for s in here])
                assert push is not None
                found.append(Largest(*key, push, any(s.high is None for s in here)))
    return found
