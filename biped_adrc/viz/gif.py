"""A moving picture of walks from the side, drawn by matplotlib and written by Pillow; no browser."""

from __future__ import annotations

import io
import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from PIL import Image, ImageColor

from biped_adrc.errors import InputError
from biped_adrc.files import write_bytes
from biped_adrc.types import Array
from biped_adrc.viz.loads import loads
from biped_adrc.viz.placement import Recorded, Scene, link_placements
from biped_adrc.viz.side_view import STANCE, SWING, TRUNK, SideView
from biped_adrc.viz.style import style
from biped_adrc.viz.surface import TILE

COLOURS = {"stance": STANCE, "swing": SWING, "": TRUNK}
REACTION, TORQUE = "#009E73", "#CC79A7"
METRES_PER_NEWTON_METRE = 0.004
GHOST = 0.35
DPI = 100
SHOWN = 2.6
"""[m], width of the picture."""


def write_gif(
    path: Path,
    walks: Mapping[str, Recorded],
    solid: str | None = None,
    start: float | None = None,
    stop: float | None = None,
    fps: float = 25.0,
    width: int = 600,
) -> None:
    """Write walks, overlaid, as a GIF that repeats.

    solid: the walk drawn opaque and followed, the last one if None. start, stop [s]: the part shown, the whole
    if None. fps [1/s]: frames per second, at most 50 (a GIF counts hundredths of a second). width [px].
    Raises InputError and OutputError.
    """
    names = list(walks)
    solid = names[-1] if solid is None and names else solid
    if solid is None or solid not in walks:
        raise InputError(f"there is no walk '{solid}' to draw solid; choose one of {names}")
    scenes = {n: Scene.of(walks[n]) for n in [*(n for n in names if n != solid), solid]}
    times = _times(scenes, start, stop, fps)
    if not 100 <= width <= 4000:
        raise InputError(f"width is {width} px, expected 100 to 4000")
    with style():
        images = [Image.fromarray(frame) for frame in _frames(scenes, times, width)]
    write_bytes(path, _encoded(images, fps))


def _times(
    scenes: Mapping[str, Scene], start: float | None, stop: float | None, fps: float
) -> Array:
    first = min(scene.trajectory.t_start for scene in scenes.values())
    last = max(scene.trajectory.t_end for scene in scenes.values())
    start = first if start is None else start
    stop = last if stop is None else stop
    if not first <= start < stop <= last:
        raise InputError(
            f"the part from {start:g} to {stop:g} s was asked for; the walks last from {first:g} to {last:g} s"
        )
    if not (math.isfinite(fps) and 0.0 < fps <= 50.0):
        raise InputError(f"fps is {fps} frames per second, expected more than 0 and at most 50")
    return start + np.arange(max(2, math.ceil((stop - start) * fps))) / fps


def _frames(scenes: Mapping[str, Scene], times: Array, width: int) -> list[Array]:
    views = [SideView(scene) for scene in scenes.values()]
    height = 1.2 * views[-1].height
    figure = Figure(figsize=(width / DPI, width * (height + 0.12) / SHOWN / DPI), dpi=DPI)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    _ground(axes, views)
    drawn = [
        _Drawn(axes, view, times, GHOST if view is not views[-1] else 1.0, 2 + k)
        for k, view in enumerate(views)
    ]
    caption = " and ".join(reversed(list(scenes)))
    text = axes.text(0.02, 0.97, "", transform=axes.transAxes, va="top", fontsize=11)
    out = []
    for k, t in enumerate(times):
        for walk in drawn:
            walk.show(k, float(t))
        x = views[-1].points(float(t))[0]
        z = views[-1].scene.level(x)
        axes.set_xlim(x - 0.6 * SHOWN, x + 0.4 * SHOWN)
        axes.set_ylim(z - 0.12, z + height)
        text.set_text(f"{caption}\nt = {t:.2f} s, step {views[-1].step(float(t))}")
        canvas.draw()  # type: ignore[no-untyped-call]
        picture = np.asarray(canvas.buffer_rgba())  # type: ignore[no-untyped-call]
        out.append(picture[:, :, :3].copy())
    return out


