"""What a study may vary: the fields of `scenario.Scenario` by name, read with unit, type and range.

Fields that are tables are written with dots: "start.v5" is the value v5 of `start`, "own.gain" the parameter
`gain` of a controller of one's own. Everything else, such as units, ranges and what is a whole number, comes
from the declaration of the scenario's fields, so that a new field can be varied without a line here.

A quantity may be text, "1.5 ms" or "30 N m". A unit is a product of powers, "kg m^2/s^2"; each symbol may
carry an SI prefix, and what follows a slash divides. An angle has a dimension of its own here, so that a
frequency [Hz] cannot be taken for an angular rate [rad/s], a factor of 2 pi that no check of SI would find.

`bench.study_file` reads values with `read`; `bench.study`, `bench.run` and the comparison make scenarios of
them with `trial`.

What `read` makes of what is given, by name of the parameter:

    period         "1.5 ms"    0.0015    [s]
    amplitude      "30 N m"    30.0      [N m]
    torque_limit   "none"      None      no limit
    start.v5       0.1         0.1       [rad/s]
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
    """A unit as its value in SI units and its dimension."""

    factor: float
    """How many SI units one of it is: 1e-3 for g, since the SI unit of mass is kg."""
    powers: tuple[int, int, int, int]
    """Exponents of (m, kg, s, rad)."""


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
"""Symbols that take an SI prefix; the N m of a torque and J are the same unit."""
WHOLE: dict[str, Unit] = {
    "1": Unit(1.0, (0, 0, 0, 0)),
    "%": Unit(1e-2, (0, 0, 0, 0)),
    "min": Unit(60.0, (0, 0, 1, 0)),
    "deg": Unit(math.pi / 180.0, (0, 0, 0, 1)),
    "rev": Unit(2.0 * math.pi, (0, 0, 0, 1)),
    "rpm": Unit(2.0 * math.pi / 60.0, (0, 0, -1, 1)),
}
"""Symbols that take no prefix: "mmin" or "krpm" is refused."""
PREFIXES = {"k": 1e3, "M": 1e6, "c": 1e-2, "m": 1e-3, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "n": 1e-9}
"""SI prefixes and their factors; the two letters for micro are different characters that look alike."""
MOST_POWER = 9
"""Largest exponent of a symbol; more is a mistake and would overflow."""

_QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*")
"""A decimal number, and what follows it."""
_FACTOR = re.compile(r"([^\d\s/*^·+-]+|1)(?:\^?(-?\d+))?")
"""A symbol and its exponent, such as "m", "s2" or "s^-2"."""


def quantity(text: str, unit: str) -> float:
    """The number of a text such as "1.5 ms" in the unit `unit`; a number without a unit is in `unit` already.

    Raises ValueError, which says why, for what is no number, another dimension, or out of range.
    """
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
    """The unit that a text such as "kg m^2/s^2" names.

    Raises ValueError for an unknown symbol, an exponent beyond `MOST_POWER`, or a factor out of range.
    """
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
    """One symbol of a unit's text and its exponent; `text` is the whole of it, for the error."""
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
    """The unit of one symbol, with or without a prefix; None where it is unknown ("min" is minutes, not
    milli-in).
    """
    if name in WHOLE or name in SYMBOLS:
        return WHOLE.get(name) or SYMBOLS[name]
    prefix, rest = PREFIXES.get(name[:1]), SYMBOLS.get(name[1:])
    return None if prefix is None or rest is None else Unit(prefix * rest.factor, rest.powers)


def _scaled(number: float, factor: float) -> float:
    """number x factor. A factor 10^k shifts the decimal point of the text of the number:

    1.5 ms becomes the float nearest to 1.5e-3, where 1.5 * 1e-3 may be its neighbour and another key of a run.
    """
    digits = math.log10(factor)
    shift = round(digits)
    if abs(digits - shift) < 1e-12:
        return float(f"{number!r}e{shift}") if "e" not in repr(number) else number * 10.0**shift
    return number * factor


TABLES = {"start": ("q1", "v1"), "own": ("NAME",), "mass": ("BODY",), "inertia": ("BODY",)}
"""The scenario's fields that are tables, and examples of the names in them."""
START_UNITS = {"q": "rad", "v": "rad/s"}
"""Units of the table `start`: coordinates q1, q2, ... and rates v1, v2, ..."""

