"""A controller of one's own in plain Python, pushed in the third step, against ADRC.

Run: python examples/own_controller.py
"""

from dataclasses import dataclass

import numpy as np

import biped_adrc as ba


@dataclass(frozen=True)
class GravityPD(ba.Controller):
    """u = K_p (q_d - q_b) + K_d (q_d' - q_b') + gravity and Coriolis terms of the motors."""

    reference: ba.Reference
    K_p: float = 2500.0  # [N m/rad]
    K_d: float = 120.0  # [N m s/rad]

    def output(self, s, m):
        r = self.reference(m.t, m.q, m.v)
        return (
            self.K_p * (r.q_d - m.q_b) + self.K_d * (r.dq_d - m.v_b) + m.terms.Omega[: len(m.q_b)]
        )


biped = ba.Biped.load("rabbit")
gait = ba.load_gait("published", biped)
push = ba.TorquePulse([30, 30, 30, 30, 0], step=3, start=0.1, stop=0.3)  # [N m], [s]

for controller in (GravityPD(gait.constraint), ba.ADRCController(gait.constraint)):
    walk = ba.walk(ba.Walker(biped, controller, push), gait, impacts=6)
    print(
        f"{type(controller).__name__:16s} {walk.trajectory.status.name:10s} "
        f"largest tracking error {walk.signals.peak_error:.1e} rad, "
        f"peak torque {np.max(np.abs(walk.signals.u)):.0f} N m"
    )

# To try: how large may K_p be before 150 N m (Walker(..., torque_limit=150)) make it fall?
