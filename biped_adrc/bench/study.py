"""A study: trials that have some values in common and others varied.

Its points are all combinations of cases, levels of the grid, samples and seeds, the seeds fastest; they are
made one after the other, when they are asked for. Samples of a range, at random or of a Sobol sequence, are

    p = low + (high - low) w,   or   p = low (high / low)^w on a logarithmic scale,   w in [0, 1]

Before a study starts `some_points` stand for all: every level of each axis with the first of all others (of
very many numbers some, evenly), all combinations of what is named by words, and points spread over the whole.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from biped_adrc.bench.parameters import Value, nested, trial
from biped_adrc.campaign.chunk import Point, key_of, text_of
from biped_adrc.errors import BipedError, InputError
from biped_adrc.types import Array

BLOCK = 1024
"""Samples that are drawn at once; a power of two, as Sobol's sequences ask for."""

Scale = Literal["linear", "log"]


class Range(BaseModel):
    """From low to high, in the parameter's SI unit; `whole` for numbers without a fraction."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    low: float
    high: float
    scale: Scale = "linear"
    whole: bool = False

    def at(self, w: float) -> float | int:
        """The value at w in [0, 1)."""
        if self.whole:
            return int(self.low) + min(
                int(w * (self.high - self.low + 1)), int(self.high - self.low)
            )
        if self.scale == "log":
            return self.low * (self.high / self.low) ** w
        return self.low + (self.high - self.low) * w

    def levels(self, count: int) -> list[float]:
        """So many values with both ends among them, exactly."""
        if count == 1:
            return [self.low]
        a, b = self.low, self.high
        if self.scale == "log":
            a, b = math.log(a), math.log(b)
        inner = [((count - 1 - k) * a + k * b) / (count - 1) for k in range(1, count - 1)]
        if self.scale == "log":
            inner = [math.exp(x) for x in inner]
        return [self.low, *inner, self.high]


class Draw(BaseModel):
    """`count` samples of all ranges together, by a generator of this seed."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    kind: Literal["random", "sobol"]
    count: int = Field(ge=1)
    seed: int = Field(ge=0)
    ranges: dict[str, Range] = Field(min_length=1)

    def samples(self) -> Iterator[dict[str, float | int]]:
        """The samples in their order, the same each time."""
        for w in itertools.islice(self._points(), self.count):
            ranges = zip(self.ranges.items(), w.tolist(), strict=True)
            yield {name: r.at(x) for (name, r), x in ranges}

    def _points(self) -> Iterator[Array]:
        """(number of ranges,) each in [0, 1), without end."""
        random, n = np.random.default_rng(self.seed), len(self.ranges)
        if self.kind == "random":
            while True:
                yield from random.random((BLOCK, n))
        from scipy.stats import qmc

        sobol = qmc.Sobol(n, seed=random)
        while True:
            yield from sobol.random(BLOCK)


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
        drawn, count = self.draw.ranges[name], self.draw.count
        return min(count, int(drawn.high - drawn.low) + 1) if drawn.whole else count

    def given(self) -> Iterator[tuple[str, Value]]:
        """Names and values of all points, but for what is drawn."""
        yield from self.fixed.items()
        for case in self.cases:
            yield from case.values.items()
        yield from ((name, x) for name, levels in self.grid.items() for x in levels)

    def configuration(self) -> dict[str, Any]:
        """All of it as plain values."""
        return self.model_dump(mode="json")

    @property
    def hash(self) -> str:
        """The same for two studies that differ in their description only."""
        return key_of(text_of(self.model_dump(mode="json", exclude={"description"})))

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


MOST_LEVELS = 200
"""Numbers of one axis that are looked at."""
MOST_WORDS = 200
"""Combinations of words."""

At = dict[str, Value]


def rehearse(study: Study, spread: int = 100) -> None:
    """Make walks, without walking them, of points that stand for all; `spread` of them all over the study.

    Raises InputError for robots, gaits, presets, controllers, joints or coordinates that there are not, and
    for values that do not fit together.
    """
    from biped_adrc.bench.build import case

    seen = set()
    for values, at in some_points(study, spread):
        try:
            s = trial(values)
            if s.key not in seen:
                seen.add(s.key)
                case(s)
        except BipedError as error:
            name = f", case '{at[CASE]}'" if CASE in at else ""
            rest = {k: x for k, x in at.items() if k != CASE}
            where = f"study '{study.name}'{name}" + (f", at {rest}" if rest else "")
            raise InputError(f"{where}: {error}") from error


def some_points(study: Study, spread: int) -> Iterator[tuple[At, At]]:
    """Values of a trial by name, and where the point lies; each case in turn, what stands out first."""
    for named in study.cases or (Named(name=""),):
        told: At = {CASE: named.name} if named.name else {}
        for at in _some_of_a_case(study, spread // max(len(study.cases), 1) + 1):
            yield study.fixed | named.values | at, told | at


def _some_of_a_case(study: Study, spread: int) -> Iterator[At]:
    axes: dict[str, Sequence[Value]] = dict(study.grid)
    if study.seeds:
        axes[SEED] = study.seeds
    samples = _samples(study)
    sample, first = next(samples), {name: levels[0] for name, levels in axes.items()}
    for name, levels in axes.items():
        yield from (first | {name: x} | sample for x in _spaced(levels))
    worded = {
        name: levels if any(isinstance(x, str) for x in levels) else levels[:1]
        for name, levels in axes.items()
    }
    for combined in itertools.islice(itertools.product(*worded.values()), MOST_WORDS):
        yield dict(zip(worded, combined, strict=True)) | sample
    for at in _spread(axes, spread):
        yield at | next(samples)


def _samples(study: Study) -> Iterator[dict[str, Any]]:
    """Samples without end."""
    if study.draw is None:
        return itertools.repeat({})
    return itertools.cycle(itertools.islice(study.draw.samples(), MOST_LEVELS))


def _spaced(levels: Sequence[Value]) -> Iterator[Value]:
    """All words; of many numbers some, with both ends."""
    step = max(1, math.ceil(len(levels) / MOST_LEVELS))
    for i, x in enumerate(levels):
        if i % step == 0 or i == len(levels) - 1 or not isinstance(x, (int, float)):
            yield x


def _spread(axes: dict[str, Sequence[Value]], most: int) -> Iterator[At]:
    """Combinations at even distances in the order of the study, the last among them."""
    count = math.prod(map(len, axes.values()))
    some = min(most, count)
    places = {round(k * (count - 1) / max(some - 1, 1)) for k in range(some)}
    for place in sorted(places):
        at: At = dict.fromkeys(axes)
        for name, levels in reversed(axes.items()):
            place, i = divmod(place, len(levels))
            at[name] = levels[i]
        yield at
