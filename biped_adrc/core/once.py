"""Results that depend on a part alone are computed once and kept in the part, for all walks that use it.

A part is a frozen dataclass, such as a controller or a robot (`core.part`). This is done only for a part in
which nothing can change; in an object of a user's class something may, so nothing is kept there. The results
are in the part's attribute `_once`, its memory.
"""

from collections.abc import Callable, Hashable
from dataclasses import fields
from enum import Enum
from functools import wraps
from types import NoneType
from typing import Any, TypeVar

import numpy as np

from biped_adrc.core.part import is_part

_T = TypeVar("_T")
_PLAIN = (int, float, complex, str, bytes, Enum, NoneType, type, np.generic)
_REMEMBERED = 64
"""Most results that a part keeps, and most parts that `shared` keeps; then the oldest one is dropped."""


class Memory(dict[Hashable, Any]):
    """The latest results, each under a key that says from what it was computed; pickle makes an empty copy."""

    def found(self, key: Hashable, make: Callable[[], Any]) -> Any:
        """The result for this key: the one that is kept, or else what make() gives, which is kept from then
        on.
        """
        # not `in`, since another thread may drop it after that; Memory itself is the sign of no result
        if (result := self.get(key, Memory)) is Memory:
            self.keep(key, result := make())
        return result

    def keep(self, key: Hashable, result: Any) -> None:
        """Keep a result; where there are _REMEMBERED already, the oldest one goes."""
        for oldest in [*self][: max(0, len(self) + 1 - _REMEMBERED)]:
            self.pop(oldest, None)
        self[key] = result

    def __reduce__(self) -> tuple[type, tuple[()]]:
        # hashes are others in another process, and arrays come back writable: their part is asked again
        return Memory, ()


_SHARED = Memory()
"""Copies of parts that `shared` has made, by class and fields."""


def constant(x: object) -> bool:
    """Whether nothing in x can change: a number, text, read-only array, or part of this package with such.

    For a part "yes" is kept: it has a memory from then on, with that entry. A class of robots says "yes" by its
    attribute `_constant`.
    """
    if isinstance(x, np.ndarray):
        # a read-only view of a writable array can change
        return not x.flags.writeable and (x.base is None or constant(x.base))
    if isinstance(x, tuple):
        return all(map(constant, x))
    cls: Any = type(x)
    names = getattr(cls, "__dataclass_fields__", None)
    if names is None:
        # _PLAIN: classes whose values cannot change, such as float and str
        return isinstance(x, _PLAIN)
    # a part with a memory has been found constant before
    if not (hasattr(x, "_constant") or vars(x).get("_once")):
        own = cls.__module__.startswith("biped_adrc.") and cls.__dataclass_params__.frozen
        if not (own and all(constant(getattr(x, name)) for name in names)):
            return False
        # not empty, so that the test above finds it true the next time
        vars(x)["_once"] = Memory(constant=True)
    return True


def once(make: Callable[..., _T]) -> Callable[..., _T]:
    """Decorator: make(x, *more) is computed once for a part x and kept in it, so that walks that share the part
    share the result. It is computed each time if something in x, or in a part among `more`, may change.

    more: hashable arguments.
    """

    @wraps(make)
    def found(x: Any, *more: Hashable) -> _T:
        # a part with a memory is constant; most calls end here, some forty for each walk of a batch
        if memory := getattr(x, "_once", None):
            result = memory.get((make, *more), Memory)
            if result is not Memory:
                return result
        if not (is_part(x) and all(constant(part) for part in (x, *more) if is_part(part))):
            return make(x, *more)
        memory = vars(x).setdefault("_once", Memory())
        return memory.found((make, *more), lambda: make(x, *more))

    return found


def shared(part: _T, **values: Any) -> _T:
    """A copy of a part with these fields changed; the part itself if they have these values already.

    Equal calls return the same object, so that results which `once` keeps in it are found again.
    """
    items = {f.name: getattr(part, f.name) for f in fields(part)} | values  # type: ignore[arg-type]
    same = all(getattr(part, name) is x for name, x in values.items())
    # the fields are kept with the copy: while they live, no other object has the ids that are in the key
    made = lambda: (items, part if same else type(part)(**items))  # noqa: E731
    # [1]: of (fields, copy) the copy
    return _SHARED.found((type(part), *map(_known_by, items.values())), made)[1]


def _known_by(x: object) -> Hashable:
    """What stands for a field's value in a key: (class, value) of a number, or of a constant part of numbers
    alone; else its id, as to compare arrays takes longer than what is shared saves.
    """
    inside = [getattr(x, f.name) for f in fields(x)] if is_part(x) and constant(x) else [x]  # type: ignore[arg-type]
    plain = all(isinstance(i, _PLAIN) or (type(i) is tuple and constant(i)) for i in inside)
    return (type(x), *inside) if plain else id(x)
