"""Near a touchdown the feedback acts on an error without the part that an impulse on the striking foot can
change.

An impulse F (2,) [N s] of the ground on the striking foot changes the rates q' by a F, and with them an error y
of the feedback by N F. That part of y is in the two directions of the columns of N, whatever F is, and says
nothing of how well the robot tracks. The projection P removes these two directions from y:

    q'+ - q'- = a F,     a = (D - J_m' J_m / m)^-1 (J' - J_m' / m)
    y+ - y- = N F,       P = 1 - N (N' N)^-1 N',       P N = 0

    a     (n, 2) change of the rates q' by 1 N s, in x and in z; a_b (p, 2) its rows of the p joints with motors
    N     change of the error y by 1 N s, in x and in z, below; (p, 2), and (n, 2) where y is the momentum
    D     (n, n) inertia matrix D_s of (11)
    H     (p, n) slope of the reference, q_d'' = drift + H q''
    J     (2, n) Jacobian of the striking foot, J_m that of m p_com, with m [kg] the robot's mass, p_com its COM

J', N' are transposes, q', e' rates. The formula of a is that of the impact (7) of the paper, for the striking
foot alone. Before touchdown J is J_2, of the swing foot. After touchdown J = 0: the foot that struck is then
the support, on which q does not depend. While a touchdown is less than T [s] away (field `window`), the law
inside uses

    rates        P e' in place of its rate error e' = q_b' - q_d', with N = a_b - H a, since q_d' of a virtual
                 constraint is a function of the measured rates and jumps with them
    innovation   P (y - y^) in place of the innovation y - y^ of its observer, which measures y; N = a_b for an
                 observer of the joints' angles, a_b - H a for one of their error, D a for one of the momentum
                 D q'

A touchdown is less than T away if the last one was less than T ago (t_step < T), or if by the phase Theta = c
q, which is Theta- at the end of a step, the next one is expected in less than T: |Theta- - Theta| < T |Theta'|.

This wrapper puts a into `Measurement.impulse`. The law inside computes N and P (`control.tracking`), and says
in `reads_impulse` in which of its methods it does.

The projection of the rate error is that of Yang and Posa, Impact invariant control with applications to
bipedal locomotion, IROS 2021 (arXiv 2103.06907), and Autonomous Robots 49(35), 2025 (arXiv 2303.00817), shown
there on a planar biped of five links: the impulse that explains most of the error is removed from it. In the
code that they published a factor fades the projection in and out; here it is on or off. For the projection of
an observer's innovation no precedent was found, in three searches for observers of disturbances and states of
legged robots near an impact.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from biped_adrc.control.around import ContactWindow
from biped_adrc.control.base import Measurement, body_of
from biped_adrc.control.outer_loop import tracked_constraint
from biped_adrc.core.checks import spoken
from biped_adrc.core.errors import InputError
from biped_adrc.core.linear import solve_positive
from biped_adrc.core.tree import chosen
from biped_adrc.core.types import Array
from biped_adrc.model.reduction import BodyTerms


def impulse_response(D: Array, body: BodyTerms, J: Array) -> Array:
    """Changes a (n, 2) [1/(kg m)] of the rates per unit impulse (x, z) on a foot with Jacobian J (2, n) [m].

    D (n, n): inertia matrix; body: terms of the same posture. The equation is the module's for a.
    """
    J_m = body.F_a  # the factor of q'' in the force on the COM, m p_com'' = F_a q'' + ..
    about_com, relative = D - J_m.T @ J_m / body.mass, J.T - J_m.T / body.mass
    return solve_positive(about_com, relative, "the inertia about the centre of mass")


@dataclass(frozen=True)
class ImpactInvariant(ContactWindow):
    """A policy that removes from the errors of `inner` what an impulse of the striking foot
    changes, near a touchdown.

    window [s]: T, on either side of the touchdown. rates: whether the controller's rate error is projected.
    innovation: whether its observer's innovation is.

    Raises InputError for a controller that tracks no virtual constraint, or lacks the error to be projected.
    """

    # the Jacobian of the swing foot is in `Measurement.body`
    needs_body = True

    rates: bool = True
    innovation: bool = False

    def __post_init__(self) -> None:
        why = "a touchdown is expected by the phase of a virtual constraint"
        # raises InputError where there is none; `_has_no` below raises it always
        tracked_constraint(self.inner, why)
        reads = self.inner.reads_impulse
        if not isinstance(reads, tuple) or any(x not in ("output", "correct") for x in reads):
            raise InputError(
                f"reads_impulse of {spoken(self.inner)} is {reads!r}, expected a tuple of 'output', 'correct'"
            )
        how = "leave m.impulse out of its error in {0}, and name '{0}' in reads_impulse"
        if "output" not in reads:
            self.inner._has_no("rate error that could be projected", how.format("output"))
        if self.innovation and "correct" not in reads:
            self.inner._has_no("innovation that could be projected", how.format("correct"))

    def output(self, s: Any, m: Measurement) -> Array:
        u = self.inner.output(s, m)
        if not self.rates:
            return u
        # both torques are computed: machine code has no branch here
        return self.near(m, self.inner.output(s, self.with_impulse(m)), u)

    def correct(self, s: Any, m: Measurement) -> Any:
        z = self.inner.correct(s, m)
        if not self.innovation:
            return z
        return self.near(m, self.inner.correct(s, self.with_impulse(m)), z)

    def landed(self, m: Measurement) -> bool:
        """Whether the last touchdown was less than T ago; 1 or 0 where machine code is made of it."""
        return m.t_step < self.until  # T less the round-off of times

    def expected(self, m: Measurement) -> bool:
        """Whether at its rate now the phase is less than T from its end Theta-, before or behind it; 1 or 0
        where machine code is made of it.
        """
        h = tracked_constraint(self.inner)
        left, rate = float(h.theta_minus - h.phase.dot(m.q)), float(h.phase.dot(m.v))
        return abs(left) < self.until * abs(rate)  # until: T less the round-off of times

    def with_impulse(self, m: Measurement) -> Measurement:
        """The measurement m with its `impulse`: a (n, 2) [1/(kg m)] of the foot that has just struck, or is
        about to.
        """
        # the foot that has just struck is the support, on which q does not depend: J = 0
        body = body_of(m)
        J = np.where(self.landed(m), 0.0 * body.J_2, body.J_2)
        return m._replace(impulse=impulse_response(m.terms.D, body, J))

    def near(self, m: Measurement, projected: Any, other: Any) -> Any:
        """Choose `projected` while a touchdown is less than T away, else `other`: torques, or states, which may
        be trees of arrays.
        """
        soon = chosen(self.expected(m), projected, other)
        return chosen(self.landed(m), projected, soon)
