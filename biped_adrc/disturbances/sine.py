"""A sinusoidal torque over a window: zeta = amplitude sin(2 pi f (t - start)).

It shows how fast a disturbance an observer follows: the estimate of one with a bandwidth w_o lags behind by a
phase that grows with 2 pi f / w_o. It begins at zero without a jump and ends with one, unless the window
holds a whole number of half periods.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.disturbances.base import (
    DisturbanceLaw,
    Windowed,
    WindowParameters,
    onset,
    window_acts,
)
from biped_adrc.errors import check_positive
from biped_adrc.types import Array


class SineParameters(NamedTuple):
    """window: when it acts, and its amplitude (n,) [N m]. frequency: f [Hz]."""

    window: WindowParameters
    frequency: float


def sine_torque(
    k: SineParameters, t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """zeta (n,) [N m] of the module's equation at t [s], asked for in the window alone."""
    s = t - onset(k.window, t_start)
    return k.window.amplitude * np.sin(2.0 * math.pi * k.frequency * s)


@dataclass(frozen=True)
class TorqueSine(Windowed):
    """The module's equation: amplitude (n,) [N m], frequency f [Hz], the window as in `Windowed`.

    Raises InputError for a frequency that is not positive.
    """

    frequency: float = 1.0

    def __post_init__(self) -> None:
        super().__post_init__()
        check_positive(self.frequency, f"sine frequency is {self.frequency} Hz")

    @property
    def parameters(self) -> SineParameters:
        """What the law `sine_torque` takes."""
        return SineParameters(self.window, float(self.frequency))

    @property
    def windowed(self) -> DisturbanceLaw:
        return DisturbanceLaw(self.parameters, sine_torque, active=window_acts)
