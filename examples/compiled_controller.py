"""A controller of one's own that compiles: its law is a function of arrays, written once.

Run: python examples/compiled_controller.py
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

import biped_adrc as ba


class GravityPDParameters(NamedTuple):
    h: ba.VirtualConstraint
    K_p: float  # [N m/rad]
    K_d: float  # [N m s/rad]


def gravity_pd(k, s, m):
    """u = K_p (q_d - q_b) + K_d (q_d' - q_b') + gravity and Coriolis terms of the motors."""
    r, p = k.h(m.t, m.q, m.v), len(m.terms.kappa)
    return k.K_p * (r.q_d - m.q[:p]) + k.K_d * (r.dq_d - m.v[:p]) + m.terms.Omega[:p]


@dataclass(frozen=True)
class GravityPD(ba.Controller):
    constraint: ba.VirtualConstraint
    K_p: float = 2500.0
    K_d: float = 120.0

    @property
    def laws(self):
        parameters = GravityPDParameters(self.constraint, self.K_p, self.K_d)
        return ba.ControllerLaws(parameters, gravity_pd)


biped = ba.Biped.load("rabbit")
gait = ba.load_gait("published", biped)
walker = ba.Walker(biped, GravityPD(gait.constraint))

for engine in ("pinocchio", "compiled"):
    walk = ba.walk(walker, gait, impacts=3, engine=engine)
    x = walk.trajectory.before("foot_strike")[-1]
    print(f"{engine:10s} q- = {np.array2string(x[:5], precision=8)}")

q, v = gait.start(biped)
gains = np.linspace(200.0, 4000.0, 20)  # [N m/rad]
cases = (
    ba.Case(ba.Walker(biped, GravityPD(gait.constraint, K_p=K)), q, v, ba.RK4(1e-3), impacts=10)
    for K in gains
)
walked = list(ba.simulate_many(cases))
print(
    "gains that walk ten steps:",
    [f"{K:.0f}" for K, w in zip(gains, walked, strict=True) if w.status.ok],
)

# To try: give the law a branch on a number, such as `if u[0] > 50.0:`. What does
# walk.trajectory.settings["why"] say, and how much slower is it? `np.where` compiles.
