"""Records of plain values: units, ranges and texts declared at the field, checked when a record is made.

    class Motors(Record):
        torque_limit: float | None = field(None, "N m", gt=0)
        ...and its help text as the docstring below

A number may be text with a unit, "150 N m" or "1 ms"; "none" is no value where a field allows it. A record that
has one obvious name, `SHORT`, may be that name alone. Values of records inside records have dotted names,
"controller.observer.bandwidth", the same in Python, in TOML and on the command line.

A part is what the registry (`core.registry`) makes of a name: a controller, an observer, a sensor, a push, a
plant. A kind is one of these groups in the registry. Records of parts may be open: they keep values with other
names in `own`, which only a part of the user's knows, and the part's constructor takes them by name. A table is
a mapping, as TOML has it. pydantic, the library behind, checks the fields, calls validators "before" or "after"
that, and collects faults in a ValidationError; a `Misfit` is one fault with the dotted name of its value.
"""

from __future__ import annotations

import operator
from collections.abc import Collection, Mapping
from dataclasses import asdict
from functools import lru_cache
from types import NoneType
from typing import Any, ClassVar, Literal, NamedTuple, Self, TypeVar, get_args, get_origin

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError, ValidationInfo
from pydantic.functional_validators import field_validator, model_validator

from biped_adrc.core.checks import IN_WORDS, members
from biped_adrc.core.errors import InputError, complaint, dotted_place, unknown
from biped_adrc.core.files import plain as as_json
from biped_adrc.core.registry import construct, find, known_name, portable, takes, unit_in
from biped_adrc.core.shown import call_text
from biped_adrc.scenario.dotted import NAME, flat, merged, tables
from biped_adrc.scenario.units import ANY, PLAIN, own_quantity, quantity

_T = TypeVar("_T")
_KINDS = IN_WORDS | {
    int: "a whole number",
    tuple: "a list",
    dict: "a table",
    object: "a record",
    NoneType: "none",
}
"""Words for the types of values, in error messages."""
SIGNS = {"ge": ">=", "gt": ">", "le": "<=", "lt": "<"}
"""Signs of the ends of a range, by their names in `operator`."""


def field(default: Any, unit: str = "", kind: str = "", **limits: Any) -> Any:
    """Declare a field of a record, with its default, and the ends of its range as ge, gt, le, lt.

    unit: of its numbers, "1" for dimensionless ones, "" where no unit is taken. kind: for a field that is a
    name of the registry, the kind of part that it names, such as "controller". The docstring below the field is
    its help text.
    """
    return Field(default, json_schema_extra={"unit": unit, "kind": kind}, **limits)


class Misfit(InputError):
    """The error for a value that a record does not take: `place` is its dotted name, `text` the fault.

    known: False where no record has a value of this name, so that `misfit` proposes names of the outer record.
    """

    def __init__(self, place: str, text: str, known: bool = True) -> None:
        super().__init__(f"{place}: {text}" if place else text)
        self.place, self.text, self.known = place, text, known


def all_taken(place: str, own: Mapping[str, object], known: Collection[str]) -> None:
    """Raise Misfit for a value in `own` (name -> value) whose name is not among the known ones; place: dotted
    name of their record.
    """
    for name in own:
        if name not in known:
            raise Misfit(f"{place}.{name}", unknown(name, known))


def named_part(
    kind: str,
    name: str,
    known: Mapping[str, object],
    own: Mapping[str, object],
    base: type[_T],
    place: str,
    fields: Collection[str] = (),
) -> _T:
    """Construct the part that the registry has of this kind and name.

    Its constructor gets by name those values that it takes: of `known`, what the scenario knows, such as
    "biped"; over them of the registry's defaults; over them of `own`, the user's own values in the record of
    the part. place: dotted name of that record, for messages. fields: names of its declared fields, which count
    as known names too. base: class that the part must have. Raises InputError for a part that is not there or
    cannot be made, and Misfit for an own value that it does not take.
    """
    entry = find(kind, name)
    make = entry.load()
    # takes: the parameters of the constructor
    all_taken(place, own, {**takes(make), **dict.fromkeys(fields)})
    values = {**known, **entry.defaults, **own}
    return construct(f"{kind} '{name}'", make, values, base, place)


