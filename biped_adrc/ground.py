"""The ground: the axes of a slope, and where it is lower or higher, by steps in numbers of single supports."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from biped_adrc.errors import InputError, check_count
from biped_adrc.types import Array


def ground_axes(slope: float) -> tuple[Array, Array]:
    """Unit vectors (x, z) along the ground, downhill for a positive slope [rad], and out of it."""
    along = np.array([math.cos(slope), -math.sin(slope)])
    return along, np.array([math.sin(slope), math.cos(slope)])


def check_slope(slope: float) -> None:
    """Raise InputError for a slope [rad] that is no ground."""
    if not abs(slope) < 0.5 * math.pi:
        raise InputError(f"the slope is {slope} rad, expected less than a right angle")


@dataclass(frozen=True)
class StepDown:
    """The ground on which single support `step` (from 1) ends lies `height` [m] below its stance foot.

    Raises InputError for a height that is not positive; a step up is a `StepUp`.
    """

    step: int
    height: float

    def __post_init__(self) -> None:
        _check(self.step, self.height, "down", "up")

    @property
    def drop(self) -> float:
        """How far the ground lies below the stance foot [m]."""
        return self.height


@dataclass(frozen=True)
class StepUp:
    """The ground on which single support `step` (from 1) ends lies `height` [m] above its stance foot.

    The swing foot strikes it once it has been above; whether it clears the edge is not modelled.
    Raises InputError for a height that is not positive; a step down is a `StepDown`.
    """

    step: int
    height: float

    def __post_init__(self) -> None:
        _check(self.step, self.height, "up", "down")

    @property
    def drop(self) -> float:
        """How far the ground lies below the stance foot [m], negative."""
        return -self.height


def uneven_ground(seed: int, rms: float, steps: int) -> tuple[StepDown | StepUp, ...]:
    """Footholds at heights of mean zero and root mean square `rms` [m], for single supports 1 to `steps`.

    The heights h_1, h_2, ... are normally distributed and independent, the first stance foot is at h_0 = 0, and
    single support k ends h_(k-1) - h_k lower than it began; after `steps` the ground is level.
    Raises InputError for a negative rms, a seed or a number of steps that is no whole number >= 0.
    """
    if not (math.isfinite(rms) and rms >= 0.0):
        raise InputError(f"the rms of uneven ground is {rms} m, expected a number >= 0")
    for name, value in (("seed", seed), ("number of steps", steps)):
        if isinstance(value, bool) or not isinstance(value, int) or value < 0:
            raise InputError(
                f"the {name} of uneven ground is {value}, expected a whole number >= 0"
            )
    heights = np.concatenate(([0.0], np.random.default_rng(seed).normal(0.0, rms, steps)))
    drops = ((k + 1, float(drop)) for k, drop in enumerate(-np.diff(heights)))
    return tuple(
        StepDown(step, drop) if drop > 0.0 else StepUp(step, -drop)
        for step, drop in drops
        if drop != 0.0
    )


def _check(step: int, height: float, way: str, other: str) -> None:
    check_count(step, f"the step {way} is in single support {step}; they are counted from 1")
    if not (math.isfinite(height) and height > 0.0):
        raise InputError(
            f"the step {way} is {height} m high, expected a positive number; a step {other} is a "
            f"Step{other.capitalize()}"
        )
