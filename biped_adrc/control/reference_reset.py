"""Reference reset: after impact the constraint is bent to the state, so that the error is zero.

The impact leaves the state off a constraint h that is not hybrid invariant, or after a disturbance. With
the error and its slope just after impact,

    e = q_b - h(Theta),   e' = q_b' / Theta' - h'(Theta),

    c(Theta) = x^3 (a_0 + a_1 x),   x = (Theta_e - Theta) / (Theta_e - Theta+),   0 past Theta_e

is added to h, with a_0, a_1 from c = e and dc/dTheta = e' at that Theta. c reaches zero at Theta_e, after a
share of the step, with two derivatives, and the reference is h again. The zero set of the error becomes
invariant under the impact for any h; c does not depend on the speed, since the impact is linear in the
rates (Morris, Grizzle, IEEE TAC 54(8), 2009; Westervelt et al., Feedback Control of Dynamic Bipedal Robot
Locomotion, 2007, on transition controllers).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, partial
from typing import NamedTuple

import numpy as np

from biped_adrc.control.base import Measurement, measured
from biped_adrc.control.outer_loop import Constraint, OuterLoop, tracked_constraint
from biped_adrc.errors import InputError
from biped_adrc.gait.constraint import Correction
from biped_adrc.gait.reference import ReferencePoint
from biped_adrc.types import Array

LEAST_REACH = 0.2
"""Least x at impact: nearer to Theta_e, where c would have to fall abruptly, nothing is corrected."""


class ResetRange(NamedTuple):
    """end: Theta_e [rad]. rate: dx/dTheta = -1 / (Theta_e - Theta+) [1/rad], where x is 1 at Theta+."""

    end: float
    rate: float


class ResetParameters(NamedTuple):
    """range: where the correction ends. phase: the row c_q (n,) of Theta = c_q q."""

    range: ResetRange
    phase: Array


def reset_coefficients(k: ResetRange, theta: float, e: Array, slope: Array) -> Array:
    """a_0, a_1 (2, p) with c = e [rad] and dc/dTheta = slope [rad/rad] at theta."""
    x = k.rate * (theta - k.end)
    A, B = e / x**3, slope / (k.rate * x**2)
    return np.vstack((4.0 * A - B, (B - 3.0 * A) / x))


def reset_start(k: ResetParameters, r: ReferencePoint, m: Measurement) -> Array:
    """(a_0, a_1) flat (2 p,) for the reference r in force; zero where there is nothing to correct."""
    x = measured(m)
    theta, dtheta = float(k.phase @ m.q), float(k.phase @ m.v)
    reach = k.range.rate * (theta - k.range.end)
    if reach < LEAST_REACH or not dtheta * k.range.rate < 0.0:
        return np.zeros(2 * len(r.q_d))
    slope = (x.velocity - r.dq_d) / dtheta
    return reset_coefficients(k.range, theta, x.position - r.q_d, slope).ravel()


def reset_polynomial(k: ResetRange, a: Array, theta: float) -> tuple[Array, Array, Array]:
    """c, dc/dTheta, d2c/dTheta2 at theta [rad], each (p,), for the rows a_0, a_1 of a (2, p).

    All are zero past Theta_e, where x would be negative.
    """
    x = max(k.rate * (theta - k.end), 0.0)
    return (
        x**3 * (a[0] + a[1] * x),
        k.rate * x**2 * (3.0 * a[0] + 4.0 * a[1] * x),
        k.rate**2 * x * (6.0 * a[0] + 12.0 * a[1] * x),
    )


@dataclass(frozen=True)
class ReferenceReset(OuterLoop):
    """The correction above around `inner`; its state is (a_0, a_1).

    share: of the phase range after which the reference is h again, in (0, 1]. Nothing is corrected when an
    impact leaves x < LEAST_REACH, or Theta running backwards: then the error is the inner controller's.
    Raises InputError.
    """

    share: float = 0.5

    def __post_init__(self) -> None:
        super().__post_init__()
        if not 0.0 < self.share <= 1.0:
            raise InputError(
                f"the reference is reset over {self.share} of the step, expected a share in (0, 1]"
            )

    @cached_property
    def range(self) -> ResetRange:
        """Where the correction ends."""
        h = tracked_constraint(self.inner)
        reach = self.share * (h.theta_minus - h.theta_plus)
        return ResetRange(h.theta_plus + reach, -1.0 / reach)

    @cached_property
    def parameters(self) -> ResetParameters:
        """What the laws `reset_start` and `reset_polynomial` need."""
        return ResetParameters(self.range, tracked_constraint(self.inner).phase)

    @property
    def own_size(self) -> int:
        return 2 * tracked_constraint(self.inner).curve.coefficients.shape[0]

    def own_start(self, h: Constraint, m: Measurement) -> Array:
        return reset_start(self.parameters, h(m.t, m.q, m.v), m)

    def own_jump(self, w: Array, h: Constraint, after: Measurement) -> Array:
        return self.own_start(h, after)

    def correction(self, w: Array) -> Correction:
        return partial(reset_polynomial, self.range, w.reshape(2, -1))
