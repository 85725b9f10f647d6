"""Reference reset: after impact the constraint is bent to the state, so that the tracking error is zero.

The constraint gives the angles of the p joints as q_d = h(Theta), with the phase Theta = c q, which runs from
Theta+ just after impact to Theta- at the next one. The impact leaves the state off h if h is not hybrid
invariant, or after a disturbance. With the error and its slope by Theta just after impact,

    e = q_b - h(Theta),   de/dTheta = q_b' / Theta' - dh/dTheta,

the polynomial

    c(Theta) = x^3 (a_0 + a_1 x),   x = (Theta_e - Theta) / (Theta_e - Theta+),   0 past Theta_e

is added to h (x = 1 at Theta+, 0 at Theta_e), with a_0, a_1 from c = e and dc/dTheta = de/dTheta at that Theta.
c and two of its derivatives reach zero at Theta_e, after a share of the step; from there on the reference is h
again. The zero set of the error becomes invariant under the impact for any h; c does not depend on the speed,
since the impact is linear in the rates (Morris, Grizzle, IEEE TAC 54(8), 2009; Westervelt et al., Feedback
Control of Dynamic Bipedal Robot Locomotion, 2007, on transition controllers).
"""

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from biped_adrc.control.base import Measurement
from biped_adrc.control.outer_loop import Constraint, OuterLoop, tracked_constraint
from biped_adrc.core.checks import Range
from biped_adrc.core.part import derived
from biped_adrc.core.types import Array
from biped_adrc.gait.constraint import Correction

LEAST_REACH = 0.2
"""Least x just after impact for which a correction is made; nearer to Theta_e c would have to fall abruptly."""


@dataclass(frozen=True)
class ResetPolynomial:
    """The correction c(Theta) with the coefficients a = (a_0, a_1) (2, p) [rad].

    end: Theta_e [rad]. rate: dx/dTheta = -1 / (Theta_e - Theta+) [1/rad], where x is 1 at Theta+.
    """

    a: Array
    end: float
    rate: float

    def __call__(self, theta: float) -> tuple[Array, Array, Array]:
        """c [rad], dc/dTheta, d2c/dTheta2 at theta [rad], each (p,); all are zero past Theta_e."""
        x, (a_0, a_1) = max(self.rate * (theta - self.end), 0.0), self.a
        return (
            x**3 * (a_0 + a_1 * x),
            self.rate * x**2 * (3.0 * a_0 + 4.0 * a_1 * x),
            self.rate**2 * x * (6.0 * a_0 + 12.0 * a_1 * x),
        )


def reset_coefficients(x: Array | float, rate: float, e: Array, slope: Array) -> Array:
    """Coefficients a_0, a_1 (2, p) [rad] of the correction c with c = e and dc/dTheta = slope at this x.

    x [1]: a number, also as an array without axes. rate: dx/dTheta [1/rad]. e (p,) [rad]. slope (p,) [rad/rad].
    """
    # a_0 + a_1 x = A and 3 a_0 + 4 a_1 x = B
    A, B = e / x**3, slope / (rate * x**2)
    return np.vstack((4.0 * A - B, (B - 3.0 * A) / x))


@dataclass(frozen=True)
class ReferenceReset(OuterLoop):
    """An outer loop that bends the constraint of `inner` to the state after each
    impact; its state is (a_0, a_1).

    inner: the controller that tracks the constraint. share [1]: of the phase range after which the reference is
    h again, in (0, 1]. Nothing is corrected when an impact leaves x < 0.2, or Theta running backwards:
    then the error is the inner controller's. Raises InputError for another share.

    >>> controller = ba.ReferenceReset(ba.NPDController(gait.constraint), share=0.4)
    >>> ba.walk(ba.Walker(biped, controller), gait, impacts=1).impacts
    1
    """

    share: Annotated[float, Range("a share in (0, 1]", lambda x: 0.0 < x <= 1.0)] = 0.5

    @derived
    def range(self) -> tuple[float, float]:
        """Theta_e [rad], where the correction ends, and dx/dTheta [1/rad]."""
        h = tracked_constraint(self.inner)
        reach = self.share * (h.theta_minus - h.theta_plus)
        return h.theta_plus + reach, -1.0 / reach

    def own_start(self, h: Constraint, m: Measurement) -> Array:
        """(a_0, a_1) (2, p) [rad], by which h is bent to the state in m; h: the reference with the corrections
        of loops further inside. Zero where nothing is corrected.
        """
        r, c, (end, rate) = h(m.t, m.q, m.v), tracked_constraint(self.inner).phase, self.range
        dtheta, x = c @ m.v, rate * (c @ m.q - end)
        # Theta runs forwards if x falls; the values 1.0 below avoid a division by 0 where nothing is corrected
        # LEAST_REACH: nearer to Theta_e the correction would have to fall abruptly
        bends = (x >= LEAST_REACH) * (dtheta * rate < 0.0)
        slope = (m.v_b - r.dq_d) / np.where(bends, dtheta, 1.0)
        a = reset_coefficients(np.where(bends, x, 1.0), rate, m.q_b - r.q_d, slope)
        return np.where(bends, a, 0.0)

    def correction(self, w: Array) -> Correction:
        return ResetPolynomial(w, *self.range)
