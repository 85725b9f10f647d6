"""A study: trials that share some values (`fixed`) and differ in others (`grid`, `draw`, `seeds`, `cases`,
`conditions`).

What is varied is declared once, as a `Study`, and the number of trials may be too large for memory: `points`
therefore is a generator. It takes the Cartesian product of cases, conditions, levels of the grid, samples and
seeds, in that order, the seeds varying fastest. Samples of a range come from a random generator or a Sobol
sequence:

    p = low + (high - low) w,   or   p = low (high / low)^w on a logarithmic scale,   w in [0, 1)

A study with a misspelt gait should fail before its first walk and not after an hour. `rehearse` therefore
builds the walker of a subset of the points (`some_points`), without simulating it: every level of each axis
with the first level of all others (at most about `MOST_LEVELS` of each axis, evenly spaced), all combinations
of values that are text, and points spread evenly over the whole study.

`bench.study_file` makes a `Study` from TOML; `bench.sweep` rehearses it and runs it with `campaign.execute`.

The first point of the example in `bench.study_file`:

    record   {"amplitude": 60.0, "hardware": "ideal", "push": "pulse"}     what is run, defaults left out
    at       {"case": "ideal", "delay": 0.0, "seed": 0}                    where it lies in the study
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from biped_adrc.bench.parameters import Value, nested, trial
from biped_adrc.campaign.chunk import Point, key_of, text_of
from biped_adrc.errors import BipedError, InputError
from biped_adrc.types import Array

BLOCK = 1024
"""Samples drawn at once; a power of two, since only those blocks of a Sobol sequence are balanced."""

Scale = Literal["linear", "log"]
"""How w in [0, 1) is mapped to a range: proportionally, or so that equal steps of w are equal ratios."""
Kind = Literal["random", "sobol"]
"""How samples are drawn: independent uniform numbers, or a scrambled Sobol sequence, which fills
space evenly.
"""


class Part(BaseModel):
    """A part of a study, checked by pydantic: it cannot be changed, and takes no other keys."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class Range(Part):
    """An interval of one parameter, in the parameter's SI unit.

    low, high: its ends; with scale "log" both are positive. whole: integers only, both ends included.
    """

    model_config = ConfigDict(allow_inf_nan=False)

    low: float
    high: float
    scale: Scale = "linear"
    whole: bool = False

    def at(self, w: float) -> float | int:
        """The value at w in [0, 1): low at w = 0, and high only in the limit.

        Integers get intervals of w of equal length, so that each of the high - low + 1 values is equally
        likely.
        """
        if self.whole:
            return int(self.low) + min(
                int(w * (self.high - self.low + 1)), int(self.high - self.low)
            )
        if self.scale == "log":
            return self.low * (self.high / self.low) ** w
        return self.low + (self.high - self.low) * w

    def share(self, x: float) -> float:
        """The w in [0, 1] of a value x: the inverse of `at`, of an integer the middle of its interval."""
        a, b = self.low, self.high
        if self.whole:
            return (x - a + 0.5) / (b - a + 1.0)
        if self.scale == "log":
            return math.log(x / a) / math.log(b / a)
        return (x - a) / (b - a)

    def levels(self, count: int) -> list[float]:
        """`count` values from low to high, evenly spaced on the scale.

        Both ends are returned exactly as given, without the round-off of exp(log(x)); a single level is low.
        """
        if count == 1:
            return [self.low]
        a, b = self.low, self.high
        if self.scale == "log":
            a, b = math.log(a), math.log(b)
        inner = [((count - 1 - k) * a + k * b) / (count - 1) for k in range(1, count - 1)]
        if self.scale == "log":
            inner = [math.exp(x) for x in inner]
        return [self.low, *inner, self.high]


class Draw(Part):
    """`count` samples of all ranges together: each sample gives one value to every parameter of `ranges`.

    kind: "random" or "sobol". seed: of NumPy's generator; the same seed gives the same samples on any machine.
    """

    kind: Kind
    count: int = Field(ge=1)
    seed: int = Field(ge=0)
    ranges: dict[str, Range] = Field(min_length=1)

    def samples(self) -> Iterator[dict[str, Value]]:
        """The `count` samples in their order, each a value by parameter name; the same at every call."""
        for w in itertools.islice(self._points(), self.count):
            ranges = zip(self.ranges.items(), w.tolist(), strict=True)
            yield {name: r.at(x) for (name, r), x in ranges}

    def _points(self) -> Iterator[Array]:
        """Points w, each of shape (number of ranges,) in [0, 1), drawn in blocks and without end."""
        random, n = np.random.default_rng(self.seed), len(self.ranges)
        if self.kind == "random":
            while True:
                yield from random.random((BLOCK, n))
        from scipy.stats import qmc

        sobol = qmc.Sobol(n, seed=random)
        while True:
            yield from sobol.random(BLOCK)


