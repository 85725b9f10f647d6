"""What a study may vary: the values of a scenario by name, read with their units, types and ranges.

A table of values is written with dots: "start.v5" stands for the value v5 of `start`, "own.gain" for a gain
that a controller of one's own takes.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, get_args

from pydantic import ValidationError

from biped_adrc.errors import InputError
from biped_adrc.scenario.scenario import FIELDS, UNITS, Scenario
from biped_adrc.scenario.values import unknown
from biped_adrc.studies.bench.units import quantity

TABLES = {"start": ("q1", "v1"), "own": ("NAME",), "mass": ("BODY",), "inertia": ("BODY",)}
"""Tables of a scenario, and what is in them."""
START_UNITS = {"q": "rad", "v": "rad/s"}

NONE = "none"
"""Text for no value, such as no limit of a torque."""

Value = float | int | bool | str | None | tuple[float, ...]


class Refused(ValueError):
    """A value cannot be used: its text says what was found and what was expected."""


def trial(values: Mapping[str, Any]) -> Scenario:
    """The scenario of values by name, at 1 kHz where they say nothing of sampling. Raises InputError."""
    return Scenario(**{"hardware": "ideal", **nested(values)})


def names() -> list[str]:
    """All parameters, in the order of the scenario."""
    return [
        *(name for name in FIELDS if name not in TABLES),
        *(f"{table}.{key}" for table, keys in TABLES.items() for key in keys),
    ]


def unit(name: str) -> str:
    """The SI unit of a parameter, "1" for none."""
    table, _, key = name.partition(".")
    return START_UNITS.get(key[:1], "1") if table == "start" else UNITS[table]


def check_name(name: str) -> None:
    """Raises Refused with the nearest names for one that there is not."""
    table, _, key = name.partition(".")
    if name in FIELDS and name not in TABLES:
        return
    if table not in TABLES:
        raise Refused(unknown(name, names()))
    if not key:
        raise Refused(f"expected a name in it, such as {table}.{TABLES[table][0]}")
    if table != "own":
        _check(name, 0.0)


def read(name: str, given: Any) -> Value:
    """A value as the scenario takes it: a number in the SI unit, or text with a unit. Raises Refused."""
    check_name(name)
    if name.startswith("own."):
        return _read_own(given)
    if given == NONE and type(None) in _types(name):
        return None
    x = given
    if is_number(name):
        if isinstance(given, bool) or not isinstance(given, (int, float, str)):
            raise Refused(f"found {given!r}, expected a number [{unit(name)}]")
        x = _in_unit(name, given)
    _check(name, x, given)
    return float(x) if is_number(name) and not is_whole(name) else x


def _read_own(given: Any) -> Value:
    if isinstance(given, list) and all(type(x) in (int, float) for x in given):
        return tuple(given)
    if given is None or isinstance(given, bool | int | float | str):
        return given
    raise Refused(f"found {given!r}, expected a number, a text, or a list of numbers")


def _in_unit(name: str, given: float | str) -> float | int:
    x: float | int
    try:
        x = quantity(given, unit(name)) if isinstance(given, str) else given
    except ValueError as error:
        raise Refused(f"found {given!r}: {error}") from None
    return int(x) if is_whole(name) and isinstance(x, float) and x.is_integer() else x


def _check(name: str, x: Any, given: Any = None) -> None:
    """Raises Refused, in the scenario's words, for a value that it does not take whatever the others are."""
    try:
        Scenario(**nested({name: x}))
    except InputError as error:
        found = error.__cause__
        reasons = (
            [r for r in found.errors() if r["loc"]] if isinstance(found, ValidationError) else []
        )
        if not reasons:  # of values together
            return
        text = reasons[0]["msg"].removeprefix("Value error, ").replace("Input should", "should")
        in_si = "" if x == given or isinstance(x, str) else f", {x:g} in SI"
        said = "" if given is None else f"found {given!r}{in_si}: "
        raise Refused(f"{said}{text}{_bracket(name)}") from None


def _bracket(name: str) -> str:
    return f" [{unit(name)}]" if is_number(name) and unit(name) != "1" else ""


def _types(name: str) -> tuple[Any, ...]:
    if "." in name:
        return () if name.startswith("own.") else (float,)
    annotation = FIELDS[name].annotation
    return get_args(annotation) or (annotation,)


def is_number(name: str) -> bool:
    """Whether a parameter is a number, so that it has ranges; an own one may be."""
    return bool({int, float} & set(_types(name))) or name.startswith("own.")


def is_whole(name: str) -> bool:
    """Whether a parameter is a whole number."""
    return is_number(name) and float not in _types(name) and not name.startswith("own.")


def nested(values: Mapping[str, Any]) -> dict[str, Any]:
    """Values by name as the scenario takes them: those with a dot in a table."""
    made: dict[str, Any] = {}
    for name, x in values.items():
        table, dot, key = name.partition(".")
        if dot:
            made.setdefault(table, {})[key] = x
        else:
            made[name] = x
    return made


def flat(values: Mapping[str, Any]) -> dict[str, Any]:
    """The inverse of `nested`; TOML reads start.v5 = .. as a table in a table."""
    made: dict[str, Any] = {}
    for name, x in values.items():
        if name in TABLES and isinstance(x, Mapping):
            made |= {f"{name}.{key}": inner for key, inner in x.items()}
        else:
            made[name] = x
    return made
