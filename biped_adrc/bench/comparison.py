"""Controllers x conditions x seeds: how often each controller walks legally, with what error, torque and cost.

Under a seed every controller meets the same disturbance, model error and start, so that walks are paired by
seed. Shares of walks have Wilson's intervals; medians are taken over the walks that make all their steps
legally and have bootstrap intervals (`analysis.statistics`). Two questions are asked beside that table: how
large a push may be (`bench.largest_push`), and what is left of the differences between observers when all
have the same bandwidth.

`compare` is given a function `carry` that turns trials into rows and knows nothing of files or processes:
`bench.compare_study` hands in one with a store, tests hand in one without walks. `bench.findings` draws
conclusions from what is returned.

Walks of the table: (controllers + those with an observer once more) x conditions x seeds, here
(7 + 4) x 12 x 20 = 2640. The rest of some 17000 walks are those of the searches for the largest pushes.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from biped_adrc.bench import conditions as given
from biped_adrc.bench.cell import Cell
from biped_adrc.bench.conditions import BANDWIDTH, BASE, COMPARED, CONDITIONS, walked_again
from biped_adrc.bench.largest_push import Carry, Largest, gathered, largest_pushes, searches
from biped_adrc.campaign.chunk import NO_WALK, Row
from biped_adrc.errors import InputError
from biped_adrc.scenario.registry import find, is_own, names

PUSH_SEEDS = 5
"""Most seeds for which largest pushes are searched: each search takes some ten walks."""
NOMINAL = {k: v for k, v in BASE.items() if k != "start_speed_spread"} | {"controller": "NPD"}
"""The trial that nothing disturbs, started on the gait: what the gait itself needs of ground and motors."""


class Comparison(NamedTuple):
    """All that a comparison found."""

    controllers: tuple[str, ...]
    """Names, in the order of the tables."""
    conditions: tuple[str, ...]
    """Names, in the order of the tables."""
    seeds: int
    """Walks of each controller under each condition."""
    nominal: Row
    """The row of the trial `NOMINAL`."""
    cells: tuple[Cell, ...]
    """One for each controller and condition, the conditions varying fastest."""
    equal: tuple[Cell, ...]
    """The cells of controllers with an observer once more, all with their poles at `BANDWIDTH`."""
    pushes: tuple[Largest, ...]
    """The largest pushes, at the controllers' own settings, then at equal bandwidth."""

    def cell(self, controller: str, condition: str) -> Cell:
        """The cell of a controller and a condition at the controller's own settings."""
        at = self.controllers.index(controller) * len(self.conditions)
        return self.cells[at + self.conditions.index(condition)]

    def at_equal(self, controller: str, condition: str) -> Cell | None:
        """The cell at equal bandwidth; None for a controller without an observer."""
        at = controller, condition
        return next((c for c in self.equal if (c.controller, c.condition) == at), None)


def check(controllers: Sequence[str], conditions: Sequence[str], seeds: int) -> None:
    """Raises InputError for a controller or a condition that there is not or is named twice, or no seeds.

    A controller of the user's own, as module:Class, is imported here, so that a failure comes before any walk.
    """
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
    """The whole comparison. carry: the row of each trial, in order; it may walk them here or anywhere.

    All fixed trials go to `carry` at once; the bisections follow in rounds. Raises InputError as `check`.
    """
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
    """The rows themselves. Raises InputError, with what it says, for one that is no walk.

    A share of walks that make all steps would mean nothing with trials in it that were refused or raised.
    """
    for row in rows:
        if row["status"] in NO_WALK:
            raise InputError(
                f"a trial of the comparison was no walk: {row['status']}: {row['detail']}; shares of walks "
                "that make all steps would mean nothing with it"
            )
    return rows
