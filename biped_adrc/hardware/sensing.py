"""A sensor: a state w that changes at ticks and impacts, and the reading of (q, q') for the controller.

    w <- sense(w, q, v)                   at a tick at (q, v)
    w <- impact(w, q, v, v_model)         after an impact to (q, v)
    (q^, v^) = reading(w, q, v)           from (q, v) as the sensors before it read them

q are the n coordinates, first the angles of the p joints with motors, last the pitch, and v = q'. A tick is a
sample instant.

`a + b` puts b behind a: both sense the true (q, v), and b changes the readings of a. In this chain from the
robot to the controller "before" means nearer to the robot, "behind" nearer to the controller.

Sensors work in sampled time: between ticks the controller has the readings of the last one. Both engines run
these methods, which are pure functions; randomness is a part of w, so that a walk is repeated by its seed.
`closed_loop.semantics` calls them, `hardware.sample_hold` keeps w.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from biped_adrc.core.checks import Checked, check_part
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array


class Sensor(Checked):
    """Base of all sensors: write `reading`, and `start` and `sense` for a sensor with a memory."""

    def start(self, q: Array, v: Array) -> Any:
        """State w at the start of a run in q (n,) [rad], v (n,) [rad/s]; () without a memory."""
        return ()

    def sense(self, w: Any, q: Array, v: Array) -> Any:
        """State w after a tick at the true q (n,) [rad], v (n,) [rad/s]."""
        return w

    def impact(self, w: Any, q: Array, v: Array, v_model: Array) -> Any:
        """State w after an impact that led to q (n,) [rad], v (n,) [rad/s], legs relabelled.

        v_model (n,) [rad/s]: the last measured rates, mapped by the nominal model's impact, for sensors that
        take differences of angles. A controller that detects touchdowns itself calls this after the impact, so
        its measured rates are only relabelled.
        """
        return w

    def reading(self, w: Any, q: Array, v: Array) -> tuple[Array, Array]:
        """q^ (n,) [rad] and v^ (n,) [rad/s] for the controller, from w and from q, v (n,) as the sensors before
        it read them; the first sensor gets the true q, v.

        This base raises InputError: a subclass writes the method, or `sampled` returns a sensor that has it.
        """
        name = type(self).__name__
        raise InputError(f"{name} has no reading(w, q, v); write it, or take sampled(n, p, period)")

    def sampled(self, n: int, p: int, period: float) -> Sensor:
        """The sensor that a walk runs: for n coordinates, p of them with motors, ticks every `period` [s]."""
        return self

    comes_first: ClassVar[bool] = False
    """Whether it measures the state itself, so that no sensor can stand before it."""

    @property
    def noisy(self) -> bool:
        """Whether the readings are random: a walk with such a sensor has no orbit, and so no return map."""
        return False

    def smooth(self) -> Sensor:
        """The same sensor without rounding to counts and without noise, so that the loop can be linearised."""
        return self

    def errors(self, n: int, p: int, before: Array) -> Array:
        """Standard deviations (2 n,) [rad, rad/s] of the random errors in (q^, v^) behind this sensor.

        before (2 n,): those of its input, the readings of the sensors before it; zeros for the first one.
        Errors are independent from tick to tick; rounding to counts is an error with a uniform distribution
        over one count. n: number of coordinates, p: of motors.
        """
        return before

    def on_computer(self, before: Sensor | None) -> Sensor | None:
        """The sensor that stands for the software, such as differences of angles and their filter, which this
        sensor and those before it run on the controller's computer; None where they run nothing there.

        A controller that is exported as C code contains it. before: this result for the sensors before it
        alone, None for the first one. This base raises InputError: a subclass writes the method.
        """
        raise InputError(
            f"sensor {type(self).__name__} does not say what of it runs on the controller's computer; "
            "write on_computer(before)"
        )

    def __add__(self, other: Sensor) -> Sensor:
        check_part(other, f"what is added to {type(self).__name__}", Sensor)
        if _parts(other)[0].comes_first:  # it would drop the readings of those before it
            raise InputError(f"{type(other).__name__} reads the state itself, so it comes first")
        return Sensing((*_parts(self), *_parts(other)))


def _parts(sensor: Sensor) -> tuple[Sensor, ...]:
    """The sensors of a `Sensing`, or the sensor alone, so that a + b + c is one flat `Sensing` of three."""
    return sensor.parts if isinstance(sensor, Sensing) else (sensor,)


@dataclass(frozen=True)
class Sensing(Sensor):
    """Several sensors: each changes the readings of those before it; w is the tuple of their states.

    Its methods do what those of `Sensor` say, sensor by sensor.
    """

    parts: tuple[Sensor, ...]

    def start(self, q: Array, v: Array) -> tuple[Any, ...]:
        return tuple([part.start(q, v) for part in self.parts])

    def sense(self, w: tuple[Any, ...], q: Array, v: Array) -> tuple[Any, ...]:
        return tuple([part.sense(own, q, v) for part, own in zip(self.parts, w, strict=True)])

    def impact(self, w: tuple[Any, ...], q: Array, v: Array, v_model: Array) -> tuple[Any, ...]:
        each = zip(self.parts, w, strict=True)
        return tuple([part.impact(own, q, v, v_model) for part, own in each])

    def reading(self, w: tuple[Any, ...], q: Array, v: Array) -> tuple[Array, Array]:
        for part, own in zip(self.parts, w, strict=True):
            q, v = part.reading(own, q, v)
        return q, v

    def sampled(self, n: int, p: int, period: float) -> Sensor:
        """The sensors that a walk runs: for n coordinates, p of them with motors, ticks every `period` [s]."""
        return Sensing(tuple(part.sampled(n, p, period) for part in self.parts))

    @property
    def noisy(self) -> bool:
        return any(part.noisy for part in self.parts)

    def smooth(self) -> Sensor:
        """The same sensors without rounding and noise, for a linear loop."""
        return Sensing(tuple(part.smooth() for part in self.parts))

    def errors(self, n: int, p: int, before: Array) -> Array:
        """Standard deviations (2 n,) [rad, rad/s] of the errors in (q^, v^) behind the last sensor.

        before (2 n,): those of what the first sensor reads, zeros for the true (q, v). n: number of
        coordinates, p: of motors.
        """
        for part in self.parts:
            before = part.errors(n, p, before)
        return before

    def on_computer(self, before: Sensor | None) -> Sensor | None:
        """The sensor that stands for the software of all these sensors on the controller's computer, or None.

        before: the software of sensors before these, None without any. Each sensor gets what those before it
        run, and returns that together with its own.
        """
        for part in self.parts:
            before = part.on_computer(before)
        return before