class Described(NamedTuple):
    """The description of one value of a record, by its dotted name."""

    name: str
    types: tuple[type, ...]
    """float, int, bool, str, tuple, dict, NoneType; object for a record; empty for a value of a user's part."""
    limits: tuple[tuple[str, float], ...] = ()
    """Ends of the range, each as ("ge", "gt", "le" or "lt", number)."""
    default: Any = None
    text: str = ""
    choices: tuple[str, ...] = ()
    unit: str = ""
    """"" for a number that takes no unit, `ANY` where only a part of the user's own knows it."""
    kind: str = ""
    """Kind in the registry, for a value that is a name of the registry; else empty."""

    @property
    def in_brackets(self) -> str:
        """The unit to be put behind a name, such as " [s]"; empty without one."""
        return "" if self.unit in PLAIN else f" [{self.unit}]"

    def read(self, x: Any) -> Any:
        """The value x as the field keeps it: texts with units become numbers in the field's unit.

        Raises ValueError for a value of another type, out of its range, or not among its choices.
        """
        x = converted(self, x)
        # an int is also a float here; a bool, which Python counts as an int, is neither. Without types, as of a
        # value of a user's part, anything is right
        known = (*self.types, int) if float in self.types else self.types
        wrong = known and (not isinstance(x, known) or (isinstance(x, bool) and int in known))
        if wrong or (self.choices and x is not None and x not in self.choices):
            kinds = " or ".join(self.choices or (_KINDS[kind] for kind in self.types))
            raise ValueError(f"found {x!r}, expected {kinds}{self.in_brackets}")
        for sign, limit in self.limits if isinstance(x, int | float) else ():
            if not getattr(operator, sign)(x, limit):  # such as operator.ge(x, 0.0)
                raise ValueError(f"found {x!r}, expected {self.range_text}{self.in_brackets}")
        return x

    def taken(self, x: Any) -> Any:
        """The value as `read` returns it. Raises Misfit, which has the dotted name, where `read` refuses it."""
        try:
            return self.read(x)
        except ValueError as error:
            raise Misfit(self.name, str(error)) from None

    @property
    def range_text(self) -> str:
        """The choices, or else the range, in a few words: ">= 0, <= 1"."""
        ends = (f"{SIGNS[sign]} {x:g}" for sign, x in self.limits)
        return " or ".join(self.choices) or ", ".join(ends)


