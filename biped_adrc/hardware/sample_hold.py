"""What a walker holds between ticks, behind its controller's state.

    x = (q, q', s, own, b, w, queue, u_m, waiting, u)

own is what a plant that moves by itself keeps, b what the controller takes for its single support, w the
sensors' state, the rest the line of torques on their way to the motors; each is empty where the
walker has no such part. u_m alone flows.

The walker's state is one vector, since integrators, stored runs and machine code know vectors alone. Here its
tail is taken apart (`read`) and put together (`written`), and what happens to all parts at the start and
between ticks is said once; `closed_loop.semantics` does so for a tick and an impact, where the controller comes
in.
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
    """n coordinates, p joints, and what is held: numbers in w, torques in the queue, and 0 or 1."""

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
    """Numbers that the plant keeps for itself."""
    belief: int
    """Numbers in b."""

    @property
    def total(self) -> int:
        """Numbers held."""
        torques = self.queue + self.lag + self.waiting + 1
        return self.own + self.belief + self.sensors + self.p * torques


class HeldParts(NamedTuple):
    """The parts at the ticks of a walker; None where it has not one."""

    sensors: Sensor | None
    """Sampled for its robot and period."""
    motors: TorqueLine
    sizes: HeldSizes
    touchdown: Touchdown | None

    def sense(self, w: Array, q: Array, v: Array) -> Array:
        """w of the sensors after a tick at q (n,) [rad], v (n,) [rad/s]."""
        return w if self.sensors is None else self.sensors.sense(w, q, v)

    def reading(self, w: Array, q: Array, v: Array) -> tuple[Array, Array]:
        """(q, v) as the sensors in their state w show it, each (n,)."""
        return (q, v) if self.sensors is None else self.sensors.reading(w, q, v)


class Held(NamedTuple):
    """What is held at one instant, in parts."""

    w: Array
    """Of the sensors."""
    line: Line
    """Torques on their way to the motors [N m]."""
    own: Array
    """Of a plant that moves by itself."""
    b: Array
    """Of the controller's belief."""


def held_parameters(
    n: int,
    p: int,
    timing: SampledTime,
    sensors: Sensor | None,
    motors: Motors | None,
    own: int,
    touchdown: Touchdown | None,
) -> HeldParts:
    """What a walker's tail is laid out by, and the numbers of its parts.

    For n coordinates, p motors and the ticks of `timing`, whose delay makes the queue; own: how many numbers
    the plant keeps for itself.
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
    """The parts of what follows the controller's state: tail (total,), as views."""
    at, parts = 0, []
    of_line = (k.queue * k.p, k.lag * k.p, k.waiting * k.p, k.p)
    for size in (k.own, k.belief, k.sensors, *of_line):
        parts.append(tail[at : at + size])
        at += size
    own, b, w, *line = parts
    return Held(w, Line(*line), own, b)


def written(held: Held) -> Array:
    """The parts in one vector (total,), the inverse of `read`."""
    return np.concatenate((held.own, held.b, held.w, *held.line))


def motor_torque(line: Line) -> Array:
    """The torque on the joints now (p,) [N m]: of motors with lag their own, else what is asked of them."""
    return line.u_m if len(line.u_m) > 0 else line.u


def lagged(k: HeldParts, tail: Array) -> Array:
    """The slope of the tail (total,): tau u_m' = u - u_m [N m], and zero for all else."""
    line, rate = read(k.sizes, tail).line, np.zeros(len(tail))
    if k.sizes.lag > 0:
        at = len(tail) - k.sizes.p * (k.sizes.waiting + 2)
        rate[at : at + k.sizes.p] = k.motors.speed * (line.u - line.u_m)
    return rate


def at_start(k: HeldParts, q: Array, v: Array, support: tuple[int, float]) -> Array:
    """What is held (total,) at the start of a run in q (n,), v (n,): no torque, a first look of the sensors.

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
    """w (size,) of the sensors at the start; raises InputError where it, or one more sample, is no such row."""
    size = (sensors.size,)
    w = returned(sensors.start(q, v), size, sensors, "start")
    returned(sensors.sense(frozen(w), q, v), size, sensors, "sense")
    for x in sensors.reading(frozen(w), q, v):
        returned(x, q.shape, sensors, "reading")
    return w
