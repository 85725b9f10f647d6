"""What a study may vary: the values of a `Trial` by name, read with their units, types and ranges.

A table of values of a trial is written with dots: "start.v5" stands for the value v5 of its `start`.
"""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from typing import Any, get_args

from pydantic import ValidationError

from biped_adrc.studies.bench.trial import UNITS, Trial
from biped_adrc.studies.bench.units import quantity

START = "start"
"""The table of a trial."""
START_UNITS = {"q": "rad", "v": "rad/s"}

NONE = "none"
"""Text for no value, such as no limit of a torque."""

Value = float | int | bool | str | None


class Refused(ValueError):
    """A value cannot be used: its text says what was found and what was expected."""


def names() -> list[str]:
    """All parameters, in the order of the trial."""
    return [*(name for name in Trial.model_fields if name != START), f"{START}.q1", f"{START}.v1"]


def unit(name: str) -> str:
    """The SI unit of a parameter, "1" for none."""
    if name.startswith(f"{START}."):
        return START_UNITS.get(name[len(START) + 1 :][:1], "1")
    return UNITS[name]


def check_name(name: str) -> None:
    """Raises Refused with the nearest names for one that there is not."""
    if name in Trial.model_fields and name != START:
        return
    if name == START or name.startswith(f"{START}."):
        _check(name, 0.0)
        return
    near = get_close_matches(name, names(), 3, 0.6)
    hint = f"did you mean {' or '.join(map(repr, near))}?" if near else f"choose from {names()}"
    raise Refused(f"unknown parameter; {hint}")


def read(name: str, given: Any) -> Value:
    """A value as the trial takes it: a number in the SI unit, or text with a unit. Raises Refused."""
    check_name(name)
    if given == NONE and type(None) in _types(name):
        return None
    x = given
    if is_number(name):
        if isinstance(given, bool) or not isinstance(given, (int, float, str)):
            raise Refused(f"found {given!r}, expected a number [{unit(name)}]")
        x = _in_unit(name, given)
    _check(name, x, given)
    return float(x) if is_number(name) and not is_whole(name) else x


def _in_unit(name: str, given: float | str) -> float | int:
    x: float | int
    try:
        x = quantity(given, unit(name)) if isinstance(given, str) else given
    except ValueError as error:
        raise Refused(f"found {given!r}: {error}") from None
    return int(x) if is_whole(name) and isinstance(x, float) and x.is_integer() else x


def _check(name: str, x: Any, given: Any = None) -> None:
    """Raises Refused, in the trial's words, for a value that it does not take whatever the others are."""
    try:
        Trial.model_validate(nested({name: x}), strict=True)
    except ValidationError as error:
        reasons = [reason for reason in error.errors() if reason["loc"]]
        if not reasons:  # of values together
            return
        text = reasons[0]["msg"].removeprefix("Value error, ").replace("Input should", "should")
        in_si = "" if x == given or isinstance(x, str) else f", {x:g} in SI"
        found = "" if given is None else f"found {given!r}{in_si}: "
        raise Refused(f"{found}{text}{_bracket(name)}") from None


def _bracket(name: str) -> str:
    return f" [{unit(name)}]" if is_number(name) and unit(name) != "1" else ""


def _types(name: str) -> tuple[Any, ...]:
    annotation = Trial.model_fields[name].annotation if "." not in name else float
    return get_args(annotation) or (annotation,)


def is_number(name: str) -> bool:
    """Whether a parameter is a number, so that it has ranges."""
    return bool({int, float} & set(_types(name)))


def is_whole(name: str) -> bool:
    """Whether a parameter is a whole number."""
    return is_number(name) and float not in _types(name)


def nested(values: Mapping[str, Any]) -> dict[str, Any]:
    """Values by name as the trial takes them: those with a dot in a table."""
    made: dict[str, Any] = {}
    for name, x in values.items():
        table, dot, key = name.partition(".")
        if dot:
            made.setdefault(table, {})[key] = x
        else:
            made[name] = x
    return made


def flat(values: Mapping[str, Any]) -> dict[str, Any]:
    """The inverse of `nested`."""
    made: dict[str, Any] = {}
    for name, x in values.items():
        if name == START and isinstance(x, Mapping):
            made |= {f"{START}.{key}": inner for key, inner in x.items()}
        else:
            made[name] = x
    return made
