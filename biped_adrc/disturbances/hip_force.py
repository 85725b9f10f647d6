"""A constant force on the hip: zeta = J(q)' F with J = dp_hip/dq.

It enters the unactuated row too, so no tracking loop rejects it (Westervelt, Grizzle, Canudas de Wit, IEEE
CDC 2003). It is constant in the world; F_x < 0 pulls backwards. The force of the
ground is m (p_com'' - g) - F.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from biped_adrc.disturbances.base import Disturbance, DisturbanceLaw
from biped_adrc.errors import InputError
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import LinkPoint, hip_point, wrench_torque
from biped_adrc.types import Array


class HipForceParameters(NamedTuple):
    """F (2,) [N], the first and the last single support in which it acts, and the hip in closed form."""

    force: Array
    first: float
    last: float
    hip: LinkPoint


def hip_torque(
    k: HipForceParameters, t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """zeta (n,) [N m]."""
    return wrench_torque(k.hip, q, np.array([k.force[0], k.force[1], 0.0]))


def hip_resultant(
    k: HipForceParameters, t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """F (2,) [N]."""
    return 1.0 * k.force


def hip_acts(k: HipForceParameters, t: float, step: int, t_start: float) -> float:
    """Above 0 from the first to the last single support."""
    return 1.0 * (step >= k.first) * (step <= k.last)


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

    @cached_property
    def parameters(self) -> HipForceParameters:
        """What the laws need."""
        first, last = self.steps or (0, math.inf)
        force = np.array(self.force, dtype=float)
        return HipForceParameters(force, float(first), float(last), hip_point(self.biped))

    @property
    def laws(self) -> tuple[DisturbanceLaw, ...]:
        return (DisturbanceLaw(self.parameters, hip_torque, (), hip_resultant, hip_acts),)
