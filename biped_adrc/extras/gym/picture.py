"""The robot from the side as an array of pixels.

The lines are those of `view.from_the_side`, drawn with Pillow, which takes a millisecond or two where a figure
takes thirty.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from biped_adrc.core.types import Array
from biped_adrc.extras.gym.stage import Stage
from biped_adrc.view.colours import TRUNK
from biped_adrc.view.from_the_side.moving_parts import COLOURS
from biped_adrc.view.from_the_side.side_view import bones, placed_lines, roles_of
from biped_adrc.view.placement import TILE, joint_values, link_placements
from biped_adrc.view.style import GREY

WIDTH, HEIGHT = 480, 360
"""Size of a picture [pixels]."""
LINE, MARGIN = 6, 40
"""Width of a link, and height of the ground in the picture [pixels]."""


class Picture:
    """Draws the walks of a stage as they are measured; the height of the robot on the orbit decides
    the scale.
    """

    def __init__(self, stage: Stage):
        self.stage, self.biped, self.bones = stage, stage.plant, bones(stage.plant)
        self.fall = math.tan(stage.scene.walked.slope + stage.task.scenario.ground.slope)
        lines = self._lines(stage.scene.on_orbit[0], 1, np.zeros(2))
        highest = max(float(z) for ends, _ in lines for z in ends[:, 1])
        self.scale = (HEIGHT - 2 * MARGIN) / max(highest, 1e-3)

    def _lines(self, q: Array, step: int, foot: Array) -> list[tuple[Array, str]]:
        """Ends (2, 2) [m] of every link in the world, and its leg: "stance", "swing" or "".

        q (n,) [rad]: posture in single support `step`. foot (2,) [m]: place of the stance foot.
        """
        values = joint_values(self.biped, q, step, float(foot[0]), float(foot[1]))
        ends = placed_lines(self.bones, link_placements(self.biped.tree, values))
        return list(zip(ends, roles_of(self.bones, self.biped, step), strict=True))

    def drawn(self, i: int) -> NDArray[np.uint8]:
        """Draw walk i as pixels (HEIGHT, WIDTH, 3)."""
        row, foot, first = self.stage.view[i], self.stage.feet[i], self.stage.first
        q, t, step = row[: self.biped.n], float(row[first]), int(row[first + 1])
        image = Image.new("RGB", (WIDTH, HEIGHT), "white")
        pen = ImageDraw.Draw(image)
        x_0 = float(foot[0] + self.biped.hip(q)[0])

        def level(x: float) -> float:
            return float(foot[1] - self.fall * (x - foot[0]))

        def pixel(x: float, z: float) -> tuple[float, float]:
            below = HEIGHT - MARGIN - self.scale * (z - level(x_0))
            return WIDTH / 2 + self.scale * (x - x_0), below

        reach = WIDTH / 2 / self.scale
        for k in range(math.floor((x_0 - reach) / TILE), math.ceil((x_0 + reach) / TILE)):
            tile = [pixel(x, level(x)) for x in (k * TILE, (k + 1) * TILE)]
            pen.line(tile, fill=GREY if k % 2 else TRUNK, width=4)
        for ends, leg in self._lines(q, step, foot):
            pen.line([pixel(*end) for end in ends.tolist()], fill=COLOURS[leg], width=LINE)
        pen.text((8, 8), f"t = {t:.3f} s, step {step}", fill=TRUNK)
        return np.array(image)
