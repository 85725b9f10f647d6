"""What the single supports of learners' walks needed of ground and motors: the certificate, one support at a
time."""

from __future__ import annotations

import numpy as np

from biped_adrc.analysis.certificate import Support
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.engine.run import COMPILED
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.robots.limits import Limits
from biped_adrc.scenario.recording import Walk
from biped_adrc.soft.walking import as_walked


def needed(arc: Arc, walker: Walker | None, loop: object, gait: Gait, limits: Limits) -> Support:
    """What a single support, one arc of all its nodes, needed. loop: what ran, a SteppingLoop on soft
    ground."""
    assert walker is not None
    run = Trajectory((arc,), Status.COMPLETED, settings={"engine": COMPILED})
    run = as_walked(loop, run) if isinstance(loop, SteppingLoop) else run
    return Walk(walker, gait, run).feasible_within(limits).supports[0]


class Needs:
    """What N walks have needed so far; `rows` (N, 4) are what a learner is told.

    Of each: 1 where all single supports that are over are feasible, else 0; largest |F_T| / F_N and least F_N
    [N] of the mean force; largest torque [N m].
    """

    def __init__(self, count: int):
        self.rows = np.zeros((count, 4))

    def begin(self, i: int) -> None:
        """Of walk i none is over."""
        self.rows[i] = 1.0, 0.0, np.inf, 0.0

    def add(self, i: int, support: Support) -> None:
        """One more of walk i."""
        feasible, friction, normal, torque = self.rows[i]
        self.rows[i] = (
            feasible * (not support.infeasible()),
            max(friction, support.mean_friction),
            min(normal, support.mean_normal_force),
            max(torque, support.peak_torque),
        )
