"""A policy across contact: after a touchdown the observer's part of the torque grows from none.

Run: python examples/policies/fade.py
"""

from dataclasses import dataclass

import numpy as np

import biped_adrc as ba
from biped_adrc.control.around import ContactWindow


@dataclass(frozen=True)
class Fade(ContactWindow):
    """u_0 + w (u - u_0), w = x^2 (3 - 2 x), x = t_step / window [s]; u_0: of an observer that begins anew."""

    window: float = 0.03

    def output(self, s, m):
        x = np.minimum(m.t_step / self.window, 1.0)
        fresh = self.inner.output(self.inner.initial_state(m), m)
        return fresh + x**2 * (3.0 - 2.0 * x) * (self.inner.output(s, m) - fresh)


biped = ba.Biped.load("rabbit")
gait = ba.load_gait("published", biped)
adrc = ba.ADRCController(gait.constraint, ba.GPIObserver.from_bandwidth(500.0))

for controller in (adrc, Fade(adrc)):
    walker = ba.Walker(biped, controller, timing=ba.SampledTime(1e-3), torque_limit=150.0)
    walk = ba.walk(walker, gait, impacts=3)
    print(f"{type(controller).__name__:15s} largest error {1e3 * walk.signals.peak_error:.3f} mrad")

# It does not pay on rigid ground, where contact settles at once. To try: on soft ground (docs/guide/mujoco.md).
