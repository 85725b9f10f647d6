"""When the controller acts: at every instant, or at ticks."""

from __future__ import annotations

import math
from dataclasses import dataclass

from biped_adrc.errors import InputError
from biped_adrc.parts import check_fields

LONGEST_PERIOD = 0.1
"""[s]. A body whose hip is l = 0.8 m high falls over its foot in sqrt(l / g) = 0.29 s: a torque that is held
for more than a third of that is no feedback, and a longer period a mistake of units."""
LONGEST_DELAY = 100
"""Periods; more torques on their way than this are a mistake of units."""


@dataclass(frozen=True)
class ContinuousTime:
    """The controller acts at every instant."""


@dataclass(frozen=True)
class SampledTime:
    """The controller acts at ticks every `period` [s] and its torque is held in between.

    restart: the clock restarts at impact. A free-running clock makes the return map depend on its phase, and a
    discrete observer takes what it is reset to at impact for its prediction of the next tick.
    delay [s]: from a tick to the instant at which its torque begins to act, for the computation. A clock that
    restarts at impact ticks there early; what is on its way is then up to one period sooner.
    delay_known: the controller's observer is fed with the torque that acts until the next tick, instead of the
    one just asked for. Raises InputError for a period that is not positive or longer than `LONGEST_PERIOD`, and
    for a delay that is negative.
    """

    period: float
    restart: bool = True
    delay: float = 0.0
    delay_known: bool = False

    def __post_init__(self) -> None:
        check_fields(self)
        if not (math.isfinite(self.period) and 0.0 < self.period <= LONGEST_PERIOD):
            raise InputError(
                f"the sampling period is {self.period} s, expected a positive number, at most "
                f"{LONGEST_PERIOD} s"
            )
        if not 0.0 <= self.delay <= LONGEST_DELAY * self.period:
            raise InputError(
                f"the computation delay is {self.delay} s, expected 0 to {LONGEST_DELAY} periods of "
                f"{self.period} s"
            )


def check_timing(timing: object) -> None:
    """Raise InputError for what is no timing, such as a period alone."""
    if isinstance(timing, ContinuousTime | SampledTime):
        return
    number = isinstance(timing, int | float) and not isinstance(timing, bool)
    meant = f"SampledTime({timing:g})" if number else "SampledTime(period)"
    raise InputError(f"timing is {timing!r}, expected {meant} or ContinuousTime()")


def check_ends(max_step_time: float, fall_height: float) -> None:
    """Raise InputError for a longest single support [s] or a height of a fall that are none, NaN among them."""
    if not (max_step_time > 0.0 and fall_height < 1.0):
        raise InputError(
            f"max_step_time is {max_step_time} s and fall_height {fall_height}, expected a positive time and a "
            "share of the height, below 1"
        )
