"""A policy across contact : the estimated disturbance is frozen for some ms after a touchdown.

Run: python examples/policies/freeze.py
"""

from dataclasses import dataclass

import numpy as np

import biped_adrc as ba
from biped_adrc.control.around import ContactWindow


@dataclass(frozen=True)
class Freeze(ContactWindow):
    """xi^ stays as the reset left it for t_step < window [s]; positions and rates follow the measurement.

    For an observer whose state is x1^, x2^, then xi^ and its derivatives, each of p joints.
    """

    def correct(self, s, m):
        return self._frozen(s, m, self.inner.correct(s, m))

    def predict(self, s, m, u):
        return self._frozen(s, m, self.inner.predict(s, m, u))

    def _frozen(self, s, m, new):
        """`new` with what stands in s behind x1^ and x2^."""
        p = len(m.q_b)
        return np.where(m.t_step < self.until, np.concatenate((new[: 2 * p], s[2 * p :])), new)


biped = ba.Biped.load("rabbit")
gait = ba.load_gait("published", biped)
adrc = ba.ADRCController(gait.constraint, ba.GPIObserver.from_bandwidth(500.0))
push = ba.TorquePulse([30, 30, 30, 30, 0], step=2, start=0.1, stop=0.3)  # [N m], [s]

for controller in (adrc, Freeze(adrc), Freeze(adrc, 0.2)):
    walker = ba.Walker(biped, controller, push, timing=ba.SampledTime(1e-3))
    walk = ba.walk(walker, gait, impacts=3)
    name = f"{type(controller).__name__} {1e3 * getattr(controller, 'window', 0.0):g} ms"
    print(f"{name:20s} largest error {1e3 * walk.signals.peak_error:.2f} mrad")

# Hold does the same for an observer of any order. To try: Table I's, ADRCController(gait.constraint).
