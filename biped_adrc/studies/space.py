"""What a study varies: ranges, samples and seeds, as pydantic reads them from the tables of a file.

    p = low + (high - low) w,   or   p = low (high / low)^w on a logarithmic scale

w in [0, 1) is a uniform random number or a point of a Sobol sequence; low and high are in the SI unit of p. A
field is a value of a scenario, by its dotted name such as "controller.K_p"; `Scenario.value_of(name, x)` reads
and checks a value for it, such as "2 ms" -> 0.002. A grid has levels of some fields, a draw samples of some; a
case or a condition is a set of values with a name; a seed is `run.seed` of a scenario.
"""

import math
from collections.abc import Callable, Mapping
from typing import Annotated, Any, Literal, Self, TypeVar

import numpy as np
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, model_validator

from biped_adrc.core.errors import problem
from biped_adrc.scenario.dotted import flat
from biped_adrc.scenario.records import Misfit
from biped_adrc.scenario.scenario import MOST_SEED, Scenario

EDGE = 0.05
"""A value stands at an end of a range that it is nearer to than this share of the width, on its scale."""
_MOST = 1_000_000
"""Most levels of a field, samples, and seeds."""


class Section(BaseModel):
    """Base class of the tables of a study: an object cannot be changed, and an unknown key is refused."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, populate_by_name=True
    )


def table(value: object) -> dict[str, Any]:
    """A table of a file, as a dict of its own. Raises ValueError for what is no table."""
    if not isinstance(value, Mapping):
        raise ValueError(f"found {value!r}, expected a table")
    return dict(value)


def by_entry(value: object, read_one: Callable[[str, Any], Any]) -> dict[str, Any]:
    """Dotted name -> read_one(name, value), for each entry of a table `value` of a file, which may be nested.

    A table inside it with "from", "to" or "choices" is one entry. Raises ValueError with all entries that
    `read_one` refuses.
    """
    result, wrong = {}, []
    # flat: dotted names, but for tables with one of these keys, which stay whole
    for name, x in flat(table(value), whole=("from", "to", "choices")).items():
        try:
            result[name] = read_one(name, x)
        except ValidationError as error:
            wrong += [f"{name}: {problem(one)}" for one in error.errors()]
        except ValueError as error:
            wrong.append(f"{name}: {error.text if isinstance(error, Misfit) else error}")
    if wrong:
        raise ValueError("; ".join(wrong))
    return result


class Span(Section):
    """An interval of one field, in its SI unit."""

    low: float = Field(alias="from", strict=True)
    high: float = Field(alias="to", strict=True)
    scale: Literal["linear", "log"] = "linear"
    """Equal differences of w are equal differences of p ("linear"), or equal ratios ("log")."""
    whole: bool = False
    """Whether its numbers are integers only, both ends included."""

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        """The span. Raises ValueError for low >= high, and for integers or numbers <= 0 on a log scale."""
        log = self.scale == "log"
        if self.low >= self.high or (log and (self.whole or self.low <= 0.0)):
            raise ValueError(
                f"found {self.low:g} to {self.high:g}, expected from < to; on scale 'log' from > 0, not whole"
            )
        return self

    def at(self, w: float) -> float | int:
        """The value at w in [0, 1): low at w = 0, and high only in the limit; each integer equally likely."""
        if self.whole:
            count = int(self.high - self.low)
            # `min` is for w (count + 1) that round-off lifts to count + 1
            return int(self.low) + min(int(w * (count + 1)), count)
        if self.scale == "log":
            return self.low * (self.high / self.low) ** w
        return self.low + (self.high - self.low) * w

    def share(self, x: float) -> float:
        """w of a value of the interval: 0 at low, 1 at high."""
        if self.scale == "log":
            return math.log(x / self.low) / math.log(self.high / self.low)
        return (x - self.low) / (self.high - self.low)

    def shift(self, x: float, w: float) -> float:
        """x moved by the share w of the width, on the scale of the interval, perhaps out of it; an interval
        from 0 on is not left downwards, and a whole number moves by 1 at least.
        """
        if self.scale == "log":
            return x * (self.high / self.low) ** w
        by = w * (self.high - self.low)
        by = math.copysign(max(1.0, round(abs(by))), w) if self.whole else by
        return max(x + by, 0.0) if self.low >= 0.0 else x + by

    def beyond(self, x: float) -> Self | None:
        """The interval with the end near which x stands moved outwards by its width; None where x stands at
        none, or at 0, which stays an end.
        """
        w, low, high = self.share(x), self.low, self.high
        log = self.scale == "log"
        if w > 1.0 - EDGE:
            return self.model_copy(update={"high": high * high / low if log else 2.0 * high - low})
        if w < EDGE and low != 0.0:
            down = low * low / high if log else 2.0 * low - high
            # an interval above 0 goes down to 0 at most
            return self.model_copy(update={"low": max(down, 0.0) if low > 0.0 else down})
        return None


class Levels(Span):
    """Levels of one field of the grid, evenly spaced on the scale."""

    count: int = Field(ge=1, le=_MOST)

    def levels(self) -> list[float]:
        """`count` values from low to high, with both ends exactly."""
        spaced = np.geomspace if self.scale == "log" else np.linspace
        return spaced(self.low, self.high, self.count).tolist()


R = TypeVar("R", bound=Span)


def read_range(name: str, value: object, kind: type[R] = Span) -> R:  # type: ignore[assignment]
    """The range of the field `name`, from the table {from, to, scale} `value`; both ends may have units.

    kind: class of the range, a `Span` or `Levels`. It is whole where the field takes integers only, or its
    table says so. Raises ValueError.
    """
    types, keys = Scenario.field_of(name).types, table(value)
    # an int is also taken by a field of floats, which is not whole
    whole = int in types and float not in types
    ends = {key: Scenario.value_of(name, keys[key]) for key in ("from", "to") if key in keys}
    return kind.model_validate({"whole": whole, **keys, **ends})


def read_list(name: str, value: object, least: int = 1) -> tuple[Any, ...]:
    """The values of the field `name` in a list, read with their units. Raises ValueError for less than `least`
    values, and for two that are equal.
    """
    row = value if isinstance(value, list | tuple) else ()  # () has too few values, and is refused
    result = tuple(Scenario.value_of(name, x) for x in row)
    # by their texts, as values of several types may stand in one list
    if len({repr(x) for x in result}) < max(least, len(result)):
        raise ValueError(f"found {value!r}, expected a list of different values or {{from, to}}")
    return result


def _levels(name: str, value: object) -> tuple[Any, ...]:
    """The levels of one field of the grid, from a list or {from, to, count}. Raises ValueError."""
    if isinstance(value, Mapping):
        value = read_range(name, value, Levels).levels()
    return read_list(name, value)


def _seeds(value: object) -> object:
    """The seeds that `value` of a file states: 0 .. n - 1 for a number n, `count` ones from `from` on for
    {from, count}, or a list of different ones. Raises ValueError for anything else.
    """
    # a list stands for the count here, which it is not, and is looked at below
    keys = value if isinstance(value, Mapping) else {"from": 0, "count": value}
    if set(keys) == {"from", "count"}:
        first, count = keys["from"], keys["count"]
        if type(first) is type(count) is int and 1 <= count <= _MOST:
            return tuple(range(first, first + count))
    if not isinstance(value, list | tuple) or len(set(map(repr, value))) < len(value):
        raise ValueError(f"found {value!r}, expected how many, {{from, count}}, or a list")
    return tuple(value)


Named = Annotated[dict[str, Any], BeforeValidator(lambda value: by_entry(value, Scenario.value_of))]
"""Values of a scenario by name, read with their units."""
Grid = Annotated[
    dict[str, tuple[Any, ...]], BeforeValidator(lambda value: by_entry(value, _levels))
]
"""Levels of the grid, by name of the field."""
Seed = Annotated[int, Field(ge=0, le=MOST_SEED, strict=True)]
Seeds = Annotated[tuple[Seed, ...], BeforeValidator(_seeds)]
"""Different seeds."""
Ranges = Annotated[dict[str, Span], BeforeValidator(lambda value: by_entry(value, read_range))]
"""Ranges, by name of the field."""


class Draw(Section):
    """Samples of all ranges together: each sample has one value of every field."""

    kind: Literal["random", "sobol"] = "sobol"
    """Independent uniform numbers, or a scrambled Sobol sequence, which fills space evenly."""
    count: int = Field(ge=1, le=_MOST)
    seed: int = Field(default=0, ge=0)
    ranges: Ranges = Field(min_length=1)

    @model_validator(mode="before")
    @classmethod
    def _gathered(cls, value: Any) -> Any:
        """Collect the ranges under the key `ranges`; in a file they stand beside the other keys."""
        if not isinstance(value, Mapping) or "ranges" in value:
            return value
        own = {name: x for name, x in value.items() if name in ("kind", "count", "seed")}
        return own | {"ranges": {name: x for name, x in value.items() if name not in own}}

    def samples(self) -> list[dict[str, Any]]:
        """The samples in their order, each as field -> value; the same at every call, on any machine."""
        random, n = np.random.default_rng(self.seed), len(self.ranges)
        if self.kind == "random":
            w = random.random((self.count, n))
        else:
            from scipy.stats import qmc

            # a Sobol sequence is balanced at powers of 2: the next one is drawn, and its first points are taken
            w = qmc.Sobol(n, seed=random).random_base2(math.ceil(math.log2(self.count)))
        # w (count, n): a row for each sample, a column for each range
        ranges = self.ranges.items()
        rows = (zip(ranges, row, strict=True) for row in w[: self.count].tolist())
        return [{name: r.at(x) for (name, r), x in row} for row in rows]
