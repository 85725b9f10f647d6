"""Which joints to bend for the stride's correction: static gain per peak torque.

The static gain g = dv/dbeta [m/s per rad] of a direction d (`stride_gain`) is what the correction does to the
speed in the long run. What it costs is the change of the motors' torque along the periodic orbit,

    U = max over the step and the motors of |du/dbeta|   [N m per rad],

and |g| / U [m/s per N m] does not change when d is scaled, so it compares directions.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from biped_adrc.analysis.stride_gain import DIFFERENCE, bumped, stride_response
from biped_adrc.control.stride import TORSO_LEAN
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.types import Array

STANCE_KNEE = (0.0, 0.0, 1.0, 0.0)
"""d for RABBIT's joints: beta < 0 bends the stance knee in the middle of the step and quickens the walk."""

DIRECTIONS: Mapping[str, tuple[float, ...]] = {
    "torso lean": TORSO_LEAN,
    "stance hip": (1.0, 0.0, 0.0, 0.0),
    "swing hip": (0.0, 1.0, 0.0, 0.0),
    "hips apart": (1.0, -1.0, 0.0, 0.0),
    "stance knee": STANCE_KNEE,
    "swing knee": (0.0, 0.0, 0.0, 1.0),
}
"""By name, for a robot with RABBIT's joints."""


@dataclass(frozen=True)
class DirectionMerit:
    """One direction d (p,) of the correction."""

    name: str
    direction: tuple[float, ...]
    static_gain: float
    """g [m/s per rad]."""
    torque: float
    """U [N m per rad]."""

    @property
    def merit(self) -> float:
        """|g| / U [m/s per N m]."""
        return abs(self.static_gain) / self.torque


def direction_merits(
    gait: Gait, biped: Biped, directions: Mapping[str, tuple[float, ...]] = DIRECTIONS
) -> tuple[DirectionMerit, ...]:
    """Every direction, the best first. Raises InputError without one, and as `stride_response`."""
    if not directions:
        raise InputError("no direction of the stride's correction was given, expected at least one")
    found = [_merit(gait, biped, name, d) for name, d in directions.items()]
    return tuple(sorted(found, key=lambda direction: -direction.merit))


def _merit(gait: Gait, biped: Biped, name: str, d: tuple[float, ...]) -> DirectionMerit:
    gain = stride_response(gait, biped, d).static_gain

    def torque(beta: float) -> Array:
        return ZeroDynamics.of(biped, bumped(gait.constraint, beta * np.array(d))).cycle.u

    change = (torque(DIFFERENCE) - torque(-DIFFERENCE)) / (2.0 * DIFFERENCE)
    U = float(np.max(np.abs(change)))
    if not U > 0.0:
        raise InputError(f"the direction '{name}' is {d}, expected one that bends a joint")
    return DirectionMerit(name, d, gain, U)
