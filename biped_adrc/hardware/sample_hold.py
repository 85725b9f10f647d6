"""The tail of a walker's state: numbers kept between ticks, behind its controller's state.

    x = (q, q', s, own, b, w, queue, u_m, waiting, u)

own are the numbers of a plant that integrates itself, b the single support that the controller assumes, w the
sensors' state. The rest are torques [N m]: those in the queue of the delay, u_m of motors with lag, the one
that waits for a fraction of a period, and u commanded to the motors now. Each part is empty where the walker
has none. Between ticks u_m alone changes.

The walker's state is one vector, since integrators, stored runs and machine code know vectors alone. Here its
tail is taken apart (`read`) and put together (`written`), and all parts are initialised and moved between
ticks; `closed_loop.semantics` moves them at a tick and an impact, where the controller acts.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from biped_adrc.core.checks import returned
from biped_adrc.core.timing import SampledTime
from biped_adrc.core.types import Array, frozen
from biped_adrc.hardware.motors import IDEAL, Line, Motors, TorqueLine, whole_and_part
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hardware.touchdown import HEAD, Belief, Touchdown, numbers_of


class HeldSizes(NamedTuple):
    """Sizes of the parts of the tail, for n coordinates and p joints."""

    n: int
    p: int
    sensors: int
    """Numbers in w."""
    queue: int
    """Torques that wait for whole periods, j of `hardware.motors`."""
    lag: int
    """1 with a lag of the motors."""
    waiting: int
    """1 with a delay that is not of whole periods."""
    rate: int
    """1 with a rate limit."""
    known: int
    """1 when the controller knows the delay."""
    own: int
    """Numbers of a plant that integrates itself."""
    belief: int
    """Numbers in b."""

    @property
    def total(self) -> int:
        """Length of the tail."""
        torques = self.queue + self.lag + self.waiting + 1
        return self.own + self.belief + self.sensors + self.p * torques


class HeldParts(NamedTuple):
    """Sensors, motors and touchdown detector of a walker at its ticks; None where it has none."""

    sensors: Sensor | None
    """The sensors, sampled for the robot and period."""
    motors: TorqueLine
    sizes: HeldSizes
    touchdown: Touchdown | None

    def sense(self, w: Array, q: Array, v: Array) -> Array:
        """State w of the sensors after a tick at q (n,) [rad], v (n,) [rad/s]."""
        return w if self.sensors is None else self.sensors.sense(w, q, v)

    def reading(self, w: Array, q: Array, v: Array) -> tuple[Array, Array]:
        """q (n,) [rad] and v (n,) [rad/s] as measured by sensors in the state w."""
        return (q, v) if self.sensors is None else self.sensors.reading(w, q, v)


class Held(NamedTuple):
    """The tail at one instant, in parts."""

    w: Array
    """State of the sensors."""
    line: Line
    """Torques on their way to the motors [N m]."""
    own: Array
    """Numbers of a plant that integrates itself."""
    b: Array
    """Belief of the controller about its single support."""


def held_parameters(
    n: int,
    p: int,
    timing: SampledTime,
    sensors: Sensor | None,
    motors: Motors | None,
    own: int,
    touchdown: Touchdown | None,
) -> HeldParts:
    """Make the sampled parts of a walker's tail, and their sizes.

    For n coordinates, p motors and the ticks of `timing`, whose delay makes the queue; own: how many
    numbers the plant keeps for itself.
    """
    motors, period = IDEAL if motors is None else motors, timing.period
    sampled = None if sensors is None else sensors.sampled(n, p, period)
    queue, fraction = whole_and_part(timing.delay, period)
    sensed = 0 if sampled is None else sampled.size
    belief = 0 if touchdown is None else HEAD + touchdown.size
    lag, waiting = int(motors.lag > 0.0), int(fraction > 0.0)
    rate = int(motors.rate_limit is not None)
    known = int(timing.delay_known and timing.delay > 0.0)
    sizes = HeldSizes(n, p, sensed, queue, lag, waiting, rate, known, own, belief)
    return frozen(HeldParts(sampled, motors.sampled(period, fraction), sizes, touchdown))


def read(k: HeldSizes, tail: Array) -> Held:
    """Split the tail (total,) of a state into its parts, as views."""
    at, parts = 0, []
    of_line = (k.queue * k.p, k.lag * k.p, k.waiting * k.p, k.p)
    for size in (k.own, k.belief, k.sensors, *of_line):
        parts.append(tail[at : at + size])
        at += size
    own, b, w, *line = parts
    return Held(w, Line(*line), own, b)


def written(held: Held) -> Array:
    """Join the parts to the tail (total,), the inverse of `read`."""
    return np.concatenate((held.own, held.b, held.w, *held.line))


def motor_torque(line: Line) -> Array:
    """Torque on the joints now (p,) [N m]: the state of lagging motors, else the command."""
    return line.u_m if len(line.u_m) > 0 else line.u


def lagged(k: HeldParts, tail: Array) -> Array:
    """Slope of the tail (total,): tau u_m' = u - u_m [N m], and zero for all else."""
    line, rate = read(k.sizes, tail).line, np.zeros(len(tail))
    if k.sizes.lag > 0:
        at = len(tail) - k.sizes.p * (k.sizes.waiting + 2)
        rate[at : at + k.sizes.p] = k.motors.speed * (line.u - line.u_m)
    return rate


def at_start(k: HeldParts, q: Array, v: Array, support: tuple[int, float]) -> Array:
    """The tail (total,) at the start of a run in q (n,), v (n,): zero torque, and a first
    measurement of the sensors.

    support: number and start [s] of the single support, which the controller knows at first.
    """
    sizes = k.sizes
    w = np.zeros(0) if k.sensors is None else _tried(k.sensors, q, v)
    b = np.zeros(0)
    if k.touchdown is not None:
        d = returned(k.touchdown.start(), (k.touchdown.size,), k.touchdown, "start")
        b = numbers_of(Belief(0.0, *support, d))
    rest = np.zeros(sizes.total - sizes.own - sizes.belief - sizes.sensors)
    return np.concatenate((np.zeros(sizes.own), b, w, rest))


def _tried(sensors: Sensor, q: Array, v: Array) -> Array:
    """Start a user's sensors and call each of their methods once; returns their state w (size,) at the start.

    Raises InputError where a method returns another shape.
    """
    size = (sensors.size,)
    w = returned(sensors.start(q, v), size, sensors, "start")
    returned(sensors.sense(frozen(w), q, v), size, sensors, "sense")
    for x in sensors.reading(frozen(w), q, v):
        returned(x, q.shape, sensors, "reading")
    return w
