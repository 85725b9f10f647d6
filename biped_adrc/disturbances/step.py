"""A torque that sets in and stays, through all later steps: zeta = amplitude from onset on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.disturbances.base import WindowedTorque
from biped_adrc.errors import InputError
from biped_adrc.types import Array


@dataclass(frozen=True)
class TorqueStep(WindowedTorque):
    """amplitude (n,) [N m] from `start` [s] of single support `step` (or of the run) for good."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.stop != float("inf"):
            raise InputError("a torque step has no stop; use TorquePulse for a window")

    def profile(self, s: float) -> float:
        return 1.0

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        if self.step is not None and step > self.step:
            return np.array(self.amplitude)
        return super().torque(t, step, t_start, q, v)
