"""Published orbits: the paper's fixed point x*, and cycles of robots without motors.

x* is the state just before impact of the paper's periodic walk (its section VI). Gait (a) of the paper, stored
as "published", is the virtual constraint of least torque whose orbit passes through it; `design_gait(through=)`
finds it again, as closely as a cost that is flat near its minimum lets it. As printed, x* puts the swing foot
0.13 mm under the ground. So q1..q4 are moved until the foot is on the ground (`gait.onto_section`), by less
than half a unit of their last printed digit; q5, printed with four decimals, and the rates are kept.

A cycle of a robot without motors is a slope, and the state just after an impact on it. It is stored as a small
readable TOML file `gaits/<robot>/<preset>.toml` with its source. The numbers are as they were published; they
only start Newton's method on the return map, which finds the cycle itself (`analysis.stability.known_cycle`).
"""

import os
import tomllib
from dataclasses import dataclass

from biped_adrc.core.errors import GaitError
from biped_adrc.core.files import data_file, reading
from biped_adrc.core.types import Array, read_only
from biped_adrc.gait.gait import finite_vector
from biped_adrc.model.biped import Biped


@dataclass(frozen=True)
class PassiveCycle:
    """A walking cycle of a robot without motors, as published; n coordinates."""

    slope: float
    """Slope of the ground [rad], positive downhill."""
    max_step_time: float
    """Longest single support [s]; a longer one ends the walk."""
    q_plus: Array
    """Coordinates (n,) just after impact [rad]."""
    v_plus: Array
    """Rates (n,) just after impact [rad/s]."""


def passive_cycle(biped: Biped) -> PassiveCycle:
    """Load the cycle of this robot and preset: <preset>.toml beside the robot's URDF, else the package's.

    Raises GaitError that names the file, what was found and what was expected.
    """
    robot, preset = biped.description.name, biped.preset
    # basename, since a preset's name must not lead out of the folder
    own = biped.description.urdf.with_name(os.path.basename(f"{preset}.toml"))
    path = own if os.path.isfile(own) else data_file("gaits", robot, f"{preset}.toml")
    if not path.is_file():
        raise GaitError(
            f"no walking cycle without motors is stored for robot '{robot}', preset '{preset}': there is no "
            f"file '{own}'; write one with source, slope [rad], max_step_time [s], and the state after impact "
            "q_plus [rad] and v_plus [rad/s], near which the cycle is searched"
        )
    with reading("cycle", path, GaitError):
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        slope, longest = float(data["slope"]), float(data["max_step_time"])
        state = (finite_vector(data, key, biped.n) for key in ("q_plus", "v_plus"))
        return PassiveCycle(slope, longest, *state)


X_STAR = read_only([3.247, 3.672, -0.622, -0.644, -0.0104, -0.298, 0.340, -1.578, 1.370, -0.170])
"""x* (10,) as printed in the paper's section VI, (q, q') just before impact [rad, rad/s]."""

PUBLISHED_MULTIPLIERS = (0.640, 0.640, 0.844, 0.844, 0.237, 0.237, 0.138, 0.354, 0.354, 0.6609)
"""|lambda| (10,) as printed in the paper's section VI, from its regression (27) on a disturbed walk."""
