"""The ground: axes along and out of a slope, steps down and up, random ones, stones, and limits of what it and
the motors can give.

The slope is constant and tilts the whole ground; a positive one goes downhill in the walking direction. A step
of the ground, down or up, is placed by the number of a single support, from 1: `StepDown(3, 0.02)` lowers by 20
mm the ground on which the third single support ends, and all that comes after it. `Walker`, the closed loop of
robot and controller, holds the slope and the tuple of steps; an impact is where the height of the swing foot
over that ground comes down to zero.

A drop [m] is how much lower the ground lies where a single support ends than at its stance foot; < 0 for up.
Between footholds, which are level pads, the ground is a straight line: above it the swing foot has to stay, but
at both ends of a step. A riser just before the foothold is a harder ground, which is judged beside it.

Stones are stepping stones: footholds at prescribed distances. All this ground is rigid; `SoftGround` has the
numbers of a compliant one, for a plant that MuJoCo simulates.

`Limits` are those of ground, motors and joints within which a walk is feasible. F_T, F_N [N] are the tangential
and the normal force of the ground on the stance foot, mu is the coefficient of dry friction. A push is an
external force or torque on the robot for a limited time.

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

import math
from dataclasses import dataclass
from typing import Annotated, Any, NamedTuple

import numpy as np

from biped_adrc.core.checks import Checked, PositiveFloat, PositiveFloats, PositiveInt, Range
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array
from biped_adrc.model.robots.robot_toml import RobotDescription


def ground_axes(slope: float) -> tuple[Array, Array]:
    """Unit vectors (x, z), each (2,), along the ground and out of it, for a slope [rad], positive downhill.

    A force F (2,) [N] in the axes (x, z) of the world has the tangential part F @ along and the normal part F @
    out, with along the first and out the second result.
    """
    along = np.array([math.cos(slope), -math.sin(slope)])
    return along, np.array([math.sin(slope), math.cos(slope)])


Slope = Annotated[float, Range("less than a right angle", lambda x: abs(x) < 0.5 * math.pi)]
RISING = Range("0 < first <= second < 1", lambda d: len(d) == 2 and 0.0 < d[0] <= d[1] < 1.0)


@dataclass(frozen=True)
class SoftGround(Checked, Shown):
    """Soft ground under point feet, in the terms of MuJoCo's contact model.

        a_ref = -b r' - k r,   b = 2 / (d T),   k = d(r) / (d^2 T^2 zeta^2)

    is the acceleration that the solver drives a foot at depth r [m] to: T is `time_constant`, zeta
    `damping_ratio` (solref), d(r) the impedance, which rises from the first value of `impedance` to the second
    one, d (solimp). Spring and damper act on an effective mass m of the foot, so that a stiffness in N/m
    follows from the robot and cannot be prescribed. A foot that rests at depth r under the force F has

        F / r = m (d(r) / d)^2 / ((1 - d(r)) T^2 zeta^2)

    since the solver leaves the share 1 - d(r) of a_ref at rest. Friction carries up to mu F_N; below that a
    foot creeps, the less the larger `impratio`. MuJoCo documentation, "Modeling: Solver parameters".

    Raises InputError for values that no ground has.
    """

    friction: PositiveFloat = 0.6
    """Coefficient mu of dry friction [1]."""
    time_constant: PositiveFloat = 2e-3
    """Time constant T [s]; MuJoCo uses two of its integration steps in place of a shorter one."""
    damping_ratio: PositiveFloat = 1.0
    """Damping ratio zeta [1]."""
    impedance: Annotated[tuple[float, float], RISING] = (0.95, 0.99)
    """Impedance d(r) at the surface and from 1 mm on [1]; 1 would leave no slack at all."""
    impratio: PositiveFloat = 20.0
    """Impedance of friction over that of the normal force [1]."""
    foot_radius: PositiveFloat = 1e-3
    """Radius of the feet [m]; a foot rolls on by the radius times the angle that its leg turns."""

    def stiffness(self, mass: float) -> tuple[float, float]:
        """Stiffness F / r [N/m] under a foot that rests: at the surface, and where d(r) = d, from 1 mm on.

        mass [kg]: the foot's effective mass m, as `MuJoCoPlant.foot_mass`. The formula is that of the class.
        """
        d = self.impedance[1]
        full = mass / (self.time_constant * self.damping_ratio) ** 2
        # at: the impedance d(r) at a depth, here at the surface and from 1 mm on
        at_surface, deep = (full * (at / d) ** 2 / (1.0 - at) for at in self.impedance)
        return at_surface, deep


@dataclass(frozen=True)
class GroundStep(Checked):
    """Base of a step down and a step up of the ground: the single support that ends on it, and its height."""

    step: PositiveInt
    """Number of the single support, from 1, that ends on the changed ground."""
    height: PositiveFloat
    """Height of the step [m], positive for both directions."""

    @property
    def drop(self) -> float:
        """Depth [m] of the ground below the stance foot where single support `step` ends; negative for up."""
        return self.height if isinstance(self, StepDown) else -self.height


class StepDown(GroundStep):
    """A step down: a single support ends on ground below its stance foot.

    step: number of that single support, from 1. height [m]: how much lower the ground lies. Raises InputError
    for a height that is not positive; a step up is a `StepUp`.

    >>> ground = (ba.StepDown(step=2, height=0.01),)
    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint), ground_steps=ground)
    >>> ba.walk(walker, gait, impacts=3).impacts
    3
    """


class StepUp(GroundStep):
    """A step up: the ground on which single support `step` (from 1) ends lies `height`
    [m] above its stance foot.

    The swing foot starts below that level; an impact is where it comes down on it after it has been above.
    Raises InputError for a height that is not positive; a step down is a `StepDown`.

    >>> ba.StepUp(step=2, height=0.01).drop
    -0.01
    """


@dataclass(frozen=True)
class Stones(Checked):
    """Stones on which the feet have to land: single support k, from 1, is to be `lengths[k - 1]` [m] long.

    A foot that lands further than `tolerance` [m] from its stone makes the walking step infeasible. Behind the
    last stone the ground is whole. Heights of stones are steps of the ground. Raises InputError for a length
    that is not positive.

    >>> Stones((0.3, 0.5)).missed(2, 0.54).__round__(3)
    0.015
    """

    lengths: PositiveFloats
    tolerance: PositiveFloat = 0.025

    def missed(self, step: int, length: float) -> float:
        """Distance [m] beyond the tolerance by which single support `step` of this length [m] misses its stone.

        0 on the stone, and behind the last one. step: its number, from 1.
        """
        if step > len(self.lengths):
            return 0.0
        return max(abs(length - self.lengths[step - 1]) - self.tolerance, 0.0)


def of_step(values: tuple[float, ...], step: int, usual: float) -> float:
    """The value of single support `step` in a list, such as the length [m] to its stone; `usual` behind it.

    values: of single supports 1, 2, ... step: a number, or a symbol of the code generator, which cannot be an
    index.
    """
    x: Any = usual
    # equality of the numbers k and step, which may be a float
    for k, value in enumerate(values, 1):
        x = np.where(abs(step - k) < 0.5, value, x)
    return x


def _are_steps(steps: object) -> bool:
    """Whether this is a tuple of steps up and down."""
    return isinstance(steps, tuple) and all(isinstance(x, StepDown | StepUp) for x in steps)


_STEPS = Range("a tuple of steps, such as (StepDown(3, 0.02),), or ()", _are_steps)
GroundSteps = Annotated[tuple[StepDown | StepUp, ...], _STEPS]


Steps = tuple[StepDown | StepUp, ...]
"""Changes of the ground's height."""