class Record(BaseModel):
    """A frozen record of plain values. Raises InputError that names the value by its dotted name."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        allow_inf_nan=False,
        defer_build=True,
        use_attribute_docstrings=True,
    )
    SHORT: ClassVar[str] = "name"
    """Name of the field that a text in place of the record sets; "" for none."""
    APART: ClassVar[tuple[tuple[str, str], ...]] = ()
    """Pairs of values that say the same, or exclude one another, by dotted names."""

    def __init__(self, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ValidationError as error:
            raise misfit(error, type(self)) from None

    @model_validator(mode="before")
    @classmethod
    def _opened(cls, values: Any) -> Any:
        """Make a mapping of a text that stands for the record, and check values that only a user's part
        knows. pydantic calls it first; a record that is not open refuses such values afterwards.
        """
        if isinstance(values, str) and cls.SHORT in cls.model_fields:
            values = {cls.SHORT: values}
        if not isinstance(values, Mapping):
            return values
        # `dotted.merged` puts a text that stands for the record under NAME
        result = {cls.SHORT if name == NAME else str(name): x for name, x in values.items()}
        # values that the class does not declare
        for name in result.keys() - cls.model_fields.keys():
            if isinstance(result[name], Mapping | Record):
                raise Misfit(name, unknown(name, cls.names()), known=False)
            # its description, with the unit that the registry states for this part; `taken` reads x by it
            what = cls._of_part(cls.own_value(name), result.get(cls.SHORT))
            result[name] = what.taken(result[name])
        return result

    @classmethod
    def own_value(cls, name: str) -> Described:
        """The description of a value that only the user's part knows: any type, any unit, no default."""
        return Described(name, (), unit=ANY)

    @classmethod
    def _of_part(cls, what: Described, part: object) -> Described:
        """The description `what` with the unit that the registry states for this value of the part named
        `part`; unchanged where it states none.
        """
        # the field SHORT of such a record is the name of the part
        kind = described(cls, cls.SHORT).kind if cls.SHORT in cls.model_fields else ""
        return what._replace(unit=unit_in(kind, part, what.name, what.unit))

    @field_validator("*", mode="before")
    @classmethod
    def _read(cls, x: Any, info: ValidationInfo) -> Any:
        """A value as its field keeps it: numbers from text with a unit, names as the registry spells them.

        info: of pydantic: name of the field, and `data`, the fields that were read before it.
        """
        what = described(cls, str(info.field_name))
        if isinstance(x, str):  # the registry may state another unit for this field of this part
            what = cls._of_part(what, info.data.get(cls.SHORT))
        return what.read(x)

    @classmethod
    def names(cls, before: str = "") -> list[str]:
        """Dotted names of all values, each behind the text `before`.

        A list of records gives those of its first record; a record inside one of its own class, such as the
        controller in an outer loop, gives its name alone, since the names would not end.
        """
        result = []
        for name, info in cls.model_fields.items():
            inner = record_in(cls, name)
            if inner is None or inner is cls:
                result.append(before + name)
            else:
                place = "0." if get_origin(info.annotation) is tuple else ""
                result += inner.names(f"{before}{name}.{place}")
        return result

    @classmethod
    def field_of(cls, name: str) -> Described:
        """Type, unit, range, default and text of a value by its dotted name, in which numbers of list items do
        not count.

        The name of a record stands for its field SHORT; a name below a table, as errors.mass.torso, for one of
        the table's numbers. Raises Misfit with the nearest names.
        """
        at: type[Record] = cls
        parts = [part for part in name.split(".") if not part.isdigit()]
        for k, part in enumerate(parts):
            inside = k < len(parts) - 1
            if part not in at.model_fields:
                if issubclass(at, OpenRecord) and not inside:
                    return at.own_value(part)._replace(name=name)
                raise Misfit(name, unknown(name, cls.names()))
            inner = record_in(at, part)
            if inner is None:
                what = described(at, part, name)
                # inside: more names follow that of a table, such as errors.mass: one of its numbers is meant
                return Described(name, (float,), text=what.text) if inside else what
            at = inner
        # the name is that of a record
        if at.SHORT in at.model_fields:
            return at.field_of(at.SHORT)._replace(name=name)
        raise Misfit(name, f"is a record; name a value, as {name}.{next(iter(at.model_fields))}")

    @classmethod
    def value_of(cls, name: str, x: object) -> Any:
        """Reads and checks a value x for a field by its dotted name, such as "run.h".

        "2 ms" becomes a number in SI units; a class registered in this process becomes the text "module:Class";
        1 becomes 1.0 in a field of floats, so that equal values have equal texts. Raises InputError for an
        unknown field, and for a value that the field does not take.
        """
        what = cls.field_of(name)
        result = what.taken(x)  # as the field keeps it
        if what.kind and isinstance(result, str):
            return portable(what.kind, result)
        return float(result) if type(result) is int and float in what.types else result

    @model_validator(mode="after")
    def _apart(self) -> Self:
        """Raise Misfit if both values of a pair of `APART` differ from their defaults."""
        usual = by_default(type(self))
        for pair in self.APART:
            values = operator.attrgetter(*pair)
            if all(x != y for x, y in zip(values(self), values(usual), strict=True)):
                raise Misfit(pair[0], f"is given beside {pair[1]}; leave one of them out")
        return self

    @property
    def own(self) -> dict[str, Any]:
        """Values by name that only the user's part knows."""
        return dict(self.model_extra or {})

    def record(self, usual: Record | None = None) -> dict[str, Any]:
        """Nested plain values, as JSON has them, that differ from those of the record `usual`; None: from the
        defaults.

        What was registered in this process is written as module:Class, by which any other process finds it.
        """
        usual = usual or by_default(type(self))
        result = {}
        for name in type(self).model_fields:
            x, before = getattr(self, name), getattr(usual, name)
            # of an inner record the differences alone; an empty table of differences counts as equal
            if isinstance(x, Record) and isinstance(before, Record):
                x, before = x.record(before), {}
            if x != before:
                kind = described(type(self), name).kind
                # portable: the name by which another process finds it; of a part registered here, module:Class
                result[name] = portable(kind, x) if kind and x is not None else as_json(x)
        others = usual.own
        return result | {name: as_json(x) for name, x in self.own.items() if others.get(name) != x}

    def _asdict(self) -> dict[str, Any]:
        """The values of `record`; `core.files.plain` looks for a method of this name to write JSON."""
        return self.record()

    def dotted(self) -> dict[str, Any]:
        """`record` by dotted names, such as {"controller.observer.bandwidth": 300.0}."""
        return flat(self.record())

    def replace(self, values: Mapping[str, Any] | None = None, **more: Any) -> Self:
        """The record with other values, nested or by dotted names; a text or a record replaces a whole one.

        s.replace(run={"seed": 3}), s.replace({"run.seed": 3}), s.replace(controller="NPD")
        """
        return type(self)(**merged(self.record(), tables({**(values or {}), **more})))

    def __repr__(self) -> str:
        return call_text(type(self).__name__, ((k, repr(x)) for k, x in self.dotted().items()))

    __str__ = __repr__

    def __hash__(self) -> int:
        return hash(repr(sorted(self.dotted().items())))


