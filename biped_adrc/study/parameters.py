"""What a study knows of a scenario: its values by dotted name, and how texts of a study file are read.

hardware.period               "1.5 ms"    0.0015    [s]
controller.observer.order     1           1
hardware.torque_limit         "none"      None      no limit
start.v5                      0.1         0.1       [rad/s]
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from biped_adrc.errors import InputError
from biped_adrc.scenario import scenario as scenarios
from biped_adrc.scenario.records import Described, Misfit
from biped_adrc.scenario.registry import portable
from biped_adrc.scenario.scenario import MOST_SEED, Scenario

Values = Mapping[str, Any]
"""Values of a scenario by dotted name, in SI units."""
Record = Mapping[str, object]
"""The values of one walk as JSON has them: what a worker receives."""

REFUSED, RAISED, CRASHED = "REFUSED", "RAISED", "CRASHED"
"""Statuses that are no result of a walk: its values do not fit together, its function raised, its worker
died."""
NO_WALK = (REFUSED, RAISED, CRASHED)
"""All of them; such rows count neither as a success nor as a fall."""
SEED, PLANT = "run.seed", "ground.plant"
"""Names of values that a study treats apart."""
SUFFIXES = {"robot.name": ".toml", "gait.name": ".json"}
"""By value, the suffix of a file in place of a registered name."""
ENDS = ("from", "to", "choices")
"""Keys of a range or of choices, which are no names of a scenario."""


class Refused(ValueError):
    """A value that cannot be used: its text says what was found and what was expected."""


def field_of(name: str) -> Described:
    """The value of this name. Raises Refused, with the nearest names, where there is none."""
    try:
        return scenarios.field_of(name)
    except InputError as error:
        raise Refused(_text(error)) from None


def _text(error: InputError) -> str:
    """What is wrong, without the name of the value."""
    return error.text if isinstance(error, Misfit) else str(error)


def scenario_of(values: Record) -> Scenario:
    """The scenario of values by name; where they say nothing of sampling, it is sampled at 1 kHz, ideally.

    A row counts at sample instants, so each walk needs some. Raises InputError for values that do not fit
    together.
    """
    return scenarios.scenario_of({"hardware.profile": "ideal", **flat(values)})


def read(name: str, x: Any) -> Any:
    """A value as the scenario takes it: a number in the SI unit, also from a text with a unit, or as it is.

    Raises Refused for an unknown name or a value out of range.
    """
    field = field_of(name)
    try:
        found = scenarios.value_of(name, x)
    except InputError as error:
        raise Refused(_text(error)) from None
    if field.kind and isinstance(found, str):
        return portable(field.kind, found)
    return float(found) if type(found) is int and float in field.types else found


def flat(values: Mapping[str, Any]) -> dict[str, Any]:
    """Values by dotted name: TOML reads start.v5 = .. as a table in a table. Ranges and choices stay whole."""
    made: dict[str, Any] = {}
    for name, x in values.items():
        if isinstance(x, list) and x and all(isinstance(y, Mapping) for y in x):
            x = {str(i): y for i, y in enumerate(x)}
        if isinstance(x, Mapping) and not set(x) & {*ENDS}:
            made |= {f"{name}.{key}": inner for key, inner in flat(x).items()}
        else:
            made[name] = x
    return made


def check_seed(seed: object) -> int:
    """A seed. Raises Refused."""
    if type(seed) is not int or not 0 <= seed <= MOST_SEED:
        raise Refused(f"found the seed {seed!r}, expected a whole number from 0 to {MOST_SEED}")
    return seed
