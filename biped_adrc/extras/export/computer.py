"""The part of a walker (closed loop of robot, controller, sensors and motors) that runs on the robot's
computer.

The computer reads the time, the angles and, where they are measured, the rates. It computes differences of
angles and their filter, the nominal model's terms, the gait, the observer, the reset policy at impact, limits
of the torque and of its rate, and the queue of torques where it knows the delay. Noise, encoder counts, lag of
motors and the delay itself belong to the robot. The nominal model is the robot as the controller knows it.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple, Self, cast

import numpy as np

from biped_adrc.analysis.tick_derivative import tick_derivative
from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.errors import InputError
from biped_adrc.core.timing import SampledTime
from biped_adrc.core.tree import Layout, chosen
from biped_adrc.core.types import Array, Indices
from biped_adrc.engine.numbers import WalkerNumbers, controller_numbers
from biped_adrc.hardware.motors import Motors
from biped_adrc.hardware.sample_hold import HeldParts
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hardware.sensors import Sensors
from biped_adrc.model.planar_robot import PlanarRobot, robot_of


@dataclass(frozen=True)
class Computer:
    """The controller's side of a walker in sampled time.

    Raises InputError for a walker that cannot run without Python, and names the part that stands in the way.
    """

    walker: Walker

    def __post_init__(self) -> None:
        """Raise InputError for a walker without sample instants or motors; see the class."""
        timing, p = self.walker.timing, self.walker.plant.p
        if not isinstance(timing, SampledTime) or p == 0:
            raise InputError(
                f"a computer sends torques to motors at sample instants, found {type(timing).__name__} and {p} "
                "motors; give the scenario hardware.period = '1 ms', or hardware = 'rabbit'"
            )
        # raises InputError where the controller has no form for sample instants
        _ = self.walker.law

    @cached_property
    def robot(self) -> PlanarRobot:
        """The nominal model."""
        return robot_of(self.walker.nominal)

    @cached_property
    def sensors(self) -> Sensor | None:
        """The part of the walker's sensors that runs on the computer: differences of angles and their filter,
        as `Sensors` without noise and counts; wrapped in `Noticed` where touchdowns are detected; None if rates
        are measured.

        At a touchdown `Noticed` takes differences with the old names of the legs, then relabels them: q+ = R q-
        + offset. Raises InputError for a sensor that has another part on the computer.
        """
        # None: there is no sensor before this one, on whose part on the computer it could build
        sensor = self.walker.sensors
        result = None if sensor is None else sensor.on_computer(None)
        if result is not None and not isinstance(result, Sensors):
            name = type(result).__name__
            raise InputError(f"on the computer the sensors are {name}, expected Sensors or None")
        if result is None or self.walker.touchdown is None:
            return result
        return Noticed(result, self.robot.R, self.robot.offset)

    @cached_property
    def alone(self) -> Walker:
        """A walker whose sample instants do what the computer does: its plant is the controller's model.

        Only where the computer needs the torques on their way, for a known delay or a rate limit, does it have
        the delay and so their queue.
        """
        time, motors = self.walker.clock, self.walker.motors
        limited = motors is not None and motors.rate_limit is not None
        if not (time.delay_known or limited):
            time = replace(time, delay=0.0)
        return Walker(
            self.walker.nominal,
            self.walker.controller,
            timing=time,
            torque_limit=self.walker.torque_limit,
            sensors=self.sensors,
            # of the motors only the limit of the torque's rate is the computer's; their lag is the robot's
            motors=Motors(motors.rate_limit) if motors is not None and limited else None,
            runaway_speed=self.walker.runaway_speed,
            runaway_torque=self.walker.runaway_torque,
        )

    @property
    def held(self) -> HeldParts:
        """What keeps numbers between sample instants, sensors and motors, in `alone`: the walker with nothing
        but what runs on the computer.
        """
        return cast(HeldParts, self.alone.held)

    def growth(self, q: Array, v: Array) -> float:
        """Growth rate [1/s] of the fastest unstable mode of the computer's state while it measures the same q
        (n,) [rad] and v (n,) [rad/s] at all sample instants; 0 where none grows.

        A replay of measurements is such an open loop: the observer receives the torque of its own controller,
        and the motion does not respond to it.
        """
        x = self.alone.initial_state(q, v)
        # J: derivative of the state after a sample instant by the state before
        _, J = tick_derivative(self.alone, self.layout)(0.0, x, Mode())
        # held: of what the computer keeps; q and v, which stand first, are fixed
        held = J[2 * len(q) :, 2 * len(q) :]
        growth = math.log(np.max(np.abs(np.linalg.eigvals(held)), initial=1.0))
        return growth / self.walker.clock.period

    @cached_property
    def layout(self) -> Layout:
        """The layout of the state of `alone`: q and v, then the numbers that the computer keeps."""
        return self.alone.layout_of(np.zeros(2 * self.alone.plant.n))

    @cached_property
    def numbers(self) -> WalkerNumbers:
        """All parameters of the controller and its model by name, without those of the real robot and ground,
        which the computer does not know.
        """
        return controller_numbers(self.robot, self.alone)


class Landing(NamedTuple):
    """State w of the sensors `Noticed`."""

    inner: Any
    """State w of the sensor that is wrapped."""
    landed: float
    """1 between a touchdown and the sample instant after it, else 0."""


@dataclass(frozen=True)
class Noticed(Sensor):
    """The sensor `inner` on the computer where touchdowns are detected at sample instants, as in
    `closed_loop.semantics`.

    A relabelling q+ = R q- + offset names the joints for the new stance leg. A touchdown is detected with the
    measurement of that instant. `impact` first reads it with the old names, so that rates are differences
    within one single support, and then relabels. The sample instant that follows at once (`landed` = 1) does
    not read the same measurement again. Raises InputError for a robot whose joints do not exchange in pairs, so
    that R is not its own inverse.
    """

    inner: Sensor
    R: Indices
    offset: Array

    def __post_init__(self) -> None:
        """Raise InputError where the relabelling is not its own inverse; see the class."""
        R, offset = self.R, self.offset
        if np.any(np.eye(len(R)) != R @ R) or np.any(R @ offset + offset != 0.0):
            raise InputError(
                "the labels of this robot's joints do not exchange in pairs at a touchdown, so what was "
                "measured has no old labels; leave out touchdown"
            )

    def sampled(self, n: int, p: int, period: float) -> Self:
        return replace(self, inner=self.inner.sampled(n, p, period))

    def start(self, q: Array, v: Array) -> Landing:
        return Landing(self.inner.start(q, v), 0.0)

    def sense(self, w: Landing, q: Array, v: Array) -> Landing:
        # at the instant of the touchdown itself (landed = 1) `impact` has read this measurement already
        return Landing(chosen(w.landed, w.inner, self.inner.sense(w.inner, q, v)), 0.0)

    def impact(self, w: Landing, q: Array, v: Array, v_model: Array) -> Landing:
        """State after a detected touchdown at q, v (n,) by the new names.

        Its rates are those measured by the old names, relabelled; v_model is not used.
        """
        R = self.R
        # the measurement with the old names, as R is its own inverse
        q_old, v_old = R @ q + self.offset, R @ v
        before = self.inner.sense(w.inner, q_old, v_old)
        # [1]: the rates of a reading (angles, rates)
        rates = self.inner.reading(before, q_old, v_old)[1]
        return Landing(self.inner.impact(before, q, v, R @ rates), 1.0)

    def reading(self, w: Landing, q: Array, v: Array) -> tuple[Array, Array]:
        return self.inner.reading(w.inner, q, v)
