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
from biped_adrc.model.link_point import LinkPoint, hip_point, wrench_torque
from biped_adrc.types import Array


class HipForceParameters(NamedTuple):
    """F (2,) [N], and the first and the last single support in which it acts; last = 0 for all of them."""

    force: Array
    first: int
    last: int


def hip_force(k: HipForceParameters, step: int) -> Array:
    """F (2,) [N] in single support `step`."""
    acts = k.last == 0 or k.first <= step <= k.last
    return k.force.copy() if acts else np.zeros(2)


def hip_torque(k: HipForceParameters, step: int, J: Array) -> Array:
    """zeta (n,) [N m] for J = dp_hip/dq (2, n) of the plant."""
    return J.T @ hip_force(k, step)


class HipPushParameters(NamedTuple):
    """F and its steps, and the hip in closed form."""

    force: HipForceParameters
    hip: LinkPoint


def hip_push(
    k: HipPushParameters, t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """zeta (n,) [N m]."""
    F = hip_force(k.force, step)
    return wrench_torque(k.hip, q, np.array([F[0], F[1], 0.0]))


def hip_resultant(
    k: HipPushParameters, t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """F (2,) [N]."""
    return hip_force(k.force, step)


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
        return hip_torque(self.parameters, step, pinned.jacobian(q, pinned.hip))

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        return hip_force(self.parameters, step)

    @cached_property
    def parameters(self) -> HipForceParameters:
        """What the laws `hip_force` and `hip_torque` need."""
        first, last = self.steps or (0, 0)
        return HipForceParameters(np.array(self.force, dtype=float), first, last)

    @cached_property
    def laws(self) -> tuple[DisturbanceLaw, ...]:
        k = HipPushParameters(self.parameters, hip_point(self.biped))
        return (DisturbanceLaw(k, hip_push, (), hip_resultant),)
