"""Prediction over a known delay around any controller: it is shown the state at which its torque will act.

    q^ = q + d v + d^2/2 a(u_q),   v^ = v + d a(u_v)          a(u): D_s a + Omega = B_s u at (q, v)

u_v is the mean of the torques that act until t + d, and u_q their mean with the weight 2 (t + d - s) / d^2 at
the instant s. With q'' constant but for the torque, both are exact. The torque that is asked for at a tick
acts d later, so those on their way are the last N = ceil(d / T), which are a state U (N, p) behind that of the
controller inside: all act for a period T but the oldest, for d - (N - 1) T.

The controller inside is given the nominal model at (q^, v^), t + d, and the torque of this tick: for its
observer there is no delay. `SampledTime(delay_known=True)` shifts the torque instead and leaves the state as
it is measured; with both the delay would count twice, so this is around a controller that is not told of it.
After an early tick, at an impact, torques act sooner than is reckoned here.

d is what is to be predicted: the delay of the clock, or more, as half a period for the hold. d = 0 is the
controller inside, bit for bit.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple, Self

import numpy as np

from biped_adrc.control.around import Around, AroundParameters, filled, tick_laws
from biped_adrc.control.base import ControllerLaws, Measurement
from biped_adrc.errors import InputError
from biped_adrc.observers.base import Estimate
from biped_adrc.timing import LONGEST_DELAY
from biped_adrc.types import Array

WHOLE = 1e-9
"""A prediction that is longer than whole periods by less than this fraction of one is of whole periods."""


class PredictionParameters(NamedTuple):
    """d [s], and the weights of U's rows in u_v and u_q, each (N,) with the sum 1."""

    d: float
    of_rate: Array
    of_angle: Array


def weights(d: float, period: float) -> tuple[Array, Array]:
    """The weights (N,) in u_v and u_q of the torques on their way, the oldest first; empty for d = 0."""
    count = math.ceil(d / period - WHOLE)
    left = np.minimum(
        np.arange(count, 0, -1) * period, d
    )  # from the torque's first instant to t + d
    after = np.append(left[1:], 0.0)
    return (left - after) / d, (left**2 - after**2) / d**2


def ahead(k: PredictionParameters, U: Array, m: Measurement) -> Measurement:
    """The measurement d later, of the nominal model under the torques U (N, p) [N m]."""

    def acceleration(u: Array) -> Array:
        a = m.terms.kappa @ u + m.terms.xi
        return np.concatenate((a, m.terms.A_N @ a + m.terms.a_N))

    a_q, a_v = acceleration(k.of_angle @ U), acceleration(k.of_rate @ U)
    assert m.elsewhere is not None
    q, v = m.q + k.d * m.v + 0.5 * k.d**2 * a_q, m.v + k.d * a_v
    return m.elsewhere(q, v)._replace(t=m.t + k.d)


@lru_cache(maxsize=64)
def predicting(inner: ControllerLaws) -> ControllerLaws:
    """The laws of `Predicted` around these."""
    start, jumped, corrected, predicted = tick_laws(inner)
    told = inner.estimate

    def parts(k: AroundParameters, s: Array, p: int) -> tuple[Array, Array]:
        """The inner state, and U (N, p)."""
        count = len(k.own.of_rate)
        end = len(s) - count * p
        return s[:end], s[end:].reshape(count, p)

    def of(k: AroundParameters, s: Array, m: Measurement) -> tuple[Array, Array, Measurement]:
        z, U = parts(k, s, m.terms.kappa.shape[0])
        return z, U, ahead(k.own, U, m)

    def output(k: AroundParameters, s: Array, m: Measurement) -> Array:
        z, _, m = of(k, s, m)
        return inner.output(k.inner, z, m)

    def initial_state(k: AroundParameters, m: Measurement) -> Array:
        U = np.zeros((len(k.own.of_rate), m.terms.kappa.shape[0]))
        return np.concatenate((start(k.inner, ahead(k.own, U, m)), U.ravel()))

    def jump(k: AroundParameters, s: Array, after: Measurement, swap: Array) -> Array:
        z, U = parts(k, s, len(swap))
        U = U[:, swap]
        return np.concatenate((jumped(k.inner, z, ahead(k.own, U, after), swap), U.ravel()))

    def correct(k: AroundParameters, s: Array, m: Measurement) -> Array:
        z, U, m = of(k, s, m)
        return np.concatenate((corrected(k.inner, z, m), U.ravel()))

    def predict(k: AroundParameters, s: Array, m: Measurement, u: Array) -> Array:
        z, U, m = of(k, s, m)
        return np.concatenate((predicted(k.inner, z, m, u), U[1:].ravel(), u))

    def estimate(k: AroundParameters, s: Array, m: Measurement) -> Estimate | None:
        assert told is not None
        z, _, m = of(k, s, m)
        return told(k.inner, z, m)

    seen = None if told is None else estimate
    return ControllerLaws(None, output, initial_state, None, jump, correct, predict, seen)


@dataclass(frozen=True)
class Predicted(Around):
    """The module's prediction over `prediction` seconds d > 0 around `inner`; period [s]: set by `sampled`.

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

    @property
    def own(self) -> PredictionParameters:
        period = self.prediction if self.period is None else self.period
        return PredictionParameters(float(self.prediction), *weights(self.prediction, period))

    @property
    def laws(self) -> ControllerLaws:
        laws = super().laws
        return laws if self.period is not None else laws._replace(output=unsampled)

    def around(self, inner: ControllerLaws) -> ControllerLaws:
        return predicting(filled(inner))

    def sampled(self, period: float) -> Self:
        return replace(self, inner=self.inner.sampled(period), period=period)


def unsampled(k: object, s: Array, m: Measurement) -> Array:
    """Raises InputError: which torques are on their way is known when the period is."""
    raise InputError("a prediction works at ticks; call sampled(period)")
