"""A torque that sets in and stays, through all later steps: zeta = amplitude from onset on.

A load that is picked up, or a friction that nobody modelled. An observer with one extended state (m = 1) finds
it without a steady error, a PD controller leaves an error that falls with its gains. Joints swap names at
impact, so a torque on one leg's joints stays with the leg that stands, not with the metal.
"""

from __future__ import annotations

from dataclasses import dataclass

from biped_adrc.disturbances.base import Windowed
from biped_adrc.errors import InputError
from biped_adrc.types import Array


@dataclass(frozen=True)
class TorqueStep(Windowed):
    """amplitude (n,) [N m] from `start` [s] of single support `step` (or of the run) for good.

    Raises InputError for a stop that is not infinite.
    """

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.stop != float("inf"):
            raise InputError("a torque step has no stop; use TorquePulse for a window")

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        return 1.0 * self.amplitude

    def acts(self, t: float, step: int, t_start: float) -> float:
        """Above 0 from onset on, in all later steps too."""
        later = 1.0 * (self.support > 0) * (step > self.support)
        return later + super().acts(t, step, t_start)
