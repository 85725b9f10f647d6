"""Wrappers around any controller for time delays: its torque acts late, or it predicts over a delay.

*Delayed*, in continuous time: the torque acts `delay` seconds late.

    u(t) = u_c(t - d),   exp(-s d) ~ N(s d) / D(s d)     u_c: the command, s: Laplace's variable

by the Pade approximant with a numerator one degree lower than the denominator of degree k = `order`:

    N(x) = sum_(j<k)  binom(k-1, j) (-x)^j / P_j
    D(x) = sum_(j<=k) binom(k, j)     x^j  / P_j,       P_j = (2k-1) (2k-2) .. (2k-j),  P_0 = 1

Its error is of order (w d)^(2k) at the frequency w [rad/s]. The approximant with k in both degrees has one
order more, but its gain at high frequency is +-1: a part of the command would act at once, for odd k with the
wrong sign, and a torque that depends on itself would have to be solved for. The approximant used here has no
direct feedthrough. Each joint has the states R (k,); ' is d/dt:

    d R_i' = R_(i+1),   d R_k' = (u_c - sum_j D_j R_(j+1)) / D_k,   u = sum_j N_j R_(j+1)

With an unknown delay the inner observer is fed with the command, as if it acted at once; with a known delay,
with the torque that acts. At impact the legs swap in the delay line as in the controller. The torque limit of
the plant (`torque_limit` of a Walker) acts behind the delay line. A limit of the drives (`torque_limit` of this
wrapper) acts before it; with an unknown delay the observer is then fed with the limited command.

*Prediction* over a known delay, in sampled time: the controller gets the state at which its torque will act.
A *tick* is a sample instant, (q, v) the measured angles and rates (n,), and a(u) the acceleration q'' (n,) by
the nominal model under the torque u, with inertia matrix D_s and Coriolis and gravity terms Omega; B_s u is u
in the rows of the joints with motors.

    q^ = q + d v + d^2/2 a(u_q),   v^ = v + d a(u_v)          D_s a + Omega = B_s u at (q, v)

u_v is the mean of the torques that act from now, t, until t + d, and u_q their mean with the weight 2 (t + d -
tau) / d^2 at the instant tau. Both are exact if q'' depends on time through the torque alone. The torque
computed at a tick acts d later. So the torques on their way are the last K = ceil(d / T), with T the period of
the ticks; they are a state U (K, p) beside that of the controller inside. Each acts for a period T, but the
oldest one only for the remaining d - (K - 1) T.

The controller inside gets the nominal model at (q^, v^), t + d, and the torque of this tick: for its observer
there is no delay. `SampledTime(delay_known=True)` shifts the torque instead and leaves the state as it is
measured; with both the delay would count twice, so use this wrapper with delay_known=False. After an early
tick, at an impact, torques act sooner than assumed here.

d is the delay to predict: that of `SampledTime`, or half a period more for the hold between ticks. It has to
be positive: without a delay this wrapper is left out.
"""

import math
from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar, NamedTuple, Self

import numpy as np

from biped_adrc.control.around import Around
from biped_adrc.control.base import Measurement
from biped_adrc.core.checks import PositiveFloat, Range
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import derived
from biped_adrc.core.timing import LONGEST_DELAY, WHOLE
from biped_adrc.core.types import Array, Indices, relabelled
from biped_adrc.observers.base import Estimate


class DelayState(NamedTuple):
    """State of a `Delayed`."""

    inner: Any
    """State of the controller inside."""
    R: Array
    """States of the delay line (k, p) [N m]."""


class QueueState(NamedTuple):
    """State of a `Predicted`."""

    inner: Any
    """State of the controller inside."""
    U: Array
    """Torques on their way (K, p) [N m], the oldest first."""


@dataclass(frozen=True)
class Delayed(Around):
    """A wrapper whose torque acts `delay` [s] after the command of `inner`, by a Pade approximant.

    order: k, 1 to 10; above 10 the coefficients cover more than ten decades, and the approximation gets no
    better. known: whether the observer inside is fed with the torque that acts, else with the command.
    torque_limit [N m]: bound on the command, before the delay. It compiles around every controller that
    compiles in continuous time. Raises InputError for numbers out of range.
    """

    # none: `ImpactInvariant`, which uses this, goes inside
    reads_impulse: ClassVar[tuple[str, ...]] = ()

    delay: PositiveFloat
    order: Annotated[int, Range("a whole number from 1 to 10", lambda x: x in range(1, 11))] = 4
    known: bool = False
    torque_limit: PositiveFloat | None = None

    @derived
    def pade(self) -> tuple[Array, Array]:
        """N (k,) and D (k + 1,) of N(x) / D(x) ~ exp(-x), x = s d, lowest power first; D_0 = N_0 = 1."""
        k = self.order
        P = [math.perm(2 * k - 1, j) for j in range(k + 1)]
        N = [(-1) ** j * math.comb(k - 1, j) / P[j] for j in range(k)]
        D = [math.comb(k, j) / P[j] for j in range(k + 1)]
        return np.array(N), np.array(D)

    @derived
    def limit(self) -> float:
        """The drives' own limit [N m], infinite for none."""
        return math.inf if self.torque_limit is None else float(self.torque_limit)

    def asked(self, z: Any, m: Measurement) -> Array:
        """The command (p,) [N m] that enters the delay line: that of `inner` in its state z, within the drives'
        own limit.
        """
        u = self.inner.output(z, m)
        return np.minimum(np.maximum(u, -self.limit), self.limit)

    def output(self, s: Any, m: Measurement) -> Array:
        """The torque u (p,) [N m] that leaves the delay line; it does not depend on m, but on R alone."""
        return self.pade[0] @ s.R  # of (N, D) the row N

    def initial_state(self, m: Measurement) -> Any:
        """The inner state at the start, and R (k, p) at rest under its command, as if it had always been so."""
        z = self.inner.initial_state(m)
        u = self.asked(z, m)
        R = np.zeros((self.order, len(u)))
        # at rest, R' = 0: D_0 R_1 = u, and all further rows are 0; N_0 R_1 = u then leaves the line
        R[0] = u / self.pade[1][0]
        return DelayState(z, R)

    def flow(self, s: Any, m: Measurement, u: Array) -> Any:
        """z' and R' of the module; the inner controller is fed with u, or with the command if not `known`."""
        (z, R), (_, D), rate = s, self.pade, 1.0 / self.delay
        asked = self.asked(z, m)
        dz = self.inner.flow(z, m, u if self.known else asked)
        dR = np.zeros(R.shape)
        dR[:-1] = rate * R[1:]
        dR[-1] = rate * (asked - D[:-1] @ R) / D[-1]
        return DelayState(dz, dR)

    def jump(self, s: Any, after: Measurement, swap: Indices) -> Any:
        return DelayState(self.inner.jump(s.inner, after, swap), relabelled(s.R, swap))

    def estimate(self, s: Any, m: Measurement) -> Estimate | None:
        return self.inner.estimate(s.inner, m)

    def sampled(self, period: float) -> Self:
        raise InputError(
            "Delayed works in continuous time; in sampled time the delay is the clock's: "
            "SampledTime(period, delay=...) around the controller inside"
        )


