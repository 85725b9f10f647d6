"""What ground and motors can give: the limits within which a walk is legal.

A walk makes a single support legally when the force of the ground, averaged over any window within it, lies in
the friction cone (F_N > 0 and |F_T| <= mu F_N), every torque is within the motors' limit, and the swing foot
does not scuff away from the ends of the step. The impulse at impact is not part of it. A mean and not an
instant: the edge of a push breaks the cone for a millisecond and a foot does not move in it, while torques that
chatter break it in the mean as well.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from biped_adrc.errors import InputError, check_positive
from biped_adrc.model.robots import RobotDescription

WINDOW = 5e-3
"""[s]"""
ROUND_OFF = 1e-9
"""By which a force on the friction cone may lie outside of it, relative."""
ENDS = 0.03
"""Share of a step at either end in which the swing foot may be at the ground."""


class KnownLimits(NamedTuple):
    """`Limits` of one robot."""

    friction: float
    """mu."""
    torque: float
    """[N m]"""
    window: float
    """[s]"""


@dataclass(frozen=True)
class Limits:
    """friction: mu of the ground; torque [N m]: of every motor; None is what the robot's record says.

    window [s]: over which the force of the ground is averaged. Raises InputError for a friction that is not
    above 0 and at most 1, or a torque or window that is not positive.
    """

    friction: float | None = None
    torque: float | None = None
    window: float = WINDOW

    def __post_init__(self) -> None:
        mu, torque = self.friction, self.torque
        if mu is not None and not 0.0 < mu <= 1.0:
            raise InputError(
                f"the friction limit is {mu}, expected a number above 0 and at most 1, or None for the "
                "robot's record"
            )
        if torque is not None and not torque > 0.0:
            raise InputError(
                f"the torque limit is {torque} N m, expected a positive number, or None for the robot's record"
            )
        check_positive(self.window, f"the force window is {self.window} s")

    def of(self, robot: RobotDescription) -> KnownLimits:
        """With what the robot's record says where None was given."""
        mu, torque = self.friction, self.torque
        return KnownLimits(
            robot.friction_coefficient if mu is None else float(mu),
            robot.peak_torque if torque is None else float(torque),
            float(self.window),
        )
