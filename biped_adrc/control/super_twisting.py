"""Super-twisting sliding mode about the reference: a continuous torque that rejects a disturbance exactly.

    sigma = e' + lambda e,   e = q_b - q_d
    u = kappa^-1 (q_d'' - lambda e' - k_1 |sigma|^(1/2) sign(sigma) + z - xi),   z' = -k_2 sign(sigma)

leaves sigma' = -k_1 |sigma|^(1/2) sign(sigma) + z + d for an error d [rad/s^2] of the model. With |d'| <= L and

    k_1 = 1.5 L^(1/2),   k_2 = 1.1 L

sigma and sigma' are zero after a finite time, and e falls like exp(-lambda t): Levant, Int. J. Control 58(6),
1993, and 76(9), 2003. A jump of d starts this anew.

Here the root and the sign are smooth within a layer delta [rad/s], which gives up the last of the accuracy:

    |sigma|^(1/2) sign(sigma)  ->  sigma / (|sigma| + delta)^(1/2),   sign(sigma)  ->  sigma / (|sigma| + delta)

and d is rejected as by an integral of gain k_2 / delta. In sampled time sigma cannot stay below k_2 T^2: with a
smaller delta the torque chatters from tick to tick by the order of kappa^-1 k_1 (k_2 T^2)^(1/2). A delta of a
few k_2 T^2 ends that.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from biped_adrc.control.base import Controller, ControllerLaws, Measurement, measured
from biped_adrc.control.tracking import solved_acceleration, tracked_laws
from biped_adrc.errors import check_positive
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.types import Array


class SuperTwistingParameters(NamedTuple):
    """The law's numbers.

    slope: lambda [1/s]; k_1 [rad^(1/2) / s^(3/2)]; k_2 [rad/s^3]; layer: delta [rad/s]; period [s], 1 in
    continuous time, where it is not used.
    """

    slope: float
    k_1: float
    k_2: float
    layer: float
    period: float


def sliding(k: SuperTwistingParameters, r: ReferencePoint, m: Measurement) -> tuple[Array, Array]:
    """sigma and e', each (p,) [rad/s]."""
    x = measured(m)
    de = x.velocity - r.dq_d
    return de + k.slope * (x.position - r.q_d), de


def twisting_torque(
    k: SuperTwistingParameters, r: ReferencePoint, s: Array, m: Measurement
) -> Array:
    """u (p,) [N m] for the state s = z (p,) [rad/s^2]."""
    sigma, de = sliding(k, r, m)
    f = s - k.slope * de - k.k_1 * sigma / np.sqrt(np.abs(sigma) + k.layer)
    return m.terms.kappa_inverse @ (solved_acceleration(r, m.terms, f) - m.terms.xi)


def twisting_start(k: SuperTwistingParameters, r: ReferencePoint, m: Measurement) -> Array:
    """z = 0 (p,) [rad/s^2] at the start: the model is taken to be right."""
    return np.zeros(len(r.q_d))


def twisting_flow(
    k: SuperTwistingParameters, r: ReferencePoint, s: Array, m: Measurement, u: Array
) -> Array:
    """z' (p,) [rad/s^3], of any torque u: z does not know of a limit, and winds up while one is reached."""
    sigma, _ = sliding(k, r, m)
    return -k.k_2 * sigma / (np.abs(sigma) + k.layer)


def twisting_predict(
    k: SuperTwistingParameters, r: ReferencePoint, s: Array, m: Measurement, u: Array
) -> Array:
    """z (p,) one period later."""
    return s + k.period * twisting_flow(k, r, s, m, u)


def twisting_jump(
    k: SuperTwistingParameters, r: ReferencePoint, s: Array, after: Measurement, swap: Array
) -> Array:
    """z (p,) after impact: what is wrong with the model belongs to a leg, and is relabelled by swap (p,)."""
    return s[swap]


@dataclass(frozen=True)
class SuperTwistingController(Controller):
    """The module's equations.

    slope: lambda [1/s] of the sliding surface. lipschitz: L [rad/s^3]. layer: delta [rad/s].
    period [s]: of the discrete form; set by `sampled`. Raises InputError for numbers that are not positive.
    """

    reference: Reference
    slope: float = 50.0
    lipschitz: float = 1e4
    layer: float = 0.05
    period: float | None = None

    def __post_init__(self) -> None:
        check_positive(self.slope, f"the slope of the sliding surface is {self.slope} 1/s")
        check_positive(self.lipschitz, f"the Lipschitz constant is {self.lipschitz} rad/s^3")
        check_positive(self.layer, f"the layer of the sliding mode is {self.layer} rad/s")

    @property
    def laws(self) -> ControllerLaws:
        k = SuperTwistingParameters(
            float(self.slope),
            1.5 * math.sqrt(self.lipschitz),
            1.1 * self.lipschitz,
            float(self.layer),
            1.0 if self.period is None else float(self.period),
        )
        own = ControllerLaws(k, twisting_torque, twisting_start, jump=twisting_jump)
        if self.period is None:
            return tracked_laws(self.reference, own._replace(flow=twisting_flow))
        return tracked_laws(self.reference, own._replace(predict=twisting_predict))

    def sampled(self, period: float) -> SuperTwistingController:
        return replace(self, period=period)
