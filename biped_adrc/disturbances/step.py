"""A torque that sets in and stays, through all later steps: zeta = amplitude from onset on.

A load that is picked up, or a friction that nobody modelled. An observer with one extended state (m = 1) finds
it without a steady error, a PD controller leaves an error that falls with its gains. Joints swap names at
impact, so a torque on one leg's joints stays with the leg that stands, not with the metal.
"""

from __future__ import annotations

from dataclasses import dataclass

from biped_adrc.disturbances.base import DisturbanceLaw, Windowed, WindowParameters, within
from biped_adrc.errors import InputError
from biped_adrc.types import Array


def step_torque(
    k: WindowParameters, t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """zeta (n,) [N m]: the amplitude, asked for from onset on alone."""
    return 1.0 * k.amplitude


def step_acts(k: WindowParameters, t: float, step: int, t_start: float) -> float:
    """Above 0 from onset on, in all later steps too, whose windows `within` does not know."""
    later: float = 1.0 * (k.step > 0) * (step > k.step)
    return later + within(k, t, step, t_start)


@dataclass(frozen=True)
class TorqueStep(Windowed):
    """amplitude (n,) [N m] from `start` [s] of single support `step` (or of the run) for good.

    Raises InputError for a stop that is not infinite.
    """

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.stop != float("inf"):
            raise InputError("a torque step has no stop; use TorquePulse for a window")

    @property
    def windowed(self) -> DisturbanceLaw:
        """The law, whose own `active` goes on past the end of the step."""
        return DisturbanceLaw(self.window, step_torque, active=step_acts)
