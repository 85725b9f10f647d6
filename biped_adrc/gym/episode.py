"""One walk of a learner, made ready: the scenario's walker with a torque from outside, and where it begins.

The learner's torque is that of `control.added_torque`: around no controller at all (action "torques"), or
around the scenario's own ("added"). Everything else, sensors, limits, delay, pushes, ground and errors of the
model, is the scenario's, drawn from its seed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from biped_adrc.analysis.certificate import Support
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.added_torque import AddedTorque
from biped_adrc.control.passive import Passive
from biped_adrc.engine.run import COMPILED
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.scenario.build import RobotAndGait, build, limits, soft_loop, start
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.run import method_of
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.soft.walking import as_walked
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
    gait: Gait
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
        walker = build(s, scene)
        inner = walker.controller if action == ADDED else Passive()
        torque = np.zeros(walker.plant.p)
        driven = replace(walker, controller=AddedTorque(inner, torque))
        begin, loop = start(s, scene), soft_loop(s, driven)
        return cls(s, driven, scene.walked, method_of(s, driven), *begin, torque, loop)

    @property
    def mode(self) -> Mode:
        """The single support in which it begins."""
        return Mode(self.scenario.first_step)

    def needed(self, arc: Arc) -> Support:
        """What a single support of it, as one arc of all its nodes, needed of ground and motors."""
        run = Trajectory((arc,), Status.COMPLETED, settings={"engine": COMPILED})
        run = run if self.loop is None else as_walked(self.loop, run)
        walk = Walk(self.walker, self.gait, run)
        return walk.feasible_within(limits(self.scenario)).supports[0]


class Needs:
    """What the single supports of N walks have needed so far; their `rows` (N, 4) are what a learner is told.

    Of each: 1 where all that are over are feasible, else 0; largest |F_T| / F_N and least F_N [N] of the mean
    force; largest torque [N m].
    """

    def __init__(self, count: int):
        self.rows = np.zeros((count, 4))

    def begin(self, i: int) -> None:
        """Of walk i none is over."""
        self.rows[i] = 1.0, 0.0, np.inf, 0.0

    def add(self, i: int, found: Support) -> None:
        """One more of walk i."""
        feasible, friction, normal, torque = self.rows[i]
        self.rows[i] = (
            feasible * (not found.infeasible()),
            max(friction, found.mean_friction),
            min(normal, found.mean_normal_force),
            max(torque, found.peak_torque),
        )
