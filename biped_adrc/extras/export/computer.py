"""The part of a walker that runs on the robot's computer.

The computer reads the time, the angles and, where they are measured, the rates. It computes differences of
angles and their filter, the nominal model's terms, the gait, the observer, the reset policy at impact, limits
of the torque and of its rate, and the queue of torques where it knows the delay. Noise, encoder counts, lag of
motors and the delay itself belong to the robot.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

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
        timing, p = self.walker.timing, self.walker.plant.p
        if not isinstance(timing, SampledTime) or p == 0:
            raise InputError(
                f"a computer sends torques to motors at sample instants, found {type(timing).__name__} and {p} "
                "motors; give the scenario a period, such as period = '1 ms', or hardware"
            )
        _ = self.walker.law  # raises where the controller has no form for sample instants

    @property
    def timing(self) -> SampledTime:
        """The walker's sampling period and delay [s]."""
        assert isinstance(self.walker.timing, SampledTime)
        return self.walker.timing

    @cached_property
    def robot(self) -> PlanarRobot:
        """The nominal model."""
        return robot_of(self.walker.nominal)

    @cached_property
    def differences(self) -> Sensors | None:
        """The walker's sensors as far as they run on the computer: differences and their filter;
        None if rates are measured.

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
        """`differences` as the computer runs them; with detected touchdowns, wrapped for these (`Noticed`)."""
        if self.differences is None or self.walker.touchdown is None:
            return self.differences
        return Noticed(self.differences, self.robot.R, self.robot.offset)

    @cached_property
    def alone(self) -> Walker:
        """A walker whose sample instants do what the computer does: its plant is the nominal model.

        It keeps a queue of torques only where the computer has to know them: with a
        known delay, or a rate limit.
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
        """The parts of the computer that keep numbers between sample instants."""
        assert self.alone.held is not None
        return self.alone.held

    def growth(self, q: Array, v: Array) -> float:
        """Growth rate [1/s] of the controller's fastest mode while (q, v), each (n,), stay
        the same; 0 where none grows.

        A replay runs so: the observer receives the torque of its own controller, and the
        motion does not respond to it.
        """
        x = self.alone.initial_state(q, v)
        _, J = tick_derivative(self.alone, self.layout)(0.0, x, Mode())
        held = J[2 * len(q) :, 2 * len(q) :]
        return math.log(np.max(np.abs(np.linalg.eigvals(held)), initial=1.0)) / self.timing.period

    @cached_property
    def layout(self) -> Layout:
        """The layout of the state of `alone`: (q, v), and x_c."""
        return self.alone.layout_of(np.zeros(2 * self.alone.plant.n))

    @cached_property
    def numbers(self) -> WalkerNumbers:
        """All numbers of the controller by name; the computer knows its model alone, so there
        are none of plant and ground.
        """
        return controller_numbers(self.robot, self.alone)


class Landing(NamedTuple):
    """State of `Noticed`."""

    inner: Any
    """State of the sensors inside."""
    landed: float
    """1 between a touchdown and the sample instant after it, else 0."""


@dataclass(frozen=True)
class Noticed(Sensor):
    """Sensors on the computer where touchdowns are detected at sample instants, as in `closed_loop.semantics`.

    A detected touchdown comes with the measurement of that instant. The measurement is first read in the old
    labels, so that rates are differences within one single support. Angles and rates are then relabelled, and
    the sample instant that follows at once does not read the same measurement again. Raises InputError for a
    robot, q+ = R q- + offset, whose joint labels do not exchange in pairs.
    """

    inner: Sensor
    R: Indices
    offset: Array

    def __post_init__(self) -> None:
        R, offset = self.R, self.offset
        if np.any(np.eye(len(R)) != R @ R) or np.any(R @ offset + offset != 0.0):
            raise InputError(
                "the labels of this robot's joints do not exchange in pairs at a touchdown, so what was "
                "measured has no old labels; leave out touchdown"
            )

    def sampled(self, n: int, p: int, period: float) -> Noticed:
        return replace(self, inner=self.inner.sampled(n, p, period))

    def start(self, q: Array, v: Array) -> Landing:
        return Landing(self.inner.start(q, v), 0.0)

    def sense(self, w: Landing, q: Array, v: Array) -> Landing:
        return Landing(chosen(w.landed, w.inner, self.inner.sense(w.inner, q, v)), 0.0)

    def impact(self, w: Landing, q: Array, v: Array, v_model: Array) -> Landing:
        R = self.R
        q_old, v_old = R @ q + self.offset, R @ v
        before = self.inner.sense(w.inner, q_old, v_old)
        rates = self.inner.reading(before, q_old, v_old)[1]
        return Landing(self.inner.impact(before, q, v, R @ rates), 1.0)

    def reading(self, w: Landing, q: Array, v: Array) -> tuple[Array, Array]:
        return self.inner.reading(w.inner, q, v)
