"""What a sensor is: a state w that ticks and impacts change, and what it makes of (q, q') for the controller.

    w <- sense(k, w, q, v)                      at a tick at (q, v)
    w <- impact(k, w, q, v, v_model)            after an impact to (q, v)
    (q^, v^) = seen(k, w, q, v)                 (q, v) as the sensors before it see them

`a + b` puts b behind a: both sense the true (q, v), and b changes what a lets through.

Sensors work in sampled time: between ticks the controller sees what was read at the last one. A leaf gives
`laws` for a robot and a period, pure functions that run in both engines, and `start`; randomness is a part of
w, so that a walk is repeated by its seed. `closed_loop.walker` calls them through `hardware.sample_hold`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.parts import Checked, check_part
from biped_adrc.types import Array

Sight = tuple[Array, Array]
"""q^ (n,) [rad] and v^ (n,) [rad/s]."""


class SensorLaws(NamedTuple):
    """The pure functions of a sensor for one robot and period, and how many numbers w (size,) has."""

    parameters: object
    """k, a NamedTuple of numbers and float64 arrays."""
    size: int
    sense: Callable[..., Array]
    """sense(k, w, q, v) -> w at a tick."""
    impact: Callable[..., Array]
    """impact(k, w, q, v, v_model) -> w; v_model (n,) is v^ taken through the nominal model's impact."""
    seen: Callable[..., Sight]
    """seen(k, w, q, v) -> q^, v^."""

    def traced(self, trace: Callable[[Callable[..., Any]], Callable[..., Any]]) -> SensorLaws:
        """With other functions in place of these: those that the engine traces into machine code."""
        return SensorLaws(*self[:2], *map(trace, self[2:]))


class Sensor(Checked, ABC):
    """Base of all sensors: frozen parameters, with laws for a robot and a period."""

    @abstractmethod
    def laws(self, n: int, p: int, period: float) -> SensorLaws:
        """For n coordinates, p of them joints, and ticks every `period` [s]."""

    @abstractmethod
    def start(self, k: Any, q: Array, v: Array) -> Array:
        """w (size,) at the start of a run in q (n,) [rad], v (n,) [rad/s], for the parameters k of its laws."""

    @property
    def noisy(self) -> bool:
        """Whether anything is random: a walk with it has no orbit, and so no return map."""
        return False

    def smooth(self) -> Sensor:
        """The same sensor without counts and noise, which a linear loop takes in its place."""
        return self

    def errors(self, n: int, p: int, before: Array) -> Array:
        """Standard deviations (2 n,) [rad, rad/s] of what this sensor adds to (q, q') at every tick,
        independent from tick to tick; counts as errors spread evenly. before: of the sensors before it.
        """
        return before

    def on_computer(self, before: Sensor | None) -> Sensor | None:
        """What the controller's computer does with the readings, such as differences and filter, behind
        `before`; None for nothing. Raises InputError for a sensor that does not say.
        """
        raise InputError(
            f"sensor {type(self).__name__} does not say what of it runs on the controller's computer; "
            "write on_computer(before)"
        )

    def __add__(self, other: Sensor) -> Sensor:
        check_part(other, f"what is added to {type(self).__name__}", Sensor)
        return Sensing((*_parts(self), *_parts(other)))


def _parts(sensor: Sensor) -> tuple[Sensor, ...]:
    """Those of several sensors, or the sensor itself, so that a + b + c is one row of three."""
    return sensor.parts if isinstance(sensor, Sensing) else (sensor,)


@dataclass(frozen=True)
class Sensing(Sensor):
    """Several sensors, one behind the other; w has their states one after the other."""

    parts: tuple[Sensor, ...]

    def laws(self, n: int, p: int, period: float) -> SensorLaws:
        """Those of all parts in one, for n coordinates, p joints and `period` [s]."""
        laws = tuple(part.laws(n, p, period) for part in self.parts)
        functions = _chained(tuple(law._replace(parameters=None) for law in laws))
        return functions._replace(parameters=tuple(law.parameters for law in laws))

    def start(self, k: tuple[object, ...], q: Array, v: Array) -> Array:
        each = zip(self.parts, k, strict=True)
        return np.concatenate([part.start(own, q, v) for part, own in each])

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


@lru_cache(maxsize=64)
def _chained(laws: tuple[SensorLaws, ...]) -> SensorLaws:
    """The laws of sensors one behind the other, without parameters; theirs are a tuple k of all parameters.

    Cached, so that two walks with the same kinds of sensors have the same functions and one machine code.
    """
    ends = [sum(law.size for law in laws[: i + 1]) for i in range(len(laws))]
    places = [(end - law.size, end) for end, law in zip(ends, laws, strict=True)]
    sensed = [law.sense for law in laws]
    jumped = [law.impact for law in laws]
    sights = [law.seen for law in laws]
    count = range(len(laws))

    def each(w: Array) -> Iterator[Array]:
        """The state of each sensor, as a part of w."""
        for first, end in places:
            yield w[first:end]

    def sense(k: tuple[object, ...], w: Array, q: Array, v: Array) -> Array:
        own = list(each(w))
        return np.concatenate([sensed[i](k[i], own[i], q, v) for i in count])

    def impact(k: tuple[object, ...], w: Array, q: Array, v: Array, v_model: Array) -> Array:
        own = list(each(w))
        return np.concatenate([jumped[i](k[i], own[i], q, v, v_model) for i in count])

    def seen(k: tuple[object, ...], w: Array, q: Array, v: Array) -> Sight:
        own = list(each(w))
        for i in count:
            q, v = sights[i](k[i], own[i], q, v)
        return q, v

    return SensorLaws(None, ends[-1], sense, impact, seen)
