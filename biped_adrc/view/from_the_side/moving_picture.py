"""A moving picture of walks from the side, drawn by matplotlib; no browser is needed.

Times of the frames are chosen (`_times`), each frame is drawn to an array of pixels (walks over one
another here, walks side by side in `side_by_side`), and `gif` writes all frames to one file.
The figure is made once; from frame to frame only its lines move, as making a figure takes longer
than drawing it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from biped_adrc.core.errors import InputError
from biped_adrc.core.files import write_bytes
from biped_adrc.core.types import Array
from biped_adrc.view.from_the_side import moving_parts as draw
from biped_adrc.view.from_the_side.gif import encoded
from biped_adrc.view.from_the_side.side_by_side import frames_apart
from biped_adrc.view.from_the_side.side_view import SideView
from biped_adrc.view.placement import Recorded, WalkScene, check_frames, ending
from biped_adrc.view.style import style

GHOST = 0.35
"""Opacity of walks that are not the solid one."""
SHOWN = 2.6
"""Width [m] of the picture of walks laid over one another."""
REST = 2.0
"""How much longer [s] the last frame is shown where a walk ended badly, to read why."""


def write_moving_picture(
    path: Path,
    walks: Mapping[str, Recorded],
    start: float | None = None,
    stop: float | None = None,
    motion: draw.Motion | None = None,
) -> None:
    """Write walks, over one another or side by side, as a GIF that repeats.

    walks: name -> walk, one or more. Where they are laid over one another, the last is drawn opaque, and
    the picture follows it. start, stop [s]: the part shown, the whole if None. motion: pace, size and
    arrangement.

    Raises InputError for a part or a motion that does not fit, and OutputError.
    """
    motion = draw.Motion() if motion is None else motion
    times = _times(walks, start, stop, motion)
    with style():
        if motion.apart:
            images = frames_apart(walks, times, motion)
        else:
            scenes = {n: WalkScene.of(walk) for n, walk in walks.items()}
            images = _frames(scenes, times, motion)
    badly = any(ending(w.trajectory) and w.trajectory.t_end <= times[-1] for w in walks.values())
    rest = REST if badly else 0.0
    write_bytes(path, encoded(images, motion.fps, rest))


def _times(
    walks: Mapping[str, Recorded], start: float | None, stop: float | None, motion: draw.Motion
) -> Array:
    """Times (K,) [s] of the frames; the end of a walk that ended badly is one of them."""
    first = min(walk.trajectory.t_start for walk in walks.values())
    last = max(walk.trajectory.t_end for walk in walks.values())
    start = first if start is None else start
    stop = last if stop is None else stop
    if not first <= start < stop <= last:
        raise InputError(
            f"the part from {start:g} to {stop:g} s was asked for; the walks last from {first:g} to {last:g} s"
        )
    rate = motion.fps * motion.slower
    check_frames((stop - start) * rate)
    count = math.ceil((stop - start) * rate * (1.0 - 1e-12))
    times = start + np.arange(count) / rate if count > 1 else np.array([start, stop])
    badly = any(ending(walk.trajectory) for walk in walks.values())
    return np.append(times, stop) if badly else times


def _frames(scenes: Mapping[str, WalkScene], times: Array, motion: draw.Motion) -> list[Array]:
    """The frames (height, width, 3) at `times` (K,) [s], walks laid over one another.

    scenes: the solid walk is the last; its hip keeps its place in the picture, the ground moves.
    Every walk has a trail, a robot and its forces in layers of its own; a caption gives time, step,
    and how walks have ended.
    """
    views = [SideView(scene) for scene in scenes.values()]
    last = views[-1]
    width, pace = motion.width, motion.pace(", ")
    height = width * (draw.HEADROOM * last.height + draw.SOLE) / SHOWN
    figure = Figure(figsize=(width / draw.DPI, height / draw.DPI), dpi=draw.DPI)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    draw.ground(axes, views)
    opacities = [GHOST] * (len(views) - 1) + [1.0]
    drawn = [
        (
            draw.Trail(axes, v, times, o, k),
            draw.DrawnRobot(axes, v, o, k),
            draw.Forces(axes, v, o, k),
        )
        for k, (v, o) in enumerate(zip(views, opacities, strict=True), start=2)
    ]
    *ghosts, solid = scenes
    caption = f"{solid} solid, {', '.join(ghosts)} translucent" if ghosts else solid
    text = axes.text(0.02, 0.97, "", transform=axes.transAxes, va="top", fontsize=11, zorder=90)
    text.set_parse_math(False)
    text.set_bbox({"fc": "white", "ec": "none", "alpha": 0.7, "pad": 2.0})
    out = []
    for k, t in enumerate(times.tolist()):
        draw.follow(axes, last, t, 0.6 * SHOWN, 0.4 * SHOWN)
        for trail, robot, forces in drawn:
            trail.show(k, t)
            robot.show(t)
            forces.show(t)
        ended = {n: ending(s.trajectory) for n, s in scenes.items() if t >= s.trajectory.t_end}
        over = [f"{name} {badly}" for name, badly in ended.items() if badly]
        words = "\n".join((caption, f"t = {t:.2f} s, step {last.step(t)}{pace}", *over))
        text.set_text(draw.wrapped(words, 0.96 * width))
        out.append(draw.picture(canvas))
    return out
