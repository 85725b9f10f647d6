"""A sinusoidal torque over a window: zeta = amplitude sin(2 pi f (t - start)).

It shows how fast a disturbance an observer follows: the estimate of one with a bandwidth w_o lags behind by a
phase that grows with 2 pi f / w_o. It begins at zero without a jump and ends with one, unless the window
holds a whole number of half periods.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from biped_adrc.disturbances.base import Windowed
from biped_adrc.errors import check_positive
from biped_adrc.types import Array


@dataclass(frozen=True)
class TorqueSine(Windowed):
    """The module's equation: amplitude (n,) [N m], frequency f [Hz], the window as in `Windowed`.

    Raises InputError for a frequency that is not positive.
    """

    frequency: float = 1.0

    def __post_init__(self) -> None:
        super().__post_init__()
        check_positive(self.frequency, f"sine frequency is {self.frequency} Hz")

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        s = t - self.onset(t_start)
        return self.amplitude * np.sin(2.0 * math.pi * self.frequency * s)
