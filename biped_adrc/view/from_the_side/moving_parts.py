"""The parts of a moving picture from the side: ground, robots, trails, footprints, arrows, rings.

Each part is a class that makes its artists on an Axes once and has a method `show`, which moves
them to what they are at t [s]; `moving_picture` and `side_by_side` put parts together. The robot and forces of
walk k are drawn in the layers 10 k to 10 k + 9, so that one walk is in front of another as a whole;
trails and ground are behind all of them.
"""

from __future__ import annotations

import math
import textwrap
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection

from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.view.colours import METRES_PER_NEWTON_METRE, REACTION, STANCE, SWING, TORQUE, TRUNK
from biped_adrc.view.from_the_side.side_view import SideView
from biped_adrc.view.placement import TILE, loads

COLOURS = {"stance": STANCE, "swing": SWING, "": TRUNK}
"""Colour of a bone by its role; the trunk has none."""
SOLE, HEADROOM = 0.12, 1.2
"""Ground shown below the foot [m], and the height of the picture above it as a multiple of the robot's."""
EDGE = 0.04
"""Distance [m] that arrows keep from the edge of the picture."""
DPI = 100
"""Pixels for each inch of a figure; sizes here are in pixels."""

LETTER = 9.5
"""Width of a letter of 11 points [px], of the wide ones."""
FPS, SLOWER = (0.1, 50.0), (1e-3, 1e6)
"""Ranges of frames per second, and of how many times slower a picture plays."""


@dataclass(frozen=True)
class Motion:
    """How walks are set in motion.

    apart: side by side instead of over one another, with their errors over time below.
    slower [1]: how many times slower than the walk, in SLOWER.
    fps [1/s]: frames per second, in FPS, as a GIF counts time in hundredths of a second.
    width [px]: of the picture, 100 to 4000.

    Raises InputError for values that do not fit.
    """

    apart: bool = False
    slower: float = 1.0
    fps: float = 25.0
    width: int = 600

    def __post_init__(self) -> None:
        for name, x, (least, most) in (("fps", self.fps, FPS), ("slower", self.slower, SLOWER)):
            if not least <= x <= most:
                raise InputError(f"{name} is {x:g}, expected {least:g} to {most:g}")
        if not 100 <= self.width <= 4000:
            raise InputError(f"width is {self.width} px, expected 100 to 4000")

    def pace(self, before: str = "") -> str:
        """By how much slower the picture is than the walk, in words behind `before`; empty for the
        pace of the walk.
        """
        return "" if self.slower == 1.0 else f"{before}{self.slower:g} times slower"


def wrapped(words: str, width: float) -> str:
    """Words of 11 points in lines of at most `width` [px]."""
    return "\n".join(textwrap.fill(line, int(width / LETTER)) for line in words.split("\n"))


def picture(canvas: FigureCanvasAgg) -> Array:
    """The figure as it is now, as pixels (height, width, 3)."""
    canvas.draw()  # type: ignore[no-untyped-call]
    return np.asarray(canvas.buffer_rgba())[:, :, :3].copy()  # type: ignore[no-untyped-call]


def ground(axes: Axes, views: list[SideView]) -> None:
    """Draw the ground of every walk as a line, and the tiles of the last one; equal lines are drawn once."""
    x = np.concatenate([view.scene.footholds for view in views])
    low, high = math.floor(x.min()) - 3, math.ceil(x.max()) + 4
    lines = [view.scene.surface.line(low, high) for view in views]
    for line in {line.tobytes(): line for line in lines}.values():
        axes.plot(*line.T, color="black", lw=1.0, zorder=1)
    for tile in views[-1].scene.surface.tiles(round(low / TILE), round(high / TILE)):
        shade = "#c8c8c8" if tile.even else "#9e9e9e"
        at, top = tile.ends.T
        axes.fill_between(at, top - 0.05, top, color=shade, lw=0.0, zorder=0)