NONE = "none"
"""Text for no value, such as no limit of a torque."""

Value = float | int | bool | str | None | tuple[float, ...]
"""What a parameter may be: a number in the SI unit, a text, no value, or a tuple of an own parameter."""


class Refused(ValueError):
    """A value cannot be used: its text says what was found and what was expected."""


def trial(values: Mapping[str, object]) -> Scenario:
    """The scenario of values by name; where they say nothing of sampling it is sampled at 1 kHz, ideally.

    That is `hardware = "ideal"`: what a study reports is counted at sample instants, so each trial needs some.
    Raises InputError for values that do not fit together.
    """
    return Scenario(**{"hardware": "ideal", **nested(values)})


def names() -> list[str]:
    """All parameters, in the order of the scenario's fields; of the tables their examples."""
    return [
        *(name for name in FIELDS if name not in TABLES),
        *(f"{table}.{key}" for table, keys in TABLES.items() for key in keys),
    ]


def unit(name: str) -> str:
    """The SI unit of a parameter, "1" for none: "rad" for "start.q5", "N m" for "amplitude"."""
    table, _, key = name.partition(".")
    return START_UNITS.get(key[:1], "1") if table == "start" else UNITS[table]


def check_name(name: str) -> None:
    """Raises Refused, with the nearest names, for a parameter that there is not."""
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
    """A value as the scenario takes it: a number in the SI unit, also from text with a unit, or as it is given.

    "none" is no value, where the field allows it. Raises Refused for an unknown name or a value out of range.
    """
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


def _read_own(given: object) -> Value:
    """A value of the table `own`, whose names and units only the user's class knows."""
    if isinstance(given, list) and all(type(x) in (int, float) for x in given):
        return tuple(given)
    if given is None or isinstance(given, bool | int | float | str):
        return given
    raise Refused(f"found {given!r}, expected a number, a text, or a list of numbers")


def _in_unit(name: str, given: float | str) -> float | int:
    """A number, or the number of a text, in the parameter's SI unit; an int where the field is one and it is
    whole.
    """
    x: float | int
    try:
        x = quantity(given, unit(name)) if isinstance(given, str) else given
    except ValueError as error:
        raise Refused(f"found {given!r}: {error}") from None
    return int(x) if is_whole(name) and isinstance(x, float) and x.is_integer() else x


def _check(name: str, x: object, given: object = None) -> None:
    """Raises Refused, in the scenario's words, where it takes this value in no combination with others.

    A scenario with this one value is built. Errors that concern several fields together are not of this value
    alone and are left to `study_file`, which builds whole points. given: as in the file, for the sentence.
    """
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


def _types(name: str) -> tuple[object, ...]:
    """The types of a parameter, as its field is annotated."""
    if "." in name:
        return () if name.startswith("own.") else (float,)
    annotation = FIELDS[name].annotation
    return get_args(annotation) or (annotation,)


def is_number(name: str) -> bool:
    """Whether a parameter is a number, so that it has a range; a parameter of `own` may be one."""
    return bool({int, float} & set(_types(name))) or name.startswith("own.")


def is_whole(name: str) -> bool:
    """Whether a parameter takes whole numbers only."""
    return is_number(name) and float not in _types(name) and not name.startswith("own.")


def nested(values: Mapping[str, object]) -> dict[str, Any]:
    """Values by name with those of tables gathered: {"start.v5": 0.1} becomes {"start": {"v5": 0.1}}."""
    made: dict[str, Any] = {}
    for name, x in values.items():
        table, dot, key = name.partition(".")
        if dot:
            made.setdefault(table, {})[key] = x
        else:
            made[name] = x
    return made


def flat(values: Mapping[str, object]) -> dict[str, object]:
    """The inverse of `nested`, needed since TOML reads start.v5 = .. as a table in a table."""
    made: dict[str, object] = {}
    for name, x in values.items():
        if name in TABLES and isinstance(x, Mapping):
            made |= {f"{name}.{key}": inner for key, inner in x.items()}
        else:
            made[name] = x
    return made
