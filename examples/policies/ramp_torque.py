"""Policies across contact: the last torque goes on, or goes smoothly to the new one.

Run: python examples/policies/ramp_torque.py
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

import biped_adrc as ba
from biped_adrc.control.around import ContactWindow


class State(NamedTuple):
    inner: np.ndarray  # of the controller inside
    u_0: np.ndarray  # the last torque (4,) [N m]


@dataclass(frozen=True)
class RampTorque(ContactWindow):
    """u = u_0 + w (u - u_0), w = x^2 (3 - 2 x), x = t_step / window; u_0 has its legs swapped at impact."""

    window: float = 0.005

    def initial_state(self, m):
        z = self.inner.initial_state(m)
        return State(z, self.inner.output(z, m))

    def jump(self, s, after, swap):
        return State(self.inner.jump(s.inner, after, swap), s.u_0[swap])

    def correct(self, s, m):
        return State(self.inner.correct(s.inner, m), s.u_0)

    def output(self, s, m):
        x = np.minimum(m.t_step / self.window, 1.0)
        return s.u_0 + x**2 * (3.0 - 2.0 * x) * (self.inner.output(s.inner, m) - s.u_0)

    def predict(self, s, m, u):
        last = np.where(m.t_step < self.until, s.u_0, u)
        return State(self.inner.predict(s.inner, m, u), last)


class LastTorque(RampTorque):
    """u = u_0 for t_step < window [s]: every motor keeps its last torque, then gives the controller's."""

    def output(self, s, m):
        return np.where(m.t_step < self.until, s.u_0, self.inner.output(s.inner, m))


biped = ba.Biped.load("rabbit")
gait = ba.load_gait("published", biped)
npd = ba.NPDController(gait.constraint)

for controller in (npd, RampTorque(npd), LastTorque(npd), LastTorque(npd, 0.015)):
    walker = ba.Walker(biped, controller, timing=ba.SampledTime(1e-3), torque_limit=150.0)
    walk = ba.walk(walker, gait, impacts=3)
    name = f"{type(controller).__name__} {1e3 * getattr(controller, 'window', 0.0):g} ms"
    print(f"{name:20s} largest error {1e3 * walk.signals.peak_error:.2f} mrad")

# It does not pay on rigid ground. To try: on soft ground (docs/guide/mujoco.md).
