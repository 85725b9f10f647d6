"""What a disturbance is: the generalised force zeta(t) of (1), and the times at which it switches."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.types import Array


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

    def switching_times(self, step: int, t_start: float) -> tuple[float, ...]:
        return tuple(s for part in self.parts for s in part.switching_times(step, t_start))


def terms(disturbance: Disturbance) -> tuple[Disturbance, ...]:
    """The parts of a sum, or the disturbance itself."""
    return disturbance.parts if isinstance(disturbance, Sum) else (disturbance,)


@dataclass(frozen=True)
class WindowedTorque(Disturbance):
    """amplitude * profile(time since onset) between `start` and `stop` [s].

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
        if self.step is not None and self.step < 1:
            raise InputError(f"torque step is {self.step}; single supports are counted from 1")
        amplitude.setflags(write=False)
        object.__setattr__(self, "amplitude", amplitude)

    @abstractmethod
    def profile(self, s: float) -> float:
        """Factor on the amplitude, s [s] after onset."""

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        origin = 0.0 if self.step is None else t_start
        here = self.step is None or step == self.step
        if here and origin + self.start <= t < origin + self.stop:
            return self.amplitude * self.profile(t - (origin + self.start))
        return np.zeros(len(self.amplitude))

    def switching_times(self, step: int, t_start: float) -> tuple[float, ...]:
        if self.step is not None and step != self.step:
            return ()
        origin = 0.0 if self.step is None else t_start
        return tuple(origin + s for s in (self.start, self.stop) if math.isfinite(s))
