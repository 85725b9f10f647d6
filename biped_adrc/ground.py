"""Where the ground is lower: steps down, in numbers of single supports."""

from __future__ import annotations

import math
from dataclasses import dataclass

from biped_adrc.errors import InputError


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
