"""NPD: feedback linearisation with proportional-derivative action, eq. (28).

    u = kappa^-1 (q_d'' - K_d (q_b' - q_d') - K_p (q_b - q_d) - xi)

xi comes from the model, (14) without disturbances. The paper writes estimates x1^, x2^ here, though NPD
has no observer: the measured state is used.
"""

from __future__ import annotations

from dataclasses import dataclass

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.control.tracking import (
    TABLE_II,
    Gains,
    feedback,
    printed_acceleration,
    solved_acceleration,
)
from biped_adrc.gait.reference import Reference
from biped_adrc.types import Array


@dataclass(frozen=True)
class NPDController(Controller):
    """(28). solve_theta: solve the loop through Theta'' (default), or drop h' Theta'' as printed."""

    reference: Reference
    gains: Gains = TABLE_II
    solve_theta: bool = True

    def output(self, s: Array, m: Measurement) -> Array:
        r = self.reference(m.t, m.q, m.v)
        f = feedback(self.gains, r, m.q_b, m.v_b)
        a = solved_acceleration(r, m.terms, f) if self.solve_theta else printed_acceleration(r, f)
        return m.terms.kappa_inverse @ (a - m.terms.xi)
