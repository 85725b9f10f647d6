"""Limits of ground, motors and joints within which a walk is feasible.

A single support is feasible when the force of the ground, averaged over any window within it, lies in the
friction cone (F_N > 0 and |F_T| <= mu F_N), every torque is within the motors' limit, every joint with a motor
within the rate and the range that its URDF states, the swing foot does not scuff away from the ends of the
step, and the impulse of its impact lies in the cone too. A mean and not an
instant is used: the edge of a push leaves the cone for a millisecond and a foot does not move in it, while
torques that chatter leave it in the mean as well. On soft ground a foot that slips by more than SLIP in a
single support takes the place of the cone. `analysis.certificate` applies the limits; those left open come
from the robot's record. A rate or a range that the URDF does not state is not judged.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, NamedTuple

from biped_adrc.core.checks import Checked, PositiveFloat, Range
from biped_adrc.core.shown import Shown
from biped_adrc.model.robots.robot_toml import RobotDescription

WINDOW = 5e-3
"""Time over which the force of the ground is averaged [s]."""
SLIP = 5e-3
"""Largest distance that a foot may slip on soft ground in a single support [m]."""

ROUND_OFF = 1e-9
"""Relative amount by which a force may lie outside the friction cone and still count as inside."""

ENDS = 0.03
"""Share of a step at either end in which the swing foot may touch the ground, dimensionless."""
ConeFloat = Annotated[float, Range("a number above 0 and at most 1", lambda x: 0.0 < x <= 1.0)]


class KnownLimits(NamedTuple):
    """The `Limits` of one robot, with every number known."""

    friction: float
    """Dry friction mu of the ground, dimensionless."""
    torque: float
    """Torque limit of every motor [N m]."""
    window: float
    """Time over which the ground's force is averaged [s]."""


@dataclass(frozen=True)
class Limits(Checked, Shown):
    """Limits of ground and motors within which a walk is feasible; None takes the value of the robot's record.

    Raises InputError for a friction that is not above 0 and at most 1, or a torque or
    window that is not positive.

    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    >>> walk = ba.walk(walker, gait, impacts=2, within=ba.Limits(friction=0.6, torque=150.0))
    >>> walk.trajectory.status.name
    'COMPLETED'
    """

    friction: ConeFloat | None = None
    """Dry friction mu of the ground, dimensionless."""
    torque: PositiveFloat | None = None
    """Torque limit of every motor [N m]."""
    window: PositiveFloat = WINDOW
    """Time over which the force of the ground is averaged [s]."""

    def of(self, robot: RobotDescription) -> KnownLimits:
        """These limits with the values of the robot's record in place of None."""
        mu = robot.friction_coefficient if self.friction is None else float(self.friction)
        torque = robot.peak_torque if self.torque is None else float(self.torque)
        return KnownLimits(mu, torque, self.window)
