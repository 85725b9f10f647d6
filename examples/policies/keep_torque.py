"""A policy across contact: what the model does not know goes on over a touchdown as a torque.

Run: python examples/policies/keep_torque.py
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

import biped_adrc as ba
from biped_adrc.control.around import AcrossContact


class State(NamedTuple):
    inner: np.ndarray  # of the observer
    w: np.ndarray  # kappa^-1 (xi^ - xi) of the last tick (4,) [N m]


@dataclass(frozen=True)
class KeepTorque(AcrossContact):
    """After impact xi^ = xi + kappa w, with w of the last tick, its legs swapped."""

    def initial_state(self, m):
        return State(self.inner.initial_state(m), np.zeros(4))

    def jump(self, s, after, swap):
        w = s.w[swap]
        xi = after.terms.xi + after.terms.kappa @ w
        return State(self.inner.observer.initial_state(after.q_b, after.v_b, xi), w)

    def correct(self, s, m):
        z = self.inner.correct(s.inner, m)
        unknown = self.inner.estimate(z, m).disturbance - m.terms.xi
        return State(z, m.terms.kappa_inverse @ unknown)

    def output(self, s, m):
        return self.inner.output(s.inner, m)

    def estimate(self, s, m):
        return self.inner.estimate(s.inner, m)

    def predict(self, s, m, u):
        return State(self.inner.predict(s.inner, m, u), s.w)


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
