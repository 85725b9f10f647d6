"""A force from elsewhere on one point of the robot, such as a hand's or a learner's.

    zeta = J(q)' F

F = `force` (F_x, F_z) [N] has the world's axes, J(q) is the Jacobian of the point. F is a parameter, as the
torque of `control.added_torque`: its maker writes another one before each sample, and nothing is compiled.
"""

from __future__ import annotations

from dataclasses import dataclass

from biped_adrc.core.types import Array, freeze
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.model.planar import LinkPoint, jacobian, turned


@dataclass(frozen=True)
class AddedForce(Disturbance):
    """The module's F = `force` (2,) [N] at `point`; nothing is computed while it is zero."""

    force: Array
    point: LinkPoint

    def __post_init__(self) -> None:
        freeze(self, "force")

    def acts(self, t: float, step: int, t_start: float) -> float:
        return 1.0 * (self.force[0] ** 2 + self.force[1] ** 2)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        k = self.point
        zeta: Array = self.force @ jacobian(k, turned(k, q), k.re, k.im)
        return zeta

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        return 1.0 * self.force
