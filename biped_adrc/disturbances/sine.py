"""A sinusoidal torque over a window: zeta = amplitude sin(2 pi f (t - start))."""

from __future__ import annotations

import math
from dataclasses import dataclass

from biped_adrc.disturbances.base import WindowedTorque
from biped_adrc.errors import InputError


@dataclass(frozen=True)
class TorqueSine(WindowedTorque):
    """amplitude (n,) [N m], frequency f [Hz]."""

    frequency: float = 1.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (math.isfinite(self.frequency) and self.frequency > 0):
            raise InputError(f"sine frequency is {self.frequency} Hz, expected a positive number")

    def profile(self, s: float) -> float:
        return math.sin(2.0 * math.pi * self.frequency * s)
