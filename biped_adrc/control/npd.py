"""NPD: feedback linearisation with proportional-derivative action, eq. (28).

    u = kappa^-1 (q_d'' - K_d (q_b' - q_d') - K_p (q_b - q_d) - xi)

xi comes from the model, (14) without disturbances. The paper writes estimates x1^, x2^ here, though NPD
has no observer: the measured state is used.

It is the yardstick of ADRC in the paper: the same gains, and the model's xi in place of an estimated one. With
a right model and no push both loops have the same error dynamics; an error of the model or a push leaves NPD an
error of the size xi / K_p.

*PD with gravity compensation*: torques of springs and dampers about the reference, and the weight.

    u = -K_p (q_b - q_d) - K_d (q_b' - q_d') + G_b(q)

Takegaki, Arimoto, ASME J. Dynamic Systems, Measurement, and Control 103(2), 1981: on a fully actuated arm that
stands still q_d is reached from everywhere, whatever the inertia, since the energy q'' D q' / 2 + K_p |q -
q_d|^2 / 2 falls. On a walker G_b ignores the motion of the unactuated coordinate, and neither inertia nor
q_d'' is used: the tracking error stays finite, and falls with the gains.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from biped_adrc.control.base import Controller, Measurement, measured
from biped_adrc.control.tracking import TABLE_II, Gains, body_of, feedback, tracking_torque
from biped_adrc.core.types import Array
from biped_adrc.gait.reference import Reference


@dataclass(frozen=True)
class NPDController(Controller):
    """NPD, eq. (28), a controller without a state.

    reference: the reference to track. gains: K_p [1/s^2], K_d [1/s]. solve_theta: solve the loop through
    Theta'' (default), or drop h' Theta'' as printed.

    >>> controller = ba.NPDController(gait.constraint, ba.Gains(K_p=2500.0, K_d=100.0))
    >>> ba.walk(ba.Walker(biped, controller), gait, impacts=1).impacts
    1
    """

    reference: Reference
    gains: Gains = TABLE_II
    solve_theta: bool = True

    def output(self, s: Array, m: Measurement) -> Array:
        return self.projected_output(s, m, None)

    def projected_output(self, s: Array, m: Measurement, a: Array | None) -> Array:
        r = self.reference(m.t, m.q, m.v)
        return tracking_torque(self.gains, r, measured(m), m.terms, self.solve_theta, a)


@dataclass(frozen=True)
class JointGains(Gains):
    """Stiffness K_p [N m/rad] and damping K_d [N m s/rad], one number for all joints or one per joint.

    Not those of Table II, which multiply accelerations. The defaults walk RABBIT's published gait.
    """

    K_p: Array | float = 3000.0
    K_d: Array | float = 250.0


@dataclass(frozen=True)
class PDGravityController(Controller):
    """PD with gravity compensation, a controller without a state; `gains` are torques per angle and rate.

    It needs the weight of the nominal model, `Measurement.body`, and no other part of it.
    """

    needs_body: ClassVar[bool] = True

    reference: Reference
    gains: JointGains = JointGains()

    def output(self, s: Array, m: Measurement) -> Array:
        r = self.reference(m.t, m.q, m.v)
        return feedback(self.gains, r, m.q_b, m.v_b) + body_of(m).G[: len(r.q_d)]
