"""A sensor: a state w that changes at ticks and impacts, and the reading of (q, q') for the controller.

    w <- sense(w, q, v)                   at a tick at (q, v)
    w <- impact(w, q, v, v_model)         after an impact to (q, v)
    (q^, v^) = reading(w, q, v)           (q, v) as the sensors before it read them

`a + b` puts b behind a: both sense the true (q, v), and b changes the readings of a.

Sensors work in sampled time: between ticks the controller has the readings of the last one. Both engines run
these methods, which are pure functions; randomness is a part of w, so that a walk is repeated by its seed.
`closed_loop.semantics` calls them, `hardware.sample_hold` keeps w.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from biped_adrc.core.checks import Checked, check_part
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array


class Sensor(Checked):
    """Base of all sensors: write `reading`, and `start` and `sense` for a sensor with a memory."""

    def start(self, q: Array, v: Array) -> Any:
        """State w at the start of a run in q (n,) [rad], v (n,) [rad/s]; () without a memory."""
        return ()

    def sense(self, w: Any, q: Array, v: Array) -> Any:
        """State w after a tick at q (n,) [rad], v (n,) [rad/s]."""
        return w

    def impact(self, w: Any, q: Array, v: Array, v_model: Array) -> Any:
        """State w after an impact that led to q (n,) [rad], v (n,) [rad/s].

        v_model (n,) [rad/s]: the last measured rates mapped by the nominal model's impact.
        """
        return w

    def reading(self, w: Any, q: Array, v: Array) -> tuple[Array, Array]:
        """q^ (n,) [rad] and v^ (n,) [rad/s], from w and from q, v (n,) as read by the sensors before it.

        Raises InputError where no class writes it.
        """
        raise InputError(
            f"{type(self).__name__} has no reading(w, q, v); write it, or take sampled(n, p, period)"
        )

    def sampled(self, n: int, p: int, period: float) -> Sensor:
        """The sensor for n coordinates, p of them joints, and ticks every `period` [s]."""
        return self

    @property
    def noisy(self) -> bool:
        """Whether the readings are random: a walk with such a sensor has no orbit, and so no return map."""
        return False

    def smooth(self) -> Sensor:
        """The same sensor without counts and noise, for a linear loop."""
        return self

    def errors(self, n: int, p: int, before: Array) -> Array:
        """Standard deviations (2 n,) [rad, rad/s] of the errors in (q, q') at every
        tick, this sensor's included.

        Errors are independent from tick to tick; counts are uniform errors. before (2 n,):
        those of the sensors before it.
        """
        return before

    def on_computer(self, before: Sensor | None) -> Sensor | None:
        """The part of the sensor that runs on the controller's computer, such as differences
        and filter; None for nothing.

        before: the part of the sensors before it. Raises InputError for a sensor that does not define it.
        """
        raise InputError(
            f"sensor {type(self).__name__} does not say what of it runs on the controller's computer; "
            "write on_computer(before)"
        )

    def __add__(self, other: Sensor) -> Sensor:
        check_part(other, f"what is added to {type(self).__name__}", Sensor)
        return Sensing((*_parts(self), *_parts(other)))


def _parts(sensor: Sensor) -> tuple[Sensor, ...]:
    """The sensors of a `Sensing`, or the sensor itself, so that a + b + c is one row of three."""
    return sensor.parts if isinstance(sensor, Sensing) else (sensor,)


@dataclass(frozen=True)
class Sensing(Sensor):
    """Several sensors, one behind the other; w is the tuple of their states."""

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
        return Sensing(tuple(part.sampled(n, p, period) for part in self.parts))

    @property
    def noisy(self) -> bool:
        return any(part.noisy for part in self.parts)

    def smooth(self) -> Sensor:
        return Sensing(tuple(part.smooth() for part in self.parts))

    def errors(self, n: int, p: int, before: Array) -> Array:
        for part in self.parts:
            before = part.errors(n, p, before)
        return before

    def on_computer(self, before: Sensor | None) -> Sensor | None:
        for part in self.parts:
            before = part.on_computer(before)
        return before
