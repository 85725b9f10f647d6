"""One number of many walks, from a column of their rows: what a search minimises, limits, and a page shows.

A row is the results of one walk by column; columns.toml has the columns with their units. A measure is such a
number: a column, and what is taken of it over all walks (median, mean, quantile or worst).

Some columns need no walk: stable, delay_margin, disk_margin and ripple are numbers of the linearised loop of a
scenario without its seed and condition (`analysis.loops.specification`), which takes some 40 ms. On soft ground
they are those of the rigid plant.

A candidate is values of a scenario that a search proposes, a condition a named set of values under which walks
are made. A walk is feasible if ground and motors could have carried it. One that is not, or has no number in
the column, ranks worst: it counts as plus infinity where less is better and as minus infinity where more is
better, and is never left out. A walk of which only the impulses at impact ask for more than the friction of the
ground (column `but_impact`) counts as feasible here.
"""

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import AfterValidator, Field, model_validator

from biped_adrc.analysis.loops.specification import Specification
from biped_adrc.core.errors import BipedError, unknown
from biped_adrc.core.types import Array
from biped_adrc.scenario.cycle import specification_of
from biped_adrc.scenario.scenario import GroundRecord
from biped_adrc.studies.build import Values, scenario_of, scene_of
from biped_adrc.studies.run import COLUMNS, WORDS
from biped_adrc.studies.space import Section

OF_ALL = ("survived", "feasible", "but_impact", "impacts", "feasible_impacts", "distance")
"""Columns that every walk has, however it ended."""
SMALLEST_SCALE = 1e-12
"""A limit's bound smaller than this counts as 0: the distance from it is then not divided by it."""
MOST_EXCESS = 1e6
"""Largest share [1] by which a limit counts as missed, so that sums are finite."""
WITHOUT_WALK = ("stable", "delay_margin", "disk_margin", "ripple")
"""Columns that need no walk: numbers of a `Specification`."""
MEASURED = (*(name for name in COLUMNS if name not in WORDS), *WITHOUT_WALK)
"""Columns with numbers, of walks and of linear loops."""

Row = Mapping[str, Any]
"""Results of one walk by column: numbers, texts or None."""


def is_made(row: Row) -> bool:
    """Whether the walk made all steps that were asked for."""
    return row.get("survived") == 1


def is_counted(row: Row) -> bool:
    """Whether the walk is feasible, or would be but for its impulses at impact, so that its error counts in the
    statistics.
    """
    return is_made(row) and 1 in (row.get("feasible"), row.get("but_impact"))


def _known(column: str) -> str:
    """The name of the column, unchanged. Raises ValueError for a column that does not exist or has no
    numbers.
    """
    if column not in MEASURED:
        raise ValueError(f"'{column}' is an {unknown(column, MEASURED)}")
    return column


Column = Annotated[str, AfterValidator(_known)]
Over = Literal["median", "mean", "worst"] | Annotated[float, Field(gt=0.0, lt=1.0)]
"""What is taken over all walks; a float in (0, 1) is that quantile: the number of the walk that is at least as
bad as this share of them, not interpolated."""


