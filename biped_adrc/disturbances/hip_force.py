"""A constant force on the hip: zeta = J(q)' F with J = dp_hip/dq.

It enters the unactuated row too, so no tracking loop rejects it (Westervelt, Grizzle, Canudas de Wit, IEEE
CDC 2003): the speed of walking changes, and an outer loop such as `control.stride` has to bring it back. It is
constant in the world; F_x < 0 pulls backwards. The force of the ground is m (p_com'' - g) - F.

J is that of the plant: a plant with model errors has other geometry than the nominal robot, and the push acts
on what walks.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from biped_adrc.core.errors import InputError
from biped_adrc.core.part import derived, setup
from biped_adrc.core.types import Array
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import LinkPoint, hip_point, wrench_torque


@dataclass(frozen=True)
class HipForce(Disturbance):
    """F = force (F_x, F_z) [N] on the hip of `biped`, the plant.

    steps: the first and the last single support (from 1) in which it acts; all of them without. It switches at
    impacts alone, so integrators have no times to stop at.
    Raises InputError for a force that is not two finite numbers, or steps that do not count up from 1.

    >>> push = ba.HipForce(biped, (20.0, 0.0), steps=(4, 6))
    >>> push.net_force(2.0, 4, 1.9)
    array([20.,  0.])
    """

    biped: Biped
    force: tuple[float, float]
    steps: tuple[int, int] | None = setup(None)

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.force) != 2 or not all(math.isfinite(f) for f in self.force):
            raise InputError(
                f"the force on the hip is {self.force}, expected two finite numbers (F_x, F_z) [N]"
            )
        if self.steps is not None and not 1 <= self.steps[0] <= self.steps[1]:
            raise InputError(
                f"the force on the hip acts in steps {self.steps}, expected (first, last) with "
                "1 <= first <= last"
            )

    @derived
    def hip(self) -> LinkPoint:
        """J in closed form."""
        return hip_point(self.biped)

    @derived
    def span(self) -> tuple[float, float]:
        """The first and the last single support, infinite for no last one."""
        first, last = self.steps or (0, math.inf)
        return float(first), float(last)

    def acts(self, t: float, step: int, t_start: float) -> float:
        """1 from the first to the last single support, else 0, whatever the time in them."""
        first, last = self.span
        return 1.0 * (step >= first) * (step <= last)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """zeta = J(q)' F (n,) [N m]; no moment acts."""
        return wrench_torque(self.hip, q, np.array([*self.force, 0.0]))

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        return 1.0 * np.array(self.force)
