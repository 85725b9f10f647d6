"""Active disturbance rejection with an extended observer, eq. (20).

    u = kappa^-1 (q_d'' - K_d (x2^ - q_d') - K_p (x1^ - q_d) - xi^)

xi^ lumps model error and external torques into one signal per joint; the nominal model gives kappa alone
(and, through Theta'' in q_d'', the unactuated row).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.control.tracking import (
    TABLE_II,
    Gains,
    feedback,
    printed_acceleration,
    solved_acceleration,
)
from biped_adrc.gait.reference import Reference
from biped_adrc.observers.base import ErrorSystem, Estimate, Observer, ResetPolicy
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.types import Array


@dataclass(frozen=True)
class ADRCController(Controller):
    """(20) with an observer that is its whole state.

    solve_theta: solve the loop through Theta'' (default), or drop h' Theta'' as printed.
    reset: what happens to the observer at impact.
    """

    reference: Reference
    observer: Observer = field(default_factory=GPIObserver.from_poles)
    gains: Gains = TABLE_II
    solve_theta: bool = True
    reset: ResetPolicy = ResetPolicy.MODEL

    def output(self, s: Array, m: Measurement) -> Array:
        x = self.observer.estimate(s)
        r = self.reference(m.t, m.q, m.v)
        f = feedback(self.gains, r, x.position, x.velocity)
        a = solved_acceleration(r, m.terms, f) if self.solve_theta else printed_acceleration(r, f)
        return m.terms.kappa_inverse @ (a - x.disturbance)

    def initial_state(self, m: Measurement) -> Array:
        return self.observer.initial_state(m.q_b, m.v_b, m.terms.xi)

    def flow(self, s: Array, m: Measurement, u: Array) -> Array:
        return self.observer.flow(s, m.q_b, m.terms.kappa @ u)

    def correct(self, s: Array, m: Measurement) -> Array:
        return self.observer.correct(s, m.q_b)

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        return self.observer.predict(s, m.terms.kappa @ u)

    def jump(self, s: Array, after: Measurement, swap: Array) -> Array:
        return self.observer.reset(s, self.reset, swap, after.q_b, after.v_b, after.terms.xi)

    def sampled(self, period: float) -> ADRCController:
        return replace(self, observer=self.observer.sampled(period))

    def error_system(self) -> ErrorSystem | None:
        return self.observer.error_system()

    def estimate(self, s: Array, m: Measurement) -> Estimate | None:
        return self.observer.estimate(s)
