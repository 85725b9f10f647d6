"""Parts of an animation in the x-z plane: ground and walks, and the pixels of frames at given times.

`DrawnWalk` makes the artists of one walk on an Axes once; its method `show` sets their positions and colours
for the time t [s]. The module `moving_picture` puts the parts together. Matplotlib draws
walk k with zorder 10 k to 10 k + 9, so that one walk is in front of another as a whole, and the ground and the
paths of hip and foot behind all walks, as k begins at 2. An arc is one single support, a foothold the place of
its stance foot. A role says which leg a line belongs to: stance, swing, or "" for the trunk.
"""

import math
import textwrap
from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrow

from biped_adrc.core.types import Array
from biped_adrc.view import colours
from biped_adrc.view.from_the_side.side_view import SideView, placed_lines
from biped_adrc.view.placement import TILE, loads_at

STONE = "#7a5230"
"""Colour of a stone: brown."""
COLOURS = {"stance": colours.STANCE, "swing": colours.SWING, "": colours.TRUNK}
"""Colour of a line by its role; the trunk has the role ""."""
SOLE, HEADROOM = 0.12, 1.2
"""Ground shown below the foot [m], and the height of the picture above it as a multiple of the robot's."""
DPI = 100
"""Pixels for each inch of a figure; sizes here are in pixels."""
LETTER = 9.5
"""Width of a letter of 11 points [px], of the wide ones."""


def frames(figure: Figure, show: Callable[[float], None], times: Array) -> list[Array]:
    """Draw the figure at the times (K,) [s]; returns the pixels (height, width, 3) of each, 0 to 255.

    show: the function that moves the figure's parts to a time. The figure is made once; from frame to frame
    only its lines move, as making a figure takes longer than drawing it.
    """
    canvas, out = FigureCanvasAgg(figure), []
    for t in times.tolist():
        show(t)
        canvas.draw()  # type: ignore[no-untyped-call]
        out.append(np.asarray(canvas.buffer_rgba())[:, :, :3].copy())  # type: ignore[no-untyped-call]
    return out


def wrapped(words: str, width: float) -> str:
    """Break a text in letters of 11 points into lines of at most `width` [px]; its own line breaks stay."""
    # LETTER: width of a letter [px]
    return "\n".join(textwrap.fill(line, int(width / LETTER)) for line in words.split("\n"))


def ground(axes: Axes, views: list[SideView]) -> None:
    """Draw the ground of every walk as a line, and the tiles and stepping stones of the last one.

    Equal lines are drawn once. Each stone is drawn where the next foot has to land, measured from the foothold
    before it, within the walker's tolerance.
    """
    # some metres beyond the footholds, so that no picture reaches the end of the ground
    x = np.concatenate([view.scene.footholds for view in views])
    low, high = math.floor(x.min()) - 3, math.ceil(x.max()) + 4
    lines = [view.scene.surface.line(low, high) for view in views]
    for line in {line.tobytes(): line for line in lines}.values():
        axes.plot(*line.T, color="black", lw=1.0, zorder=1)
    scene = views[-1].scene
    for ends, light in scene.surface.tiles(round(low / TILE), round(high / TILE)):
        shade = "#c8c8c8" if light else "#9e9e9e"
        edge, top = ends.T
        axes.fill_between(edge, top - 0.05, top, color=shade, lw=0.0, zorder=0)
    if scene.walker.stones is not None:
        half = scene.walker.stones.tolerance
        # a walk may have more or fewer footholds than stones
        for x_0, L in zip(scene.footholds, scene.walker.stones.lengths, strict=False):
            at, z = (x_0 + L - half, x_0 + L + half), scene.level(float(x_0 + L))
            axes.plot(at, (z, z), color=STONE, lw=6.0, solid_capstyle="butt", zorder=1)


def follow(axes: Axes, view: SideView, t: float, left: float, right: float) -> None:
    """Set the limits of the axes around the hip at t [s]: `left` [m] to its left, `right` [m] to its right, and
    in height around the ground below it.

    The limits stay as they are where the hip's position is not finite, as in a walk that has diverged.
    """
    x = float(view.points(t)[0])  # of the hip
    if not math.isfinite(x):
        return
    z = view.scene.level(x)
    axes.set_xlim(x - left, x + right)
    # SOLE: ground shown below the foot [m]; HEADROOM: height shown over the robot's
    axes.set_ylim(z - SOLE, z + HEADROOM * view.height)


