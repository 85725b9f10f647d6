"""A moving picture of walks from the side, drawn by matplotlib; no browser is needed.

Times of the frames are chosen (`_times`), a figure and what moves it are made (walks over one another here,
walks side by side in `side_by_side`), `moving_parts.frames` draws the frames, and `encoded` writes them as a
GIF: small, shown by every page and slide, 64 colours and at most 50 frames a second.
"""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from PIL import Image, ImageColor

from biped_adrc.core.errors import InputError
from biped_adrc.core.files import write_bytes
from biped_adrc.core.types import Array
from biped_adrc.view.colours import REACTION, TORQUE
from biped_adrc.view.from_the_side import moving_parts as draw
from biped_adrc.view.from_the_side.side_by_side import LINES, side_by_side
from biped_adrc.view.from_the_side.side_view import SideView
from biped_adrc.view.placement import Clip, Recorded, WalkScene, check_frames, ending
from biped_adrc.view.style import style

GHOST = 0.35
"""Opacity of all walks but the solid one."""
WIDTH, SHOWN = 600, 2.6
"""Width of the picture of walks laid over one another [px], [m]."""
FPS = 0.1, 50.0
"""Range of frames per second, as a GIF counts time in hundredths of a second."""
REST = 2.0
"""Extra time [s] for which the last frame is shown where a walk ended early, to read the reason."""
MARKED = (*draw.COLOURS.values(), REACTION, TORQUE, *LINES, "black", "white")
"""Colours that have a place in the palette of a GIF, even where few pixels have them."""


def write_moving_picture(path: Path, walks: Mapping[str, Recorded], clip: Clip) -> None:
    """Write walks, over one another or side by side, as a GIF that repeats.

    walks: name -> walk, one or more. Where they are laid over one another, the last is drawn opaque, and the
    picture follows it. clip: the part shown, pace and arrangement.

    Raises InputError for a frame rate, a part or an arrangement that does not fit, and OutputError.
    """
    fps = clip.fps or 25.0
    if not FPS[0] <= fps <= FPS[1]:
        raise InputError(f"fps is {fps:g}, expected {FPS[0]:g} to {FPS[1]:g} in a moving picture")
    times = _times(walks, clip, fps * clip.slower)
    pace = "" if clip.slower == 1.0 else f"{clip.slower:g} times slower"
    with style():
        make = side_by_side if clip.apart else _over_one_another
        images = draw.frames(*make(walks, times, pace), times)
    badly = any(ending(w.trajectory) and w.trajectory.t_end <= times[-1] for w in walks.values())
    write_bytes(path, encoded(images, fps, REST if badly else 0.0))


def _times(walks: Mapping[str, Recorded], clip: Clip, rate: float) -> Array:
    """Times (K,) [s] of the frames, `rate` [1/s] of them per second of the walk.

    If a walk ended early, its end is one of them.
    """
    first = min(walk.trajectory.t_start for walk in walks.values())
    start, stop = clip.part(first, max(walk.trajectory.t_end for walk in walks.values()), first)
    check_frames((stop - start) * rate)
    count = math.ceil((stop - start) * rate * (1.0 - 1e-12))
    times = start + np.arange(count) / rate if count > 1 else np.array([start, stop])
    badly = any(ending(walk.trajectory) for walk in walks.values())
    return np.append(times, stop) if badly else times


def _over_one_another(
    walks: Mapping[str, Recorded], times: Array, pace: str
) -> tuple[Figure, Callable[[float], None]]:
    """Make the figure of walks laid over one another; also returns the function that moves it to a time t [s].

    The last walk is solid; its hip keeps its place in the picture, the ground moves. A caption gives time,
    step and pace, and how walks have ended.
    """
    views = {name: SideView(WalkScene.of(walk)) for name, walk in walks.items()}
    *ghosts, solid = views
    last = views[solid]
    figure = draw.blank(WIDTH, WIDTH * (draw.HEADROOM * last.height + draw.SOLE) / SHOWN)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    draw.ground(axes, list(views.values()))
    drawn = [
        draw.DrawnWalk(axes, view, 1.0 if view is last else GHOST, k, trail=True)
        for k, view in enumerate(views.values(), start=2)
    ]
    caption = f"{solid} solid, {', '.join(ghosts)} translucent" if ghosts else solid
    text = axes.text(0.02, 0.97, "", transform=axes.transAxes, va="top", fontsize=11, zorder=90)
    text.set_parse_math(False)
    text.set_bbox({"fc": "white", "ec": "none", "alpha": 0.7, "pad": 2.0})

    def show(t: float) -> None:
        draw.follow(axes, last, t, 0.6 * SHOWN, 0.4 * SHOWN)
        for walk in drawn:
            walk.show(t)
        ended = {
            n: ending(v.scene.trajectory) for n, v in views.items() if t >= v.scene.trajectory.t_end
        }
        over = [f"{name} {badly}" for name, badly in ended.items() if badly]
        clock = ", ".join(filter(None, (f"t = {t:.2f} s, step {last.step(t)}", pace)))
        text.set_text(draw.wrapped("\n".join((caption, clock, *over)), 0.96 * WIDTH))

    return figure, show


def encoded(frames: Sequence[Array], fps: float, rest: float) -> bytes:
    """Encode frames (height, width, 3) as a GIF with one palette for all, so that colours do not flicker.

    The palette is made from every eighth frame and from bands of the colours MARKED. fps [1/s]; rest [s]: how
    much longer the last frame is shown.
    """
    some = [frame[::3] for frame in frames[:: max(1, len(frames) // 8)]]
    height, width, _ = some[0].shape
    bands = [np.full((height // 4, width, 3), ImageColor.getrgb(c), np.uint8) for c in MARKED]
    palette = Image.fromarray(np.concatenate([*some, *bands])).quantize(64)
    first, *others = (
        Image.fromarray(frame).quantize(palette=palette, dither=Image.Dither.NONE)
        for frame in frames
    )
    hundredths = np.diff(np.rint(100.0 * np.arange(len(frames) + 1) / fps))
    hundredths[-1] += round(100.0 * rest)
    buffer, durations = io.BytesIO(), [10 * int(x) for x in hundredths]
    first.save(
        buffer,
        "GIF",
        save_all=True,
        append_images=others,
        duration=durations,
        loop=0,
        optimize=False,
    )
    return buffer.getvalue()
