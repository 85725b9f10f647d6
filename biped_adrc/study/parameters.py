"""What a study knows of a scenario: its fields by name, their units, and how values are read.

A name is opaque outside of this module: "bandwidth", or with a dot for a value in a table, "start.v5",
"own.gain". A quantity may be text with a unit; "none" is no value.

    period         "1.5 ms"    0.0015    [s]
    torque_limit   "none"      None      no limit
    start.v5       0.1         0.1       [rad/s]
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple, get_args

from pydantic import ValidationError

from biped_adrc.errors import InputError
from biped_adrc.files import one_line, reading, toml_key, toml_value, write_text
from biped_adrc.scenario.registry import portable
from biped_adrc.scenario.scenario import DEFAULTS, FIELDS, MOST_SEED, OF_PLANT, UNITS, Scenario
from biped_adrc.scenario.values import unknown as unknown
from biped_adrc.study.units import quantity

Values = Mapping[str, Any]
"""Values of a scenario by name, in SI units."""
Record = Mapping[str, object]
"""The values of one walk as JSON has them: what a worker receives."""

REFUSED, RAISED, CRASHED = "REFUSED", "RAISED", "CRASHED"
"""Statuses that are no result of a walk: its values do not fit together, its function raised, its worker
died."""
NO_WALK = (REFUSED, RAISED, CRASHED)
"""All of them; such rows count neither as a success nor as a fall."""
SEED, PLANT = "seed", "plant"
"""Names of fields that a study treats apart."""
SUFFIXES = {"robot": ".toml", "gait": ".json"}
"""By field, the suffix of a file in place of a registered name."""
OWN = {
    **{name: name for name in ("controller", "observer", "robot", "gait", "plant")},
    "own.inner": "controller",
    "push": "disturbance",
}
"""Fields that may name a class of the user as module:Class, and the registry's kind of it."""
TABLES = {"start": ("q1", "v1"), "own": ("NAME",), "mass": ("BODY",), "inertia": ("BODY",)}
"""Fields that are tables, and examples of the names in them."""
START_UNITS = {"q": "rad", "v": "rad/s"}
"""Units of the table `start`: coordinates q1, q2, ... and rates v1, v2, ..."""
NONE = "none"
"""Text for no value, such as no limit of a torque."""
ENDS = ("from", "to", "choices")
"""Keys of a range or of choices, which are no names of a scenario."""


class Refused(ValueError):
    """A value that cannot be used: its text says what was found and what was expected."""


class Field(NamedTuple):
    """What a study has to know of a field."""

    unit: str
    """Its SI unit, "1" for none."""
    number: bool
    """Whether it may be a number, so that it has a range; a parameter of a controller of one's own may."""
    whole: bool
    """Whether it takes whole numbers only."""
    default: object = None
    """Its value where a scenario does not say it."""
    types: tuple[object, ...] = ()
    """Those that it takes; empty where only the user's class knows."""


def names() -> list[str]:
    """All fields, in the order of the scenario; of tables their examples."""
    tables = [f"{table}.{key}" for table, keys in TABLES.items() for key in keys]
    return [*(name for name in FIELDS if name not in TABLES), *tables]


def field_of(name: str) -> Field:
    """The field of this name. Raises Refused, with the nearest names, where there is none."""
    table, _, key = name.partition(".")
    if table not in FIELDS or (key and table not in TABLES):
        raise Refused(unknown(name, names()))
    if table not in TABLES:
        types = get_args(FIELDS[name].annotation) or (FIELDS[name].annotation,)
        number = bool({int, float} & set(types))
        whole = number and float not in types
        return Field(UNITS[name], number, whole, DEFAULTS[name], types)
    if not key:
        raise Refused(f"expected a name in it, such as {table}.{TABLES[table][0]}")
    if table == "own":
        return Field("1", True, False)
    unit = START_UNITS.get(key[:1], "1") if table == "start" else UNITS[table]
    return Field(unit, True, False, 0.0, (float,))


def scenario_of(values: Record) -> Scenario:
    """The scenario of values by name; where they say nothing of sampling, it is sampled at 1 kHz, ideally.

    A row counts at sample instants, so each walk needs some. Raises InputError for values that do not fit
    together.
    """
    return Scenario(**{"hardware": "ideal", **nested(values)})


