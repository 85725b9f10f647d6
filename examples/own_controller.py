"""A controller of one's own, which is compiled as it is: pushed against ADRC, then with many gains at once.

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
        f"peak torque {np.max(np.abs(walk.signals.u)):.0f} N m, "
        f"engine {walk.trajectory.settings['engine']}"
    )

q, v = gait.start(biped)
gains = np.linspace(200.0, 4000.0, 20)  # [N m/rad], with the same machine code
cases = (
    ba.Case(ba.Walker(biped, GravityPD(gait.constraint, K_p=K)), q, v, ba.RK4(1e-3), impacts=10)
    for K in gains
)
walked = [w.status.ok for w in ba.simulate_many(cases)]
print("gains that walk ten steps:", [f"{K:.0f}" for K in gains[walked]])

# To try: let `output` branch on a number, as `if m.v_b[0] > 5.0:`. What does walk.trajectory.settings["why"]
# say, and how much slower is it? `np.where` compiles.
