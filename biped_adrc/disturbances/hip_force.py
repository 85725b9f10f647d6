"""A constant force on the hip: zeta = J(q)' F with J = dp_hip/dq.

It enters the unactuated row too, so no tracking loop rejects it (Westervelt, Grizzle, Canudas de Wit, IEEE
CDC 2003): the speed of walking changes, and an outer loop such as `control.stride` has to bring it back. It is
constant in the world; F_x < 0 pulls backwards. The force of the ground is m (p_com'' - g) - F.

`HipForce` holds what a user gives, `HipForceParameters` the numbers of its laws. J is that of the plant: a
plant with model errors has other geometry than the nominal robot, and the push acts on what walks.
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
    """The force and when it acts, as numbers for the laws.

    force: F (2,) [N]. first, last: single supports, infinite for no last one. hip: J in closed form.
    """

    force: Array
    first: float
    last: float
    hip: LinkPoint


def hip_torque(
    k: HipForceParameters, t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """zeta = J(q)' F (n,) [N m], at the angles q (n,) [rad]; no moment acts."""
    return wrench_torque(k.hip, q, np.array([k.force[0], k.force[1], 0.0]))


def hip_resultant(
    k: HipForceParameters, t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """F (2,) [N], what the robot as a whole is pushed with."""
    return 1.0 * k.force


def hip_acts(k: HipForceParameters, t: float, step: int, t_start: float) -> float:
    """1 from the first to the last single support, else 0, whatever the time in them."""
    return 1.0 * (step >= k.first) * (step <= k.last)


@dataclass(frozen=True)
class HipForce(Disturbance):
    """F = force (F_x, F_z) [N] on the hip of `biped`, the plant.

    steps: the first and the last single support (from 1) in which it acts; all of them without. It switches at
    impacts alone, so integrators have no times to stop at.
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
        """What the laws `hip_torque`, `hip_resultant` and `hip_acts` take."""
        first, last = self.steps or (0, math.inf)
        force = np.array(self.force, dtype=float)
        return HipForceParameters(force, float(first), float(last), hip_point(self.biped))

    @property
    def laws(self) -> tuple[DisturbanceLaw, ...]:
        """One law, that of J' F, with its resultant."""
        return (DisturbanceLaw(self.parameters, hip_torque, (), hip_resultant, hip_acts),)