def drop_of(steps: Steps, number: int) -> float:
    """Depth [m] by which these steps lower the ground on which single support `number` ends; negative for up.

    Several steps of one single support add up.
    """
    return sum((d.drop for d in steps if d.step == number), 0.0)


def uneven_ground(seed: int, rms: float, steps: int) -> Steps:
    """Make random steps up and down, with heights of footholds of mean zero.

    seed: of the heights, a whole number from 0. rms [m]: their root mean square. steps: how many. The heights
    h_1, h_2, ... are independent and normally distributed. The first stance foot is at h_0 = 0, and single
    support k, for k = 1 to `steps`, ends h_(k-1) - h_k lower than it began. After that the ground is level. The
    same seed gives the same ground. Raises ValueError for an rms, a seed or a number of steps below 0.

    >>> ground = ba.uneven_ground(seed=1, rms=0.005, steps=20)
    >>> [edge.step for edge in ground[:3]]
    [1, 2, 3]
    """
    heights = np.concatenate(([0.0], np.random.default_rng(seed).normal(0.0, rms, steps)))
    return stepped(-np.diff(heights))


def stepped(drops: Array, first: int = 1) -> Steps:
    """Make steps of the ground of its drops.

    drops [m]: that of single support first + i at place i, up where negative; 0 makes no step. first: number of
    the first single support.

    >>> ba.stepped(np.array([0.0, 0.01, -0.02]))
    (StepDown(step=2, height=0.01), StepUp(step=3, height=0.02))
    """
    return tuple(
        StepDown(step, drop) if drop > 0.0 else StepUp(step, -drop)
        for step, drop in enumerate(drops.tolist(), first)
        if drop != 0.0
    )


# -- limits of ground and motors -------------------------------------------------------------------
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
