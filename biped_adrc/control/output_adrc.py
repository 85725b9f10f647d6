"""ADRC in output form: the observer estimates the disturbance of the output, not of the joints.

    y   = q_b - q_d
    y'' = L u + xi_y,   L = (I - H_b - H_N A_N) kappa
    u   = L^-1 (-K_p y^ - K_d y'^ - xi_y^)

q_b (p,) are the joints with motors, q_N the others, ^ marks an estimate. The reference has q_d'' = drift + H
q'' with H = (H_b, H_N) (p, n). With the model's equations (12) and (13) of the paper, q_N'' = A_N q_b'' + a_N
and q_b'' = kappa u + xi, xi_y is M xi - drift - H_N a_N, M = I - H_b - H_N A_N. This value is used at the start
and at impact alone: the reference's own acceleration, and the effect of the unactuated coordinate on it through
Theta'', are estimated together with model error and external forces. In the joint form (20) q_d'' comes from
the model, and an error of the model's Theta'' is an error of the reference that no observer of q_b'' can see. L
is J D^-1 B, with J the Jacobian of y, D the inertia matrix and B the rows with motors.

Han, IEEE Trans. Industrial Electronics 56(3), 2009, for the total disturbance of an output; Westervelt,
Grizzle, Koditschek, IEEE TAC 48(1), 2003, for y.
"""

from dataclasses import dataclass, field

from biped_adrc.control.base import Measurement, impulse_of
from biped_adrc.control.tracking import (
    TABLE_II,
    Gains,
    ObservingController,
    output_matrix,
    rate_error_change,
    unchanged,
)
from biped_adrc.core.linear import solve
from biped_adrc.core.types import Array
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.observers.base import Estimate, Observer, ResetPolicy
from biped_adrc.observers.gpi import GPIObserver


@dataclass(frozen=True)
class OutputADRCController(ObservingController):
    """ADRC of the output y = q_b - q_d, with an observer of y that is the whole state.

    reference: q_d. observer: of xi_y (p,) [rad/s^2], by default (17) with the poles of Table I. gains: K_p
    [1/s^2] and K_d [1/s] of y'' = -K_p y - K_d y', Table II by default as in the joint form. reset: what
    happens to the observer at impact; MODEL takes y, y' from the measurement and xi_y from the model. The
    exponential integration method does not fit: in continuous time with Table I take RK4, integration steps of
    5e-5 s.
    """

    reference: Reference
    observer: Observer = field(default_factory=GPIObserver.from_poles)
    gains: Gains = TABLE_II
    reset: ResetPolicy = ResetPolicy.MODEL

    def measured_output(self, m: Measurement) -> Estimate:
        """The observer's measurement y [rad], and y' [rad/s] and the nominal model's xi_y [rad/s^2], which only
        its start and its reset use; each (p,).
        """
        r, terms = self.point(m), m.terms  # r: the reference now
        p = len(r.q_d)
        xi_y = output_matrix(r, terms) @ terms.xi - r.drift - r.H[:, p:] @ terms.a_N
        return Estimate(m.q_b - r.q_d, m.v_b - r.dq_d, xi_y)

    def observer_input(self, m: Measurement, u: Array) -> Array:
        """Input of the observer for the torque u (p,) [N m]: L u (p,) [rad/s^2]."""
        return output_matrix(self.point(m), m.terms) @ (m.terms.kappa @ u)

    def torque(self, r: ReferencePoint, x: Estimate, m: Measurement) -> Array:
        """u (p,) [N m] for the point r of the reference and estimates x of y, y' and xi_y.

        Raises SingularError where M is exactly singular, with a pivot of 0.0; near that u grows
        without bound and without an error.
        """
        # near a touchdown, inside `ImpactInvariant`, without the part that an impulse on the foot can change
        dy = x.velocity if m.impulse is None else unchanged(r, x.velocity, m.impulse)
        w = -self.gains.K_p * x.position - self.gains.K_d * dy - x.disturbance
        # `output_matrix` is M, so ddq_b = kappa u
        L = output_matrix(r, m.terms)
        ddq_b = solve(L, w, "L of y'' = L u + xi_y, the output's decoupling matrix,")
        return m.terms.kappa_inverse @ ddq_b

    def joint_estimate(self, x: Estimate, m: Measurement) -> Estimate:
        """Convert estimates x of y, y' and xi_y to those of q_b, q_b' and xi of the joints, each (p,).

        xi = M^-1 (xi_y + drift + H_N a_N), with a_N of the nominal model.
        """
        r, terms = self.point(m), m.terms
        rest = x.disturbance + r.drift + r.H[:, len(r.q_d) :] @ terms.a_N
        xi = solve(output_matrix(r, terms), rest, "the output's decoupling matrix")
        return Estimate(x.position + r.q_d, x.velocity + r.dq_d, xi)

    def impulse_change(self, m: Measurement) -> Array:
        """Changes N = a_b - H a (p, 2) of y' by an impulse of 1 N s in x and in z; a (n, 2) is `m.impulse`."""
        return rate_error_change(self.point(m), impulse_of(m))
