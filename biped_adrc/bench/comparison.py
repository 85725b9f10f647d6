"""Controllers x conditions x seeds: how often the walks are feasible, their error, torque and cost.

Under a seed every controller meets the same disturbance, model error and start, so that walks are paired by
seed. Shares of walks have Wilson's intervals; medians are taken over the walks that are feasible, the impact
at most aside, and have bootstrap intervals (`analysis.statistics`). Settings (`bench.settings`) are tuned
alike, or as published.

`compare` is given a function `carry` that turns trials into rows and knows nothing of files or processes:
`bench.compare_study` hands in one with a store, tests hand in one without walks.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from biped_adrc.bench.cell import Cell
from biped_adrc.bench.conditions import BASE, CONDITIONS, conditions_on
from biped_adrc.bench.settings import AS_PUBLISHED, TUNED, Settings
from biped_adrc.campaign.chunk import NO_WALK, Record, Row
from biped_adrc.errors import InputError
from biped_adrc.scenario.build import RIGID
from biped_adrc.scenario.registry import find, is_own, names

Carry = Callable[[Sequence[Record]], Sequence[Row]]
"""Walks trials: values of scenarios -> their rows, in order."""


def nominal_trial(settings: Settings) -> Record:
    """The trial that nothing disturbs, started on the gait: what the gait itself needs of ground and motors."""
    on_the_gait = {k: v for k, v in BASE.items() if k != "start_speed_spread"}
    return {**on_the_gait, **settings.values, "controller.name": "NPD"}


class Comparison(NamedTuple):
    """All that a comparison found."""

    controllers: tuple[str, ...]
    """Names, in the order of the tables."""
    conditions: tuple[str, ...]
    """Names, in the order of the tables."""
    seeds: int
    """Walks of each controller under each condition."""
    nominal: Row
    """The row of `nominal_trial`."""
    cells: tuple[Cell, ...]
    """One for each controller and condition, the conditions varying fastest."""
    settings: Settings = AS_PUBLISHED
    """Those with which controllers walked."""

    def cell(self, controller: str, condition: str) -> Cell:
        """The cell of a controller and a condition at the controller's own settings."""
        at = self.controllers.index(controller) * len(self.conditions)
        return self.cells[at + self.conditions.index(condition)]


def check(
    controllers: Sequence[str], conditions: Sequence[str], seeds: int, settings: Settings = TUNED
) -> None:
    """Raises InputError for a controller or a condition that there is not or is named twice, or no seeds.

    A controller of the user's own, as module:Class, is imported here, so that a failure comes before any walk.
    """
    own = tuple(filter(is_own, controllers))
    there = dict.fromkeys((*settings.contestants, *names("controller")))
    for kind, asked, known, more in (
        ("controller", controllers, tuple(there), own),
        ("condition", conditions, tuple(CONDITIONS), ()),
    ):
        if not asked or not {*asked} <= {*known, *more} or len(set(asked)) < len(asked):
            raise InputError(
                f"the comparison names the {kind}s {list(asked)}, expected different ones of {list(known)}"
            )
    for name in controllers:
        find("controller", settings.controller(name)).load()
    if seeds < 1:
        raise InputError(f"the comparison asks for {seeds} seeds, expected at least 1")


def compare(
    carry: Carry,
    controllers: Sequence[str] | None = None,
    conditions: Sequence[str] | None = None,
    seeds: int = 20,
    settings: Settings = TUNED,
) -> Comparison:
    """The whole comparison. carry: the row of each trial, in order; it may walk them here or anywhere.

    controllers, conditions: all of the settings where None. Raises InputError as `check`.
    """
    controllers = tuple(settings.contestants) if controllers is None else tuple(controllers)
    every = conditions_on(RIGID, settings.alike)
    conditions = every if conditions is None else tuple(conditions)
    check(controllers, conditions, seeds, settings)
    pairs = [(c, d) for c in controllers for d in conditions]
    records = [settings.record(d, c, seed) for c, d in pairs for seed in range(seeds)]
    nominal, *rows = walked_rows(carry([nominal_trial(settings), *records]))
    cells = [
        Cell(
            c,
            d,
            tuple(rows[k * seeds : (k + 1) * seeds]),
            settings.as_published(c, CONDITIONS[d].place),
        )
        for k, (c, d) in enumerate(pairs)
    ]
    return Comparison(controllers, conditions, seeds, nominal, tuple(cells), settings)


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
