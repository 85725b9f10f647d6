"""Parts of a walker: frozen dataclasses with ordinary methods, run by Python or by the *engine*, a compiler.

A walker is the closed loop of a robot, its controller, disturbances and clock. Controllers, observers,
references, disturbances, sensors and touchdown detectors are parts, and parts may hold parts. Python calls
their methods on numbers. The engine calls them once on symbols and writes machine code:

    floats, arrays of floats       numbers, given at run time: new values compile nothing
    whole numbers, flags, texts    structure: another value is another code
    derived                        numbers that are computed once from the fields, such as gains from poles
    setup                          fields that only derived numbers and the initial state use, such as a seed

A method with an `if` on a number (`if x > 0`) cannot be compiled; it runs in Python. Write `np.where` instead.
"""

from abc import ABC
from collections.abc import Callable, Mapping
from dataclasses import field, fields
from functools import cached_property, wraps
from typing import Any

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
    # without what `core.once` keeps, which was computed from the old fields
    return with_content(part, {k: x for k, x in vars(part).items() if k != "_once"} | values)


@per_class
def derived_names(cls: type) -> tuple[str, ...]:
    """Names of the derived numbers of a class, those of its bases first."""
    members = (item for base in reversed(cls.__mro__) for item in vars(base).items())
    return tuple(dict.fromkeys(name for name, x in members if isinstance(x, derived)))
