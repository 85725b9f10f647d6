"""Policies across contact: the last torque goes on, or goes smoothly to the new one.

Run: python examples/policies/ramp_torque.py
"""

from dataclasses import dataclass

import numpy as np

import biped_adrc as ba
from biped_adrc.control.around import ContactWindow


@dataclass(frozen=True)
class RampTorque(ContactWindow):
    """u = u_0 + w (u - u_0), w = x^2 (3 - 2 x), x = t_step / window; u_0 (p,), the last torque with its legs
    swapped, ends the state."""

    window: float = 0.005

    def initial_state(self, m):
        z = self.inner.initial_state(m)
        return np.concatenate((z, self.inner.output(z, m)))

    def jump(self, s, after, swap):
        return np.concatenate((self.inner.jump(s[:-4], after, swap), s[-4:][swap]))

    def correct(self, s, m):
        return np.concatenate((self.inner.correct(s[:-4], m), s[-4:]))

    def output(self, s, m):
        x = np.minimum(m.t_step / self.window, 1.0)
        return s[-4:] + x**2 * (3.0 - 2.0 * x) * (self.inner.output(s[:-4], m) - s[-4:])

    def predict(self, s, m, u):
        last = np.where(m.t_step < self.until, s[-4:], u)
        return np.concatenate((self.inner.predict(s[:-4], m, u), last))


class LastTorque(RampTorque):
    """u = u_0 for t_step < window [s]: every motor keeps its last torque, then gives the controller's."""

    def output(self, s, m):
        return np.where(m.t_step < self.until, s[-4:], self.inner.output(s[:-4], m))


biped = ba.Biped.load("rabbit")
gait = ba.load_gait("published", biped)
npd = ba.NPDController(gait.constraint)

for controller in (npd, RampTorque(npd), LastTorque(npd), LastTorque(npd, 0.015)):
    walker = ba.Walker(biped, controller, timing=ba.SampledTime(1e-3), torque_limit=150.0)
    walk = ba.walk(walker, gait, impacts=3)
    name = f"{type(controller).__name__} {1e3 * getattr(controller, 'window', 0.0):g} ms"
    print(f"{name:20s} largest error {1e3 * walk.signals.peak_error:.2f} mrad")

# It does not pay on rigid ground. To try: on soft ground (docs/guide/mujoco.md).
