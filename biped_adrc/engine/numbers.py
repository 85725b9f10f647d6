"""The numbers of a walker, the closed loop, that machine code gets at run time: masses, gains, limits, .., by
name.

`engine.structure.floats` writes the floats among them in this order into the vector K, an argument of every
compiled function; whole numbers and flags decide the code itself. A number that machine code is to get in
addition becomes a field here.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.walker import ErrorForm, Walker
from biped_adrc.control.base import Controller
from biped_adrc.control.outer_loop import OuterLoop, tracked_by
from biped_adrc.core.types import Array
from biped_adrc.gait.reference import Reference
from biped_adrc.hardware.sample_hold import HeldParts
from biped_adrc.model.planar_robot import PlanarRobot, robot_of

Reading = Callable[..., tuple[Array, ...]]
"""read(loop, t, x, mode, reference) -> arrays, such as `signals_at`: what is read off the loop at one instant,
t in [s], x (nx,); reference(s, m) is the point of the reference from which it takes errors."""


NONE = np.zeros(0)
"""An empty array, for what a walker does not have."""


class WalkerNumbers(NamedTuple):
    """All numbers of a walker that machine code gets at run time, in the order of the vector K."""

    plant: PlanarRobot
    """The robot that moves; where the plant moves by itself, the controller's model."""
    model: PlanarRobot | None
    """The controller's model, None where it is `plant`."""
    controller: Controller
    """The controller in its form for the walker's time base, continuous or sampled."""
    torque_limit: float
    """Limit at which every motor saturates [N m], infinite without one."""
    tan_slope: float = 0.0
    """Tangent of the ground's slope [1], positive downhill."""
    lowest_hip: float = 0.0
    """Height of the hip below which the robot has fallen [m]."""
    longest: float = math.inf
    """Longest single support [s]."""
    strongest: float = math.inf
    """Torque beyond which the run ends [N m], infinite without such a bound."""
    held: HeldParts | tuple[()] = ()
    """Parameters of what is held between sample instants, empty in continuous time."""
    impact_gain: Array = NONE
    """Relative errors of v+, the rates after an impact, (n,) [1]; empty without."""
    split: ErrorForm | None = None
    """Coordinates of the exponential method; None for other methods."""
    curve: Reference | OuterLoop | None = None
    """Reference from which readings take errors; no other function uses it."""
    moves: bool = False
    """Whether the plant moves by itself, so that sample instants are all that is compiled."""


def numbers_of(
    walker: Walker, split: ErrorForm | None = None, curve: Reference | OuterLoop | None = None
) -> WalkerNumbers:
    """All numbers of a walker by name, as K lists them; what a walker does not have is empty and has no number
    in K.

    split: coordinates of the exponential method, None for other methods. curve: reference from which readings
    take errors. Raises ModelError for a robot that is no planar tree.
    """
    # `robot_of`: the robot's dynamics as formulas, which can be traced; `tracked_by`: the controller itself
    # where an outer loop in it changes the reference, else the curve
    return controller_numbers(robot_of(walker.plant), walker)._replace(
        model=None if walker.model is None else robot_of(walker.model),
        tan_slope=math.tan(walker.ground_slope),
        lowest_hip=float(walker.lowest_hip),
        longest=float(walker.max_step_time),
        impact_gain=walker.gain,
        split=split,
        curve=None if curve is None else tracked_by(walker.law, curve),
    )


def controller_numbers(robot: PlanarRobot, loop: Walker | SteppingLoop) -> WalkerNumbers:
    """The numbers of a loop's controller, with `robot` as its model and as the plant; those of the ground, of
    another model and of impacts have their defaults.
    """
    limit = math.inf if loop.torque_limit is None else float(loop.torque_limit)
    strongest, held = float(loop.bounds.strongest), loop.held or ()
    # None: no model but `robot` itself
    return WalkerNumbers(robot, None, loop.law, limit, strongest=strongest, held=held)