def _ground(axes: Axes, views: list[SideView]) -> None:
    """The ground of every walk as a line, of the solid one (the last) with its tiles."""
    x = np.concatenate([view.scene.footholds for view in views])
    low, high = math.floor(x.min()) - 3, math.ceil(x.max()) + 4
    lines = [view.scene.surface.line(low, high) for view in views]
    for line in {line.tobytes(): line for line in lines}.values():
        axes.plot(*line.T, color="black", lw=1.0, zorder=1)
    for tile in views[-1].scene.surface.tiles(round(low / TILE), round(high / TILE)):
        shade = "#c8c8c8" if tile.even else "#9e9e9e"
        at, top = tile.ends.T
        axes.fill_between(at, top - 0.05, top, color=shade, lw=0.0, zorder=0)


class _Drawn:
    """The artists of one walk, updated from frame to frame."""

    def __init__(
        self, axes: Axes, view: SideView, times: Array, opacity: float, order: int
    ) -> None:
        self.view = view
        wide = {role: 9.0 if role == "" else 6.5 for role in COLOURS}
        self.widths = wide
        self.lines = LineCollection([], capstyle="round", alpha=opacity, zorder=10 * order)
        axes.add_collection(self.lines)
        self.points = np.array([view.points(float(t)) for t in times])
        self.steps = np.array([view.step(float(t)) for t in times])
        (self.hip,) = axes.plot([], [], color="#555555", lw=0.9, alpha=opacity, zorder=order)
        (self.foot,) = axes.plot([], [], color=SWING, lw=0.9, alpha=opacity, zorder=order)
        (self.prints,) = axes.plot([], [], "^", color="black", ms=4, alpha=opacity, zorder=order)
        self.reaction = PolyCollection([], color=REACTION, alpha=opacity, zorder=10 * order + 1)
        self.torques = PolyCollection([], color=TORQUE, alpha=opacity, zorder=10 * order + 2)
        axes.add_collection(self.reaction)
        axes.add_collection(self.torques)

    def show(self, k: int, t: float) -> None:
        """Frame k, at t [s]."""
        view, scene = self.view, self.view.scene
        roles = view.roles(t)
        self.lines.set_segments(list(view.segments(t)))
        self.lines.set_color([COLOURS[role] for role in roles])
        self.lines.set_linewidth([self.widths[role] for role in roles])
        self.hip.set_data(self.points[: k + 1, 0], self.points[: k + 1, 1])
        jumps = np.flatnonzero(np.diff(self.steps[: k + 1])) + 1
        self.foot.set_data(*np.insert(self.points[: k + 1, 2:], jumps, np.nan, axis=0).T)
        i = scene.arc_at(t)
        self.prints.set_data(scene.footholds[: i + 1], scene.heights[: i + 1])
        acting = loads(scene, t)
        force = view.metres_per_newton * acting.ground_reaction
        self.reaction.set_verts([arrow(np.array(scene.foothold(i)), force)])
        self.torques.set_verts(self._rings(t, acting.zeta))

    def _rings(self, t: float, zeta: Array) -> list[Array]:
        if not zeta.any():
            return []
        biped = self.view.scene.biped
        placements = link_placements(biped.tree, self.view.scene.joints(t))
        joints = {joint.name: joint for joint in biped.tree.joints}
        return [
            ring(placements[joints[name].child][[0, 2], 3], METRES_PER_NEWTON_METRE * float(torque))
            for name, torque in zip(biped.description.joints, zeta, strict=True)
            if torque != 0.0
        ]


def arrow(start: Array, vector: Array) -> Array:
    """Outline (7, 2) of an arrow; its head shrinks with a short one."""
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
    """Outline of a bent arrow, counter-clockwise for a positive radius [m]."""
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


def _encoded(images: list[Image.Image], fps: float) -> bytes:
    """One palette for all frames, so that colours do not flicker; no used colour is missing from it."""
    some = [np.asarray(image)[::3] for image in images[:: max(1, len(images) // 8)]]
    width = some[0].shape[1]
    swatches = [
        ImageColor.getrgb(c) for c in (*COLOURS.values(), REACTION, TORQUE, "black", "white")
    ]
    band = [np.full((len(some[0]) // 4, width, 3), rgb, dtype=np.uint8) for rgb in swatches]
    palette = Image.fromarray(np.concatenate([*some, *band])).quantize(64)
    frames = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    buffer = io.BytesIO()
    frames[0].save(
        buffer,
        format="GIF",
        save_all=True,
        append_images=frames[1:],
        duration=round(1000.0 / fps),
        loop=0,
        optimize=False,
    )
    return buffer.getvalue()
