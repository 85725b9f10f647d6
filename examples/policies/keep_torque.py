"""A policy across contact: what the model does not know goes on over a touchdown as a torque.

Run: python examples/policies/keep_torque.py
"""

from dataclasses import dataclass

import numpy as np

import biped_adrc as ba
from biped_adrc.control.around import AcrossContact


@dataclass(frozen=True)
class KeepTorque(AcrossContact):
    """w = kappa^-1 (xi^ - xi) of the last tick ends the state; after impact xi^ = xi + kappa w, w swapped."""

    def initial_state(self, m):
        return np.concatenate((self.inner.initial_state(m), np.zeros(4)))

    def jump(self, s, after, swap):
        w = s[-4:][swap]
        xi = after.terms.xi + after.terms.kappa @ w
        return np.concatenate((self.inner.observer.initial_state(after.q_b, after.v_b, xi), w))

    def correct(self, s, m):
        z = self.inner.correct(s[:-4], m)
        unknown = self.inner.estimate(z, m).disturbance - m.terms.xi
        return np.concatenate((z, m.terms.kappa_inverse @ unknown))

    def output(self, s, m):
        return self.inner.output(s[:-4], m)

    def estimate(self, s, m):
        return self.inner.estimate(s[:-4], m)

    def predict(self, s, m, u):
        return np.concatenate((self.inner.predict(s[:-4], m, u), s[-4:]))


biped = ba.Biped.load("rabbit")
gait = ba.load_gait("published", biped)
adrc = ba.ADRCController(gait.constraint, ba.GPIObserver.from_bandwidth(200.0))
push = ba.TorqueStep([20, 20, 10, 10, 0], step=1, start=0.1)  # [N m], [s], for good

for controller in (adrc, KeepTorque(adrc)):
    walker = ba.Walker(biped, controller, push, timing=ba.SampledTime(2e-3))
    arc = ba.walk(walker, gait, impacts=2).trajectory.arcs[1]
    early = arc.x[arc.t < arc.t[0] + 0.1]
    error = max(np.max(np.abs(x[:4] - gait.constraint(0.0, x[:5], x[5:10]).q_d)) for x in early)
    print(f"{type(controller).__name__:14s} {1e3 * error:.2f} mrad in the 0.1 s after touchdown")

# It pays under a push that stays. To try: the paper's push, which ends before the touchdown.
