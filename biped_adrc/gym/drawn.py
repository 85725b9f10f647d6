"""One walk of a stage as a picture: where its stance foot is in the world, and the drawing made once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from biped_adrc.gym.picture import Picture
from biped_adrc.gym.stage import Stage


class Drawn:
    """Walk i of a stage, drawn as it is measured. `follow` is called after every sample."""

    def __init__(self, stage: Stage, i: int):
        self.stage, self.i = stage, i
        scenario, gait = stage.task.scenario, stage.scene.walked
        self.scene = Picture(stage.plant, gait.slope + scenario.slope, stage.scene.on_orbit[0])
        self.foot, self.step = np.zeros(2), 0

    @property
    def t(self) -> float:
        """Time of the walk [s]."""
        return float(self.stage.walks.seen[self.i, self.stage.first])

    def follow(self, begins: bool) -> None:
        """Keep (x, z) [m] of the stance foot: after a touchdown the foot before is the swing foot."""
        row = self.stage.walks.seen[self.i]
        q, step = row[: self.stage.plant.n], int(row[self.stage.first + 1])
        if begins:
            self.foot = np.zeros(2)
        elif step != self.step:
            self.foot = self.foot - self.stage.plant.swing_foot(q)
        self.step = step

    def picture(self) -> NDArray[np.uint8]:
        """(height, width, 3)."""
        q = self.stage.walks.seen[self.i, : self.stage.plant.n]
        return self.scene.drawn(q, self.step, self.foot, self.t)
