"""PI control of the walking speed from step to step.

At the k-th impact, with L the step length and T the duration of the step just finished,

    e_k = v* - L / T,   I_k = I_(k-1) + e_k,   beta_(k+1) = K_P e_k + K_I I_k

and the constraint of the next step is h(Theta) + beta b(s) d, with the direction d of the joints and the bump

    b(s) = 64 s^3 (1 - s)^3,   0 <= s <= 1,   s = (Theta - Theta+) / (Theta- - Theta+).

b vanishes with two derivatives at both ends, so a hybrid invariant constraint stays one, and so does the
pose at impact: L is that of the gait. |beta| is bounded and K_I |I| with it (anti-windup). After
Westervelt, Grizzle, Canudas de Wit, IEEE CDC 2003, Switching and PI control of walking motions of planar biped
walkers, where an inner loop of any kind cannot reject what enters the zero dynamics.

T is a state, tau' = 1 with tau+ = 0, so that the return map is a function of the state. In sampled time T
counts to the last tick.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, partial
from typing import NamedTuple

import numpy as np

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.control.outer_loop import Constraint, OuterLoop, tracked_constraint
from biped_adrc.errors import InputError, check_positive
from biped_adrc.gait.constraint import Correction
from biped_adrc.gait.gait import Gait
from biped_adrc.model.biped import Biped
from biped_adrc.types import Array

TORSO_LEAN = (1.0, 1.0, 0.0, 0.0)
"""d for RABBIT's joints: both hips turn, so that the legs stay where they were and the torso leans forwards by
beta in the middle of the step. A lean forwards and back slows the walk: its gains are negative."""


def bump(s: float) -> tuple[float, float, float]:
    """b, db/ds, d2b/ds2 at s, all zero outside of [0, 1]; b = 1 in the middle of the step."""
    w, dw = max(s * (1.0 - s), 0.0), 1.0 - 2.0 * s
    return 64.0 * w**3, 192.0 * w**2 * dw, 384.0 * w * (dw**2 - w)


class StrideParameters(NamedTuple):
    """v* [m/s], L [m], d (p,), K_P, K_I [rad s/m], bounds on |beta| [rad] and |I| [m/s], Theta+ [rad] and
    1 / (Theta- - Theta+) [1/rad]."""

    speed: float
    step_length: float
    direction: Array
    K_P: float
    K_I: float
    most_beta: float
    most_I: float
    theta_plus: float
    rate: float


def stride_correction(k: StrideParameters, w: Array, theta: float) -> tuple[Array, Array, Array]:
    """beta b d and its two derivatives by Theta, each (p,), for w = (tau, I, beta)."""
    b, db, ddb = bump(k.rate * (theta - k.theta_plus))
    shift = w[2] * k.direction
    return b * shift, k.rate * db * shift, k.rate**2 * ddb * shift


def stride_jump(k: StrideParameters, w: Array) -> Array:
    """w = (tau, I, beta) (3,) after impact: the PI of the module's equation, with both bounds.

    One at tau = 0, as when a run starts with it, has timed no step and changes nothing.
    """
    if not w[0] > 0.0:
        return w.copy()
    e = k.speed - k.step_length / w[0]
    integral = min(max(w[1] + e, -k.most_I), k.most_I)
    beta = k.K_P * e + k.K_I * integral
    return np.array((0.0, integral, min(max(beta, -k.most_beta), k.most_beta)))


@dataclass(frozen=True)
class StrideGains:
    """K_P [rad s/m], K_I [rad s/m], and `limit`, the bound on |beta| [rad].

    `analysis.stride_gain` finds them from how the speed answers to beta. Raises InputError for gains that are
    not finite and a bound that is not positive.
    """

    K_P: float
    K_I: float
    limit: float = 0.3

    def __post_init__(self) -> None:
        if not (math.isfinite(self.K_P) and math.isfinite(self.K_I)):
            raise InputError(
                f"stride gains are K_P = {self.K_P}, K_I = {self.K_I} rad s/m, expected finite numbers"
            )
        check_positive(self.limit, f"the bound on beta is {self.limit} rad")


@dataclass(frozen=True)
class StridePI(OuterLoop):
    """The PI above around `inner`; its state is (tau, I, beta). Make it with `on_gait`.

    speed: v* [m/s]. step_length: L [m]. direction: d (p,). Raises InputError for a speed or length that is not
    positive, and for a direction that has not p finite numbers.
    """

    speed: float
    step_length: float
    direction: tuple[float, ...]
    gains: StrideGains

    def __post_init__(self) -> None:
        super().__post_init__()
        p = tracked_constraint(self.inner).curve.coefficients.shape[0]
        if len(self.direction) != p or not np.all(np.isfinite(self.direction)):
            raise InputError(
                f"the direction of the stride's correction is {self.direction}, expected {p} finite "
                "numbers, one per motor"
            )
        for name, value, unit in (("speed", self.speed, "m/s"), ("length", self.step_length, "m")):
            if not (math.isfinite(value) and value > 0):
                raise InputError(f"the stride's {name} is {value} {unit}, expected > 0")

    @classmethod
    def on_gait(
        cls,
        inner: Controller,
        gait: Gait,
        biped: Biped,
        gains: StrideGains,
        speed: float | None = None,
        direction: tuple[float, ...] = TORSO_LEAN,
    ) -> StridePI:
        """Around `inner` on a gait, with its step length, and its speed unless another is given [m/s]."""
        length = float(np.hypot(*biped.swing_foot(gait.q_minus)))
        return cls(
            inner, length / gait.period if speed is None else speed, length, direction, gains
        )

    @property
    def own_size(self) -> int:
        return 3

    def own_start(self, h: Constraint, m: Measurement) -> Array:
        return np.array((m.t_step, 0.0, 0.0))

    def own_flow(self, w: Array) -> Array:
        return np.array((1.0, 0.0, 0.0))

    def own_correct(self, w: Array, m: Measurement) -> Array:
        return np.array((m.t_step, w[1], w[2]))

    def own_jump(self, w: Array, h: Constraint, after: Measurement) -> Array:
        return stride_jump(self.parameters, w)

    @cached_property
    def parameters(self) -> StrideParameters:
        """What the laws `stride_correction` and `stride_jump` need."""
        h, k = tracked_constraint(self.inner), self.gains
        return StrideParameters(
            float(self.speed),
            float(self.step_length),
            np.array(self.direction, dtype=float),
            float(k.K_P),
            float(k.K_I),
            float(k.limit),
            k.limit / abs(k.K_I) if k.K_I else math.inf,
            h.theta_plus,
            h.rate,
        )

    def correction(self, w: Array) -> Correction:
        return partial(stride_correction, self.parameters, w)
