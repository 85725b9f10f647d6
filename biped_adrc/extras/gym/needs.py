"""What the single supports of learners' walks needed of ground and motors, summed up."""

from __future__ import annotations

import numpy as np

from biped_adrc.analysis.certificate import Support


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
