"""What a study may vary: the values of a scenario by name, read with their units, types and ranges.

A table of values is written with dots: "start.v5" stands for the value v5 of `start`, "own.gain" for a gain
that a controller of one's own takes. A quantity may be text, such as "1.5 ms" or "30 N m": a unit is a product
of powers, "kg m^2/s^2", each symbol may carry a prefix, what follows a slash divides. Angles have a dimension
of their own, so that a frequency [Hz] is not taken for a rate [rad/s].
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any, NamedTuple, get_args

from pydantic import ValidationError

from biped_adrc.errors import InputError
from biped_adrc.scenario.scenario import FIELDS, UNITS, Scenario
from biped_adrc.scenario.values import unknown


class Unit(NamedTuple):
    """A factor to SI, and powers of (m, kg, s, rad)."""

    factor: float
    powers: tuple[int, int, int, int]


SYMBOLS: dict[str, Unit] = {
    "m": Unit(1.0, (1, 0, 0, 0)),
    "g": Unit(1e-3, (0, 1, 0, 0)),
    "s": Unit(1.0, (0, 0, 1, 0)),
    "Hz": Unit(1.0, (0, 0, -1, 0)),
    "N": Unit(1.0, (1, 1, -2, 0)),
    "J": Unit(1.0, (2, 1, -2, 0)),
    "W": Unit(1.0, (2, 1, -3, 0)),
    "rad": Unit(1.0, (0, 0, 0, 1)),
}
"""These take prefixes; N m of a torque and J are the same."""
WHOLE: dict[str, Unit] = {
    "1": Unit(1.0, (0, 0, 0, 0)),
    "%": Unit(1e-2, (0, 0, 0, 0)),
    "min": Unit(60.0, (0, 0, 1, 0)),
    "deg": Unit(math.pi / 180.0, (0, 0, 0, 1)),
    "rev": Unit(2.0 * math.pi, (0, 0, 0, 1)),
    "rpm": Unit(2.0 * math.pi / 60.0, (0, 0, -1, 1)),
}
"""These do not."""
PREFIXES = {"k": 1e3, "M": 1e6, "c": 1e-2, "m": 1e-3, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "n": 1e-9}
MOST_POWER = 9
"""Of a symbol in a unit."""

_QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*")
_FACTOR = re.compile(r"([^\d\s/*^·+-]+|1)(?:\^?(-?\d+))?")


def quantity(text: str, unit: str) -> float:
    """The number of `text` in `unit`, which it has where it names none. Raises ValueError with the reason."""
    match = _QUANTITY.fullmatch(text)
    if match is None:
        raise ValueError(f"expected a number [{unit}] or a number and its unit")
    number, given = float(match[1]), match[2]
    if not math.isfinite(number):
        raise ValueError(f"{match[1]} is too large, expected a finite number [{unit}]")
    if not given:
        return number
    found, expected = unit_of(given), unit_of(unit)
    if found.powers != expected.powers:
        raise ValueError(f"'{given}' is another dimension, expected a unit such as '{unit}'")
    scaled = _scaled(number, found.factor / expected.factor)
    if not math.isfinite(scaled):
        raise ValueError(f"it is too large, expected a finite number [{unit}]")
    return scaled


def unit_of(text: str) -> Unit:
    """A unit from its text. Raises ValueError for an unknown symbol or a power beyond `MOST_POWER`."""
    factor, powers = 1.0, (0, 0, 0, 0)
    over, *under = text.split("/")
    for sign, part in [(1, over), *((-1, part) for part in under)]:
        for word in re.split(r"[\s*·]+", part.strip()):
            symbol, power = _factor(word, text)
            factor *= symbol.factor ** (sign * power)
            powers = tuple(  # type: ignore[assignment]
                a + sign * power * b for a, b in zip(powers, symbol.powers, strict=True)
            )
    if not 0.0 < factor < math.inf:
        raise ValueError(f"the unit '{text}' is out of range")
    return Unit(factor, powers)


def _factor(word: str, text: str) -> tuple[Unit, int]:
    match = _FACTOR.fullmatch(word)
    symbol = None if match is None else _symbol(match[1])
    if match is None or symbol is None:
        known = ", ".join([*SYMBOLS, *WHOLE])
        raise ValueError(f"the unit '{text}' is not known; units are made of {known}")
    power = match[2] or "1"
    if len(power) > 4 or abs(int(power)) > MOST_POWER:
        raise ValueError(f"the unit '{text}' has the power {power}, expected at most {MOST_POWER}")
    return symbol, int(power)


def _symbol(name: str) -> Unit | None:
    if name in WHOLE or name in SYMBOLS:
        return WHOLE.get(name) or SYMBOLS[name]
    prefix, rest = PREFIXES.get(name[:1]), SYMBOLS.get(name[1:])
    return None if prefix is None or rest is None else Unit(prefix * rest.factor, rest.powers)


def _scaled(number: float, factor: float) -> float:
    """number factor; by a decimal shift where it is one, so that 1.5 ms is 1.5e-3 and not its neighbour."""
    digits = math.log10(factor)
    shift = round(digits)
    if abs(digits - shift) < 1e-12:
        return float(f"{number!r}e{shift}") if "e" not in repr(number) else number * 10.0**shift
    return number * factor


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
        of = f" [{unit(name)}]" if is_number(name) and unit(name) != "1" else ""
        raise Refused(f"{said}{text}{of}") from None


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
