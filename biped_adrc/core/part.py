"""Parts of a walker: frozen dataclasses with ordinary methods, run by Python or by the *engine*, a compiler.

A walker is the closed loop of a robot, its controller, disturbances and clock. Controllers, observers,
references, disturbances, sensors and touchdown detectors are parts, and parts may hold parts. Python calls
their methods on numbers. The engine calls them once on symbols and writes machine code:

    floats, arrays of floats       numbers, given at run time: new values compile nothing
    whole numbers, flags, texts    structure: another value is another code
    derived                        numbers that are computed once from the fields, such as gains from poles
    setup                          fields that only derived numbers and the initial state use, such as a seed

A method with an `if` on a number (`if x > 0`) cannot be compiled; it runs in Python. Write `np.where` instead.

Results that depend on a part alone are computed once (`once`) and kept in the part, for all walks that use it.
This is done only for a part in which nothing can change; in an object of a user's class something may, so
nothing is kept there. The results are in the part's attribute `_once`, its memory.
"""

from abc import ABC
from collections.abc import Callable, Hashable, Mapping
from dataclasses import field, fields
from enum import Enum
from functools import cached_property, wraps
from types import NoneType
from typing import Any

import numpy as np

from biped_adrc.core.checks import Checked, hints_of, per_class
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import T, frozen


class derived(cached_property[Any]):
    """A method whose value is computed once for each object, from its fields, and is read-only.

    func: the method, with no argument but `self`. Machine code uses the numbers that it returns: a pole
    placement, for instance, is not run on symbols, but its gains are used.

    >>> @dataclass(frozen=True)
    ... class Damped:
    ...     K_p: float  # [1/s^2]
    ...
    ...     @ba.derived
    ...     def K_d(self):
    ...         return 2.0 * np.sqrt(self.K_p)  # a double pole
    >>> float(Damped(2500.0).K_d)
    100.0
    """

    def __init__(self, func: Callable[[Any], Any]) -> None:
        super().__init__(wraps(func)(lambda part: frozen(func(part))))


class Part(Checked, Shown, ABC):
    """Base of all parts: fields are checked, parts are equal by value, and a repr is one line.

    A subclass is a frozen dataclass.
    """


class Setup:
    """Stands for the value of a field of `setup` where methods run on symbols, which must not use it."""


SETUP = {"setup": True}
"""Metadata of a dataclass field by which `setup` marks it."""


def setup(default: Any) -> Any:
    """A dataclass field with this default that no method reads on symbols, such as a seed:
    new values compile nothing.
    """
    return field(default=default, metadata=SETUP)


def is_part(x: object) -> bool:
    """Whether x is an object of a dataclass."""
    return hasattr(type(x), "__dataclass_fields__")


def content(part: Any) -> dict[str, Any]:
    """Name -> value of the fields and derived numbers of a part, as the engine replaces them by symbols."""
    return {name: value(getattr(part, name)) for name, value in _values(type(part))}


@per_class
def _values(cls: Any) -> tuple[tuple[str, Callable[[Any], Any]], ...]:
    """Names in `content` for a class of parts, each with the function that converts its value.

    Whole numbers in a field annotated as float become floats: else they would be structure, and compiled in.
    """
    result: list[tuple[str, Callable[[Any], Any]]] = []
    hints = hints_of(cls)
    for f in fields(cls):
        # float, Annotated[float, ..], tuple[float, ..]: by the text of the annotation
        value = _as_floats if "float" in str(hints.get(f.name, f.type)).lower() else _itself
        result.append((f.name, (lambda _: Setup()) if f.metadata.get("setup") else value))
    return (*result, *((name, _itself) for name in derived_names(cls)))


def _itself(x: Any) -> Any:
    """The value unchanged."""
    return x


def _as_floats(x: Any) -> Any:
    """The value with whole numbers, also those in tuples and lists, as floats."""
    if type(x) in (tuple, list):
        return type(x)(map(_as_floats, x))
    return float(x) if type(x) is int else x


def with_content(part: T, values: Mapping[str, Any], cls: type | None = None) -> T:
    """Make an object of the class of a part, or of `cls`, with these attributes alone, without any check."""
    new: Any = object.__new__(type(part) if cls is None else cls)
    vars(new).update(values)
    return new


def with_fields(part: T, **values: Any) -> T:
    """A copy of a part with these fields changed, without any check.

    Derived numbers that were computed already are copied, not computed anew. For methods that run on symbols
    too: `dataclasses.replace` would check symbols as numbers.
    """
    # without what `once` keeps, which was computed from the old fields
    return with_content(part, {k: x for k, x in vars(part).items() if k != "_once"} | values)


@per_class
def derived_names(cls: type) -> tuple[str, ...]:
    """Names of the derived numbers of a class, those of its bases first."""
    members = (item for base in reversed(cls.__mro__) for item in vars(base).items())
    return tuple(dict.fromkeys(name for name, x in members if isinstance(x, derived)))


# -- results that are kept in parts ---------------------------------------------------------------
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


def once(make: Callable[..., T]) -> Callable[..., T]:
    """Decorator: make(x, *more) is computed once for a part x and kept in it, so that walks that share the part
    share the result. It is computed each time if something in x, or in a part among `more`, may change.

    more: hashable arguments.
    """

    @wraps(make)
    def found(x: Any, *more: Hashable) -> T:
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


def rewrites(part: object, name: str, *others: str) -> bool:
    """Whether a subclass writes one of the methods `others` again, but inherits the method `name`, which is
    right only for the others as they were.
    """
    at = {x: [x in vars(c) for c in type(part).__mro__].index(True) for x in (name, *others)}
    return any(at[x] < at[name] for x in others)


def shared(part: T, **values: Any) -> T:
    """A copy of a part with these fields changed; the part itself if they have these values already.

    Equal calls return the same object, so that results which `once` keeps in it are found again.
    """
    items = {f.name: getattr(part, f.name) for f in fields(part)} | values  # type: ignore[arg-type]
    same = all(getattr(part, name) is x for name, x in values.items())
    # the fields are kept with the copy: while they live, no other object has the ids that are in the key
    make = lambda: (items, part if same else type(part)(**items))  # noqa: E731
    # [1]: of (fields, copy) the copy
    return _SHARED.found((type(part), *map(_known_by, items.values())), make)[1]


def _known_by(x: object) -> Hashable:
    """What stands for a field's value in a key: (class, value) of a number, or of a constant part of numbers
    alone; else its id, as to compare arrays takes longer than what is shared saves.
    """
    inside = [getattr(x, f.name) for f in fields(x)] if is_part(x) and constant(x) else [x]  # type: ignore[arg-type]
    plain = all(isinstance(i, _PLAIN) or (type(i) is tuple and constant(i)) for i in inside)
    return (type(x), *inside) if plain else id(x)
