"""The cells of the study of soft ground, and each case held against NPD in the same cell.

A cell is a gait on a ground under a push. `Pair` is what a case and NPD did there; shares and medians of the
page are of such pairs. A walk that was not made is no pair with a ratio, and counts as one that misses the
goal.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from statistics import median
from typing import Any, NamedTuple

Row = Mapping[str, Any]
"""What is kept of a walk."""
NPD = "NPD"
UNPUSHED = "none"
AT_MOST, TRANSIENT, SHARE = 0.25, 1.1, 0.95
"""The goal: a push's error and a touchdown's as multiples of NPD's, and in how many of the pushed cells."""
NO_SLIP = 5e-3
"""A walk without slip: no foot slips further in a step [m]."""
WHERE = ("gait", "ground_friction", "time_constant", "condition")
"""What makes a cell."""


class Pair(NamedTuple):
    """A case and NPD in the same cell."""

    case: Row
    npd: Row

    def ratio(self, column: str) -> float | None:
        """Of the case's number to NPD's; None where one of both did not walk or has none."""
        mine, its = self.case[column], self.npd[column]
        if not (self.case["survived"] and self.npd["survived"]) or mine is None or not its:
            return None
        return float(mine / its)


def cell(row: Row) -> tuple[Any, ...]:
    """Where a walk is in the study."""
    return tuple(row[name] for name in WHERE)


def cases(rows: Iterable[Row]) -> list[str]:
    """In their order."""
    return list(dict.fromkeys(row["case"] for row in rows))


def of(rows: Iterable[Row], **given: object) -> list[Row]:
    """The rows with these values."""
    return [row for row in rows if all(row[name] == x for name, x in given.items())]


def pairs(rows: Sequence[Row], case: str) -> list[Pair]:
    """A case beside NPD in each cell in which NPD walks."""
    npd = {cell(row): row for row in of(rows, case=NPD, survived=1)}
    return [Pair(row, npd[cell(row)]) for row in of(rows, case=case) if cell(row) in npd]


def pushed(found: Iterable[Pair]) -> list[Pair]:
    """Those in which something pushes."""
    return [pair for pair in found if pair.case["condition"] != UNPUSHED]


def unpushed(found: Iterable[Pair]) -> list[Pair]:
    """Those in which nothing does."""
    return [pair for pair in found if pair.case["condition"] == UNPUSHED]


def kept(found: Sequence[Pair], column: str, limit: float) -> int:
    """In how many pairs the ratio is at most `limit`."""
    return sum((x := pair.ratio(column)) is not None and x <= limit for pair in found)


def missed(found: Iterable[Pair]) -> list[Pair]:
    """Those in which the error of the push is more than a quarter of NPD's, or the case does not walk."""
    return [pair for pair in found if not kept([pair], "pushed_error", AT_MOST)]


def ratios(found: Iterable[Pair], column: str) -> list[float]:
    """Those that there are, from the least to the largest."""
    return sorted(x for pair in found if (x := pair.ratio(column)) is not None)


def middle(numbers: Sequence[float]) -> float | None:
    """The median, None of nothing."""
    return median(numbers) if numbers else None


def without_slip(row: Row) -> bool:
    """Whether a walk is made and no foot slips."""
    return bool(row["survived"]) and row["slip"] is not None and row["slip"] <= NO_SLIP


def floors(rows: Sequence[Row], found: Iterable[Pair]) -> list[tuple[Pair, float]]:
    """Pairs under the paper's push beside the error that NPD has in the window of that push without any push,
    as a multiple of its error with it.
    """
    alone = {cell(row)[:-1]: row for row in of(rows, case=NPD, condition=UNPUSHED, survived=1)}
    return [
        (pair, alone[at]["pushed_error"] / pair.npd["pushed_error"])
        for pair in found
        if pair.case["condition"] == "paper" and (at := cell(pair.case)[:-1]) in alone
    ]


def meets(found: Sequence[Pair]) -> bool:
    """Whether a case meets the goal in the pairs of all cells in which NPD walks."""
    those = pushed(found)
    errors = kept(those, "pushed_error", AT_MOST) >= SHARE * len(those)
    transients = kept(found, "touchdown_error", TRANSIENT) == len(found)
    return bool(those) and errors and transients


def nearest(rows: Sequence[Row]) -> str:
    """The case whose error of a push is at most a quarter of NPD's in most cells, of those that walk wherever
    NPD walks if there are any.
    """
    found = {case: pairs(rows, case) for case in cases(rows) if case != NPD}
    steady = [case for case, x in found.items() if all(pair.case["survived"] for pair in x)]
    key: Callable[[str], int] = lambda case: kept(pushed(found[case]), "pushed_error", AT_MOST)  # noqa: E731
    return max(steady or found, key=key)
