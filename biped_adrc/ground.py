"""The ground: the axes of a slope, and where it is lower, by steps down in numbers of single supports."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.types import Array


def ground_axes(slope: float) -> tuple[Array, Array]:
    """Unit vectors (x, z) along the ground, downhill for a positive slope [rad], and out of it."""
    along = np.array([math.cos(slope), -math.sin(slope)])
    return along, np.array([math.sin(slope), math.cos(slope)])


@dataclass(frozen=True)
class StepDown:
    """The ground on which single support `step` (from 1) ends lies `height` [m] below its stance foot.

    Raises InputError for a step up: whether the swing foot clears its edge is not modelled.
    """

    step: int
    height: float

    def __post_init__(self) -> None:
        if self.step < 1:
            raise InputError(
                f"the step down is in single support {self.step}; they are counted from 1"
            )
        if not (math.isfinite(self.height) and self.height > 0.0):
            raise InputError(
                f"the step down is {self.height} m high, expected a positive number; steps up are not "
                "modelled"
            )

    @property
    def drop(self) -> float:
        """How far the ground lies below the stance foot [m]."""
        return self.height


@dataclass(frozen=True)
class StepUp:
    """The ground on which single support `step` (from 1) ends lies `height` [m] above its stance foot.

    The foot strikes it once it has been above; whether it clears the edge is not modelled.
    """

    step: int
    height: float

    @property
    def drop(self) -> float:
        """How far the ground lies below the stance foot [m], negative."""
        return -self.height
