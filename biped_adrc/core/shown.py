"""What records of the package have in common: equality by value, arrays included, and a text on one line.

A dataclass compares its fields as a tuple, which raises for arrays, and so does its hash. In subclasses of
`ByValue` an array is its shape, its dtype and its numbers. NaN equals NaN, so that a thing equals itself and
its copy, and -0 equals 0.

A subclass of `Shown` prints its fields that are not at their defaults, with arrays by their shape, unless it
writes its own `__repr__`.
"""

from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import MISSING, fields, is_dataclass
from enum import Enum
from itertools import zip_longest
from numbers import Real
from typing import Any

import numpy as np

from biped_adrc.core.types import T, freeze

LONGEST = 110
"""Longest line [characters]."""
FEW = 6
"""Largest number of entries with which an array is printed in full."""
SHORT = 48
"""Longest text of a part inside another one [characters]."""


class ByValue:
    """Base of dataclasses that are equal by class and fields; a class that writes its own `__eq__` keeps it."""

    KEPT = frozenset({"__eq__", "__hash__"})
    """Methods that `@dataclass` replaces by its own unless the class itself has them, not a base."""

    def __init_subclass__(cls, **kwargs: Any) -> None:
        """Copy the inherited methods in KEPT into the class, so that `@dataclass` leaves them."""
        super().__init_subclass__(**kwargs)
        for name in cls.KEPT - vars(cls).keys():
            setattr(cls, name, getattr(cls, name))

    def __eq__(self, other: object) -> bool:
        """Whether class and fields are equal; what is no dataclass equals itself alone."""
        # True for the same object; False for one of another class
        if self is other or type(self) is not type(other):
            return self is other
        return is_dataclass(self) and value_of(self) == value_of(other)

    def __hash__(self) -> int:
        """Hash of class and fields; for what is no dataclass, of its identity."""
        if not is_dataclass(self):
            return object.__hash__(self)
        # a dict of results, which `core.part.once` puts into an object in which nothing can change; else None
        if memory := vars(self).get("_once"):
            return memory.found("hash", lambda: hash(value_of(self)))
        return hash(value_of(self))


def value_of(x: Any) -> Hashable:
    """Convert x to a hashable value; two such values are equal where the x are equal by class and numbers.

    Arrays, mappings, lists, tuples and dataclasses are converted with all that is in them. All else is its own
    value, but for NaN, which is not equal to itself: the text "nan" stands for it.
    """
    if isinstance(x, np.ndarray):
        return (np.ndarray, x.shape, x.dtype.str, value_of(x.tolist()))
    if isinstance(x, Mapping):  # a set, since the order of its items does not count
        return (type(x), frozenset((name, value_of(item)) for name, item in x.items()))
    if isinstance(x, tuple | list):
        return (type(x), *map(value_of, x))
    # a dataclass with eq=False is compared by its identity
    if is_dataclass(x) and not isinstance(x, type) and type(x).__eq__ is not object.__eq__:
        return (type(x), *(value_of(getattr(x, f.name)) for f in fields(x) if f.compare))
    return "nan" if isinstance(x, float | complex) and x != x else x


class Shown(ByValue):
    """Base of dataclasses whose repr is `as_line`; a class that writes a `__repr__` keeps it."""

    # methods of a base that `@dataclass` would replace by its own
    KEPT = ByValue.KEPT | {"__repr__"}

    def __repr__(self) -> str:
        return as_line(self)


def shown(cls: type[T]) -> type[T]:
    """Decorate a NamedTuple, which would have a repr of its own, so that its repr is `as_line`."""
    cls.__repr__ = as_line  # type: ignore[method-assign]
    return cls


class Frozen(Shown):
    """Base of dataclasses whose arrays are read-only views: the arrays stay writable for their owners."""

    def __post_init__(self) -> None:
        freeze(self, *vars(self))


def as_line(thing: Any) -> str:
    """Text Name(field=value, ...) of a dataclass or NamedTuple in at most `LONGEST` characters.

    Fields at their defaults, and empty mappings, are left out.
    """
    return call_text(type(thing).__name__, ((key, short(x)) for key, x in _fields_of(thing)))


def call_text(name: str, fields: Iterable[tuple[str, str]]) -> str:
    """Text Name(field=text, ...) from pairs (field, text), cut off after `LONGEST` characters."""
    inside = ", ".join(f"{key}={text}" for key, text in fields)
    room = LONGEST - len(name) - 2  # for the parentheses
    return f"{name}({inside if len(inside) <= room else inside[: room - 3] + '...'})"


def short(x: Any) -> str:
    """Short text of a value: numbers as they are, a long array by its shape, an object with a repr longer than
    `SHORT` by its class.
    """
    if isinstance(x, np.ndarray):
        # FEW: up to so many entries an array is printed in full
        few = x.ndim == 1 and x.size <= FEW and x.dtype.kind in "bifc"
        return f"[{' '.join(f'{number:.6g}' for number in x)}]" if few else f"array{x.shape}"
    if isinstance(x, Real) and not isinstance(x, bool):
        return f"{x}"
    if isinstance(x, Enum):
        return x.name
    if callable(x) and hasattr(x, "__name__"):
        return str(x.__name__)
    text = f"{{{len(x)} keys}}" if isinstance(x, Mapping) and len(x) > 2 else repr(x)
    if len(text) <= SHORT and "\n" not in text:
        return text
    if isinstance(x, str):
        return repr(x[: SHORT - 5] + "...")
    if isinstance(x, Sequence):
        return f"({len(x)} items)"
    return f"{type(x).__name__}(...)"


def _fields_of(thing: Any) -> list[tuple[str, Any]]:
    """Names and values of the fields of a dataclass or NamedTuple that are not at their defaults."""
    # of a NamedTuple; those of a dataclass follow
    names, usual = getattr(thing, "_fields", ()), dict(getattr(thing, "_field_defaults", {}))
    if is_dataclass(thing):
        shown = [f for f in fields(thing) if f.repr and f.init]
        names = [f.name for f in shown]
        # the class knows a default that a subclass has changed
        usual |= {f.name: getattr(type(thing), f.name, MISSING) for f in shown}
        usual |= {f.name: f.default_factory() for f in shown if f.default_factory is not MISSING}
    # _same: the field has its default, or is an empty mapping
    return [(key, getattr(thing, key)) for key in names if not _same(thing, key, usual)]


def _same(thing: Any, key: str, usual: Mapping[str, Any]) -> bool:
    """Whether field `key` is not to be shown: it has its default in `usual`, or is an empty mapping."""
    x = getattr(thing, key)
    if isinstance(x, Mapping) and not x:
        return True
    if key not in usual or type(x) is not type(usual[key]):
        return False
    try:
        return bool(np.all(x == usual[key]))
    except (ValueError, TypeError):
        return False


def columns(rows: Sequence[Sequence[str]], least: int = 0, gap: int = 2) -> list[str]:
    """Format the rows of a table as lines of text, cells padded to the width of their column.

    A row of one text is a line of its own, such as a heading between rows, and does not count for the widths.
    least: least width of the first column, in characters. gap: spaces between two columns.
    """
    table = [row for row in rows if len(row) > 1]
    widths = [max(map(len, column)) for column in zip_longest(*table, fillvalue="")] or [0]
    widths[0] = max(widths[0], least)
    cells = ([x.ljust(w) for x, w in zip(row, widths, strict=False)] for row in rows)
    return [(" " * gap).join(line).rstrip() for line in cells]
