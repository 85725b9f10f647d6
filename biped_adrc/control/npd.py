"""NPD: feedback linearisation with proportional-derivative action, eq. (28) of the paper.

    u = kappa^-1 (q_d'' - K_d (q_b' - q_d') - K_p (q_b - q_d) - xi)

q_b (p,) are the joints with motors, q_b'' = kappa u + xi by (13). q_d'' of a virtual constraint q_d = h(Theta)
contains h' Theta'' and so the torque itself: `tracking` solves this algebraic loop. xi comes from the model,
(14) without disturbances. The paper writes estimates x1^, x2^ here, though NPD has no observer: the measured
state is used.

The paper compares ADRC with it: the same gains, and the model's xi in place of an estimated one. With a right
model and no push both loops have the same error dynamics. A push, or an error of the model, that changes xi by
d xi [rad/s^2] leaves NPD an error of the size d xi / K_p [rad].
"""

from dataclasses import dataclass

from biped_adrc.control.base import Controller, Measurement, measured
from biped_adrc.control.tracking import TABLE_II, Gains, tracking_torque
from biped_adrc.core.types import Array
from biped_adrc.gait.reference import Reference


@dataclass(frozen=True)
class NPDController(Controller):
    """NPD, eq. (28), a controller without a state.

    reference: the reference to track. gains: K_p [1/s^2], K_d [1/s]. solve_theta: whether the loop
    through Theta'' is solved; else h' Theta'' is dropped, as the paper prints it.

    >>> controller = ba.NPDController(gait.constraint, ba.Gains(K_p=2500.0, K_d=100.0))
    >>> ba.walk(ba.Walker(biped, controller), gait, impacts=1).impacts
    1
    """

    reads_impulse = ("output",)

    reference: Reference
    gains: Gains = TABLE_II
    solve_theta: bool = True

    def output(self, s: Array, m: Measurement) -> Array:
        # the measurement takes the place of an observer's estimates
        r = self.reference(m.t, m.q, m.v)
        return tracking_torque(self.gains, r, measured(m), m, self.solve_theta)
