"""Prediction over a known delay around any controller, which gets the state at which its torque will act.

    q^ = q + d v + d^2/2 a(u_q),   v^ = v + d a(u_v)          a(u): D_s a + Omega = B_s u at (q, v)

u_v is the mean of the torques that act until t + d, and u_q their mean with the weight 2 (t + d - s) / d^2 at
the instant s. With q'' constant but for the torque, both are exact. The torque computed at a tick acts d
later, so those on their way are the last N = ceil(d / T), which are a state U (N, p) behind that of the
controller inside: all act for a period T but the oldest, for d - (N - 1) T.

The controller inside gets the nominal model at (q^, v^), t + d, and the torque of this tick: for its observer
there is no delay. `SampledTime(delay_known=True)` shifts the torque instead and leaves the state as it is
measured; with both the delay would count twice, so use this wrapper with delay_known=False. After an early
tick, at an impact, torques act sooner than assumed here.

d is the delay to predict: that of the clock, or more, as half a period for the hold. d = 0 is the
controller inside, bit for bit.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from biped_adrc.control.around import Around
from biped_adrc.control.base import Controller, Measurement
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import derived
from biped_adrc.core.timing import LONGEST_DELAY, WHOLE
from biped_adrc.core.types import Array, Indices, relabelled
from biped_adrc.observers.base import Estimate


def weights(d: float, period: float) -> tuple[Array, Array]:
    """Weights (N,) of the torques on their way in the means u_v and u_q, the oldest first; empty for d = 0.

    d [s]: the delay. period [s]: of the ticks.
    """
    count = math.ceil(d / period - WHOLE)
    # from the torque's first instant to t + d
    left = np.minimum(np.arange(count, 0, -1) * period, d)
    after = np.append(left[1:], 0.0)
    return (left - after) / d, (left**2 - after**2) / d**2


@dataclass(frozen=True)
class Predicted(Around):
    """A wrapper that predicts the state over d = `prediction` [s] for `inner`; period [s]: set by `sampled`.

    Raises InputError for d that is not positive, or longer than `timing.LONGEST_DELAY` periods.
    """

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
        """Weights of the N torques on their way in the means u_v and u_q, each (N,); see `weights`."""
        return weights(self.prediction, self.period or self.prediction)

    def parts(self, s: Array, m: Measurement) -> tuple[Array, Array]:
        """Split the state s into that of the controller inside, and the torques on their way U (N, p) [N m]."""
        count, p = len(self.weights[0]), m.terms.kappa.shape[0]
        end = len(s) - count * p
        return s[:end], s[end:].reshape(count, p)

    def ahead(self, U: Array, m: Measurement) -> Measurement:
        """The measurement d later, predicted by the nominal model under the torques U (N, p) [N m].

        Raises InputError for a controller that was not made for sampled time.
        """

        def acceleration(u: Array) -> Array:
            a = m.terms.kappa @ u + m.terms.xi
            return np.concatenate((a, m.terms.A_N @ a + m.terms.a_N))

        d, (of_rate, of_angle) = self.prediction, self.weights
        a_q, a_v = acceleration(of_angle @ U), acceleration(of_rate @ U)
        assert m.elsewhere is not None
        q, v = m.q + d * m.v + 0.5 * d**2 * a_q, m.v + d * a_v
        return m.elsewhere(q, v)._replace(t=m.t + d)

    def output(self, s: Array, m: Measurement) -> Array:
        z, U = self.parts(s, m)
        return self.inner.output(z, self.ahead(U, m))

    projected_output, projected_correct = Controller.projected_output, Controller.projected_correct

    def initial_state(self, m: Measurement) -> Array:
        U = np.zeros((len(self.weights[0]), m.terms.kappa.shape[0]))
        return np.concatenate((self.inner.initial_state(self.ahead(U, m)), U.ravel()))

    def jump(self, s: Array, after: Measurement, swap: Indices) -> Array:
        z, U = self.parts(s, after)
        U = relabelled(U, swap)
        return np.concatenate((self.inner.jump(z, self.ahead(U, after), swap), U.ravel()))

    def correct(self, s: Array, m: Measurement) -> Array:
        z, U = self.parts(s, m)
        return np.concatenate((self.inner.correct(z, self.ahead(U, m)), U.ravel()))

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        z, U = self.parts(s, m)
        return np.concatenate((self.inner.predict(z, self.ahead(U, m), u), U[1:].ravel(), u))

    def estimate(self, s: Array, m: Measurement) -> Estimate | None:
        z, U = self.parts(s, m)
        return self.inner.estimate(z, self.ahead(U, m))

    def sampled(self, period: float) -> Self:
        return replace(self, inner=self.inner.sampled(period), period=period)

    def continuous(self) -> Self:
        self._only_sampled()
