"""No torque at all: u = 0, for passive walkers and for seeing what a robot does by itself.

The compass gait down a slope needs nothing more (McGeer, Int. J. Robotics Research 9(2), 1990). Tests take it
where the loop has to do nothing, such as for the conservation of energy between impacts.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.core.types import Array


@dataclass(frozen=True)
class Passive(Controller):
    """u = 0 (p,) [N m].

    >>> walk = ba.walk_scenario(ba.Scenario("passive", robot="compass", run={"impacts": 2}))
    >>> walk.impacts
    2
    """

    def output(self, s: Array, m: Measurement) -> Array:
        return np.zeros(m.terms.kappa.shape[0])
