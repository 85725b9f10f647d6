"""A virtual constraint with a correction added to it.

    q_d   = h(Theta) + c(Theta)
    q_d'  = (h' + c') Theta'
    q_d'' = (h'' + c'') Theta'^2 + (h' + c') c_q q''

Theta = c_q q as in h; ' on h and c is d/dTheta. Corrections of corrections add up.
"""

from __future__ import annotations

import math
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


FADE = 0.01
"""Share of the phase range over which the curvature fades out past an end."""


def continued(h: VirtualConstraint) -> CorrectedConstraint:
    """h between Theta+ and Theta-, and outside, at a distance y past an end with h_0, h_0', h_0'' there,

        h_0 + h_0' y + h_0'' (l y - l^2 (1 - exp(-y / l))):

    two derivatives agree, and the curvature fades out over l = FADE (Theta- - Theta+). A polynomial leaves its
    range steeply; a step that ends late, as on lower ground, needs this.
    """
    least, most = sorted((h.theta_plus, h.theta_minus))
    reach = FADE * (most - least)

    def correction(theta: float) -> tuple[Array, Array, Array]:
        a, da, dda = h.h(theta)
        end = min(max(theta, least), most)
        if end == theta:
            return np.zeros_like(a), np.zeros_like(a), np.zeros_like(a)
        b, db, ddb = h.h(end)
        y = theta - end
        l = math.copysign(reach, y)  # noqa: E741
        left = math.exp(-y / l)
        fading = l * y - l**2 * (1.0 - left), l * (1.0 - left), left
        return b + db * y + ddb * fading[0] - a, db + ddb * fading[1] - da, ddb * fading[2] - dda

    return CorrectedConstraint(h, correction)
