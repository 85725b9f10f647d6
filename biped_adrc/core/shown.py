"""Short texts of objects for printing: one line, with arrays by their shape.

A subclass of `Shown` prints its fields that are not at their defaults, unless it writes its own `__repr__`.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import MISSING, fields, is_dataclass
from enum import Enum
from itertools import zip_longest
from numbers import Real
from typing import Any

import numpy as np

from biped_adrc.core.by_value import ByValue

LONGEST = 110
"""Longest line [characters]."""
FEW = 6
"""Largest number of entries with which an array is printed in full."""
SHORT = 48
"""Longest text of a part inside another one [characters]."""


class Shown(ByValue):
    """Base of dataclasses whose repr is `as_line`; a class that writes a `__repr__` keeps it."""

    # methods of a base that `@dataclass` would replace by its own
    KEPT = ByValue.KEPT | {"__repr__"}

    def __repr__(self) -> str:
        return as_line(self)


def as_line(thing: Any) -> str:
    """Text Name(field=value, ...) of a dataclass or NamedTuple in at most `LONGEST` characters.

    Fields at their defaults, and empty mappings, are left out.
    """
    return call_text(type(thing).__name__, ((key, short(x)) for key, x in _fields_of(thing)))


def call_text(name: str, fields: Iterable[tuple[str, str]]) -> str:
    """Text Name(field=text, ...) from pairs (field, text), cut off after `LONGEST` characters."""
    told = ", ".join(f"{key}={text}" for key, text in fields)
    room = LONGEST - len(name) - 2  # for the parentheses
    return f"{name}({told if len(told) <= room else told[: room - 3] + '...'})"


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
