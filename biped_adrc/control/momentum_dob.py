"""Feedback linearisation with a momentum-based disturbance observer.

    D q'' + Omega = B u + zeta,   r -> zeta       r by the observer `observers.momentum`
    u = kappa^-1 (a_d - xi) - r_b - A_N' r_N      NPD (28) of the paper, less the torque that cancels r in q_b''
    q_N'' = A_N q_b'' + a_N + D22^-1 r_N          (12) of the paper with r, for Theta'' in q_d''

q_b (p,) are the joints with motors, q_N the others. Symbols: D the inertia matrix, D22 its block of q_N, Omega
Coriolis and gravity terms, kappa and xi input gain and disturbance of q_b'' = kappa u + xi, A_N and a_N of the
rows without motors in (12), Theta the phase of a virtual constraint. zeta (n,) [N m] is the external force, r =
(r_b, r_N) its estimate, a_d = q_d'' - K_d (q_b' - q_d') - K_p (q_b - q_d). ' on q is d/dt, on a matrix a
transpose. r_b is matched, one entry per motor; r_N acts on the unactuated coordinate: its effect on the q_b is
cancelled, that on q_N itself cannot be. For r = zeta the error obeys q_b'' - q_d'' = -K_d (q_b' - q_d') - K_p
(q_b - q_d) exactly, under any constant force. Unlike in ADRC the model compensates its own Omega, and the
observer estimates the remaining force.

De Luca, Albu-Schaeffer, Haddadin, Hirzinger, IROS 2006; Chen, Ballance, Gawthrop, O'Reilly, IEEE Trans.
Industrial Electronics 47(4), 2000; Sariyildiz, Oboe, Ohnishi, IEEE Trans. Industrial Electronics 67(3), 2020.

At impact the momentum jumps, and is then about another foot; r is relabelled and kept (`ChainObserver.reset`).

Measurement and input of the observer are of all n coordinates, where those of ADRC are of the p joints.
"""

from dataclasses import dataclass, field

import numpy as np

from biped_adrc.control.base import Measurement, body_of, impulse_of, measured
from biped_adrc.control.tracking import TABLE_II, Gains, ObservingController, tracking_torque
from biped_adrc.core.linear import solve_positive
from biped_adrc.core.types import Array
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.model.reduction import Reduction
from biped_adrc.observers.base import Estimate, Observer, ResetPolicy
from biped_adrc.observers.momentum import MomentumObserver


def _pushed(terms: Reduction, r: Array) -> Reduction:
    """The model's terms for D q'' + Omega = B u + r: Omega, xi and a_N are changed by r (n,) [N m]."""
    p = terms.kappa.shape[0]
    xi = terms.xi + terms.kappa @ (r[:p] + terms.A_N.T @ r[p:])
    a_N = terms.a_N + solve_positive(terms.D[p:, p:], r[p:], "D22")
    return Reduction(terms.D, terms.Omega - r, terms.kappa, xi, terms.kappa_inverse, terms.A_N, a_N)


@dataclass(frozen=True)
class MomentumDOBController(ObservingController):
    """NPD (28) less the external force that a momentum observer estimates; the observer is the whole state.

    reference: q_d, which the joints track. observer: of the force, by default with its poles at -200 rad/s.
    gains: K_p [1/s^2], K_d [1/s]. solve_theta: whether the loop through Theta'' is solved (`tracking`); else h'
    Theta'' is dropped, as (28) is printed. reset: what happens to the observer at impact.
    """

    needs_body = True

    reference: Reference
    observer: Observer = field(default_factory=lambda: MomentumObserver.from_bandwidth(200.0))
    gains: Gains = TABLE_II
    solve_theta: bool = True
    reset: ResetPolicy = ResetPolicy.MODEL

    def measured_output(self, m: Measurement) -> Estimate:
        """Momentum pi = D q' (n,) [kg m^2/s] of the nominal model, and zero external force, by which the
        observer starts; the rate of pi, which it does not use, is 0 too.
        """
        none = np.zeros(len(m.q))
        return Estimate(m.terms.D @ m.v, none, none)

    def observer_input(self, m: Measurement, u: Array) -> Array:
        """beta = C' q' - G + B u (n,) [N m], the known part of the rate pi' of the momentum, with C the
        Coriolis matrix, C' its transpose and G gravity, for the applied torque u (p,) [N m].
        """
        body, p = body_of(m), m.terms.kappa.shape[0]
        beta = body.turning - body.G  # turning: C' q'
        beta[:p] += u
        return beta

    def torque(self, r: ReferencePoint, x: Estimate, m: Measurement) -> Array:
        """u (p,) [N m] for the reference r now and estimates x whose disturbance is a force (n,) [N m].

        Angles and rates are the measured ones in m.
        Raises SingularError where the loop through Theta'' is singular.
        """
        # the model as if the estimated force were part of its Omega
        terms = _pushed(m.terms, x.disturbance)
        joints = measured(m)._replace(disturbance=terms.xi)
        return tracking_torque(self.gains, r, joints, m._replace(terms=terms), self.solve_theta)

    def joint_estimate(self, x: Estimate, m: Measurement) -> Estimate:
        """Measured angles and rates of the joints, and the total disturbance xi (14), each (p,), of the model
        with the estimated force.
        """
        return measured(m)._replace(disturbance=_pushed(m.terms, x.disturbance).xi)

    def impulse_change(self, m: Measurement) -> Array:
        """Changes N = D a (n, 2) of the momentum by an impulse of 1 N s in x and in z; a (n, 2): m.impulse."""
        return m.terms.D @ impulse_of(m)