CASE, CONDITION, SEED = "case", "condition", "seed"
"""Names under which the case, the condition and the seed of a point stand beside its parameters."""
NAMES = (CASE, CONDITION)
"""Those of them that are words."""
MOST_POINTS = 10**9
"""Largest number of points that a study may have; more is taken for a mistake in the file."""


class Named(Part):
    """A case or a condition: values by parameter under a name, such as {"counts": 8192} as "encoders".

    They take precedence over the fixed values of the study.
    """

    name: str
    values: dict[str, Value] = {}


class Study(Part):
    """What is varied and what is not, in SI units, checked: `read_study` makes it of a file or of
    plain tables.
    """

    name: str
    """How results, tables and errors call it."""
    description: str = ""
    """A text for the reader; it takes no part in the hash."""
    fixed: dict[str, Value] = {}
    """Values by parameter that all points share, unless their case says otherwise."""
    grid: dict[str, tuple[Value, ...]] = {}
    """Levels by parameter; all combinations are run."""
    draw: Draw | None = None
    """Samples, each combined with every combination of the grid; None for none."""
    seeds: tuple[int, ...] = Field(default=(), description="The trial's own seed without.")
    """Seeds of the scenario, run for each combination; empty: the scenario's own seed."""
    cases: tuple[Named, ...] = ()
    """Sets of values, each run over the whole grid and all samples; empty: the fixed values alone."""
    conditions: tuple[Named, ...] = ()
    """More sets of other values, each combined with each case; empty: none."""

    @property
    def count(self) -> int:
        """The number of its points: levels x samples x cases x conditions x seeds."""
        levels = math.prod(len(levels) for levels in self.grid.values())
        samples = 1 if self.draw is None else self.draw.count
        return levels * samples * self.sets * max(len(self.seeds), 1)

    @property
    def sets(self) -> int:
        """The number of combinations of a case and a condition, at least 1."""
        return max(len(self.cases), 1) * max(len(self.conditions), 1)

    @property
    def varied(self) -> tuple[str, ...]:
        """The names by which two points differ, in the order of the columns: the case, the condition, the
        parameters, the seed.
        """
        drawn = () if self.draw is None else tuple(self.draw.ranges)
        named = (*((CASE,) if self.cases else ()), *((CONDITION,) if self.conditions else ()))
        return (*named, *self.grid, *drawn, *((SEED,) if self.seeds else ()))

    def levels(self, name: str) -> int:
        """How many values the axis `name` of `varied` takes at most; 1 for a name that is not varied."""
        if name in NAMES:
            return len(self.cases if name == CASE else self.conditions)
        if name in self.grid:
            return len(self.grid[name])
        if name == SEED and self.seeds:
            return len(self.seeds)
        if self.draw is None or name not in self.draw.ranges:
            return 1
        drawn, count = self.draw.ranges[name], self.draw.count
        return min(count, int(drawn.high - drawn.low) + 1) if drawn.whole else count

    def given(self) -> Iterator[tuple[str, Value]]:
        """Names and values that any point uses, apart from samples: where files and classes of the user may be
        named.
        """
        yield from self.fixed.items()
        for named in (*self.cases, *self.conditions):
            yield from named.values.items()
        yield from ((name, x) for name, levels in self.grid.items() for x in levels)

    def configuration(self) -> dict[str, object]:
        """The whole study as plain values, from which `load_sweep` makes it again; stored with the results."""
        return self.model_dump(mode="json")

    @property
    def hash(self) -> str:
        """A hash of everything but the description: results of a study with another hash are never mixed with
        these.
        """
        apart = {"description"} if self.conditions else {"description", "conditions"}
        return key_of(text_of(self.model_dump(mode="json", exclude=apart)))

    def named(self) -> Iterator[tuple[dict[str, Value], dict[str, Value]]]:
        """For each case under each condition: the values that all of its points share, and its names."""
        for case, condition in itertools.product(self.cases or (None,), self.conditions or (None,)):
            values, names = dict(self.fixed), dict[str, Value]()
            for kind, one in zip(NAMES, (case, condition), strict=True):
                if one is not None:
                    values |= one.values
                    names[kind] = one.name
            yield values, names

    def points(self) -> Iterator[Point]:
        """All points, one after the other: the record of the trial, and the varied values that locate it.

        Values that do not fit together (a rate limit without sampling, say) still make a point. Its record has
        the values as they are, and its run becomes a row with the status REFUSED.
        """
        for values, named in self.named():
            for levels in itertools.product(*self.grid.values()):
                level = dict(zip(self.grid, levels, strict=True))
                for sample in self.samples():
                    for seed in self.seeds or (None,):
                        at = level | sample | ({} if seed is None else {SEED: seed})
                        yield Point(record_of(values | at), named | at)

    def samples(self) -> Iterator[dict[str, Value]]:
        """What is drawn, by parameter, for each sample; one empty sample where nothing is drawn."""
        return iter([{}]) if self.draw is None else self.draw.samples()


