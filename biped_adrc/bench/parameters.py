"""What a study may vary: values of a scenario by dotted name, read with unit, type and range.

`bench.study_file` reads values with `read`; `bench.study`, `bench.run` and the comparison make scenarios of
them with `trial`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError

from biped_adrc.errors import InputError
from biped_adrc.scenario.dotted import merged, nested
from biped_adrc.scenario.scenario import Scenario, field_of, scenario_of, value_of

Value = float | int | bool | str | None | tuple[float, ...]
"""What a parameter may be: a number in the SI unit, a text, no value, or a tuple of an own parameter."""
NONE = "none"
"""Text for no value, such as no limit of a torque."""


class Refused(ValueError):
    """A value cannot be used: its text says what was found and what was expected."""


def trial(values: Mapping[str, object]) -> Scenario:
    """The scenario of values by name; where they say nothing of sampling it is sampled at 1 kHz, ideally.

    That is the profile ideal: what a study reports is counted at sample instants, so each trial needs some.
    Raises InputError for values that do not fit together.
    """
    values = {_full(name): x for name, x in values.items()}
    return scenario_of(merged({"hardware": {"profile": "ideal"}}, nested(values)))


def _full(name: str) -> str:
    """The axis of seeds by its name in a scenario."""
    return "run.seed" if name == "seed" else name


def flat(values: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    """The inverse of `nested`, of tables as a file of a study has them."""
    made: dict[str, Any] = {}
    for name, x in values.items():
        if isinstance(x, Mapping) and not {"from", "values", "choices"} & set(x):
            made |= flat(x, f"{before}{name}.")
        else:
            made[before + name] = x
    return made


def unit(name: str) -> str:
    """The SI unit of a parameter, "1" for none: "rad" for "start.q5"."""
    return field_of(_full(name)).unit


def check_name(name: str) -> None:
    """Raises Refused, with the nearest names, for a parameter that there is not."""
    try:
        field_of(_full(name))
    except InputError as error:
        raise Refused(getattr(error, "text", str(error))) from None


def read(name: str, given: Any) -> Value:
    """A value as the scenario takes it: a number in the SI unit, also from text with a unit, or as it is given.

    "none" is no value, where the field allows it. Raises Refused for an unknown name or a value out of range.
    """
    try:
        x: Value = value_of(_full(name), given)
    except InputError as error:
        raise Refused(getattr(error, "text", str(error))) from None
    return float(x) if float in field_of(_full(name)).types and type(x) is int else x


def is_number(name: str) -> bool:
    """Whether a parameter is a number, so that it has a range; an own parameter may be one."""
    what = field_of(_full(name))
    return what.number or not what.types


def is_whole(name: str) -> bool:
    """Whether a parameter takes whole numbers only."""
    types = field_of(_full(name)).types
    return int in types and float not in types


def reason(error: Exception) -> str:
    """The text of an error; of a pydantic error the first thing that is wrong, as "name: found, expected"."""
    if not isinstance(error, ValidationError):
        return str(error)
    found = error.errors()[0]
    name = "".join(f"{part}: " for part in found["loc"])
    text = found["msg"].removeprefix("Value error, ")
    if not (found["loc"] and text.startswith("Input should")):
        return f"{name}{text}"
    return f"{name}found {found['input']!r}, {text.replace('Input should', 'should')}"


__all__ = ["NONE", "Refused", "flat", "nested", "read", "reason", "trial", "unit"]
