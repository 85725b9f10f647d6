"""The virtual holonomic constraint of section IV: q_d = h(Theta(q)).

    Theta = c q,   s = (Theta - Theta+) / (Theta- - Theta+)
    q_d   = h(Theta)
    q_d'  = h' Theta'
    q_d'' = h'' Theta'^2 + h' c q''

Theta+ is the phase just after impact, Theta- just before the next one; ' on h is d/dTheta.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.errors import GaitError
from biped_adrc.gait.curves import Curve, CurveParameters, curve
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.types import Array


class ConstraintParameters(NamedTuple):
    """Curve, row c (n,), Theta+ [rad] and 1 / (Theta- - Theta+) [1/rad]."""

    curve: CurveParameters
    c: Array
    theta_plus: float
    rate: float


def virtual_constraint(k: ConstraintParameters, q: Array, v: Array) -> ReferencePoint:
    """The reference at (q, v)."""
    theta, dtheta = float(k.c @ q), float(k.c @ v)
    h, dh, ddh = curve(k.curve, k.rate * (theta - k.theta_plus))
    slope = k.rate * dh
    return ReferencePoint(
        h, slope * dtheta, (k.rate * dtheta) ** 2 * ddh, slope[:, np.newaxis] * k.c
    )


@dataclass(frozen=True)
class VirtualConstraint(Reference):
    """h over the phase c q from theta_plus to theta_minus [rad]."""

    curve: Curve
    phase: Array
    theta_plus: float
    theta_minus: float

    def __post_init__(self) -> None:
        c = np.array(self.phase, dtype=float)
        span = self.theta_minus - self.theta_plus
        if not np.all(np.isfinite(c)) or not np.isfinite(span) or span == 0.0:
            raise GaitError(
                f"phase row {c} from {self.theta_plus} to {self.theta_minus} rad; expected finite numbers "
                "and two different ends"
            )
        c.setflags(write=False)
        object.__setattr__(self, "phase", c)
        object.__setattr__(
            self,
            "_parameters",
            ConstraintParameters(
                self.curve.parameters, c, float(self.theta_plus), float(1.0 / span)
            ),
        )

    @property
    def parameters(self) -> ConstraintParameters:
        """What the law `virtual_constraint` needs."""
        k: ConstraintParameters = self._parameters  # type: ignore[attr-defined]
        return k

    def __call__(self, t: float, q: Array, v: Array) -> ReferencePoint:
        return virtual_constraint(self.parameters, q, v)

    def h(self, theta: float) -> tuple[Array, Array, Array]:
        """h, dh/dTheta, d2h/dTheta2 at theta [rad], each (p,)."""
        k = self.parameters
        h, dh, ddh = curve(k.curve, k.rate * (theta - k.theta_plus))
        return h, k.rate * dh, k.rate**2 * ddh
