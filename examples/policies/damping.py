"""A policy across contact: for some ms after a touchdown the joints are damped, and nothing else.

Run: python examples/policies/damping.py
"""

from dataclasses import dataclass

import numpy as np

import biped_adrc as ba
from biped_adrc.control.around import ContactWindow


@dataclass(frozen=True)
class Damping(ContactWindow):
    """u = -damping q_b' for t_step < window [s]; the controller inside runs, and receives this torque."""

    damping: float = 5.0  # [N m s/rad]

    def output(self, s, m):
        u = self.inner.output(s, m)
        return np.where(m.t_step < self.until, -self.damping * m.v_b, u)


ba.register("contact", "damping", Damping, "the joints are damped while contact settles")

walks = {"hardware": {"period": 1e-3, "torque_limit": 150.0}, "run": {"impacts": 3}}
short = {"name": "damping", "window": 5e-3}
for name, policy in (
    ("NPD", {}),
    ("5 N m s/rad", short),
    ("no torque", {**short, "damping": 0.0}),
):
    walk = ba.walk_scenario(ba.Scenario({"name": "NPD", "contact": policy}, **walks))
    print(f"{name:12s} largest error {1e3 * walk.signals.peak_error:.2f} mrad")

# It does not pay. To try: ground={"plant": "mujoco", "time_constant": 0.01}, and controller LESO.
