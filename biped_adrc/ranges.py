"""Ranges of numbers as annotations: `gain: PositiveFloat`, checked when the object is made (`parts.Checked`).

Each has the name that pydantic gives it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from numbers import Integral
from typing import Annotated, Any, NamedTuple


class Range(NamedTuple):
    """The numbers that `holds` accepts, and what a message calls them."""

    words: str
    holds: Callable[[Any], bool]


def _whole(x: Any, least: int) -> bool:
    return isinstance(x, Integral) and not isinstance(x, bool) and int(x) >= least


FiniteFloat = Annotated[float, Range("a finite number", math.isfinite)]
PositiveFloat = Annotated[float, Range("a positive number", lambda x: 0.0 < x < math.inf)]
NonNegativeFloat = Annotated[
    float, Range("zero or a positive number", lambda x: 0.0 <= x < math.inf)
]
PositiveInt = Annotated[int, Range("a whole number, at least 1", lambda x: _whole(x, 1))]
NonNegativeInt = Annotated[int, Range("a whole number >= 0", lambda x: _whole(x, 0))]
