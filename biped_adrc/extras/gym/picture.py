"""The robot from the side as an array of pixels, and a window that shows it.

The lines are those of `view.from_the_side`, drawn with Pillow, which takes a millisecond or two where a figure
takes thirty. The window is matplotlib's; where there is no screen its backend has none, and nothing is shown.
"""

from __future__ import annotations

import math
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from biped_adrc.core.types import Array
from biped_adrc.extras.gym.stage import Stage
from biped_adrc.model.biped import Biped
from biped_adrc.view.colours import TRUNK
from biped_adrc.view.from_the_side.moving_parts import COLOURS
from biped_adrc.view.from_the_side.side_view import bones, placed_lines, roles_of
from biped_adrc.view.placement import TILE, joint_values, link_placements
from biped_adrc.view.style import GREY

WIDTH, HEIGHT = 480, 360
"""Of a picture [pixels]."""
LINE, MARGIN = 6, 40
"""Width of a link, and height of the ground in the picture [pixels]."""
PICTURES = 50
"""Of the window in a second of the walk."""


class Picture:
    """The drawing of one robot on a slope [rad]; q (n,) [rad]: a posture that decides the scale."""

    def __init__(self, biped: Biped, slope: float, q: Array):
        self.biped, self.bones, self.fall = biped, bones(biped), math.tan(slope)
        highest = max(float(z) for ends, _ in self._lines(q, 1, np.zeros(2)) for z in ends[:, 1])
        self.scale = (HEIGHT - 2 * MARGIN) / max(highest, 1e-3)

    def _lines(self, q: Array, step: int, foot: Array) -> list[tuple[Array, str]]:
        """Ends (2, 2) [m] of every link in the world, and its leg: "stance", "swing" or ""."""
        values = joint_values(self.biped, q, step, float(foot[0]), float(foot[1]))
        ends = placed_lines(self.bones, link_placements(self.biped.tree, values))
        return list(zip(ends, roles_of(self.bones, self.biped, step), strict=True))

    def drawn(self, q: Array, step: int, foot: Array, t: float) -> NDArray[np.uint8]:
        """(HEIGHT, WIDTH, 3) at q (n,) [rad] in single support `step`, its foot at `foot` (2,) [m], t [s]."""
        image = Image.new("RGB", (WIDTH, HEIGHT), "white")
        pen = ImageDraw.Draw(image)
        middle = foot + self.biped.hip(q) * np.array([1.0, 0.0])
        level = float(foot[1]) - self.fall * float(middle[0] - foot[0])

        def pixel(x: float, z: float) -> tuple[float, float]:
            return (
                WIDTH / 2 + self.scale * (x - float(middle[0])),
                HEIGHT - MARGIN - self.scale * (z - level),
            )

        reach, x_0 = WIDTH / 2 / self.scale, float(middle[0])
        for k in range(math.floor((x_0 - reach) / TILE), math.ceil((x_0 + reach) / TILE)):
            tile = [
                pixel(x, foot[1] - self.fall * (x - foot[0])) for x in (k * TILE, (k + 1) * TILE)
            ]
            pen.line(tile, fill=GREY if k % 2 else TRUNK, width=4)
        for ends, leg in self._lines(q, step, foot):
            pen.line([pixel(*end) for end in ends.tolist()], fill=COLOURS[leg], width=LINE)
        pen.text((8, 8), f"t = {t:.3f} s, step {step}", fill=TRUNK)
        return np.array(image)


class Drawn:
    """Walk i of a stage, drawn as it is measured. `follow` is called after every sample."""

    def __init__(self, stage: Stage, i: int):
        self.stage, self.i = stage, i
        scenario, gait = stage.task.scenario, stage.scene.walked
        self.scene = Picture(
            stage.plant, gait.slope + scenario.ground.slope, stage.scene.on_orbit[0]
        )
        self.foot, self.step = np.zeros(2), 0

    @property
    def t(self) -> float:
        """Time of the walk [s]."""
        return float(self.stage.view[self.i, self.stage.first])

    def follow(self, begins: bool) -> None:
        """Keep (x, z) [m] of the stance foot: after a touchdown the foot before is the swing foot."""
        row = self.stage.view[self.i]
        q, step = row[: self.stage.plant.n], int(row[self.stage.first + 1])
        if begins:
            self.foot = np.zeros(2)
        elif step != self.step:
            self.foot = self.foot - self.stage.plant.swing_foot(q)
        self.step = step

    def picture(self) -> NDArray[np.uint8]:
        """(height, width, 3)."""
        q = self.stage.view[self.i, : self.stage.plant.n]
        return self.scene.drawn(q, self.step, self.foot, self.t)


class Window:
    """A window that shows one picture after the other, no faster than the walk; none without a screen."""

    def __init__(self) -> None:
        self.figure: Any = None
        self.shown, self.clock = -math.inf, 0.0

    def due(self, t: float, begins: bool) -> bool:
        """Whether there should be another picture at t [s] of the walk."""
        return begins or t - self.shown >= 1.0 / PICTURES

    def show(self, picture: NDArray[np.uint8]) -> None:
        """In the window, which is opened by the first one."""
        import matplotlib.pyplot as plt

        if self.figure is None:
            self.figure = plt.figure(figsize=(WIDTH / 100, HEIGHT / 100), dpi=100)
            axes = self.figure.add_axes((0.0, 0.0, 1.0, 1.0))
            axes.set_axis_off()
            self.image = axes.imshow(picture)
            if self.on_screen:
                self.figure.show()
        self.image.set_data(picture)
        if self.on_screen:
            time.sleep(max(0.0, self.clock + 1.0 / PICTURES - time.monotonic()))
            self.clock = time.monotonic()
        self.figure.canvas.draw_idle()
        self.figure.canvas.flush_events()

    @property
    def on_screen(self) -> bool:
        """Whether the backend of matplotlib has windows."""
        return self.figure.canvas.required_interactive_framework is not None

    def close(self) -> None:
        """Close it, if it is open."""
        import matplotlib.pyplot as plt

        if self.figure is not None:
            plt.close(self.figure)
            self.figure = None
