"""A scenario in a TOML file: the values of one walk, which commands and files of studies take.

    controller = "LESO"
    bandwidth = "160 rad/s"
    own.window = 0.02

Values are read as in the file of a study (`bench.parameters.read`): numbers in the SI unit, or text with a
unit; "none" for no value. Written by `tuning.tune`; read by the option --scenario and by [study] scenario.
"""

from __future__ import annotations

import tomllib
from pathlib import Path

from pydantic import ValidationError

from biped_adrc.bench.parameters import Refused, Value, flat, read
from biped_adrc.errors import InputError
from biped_adrc.files import one_line, reading, toml_key, toml_value, write_text
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
    lines = [f"# {one_line(line)}" for line in comment.splitlines()] + scenario_lines(s)
    write_text(path, "\n".join(lines) + "\n")


def scenario_lines(s: Scenario) -> list[str]:
    """The values of a scenario that differ from the defaults, and whom it is of, as lines of TOML."""
    record = {"controller": s.controller, "robot": s.robot} | s.record()
    return [
        f"{'.'.join(map(toml_key, name.split('.', 1)))} = {toml_value(x)}"
        for name, x in flat(record).items()
    ]
