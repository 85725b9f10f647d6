"""The ground: the axes of a slope, and where it is lower or higher, by steps in numbers of single supports."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from biped_adrc.errors import InputError, check_count, check_positive, check_whole
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
class GroundStep:
    """What a step down and a step up share."""

    step: int
    height: float
    way: ClassVar[str]
    other: ClassVar[str]

    def __post_init__(self) -> None:
        way, height = self.way, self.height
        check_count(
            self.step, f"the step {way} is in single support {self.step}; they are counted from 1"
        )
        hint = f"; a step {self.other} is a Step{self.other.capitalize()}"
        check_positive(height, f"the step {way} is {height} m high", hint)

    @property
    def drop(self) -> float:
        """How far the ground lies below the stance foot [m], negative for a step up."""
        return self.height if self.way == "down" else -self.height


class StepDown(GroundStep):
    """The ground on which single support `step` (from 1) ends lies `height` [m] below its stance foot.

    Raises InputError for a height that is not positive; a step up is a `StepUp`.
    """

    way, other = "down", "up"


class StepUp(GroundStep):
    """The ground on which single support `step` (from 1) ends lies `height` [m] above its stance foot.

    The swing foot strikes it once it has been above; whether it clears the edge is not modelled.
    Raises InputError for a height that is not positive; a step down is a `StepDown`.
    """

    way, other = "up", "down"


def uneven_ground(seed: int, rms: float, steps: int) -> tuple[StepDown | StepUp, ...]:
    """Footholds at heights of mean zero and root mean square `rms` [m], for single supports 1 to `steps`.

    The heights h_1, h_2, ... are normally distributed and independent, the first stance foot is at h_0 = 0, and
    single support k ends h_(k-1) - h_k lower than it began; after `steps` the ground is level.
    Raises InputError for a negative rms, a seed or a number of steps that is no whole number >= 0.
    """
    if not (math.isfinite(rms) and rms >= 0.0):
        raise InputError(f"the rms of uneven ground is {rms} m, expected a number >= 0")
    for name, value in (("seed", seed), ("number of steps", steps)):
        check_whole(value, f"the {name} of uneven ground is {value}")
    heights = np.concatenate(([0.0], np.random.default_rng(seed).normal(0.0, rms, steps)))
    drops = ((k + 1, float(drop)) for k, drop in enumerate(-np.diff(heights)))
    return tuple(
        StepDown(step, drop) if drop > 0.0 else StepUp(step, -drop)
        for step, drop in drops
        if drop != 0.0
    )
