"""A study: trials that have some values in common and others varied.

Its points are all combinations of cases, levels of the grid, samples and seeds, the seeds fastest; they are
made one after the other, when they are asked for.
"""

from __future__ import annotations

import hashlib
import itertools
import json
import math
from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from biped_adrc.errors import InputError
from biped_adrc.studies.bench.parameters import Value, nested, trial
from biped_adrc.studies.bench.points import Point
from biped_adrc.studies.bench.samples import Draw

CASE, SEED = "case", "seed"
MOST_POINTS = 10**9
"""Of a study."""


class Named(BaseModel):
    """A partial set of parameters by name; they go before the study's fixed ones."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str
    values: dict[str, Value] = {}


class Study(BaseModel):
    """What is varied and what is not, in SI units: as `read_study` makes it of a file or of plain tables."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str
    description: str = ""
    fixed: dict[str, Value] = {}
    grid: dict[str, tuple[Value, ...]] = {}
    draw: Draw | None = None
    seeds: tuple[int, ...] = Field(default=(), description="The trial's own seed without.")
    cases: tuple[Named, ...] = ()

    @property
    def count(self) -> int:
        """The number of its points."""
        levels = math.prod(len(levels) for levels in self.grid.values())
        samples = 1 if self.draw is None else self.draw.count
        return levels * samples * max(len(self.cases), 1) * max(len(self.seeds), 1)

    @property
    def varied(self) -> tuple[str, ...]:
        """What a point is told apart by: the case, parameters by name, the seed."""
        drawn = () if self.draw is None else tuple(self.draw.ranges)
        case = (CASE,) if self.cases else ()
        return (*case, *self.grid, *drawn, *((SEED,) if self.seeds else ()))

    def levels(self, name: str) -> int:
        """How many values of one of `varied` there may be."""
        if name == CASE:
            return len(self.cases)
        if name in self.grid:
            return len(self.grid[name])
        if name == SEED and self.seeds:
            return len(self.seeds)
        if self.draw is None or name not in self.draw.ranges:
            return 1
        drawn = self.draw.ranges[name]
        return min(
            self.draw.count, int(drawn.high - drawn.low) + 1 if drawn.whole else self.draw.count
        )

    def configuration(self) -> dict[str, Any]:
        """All of it as plain values."""
        return self.model_dump(mode="json")

    @property
    def hash(self) -> str:
        """The same for two studies that differ in their description only."""
        text = json.dumps(self.model_dump(mode="json", exclude={"description"}), sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:32]

    def points(self) -> Iterator[Point]:
        """One after the other; where values do not fit together the record has them as they are."""
        for case in self.cases or (None,):
            values = self.fixed | ({} if case is None else case.values)
            named: dict[str, Value] = {} if case is None else {CASE: case.name}
            for levels in itertools.product(*self.grid.values()):
                level = dict(zip(self.grid, levels, strict=True))
                for sample in self._samples():
                    for seed in self.seeds or (None,):
                        at = level | sample | ({} if seed is None else {SEED: seed})
                        yield Point(record_of(values | at), named | at)

    def _samples(self) -> Iterator[dict[str, Any]]:
        return iter([{}]) if self.draw is None else self.draw.samples()


def too_many(study: Study) -> str:
    """In words, of a study with more than `MOST_POINTS`."""
    found, most = f"{study.count:.3g}", f"{MOST_POINTS:.0e}"
    return f"has {found} points, expected at most {most}; give fewer levels, samples or seeds"


def record_of(values: dict[str, Value]) -> dict[str, Any]:
    """The trial's record of values by name, or the values themselves where no scenario has them together."""
    try:
        return trial(values).record()
    except InputError:
        return dict(sorted(nested(values).items()))