def too_many(study: Study) -> str:
    """The sentence for a study with more than `MOST_POINTS` points, behind its name."""
    found, most = f"{study.count:.3g}", f"{MOST_POINTS:.0e}"
    return f"has {found} points, expected at most {most}; give fewer levels, samples or seeds"


def record_of(values: dict[str, Value]) -> dict[str, object]:
    """The trial's record: the values that differ from the scenario's defaults, by which runs are identified.

    Where no scenario takes these values together, the values themselves, sorted by name.
    """
    try:
        return trial(values).record()
    except InputError:
        return dict(sorted(nested(values).items()))


MOST_LEVELS = 200
"""Levels of one axis, and samples, that a rehearsal looks at."""
MOST_WORDS = 200
"""Combinations of values given as text that a rehearsal looks at."""

At = dict[str, Value]
"""Values by name: of a trial, or those that locate a point."""


def rehearse(study: Study, spread: int = 100) -> None:
    """Build the walkers of points that stand for all of the study, without simulating them.

    spread: how many of them lie evenly over the whole study. Two points with the same scenario are built once.
    Raises InputError, with the study, the case and the point, for a robot, gait, preset, controller, joint or
    coordinate that does not exist, and for values that do not fit together.
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
            name = "".join(f", {kind} '{at[kind]}'" for kind in NAMES if kind in at)
            rest = {k: x for k, x in at.items() if k not in NAMES}
            where = f"study '{study.name}'{name}" + (f", at {rest}" if rest else "")
            raise InputError(f"{where}: {error}") from error


def some_points(study: Study, spread: int) -> Iterator[tuple[At, At]]:
    """Points that stand for all: (values of the trial by name, values that locate the point).

    Case by case under each condition; first the extremes of each axis, then combinations of text, then about
    `spread` points in all that lie evenly over the study.
    """
    for values, named in study.named():
        for at in _some_of_a_case(study, spread // study.sets + 1):
            yield values | at, named | at


def _some_of_a_case(study: Study, spread: int) -> Iterator[At]:
    """The points of `some_points` for one case under one condition, as values by axis.

    Of the seeds, which draw numbers alone, the first and the last stand for all.
    """
    axes: dict[str, Sequence[Value]] = dict(study.grid)
    if study.seeds:
        axes[SEED] = tuple(dict.fromkeys((study.seeds[0], study.seeds[-1])))
    samples = itertools.cycle(itertools.islice(study.samples(), MOST_LEVELS))
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


def _spaced(levels: Sequence[Value]) -> Iterator[Value]:
    """At most about `MOST_LEVELS` levels of an axis, evenly spaced, the last one included; every text among
    them.
    """
    step = max(1, math.ceil(len(levels) / MOST_LEVELS))
    for i, x in enumerate(levels):
        if i % step == 0 or i == len(levels) - 1 or not isinstance(x, (int, float)):
            yield x


def _spread(axes: dict[str, Sequence[Value]], most: int) -> Iterator[At]:
    """At most `most` combinations at even distances in the order of the study, the first and the last among
    them.

    The index of a combination is a number in a mixed radix whose digits are the levels of the axes.
    """
    count = math.prod(map(len, axes.values()))
    some = min(most, count)
    places = {round(k * (count - 1) / max(some - 1, 1)) for k in range(some)}
    for place in sorted(places):
        at: At = dict.fromkeys(axes)
        for name, levels in reversed(axes.items()):
            place, i = divmod(place, len(levels))
            at[name] = levels[i]
        yield at
