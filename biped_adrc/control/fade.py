"""A policy across contact: the observer runs all the time, and what it says counts little by little.

u = u_0 + w(t_step / T) (u - u_0)          u_0 = output(initial_state(m), m), w of `across_contact`
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from biped_adrc.control.across_contact import ContactWindow, ramp
from biped_adrc.control.around import AroundParameters, passed_on
from biped_adrc.control.base import ControllerLaws, Measurement
from biped_adrc.types import Array


@lru_cache(maxsize=64)
def fading(inner: ControllerLaws) -> ControllerLaws:
    """The laws of `Fade` around these."""
    passed = passed_on(inner)

    def output(k: AroundParameters, s: Array, m: Measurement) -> Array:
        assert inner.initial_state is not None
        u = inner.output(k.inner, s, m)
        fresh = inner.output(k.inner, inner.initial_state(k.inner, m), m)
        part = ramp(k.own.rate * m.t_step)
        return np.where(m.t_step < k.own.until, fresh + part * (u - fresh), u)

    return passed._replace(output=output)


@dataclass(frozen=True)
class Fade(ContactWindow):
    """The observer of `inner` runs, and its part of the torque grows from none for `window` seconds."""

    def around(self, inner: ControllerLaws) -> ControllerLaws:
        return fading(inner)
