"""A scenario file as flat values by dotted name, for files of studies."""

from __future__ import annotations

from pathlib import Path

from biped_adrc.bench.parameters import Value
from biped_adrc.scenario import file
from biped_adrc.scenario.dotted import flat


def read_scenario(path: Path) -> dict[str, Value]:
    """The values of a scenario file by dotted name. Raises InputError."""
    return flat(file.read_scenario(path).record())