class DrawnWalk:
    """The artists of one walk: links as thick lines in the colours of their roles, paths, footprints and loads.

    The ground reaction is an arrow at the stance foot, an external torque a ring around its joint. On soft
    ground the other foot has an arrow too while both carry, and "slips" is written while a foot slips. opacity:
    0 to 1. order: number of the walk's layer; a higher one is in front.
    """

    def __init__(self, axes: Axes, view: SideView, opacity: float, order: int) -> None:
        self.axes, self.view = axes, view
        layer = 10 * order
        (self.hip,) = axes.plot([], [], color="#555555", lw=0.9, alpha=opacity, zorder=order)
        (self.foot,) = axes.plot([], [], color=colours.SWING, lw=0.9, alpha=opacity, zorder=order)
        (self.prints,) = axes.plot([], [], "^", color="black", ms=4, alpha=opacity, zorder=order)
        self.links = LineCollection([], capstyle="round", alpha=opacity, zorder=layer)
        self.torques = PolyCollection([], color=colours.TORQUE, alpha=opacity, zorder=layer + 2)
        axes.add_collection(self.links)
        axes.add_collection(self.torques)
        self.arrows = [
            FancyArrow(0, 0, 0, 0, width=0.024, length_includes_head=True) for _ in range(2)
        ]
        for arrow in self.arrows:
            arrow.set(color=colours.REACTION, alpha=opacity, zorder=layer + 1)
            axes.add_patch(arrow)
        self.text = axes.text(0.0, 0.0, "", color=colours.REACTION, fontsize=9, zorder=layer + 3)
        # of the calls of `show` so far: places of hip and swing foot, and number of the single support
        self.passed: list[Array] = []
        self.steps: list[int] = []

    def show(self, t: float) -> None:
        """Move all artists to t [s]; from call to call t has to grow, since the paths are extended."""
        view, scene = self.view, self.view.scene
        roles, placements = view.roles(t), view.placements(t)
        # placed_lines: both ends of every line of the robot, from the placements of its links
        self.links.set_segments(placed_lines(view.bones, placements))
        self.links.set_color([COLOURS[role] for role in roles])
        self.links.set_linewidth([9.0 if role == "" else 6.5 for role in roles])
        i, points = scene.arc_at(t), view.points(t)
        self.prints.set_data(scene.footholds[: i + 1], scene.heights[: i + 1])
        # the path of the swing foot breaks at an impact, where the other foot becomes the swing foot
        self.passed.append(points)
        self.steps.append(view.step(t))
        path, jumps = np.array(self.passed), np.flatnonzero(np.diff(self.steps)) + 1
        self.hip.set_data(*path[:, :2].T)
        self.foot.set_data(*np.insert(path[:, 2:], jumps, np.nan, axis=0).T)
        acting, foot = loads_at(scene, t), np.array(scene.foot(i, t))
        # drawn: vector of the arrow [m]; cut: a text if it was cut; points[2:]: the swing foot
        drawn, cut = self._arrow(0, foot, acting.ground_reaction)
        self._arrow(1, points[2:], acting.other)
        self.text.set_text(cut or ("slips" if acting.slips else ""))
        right = foot[0] > np.mean(self.axes.get_xlim())  # so that the words stay in the picture
        self.text.set_horizontalalignment("right" if right else "left")
        # beside the middle of the arrow
        beside = foot[0] + (-0.05 if right else 0.05)
        self.text.set_position((beside, foot[1] + max(0.5 * drawn[1], 0.05)))
        radii = colours.METRES_PER_NEWTON_METRE * acting.zeta
        torque = dict(zip(scene.biped.description.joints, radii.tolist(), strict=True))
        # a ring at each joint with a torque, at x and z of its child link
        pushed = [joint for joint in scene.biped.tree.joints if torque.get(joint.name)]
        self.torques.set_verts(
            [placements[j.child][[0, 2], 3] + colours.bent_arrow(torque[j.name]) for j in pushed]
        )

    def _arrow(self, k: int, start: Array, force: Array) -> tuple[Array, str]:
        """Draw arrow k (0: stance foot, 1: other foot) for a force (2,) [N] at `start` (2,) [m]; returns the
        vector of the arrow (2,) [m], and a text if it was cut to LONGEST_ARROW, else "".

        A force as large as the robot's weight has the length `WEIGHT_LENGTH`; a short arrow has a small head.
        """
        vector = colours.WEIGHT_LENGTH / self.view.scene.biped.weight * force
        length, words = float(np.hypot(*vector)), ""
        if not math.isfinite(length):
            vector, length, words = np.zeros(2), 0.0, "no finite force, arrow cut"
        elif length > colours.LONGEST_ARROW:
            vector, length = colours.LONGEST_ARROW / length * vector, colours.LONGEST_ARROW
            words = f"{np.hypot(*force):.3g} N, arrow cut"
        arrow, head = self.arrows[k], min(0.09, length)
        arrow.set_visible(length > 0.0)
        x, y, dx, dy = (*start, *vector)
        arrow.set_data(x=x, y=y, dx=dx, dy=dy, head_width=0.07 * head / 0.09, head_length=head)
        return vector, words
