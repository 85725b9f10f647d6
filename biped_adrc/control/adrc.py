"""Active disturbance rejection with an extended observer, eq. (20).

    u = kappa^-1 (q_d'' - K_d (x2^ - q_d') - K_p (x1^ - q_d) - xi^)

xi^ lumps model error and external torques into one signal per joint; the nominal model gives kappa alone
(and, through Theta'' in q_d'', the unactuated row).

Any observer of the chain x1' = x2, x2' = xi + kappa u fits: it sees q_b, is fed with kappa u for the torque
applied, and xi^ is what remains. The four functions below say so, as `control.observing.Sight`.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from biped_adrc.control.base import Measurement, measured
from biped_adrc.control.observing import ObservingController, Sight
from biped_adrc.control.tracking import TABLE_II, Gains, TrackingParameters, tracking_torque
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.observers.base import ErrorSystem, Estimate, Feedback, Observer, ResetPolicy
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.types import Array


def joints_seen(r: ReferencePoint, m: Measurement) -> Estimate:
    """q_b, q_b' and the nominal model's xi, each (p,)."""
    return measured(m)


def joints_fed(r: ReferencePoint, m: Measurement, u: Array) -> Array:
    """kappa u (p,) [rad/s^2]."""
    return m.terms.kappa @ u


def adrc_torque(k: TrackingParameters, r: ReferencePoint, x: Estimate, m: Measurement) -> Array:
    """u (p,) [N m] of (20) for the estimates x."""
    return tracking_torque(k, r, x, m.terms)


def joints_told(r: ReferencePoint, x: Estimate, m: Measurement) -> Estimate:
    """The estimates as they are, each (p,): the observer's coordinates are the joints."""
    return x


def joints_struck(r: ReferencePoint, m: Measurement, a: Array) -> Array:
    """What rates a (n, 2) change in q_b', (p, 2)."""
    return a[: m.terms.kappa.shape[0]]


@dataclass(frozen=True)
class ADRCController(ObservingController):
    """(20) with an observer that is its whole state; Table I and Table II by default.

    gains: K_p [1/s^2], K_d [1/s].
    solve_theta: solve the loop through Theta'' (default), or drop h' Theta'' as printed.
    reset: what happens to the observer at impact.
    """

    sight = Sight(joints_seen, joints_fed, adrc_torque, joints_told, joints_struck, False)

    reference: Reference
    observer: Observer = field(default_factory=GPIObserver.from_poles)
    gains: Gains = TABLE_II
    solve_theta: bool = True
    reset: ResetPolicy = ResetPolicy.MODEL

    def error_system(self) -> ErrorSystem | None:
        error = self.observer.error_system()
        if error is None:
            return None
        return error._replace(feedback=Feedback(self.gains.K_p, self.gains.K_d, self.reference))
