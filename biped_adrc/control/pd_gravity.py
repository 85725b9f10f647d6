"""PD with gravity compensation: torques of springs and dampers about the reference, and the weight.

    u = -K_p (q_b - q_d) - K_d (q_b' - q_d') + G_b(q)

q_b (p,) are the joints with motors, G_b (p,) [N m] their part of the weight's torques. Takegaki, Arimoto, ASME
J. Dynamic Systems, Measurement, and Control 103(2), 1981: on a fully actuated arm that stands still q_d is
reached from everywhere, whatever the inertia, since the energy q'^T D q' / 2 + K_p |q - q_d|^2 / 2 falls. On a
walker G_b ignores the motion of the unactuated coordinate, and neither inertia nor q_d'' is used: the tracking
error stays finite, and falls with the gains.
"""

from dataclasses import dataclass

from biped_adrc.control.base import Controller, Measurement, body_of
from biped_adrc.control.tracking import Gains, feedback
from biped_adrc.core.types import Array
from biped_adrc.gait.reference import Reference


@dataclass(frozen=True)
class JointGains(Gains):
    """Stiffness K_p [N m/rad] and damping K_d [N m s/rad], one number for all joints or one per joint.

    Not those of Table II, which multiply accelerations. With the defaults RABBIT walks its published gait.
    """

    SUCH_AS = "JointGains(3000.0, 250.0), K_p [N m/rad] and K_d [N m s/rad]"

    K_p: Array | float = 3000.0
    K_d: Array | float = 250.0


@dataclass(frozen=True)
class PDGravityController(Controller):
    """PD with gravity compensation, a controller without a state; `gains` are torques per angle and rate.

    reference: q_d, which the joints track. The controller needs the weight of the nominal model,
    `Measurement.body`, and no other part of it.
    """

    needs_body = True

    reference: Reference
    gains: JointGains = JointGains()

    def output(self, s: Array, m: Measurement) -> Array:
        r = self.reference(m.t, m.q, m.v)
        # with `JointGains` the feedback is a torque [N m]
        return feedback(self.gains, r, m.q_b, m.v_b) + body_of(m).G[: len(r.q_d)]
