"""Tracking with an observer that is the controller's whole state: what ADRC, its output form and DOB share.

    u = torque(r, x^, m),   z' = flow(z, y, input)          in continuous time
    z <- correct(z, y),     z <- predict(z, input)          at a tick

r is the point of the reference, x^ the observer's estimate. A controller of this kind says what its observer
measures, y, what its input is, and the torque; observer and reference may be any.

`adrc` measures the joints, `output_adrc` the output y = q_b - q_d, `momentum_dob` the momentum. All else,
resets and time bases included, is here once.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import replace
from typing import Self

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.control.tracking import Gains, orthogonal_to
from biped_adrc.core.checks import check_part
from biped_adrc.core.types import Array, Indices
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.observers.base import Estimate, Observer, ResetPolicy


class ObservingController(Controller):
    """Base of the controllers whose state is an observer's.

    reference: what is tracked. gains: K_p [1/s^2], K_d [1/s] on the estimates. reset: the observer's,
    at impact.

    >>> controller = ba.ADRCController(gait.constraint)
    >>> isinstance(controller, ba.ObservingController), controller.observer.m
    (True, 7)
    """

    reference: Reference
    observer: Observer
    gains: Gains
    reset: ResetPolicy

    @abstractmethod
    def measured_output(self, m: Measurement) -> Estimate:
        """y and y', and the disturbance that the nominal model expects."""

    @abstractmethod
    def observer_input(self, m: Measurement, u: Array) -> Array:
        """The observer's input under the torque u (p,)."""

    @abstractmethod
    def torque(
        self, r: ReferencePoint, x: Estimate, m: Measurement, a: Array | None = None
    ) -> Array:
        """u (p,) [N m] for the estimates x, where a is given blind to changes of the rates along it (n, 2)."""

    @abstractmethod
    def output_change(self, m: Measurement, a: Array) -> Array:
        """Change of y' when the rates change by a (n, 2), such as per unit of each contact impulse."""

    def joint_estimate(self, x: Estimate, m: Measurement) -> Estimate:
        """The estimates x as estimates of the joints, each (p,); they are, where y is q_b."""
        return x

    def point(self, m: Measurement) -> ReferencePoint:
        """The reference at a measurement."""
        return self.reference(m.t, m.q, m.v)

    def estimated(self, s: Array) -> Estimate:
        """The observer's estimates. Raises InputError for an observer that returns something else."""
        x = self.observer.estimate(s)
        check_part(x, f"what {type(self.observer).__name__}.estimate returned", Estimate)
        return x

    def output(self, s: Array, m: Measurement) -> Array:
        return self.torque(self.point(m), self.estimated(s), m)

    def projected_output(self, s: Array, m: Measurement, a: Array) -> Array:
        return self.torque(self.point(m), self.estimated(s), m, a)

    def initial_state(self, m: Measurement) -> Array:
        return self.observer.initial_state(*self.measured_output(m))

    def jump(self, s: Array, after: Measurement, swap: Indices) -> Array:
        return self.observer.reset(s, self.reset, swap, *self.measured_output(after))

    def flow(self, s: Array, m: Measurement, u: Array) -> Array:
        return self.observer.flow(s, self.measured_output(m).position, self.observer_input(m, u))

    def correct(self, s: Array, m: Measurement) -> Array:
        return self.observer.correct(s, self.measured_output(m).position)

    def projected_correct(self, s: Array, m: Measurement, a: Array) -> Array:
        estimate, y = self.observer.estimate(s).position, self.measured_output(m).position
        P = orthogonal_to(self.output_change(m, a))
        return self.observer.correct(s, estimate + P @ (y - estimate))

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        return self.observer.predict(s, self.observer_input(m, u))

    def estimate(self, s: Array, m: Measurement) -> Estimate:
        return self.joint_estimate(self.estimated(s), m)

    def sampled(self, period: float) -> Self:
        sampled: Self = replace(self, observer=self.observer.sampled(period))  # type: ignore[type-var]
        return sampled

    def continuous(self) -> Self:
        if type(self.observer).flow is Observer.flow:
            self._only_sampled()
        return self
