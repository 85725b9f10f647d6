"""PI control of the walking speed from step to step.

At the k-th impact, with v* [m/s] the speed to keep, L the step length and T the duration of the step just
finished,

    e_k = v* - L / T,   I_k = I_(k-1) + e_k,   beta_(k+1) = K_P e_k + K_I I_k

and the constraint of the next step is h(Theta) + beta b(s) d (p,) [rad], with the phase Theta = c q, which runs
from Theta+ just after impact to Theta- at the next one, the direction d of the joints and the bump

    b(s) = 64 s^3 (1 - s)^3,   0 <= s <= 1,   s = (Theta - Theta+) / (Theta- - Theta+).

b vanishes with two derivatives at both ends, so a hybrid invariant constraint stays one, and the pose at impact
stays too: L is that of the gait. |beta| is bounded and K_I |I| with it (anti-windup). An inner loop of any kind
cannot reject what enters the zero dynamics; this PI acts on them. After Westervelt, Grizzle, Canudas de Wit,
Switching and PI control of walking motions of planar biped walkers, IEEE CDC 2003.

T is the value at impact of a state tau, tau' = 1, which is set to 0 after impact, so that the return map is a
function of the state and not of time. In sampled time T counts to the last sample instant.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.control.outer_loop import Constraint, OuterLoop, tracked_constraint
from biped_adrc.core.checks import Checked, FiniteFloat, PositiveFloat
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import derived
from biped_adrc.core.tree import chosen
from biped_adrc.core.types import Array
from biped_adrc.gait.constraint import Correction
from biped_adrc.gait.gait import Gait
from biped_adrc.model.biped import Biped

TORSO_LEAN = (1.0, 1.0, 0.0, 0.0)
"""d for RABBIT's joints: both hips turn, so that the legs stay where they were and the torso leans forwards by
beta in the middle of the step. To lean forwards and back again slows the walk: the gains are negative."""


@dataclass(frozen=True)
class Bump:
    """The correction c = shift b(s), which is added to the constraint h, for shift = beta d (p,) [rad]; b is 1
    at s = 1/2, and zero outside of [0, 1].

    theta_plus: Theta+ [rad]. rate: 1 / (Theta- - Theta+) [1/rad].
    """

    shift: Array
    theta_plus: float
    rate: float

    def __call__(self, theta: float) -> tuple[Array, Array, Array]:
        """c [rad] and its two derivatives by Theta at theta [rad], each (p,)."""
        s = self.rate * (theta - self.theta_plus)
        # b(s) = 64 w^3, with w = s (1 - s); w = 0 outside of [0, 1]
        w, dw = max(s * (1.0 - s), 0.0), 1.0 - 2.0 * s
        b, db, ddb = 64.0 * w**3, 192.0 * w**2 * dw, 384.0 * w * (dw**2 - w)
        return b * self.shift, self.rate * db * self.shift, self.rate**2 * ddb * self.shift


@dataclass(frozen=True)
class StrideGains(Checked):
    """Gains of the PI: K_P [rad s/m], K_I [rad s/m], and `limit`, the bound on |beta| [rad].

    `analysis.stride_gain` computes them from the response of the speed to beta. Raises InputError for gains
    that are not finite and a bound that is not positive.
    """

    K_P: FiniteFloat
    K_I: FiniteFloat
    limit: PositiveFloat = 0.3


class StrideState(NamedTuple):
    """State w of a `StridePI`."""

    tau: float
    """Time since the single support began [s]."""
    I: float  # noqa: E741
    """Sum of the speed's errors e_k [m/s]."""
    beta: float
    """Amplitude of the correction [rad]."""


@dataclass(frozen=True)
class StridePI(OuterLoop):
    """An outer loop, the PI on the walking speed around `inner`; its state is a
    `StrideState`. Make it with `on_gait`.

    inner: the controller that tracks the gait. speed [m/s]: v*. step_length [m]: L. direction (p,) [1]: d, by
    which joints bend. gains: K_P, K_I [rad s/m] and the bound [rad] of the PI. Raises InputError for a speed or
    length that is not positive, and for a direction that has not p finite numbers.

    >>> npd = ba.NPDController(gait.constraint)
    >>> gains = ba.stride_response(gait, biped).gains()
    >>> controller = ba.StridePI.on_gait(npd, gait, biped, gains, speed=0.82)
    >>> ba.walk(ba.Walker(biped, controller), gait, impacts=3).impacts
    3
    """

    speed: PositiveFloat
    step_length: PositiveFloat
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

    @classmethod
    def on_gait(
        cls,
        inner: Controller,
        gait: Gait,
        biped: Biped,
        gains: StrideGains,
        speed: float | None = None,
        direction: tuple[float, ...] = TORSO_LEAN,
    ) -> Self:
        """The PI around `inner` on a gait, with the gait's step length.

        speed [m/s]: v*, the gait's if None. direction (p,) [1]: d, by which the joints bend; by
        default the torso of RABBIT leans.
        """
        length = gait.step_length(biped)
        speed = length / gait.period if speed is None else speed
        return cls(inner, speed, length, direction, gains)

    def own_start(self, h: Constraint, m: Measurement) -> StrideState:
        # a run may begin within a step, and then with its time so far
        return StrideState(m.t_step, 0.0, 0.0)

    def own_flow(self, w: StrideState) -> StrideState:
        # in continuous time: tau' = 1, I and beta stay
        return StrideState(1.0, 0.0, 0.0)

    def own_correct(self, w: StrideState, m: Measurement) -> StrideState:
        # in sampled time: the time since the step began, in place of an integral
        return w._replace(tau=m.t_step)

    def own_jump(self, w: StrideState, h: Constraint, after: Measurement) -> StrideState:
        return self.stepped(w)

    def stepped(self, w: StrideState) -> StrideState:
        """w after an impact: I and beta by the PI on the speed of the step just finished, both bounded.

        With tau = 0, as when a run starts at the impact, no step has been timed and the state stays as it is.
        """
        # 1.0: no division by 0 where nothing was timed
        timed, k = w.tau > 0.0, self.gains
        e = self.speed - self.step_length / np.where(timed, w.tau, 1.0)
        I = np.minimum(np.maximum(w.I + e, -self.most_I), self.most_I)  # noqa: E741
        beta = np.minimum(np.maximum(k.K_P * e + k.K_I * I, -k.limit), k.limit)
        return chosen(timed, StrideState(0.0, I, beta), w)

    @derived
    def most_I(self) -> float:
        """Bound on |I| [m/s], such that |K_I I| has the bound of |beta|; infinite for K_I = 0."""
        return self.gains.limit / abs(self.gains.K_I) if self.gains.K_I else math.inf

    def correction(self, w: StrideState) -> Correction:
        h = tracked_constraint(self.inner)
        return Bump(w.beta * np.array(self.direction), h.theta_plus, h.rate)
