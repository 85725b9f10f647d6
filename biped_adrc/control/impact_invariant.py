"""Near a touchdown, a feedback error without the part that an impulse of the striking foot can change.

    a = (D - J_m' J_m / m)^-1 (J' - J_m' / m)          q'+ - q'- = a F for an impulse F of the ground (2,)
    N = change of a quantity under q' + a F            (., 2)
    P = 1 - N (N' N)^-1 N'                             P N = 0

F (2,) [N s] is the foot's impulse, a (n, 2) the change of q' for each N s of it, N the change of the quantity
that is projected; J', N' are transposes, q', e' rates, D is D_s. a follows from the impact (7) where only the
foot with the Jacobian J strikes. J is J_2 of the swing foot before touchdown. After it J = 0: the foot that
struck is then the support, and q does not contain its place. J_m is the Jacobian of m p_com, m [kg] the
robot's mass, t_step [s] the time since the last touchdown, H the matrix of q_d'' = drift + H q''. While a
touchdown is less than T [s] away (field `window`),

    rates        the controller's rate error e' = q_b' - q_d' is P e', N = a_b - H a
    innovation   that of the observer, y - y^, is P (y - y^); N is a_b for an observer of the joints, a_b - H a
                 for one of their error, D a for one of the momentum D q'

since q_d' of a virtual constraint follows the measured rates and jumps with them. The last
touchdown was less than T ago (t_step < T), or the next one is expected in less than T by the
phase: |Theta- - Theta| < T |Theta'|.

This wrapper puts a into `Measurement.impulse`, and the law inside projects; a law says in `reads_impulse` in
which of its methods it does.

The projection of the rate error is that of Yang and Posa, Impact invariant control with applications to
bipedal locomotion, IROS 2021 (arXiv 2103.06907), and Autonomous Robots 49(35), 2025 (arXiv 2303.00817), shown
there on a planar biped of five links: the impulse that explains most of the error is removed from it. In the
code that they published it is faded in and out by a factor; here it is on or off. For the innovation of an
observer no precedent was found, in three searches for observers of disturbances and states of legged robots
near an impact.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.control.around import ContactWindow
from biped_adrc.control.base import Measurement
from biped_adrc.control.outer_loop import tracked_constraint
from biped_adrc.control.tracking import body_of
from biped_adrc.core.checks import check_part
from biped_adrc.core.linear import solve_positive
from biped_adrc.core.part import derived
from biped_adrc.core.types import Array
from biped_adrc.model.reduction import BodyTerms


def impulse_response(D: Array, body: BodyTerms, J: Array) -> Array:
    """Changes a (n, 2) [1/(kg m)] of the rates per unit impulse (x, z) on a foot with Jacobian J (2, n) [m].

    D (n, n): inertia matrix; body: terms of the same posture. See the module for the equation.
    """
    J_m = body.F_a
    about_com = D - J_m.T @ J_m / body.mass
    return solve_positive(
        about_com, J.T - J_m.T / body.mass, "the inertia about the centre of mass"
    )


@dataclass(frozen=True)
class ImpactInvariant(ContactWindow):
    """A policy that removes from the errors of `inner` what an impulse of the striking foot
    changes, near a touchdown.

    window [s]: on either side of the touchdown. rates: apply it to the controller's rate error.
    innovation: to that of its observer.

    Raises InputError for a controller that tracks no virtual constraint, or lacks the error to be projected.
    """

    rates: bool = True
    innovation: bool = False

    def __post_init__(self) -> None:
        for name in ("rates", "innovation"):
            check_part(getattr(self, name), f"{name} of ImpactInvariant", bool)
        tracked_constraint(
            self.inner, "a touchdown is expected by the phase of a virtual constraint"
        )
        if "output" not in self.inner.reads_impulse:
            self.inner._has_no("rate error that could be projected")
        if self.innovation and "correct" not in self.inner.reads_impulse:
            self.inner._has_no("innovation that could be projected")

    @derived
    def phase(self) -> tuple[Array, float]:
        """Row c (n,) of the phase Theta = c q, and the phase Theta- [rad] at which a step ends."""
        h = tracked_constraint(self.inner)
        return h.phase, float(h.theta_minus)

    @property
    def needs_body(self) -> bool:  # type: ignore[override]
        """True, as the Jacobian of the swing foot is in `Measurement.body`."""
        return True

    def output(self, s: Array, m: Measurement) -> Array:
        u = self.inner.output(s, m)
        if not self.rates:
            return u
        return self.near(m, self.inner.output(s, self.with_impulse(m)), u)

    def correct(self, s: Array, m: Measurement) -> Array:
        z = self.inner.correct(s, m)
        if not self.innovation:
            return z
        return self.near(m, self.inner.correct(s, self.with_impulse(m)), z)

    def landed(self, m: Measurement) -> bool:
        """Whether the last touchdown was less than T ago; 1 or 0 on symbols."""
        return m.t_step < self.until

    def expected(self, m: Measurement) -> bool:
        """Whether the phase is within T of its end, before or after it; 1 or 0 on symbols."""
        c, theta_minus = self.phase
        left, rate = float(theta_minus - c.dot(m.q)), float(c.dot(m.v))
        return abs(left) < self.until * abs(rate)

    def with_impulse(self, m: Measurement) -> Measurement:
        """The measurement m with its `impulse`: a (n, 2) [1/(kg m)] of the foot that has just struck, or is
        about to.
        """
        body = body_of(m)
        J = np.where(self.landed(m), 0.0 * body.J_2, body.J_2)
        return m._replace(impulse=impulse_response(m.terms.D, body, J))

    def near(self, m: Measurement, projected: Array, other: Array) -> Array:
        """`projected` within T of a touchdown, else `other`."""
        soon = np.where(self.expected(m), projected, other)
        return np.where(self.landed(m), projected, soon)
