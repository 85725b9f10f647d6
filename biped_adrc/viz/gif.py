"""A moving picture of walks from the side, drawn by matplotlib and written by Pillow; no browser."""

from __future__ import annotations

import io
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image, ImageColor

from biped_adrc.errors import InputError
from biped_adrc.files import write_bytes
from biped_adrc.types import Array
from biped_adrc.viz.apart import LINES, Magnified, frames_apart
from biped_adrc.viz.moving import (
    COLOURS,
    HEADROOM,
    REACTION,
    REFERENCE,
    SOLE,
    TORQUE,
    DrawnRobot,
    Forces,
    Trail,
    follow,
    ground,
    picture,
)
from biped_adrc.viz.placement import Recorded, Scene, ending
from biped_adrc.viz.side_view import SideView
from biped_adrc.viz.style import style

GHOST = 0.35
DPI = 100
SHOWN = 2.6
"""[m], width of the picture of walks laid over one another."""
REST = 2.0
"""[s], how much longer the last frame is shown where a walk ended badly."""


@dataclass(frozen=True)
class Motion:
    """How walks are set in motion.

    apart: side by side instead of over one another, with their errors over time below. magnify: factor by which
    the deviation from the reference is drawn larger, and the reference in grey; None for the posture as it is;
    it needs `apart`. slower: by how much slower than the walk. fps [1/s]: frames per second, at most 50 (a GIF
    counts hundredths of a second). width [px].
    """

    apart: bool = False
    magnify: float | None = None
    slower: float = 1.0
    fps: float = 25.0
    width: int = 600

    def __post_init__(self) -> None:
        if not (math.isfinite(self.fps) and 0.0 < self.fps <= 50.0):
            raise InputError(
                f"fps is {self.fps} frames per second, expected more than 0 and at most 50"
            )
        if not (math.isfinite(self.slower) and self.slower > 0.0):
            raise InputError(f"slower is {self.slower}, expected a positive number")
        if not 100 <= self.width <= 4000:
            raise InputError(f"width is {self.width} px, expected 100 to 4000")
        if self.magnify is not None and not self.apart:
            raise InputError("a magnified deviation is drawn of walks side by side; add 'apart'")


def write_gif(
    path: Path,
    walks: Mapping[str, Recorded],
    solid: str | None = None,
    start: float | None = None,
    stop: float | None = None,
    motion: Motion | None = None,
) -> None:
    """Write walks, over one another or side by side, as a GIF that repeats.

    solid: the walk drawn opaque and followed where they are laid over one another, the last one if None. start,
    stop [s]: the part shown, the whole if None. Raises InputError and OutputError.
    """
    motion = Motion() if motion is None else motion
    names = list(walks)
    solid = names[-1] if solid is None and names else solid
    if solid is None or solid not in walks:
        raise InputError(f"there is no walk '{solid}' to draw solid; choose one of {names}")
    times = _times(walks, start, stop, motion)
    with style():
        if motion.apart:
            images = frames_apart(
                walks, times, Magnified(motion.magnify, motion.slower), motion.width
            )
        else:
            order = [*(n for n in names if n != solid), solid]
            scenes = {n: Scene.of(walks[n]) for n in order}
            images = _frames(scenes, times, motion.width, _speed(motion.slower))
    badly = any(ending(w.trajectory) and w.trajectory.t_end <= times[-1] for w in walks.values())
    rest = REST if badly else 0.0
    write_bytes(path, _encoded([Image.fromarray(i) for i in images], motion.fps, rest))


def _times(
    walks: Mapping[str, Recorded], start: float | None, stop: float | None, motion: Motion
) -> Array:
    """When the frames are; the end of a walk that ended badly is one of them."""
    first = min(walk.trajectory.t_start for walk in walks.values())
    last = max(walk.trajectory.t_end for walk in walks.values())
    start = first if start is None else start
    stop = last if stop is None else stop
    if not first <= start < stop <= last:
        raise InputError(
            f"the part from {start:g} to {stop:g} s was asked for; the walks last from {first:g} to {last:g} s"
        )
    rate = motion.fps * motion.slower
    times = start + np.arange(max(2, math.ceil((stop - start) * rate))) / rate
    badly = any(ending(walk.trajectory) for walk in walks.values())
    return np.append(times, stop) if badly else times


def _speed(slower: float) -> str:
    return "" if slower == 1.0 else f", {slower:g} times slower"


def _frames(scenes: Mapping[str, Scene], times: Array, width: int, speed: str) -> list[Array]:
    views = [SideView(scene) for scene in scenes.values()]
    last = views[-1]
    height = width * (HEADROOM * last.height + SOLE) / SHOWN
    figure = Figure(figsize=(width / DPI, height / DPI), dpi=DPI)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    ground(axes, views)
    opacities = [GHOST] * (len(views) - 1) + [1.0]
    drawn = [
        (Trail(axes, v, times, o, k), DrawnRobot(axes, v, o, k), Forces(axes, v, o, k))
        for k, (v, o) in enumerate(zip(views, opacities, strict=True), start=2)
    ]
    *ghosts, solid = scenes
    caption = f"{solid} solid, {', '.join(ghosts)} translucent" if ghosts else solid
    text = axes.text(0.02, 0.97, "", transform=axes.transAxes, va="top", fontsize=11, zorder=90)
    text.set_bbox({"fc": "white", "ec": "none", "alpha": 0.7, "pad": 2.0})
    out = []
    for k, t in enumerate(times.tolist()):
        follow(axes, last, t, 0.6 * SHOWN, 0.4 * SHOWN)
        for trail, robot, forces in drawn:
            trail.show(k, t)
            robot.show(t)
            forces.show(t)
        over = [f"\n{n} {ending(s.trajectory)}" for n, s in scenes.items() if _is_over(s, t)]
        text.set_text(f"{caption}\nt = {t:.2f} s, step {last.step(t)}{speed}{''.join(over)}")
        out.append(picture(canvas))
    return out


def _is_over(scene: Scene, t: float) -> bool:
    return t >= scene.trajectory.t_end and ending(scene.trajectory) != ""


def _encoded(images: list[Image.Image], fps: float, rest: float) -> bytes:
    """One palette for all frames, so that colours do not flicker; no used colour is missing from it.

    rest [s]: how much longer the last frame is shown.
    """
    some = [np.asarray(image)[::3] for image in images[:: max(1, len(images) // 8)]]
    width = some[0].shape[1]
    marked = (*COLOURS.values(), REACTION, TORQUE, REFERENCE, *LINES, "black", "white")
    swatches = [ImageColor.getrgb(c) for c in marked]
    band = [np.full((len(some[0]) // 4, width, 3), rgb, dtype=np.uint8) for rgb in swatches]
    palette = Image.fromarray(np.concatenate([*some, *band])).quantize(64)
    frames = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    buffer, frame = io.BytesIO(), round(1000.0 / fps)
    frames[0].save(
        buffer,
        format="GIF",
        save_all=True,
        append_images=frames[1:],
        duration=[frame] * (len(images) - 1) + [frame + round(1000.0 * rest)],
        loop=0,
        optimize=False,
    )
    return buffer.getvalue()