@dataclass(frozen=True)
class Predicted(Around):
    """A wrapper that predicts the state over d = `prediction` [s] for `inner`; its state is a `QueueState`.

    period [s]: T of the ticks, which `sampled` sets; None until then.
    Raises InputError for d that is not positive, or longer than 100 periods.
    """

    # none: `ImpactInvariant`, which uses this, goes inside
    reads_impulse: ClassVar[tuple[str, ...]] = ()

    prediction: float
    period: float | None = None

    def __post_init__(self) -> None:
        longest = math.inf if self.period is None else LONGEST_DELAY * self.period
        if not (math.isfinite(self.prediction) and 0.0 < self.prediction <= longest):
            raise InputError(
                f"the prediction is over {self.prediction} s, expected a positive time of at most "
                f"{LONGEST_DELAY} periods; leave it out for none"
            )

    @derived
    def weights(self) -> tuple[Array, Array]:
        """Weights of the K torques on their way in the means u_v and u_q, each (K,), the oldest first; K =
        ceil(d / T), so K = 1 for d <= T."""
        # before `sampled` sets the period there is one torque on its way
        d, T = self.prediction, self.period or self.prediction
        # WHOLE, 1e-9 of a period: a delay longer than whole periods by round-off alone needs no torque more
        count = math.ceil(d / T - WHOLE)
        # [s], from the first instant at which each torque acts, now for the oldest one, to t + d
        left = np.minimum(np.arange(count, 0, -1) * T, d)
        after = np.append(left[1:], 0.0)  # [s], from the end of its action to t + d
        # the integrals of the weights 1 / d and 2 (t + d - tau) / d^2 over the action of each torque
        return (left - after) / d, (left**2 - after**2) / d**2

    def ahead(self, U: Array, m: Measurement) -> Measurement:
        """The measurement d later, predicted by the nominal model under the torques U (K, p) [N m].

        Its `t` is d later too; `step` and `t_step` remain those of m.
        """

        def acceleration(u: Array) -> Array:
            # of the joints with motors, q_b'' = kappa u + xi, then of the others, q_N'' = A_N q_b'' + a_N
            a = m.terms.kappa @ u + m.terms.xi
            return np.concatenate((a, m.terms.A_N @ a + m.terms.a_N))

        d, (of_rate, of_angle) = self.prediction, self.weights
        # (p,) a weighted mean of the torques, (n,) the acceleration under it
        a_q, a_v = acceleration(of_angle @ U), acceleration(of_rate @ U)
        # elsewhere(q, v): the measurement in that state, with the model's terms there
        assert m.elsewhere is not None
        q, v = m.q + d * m.v + 0.5 * d**2 * a_q, m.v + d * a_v
        return m.elsewhere(q, v)._replace(t=m.t + d)

    def output(self, s: Any, m: Measurement) -> Array:
        return self.inner.output(s.inner, self.ahead(s.U, m))

    def initial_state(self, m: Measurement) -> Any:
        """The inner state at the predicted start, and U = 0: no torque is on its way."""
        U = np.zeros((len(self.weights[0]), m.terms.kappa.shape[0]))
        return QueueState(self.inner.initial_state(self.ahead(U, m)), U)

    def jump(self, s: Any, after: Measurement, swap: Indices) -> Any:
        """The state after impact: the torques on their way were computed before it, and are relabelled."""
        U = relabelled(s.U, swap)
        # ahead: the measurement d later, predicted under the torques U
        return QueueState(self.inner.jump(s.inner, self.ahead(U, after), swap), U)

    def correct(self, s: Any, m: Measurement) -> Any:
        return s._replace(inner=self.inner.correct(s.inner, self.ahead(s.U, m)))

    def predict(self, s: Any, m: Measurement, u: Array) -> Any:
        """The inner state at the next tick under u, and U without its oldest torque but with u (p,) [N m]."""
        z = self.inner.predict(s.inner, self.ahead(s.U, m), u)
        return QueueState(z, np.concatenate((s.U[1:], u[np.newaxis])))

    def estimate(self, s: Any, m: Measurement) -> Estimate | None:
        return self.inner.estimate(s.inner, self.ahead(s.U, m))

    def sampled(self, period: float) -> Self:
        return replace(self, inner=self.inner.sampled(period), period=period)
