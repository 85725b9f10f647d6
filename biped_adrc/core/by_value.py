"""Equality and hash of dataclasses by class and values, arrays included.

A dataclass compares its fields as a tuple, which raises for arrays, and so does its hash. In subclasses of
`ByValue` an array is its shape, its dtype and its numbers. NaN equals NaN, so that a thing equals itself and
its copy, and -0 equals 0.
"""

from collections.abc import Hashable, Mapping
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np


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
        # a dict of results, which `core.once` puts into an object in which nothing can change; else None
        memory = vars(self).get("_once")
        return (
            memory.found("hash", lambda: hash(value_of(self))) if memory else hash(value_of(self))
        )


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
