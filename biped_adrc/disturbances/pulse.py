"""A constant torque over a window: zeta = amplitude for start <= t < stop."""

from __future__ import annotations

from dataclasses import dataclass

from biped_adrc.disturbances.base import WindowedTorque


@dataclass(frozen=True)
class TorquePulse(WindowedTorque):
    """The push of the paper: amplitude (n,) [N m] over [start, stop) [s] of one step."""

    def profile(self, s: float) -> float:
        return 1.0
