"""Motors, in sampled time: rate limit, delay and lag between the commanded torque and the one that acts.

    u_k in [u_(k-1) - rate T, u_(k-1) + rate T]        at the tick
    u acts from t_k + delay on                          delay = (j + f) T, 0 <= f < 1
    tau u_m' = u - u_m                                  torque of the motor

Torques that do not act yet are stored: j of them in a queue, and one more until t_k + f T where f > 0. At
impact all of them are relabelled with the joints. Where the clock restarts at the impact, a tick comes early,
and is treated as a full period: the rate limit allows a change of rate T, the queue moves up by one, and a
torque that still waits for a fraction of a period is replaced.

The delay is the clock's, `SampledTime(period, delay)`; rate limit and lag are `Motors`. A saturation,
`Walker.torque_limit`, comes before all of this. An observer's input is the torque after the rate limit, and
with a known delay the mean of the torque that acts in the period: `mean_command`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.core.checks import Checked, NonNegativeFloat, PositiveFloat
from biped_adrc.core.shown import Shown
from biped_adrc.core.timing import WHOLE
from biped_adrc.core.types import Array, Indices, relabelled


class Line(NamedTuple):
    """The torques on their way to the motors at one instant, each (p,) or (.., p) [N m].

    None where the walker has no such part.
    """

    queue: Array
    """Torques that wait for whole periods (j, p), the oldest first."""
    u_m: Array | None
    """Torque of the motors; None without lag."""
    waiting: Array | None
    """Torque that acts from t_k + f T on."""
    u: Array
    """Torque commanded to the motors now."""

    @property
    def sent(self) -> Array:
        """The torque sent last: the end of the queue, else the one that waits, else the one that acts."""
        if self.queue.shape[-2] > 0:
            return self.queue[..., -1, :]
        return self.u if self.waiting is None else self.waiting

    def relabelled(self, swap: Indices) -> Line:
        """The torques after an impact; swap (p,): the relabelling of the joints."""
        each: Any = (x if x is None else relabelled(x, swap) for x in self)
        return Line(*each)


@dataclass(frozen=True)
class TorqueLine:
    """Rate limit, lag and fractional delay of the motors, for ticks every T."""

    change: float | None
    """Largest change of the torque in a period [N m], None without limit."""
    speed: float
    """1 / tau [1/s], 0 without lag."""
    fraction: float
    """Fraction f of a period in the delay."""

    def limit(self, line: Line, u: Array) -> Array:
        """Bound u (p,) [N m] so that it differs by at most `change` from the torque sent one tick before.

        That torque is the last one of the queue. Without a queue it is the command to the motors now, as a
        torque that waited for a fraction of a period has begun to act by the next tick.
        """
        if self.change is None:
            return u
        last = line.queue[-1] if len(line.queue) > 0 else line.u
        return np.minimum(np.maximum(u, last - self.change), last + self.change)

    def send(self, line: Line, u: Array) -> Line:
        """The line after a tick that sends u (p,) [N m]: u joins the end of the queue,
        and its first torque acts.
        """
        queue, next_one = line.queue, u
        if len(queue) > 0:
            next_one = queue[0]
            queue = np.concatenate((queue[1:], u[np.newaxis]))
        if line.waiting is not None:  # it replaces u later in the period, by `semantics.release`
            return Line(queue, line.u_m, next_one, line.u)
        return Line(queue, line.u_m, None, next_one)

    def mean_command(self, line: Line) -> Array:
        """Mean (p,) [N m] of the torque commanded to the motors from this tick until the next."""
        if line.waiting is not None:
            return self.fraction * line.u + (1.0 - self.fraction) * line.waiting
        return line.u


@dataclass(frozen=True)
class Motors(Checked, Shown):
    """Motors that are all alike.

    rate_limit [N m/s]: of the torque; None: no limit. lag [s]: time constant tau of the torque; 0: no lag.
    Raises InputError for a limit that is not positive and a lag below zero.

    >>> motors = ba.Motors(rate_limit=20000.0, lag=0.002)
    >>> timing = ba.SampledTime(1e-3)
    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=timing, motors=motors)
    >>> ba.walk(walker, gait, impacts=2).impacts
    2
    """

    rate_limit: PositiveFloat | None = None
    lag: NonNegativeFloat = 0.0

    def sampled(self, p: int, delay: float, period: float) -> tuple[TorqueLine, Line]:
        """The p motors for ticks every `period` T [s], and their line with all torques zero.

        delay [s]: (j + f) T, from a tick until its torque acts.
        """
        (j, fraction), none = whole_and_part(delay, period), np.zeros(p)
        change = None if self.rate_limit is None else self.rate_limit * period
        drive = TorqueLine(change, 0.0 if self.lag == 0.0 else 1.0 / self.lag, fraction)
        u_m, waiting = none if self.lag > 0.0 else None, none if fraction > 0.0 else None
        return drive, Line(np.zeros((j, p)), u_m, waiting, none)


IDEAL = Motors()
"""Motors without limit and lag."""


def whole_and_part(delay: float, period: float) -> tuple[int, float]:
    """Split a delay [s] = (j + f) period [s] into j and f; f = 0 where it is whole up to round-off."""
    periods = delay / period
    j = math.floor(periods + WHOLE)
    f = periods - j
    return (j, f) if f > WHOLE else (j, 0.0)
