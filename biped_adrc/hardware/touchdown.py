"""Touchdown detectors: a touchdown may be detected late, early, not at all, or where there was none.

    d <- touchdown(d, other, t)               at a true touchdown
    (d, fires) = notice(d, look)              at a tick, fires 0 or 1

Without such a part a controller, its observer and the labels of its measurement change at the true touchdown.
With one they change at the tick (sample instant) at which `notice` fires, and the controller's assumption until
then, its belief, is a part of the walker's state:

    belief = (other, step, start, d)       other: 1 where its legs have the labels of the other foot, else 0

The labels say which leg is the stance leg: angles, torques and feet are numbered by them. A touchdown changes
the plant's labels, a detection the controller's; so each toggles `other`, and other = 1 means that they differ.
So a detection before its touchdown is an early one. A touchdown that is not detected before the following
touchdown leaves the labels right again, and the controller counts two walking steps less than there were. Both
engines (Python, and the compiler on symbols) run these methods, which are pure functions; randomness is a part
of d.

`FaultyTouchdown` knows the true touchdown and makes errors: it fires at the first tick at t >= t_touchdown +
late, with probability 1 - missed; its state d is a `Due`.

The others use the swing foot: its place (x, z) from the stance foot by the measured angles, or the vertical
force F on it. Both have a gate on the phase, that is on how far the swing foot is ahead:

    ByKinematics   z + tan(slope) x < height, and lower than at the tick before
    ByForce        free: F < off; then loaded: F > on, until F < off; detected after debounce and delay

A state d consists of floats, 1.0 for yes and 0.0 for no, and `1.0 * (..) * (..)` stands for `and`: the engine
runs the same lines on symbols, where an `if` cannot be. SAME_INSTANT [s] is the round-off of times.
"""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np

from biped_adrc.core.checks import Checked, FiniteFloat, NonNegativeFloat, NonNegativeInt, Range
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import derived, setup
from biped_adrc.core.shown import Shown
from biped_adrc.core.timing import SAME_INSTANT
from biped_adrc.core.types import Array
from biped_adrc.hardware.sensors import seeded, uniforms


class Belief(NamedTuple):
    """The controller's assumption about the present single support."""

    other: float
    """1 where its labels differ from the plant's, else 0."""
    step: float
    """Number of the single support: that of the first one plus the number of detections."""
    start: float
    """Time of the last detection [s]; at first the start of the first single support."""
    d: Any
    """State d of the detector."""


class Look(NamedTuple):
    """The quantities that a detector may use at a tick."""

    t: float
    """Time [s]."""
    t_step: float
    """Time since the last detection [s]."""
    foot: Array
    """The controller's swing foot (x, z) from its stance foot (2,) [m], by its model at the measured angles."""
    force: float
    """Vertical force of the ground on the controller's swing foot [N]; 0 unless `needs_force`."""
    other: float
    """1 where the controller's labels differ from the plant's, else 0. No real detector could know it, nor the
    next two: they serve detectors such as `FaultyTouchdown`, which makes errors on purpose."""
    step: float
    """Number of the plant's single support, from 1."""
    age: float
    """Time since the last true touchdown [s]."""


class Touchdown(Checked, ABC):
    """Base of all touchdown detectors: write `notice`, and `start` for a detector with a memory.

    >>> @dataclass(frozen=True)
    ... class Low(ba.Touchdown):
    ...     height: float  # [m]
    ...
    ...     def notice(self, d, look):
    ...         return d, 1.0 * (look.t_step > 0.2) * (look.foot[1] < self.height)
    >>> timing = ba.SampledTime(1e-3, restart=False)
    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=timing, touchdown=Low(0.001))
    >>> ba.walk(walker, gait, impacts=2).impacts
    2
    """

    needs_force: ClassVar[bool] = False
    """Whether `Look.force` is needed."""

    def start(self) -> Any:
        """State d at the start of a run; () without a memory."""
        return ()

    def touchdown(self, d: Any, other: float, t: float) -> Any:
        """State d after a true touchdown at t [s]; other: 1 where labels of controller and plant now differ."""
        return d

    @abstractmethod
    def notice(self, d: Any, look: Look) -> tuple[Any, float]:
        """State d after a tick, and 1 where the detector fires (a touchdown is detected), else 0.

        look: what may be known at this tick.
        """


STEP_AND_TIME = Range(
    "a step and a time in it [s], such as (2, 0.3)",
    lambda x: len(x) == 2 and isinstance(x[0], int) and x[0] >= 1 and 0.0 <= x[1] < math.inf,
)


