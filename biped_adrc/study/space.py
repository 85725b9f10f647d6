"""What a study varies: ranges, samples and seeds, as pydantic reads them from the tables of a file.

p = low + (high - low) w,   or   p = low (high / low)^w on a logarithmic scale,   w in [0, 1)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, model_validator

from biped_adrc.study.parameters import Refused, check_seed, field_of, flat, read

MOST = 1_000_000
"""Most levels of a field, samples, and seeds."""


class Part(BaseModel):
    """A part of a study: it cannot be changed, and takes no other keys."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


def each(given: object, read_one: Callable[[str, Any], Any]) -> dict[str, Any]:
    """`read_one(name, value)` for each entry of a table. Raises ValueError with all entries that it refuses."""
    if not isinstance(given, Mapping):
        raise ValueError(f"found {given!r}, expected a table")
    found, wrong = {}, []
    for name, x in flat(given).items():
        try:
            found[name] = read_one(name, x)
        except ValueError as error:
            wrong.append(f"{name}: {error}")
    if wrong:
        raise ValueError("; ".join(wrong))
    return found


class Range(Part):
    """An interval of one field, in its SI unit."""

    low: float
    high: float
    scale: Literal["linear", "log"] = "linear"
    """Equal steps of w are equal steps, or equal ratios."""
    whole: bool = False
    """Integers only, both ends included."""

    def at(self, w: float) -> float | int:
        """The value at w in [0, 1): low at w = 0, and high only in the limit; each integer equally likely."""
        if self.whole:
            count = int(self.high - self.low)
            return int(self.low) + min(int(w * (count + 1)), count)
        if self.scale == "log":
            return self.low * (self.high / self.low) ** w
        return self.low + (self.high - self.low) * w

    def levels(self, count: int) -> list[float]:
        """`count` values from low to high, evenly spaced on the scale, with both ends exactly."""
        spaced = np.geomspace if self.scale == "log" else np.linspace
        found = spaced(self.low, self.high, count).tolist()
        return [self.low, *found[1:-1], self.high][:count]


def read_range(name: str, given: object, *more: str) -> Range:
    """The range {from, to, scale} of a number, read with its unit. more: keys that may be there besides.

    Raises ValueError.
    """
    field = field_of(name)
    keys = ("from", "to", "scale", "whole", *more)
    if not isinstance(given, Mapping) or not {"from", "to"} <= set(given) <= set(keys):
        raise Refused(f"found {given!r}, expected {{{', '.join(keys)}}}")
    if field.types and not field.number:
        raise Refused("has no ranges; give a list of values")
    low, high = read(name, given["from"]), read(name, given["to"])
    scale, whole = (
        given.get("scale", "linear"),
        given.get("whole", int in field.types and float not in field.types),
    )
    if scale not in ("linear", "log") or type(whole) is not bool:
        raise Refused(
            f"found scale {scale!r}, whole {whole!r}, expected 'linear' or 'log', and true or false"
        )
    if not isinstance(low, int | float) or not isinstance(high, int | float) or low >= high:
        raise Refused(f"found from {given['from']!r} to {given['to']!r}, expected from < to")
    if scale == "log" and (low <= 0.0 or whole):
        raise Refused("a logarithmic scale expects a field with a fraction and from > 0")
    return Range(low=low, high=high, scale=scale, whole=whole)


def _levels(name: str, given: object) -> tuple[Any, ...]:
    """The levels of one field of the grid, from a list or {from, to, count}. Raises ValueError."""
    if isinstance(given, Mapping):
        count = given.get("count")
        if type(count) is not int or not 1 <= count <= MOST:
            raise Refused(f"found count {count!r}, expected a whole number from 1 to {MOST}")
        given = read_range(name, given, "count").levels(count)
    if not isinstance(given, list) or not given:
        raise Refused(f"found {given!r}, expected a list of values or {{from, to, count}}")
    levels = tuple(read(name, x) for x in given)
    if len({repr(x) for x in levels}) < len(levels):
        raise Refused(f"found {given!r}, expected different values")
    return levels


def _seeds(given: object) -> object:
    """The seeds 0 .. n-1 of a number n, those of {from, count}, or of a list of different ones."""
    if type(given) is int and 1 <= given <= MOST:
        return tuple(range(given))
    if isinstance(given, Mapping) and set(given) == {"from", "count"}:
        first, count = check_seed(given["from"]), given["count"]
        if type(count) is int and 1 <= count <= MOST:
            return tuple(range(first, first + count))
    if not isinstance(given, list | tuple) or len(set(map(repr, given))) < len(given):
        raise ValueError(f"found {given!r}, expected how many, {{from, count}}, or a list")
    return tuple(check_seed(x) for x in given)


Values = Annotated[dict[str, Any], BeforeValidator(lambda given: each(given, read))]
"""Values of a scenario by name, read with their units."""
Sets = dict[str, Values]
"""Values by name of the case or condition."""
Grid = Annotated[dict[str, tuple[Any, ...]], BeforeValidator(lambda given: each(given, _levels))]
"""Levels by name."""
Seeds = Annotated[tuple[int, ...], BeforeValidator(_seeds)]
"""Different seeds."""
Ranges = Annotated[dict[str, Range], BeforeValidator(lambda given: each(given, read_range))]
"""Ranges by name."""


class Draw(Part):
    """Samples of all ranges together: each sample has one value of every field."""

    kind: Literal["random", "sobol"] = "sobol"
    """Independent uniform numbers, or a scrambled Sobol sequence, which fills space evenly."""
    count: int = Field(ge=1, le=MOST)
    seed: int = Field(default=0, ge=0)
    ranges: Ranges = Field(min_length=1)

    @model_validator(mode="before")
    @classmethod
    def _gathered(cls, given: Any) -> Any:
        """Ranges stand beside the other keys in a file."""
        if not isinstance(given, Mapping) or "ranges" in given:
            return given
        own = {name: x for name, x in given.items() if name in ("kind", "count", "seed")}
        return own | {"ranges": {name: x for name, x in given.items() if name not in own}}

    def samples(self) -> list[dict[str, Any]]:
        """The samples in their order, each a value by name; the same at every call, on any machine."""
        random, n = np.random.default_rng(self.seed), len(self.ranges)
        if self.kind == "random":
            w = random.random((self.count, n))
        else:
            from scipy.stats import qmc

            w = qmc.Sobol(n, seed=random).random_base2(math.ceil(math.log2(self.count)))
        pairs = self.ranges.items()
        return [
            {name: r.at(x) for (name, r), x in zip(pairs, row, strict=True)}
            for row in w[: self.count].tolist()
        ]
