"""No torque: u = 0, for passive walkers and for the robot's own motion.

The compass gait down a slope needs nothing more (McGeer, Int. J. Robotics Research 9(2), 1990). Tests use it
where no controller may interfere, such as for the conservation of energy between impacts.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.core.types import Array


@dataclass(frozen=True)
class Passive(Controller):
    """A controller with u = 0 (p,) [N m].

    >>> walk = ba.walk_scenario(ba.Scenario("passive", robot="compass", run={"impacts": 2}))
    >>> walk.impacts
    2
    """

    def output(self, s: Array, m: Measurement) -> Array:
        return np.zeros(m.terms.kappa.shape[0])
