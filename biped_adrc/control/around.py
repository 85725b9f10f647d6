"""What goes around any controller: a controller that calls the one inside.

A leaf writes the methods that differ. It names no class of controllers, so that every one that compiles still
does. `across_contact` has the policies for the time after a touchdown, `friction_feedforward` and `predicted`
what serves all the time.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.core.types import Array, Indices
from biped_adrc.observers.base import Estimate


@dataclass(frozen=True)
class Around(Controller):
    """Base of what is around `inner`: all that a leaf does not write is that of the controller inside."""

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
