"""A measure: one number of a candidate, from a column of the rows of its walks.

A walk that is not feasible (the impact at most aside), or has no number in the column, ranks worst: it counts
as plus infinity where less is better and as minus infinity where more is better, and is never dropped. What is
asked over all walks is

    median, mean, worst, or a quantile p in (0, 1), of which the next worse walk counts, without interpolation.

The columns of `OF_ALL` say by themselves what became of a walk; there what was no walk counts as 0.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Literal

import numpy as np
from pydantic import Field

from biped_adrc.bench.cell import is_counted, is_made, number
from biped_adrc.bench.study import Part
from biped_adrc.campaign.chunk import Row
from biped_adrc.types import Array

OF_ALL = ("survived", "feasible", "but_impact", "impacts", "feasible_impacts", "distance")
"""Columns that every walk has, however it ended."""
SMALLEST_SCALE = 1e-12
"""Of a limit: below this a bound counts as 0, and what is beyond it is not divided by it."""

Counts = Literal["feasible", "made"]
"""Which walks count with their number: feasible ones (the impact aside), or all that make their steps."""
Walks = Sequence[tuple[str, Row]]
"""Walks of a candidate: the name of the condition of each, and its row."""


class Measure(Part):
    """A column, and how the walks of a candidate make one number of it."""

    column: str
    """Of `bench.run.COLUMNS`, or of `without_walk.WITHOUT_WALK`."""
    over: Literal["median", "mean", "worst"] | float = "median"
    """What is taken over all walks: a float is a quantile."""
    condition: str | None = None
    """The walks under this condition alone; None for all."""
    counts: Counts = "feasible"
    """Walks that count with their number; all others rank worst."""

    @property
    def less_is_better(self) -> bool:
        """The direction in which walks are ranked."""
        raise NotImplementedError

    @property
    def words(self) -> str:
        """Of the measure, for tables and axes: "median rms_error under push"."""
        over = f"{self.over:g} quantile of" if isinstance(self.over, float) else self.over
        under = "" if self.condition is None else f" under {self.condition}"
        return f"{over} {self.column}{under}"

    def measured(self, walks: Walks, known: Mapping[str, float | None]) -> float:
        """The measure of a candidate. known: its columns that need no walk, by name; None ranks worst."""
        if self.column not in known:
            return self.of(self.numbers(walks))
        x = known[self.column]
        return self.worst if x is None else x

    def numbers(self, walks: Walks) -> Array:
        """The number of each walk, (N,), with infinity of either sign for those that rank worst."""
        rows = [row for name, row in walks if self.condition in (None, name)]
        return np.array([self._number(row) for row in rows])

    def _number(self, row: Row) -> float:
        x = number(row, self.column)
        if self.column in OF_ALL:
            return 0.0 if x is None else x
        return x if self.fine(row) and x is not None else self.worst

    def fine(self, row: Row) -> bool:
        """Whether a walk counts with its number."""
        return is_counted(row) if self.counts == "feasible" else is_made(row)

    @property
    def worst(self) -> float:
        """The number of a walk that ranks worst."""
        return math.inf if self.less_is_better else -math.inf

    def of(self, x: Array) -> float:
        """The measure of the numbers of walks; of several sets (B, N) at once it is an array (B,)."""
        return float(self.of_each(x[None, :])[0])

    def of_each(self, x: Array) -> Array:
        """The measure of each row of x (B, N), as (B,)."""
        if self.over == "mean":
            return np.asarray(x.mean(axis=1))
        ranked = np.sort(x if self.less_is_better else -x, axis=1)
        n = x.shape[1]
        if self.over == "median":
            found = (ranked[:, (n - 1) // 2] + ranked[:, n // 2]) / 2.0
        else:
            p = 1.0 if self.over == "worst" else float(self.over)
            found = ranked[:, min(math.ceil(p * n), n) - 1]
        return found if self.less_is_better else -found


class Aim(Measure):
    """A measure that is to be small, or large."""

    goal: Literal["minimise", "maximise"] = "minimise"

    @property
    def less_is_better(self) -> bool:
        return self.goal == "minimise"


class Limit(Measure):
    """A measure that has to be at least, or at most, so large."""

    over: Literal["median", "mean", "worst"] | float = "mean"
    least: float | None = Field(default=None, allow_inf_nan=False)
    most: float | None = Field(default=None, allow_inf_nan=False)

    @property
    def less_is_better(self) -> bool:
        return self.most is not None

    @property
    def bound(self) -> float:
        """The one of both that is given."""
        return float(self.least if self.most is None else self.most)  # type: ignore[arg-type]

    @property
    def sentence(self) -> str:
        """ "mean feasible at least 0.9"."""
        return f"{self.words} at {'most' if self.less_is_better else 'least'} {self.bound:g}"

    def excess(self, x: float) -> float:
        """By how much x misses the limit, as a share of its bound; 0 where the limit is kept."""
        beyond = x - self.bound if self.less_is_better else self.bound - x
        scale = abs(self.bound) if abs(self.bound) > SMALLEST_SCALE else 1.0
        return max(beyond / scale, 0.0)
