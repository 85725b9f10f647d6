"""The tail of a walker's state: numbers kept between ticks, behind its controller's state.

    x = (q, q', s, tail),   tail = (own, belief, sensors, line)

s is the controller's state. own are the numbers of a plant that integrates itself, as an engine with contact
does, belief the single support that the controller assumes, sensors the state w of the sensors, and line the
torques on their way to the motors (`hardware.motors`). A part is empty, or None, where the walker has none. A
tick is a sample instant. Between ticks nothing but `line` changes: the torque of lagging motors, and the
commanded torque u, where a delay ends within the period.

`HeldParts` initialises the tail; `closed_loop.semantics` moves it at a tick and an impact, where the controller
acts.
"""

from typing import Any, NamedTuple

import numpy as np

from biped_adrc.core.tree import Layout, returned_tree
from biped_adrc.core.types import Array
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
    """Whether the controller knows the delay: its observer then gets the torque that acts, not the one sent."""
    own: int
    """How many numbers a plant that integrates itself keeps for its own use; 0 for others."""
    line: Layout
    """Layout of a `Line`: which place of a flat vector belongs to which torque."""

    def sense(self, w: Any, q: Array, v: Array) -> Any:
        """State w of the sensors after a tick at true q (n,) [rad], v (n,) [rad/s]; None without sensors."""
        return w if self.sensors is None else self.sensors.sense(w, q, v)

    def reading(self, w: Any, q: Array, v: Array) -> tuple[Array, Array]:
        """q (n,) [rad], v (n,) [rad/s] as sensors in the state w measure them; q, v without sensors."""
        return (q, v) if self.sensors is None else self.sensors.reading(w, q, v)

    def start(self, q: Array, v: Array, step: float, start: float) -> Tail:
        """The tail at the start of a run in q (n,) [rad], v (n,) [rad/s]: all torques 0, sensors at (q, v).

        step: number of the first single support, start [s]: time at which it began; a controller that detects
        touchdowns itself believes in these at first. `own` is 0 here: the plant fills it in.
        """
        # states are checked, since they may be a user's; None: every structure of arrays is right
        sensors, belief, touchdown = self.sensors, None, self.touchdown
        w = None if sensors is None else returned_tree(sensors.start(q, v), None, sensors, "start")
        if touchdown is not None:
            d = returned_tree(touchdown.start(), None, touchdown, "start")
            belief = Belief(0.0, float(step), float(start), d)  # 0: its names of the legs are right
        # the last one is a `Line` of zeros
        return Tail(np.zeros(self.own), belief, w, self.line.tree(np.zeros(self.line.size)))


def motor_torque(line: Line) -> Array:
    """Torque on the joints now (p,) [N m]: u_m of motors with a lag, else the command u."""
    return line.u if line.u_m is None else line.u_m
