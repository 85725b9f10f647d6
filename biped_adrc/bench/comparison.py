"""Controllers x conditions x seeds: which controller walks legally under what, at what error, torque and cost.

Every controller meets the same draws, so walks are paired by their seeds. Shares have Wilson's intervals,
medians are over the walks that make all their steps legally and have bootstrap intervals (`bench.statistics`).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from biped_adrc.bench import conditions as given
from biped_adrc.bench.cell import Cell, Row
from biped_adrc.bench.conditions import BANDWIDTH, BASE, COMPARED, CONDITIONS, walked_again
from biped_adrc.bench.largest_push import Carry, Largest, gathered, largest_pushes, searches
from biped_adrc.campaign.chunk import NO_WALK
from biped_adrc.errors import InputError
from biped_adrc.scenario.registry import find, is_own, names

PUSH_SEEDS = 5
"""Seeds of the largest pushes, at most."""
NOMINAL = {k: v for k, v in BASE.items() if k != "start_speed_spread"} | {"controller": "NPD"}
"""The trial that nothing disturbs, started on the gait: what the gait itself needs."""


class Comparison(NamedTuple):
    """What a comparison found."""

    controllers: tuple[str, ...]
    conditions: tuple[str, ...]
    seeds: int
    nominal: Row
    """Of the trial `NOMINAL`."""
    cells: tuple[Cell, ...]
    equal: tuple[Cell, ...]
    """The cells of controllers with an observer once more, all at the same bandwidth."""
    pushes: tuple[Largest, ...]
    """At their own settings, then at equal bandwidth."""

    def cell(self, controller: str, condition: str) -> Cell:
        """Of the table."""
        at = self.controllers.index(controller) * len(self.conditions)
        return self.cells[at + self.conditions.index(condition)]

    def at_equal(self, controller: str, condition: str) -> Cell | None:
        """The cell at equal bandwidth; None for a controller without an observer."""
        found = [c for c in self.equal if (c.controller, c.condition) == (controller, condition)]
        return found[0] if found else None


def check(controllers: Sequence[str], conditions: Sequence[str], seeds: int) -> None:
    """Raise InputError for a name that there is not, twice the same, or no seeds."""
    own = tuple(filter(is_own, controllers))
    for kind, asked, known, more in (
        ("controller", controllers, names("controller"), own),
        ("condition", conditions, tuple(CONDITIONS), ()),
    ):
        if not asked or not {*asked} <= {*known, *more} or len(set(asked)) < len(asked):
            raise InputError(
                f"the comparison names the {kind}s {list(asked)}, expected different ones of {list(known)}"
            )
    for name in controllers:
        find("controller", name).load()
    if seeds < 1:
        raise InputError(f"the comparison asks for {seeds} seeds, expected at least 1")


def compare(
    carry: Carry,
    controllers: Sequence[str] = COMPARED,
    conditions: Sequence[str] = tuple(CONDITIONS),
    seeds: int = 20,
    pushes: bool = True,
) -> Comparison:
    """The whole comparison; `carry` walks trials, here or anywhere. Raises InputError as `check`."""
    check(controllers, conditions, seeds)
    again = walked_again(controllers)
    cells = [(c, d, None) for c in controllers for d in conditions]
    equal = [(c, d, BANDWIDTH) for c in again for d in conditions]
    records = [
        NOMINAL,
        *(given.record(d, c, seed) for c, d, _ in cells for seed in range(seeds)),
        *(given.equal_record(d, c, seed) for c, d, _ in equal for seed in range(seeds)),
    ]
    nominal, *rows = walked_rows(carry(records))
    parts = (tuple(rows[i : i + seeds]) for i in range(0, len(rows), seeds))
    found = [Cell(c, d, part, w) for (c, d, w), part in zip([*cells, *equal], parts, strict=True)]
    few = min(seeds, PUSH_SEEDS) if pushes else 0
    begun = searches(controllers, few) + searches(again, few, given.equal_values)
    done = largest_pushes(begun, lambda records: walked_rows(carry(records)))
    split, largest = len(cells), tuple(gathered(done))
    told = tuple(controllers), tuple(conditions), seeds, nominal
    return Comparison(*told, tuple(found[:split]), tuple(found[split:]), largest)


def walked_rows(rows: Sequence[Row]) -> Sequence[Row]:
    """The rows themselves. Raises InputError for one that is no walk, with what it says."""
    for row in rows:
        if row["status"] in NO_WALK:
            raise InputError(
                f"a trial of the comparison was no walk: {row['status']}: {row['detail']}; shares of walks "
                "that make all steps would mean nothing with it"
            )
    return rows
