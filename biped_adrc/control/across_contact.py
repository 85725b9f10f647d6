"""Controllers across a touchdown: a policy around any controller, for the time in which contact settles.

    hold    s <- initial_state(m)                      at each tick with t_step < T, then s <- correct(s, m)

t_step is the time since the touchdown that the controller was told of; the start of a run counts as one. A
contact that takes time moves the joints by forces that no observer is told of, and an observer takes them for
a disturbance. While it is held the torque is that of the model on measured rates, as NPD's for ADRC; it is told
the torque of the last such tick, so that from there on it runs as from a start.

Policies act at ticks, so they work in sampled time alone. T = 0 is the controller itself, bit for bit. Around
an outer loop they would begin that loop anew; put the outer loop around the policy.

`AcrossContact` is the base of all policies; `ContactWindow` of those with a T. Another one is
`impact_invariant`; more, as files that run, are in `examples/policies`. What an observer does at the instant of
the touchdown itself is its `ResetPolicy`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from biped_adrc.control.around import Around
from biped_adrc.control.base import Measurement
from biped_adrc.core.checks import NonNegativeFloat
from biped_adrc.core.part import derived
from biped_adrc.core.timing import SAME_INSTANT
from biped_adrc.core.types import Array


@dataclass(frozen=True)
class AcrossContact(Around):
    """Base of the policies, which act at sample instants."""

    def continuous(self) -> Self:
        self._only_sampled()


@dataclass(frozen=True)
class ContactWindow(AcrossContact):
    """Base of the policies that act for `window` seconds T after touchdown. Raises InputError unless T >= 0."""

    window: NonNegativeFloat = 0.015

    @derived
    def until(self) -> float:
        """T less round-off [s]."""
        return float(self.window - SAME_INSTANT)


@dataclass(frozen=True)
class Hold(ContactWindow):
    """The observer of `inner` begins anew at each tick for `window` seconds after touchdown, then runs."""

    def correct(self, s: Array, m: Measurement) -> Array:
        fresh, run = self.inner.initial_state(m), self.inner.correct(s, m)
        return np.where(m.t_step < self.until, fresh, run)
