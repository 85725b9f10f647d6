"""NPD: feedback linearisation with proportional-derivative action, eq. (28).

    u = kappa^-1 (q_d'' - K_d (q_b' - q_d') - K_p (q_b - q_d) - xi)

xi comes from the model, (14) without disturbances. The paper writes estimates x1^, x2^ here, though NPD
has no observer: the measured state is used.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from biped_adrc.control.base import Controller, ControllerLaws, Measurement, measured
from biped_adrc.control.tracking import (
    TABLE_II,
    Gains,
    TrackingParameters,
    constraint_parameters,
    tracking_torque,
)
from biped_adrc.gait.constraint import ConstraintParameters, VirtualConstraint, virtual_constraint
from biped_adrc.gait.reference import Reference
from biped_adrc.types import Array


class NPDParameters(NamedTuple):
    """h, and the gains with the choice of loop."""

    h: ConstraintParameters
    tracking: TrackingParameters


def npd_output(k: NPDParameters, s: Array, m: Measurement) -> Array:
    """u (p,) [N m] on a virtual constraint; s is empty."""
    return tracking_torque(k.tracking, virtual_constraint(k.h, m.q, m.v), measured(m), m.terms)


@dataclass(frozen=True)
class NPDController(Controller):
    """(28). solve_theta: solve the loop through Theta'' (default), or drop h' Theta'' as printed."""

    reference: Reference
    gains: Gains = TABLE_II
    solve_theta: bool = True

    def output(self, s: Array, m: Measurement) -> Array:
        k, r = self.gains.parameters(self.solve_theta), self.reference(m.t, m.q, m.v)
        return tracking_torque(k, r, measured(m), m.terms)

    @property
    def parameters(self) -> NPDParameters:
        """What the law `npd_output` needs. Raises InputError unless a virtual constraint is tracked."""
        return NPDParameters(
            constraint_parameters(self.reference), self.gains.parameters(self.solve_theta)
        )

    @property
    def laws(self) -> ControllerLaws | None:
        if type(self.reference) is not VirtualConstraint:
            return None
        return ControllerLaws(self.parameters, npd_output)