class Measure(Section):
    """A column, and how its numbers in many walks become one number."""

    column: Column
    over: Over = "median"
    condition: str | None = None
    """The measure is of the walks under this condition alone; None for all."""
    counts: Literal["feasible", "made"] = "feasible"
    """Walks that count with their number: feasible, or all that made their last step; others rank worst."""

    @property
    def sign(self) -> float:
        """1 where less is better, as here; -1 where more is, as subclasses may say."""
        return 1.0

    @property
    def words(self) -> str:
        """Words of the measure for tables and axes: "median rms_error under push"."""
        over = f"{self.over:g} quantile of" if isinstance(self.over, float) else self.over
        return f"{over} {self.column}" + (f" under {self.condition}" if self.condition else "")

    @property
    def worst(self) -> float:
        """The number of a walk that ranks worst: plus or minus infinity."""
        return self.sign * math.inf

    def number(self, row: Row) -> float:
        """The number of a walk in the unit of the column; `worst` where the walk does not count, or has none.

        Columns of OF_ALL, such as impacts or distance, have a number for every walk, however it ended; None, of
        what was no walk, is 0 in them.
        """
        x = row.get(self.column)
        if self.column in OF_ALL:
            return float(x or 0.0)
        # fine: whether the walk counts with its number
        fine = is_counted(row) if self.counts == "feasible" else is_made(row)
        return float(x) if fine and isinstance(x, int | float) else self.worst

    def of(self, walks: Sequence[tuple[str, Row]], known: Mapping[str, float | None]) -> float:
        """The measure of these walks, (condition, row) each, in the unit of the column.

        known: column -> number, for columns that need no walk; it is returned in place of one from the walks,
        and `worst`, the infinity of the worse side, for None.
        """
        if self.column in known:
            x = known[self.column]
            return self.worst if x is None else x
        rows = (row for name, row in walks if self.condition in (None, name))
        numbers: Array = np.array([self.number(row) for row in rows])
        if self.over in ("mean", "median"):
            return float(getattr(np, self.over)(numbers))
        # `over` is a quantile, such as 0.9; `sign` makes the largest number the worst, so 1.0 is that walk.
        # inverted_cdf does not interpolate: between infinite numbers, of falls, that would be NaN
        p = 1.0 if self.over == "worst" else float(self.over)
        return self.sign * float(np.quantile(self.sign * numbers, p, method="inverted_cdf"))


class Aim(Measure):
    """A measure that is to be small, or large."""

    goal: Literal["minimise", "maximise"] = "minimise"

    @property
    def sign(self) -> float:
        """1 where the measure is to be minimised, -1 where it is to be maximised."""
        return 1.0 if self.goal == "minimise" else -1.0


class Limit(Measure):
    """A measure that has to be at least, or at most, so large."""

    over: Over = "mean"
    least: float | None = None
    most: float | None = None

    @model_validator(mode="after")
    def _one(self) -> Self:
        """The limit itself. Raises ValueError for two bounds, or none."""
        if (self.least is None) == (self.most is None):
            raise ValueError("expected one of least and most")
        return self

    @property
    def sign(self) -> float:
        """1 for an upper bound `most`, -1 for a lower bound `least`."""
        return -1.0 if self.most is None else 1.0

    @property
    def bound(self) -> float:
        """The bound of the limit, `least` or `most`, in the unit of the column."""
        return float(self.least if self.most is None else self.most)  # type: ignore[arg-type]

    @property
    def sentence(self) -> str:
        """The limit in words, such as "mean feasible at least 0.9"."""
        return f"{self.words} at {'least' if self.most is None else 'most'} {self.bound:g}"

    def excess(self, x: float) -> float:
        """By how much the number x of this measure misses the limit, as a share of its bound [1]; 0 where x
        keeps it.

        It is at most MOST_EXCESS; where the bound is 0 it is the distance itself, in the unit of the column.
        """
        # a bound below 1e-12 counts as 0
        scale = abs(self.bound) if abs(self.bound) > SMALLEST_SCALE else 1.0
        return min(max(self.sign * (x - self.bound) / scale, 0.0), MOST_EXCESS)


@lru_cache(maxsize=128)
def _specification(text: str) -> Specification:
    """The numbers of the linearised loop of a scenario, cached, since a candidate is asked for several columns.

    text: JSON of the values by name, which can be a key of the cache as a dict cannot. The ground keeps its
    slope and heights, and is made rigid (the default of its record), since a loop on soft ground is not
    linearised. Raises InputError.
    """
    s = scenario_of(json.loads(text))
    g = s.ground
    s = s.replace(ground=GroundRecord(slope=g.slope, drop=g.drop, drop_step=g.drop_step, rms=g.rms))
    return specification_of(s, scene_of(s))


def numbers_without_walk(columns: Iterable[str], values: Values) -> dict[str, float | None]:
    """Compute those of the columns that need no walk, for a candidate with these values of a scenario; other
    columns are left out. Returns column -> number.

    None where there is no finite number, or where the values do not fit together.
    """
    computed = [name for name in columns if name in WITHOUT_WALK]
    text = json.dumps(values, sort_keys=True)
    try:
        result = {name: float(getattr(_specification(text), name)) for name in computed}
    except BipedError:
        return dict.fromkeys(computed)
    return {name: x if math.isfinite(x) else None for name, x in result.items()}
