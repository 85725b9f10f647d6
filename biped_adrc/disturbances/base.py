"""What a disturbance is: the generalised force zeta(t) of (1), and the times at which it switches."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.errors import InputError, check_count
from biped_adrc.types import Array

GAUSS = 0.5773502691896257
"""1 / sqrt(3): nodes of Gauss's rule on [-1, 1], both of weight 1."""


class DisturbanceLaw(NamedTuple):
    """The pure function behind a disturbance: zeta = torque(parameters, t, step, t_start, q, v)."""

    parameters: Any
    """k, a NamedTuple of numbers and float64 arrays."""
    torque: Callable[..., Array]
    switches: tuple[tuple[int, float], ...] = ()
    """(step, s): not smooth s [s] after that single support began, or for step 0 at the time s of the run."""
    resultant: Callable[..., Array] | None = None
    """`Disturbance.resultant` as resultant(parameters, t, step, t_start, q, v), of time alone; None is zero."""


class Disturbance(ABC):
    """A pure function of time, step and state. `a + b` adds two of them up."""

    @abstractmethod
    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """zeta (n,) [N m] at time t [s] in single support `step` (from 1), which began at t_start."""

    def switching_times(self, step: int, t_start: float) -> tuple[float, ...]:
        """Times [s] at which the torque is not smooth in this step."""
        return ()

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        """Force (F_x, F_z) [N] from outside on the robot as a whole, zero for torques; what the ground does not
        carry."""
        return np.zeros(2)

    def impulse(self, t0: float, t1: float, step: int, t_start: float) -> Array:
        """The integral of `resultant` from t0 to t1 (2,) [N s], by two points of Gauss in each smooth piece."""
        inside = sorted(s for s in self.switching_times(step, t_start) if t0 < s < t1)
        total = np.zeros(2)
        for a, b in pairwise([t0, *inside, t1]):
            middle, half = 0.5 * (a + b), 0.5 * (b - a)
            for node in (middle - GAUSS * half, middle + GAUSS * half):
                total += half * self.resultant(node, step, t_start)
        return total

    @property
    def pulls(self) -> bool:
        """Whether it has a resultant at all."""
        return type(self).resultant is not Disturbance.resultant

    @property
    def laws(self) -> tuple[DisturbanceLaw, ...] | None:
        """The torque is their sum; None for a disturbance written as a method alone."""
        return None

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        """(step, s) as `DisturbanceLaw.switches`; of a disturbance without laws, none that are known."""
        return tuple(edge for law in self.laws or () for edge in law.switches)

    def __add__(self, other: Disturbance) -> Disturbance:
        return Sum((*terms(self), *terms(other)))


@dataclass(frozen=True)
class Sum(Disturbance):
    """The sum of several disturbances; of none, zero."""

    parts: tuple[Disturbance, ...] = ()

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        total = np.zeros(len(q))
        for part in self.parts:
            total += part.torque(t, step, t_start, q, v)
        return total

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        total = np.zeros(2)
        for part in self.parts:
            total += part.resultant(t, step, t_start)
        return total

    @property
    def pulls(self) -> bool:
        return any(part.pulls for part in self.parts)

    def switching_times(self, step: int, t_start: float) -> tuple[float, ...]:
        return tuple(s for part in self.parts for s in part.switching_times(step, t_start))

    @property
    def laws(self) -> tuple[DisturbanceLaw, ...] | None:
        found: tuple[DisturbanceLaw, ...] = ()
        for part in self.parts:
            if part.laws is None:
                return None
            found += part.laws
        return found


def terms(disturbance: Disturbance) -> tuple[Disturbance, ...]:
    """The parts of a sum, or the disturbance itself."""
    return disturbance.parts if isinstance(disturbance, Sum) else (disturbance,)


class WindowParameters(NamedTuple):
    """amplitude (n,) [N m]; step, 0 when the window counts from the start of the run; start, stop [s]."""

    amplitude: Array
    step: int
    start: float
    stop: float


def since_onset(k: WindowParameters, t: float, step: int, t_start: float) -> float:
    """Time since onset [s], -1 outside the window."""
    if k.step > 0 and step != k.step:
        return -1.0
    origin = t_start if k.step > 0 else 0.0
    if origin + k.start <= t < origin + k.stop:
        return t - (origin + k.start)
    return -1.0


@dataclass(frozen=True)
class Windowed(Disturbance):
    """A torque between `start` and `stop` [s].

    amplitude (n,) [N m] acts on q1..qN, actuated or not. With `step` the window counts from the start of
    that single support and closes at its end at the latest; without, from the start of the run.
    """

    amplitude: Array
    step: int | None = None
    start: float = 0.0
    stop: float = math.inf

    def __post_init__(self) -> None:
        amplitude = np.array(self.amplitude, dtype=float)
        if amplitude.ndim != 1 or not np.all(np.isfinite(amplitude)):
            raise InputError(
                f"torque amplitude is {amplitude}, expected one finite number [N m] per coordinate"
            )
        if not (math.isfinite(self.start) and self.start >= 0 and self.stop > self.start):
            raise InputError(
                f"torque window is [{self.start}, {self.stop}] s, expected 0 <= start < stop"
            )
        if self.step is not None:
            what = f"torque step is {self.step}; single supports are counted from 1"
            check_count(self.step, what)
        amplitude.setflags(write=False)
        object.__setattr__(self, "amplitude", amplitude)

    @cached_property
    def window(self) -> WindowParameters:
        """What the law `since_onset` needs."""
        return WindowParameters(self.amplitude, self.step or 0, float(self.start), float(self.stop))

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        """As `DisturbanceLaw.switches`."""
        ends = (self.start, self.stop)
        return tuple((self.step or 0, float(s)) for s in ends if math.isfinite(s))

    def switching_times(self, step: int, t_start: float) -> tuple[float, ...]:
        return tuple(s if at == 0 else t_start + s for at, s in self.switches if at in (0, step))


@dataclass(frozen=True)
class WindowedTorque(Windowed):
    """amplitude * profile(time since onset) in its window."""

    @abstractmethod
    def profile(self, s: float) -> float:
        """Factor on the amplitude, s [s] after onset."""

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        s = since_onset(self.window, t, step, t_start)
        return self.amplitude * self.profile(s) if s >= 0.0 else np.zeros(len(self.amplitude))