class Due(NamedTuple):
    """State of a `FaultyTouchdown`."""

    waits: float
    """1 while a touchdown waits to be detected, else 0."""
    due: float
    """Time from which it is detected [s]."""
    done: float
    """1 once the false detection has happened, and where none is planned; else 0."""
    r: Array
    """State of the random numbers (6,), or (0,) where no touchdown is missed at random."""


class _Load(NamedTuple):
    """State of a `ByForce`."""

    free: float
    """1 once the foot has been free, else 0."""
    loaded: float
    """1 while it is loaded after that, else 0."""
    since: float
    """Time since which it is loaded [s]; the present time while it is not."""
    waits: float
    """1 while a touchdown waits for the delay to end, else 0."""
    due: float
    """Time from which it is detected [s]."""


@dataclass(frozen=True)
class FaultyTouchdown(Shown, Touchdown):
    """A detector that knows the true touchdown and fires `late` [s] after it, with
    misses and false detections.

    missed [1]: probability that a touchdown is never detected, by `seed`, a whole number from 0. false_at:
    (number of a single support from 1, time [s] from its start) of one detection without a touchdown, at the
    first tick from then on; shortly before its end it is an early one. A touchdown that leaves the labels
    right, as after a missed or an early one, is not detected. Raises InputError for a time that is negative and
    a probability out of range.
    """

    late: NonNegativeFloat = 0.0
    missed: Annotated[float, Range("0 to 1", lambda x: 0.0 <= x <= 1.0)] = 0.0
    false_at: Annotated[tuple[int, float], STEP_AND_TIME] | None = setup(None)
    seed: NonNegativeInt = setup(0)

    @derived
    def random(self) -> Array:
        """State r of the random numbers at the start of a run: (6,), or (0,) where `missed` is 0."""
        return seeded(self.seed) if self.missed > 0.0 else np.zeros(0)

    @derived
    def false(self) -> Array:
        """Number of the single support, and time in it [s], of the false detection (2,); number 0 for none."""
        return np.array((0, 0.0) if self.false_at is None else self.false_at, dtype=float)

    def start(self) -> Due:
        """State at the start: no touchdown waits; `done` is 1 where no false detection is planned."""
        # (waits, due, done, r)
        return Due(0.0, 0.0, float(self.false_at is None), self.random)

    def touchdown(self, d: Due, other: float, t: float) -> Due:
        """State d after a true touchdown at t [s]: its detection is due `late` [s] later, if the labels
        differ after it (other = 1) and a random number does not make it a missed one.
        """
        missed, r = 0.0, d.r
        # r is empty where no touchdown is missed at random; else a uniform number decides
        if len(r) > 0:
            r, u = uniforms(r, 1)
            missed = 1.0 * (u[0] < self.missed)
        waits: Any = np.where(other > 0.5, 1.0 - missed, 0.0)
        return Due(waits, t + self.late, d.done, r)

    def notice(self, d: Due, look: Look) -> tuple[Due, float]:
        """Fire when a detection is due and the labels still differ; and once, at the time of `false_at`.

        look: the time t [s], `other` (1 while the labels differ), the plant's single support `step`, and its
        `age`, the time [s] since it began.
        """
        # floats that are 0 or 1, or whole numbers, are compared by 0.5; `false` is (single support, time in it)
        due = 1.0 * (d.waits * look.other > 0.5) * (look.t >= d.due - SAME_INSTANT)
        at_step = 1.0 * (abs(look.step - self.false[0]) < 0.5) * (d.done < 0.5)
        false = at_step * (look.age >= self.false[1] - SAME_INSTANT)
        fires = np.maximum(due, false)
        left = d._replace(waits=d.waits * (1.0 - fires), done=np.maximum(d.done, false))
        return left, fires


@dataclass(frozen=True)
class Gated(Shown, Touchdown):
    """Base of the detectors with a gate: they fire only where the swing foot is far enough ahead.

    ahead [m]: least distance of the controller's swing foot in front of its stance foot. after [s]: least time
    between two detections. slope [rad]: of the ground as the controller assumes it, positive downhill. Raises
    InputError for numbers that are not finite or a time that is negative.
    """

    ahead: FiniteFloat = 0.1
    after: NonNegativeFloat = 0.1
    slope: FiniteFloat = 0.0

    @derived
    def tangent(self) -> float:
        """tan(slope) [1], how much the ground falls per metre forwards."""
        return math.tan(self.slope)

    def gate(self, look: Look) -> float:
        """1 where a touchdown is possible, else 0: the swing foot is ahead by more than `ahead` [m], and at
        least `after` [s] have passed since the last detection.
        """
        ahead = 1.0 * (look.foot[0] > self.ahead)
        return ahead * (look.t_step >= self.after - SAME_INSTANT)


