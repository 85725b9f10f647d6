"""A constant torque over a window: zeta = amplitude for start <= t < stop."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.disturbances.base import DisturbanceLaw, Windowed, WindowParameters, since_onset
from biped_adrc.types import Array


def pulse_torque(
    k: WindowParameters, t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """zeta (n,) [N m]."""
    is_on = since_onset(k, t, step, t_start) >= 0.0
    return k.amplitude.copy() if is_on else np.zeros(len(k.amplitude))


@dataclass(frozen=True)
class TorquePulse(Windowed):
    """The push of the paper: amplitude (n,) [N m] over [start, stop) [s] of one step."""

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        return pulse_torque(self.parameters, t, step, t_start, q, v)

    @property
    def parameters(self) -> WindowParameters:
        """What the law `pulse_torque` needs."""
        return self.window

    @property
    def laws(self) -> tuple[DisturbanceLaw, ...]:
        return (DisturbanceLaw(self.parameters, pulse_torque, self.switches),)
