"""A constant force on the hip: zeta = J(q)' F with J = dp_hip/dq.

It enters the unactuated row too, so no tracking loop rejects it (Westervelt, Grizzle, Canudas de Wit, IEEE
CDC 2003). It is constant in the world; F_x < 0 pulls backwards. The force of the
ground is m (p_com'' - g) - F.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from biped_adrc.disturbances.base import Disturbance
from biped_adrc.errors import InputError
from biped_adrc.model.biped import Biped
from biped_adrc.types import Array


@dataclass(frozen=True)
class HipForce(Disturbance):
    """F = force (F_x, F_z) [N] on the hip of `biped`, the plant.

    steps: the first and the last single support (from 1) in which it acts; all of them without.
    Raises InputError for a force that is not two finite numbers, or steps that do not count up from 1.
    """

    biped: Biped
    force: tuple[float, float]
    steps: tuple[int, int] | None = None

    def __post_init__(self) -> None:
        if len(self.force) != 2 or not all(math.isfinite(f) for f in self.force):
            raise InputError(
                f"the force on the hip is {self.force}, expected two finite numbers (F_x, F_z) [N]"
            )
        if self.steps is not None and not 1 <= self.steps[0] <= self.steps[1]:
            raise InputError(
                f"the force on the hip acts in steps {self.steps}, expected (first, last) with "
                "1 <= first <= last"
            )

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        pinned = self.biped.pinned
        return pinned.jacobian(q, pinned.hip).T @ self.resultant(t, step, t_start)

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        acts = self.steps is None or self.steps[0] <= step <= self.steps[1]
        return np.array(self.force) if acts else np.zeros(2)
