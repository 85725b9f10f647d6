"""A scenario in a TOML file: the values of one walk, which commands and files of studies take.

    controller = "LESO"
    bandwidth = "160 rad/s"
    own.window = 0.02

Values are read as in the file of a study (`bench.parameters.read`): numbers in the SI unit, or text with a
unit; "none" for no value. Written by `tuning.tune`; read by the option --scenario and by [study] scenario.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path

from pydantic import ValidationError

from biped_adrc.bench.parameters import NONE, Refused, Value, flat, read
from biped_adrc.errors import InputError
from biped_adrc.files import reading, write_text
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.values import reason


def read_scenario(path: Path) -> dict[str, Value]:
    """The values of a scenario file by name, those of tables with a dot. Raises InputError."""
    with reading("scenario file", path, InputError):
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
    found = {}
    for name, x in flat(tables).items():
        try:
            found[name] = read(name, x)
        except (Refused, ValidationError) as error:
            raise InputError(f"scenario file '{path}', {name}: {reason(error)}") from error
    return found


def write_scenario(path: Path, s: Scenario, comment: str = "") -> None:
    """Write the values of a scenario that differ from the defaults, and whom it is of. Raises OutputError.

    comment: lines at the top of the file.
    """
    lines = [f"# {line}" for line in comment.splitlines()] + scenario_lines(s)
    write_text(path, "\n".join(lines) + "\n")


def scenario_lines(s: Scenario) -> list[str]:
    """The values of a scenario that differ from the defaults, and whom it is of, as lines of TOML."""
    record = {"controller": s.controller, "robot": s.robot} | s.record()
    return [
        f"{'.'.join(map(_key, name.split('.', 1)))} = {toml(x)}" for name, x in flat(record).items()
    ]


def _key(name: str) -> str:
    """A key as TOML has it, in quotes where it has other characters than letters, digits, _ and -."""
    return name if re.fullmatch("[A-Za-z0-9_-]+", name) else json.dumps(name)


def toml(x: object) -> str:
    """A plain value as TOML has it: floats read back to the same bits."""
    if x is None:
        return json.dumps(NONE)
    if isinstance(x, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {toml(inner)}" for key, inner in x.items()) + " }"
    if isinstance(x, list | tuple):
        return "[" + ", ".join(map(toml, x)) + "]"
    if isinstance(x, str | bool | int):
        return json.dumps(x, ensure_ascii=False)
    return repr(float(x)) if isinstance(x, float) else repr(x)
