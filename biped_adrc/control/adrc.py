"""Active disturbance rejection with an extended observer, eq. (20) of the paper.

    u = kappa^-1 (q_d'' - K_d (x2^ - q_d') - K_p (x1^ - q_d) - xi^)

q_b (p,) are the joints with motors, q_b'' = kappa u + xi by (13), with kappa (p, p) and xi (p,) [rad/s^2]; x1^
is the estimate of q_b, x2^ that of q_b'. xi^ lumps model error and external torques into one signal per joint;
of the nominal model the law uses kappa alone (and, for Theta'' in q_d'', the unactuated row). For a virtual
constraint q_d = h(Theta), with the phase Theta = c q, q_d'' contains h' Theta'' and so the torque itself:
module `tracking` solves this algebraic loop. ^ marks an estimate.

Any observer of the chain x1' = x2, x2' = xi + kappa u fits: it measures q_b, its input is kappa u for the
torque applied, and xi^ estimates the rest of q_b''.

In assisted ADRC the observer contains the nominal model's xi, and estimates the remaining disturbance d.

    x1' = x2,   x2' = xi + kappa u + d                              d: model error and external torques
    u = kappa^-1 (q_d'' - K_d (x2^ - q_d') - K_p (x1^ - q_d) - xi - d^)

Its observer has m extended states, for d and its derivatives. With m = 0 there is no d^, and the law is NPD
(28), feedback linearisation with PD action, on the angles and rates of an observer in place of measured ones.
With m >= 1 the observer has less to follow than in (20), where all of xi is a disturbance: (20) needs kappa
alone of the model, assisted ADRC all of it.
"""

from dataclasses import dataclass, field

import numpy as np

from biped_adrc.control.base import Measurement, measured
from biped_adrc.control.tracking import TABLE_II, Gains, ObservingController, tracking_torque
from biped_adrc.core.part import rewrites
from biped_adrc.core.types import Array
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.observers.base import ErrorSystem, Estimate, Observer, ResetPolicy
from biped_adrc.observers.gpi import GPIObserver


@dataclass(frozen=True)
class ADRCController(ObservingController):
    """ADRC, eq. (20), with an observer that is its whole state; Table I and Table II by default.

    reference: q_d, which the joints track. observer: of xi (p,) [rad/s^2], by default the paper's (17) with the
    poles of its Table I. gains: K_p [1/s^2], K_d [1/s]. solve_theta: whether the loop through Theta'' is
    solved; else h' Theta'' is dropped, as the paper prints it. reset: what happens to the observer at impact;
    by default it starts anew there.

    >>> controller = ba.ADRCController(gait.constraint, ba.GPIObserver.from_bandwidth(400.0, m=2))
    >>> ba.walk(ba.Walker(biped, controller), gait, impacts=1).impacts
    1
    """

    reference: Reference
    observer: Observer = field(default_factory=GPIObserver.from_poles)
    gains: Gains = TABLE_II
    solve_theta: bool = True
    reset: ResetPolicy = ResetPolicy.MODEL

    def measured_output(self, m: Measurement) -> Estimate:
        """The observer's measurement q_b [rad], and q_b' [rad/s] and the nominal model's xi [rad/s^2], which
        only its start and its reset use; each (p,).
        """
        return measured(m)

    def observer_input(self, m: Measurement, u: Array) -> Array:
        """Input of the observer for the torque u (p,) [N m]: kappa u (p,) [rad/s^2]."""
        return m.terms.kappa @ u

    def torque(self, r: ReferencePoint, x: Estimate, m: Measurement) -> Array:
        """u (p,) [N m] of (20) for the point r of the reference and the observer's estimates x."""
        # `joint_estimate` is x itself here; it differs in `AssistedADRCController`
        return tracking_torque(self.gains, r, self.joint_estimate(x, m), m, self.solve_theta)

    def error_system(self) -> ErrorSystem | None:
        # a subclass may write another flow of the observer, or of the law, beside the inherited error dynamics
        own = rewrites(self, "error_system", "flow", "observer_input", "measured_output")
        other = own or rewrites(self.observer, "error_system", "flow")
        return None if other else self.observer.error_system()


@dataclass(frozen=True)
class AssistedADRCController(ADRCController):
    """Assisted ADRC: the observer has the nominal model's xi in its input, and estimates the remaining d.

    The observer is the whole state; by default it has m = 1 extended state and its poles at -500 rad/s.
    """

    observer: Observer = field(default_factory=lambda: GPIObserver.from_bandwidth(500.0, 1))

    def measured_output(self, m: Measurement) -> Estimate:
        """The observer's measurement q_b [rad], and q_b' [rad/s] and d = 0 [rad/s^2], which only its start and
        its reset use: there the model is taken for exact; each (p,).
        """
        return Estimate(m.q_b, m.v_b, np.zeros(len(m.q_b)))

    def observer_input(self, m: Measurement, u: Array) -> Array:
        """Input of the observer: kappa u + xi (p,) [rad/s^2], the acceleration by the model."""
        return super().observer_input(m, u) + m.terms.xi

    def joint_estimate(self, x: Estimate, m: Measurement) -> Estimate:
        """The estimates x of the joints with xi^ = xi + d^ (p,) [rad/s^2] in place of d^."""
        return x._replace(disturbance=m.terms.xi + x.disturbance)
