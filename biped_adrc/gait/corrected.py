"""A virtual constraint with a correction added to it.

    q_d   = h(Theta) + c(Theta)
    q_d'  = (h' + c') Theta'
    q_d'' = (h'' + c'') Theta'^2 + (h' + c') c_q q''

Theta = c_q q as in h; ' on h and c is d/dTheta. Corrections of corrections add up.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.types import Array

Correction = Callable[[float], tuple[Array, Array, Array]]
"""c, dc/dTheta, d2c/dTheta2 at Theta [rad], each (p,)."""


@dataclass(frozen=True)
class CorrectedConstraint(Reference):
    """base + correction, a function of the same phase."""

    base: VirtualConstraint | CorrectedConstraint
    correction: Correction

    @property
    def constraint(self) -> VirtualConstraint:
        """h, without any correction."""
        return self.base if isinstance(self.base, VirtualConstraint) else self.base.constraint

    def __call__(self, t: float, q: Array, v: Array) -> ReferencePoint:
        r, phase = self.base(t, q, v), self.constraint.phase
        rate = float(phase @ v)
        c, dc, ddc = self.correction(float(phase @ q))
        return ReferencePoint(
            r.q_d + c,
            r.dq_d + dc * rate,
            r.drift + ddc * rate**2,
            r.H + dc[:, np.newaxis] * phase,
        )
