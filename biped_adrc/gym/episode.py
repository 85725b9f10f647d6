"""One walk of a learner, made ready: the scenario's walker with a torque from outside, and where it begins.

The learner's torque is that of `control.added_torque`: around no controller at all (action "torques"), or
around the scenario's own ("added"). Everything else, sensors, limits, delay, pushes, ground and errors of the
model, is the scenario's, drawn from its seed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.added_torque import AddedTorque
from biped_adrc.control.passive import Passive
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.scenario.build import RIGID, RobotAndGait, build, soft_loop, start
from biped_adrc.scenario.run import method_of
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.types import Array

TORQUES, ADDED = "torques", "added"
"""What an action is: all of the torque, or an addition to that of the scenario's controller."""


@dataclass(frozen=True)
class Episode:
    """One walk that a learner drives."""

    scenario: Scenario
    """With the seed of this walk."""
    walker: Walker
    """Its controller is an `AddedTorque` around the scenario's, or around none."""
    method: OneStepMethod
    q: Array
    """At the start (n,) [rad]."""
    v: Array
    """At the start (n,) [rad/s]."""
    torque: Array
    """The learner's (p,) [N m], to be written before each sample where the controller runs in Python."""
    loop: SteppingLoop | None
    """Around another plant than the rigid one."""

    @classmethod
    def of(cls, s: Scenario, scene: RobotAndGait, action: str) -> Episode:
        """A scenario with its own seed. Raises InputError for values that do not fit together."""
        walker = build(s, scene, metered=s.plant == RIGID)
        inner = walker.controller if action == ADDED else Passive()
        torque = np.zeros(walker.plant.p)
        driven = replace(walker, controller=AddedTorque(inner, torque))
        begin, loop = start(s, scene), soft_loop(s, driven)
        return cls(s, driven, method_of(s, driven), *begin, torque, loop)

    @property
    def mode(self) -> Mode:
        """The single support in which it begins."""
        return Mode(self.scenario.first_step)
