"""A scenario in a TOML file, with the dotted names that it has everywhere.

    controller.name = "LESO"
    controller.observer.bandwidth = "160 rad/s"
    pushes = [{ joints = "q1", torque = "30 N m", step = 2, onset = "0.1 s" }]

Numbers are in the SI unit, or text with a unit; "none" is no value. Written by a search of `study`; read by
--scenario.
"""

from __future__ import annotations

import tomllib
from pathlib import Path

from biped_adrc.core.errors import InputError
from biped_adrc.core.files import one_line, reading, toml_key, toml_value, write_text
from biped_adrc.scenario.dotted import flat
from biped_adrc.scenario.scenario import Scenario


def read_scenario(path: Path) -> Scenario:
    """The scenario of a file. Raises InputError with the file and the name of the value."""
    with reading("scenario file", path, InputError):
        return Scenario(**tomllib.loads(path.read_text(encoding="utf-8")))


def write_scenario(path: Path, s: Scenario, comment: str = "") -> None:
    """Write the values of a scenario that differ from the defaults, and whom it is of. Raises OutputError.

    comment: lines at the top of the file.
    """
    lines = [f"# {one_line(line)}" for line in comment.splitlines()] + scenario_lines(s)
    write_text(path, "\n".join(lines) + "\n")


def scenario_lines(s: Scenario) -> list[str]:
    """The values of a scenario that differ from the defaults, and whom it is of, as lines of TOML."""
    record = {"controller.name": s.controller.name, "robot.name": s.robot.name}
    pushes = s.record().pop("pushes", [])
    values = record | flat({k: x for k, x in s.record().items() if k != "pushes"})
    values |= {"pushes": pushes} if pushes else {}
    return [
        f"{'.'.join(map(toml_key, name.split('.')))} = {toml_value(x)}"
        for name, x in values.items()
    ]