@dataclass(frozen=True)
class ByKinematics(Gated):
    """A detector that fires when the swing foot, by the controller's model at the measured
    angles, is low.

    ahead [m]: least distance of the swing foot in front of the stance foot. after [s]: least time between two
    detections. slope [rad]: of the ground as the controller assumes it, positive downhill. height [m]: of the
    foot above that ground, below which it fires.

    With a height above zero it is early, by height / speed of the foot up to a tick; a step of the ground,
    which no angle shows, makes it late or early too.

    >>> detector = ba.ByKinematics(height=0.002)
    >>> timing = ba.SampledTime(1e-3, restart=False)
    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=timing, touchdown=detector)
    >>> ba.walk(walker, gait, impacts=2).impacts
    2
    """

    height: FiniteFloat = 0.0

    def start(self) -> float:
        """State d at the start: height [m] of the swing foot at the tick before, 0 as it still stands."""
        return 0.0

    def notice(self, d: float, look: Look) -> tuple[float, float]:
        """Fire when the foot is below `height`, on its way down, and the gate is open.

        d and the new state are its height [m] above the assumed slope at the tick before and now. look.foot:
        (x, z) [m] of the swing foot from the stance foot.
        """
        height = look.foot[1] + self.tangent * look.foot[0]
        # height < d: lower than at the tick before
        low = 1.0 * (height < self.height) * (height < d)
        return height, low * self.gate(look)


@dataclass(frozen=True)
class ByForce(Gated):
    """A detector that fires when the ground's force on the swing foot, low before, exceeds a threshold.

    ahead [m]: least distance of the swing foot in front of the stance foot. after [s]: least time between two
    detections. slope [rad]: of the ground as the controller assumes it, positive downhill. off [N]: the foot
    was free before, with less force than this. on [N]: force above which it is then loaded. debounce [s]:
    time for which it then carries at least `off`. delay [s]: it fires so much later. A foot switch is such a
    detector with its threshold and delay.
    Raises InputError unless 0 <= off <= on.

    >>> detector = ba.ByForce(on=80.0, off=30.0, delay=2e-3)
    >>> timing = ba.SampledTime(1e-3, restart=False)
    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=timing, touchdown=detector)
    >>> ba.walk(walker, gait, impacts=2).impacts
    2
    """

    on: FiniteFloat = 50.0
    off: NonNegativeFloat = 20.0
    debounce: NonNegativeFloat = 0.0
    delay: NonNegativeFloat = 0.0

    def __post_init__(self) -> None:
        if self.off > self.on:
            raise InputError(
                f"the touchdown's forces are off = {self.off} N and on = {self.on} N, expected 0 <= off <= on"
            )

    needs_force = True

    def start(self) -> _Load:
        """State at the start, all 0: the foot was not free yet, so it must lift off before a detection."""
        # free, loaded, since, waits, due: neither free nor loaded, and no touchdown waits
        return _Load(0.0, 0.0, 0.0, 0.0, 0.0)

    def notice(self, d: _Load, look: Look) -> tuple[_Load, float]:
        """Fire `delay` after a foot that was free has been loaded for `debounce`; then the foot is not free.

        look: the time t [s] and the `force` [N] of the ground on the swing foot.
        """
        t = look.t
        # np.maximum stands for `or`, products for `and`; all are 1 or 0, but for the times `since` and `due`
        free = np.maximum(d.free, 1.0 * (look.force < self.off))
        stays = d.loaded * (look.force >= self.off)
        loaded = np.maximum(stays, 1.0 * (look.force > self.on) * free * self.gate(look))
        since: Any = np.where(d.loaded > 0.5, d.since, t)
        # sure: loaded for `debounce`, and no detection is waiting for its delay already
        sure = loaded * (t - since >= self.debounce - SAME_INSTANT) * (1.0 - d.waits)
        due: Any = np.where(sure > 0.5, t + self.delay, d.due)
        waits = np.maximum(d.waits, sure)
        fires = waits * (t >= due - SAME_INSTANT)
        # firing sets the state back to that of a foot that has to be free first
        left = 1.0 - fires
        return _Load(free * left, loaded * left, since, waits * left, due), fires
