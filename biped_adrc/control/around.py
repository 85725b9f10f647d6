"""What goes around any controller: a controller that calls the one inside.

A subclass writes the methods that differ. It names no class of controllers, so that every one that compiles
still does. `friction_feedforward` and `predicted` serve all the time, as does a torque a from elsewhere, such
as a learner's, beside u_i that the controller inside asks for:

    u = u_i + a

The controller inside gets the sum that acts: its observer does not take a for a disturbance, and so does not
fight it. Around `Passive` it is the torque a itself. a (p,) [N m] is a parameter: machine code reads it from
its vector K, Python from the array that it was made with, which stays its maker's to write. So a `Stepper`
gives another a before each sample, and compiles nothing.

Across a touchdown a policy serves for the time in which contact settles:

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

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.core.checks import NonNegativeFloat
from biped_adrc.core.part import derived
from biped_adrc.core.timing import SAME_INSTANT
from biped_adrc.core.types import Array, Indices, freeze
from biped_adrc.observers.base import Estimate


@dataclass(frozen=True)
class Around(Controller):
    """Base of what is around `inner`: all that a subclass does not write is that of the controller inside."""

    inner: Controller

    @property
    def needs_body(self) -> bool:  # type: ignore[override]
        """As the controller inside."""
        return self.inner.needs_body

    def output(self, s: Array, m: Measurement) -> Array:
        return self.inner.output(s, m)

    def projected_output(self, s: Array, m: Measurement, a: Array) -> Array:
        return self.inner.projected_output(s, m, a)

    def initial_state(self, m: Measurement) -> Array:
        return self.inner.initial_state(m)

    def flow(self, s: Array, m: Measurement, u: Array) -> Array:
        return self.inner.flow(s, m, u)

    def correct(self, s: Array, m: Measurement) -> Array:
        return self.inner.correct(s, m)

    def projected_correct(self, s: Array, m: Measurement, a: Array) -> Array:
        return self.inner.projected_correct(s, m, a)

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        return self.inner.predict(s, m, u)

    def jump(self, s: Array, after: Measurement, swap: Indices) -> Array:
        return self.inner.jump(s, after, swap)

    def estimate(self, s: Array, m: Measurement) -> Estimate | None:
        return self.inner.estimate(s, m)

    def sampled(self, period: float) -> Self:
        return replace(self, inner=self.inner.sampled(period))

    def continuous(self) -> Self:
        return replace(self, inner=self.inner.continuous())


@dataclass(frozen=True)
class AddedTorque(Around):
    """The module's a = `torque` (p,) [N m] beside the torque of `inner`."""

    torque: Array

    def __post_init__(self) -> None:
        freeze(self, "torque")

    def output(self, s: Array, m: Measurement) -> Array:
        return self.inner.output(s, m) + self.torque

    def projected_output(self, s: Array, m: Measurement, a: Array) -> Array:
        return self.inner.projected_output(s, m, a) + self.torque


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
