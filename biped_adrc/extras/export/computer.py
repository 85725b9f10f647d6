"""What of a walker runs on the robot's computer, and what is the robot's own.

The computer is given the time, the angles and, where they are measured, the rates. Its own are:
differences of angles and their filter, the nominal model's terms, the gait, the observer, the policy
at impact, limits of the torque and of its rate, and the torques on their way where it knows the
delay. Noise, counts of encoders, lag of motors and the delay itself are the robot's.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.errors import InputError, ModelError
from biped_adrc.core.timing import SampledTime
from biped_adrc.core.types import Array
from biped_adrc.engine.equations import WalkerNumbers
from biped_adrc.engine.program import controller_numbers
from biped_adrc.engine.tick_derivative import tick_derivative
from biped_adrc.extras.export.noticed import Noticed
from biped_adrc.hardware.motors import Motors
from biped_adrc.hardware.sample_hold import HeldParts
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hardware.sensors import Sensors
from biped_adrc.model.planar_robot import PlanarRobot, robot_of


@dataclass(frozen=True)
class Computer:
    """The controller's side of a walker in sampled time.

    Raises InputError for what cannot run without Python, and names the part that stands in the way.
    """

    walker: Walker

    def __post_init__(self) -> None:
        if not isinstance(self.walker.timing, SampledTime):
            raise InputError(
                f"a robot's computer acts at sample instants, found {type(self.walker.timing).__name__}; "
                "give the scenario a period, such as period = '1 ms', or hardware"
            )
        if self.walker.plant.p == 0:
            raise InputError("the robot has no motors, so there is no torque to compute")
        _ = self.walker.law  # raises where the controller has no form for sample instants

    @property
    def timing(self) -> SampledTime:
        """Period and delay."""
        assert isinstance(self.walker.timing, SampledTime)
        return self.walker.timing

    @cached_property
    def robot(self) -> PlanarRobot:
        """The nominal model. Raises InputError for one that is no planar tree of rigid links."""
        try:
            return robot_of(self.walker.nominal)
        except ModelError as reason:
            raise InputError(f"there is no C of the robot's model: {reason}") from reason

    @cached_property
    def differences(self) -> Sensors | None:
        """Differences of angles and their filter; None where all rates are measured.

        Raises InputError for a sensor with another part on the computer.
        """
        sensor = self.walker.sensors
        result = None if sensor is None else sensor.on_computer(None)
        if result is not None and not isinstance(result, Sensors):
            raise InputError(
                f"on the computer the sensors are {type(result).__name__}, expected Sensors or None"
            )
        return result

    @cached_property
    def sensors(self) -> Sensor | None:
        """The same as the computer runs them, where it notices touchdowns at sample instants too."""
        if self.differences is None or self.walker.touchdown is None:
            return self.differences
        return Noticed(self.differences, self.robot.R, self.robot.offset)

    @cached_property
    def alone(self) -> Walker:
        """A walker whose sample instants are what the computer does: its plant is the nominal model.

        Torques on their way are held where the computer has to know them: with a known delay, or a
        rate limit.
        """
        time, motors = self.timing, self.walker.motors
        limited = motors is not None and motors.rate_limit is not None
        if not (time.delay_known or limited):
            time = replace(time, delay=0.0)
        return Walker(
            self.walker.nominal,
            self.walker.controller,
            timing=time,
            torque_limit=self.walker.torque_limit,
            sensors=self.sensors,
            motors=Motors(motors.rate_limit) if motors is not None and limited else None,
            runaway_speed=self.walker.runaway_speed,
            runaway_torque=self.walker.runaway_torque,
        )

    @property
    def held(self) -> HeldParts:
        """What the computer holds between sample instants."""
        assert self.alone.held is not None
        return self.alone.held

    def growth(self, q: Array, v: Array) -> float:
        """Of the controller's fastest mode [1/s] where (q, v), each (n,), is held; 0 where none grows.

        An observer that receives the torque of its own controller, and a motion that does not answer to it,
        are such a case: a replay that runs freely.
        """
        x = self.alone.initial_state(q, v)
        _, J = tick_derivative(self.alone, len(x))(0.0, x, Mode())
        held = J[2 * len(q) :, 2 * len(q) :]
        return math.log(np.max(np.abs(np.linalg.eigvals(held)), initial=1.0)) / self.timing.period

    @cached_property
    def numbers(self) -> WalkerNumbers:
        """All numbers by name; of plant and ground there are none, as the computer knows its model alone."""
        return controller_numbers(self.robot, self.alone)
