"""Motors, in sampled time: rate limit, delay and lag between the torque asked for and the one that acts.

    u_k in [u_(k-1) - rate T, u_(k-1) + rate T]        at the tick
    u acts from t_k + delay on                          delay = (j + f) T, 0 <= f < 1
    tau u_m' = u - u_m                                  torque of the motor

What waits to act is held: j torques in a queue, and one more until t_k + f T where f > 0. At impact all of them
are relabelled with the joints. Where the clock restarts there, a tick comes early: it may change the torque by
as much as any other, the queue moves up, and what is waiting for a fraction of a period is replaced.

The delay is the clock's, `SampledTime(period, delay)`; rate limit and lag are `Motors`. A saturation,
`Walker.torque_limit`, comes before all of this. An observer's input is the torque after the rate limit, and
where the delay is known that which acts: `mean_command`.
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
    """The torques of one instant, each (p,) [N m]; empty for what this walker has not."""

    queue: Array
    """(j p,), the oldest first."""
    u_m: Array
    """Of the motor; empty without lag."""
    waiting: Array
    """Acts from t_k + f T on."""
    u: Array
    """Asked of the motor now."""

    def relabelled(self, swap: Indices) -> Line:
        """The line after an impact; swap (p,) relabels the joints."""
        p = len(self.u)
        return Line(
            *(relabelled(x.reshape(-1, p), swap).ravel() if len(x) > 0 else x for x in self)
        )


@dataclass(frozen=True)
class TorqueLine:
    """Motors with ticks every T, and the delay's part f of a period."""

    change: float
    """The largest of torque in a period [N m], infinite without limit."""
    speed: float
    """1 / tau [1/s], 0 without lag."""
    fraction: float
    """f"""

    def limit(self, line: Line, u: Array) -> Array:
        """u (p,) [N m] within the rate limit, after the torque that was sent before it.

        That is the last of the queue, or what was asked of the motor now: what waited has acted, or never will.
        """
        p = len(line.u)
        last = line.u
        if len(line.queue) > 0:
            last = line.queue[len(line.queue) - p :]
        return np.minimum(np.maximum(u, last - self.change), last + self.change)

    def send(self, line: Line, u: Array) -> Line:
        """The line after a tick that sends u (p,) [N m]: it joins the queue's end, the first one acts."""
        queue, next_one = line.queue, u
        if len(queue) > 0:
            p = len(u)
            next_one = queue[:p]
            queue = np.concatenate((queue[p:], u))
        if len(line.waiting) > 0:
            return Line(queue, line.u_m, next_one, line.u)
        return Line(queue, line.u_m, line.waiting, next_one)

    def mean_command(self, line: Line) -> Array:
        """Mean (p,) [N m] of the torque asked of the motors until the next tick."""
        if len(line.waiting) > 0:
            return self.fraction * line.u + (1.0 - self.fraction) * line.waiting
        return line.u


@dataclass(frozen=True)
class Motors(Checked, Shown):
    """rate_limit [N m/s], None for none; lag: time constant tau [s] of the torque, 0 for none.

    The same for all motors. Raises InputError for a limit that is not positive and a lag below zero.

    >>> motors = ba.Motors(rate_limit=20000.0, lag=0.002)
    >>> timing = ba.SampledTime(1e-3)
    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=timing, motors=motors)
    >>> ba.walk(walker, gait, impacts=2).impacts
    2
    """

    rate_limit: PositiveFloat | None = None
    lag: NonNegativeFloat = 0.0

    def sampled(self, period: float, fraction: float) -> TorqueLine:
        """The line with ticks every `period` [s] and the delay's part f of a period."""
        change = math.inf if self.rate_limit is None else self.rate_limit * period
        return TorqueLine(change, 0.0 if self.lag == 0.0 else 1.0 / self.lag, fraction)


IDEAL = Motors()
"""No limit, no lag."""


def whole_and_part(delay: float, period: float) -> tuple[int, float]:
    """j and f of a delay [s] = (j + f) period [s], f = 0 where it is whole but for round-off."""
    periods = delay / period
    j = math.floor(periods + WHOLE)
    f = periods - j
    return (j, f) if f > WHOLE else (j, 0.0)
