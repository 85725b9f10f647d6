"""Motors, in sampled time: rate limit, delay and lag between the commanded torque and the one that acts.

    u_k in [u_(k-1) - rate T, u_(k-1) + rate T]        at the tick
    u acts from t_k + delay on                          delay = (j + f) T, 0 <= f < 1
    tau u_m' = u - u_m                                  torque of the motor

Torques that do not act yet are stored: j of them in a queue, and one more until t_k + f T where f > 0. At
impact all of them are relabelled with the joints. Where the clock restarts there, a tick comes early: it may
change the torque by as much as any other, the queue moves up, and the torque that waits for a fraction of a
period is replaced.

The delay is the clock's, `SampledTime(period, delay)`; rate limit and lag are `Motors`. A saturation,
`Walker.torque_limit`, comes before all of this. An observer's input is the torque after the rate limit, and
with a known delay the mean of the torque that acts in the period: `mean_command`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.core.checks import Checked, NonNegativeFloat, PositiveFloat
from biped_adrc.core.shown import Shown
from biped_adrc.core.timing import WHOLE
from biped_adrc.core.types import Array, Indices, relabelled


class Line(NamedTuple):
    """The torques on their way to the motors at one instant, each (p,) [N m]; empty where
    the walker has no such part.
    """

    queue: Array
    """Torques that wait for whole periods (j p,), the oldest first."""
    u_m: Array
    """Torque of the motors; empty without lag."""
    waiting: Array
    """Torque that acts from t_k + f T on."""
    u: Array
    """Torque commanded to the motors now."""

    @property
    def sent(self) -> Array:
        """The torque sent last: the end of the queue, else the one that waits, else the one that acts."""
        if len(self.queue) > 0:
            return self.queue[len(self.queue) - len(self.u) :]
        return self.waiting if len(self.waiting) > 0 else self.u

    def relabelled(self, swap: Indices) -> Line:
        """The torques after an impact; swap (p,): the relabelling of the joints."""
        p = len(self.u)
        return Line(
            *(relabelled(x.reshape(-1, p), swap).ravel() if len(x) > 0 else x for x in self)
        )


@dataclass(frozen=True)
class TorqueLine:
    """Rate limit, lag and fractional delay of the motors, for ticks every T."""

    change: float
    """Largest change of the torque in a period [N m], infinite without limit."""
    speed: float
    """1 / tau [1/s], 0 without lag."""
    fraction: float
    """Fraction f of a period in the delay."""

    def limit(self, line: Line, u: Array) -> Array:
        """u (p,) [N m] within the rate limit, relative to the torque that was sent before it.

        That is the last of the queue, or the command to the motors now: the waiting torque has
        acted already, or never will.
        """
        p = len(line.u)
        last = line.u
        if len(line.queue) > 0:
            last = line.queue[len(line.queue) - p :]
        return np.minimum(np.maximum(u, last - self.change), last + self.change)

    def send(self, line: Line, u: Array) -> Line:
        """The line after a tick that sends u (p,) [N m]: u joins the end of the queue,
        and its first torque acts.
        """
        queue, next_one = line.queue, u
        if len(queue) > 0:
            p = len(u)
            next_one = queue[:p]
            queue = np.concatenate((queue[p:], u))
        if len(line.waiting) > 0:
            return Line(queue, line.u_m, next_one, line.u)
        return Line(queue, line.u_m, line.waiting, next_one)

    def mean_command(self, line: Line) -> Array:
        """Mean (p,) [N m] of the torque commanded to the motors from this tick until the next."""
        if len(line.waiting) > 0:
            return self.fraction * line.u + (1.0 - self.fraction) * line.waiting
        return line.u


@dataclass(frozen=True)
class Motors(Checked, Shown):
    """Motors that are all alike: rate_limit [N m/s], None for none; lag: time constant tau [s], 0 for none.

    Raises InputError for a limit that is not positive and a lag below zero.

    >>> motors = ba.Motors(rate_limit=20000.0, lag=0.002)
    >>> timing = ba.SampledTime(1e-3)
    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=timing, motors=motors)
    >>> ba.walk(walker, gait, impacts=2).impacts
    2
    """

    rate_limit: PositiveFloat | None = None
    lag: NonNegativeFloat = 0.0

    def sampled(self, period: float, fraction: float) -> TorqueLine:
        """The motors for ticks every `period` [s], with the fraction f of a period in the delay."""
        change = math.inf if self.rate_limit is None else self.rate_limit * period
        return TorqueLine(change, 0.0 if self.lag == 0.0 else 1.0 / self.lag, fraction)


IDEAL = Motors()
"""Motors without limit and lag."""


def whole_and_part(delay: float, period: float) -> tuple[int, float]:
    """Split a delay [s] = (j + f) period [s] into j and f; f = 0 where it is whole up to round-off."""
    periods = delay / period
    j = math.floor(periods + WHOLE)
    f = periods - j
    return (j, f) if f > WHOLE else (j, 0.0)
