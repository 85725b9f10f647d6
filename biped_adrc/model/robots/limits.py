"""Limits of ground, motors and joints within which a walk is feasible.

F_T, F_N [N] are the tangential and the normal force of the ground on the stance foot, mu is the coefficient of
dry friction. A push is an external force or torque on the robot for a limited time.

A single support is feasible if

- the force of the ground, as a mean over the time `window` (5 ms), lies in the friction cone (F_N > 0 and
  |F_T| <= mu F_N), wherever in the single support this window lies;
- every torque is within the motors' limit, and every joint with a motor within the rate and the range that its
  URDF states; a rate or a range that it does not state is not judged;
- the swing foot stays above the straight lines between footholds, but in the first and last 3 % (`ENDS`) of the
  walking step's time;
- the impulse of the impact lies in the friction cone too.

The mean and not the force at an instant is judged: when a push begins or ends, the force leaves the cone for a
millisecond, in which a foot does not move, while torques that chatter leave it in the mean as well. On soft
ground, in place of the cone, no foot may slip by more than `SLIP` in a single support. `analysis.certificate`
applies the limits; those that are left open come from the robot's record.
"""

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
"""Share of a force [1] by which it may lie outside the friction cone and still count as inside."""

ENDS = 0.03
"""Share [1] of the time of a walking step, at either end, in which the swing foot may touch the ground."""
ConeFloat = Annotated[float, Range("a number above 0 and at most 1", lambda x: 0.0 < x <= 1.0)]


class KnownLimits(NamedTuple):
    """The `Limits` of one robot, with a number in place of every None, in the same units."""

    friction: float
    torque: float
    window: float


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
        """These limits as numbers: where one is None, the value of the robot's record."""
        mu = robot.friction_coefficient if self.friction is None else float(self.friction)
        torque = robot.peak_torque if self.torque is None else float(self.torque)
        return KnownLimits(mu, torque, self.window)
