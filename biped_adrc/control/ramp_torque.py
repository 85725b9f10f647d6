"""A policy across contact: the torque goes from that before the touchdown to the controller's.

    u <- u_0 + w(t_step / T) (u - u_0)      at each tick with t_step < T, w of `across_contact`

A contact that takes time leaves both feet on the ground for some milliseconds, in which the model of one foot
that is pinned is wrong. u_0 is the torque of the last tick before the touchdown that the controller was told
of, its legs swapped; at the start of a run it is the controller's own. A touchdown within the window keeps u_0.
The observer inside runs as without the policy, and is told the torque that acts; put it around `Hold` and its
like to have both.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from biped_adrc.control.across_contact import ContactWindow, ramp
from biped_adrc.control.around import AroundParameters, tick_laws
from biped_adrc.control.base import ControllerLaws, Measurement
from biped_adrc.observers.base import Estimate
from biped_adrc.types import Array


@lru_cache(maxsize=64)
def ramping(inner: ControllerLaws) -> ControllerLaws:
    """The laws of `RampTorque` around these; u_0 (p,) [N m] stands at the end of the state."""
    start, jumped, corrected, predicted = tick_laws(inner)
    told = inner.estimate

    def parts(s: Array, m: Measurement) -> tuple[Array, Array]:
        size = len(s) - m.terms.kappa.shape[0]
        return s[:size], s[size:]

    def output(k: AroundParameters, s: Array, m: Measurement) -> Array:
        z, u_0 = parts(s, m)
        u = inner.output(k.inner, z, m)
        ramped = u_0 + ramp(k.own.rate * m.t_step) * (u - u_0)
        return np.where(m.t_step < k.own.until, ramped, u)

    def initial_state(k: AroundParameters, m: Measurement) -> Array:
        z = start(k.inner, m)
        return np.concatenate((z, inner.output(k.inner, z, m)))

    def jump(k: AroundParameters, s: Array, after: Measurement, swap: Array) -> Array:
        z, u_0 = parts(s, after)
        return np.concatenate((jumped(k.inner, z, after, swap), u_0[swap]))

    def correct(k: AroundParameters, s: Array, m: Measurement) -> Array:
        z, u_0 = parts(s, m)
        return np.concatenate((corrected(k.inner, z, m), u_0))

    def predict(k: AroundParameters, s: Array, m: Measurement, u: Array) -> Array:
        z, u_0 = parts(s, m)
        last = np.where(m.t_step < k.own.until, u_0, u)
        return np.concatenate((predicted(k.inner, z, m, u), last))

    def estimate(k: AroundParameters, s: Array, m: Measurement) -> Estimate | None:
        return None if told is None else told(k.inner, parts(s, m)[0], m)

    seen = None if told is None else estimate
    return ControllerLaws(None, output, initial_state, None, jump, correct, predict, seen)


@dataclass(frozen=True)
class RampTorque(ContactWindow):
    """The torque goes from that before the touchdown to that of `inner` within `window` seconds."""

    window: float = 0.005

    def around(self, inner: ControllerLaws) -> ControllerLaws:
        return ramping(inner)
