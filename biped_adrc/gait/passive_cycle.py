"""Known walking cycles of robots without motors: a slope, and the state just after an impact on the cycle.

Stored as a small readable TOML file `gaits/<robot>/<preset>.toml` with its source. The numbers are as they were
published, a start for Newton on the return map and nothing more.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass

from biped_adrc.errors import GaitError
from biped_adrc.files import reading
from biped_adrc.gait.gait import finite_vector
from biped_adrc.model.biped import Biped
from biped_adrc.resources import data_folder
from biped_adrc.types import Array


@dataclass(frozen=True)
class PassiveCycle:
    """A cycle of a robot that only gravity drives; n coordinates."""

    robot: str
    preset: str
    source: str
    slope: float
    """Of the ground [rad], positive downhill."""
    max_step_time: float
    """[s]: a longer single support is no step of this robot."""
    q_plus: Array
    """(n,) just after impact [rad]."""
    v_plus: Array
    """(n,) [rad/s]."""


def passive_cycle(biped: Biped) -> PassiveCycle:
    """The stored cycle of this robot and preset.

    Raises GaitError that names the file, what was found and what was expected.
    """
    robot, preset = biped.description.name, biped.preset
    path = data_folder("gaits") / robot / f"{preset}.toml"
    if not path.is_file():
        raise GaitError(
            f"no walking cycle without motors is stored for robot '{robot}', preset '{preset}': there is no "
            f"file '{path}'"
        )
    with reading("cycle", path, GaitError):
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        return PassiveCycle(
            robot,
            preset,
            str(data["source"]),
            float(data["slope"]),
            float(data["max_step_time"]),
            finite_vector(data, "q_plus", biped.n),
            finite_vector(data, "v_plus", biped.n),
        )