class OpenRecord(Record, extra="allow"):
    """A record that takes names that it does not declare, for a part of the user's, and keeps them in `own`."""


def converted(what: Described, x: Any) -> Any:
    """Convert a value x that is a text to the type of the field `what`: "none" to None, a number to the field's
    unit, a registered name to its spelling, "1, 2" to a tuple. In a table each text becomes a number. A whole
    float becomes an int in a field of ints, a list of numbers and texts a tuple, NumPy's types become Python's;
    other values stay.

    Raises ValueError for a text that does not fit.
    """
    types, unit = what.types, what.unit
    if isinstance(x, np.generic | np.ndarray):
        x = x.tolist()
    if isinstance(x, list | tuple) and all(isinstance(y, int | float | str) for y in x):
        # units in a list for a user's part
        return tuple(own_quantity(y, unit) if isinstance(y, str) and not types else y for y in x)
    if isinstance(x, Mapping) and dict in types:
        return {key: quantity(y, unit) if isinstance(y, str) else y for key, y in x.items()}
    if isinstance(x, str):
        if x == "none" and NoneType in types:
            return None
        if what.kind:
            return known_name(what.kind, x)
        if not types:
            return own_quantity(x, unit)
        if int in types and x.strip().isdecimal():
            return int(x)
        if int in types or float in types:
            x = quantity(x, unit)
        elif bool in types and x in ("true", "false"):
            return x == "true"
        elif tuple in types and what.in_brackets:  # a list of numbers with a unit, such as lengths
            return tuple(quantity(word, unit) for word in x.split(","))
    return int(x) if int in types and isinstance(x, float) and x.is_integer() else x


@lru_cache
def by_default(cls: type[Record]) -> Record:
    """The record of this class with all its defaults: one object per class, made without checks."""
    return cls.model_construct()


@lru_cache(maxsize=1024)
def described(cls: type[Record], name: str, place: str = "") -> Described:
    """The description of the field `name` of a class of records; place: its dotted name, if that is longer."""
    info = cls.model_fields[name]
    kinds = members(info.annotation)
    choices = tuple(x for kind in kinds if get_origin(kind) is Literal for x in get_args(kind))
    # a Literal is a text with choices; get_origin(tuple[float, ...]) is tuple
    types = tuple(str if get_origin(k) is Literal else get_origin(k) or k for k in kinds)
    if record_in(cls, name):
        types = (object, *types)
    more: Any = info.json_schema_extra  # unit and kind, by `field`
    # pydantic's metadata are the ends of the range, such as Ge(ge=0)
    limits = tuple(pair for x in info.metadata for pair in asdict(x).items())
    default, text = info.get_default(call_default_factory=True), info.description or ""
    return Described(place or name, types, limits, default, text, choices, **more)


def record_in(cls: type[Record], name: str) -> type[Record] | None:
    """The class of the record, or of the records, that a field holds; None for a value."""
    kinds = members(cls.model_fields[name].annotation)
    inner = (x for kind in kinds for x in (kind, *get_args(kind)))  # those of a tuple too
    return next((x for x in inner if isinstance(x, type) and issubclass(x, Record)), None)


def misfit(error: ValidationError, cls: type[Record]) -> Misfit:
    """The first fault that pydantic found in values for a record of class `cls`, as an error with the dotted
    name of the value.
    """
    result = error.errors()[0]
    place = dotted_place(result)
    # the exception that a validator raised, if it was one
    inner = result.get("ctx", {}).get("error")
    # a Misfit raised in a validator has a place within the record that pydantic was checking, at `place`
    if isinstance(inner, Misfit):
        place = ".".join(part for part in (place, inner.place) if part)
        if inner.known:
            return Misfit(place, inner.text)
    # there is no value of this name: `unknown` proposes names that are like it, of the outermost record
    if result["type"] == "extra_forbidden" or isinstance(inner, Misfit):
        return Misfit(place, unknown(place, cls.names()), known=False)
    return Misfit(place, complaint(result))
