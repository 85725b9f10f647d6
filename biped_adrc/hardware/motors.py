"""Motors, in sampled time: rate limit, delay and lag between the commanded torque and the one that acts.

    u_k in [u_(k-1) - rate T, u_(k-1) + rate T]        at the tick
    u acts from t_k + delay on                          delay = (j + f) T, 0 <= f < 1
    tau u_m' = u - u_m                                  torque of the motor

T is the sampling period, t_k = k T the tick (sample instant), u_k the torque that the controller sends there.

Torques that do not act yet are stored: j of them in a queue, and one more until t_k + f T where f > 0. At an
impact the legs exchange their roles, and so do the entries of all these torques (relabelling). Where the clock
restarts at the impact, a tick comes early, and is treated as a full period: the rate limit allows a change of
rate T, the queue moves up by one, and a torque that still waits for a fraction of a period is replaced.

The delay is the clock's, `SampledTime(period, delay)`; rate limit and lag are `Motors`. A saturation,
`Walker.torque_limit`, comes before all of this. An observer's input is the torque after the rate limit, and
with a known delay the mean of the torque that acts in the period: `mean_command`.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np

from biped_adrc.core.checks import Checked, NonNegativeFloat, PositiveFloat
from biped_adrc.core.shown import Shown
from biped_adrc.core.timing import WHOLE
from biped_adrc.core.types import Array, Indices, relabelled


class Line(NamedTuple):
    """The torques on their way to the motors at one instant, each (p,) or (.., p) [N m].

    p motors; leading axes are instants. A field is None where the walker has no such part.
    """

    queue: Array
    """Torques that wait for whole periods (j, p), the oldest first."""
    u_m: Array | None
    """Torque that lagging motors produce now; None without lag."""
    waiting: Array | None
    """Torque that replaces u at t_k + f T; None where the delay is a whole number of periods."""
    u: Array
    """Torque that is commanded to the motors now, after the delay."""

    @property
    def sent(self) -> Array:
        """The torque that the controller sent at its last tick: the end of the queue, without a queue the
        waiting one, without either u.
        """
        if self.queue.shape[-2] > 0:
            return self.queue[..., -1, :]
        return self.u if self.waiting is None else self.waiting

    def relabelled(self, swap: Indices) -> Self:
        """The torques after an impact; swap (p,): motor i gets entry swap[i] of (torque, -torque)."""
        # `relabelled` in the next line is the function for one array, None stays None
        return type(self)._make(x if x is None else relabelled(x, swap) for x in self)


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

        line: the torques just before this tick. The torque sent one tick before is the last one of the queue.
        Without a queue it is line.u, also after a delay of a fraction of a period, which has ended by now.
        """
        if self.change is None:
            return u
        last = line.queue[-1] if len(line.queue) > 0 else line.u
        return np.minimum(np.maximum(u, last - self.change), last + self.change)

    def send(self, line: Line, u: Array) -> Line:
        """The torques on their way after a tick that sends u (p,) [N m], from those before it (line): u joins
        the end of the queue, and the first torque leaves it; without a queue that is u itself.

        The torque that leaves acts at once, or waits for the fraction of the delay while the old one acts on.
        """
        queue = np.concatenate((line.queue, u[np.newaxis]))
        next_one, queue = queue[0], queue[1:]
        # `closed_loop.semantics.release` puts the waiting torque in place of u at t_k + f T
        if line.waiting is not None:
            return Line(queue, line.u_m, next_one, line.u)
        return Line(queue, line.u_m, None, next_one)

    def mean_command(self, line: Line) -> Array:
        """Mean (p,) [N m] of the command to the motors from this tick to the next; line: as `send` returns it.

        line.u acts for the fraction f of the period, line.waiting for the rest. The lag does not enter.
        """
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
        """The p motors for ticks every `period` T [s], and the torques on their way (`Line`) at the start of a
        run, all zero.

        delay [s]: (j + f) T, from a tick until its torque acts. None marks what these motors do not have.
        """
        # none: torques of zero; j: whole periods in the delay
        (j, fraction), none = whole_and_part(delay, period), np.zeros(p)
        change = None if self.rate_limit is None else self.rate_limit * period
        drive = TorqueLine(change, 0.0 if self.lag == 0.0 else 1.0 / self.lag, fraction)
        u_m, waiting = none if self.lag > 0.0 else None, none if fraction > 0.0 else None
        return drive, Line(np.zeros((j, p)), u_m, waiting, none)


IDEAL = Motors()
"""Motors without limit and lag."""


def whole_and_part(delay: float, period: float) -> tuple[int, float]:
    """Split a delay [s] = (j + f) period [s] into whole periods j and the fraction f, 0 <= f < 1.

    f is exactly 0 where the delay is a whole number of periods up to round-off (`WHOLE`, in periods).
    """
    periods = delay / period
    j = math.floor(periods + WHOLE)
    f = periods - j
    return (j, f) if f > WHOLE else (j, 0.0)
