"""PD with gravity compensation: torques of springs and dampers about the reference, and the weight.

    u = -K_p (q_b - q_d) - K_d (q_b' - q_d') + G_b(q)

Takegaki, Arimoto, ASME J. Dynamic Systems, Measurement, and Control 103(2), 1981: on a fully actuated arm
that stands still q_d is reached from everywhere, whatever the inertia, since the energy
q'' D q' / 2 + K_p |q - q_d|^2 / 2 falls. On a walker G_b leaves out what the unactuated coordinate does, and
nothing is asked of the inertia or of q_d'': the error of tracking stays finite, and falls with the gains.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from biped_adrc.control.base import Controller, ControllerLaws, Measurement
from biped_adrc.control.tracking import Gains, TrackingParameters, body_of, feedback, tracked_laws
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.types import Array


@dataclass(frozen=True)
class JointGains(Gains):
    """Stiffness K_p [N m/rad] and damping K_d [N m s/rad], one number for all joints or one per joint.

    Not those of Table II, which multiply accelerations. The defaults walk RABBIT's published gait.
    """

    K_p: Array | float = 3000.0
    K_d: Array | float = 250.0


def pd_gravity_torque(k: TrackingParameters, r: ReferencePoint, s: Array, m: Measurement) -> Array:
    """u (p,) [N m] about the point r of the reference."""
    p = m.terms.kappa.shape[0]
    return feedback(k, r, m.q[:p], m.v[:p]) + body_of(m).G[:p]


@dataclass(frozen=True)
class PDGravityController(Controller):
    """The module's equation, a controller without a state; `gains` are torques per angle and rate.

    It needs the weight of the nominal model, `Measurement.body`, and no other part of it.
    """

    needs_body: ClassVar[bool] = True

    reference: Reference
    gains: JointGains = JointGains()

    @property
    def laws(self) -> ControllerLaws:
        k = self.gains.parameters(solve_theta=False)
        return tracked_laws(self.reference, ControllerLaws(k, pd_gravity_torque))