def follow(axes: Axes, view: SideView, t: float, left: float, right: float) -> None:
    """Set the limits around the hip at t [s], from `left` before it to `right` behind it [m].

    They are kept as they are where the hip's position is not finite, as in a walk that has
    diverged.
    """
    x = float(view.points(t)[0])
    if not math.isfinite(x):
        return
    z = view.scene.level(x)
    axes.set_xlim(x - left, x + right)
    axes.set_ylim(z - SOLE, z + HEADROOM * view.height)


class DrawnRobot:
    """The links of one posture as thick lines, in the colours of stance leg, swing leg and trunk.

    opacity: 0 to 1. order: number of the layer.
    """

    def __init__(self, axes: Axes, view: SideView, opacity: float, order: int) -> None:
        self.view = view
        self.lines = LineCollection([], capstyle="round", alpha=opacity, zorder=10 * order)
        axes.add_collection(self.lines)

    def show(self, t: float) -> None:
        """Move the links to the posture at t [s]."""
        roles = self.view.roles(t)
        self.lines.set_segments(list(self.view.segments(t)))
        self.lines.set_color([COLOURS[role] for role in roles])
        self.lines.set_linewidth([9.0 if role == "" else 6.5 for role in roles])


class Trail:
    """The paths of hip and swing foot so far, and footprints.

    times (K,) [s]: those of the frames. All points are computed at the beginning; a frame shows the
    first of them.
    """

    def __init__(
        self, axes: Axes, view: SideView, times: Array, opacity: float, order: int
    ) -> None:
        self.view = view
        self.points = np.array([view.points(float(t)) for t in times])
        self.steps = np.array([view.step(float(t)) for t in times])
        (self.hip,) = axes.plot([], [], color="#555555", lw=0.9, alpha=opacity, zorder=order)
        (self.foot,) = axes.plot([], [], color=SWING, lw=0.9, alpha=opacity, zorder=order)
        self.prints = Footprints(axes, view, opacity, order)

    def show(self, k: int, t: float) -> None:
        """Draw what frame k, at t [s], has behind it; the swing foot's path breaks where the feet exchange."""
        self.hip.set_data(self.points[: k + 1, 0], self.points[: k + 1, 1])
        jumps = np.flatnonzero(np.diff(self.steps[: k + 1])) + 1
        self.foot.set_data(*np.insert(self.points[: k + 1, 2:], jumps, np.nan, axis=0).T)
        self.prints.show(t)


class Footprints:
    """A mark at every foothold so far."""

    def __init__(self, axes: Axes, view: SideView, opacity: float, order: int) -> None:
        self.scene = view.scene
        (self.marks,) = axes.plot([], [], "^", color="black", ms=4, alpha=opacity, zorder=order)

    def show(self, t: float) -> None:
        """Draw the footprints up to t [s]."""
        i = self.scene.arc_at(t)
        self.marks.set_data(self.scene.footholds[: i + 1], self.scene.heights[: i + 1])