def read(name: str, given: Any) -> Any:
    """A value as the scenario takes it: a number in the SI unit, also from a text with a unit, or as it is.

    Raises Refused for an unknown name or a value out of range.
    """
    field = field_of(name)
    if not field.types:
        return _read_own(given)
    if given == NONE and type(None) in field.types:
        return None
    x = _in_unit(field, given) if field.number else given
    _check(name, field, x, given)
    if name in OWN and isinstance(x, str):
        return portable(OWN[name], x)
    return float(x) if field.number and not field.whole else x


def _read_own(given: object) -> object:
    """A value of the table `own`, whose names and units only the user's class knows."""
    if isinstance(given, list) and all(type(x) in (int, float) for x in given):
        return tuple(given)
    if given is None or isinstance(given, bool | int | float | str):
        return given
    raise Refused(f"found {given!r}, expected a number, a text, or a list of numbers")


def _in_unit(field: Field, given: object) -> float | int:
    """A number, or that of a text, in the field's SI unit; an int where the field is one and it is whole."""
    if isinstance(given, bool) or not isinstance(given, int | float | str):
        raise Refused(f"found {given!r}, expected a number [{field.unit}]")
    try:
        x = quantity(given, field.unit) if isinstance(given, str) else given
    except ValueError as error:
        raise Refused(f"found {given!r}: {error}") from None
    return int(x) if field.whole and isinstance(x, float) and x.is_integer() else x


def _check(name: str, field: Field, x: object, given: object) -> None:
    """Raises Refused where a scenario takes this value in no combination with others.

    given: the value as in the file, for the message.
    """
    try:
        Scenario(**nested({name: x}))
    except InputError as error:
        found = error.__cause__
        alone = (
            [r for r in found.errors() if r["loc"]] if isinstance(found, ValidationError) else []
        )
        if not alone:  # of values together, which are checked as a whole
            return
        text = alone[0]["msg"].removeprefix("Value error, ").replace("Input should", "should")
        in_si = "" if x == given or isinstance(x, str) else f", {x:g} in SI"
        unit = f" [{field.unit}]" if field.number and field.unit != "1" else ""
        raise Refused(f"found {given!r}{in_si}: {text}{unit}") from None


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
    """The inverse of `nested`: TOML reads start.v5 = .. as a table in a table. Ranges and choices stay
    whole."""
    made: dict[str, object] = {}
    for name, x in values.items():
        if isinstance(x, Mapping) and not set(x) & {*ENDS}:
            made |= {f"{name}.{key}": inner for key, inner in flat(x).items()}
        else:
            made[name] = x
    return made


def on_rigid_ground(s: Scenario) -> Scenario:
    """The scenario with the rigid plant in place of another one."""
    return replace(s, **{name: DEFAULTS[name] for name in (PLANT, *OF_PLANT)})


def read_scenario(path: Path) -> dict[str, Any]:
    """The values of a scenario file (TOML) by name. Raises InputError."""
    with reading("scenario file", path, InputError):
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
    found = {}
    for name, x in flat(tables).items():
        try:
            found[name] = read(name, x)
        except Refused as error:
            raise InputError(f"scenario file '{path}', {name}: {error}") from error
    return found


def write_scenario(path: Path, s: Scenario, comment: str = "") -> None:
    """Write the values of a scenario that differ from the defaults, below a comment. Raises OutputError."""
    lines = [f"# {one_line(line)}" for line in comment.splitlines()] + scenario_lines(s)
    write_text(path, "\n".join(lines) + "\n")


def scenario_lines(s: Scenario) -> list[str]:
    """The values of a scenario that differ from the defaults, its controller and robot, as lines of TOML."""
    record = flat({"controller": s.controller, "robot": s.robot} | s.record())
    return [
        f"{'.'.join(map(toml_key, name.split('.', 1)))} = {toml_value(x)}"
        for name, x in record.items()
    ]


def check_seed(seed: object) -> int:
    """A seed. Raises Refused."""
    if type(seed) is not int or not 0 <= seed <= MOST_SEED:
        raise Refused(f"found the seed {seed!r}, expected a whole number from 0 to {MOST_SEED}")
    return seed
