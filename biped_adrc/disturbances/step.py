"""A torque that sets in and stays, through all later steps: zeta = amplitude from onset on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.disturbances.base import DisturbanceLaw, Windowed, WindowParameters, since_onset
from biped_adrc.errors import InputError
from biped_adrc.types import Array


def step_torque(
    k: WindowParameters, t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """zeta (n,) [N m]."""
    if 0 < k.step < step or since_onset(k, t, step, t_start) >= 0.0:
        return k.amplitude.copy()
    return np.zeros(len(k.amplitude))


@dataclass(frozen=True)
class TorqueStep(Windowed):
    """amplitude (n,) [N m] from `start` [s] of single support `step` (or of the run) for good."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.stop != float("inf"):
            raise InputError("a torque step has no stop; use TorquePulse for a window")

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        return step_torque(self.parameters, t, step, t_start, q, v)

    @property
    def parameters(self) -> WindowParameters:
        """What the law `step_torque` needs."""
        return self.window

    @property
    def laws(self) -> tuple[DisturbanceLaw, ...]:
        return (DisturbanceLaw(self.parameters, step_torque, self.switches),)