class Forces:
    """The arrow of the ground reaction at the stance foot, and a ring around every joint that is pushed.

    On soft ground an arrow at the other foot too where both carry, and the word where one slips.

    Scales: the robot's weight gives an arrow of `WEIGHT_LENGTH` [m], and rings are the same for all
    robots. order: number of the layer; arrows are in front of the links of the same walk.
    """

    def __init__(self, axes: Axes, view: SideView, opacity: float, order: int) -> None:
        self.axes, self.view = axes, view
        self.reaction = PolyCollection([], color=REACTION, alpha=opacity, zorder=10 * order + 1)
        self.torques = PolyCollection([], color=TORQUE, alpha=opacity, zorder=10 * order + 2)
        axes.add_collection(self.reaction)
        axes.add_collection(self.torques)
        self.text = axes.text(0.0, 0.0, "", color=REACTION, fontsize=9, zorder=10 * order + 3)

    def show(self, t: float) -> None:
        """Draw the forces at t [s]; an arrow that would leave the picture is cut and says how large
        the force is [N].
        """
        scene, scale = self.view.scene, self.view.metres_per_newton
        acting, limits = loads(scene, t), (self.axes.get_xlim(), self.axes.get_ylim())
        start, force = np.array(scene.foot(scene.arc_at(t), t)), scale * acting.ground_reaction
        drawn = cut(start, force, *limits)
        arrows = [arrow(start, drawn)]
        if acting.other.any():
            other = self.view.points(t)[2:]
            arrows.append(arrow(other, cut(other, scale * acting.other, *limits)))
        self.reaction.set_verts(arrows)
        size = float(np.hypot(*acting.ground_reaction))
        amount = f"{size:.3g} N" if math.isfinite(size) else "no finite force"
        word = "slips" if acting.slips else ""
        self.text.set_text(word if np.array_equal(drawn, force) else f"{amount}, arrow cut")
        right = start[0] > np.mean(limits[0])  # so that the words stay in the picture
        x = start[0] + (-0.05 if right else 0.05)
        self.text.set_horizontalalignment("right" if right else "left")
        self.text.set_position((x, max(start[1] + 0.5 * drawn[1], start[1] + 0.05)))
        self.torques.set_verts(self._rings(t, acting.zeta))

    def _rings(self, t: float, zeta: Array) -> list[Array]:
        """Outlines of the rings for external torques zeta (n,) [N m]; none where no joint is pushed."""
        if not zeta.any():
            return []
        biped = self.view.scene.biped
        placements = self.view.placements(t)
        joints = {joint.name: joint for joint in biped.tree.joints}
        return [
            ring(placements[joints[name].child][[0, 2], 3], METRES_PER_NEWTON_METRE * float(torque))
            for name, torque in zip(biped.description.joints, zeta, strict=True)
            if torque != 0.0
        ]


def cut(start: Array, vector: Array, x: tuple[float, float], z: tuple[float, float]) -> Array:
    """The vector (2,) at `start` (2,), shortened so that its tip stays `EDGE` inside the limits x, z [m].

    Zero for a vector that is not finite.
    """
    if not np.isfinite(vector).all():
        return np.zeros(2)
    share = 1.0
    for at, by, (low, high) in zip(start, vector, (x, z), strict=True):
        room = (high - EDGE - at) if by > 0.0 else (at - low - EDGE)
        if abs(by) > room:
            share = min(share, max(room, 0.0) / abs(by))
    return vector if share == 1.0 else share * vector


def arrow(start: Array, vector: Array) -> Array:
    """Outline (7, 2) [m] of an arrow from `start` along `vector`, both (2,); the head shrinks with a
    short one.
    """
    length = float(np.hypot(*vector))
    if length == 0.0:
        return np.tile(start, (7, 1))
    along = vector / length
    across = np.array([-along[1], along[0]])
    head, half = min(0.09, length), 0.012
    neck = start + (length - head) * along
    wide = 0.035 * head / 0.09
    return np.array(
        [
            start - half * across,
            neck - half * across,
            neck - wide * across,
            start + vector,
            neck + wide * across,
            neck + half * across,
            start + half * across,
        ]
    )


def ring(centre: Array, radius: float) -> Array:
    """Outline (K, 2) [m] of a bent arrow around `centre` (2,), counter-clockwise for a positive radius [m].

    Its angles from -60 to 240 degrees leave an opening below, so that the joint stays visible.
    """
    angle = np.radians(np.linspace(-60.0, 200.0, 30))
    rim = np.column_stack((np.cos(angle), np.sin(angle)))
    tip = np.radians(240.0)
    outline = np.vstack(
        (
            1.12 * rim,
            1.3 * rim[-1],
            [[math.cos(tip), math.sin(tip)]],
            0.7 * rim[-1],
            0.88 * rim[::-1],
        )
    )
    return centre + abs(radius) * outline * np.array([math.copysign(1.0, radius), 1.0])
