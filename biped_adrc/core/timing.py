"""Time base of the controller: continuous, or sampled with a zero-order hold.

`ContinuousTime` is the paper's setting: torque is a function of the state at every stage of the integrator.
`SampledTime` is a computer: it measures at sample instants (ticks), its torque begins to act after a
computation delay and is then held until the next one arrives. Timing is a field of `Walker` (robot,
controller and clock); classes of `control` and `observers` have methods for either base.
"""

from dataclasses import dataclass
from typing import Annotated

from biped_adrc.core.checks import Checked, Range
from biped_adrc.core.errors import InputError

LEAST_PERIOD, LONGEST_PERIOD = 1e-9, 0.1
"""Least and largest sampling period [s]: shorter ones could not be counted exactly in floats; a longer one is
too long for a body with the hip 0.8 m high, which falls with the time constant sqrt(l / g) = 0.29 s."""
LONGEST_DELAY = 100
"""Largest computation delay accepted, in periods; a longer one is a mistake of units."""
WHOLE = 1e-9
"""Tolerance, as a fraction of a period, with which a delay counts as a whole number of periods."""
SAME_INSTANT = 1e-9
"""Times that differ by less are the same instant up to round-off [s], in both engines."""
_WORDS = f"at least {LEAST_PERIOD} s, at most {LONGEST_PERIOD} s"
_PERIODS = Range(_WORDS, lambda T: LEAST_PERIOD <= T <= LONGEST_PERIOD)


@dataclass(frozen=True)
class ContinuousTime:
    """The controller acts at every instant: u(t) is a function of the state at t, without sampling or delay.

    >>> ba.Walker(biped, ba.NPDController(gait.constraint), timing=ba.ContinuousTime()).sampled
    False
    """


@dataclass(frozen=True)
class SampledTime(Checked):
    """The controller acts at sample instants every `period` [s], and its torque is held in between.

    period [s]: time between two sample instants.
    restart: the sampling clock restarts at impact. A free-running clock makes the return map depend
    on the phase of the clock at impact, so it has no fixed point in general. With a restart, a
    discrete observer takes the state to which it is reset at impact for its prediction of the next
    sample instant.
    delay [s]: from a sample instant to the instant at which its torque begins to act, the time of
    computation. It may be longer than a period. A clock that restarts at impact has a sample instant
    at the impact, before the next regular one; torque that is on its way then acts up to one period sooner.
    delay_known: the controller's observer is fed with the torque that acts until the next sample
    instant (known delay), instead of the one just computed, as if that acted at once (unknown delay).

    Raises InputError for a period shorter than `LEAST_PERIOD` or longer than `LONGEST_PERIOD`, and for a
    delay that is negative or longer than `LONGEST_DELAY` periods.

    >>> timing = ba.SampledTime(1e-3, delay=0.5e-3, delay_known=True)
    >>> ba.Walker(biped, ba.NPDController(gait.constraint), timing=timing).sampled
    True
    """

    SUCH_AS = "SampledTime(1e-3)"

    period: Annotated[float, _PERIODS]
    restart: bool = True
    delay: float = 0.0
    delay_known: bool = False

    def __post_init__(self) -> None:
        if not 0.0 <= self.delay <= LONGEST_DELAY * self.period:
            raise InputError(f"the delay is {self.delay} s, expected 0 to {LONGEST_DELAY} periods")


def check_ends(max_step_time: float, fall_height: float, speed: float, torque: float) -> None:
    """Raise InputError for limits with which a run has no end or ends at once: NaN, numbers that are not
    positive, a height of 1 or more.

    max_step_time [s]: the longest single support before the walk counts as stalled. fall_height [1]: the robot
    counts as fallen when its hip is lower than this fraction of the distance from stance foot to hip at q = 0.
    speed [1], torque [1]: a run ends beyond so many times 50 rad/s, or the robot's peak torque; infinite for no
    end.
    """
    if not (max_step_time > 0.0 and fall_height < 1.0 and speed > 0.0 and torque > 0.0):
        raise InputError(
            f"max_step_time is {max_step_time} s, fall_height {fall_height}, runaway_speed is {speed} and "
            f"runaway_torque {torque}, expected a share below 1 of the height, and else positive numbers"
        )
