"""The tail of a walker's state: numbers kept between ticks, behind its controller's state.

    x = (q, q', s, tail),   tail = (own, belief, sensors, line)

own are the numbers of a plant that integrates itself, belief the single support that the controller assumes,
sensors the state w of the sensors, and line the torques on their way to the motors (`hardware.motors`). A part
is empty, or None, where the walker has none. Between ticks `line` changes alone: the torque of lagging motors,
and the torque that is asked for, u, where a delay ends within the period.

`HeldParts` initialises the tail; `closed_loop.semantics` moves it at a tick and an impact, where the controller
acts.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from biped_adrc.core.tree import Layout, returned_tree
from biped_adrc.core.types import Array, frozen
from biped_adrc.hardware.motors import Line, TorqueLine
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hardware.touchdown import Belief, Touchdown


class Tail(NamedTuple):
    """The tail at one instant."""

    own: Array
    """Numbers of a plant that integrates itself (k,)."""
    belief: Belief | None
    """What the controller assumes about its single support; None where it knows touchdowns at once."""
    sensors: Any
    """State w of the sensors; None without sensors."""
    line: Line
    """Torques on their way to the motors [N m]."""


class HeldParts(NamedTuple):
    """Sensors, motors and touchdown detector of a walker at its ticks; None where it has none."""

    sensors: Sensor | None
    """The sensors in their form for this robot and period."""
    motors: TorqueLine
    """Rate limit, lag and fractional delay of the motors."""
    touchdown: Touchdown | None
    """The detector; None where the controller knows touchdowns at once."""
    known: bool
    """Whether the controller knows the delay."""
    own: int
    """How many numbers a plant that integrates itself keeps for its own use."""
    line: Layout
    """Layout of the torques on their way."""

    def sense(self, w: Any, q: Array, v: Array) -> Any:
        """State w of the sensors after a tick at q (n,) [rad], v (n,) [rad/s]."""
        return w if self.sensors is None else self.sensors.sense(w, q, v)

    def reading(self, w: Any, q: Array, v: Array) -> tuple[Array, Array]:
        """q (n,) [rad] and v (n,) [rad/s] as measured by sensors in the state w."""
        return (q, v) if self.sensors is None else self.sensors.reading(w, q, v)

    def start(self, q: Array, v: Array, step: float, start: float) -> Tail:
        """The tail at the start of a run in q (n,), v (n,): no torque, and a first measurement.

        step, start [s]: number and start of the single support, which the controller knows at first.
        """
        w = None if self.sensors is None else _tried(self.sensors, q, v)
        belief, touchdown = None, self.touchdown
        if touchdown is not None:
            d = returned_tree(touchdown.start(), None, touchdown, "start")
            belief = Belief(0.0, float(step), float(start), d)
        return Tail(np.zeros(self.own), belief, w, self.line.tree(np.zeros(self.line.size)))


def motor_torque(line: Line) -> Array:
    """Torque on the joints now (p,) [N m]: the state of lagging motors, else the command."""
    return line.u if line.u_m is None else line.u_m


def _tried(sensors: Sensor, q: Array, v: Array) -> Any:
    """Start a user's sensors and call each of their methods once; returns their state w at the start.

    Raises InputError where `sense` returns a state of another class or shape than `start`, or `reading` other
    shapes than those of q and v.
    """
    w = returned_tree(sensors.start(q, v), None, sensors, "start")
    returned_tree(sensors.sense(frozen(w), q, v), Layout.of(w), sensors, "sense")
    for x in sensors.reading(frozen(w), q, v):
        returned_tree(x, Layout.of(q), sensors, "reading")
    return w
