"""What a comparison says in words, from its numbers alone: who tracks best where, who falls, who pays."""

from __future__ import annotations

from collections.abc import Iterable

from biped_adrc.studies.bench.comparison import Cell, Comparison

CLEARLY = 2.0
"""Ratio of two medians above which one is said to be better."""
HALF = 0.5


def findings(c: Comparison) -> list[str]:
    """Sentences; none that the intervals do not carry."""
    return [*_best(c), *_falls(c), *_costs(c)]


def _cells(c: Comparison, condition: str) -> list[Cell]:
    return [c.cell(controller, condition) for controller in c.controllers]


def _error(cell: Cell) -> float | None:
    found = cell.medians["peak_error"]
    return None if found is None or cell.survived.value < HALF else found.value


def _best(c: Comparison) -> Iterable[str]:
    """For each condition the smallest error, with those that are within `CLEARLY` of it."""
    for condition in c.conditions:
        errors = {cell.controller: e for cell in _cells(c, condition) if (e := _error(cell))}
        if len(errors) < 2:
            continue
        least, most = min(errors.values()), max(errors, key=lambda k: errors[k])
        near = [name for name, e in errors.items() if e <= CLEARLY * least]
        if errors[most] <= CLEARLY * least:
            yield f"{condition}: no controller tracks clearly better than another ({least:.1e} rad)."
        else:
            yield (
                f"{condition}: least error with {', '.join(near)} ({least:.1e} rad), most with {most} "
                f"({errors[most]:.1e} rad)."
            )


def _falls(c: Comparison) -> Iterable[str]:
    """Who falls where others walk."""
    for condition in c.conditions:
        cells = _cells(c, condition)
        walking = [cell for cell in cells if cell.survived.low > HALF]
        falling = [cell.controller for cell in cells if cell.survived.high < HALF]
        if walking and falling:
            yield (
                f"{condition}: {', '.join(falling)} fall in most walks where "
                f"{', '.join(cell.controller for cell in walking)} make all steps in most."
            )


def _costs(c: Comparison) -> Iterable[str]:
    """Where a controller pays with its motors."""
    for condition in c.conditions:
        costs = {
            cell.controller: found.value
            for cell in _cells(c, condition)
            if (found := cell.medians["cost_of_transport"]) is not None
            and cell.survived.value >= HALF
        }
        if costs and max(costs.values()) > 1.25 * min(costs.values()):
            high, low = max(costs, key=lambda k: costs[k]), min(costs, key=lambda k: costs[k])
            yield (
                f"{condition}: {high} needs a cost of transport of {costs[high]:.2f}, {low} "
                f"{costs[low]:.2f}."
            )
