"""A torque that sets in and stays, through all later steps: zeta = amplitude from onset on."""

from __future__ import annotations

from dataclasses import dataclass

from biped_adrc.disturbances.base import DisturbanceLaw, Windowed, WindowParameters, within
from biped_adrc.errors import InputError
from biped_adrc.types import Array


def step_torque(
    k: WindowParameters, t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """zeta (n,) [N m] from onset on."""
    return 1.0 * k.amplitude


def step_acts(k: WindowParameters, t: float, step: int, t_start: float) -> float:
    """Above 0 from onset on, in all later steps too."""
    later: float = 1.0 * (k.step > 0) * (step > k.step)
    return later + within(k, t, step, t_start)


@dataclass(frozen=True)
class TorqueStep(Windowed):
    """amplitude (n,) [N m] from `start` [s] of single support `step` (or of the run) for good."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.stop != float("inf"):
            raise InputError("a torque step has no stop; use TorquePulse for a window")

    @property
    def windowed(self) -> DisturbanceLaw:
        return DisturbanceLaw(self.window, step_torque, active=step_acts)
