"""ADRC without a model: one number b_0 per joint in place of the inertia.

    y   = q_b - q_d
    y'' = b_0 u + f
    u   = (-K_p y^ - K_d y'^ - f^) / b_0

q_b (p,) are the joints with motors, u (p,) [N m] their torques, ^ marks an estimate. b_0 [1/(kg m^2)] is
constant: the acceleration of a joint per torque of its own motor. f (p,) [rad/s^2] is all the rest of y''. The
law uses the measured angles, the reference and the torque applied, and no term of the model.

The model says y'' = L u + xi_y, as in `output_adrc`. So the law is the output form with diag b_0 in place of L
(p, p), and the observer estimates f = xi_y + (L - diag b_0) u. L couples the joints and changes along a step.
Frozen, with the same gains for all joints, the loop is that of p single joints y'' = lambda b_0 u + .. with the
eigenvalues lambda of L diag(b_0)^-1; for RABBIT they lie between 0.20 and 1.65. In continuous time the default
gains and observer are stable for lambda = 0.15 to 5.5. With the gains of Table II and an observer of 500 rad/s
lambda has to be above 0.34, and RABBIT does not walk. A smaller b_0 makes all lambda larger.

Herbst, Electronics 2(3), 2013, for b_0; Madonski, Shao, Zhang, Gao, Yang, Li, Control Engineering Practice 84,
2019, for the observer of the error y; Han, IEEE Trans. Industrial Electronics 56(3), 2009, for f.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from biped_adrc.control.base import Measurement
from biped_adrc.control.output_adrc import OutputADRCController
from biped_adrc.control.tracking import Gains, check_joints, per_joint, unchanged
from biped_adrc.core.types import Array, read_only
from biped_adrc.gait.reference import ReferencePoint
from biped_adrc.observers.base import Estimate, Observer
from biped_adrc.observers.gpi import GPIObserver

RABBIT = read_only((0.48, 0.59, 0.82, 0.95))
"""b_0 [1/(kg m^2)] of RABBIT's stance hip, swing hip, stance knee and swing knee: means of the diagonal of
kappa along the gaits v0.5 to v0.8."""
_SLOW = Gains(900.0, 60.0)
"""omega_c = 30 rad/s."""


@dataclass(frozen=True)
class B0ADRCController(OutputADRCController):
    """ADRC of y = q_b - q_d with b_0 in place of the model; all defaults are those of RABBIT.

    reference: q_d. observer: of y, y' and f. gains: K_p [1/s^2], K_d [1/s]. b_0 [1/(kg m^2)]: one number, or
    one per joint (p,). reset: MODEL begins anew with f^ = 0 at impact, and MEASURED keeps f^, relabelled.
    Raises InputError for numbers that are not positive.

    >>> controller = ba.B0ADRCController(gait.constraint, b_0=0.6)
    >>> ba.walk(ba.Walker(biped, controller), gait, impacts=1).impacts
    1
    """

    observer: Observer = field(default_factory=lambda: GPIObserver.from_bandwidth(200.0, 1))
    gains: Gains = _SLOW
    b_0: Array | float = field(default_factory=lambda: RABBIT)

    def __post_init__(self) -> None:
        b_0 = per_joint(self.b_0, "b_0, the acceleration of a joint per torque of its own motor,")
        object.__setattr__(self, "b_0", b_0)

    def initial_state(self, m: Measurement) -> Any:
        """The observer at the measured y and y', with f^ = 0. Raises InputError for a wrong number of b_0."""
        check_joints(self.b_0, "b_0", len(m.q_b))
        return super().initial_state(m)

    def measured_output(self, m: Measurement) -> Estimate:
        """y [rad], y' [rad/s], and f = 0 [rad/s^2], as no model knows it; each (p,)."""
        r = self.point(m)  # the reference now
        return Estimate(m.q_b - r.q_d, m.v_b - r.dq_d, np.zeros(len(r.q_d)))

    def observer_input(self, m: Measurement, u: Array) -> Array:
        """b_0 u (p,) [rad/s^2], the observer's input for the torque u (p,) [N m]."""
        return self.b_0 * u

    def torque(self, r: ReferencePoint, x: Estimate, m: Measurement) -> Array:
        """u (p,) [N m] for the point r of the reference and estimates x of y, y' and f."""
        # near a touchdown, inside `ImpactInvariant`, without the part that an impulse on the foot can change
        dy = x.velocity if m.impulse is None else unchanged(r, x.velocity, m.impulse)
        return (-self.gains.K_p * x.position - self.gains.K_d * dy - x.disturbance) / self.b_0

    def joint_estimate(self, x: Estimate, m: Measurement) -> Estimate:
        """Estimates of q_b, q_b' and xi (p,) for plots: xi_y = f + (diag b_0 - L) u with the law's own torque u
        and the model's L.
        """
        u = self.torque(self.point(m), x, m)
        xi_y = x.disturbance + self.b_0 * u - super().observer_input(m, u)
        return super().joint_estimate(x._replace(disturbance=xi_y), m)
