"""Pictures of walks from the side, drawn by matplotlib: moving ones, and strips; no browser is needed.

*A moving picture*: times of the frames are chosen (`_times`), a figure and what moves it are made,
`moving_parts.frames` draws the frames, and `encoded` writes them as a GIF: small, shown by every page and
slide, 64 colours and at most 50 frames a second.

Walks are laid over one another, or stand side by side. An error of a milliradian is invisible on a robot 1.4 m
high: the curves of the command `plot` show it.

*A strip* of stick figures over a few steps, as in papers on walking: postures at equally spaced times are
drawn over one another on the ground they walk on, darker the later; stance leg, swing leg and trunk differ in
colour and dash.
"""

import io
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from PIL import Image, ImageColor

from biped_adrc.core.errors import InputError
from biped_adrc.core.files import write_bytes
from biped_adrc.core.types import Array
from biped_adrc.view.colours import REACTION, STANCE, SWING, TORQUE, TRUNK
from biped_adrc.view.from_the_side import moving_parts as draw
from biped_adrc.view.from_the_side.side_view import SideView
from biped_adrc.view.placement import GHOST, Clip, Drawable, WalkScene, check_frames, ending
from biped_adrc.view.style import label, literal, new_figure, style, write_figure

WIDTH, SHOWN = 600, 2.6
"""Width of the picture of walks laid over one another [px], [m]."""
WIDE, PANEL = 800, 1.5
"""Width of the picture of walks side by side [px], and what the panel of one walk shows [m]."""
_FPS = 0.1, 50.0
"""Least and largest number of frames per second [1/s]; a GIF counts time in hundredths of a second."""
REST = 2.0
"""Extra time [s] for which the last frame is shown where a walk ended early, to read the reason."""
MARKED = (*draw.COLOURS.values(), REACTION, TORQUE, "black", "white")
"""Colours that have a place in the palette of a GIF, even where few pixels have them."""


def write_moving_picture(path: Path, walks: Mapping[str, Drawable], clip: Clip) -> None:
    """Write walks, over one another or side by side, as a GIF that repeats.

    walks: name -> walk, one or more. Where they are laid over one another, the last is drawn opaque, and the
    picture follows it. clip: the part shown, pace and arrangement.

    Raises InputError for a frame rate or a part that does not fit, OutputError for a file it cannot write.
    """
    fps = clip.fps or 25.0
    if not _FPS[0] <= fps <= _FPS[1]:
        raise InputError(f"fps is {fps:g}, expected {_FPS[0]:g} to {_FPS[1]:g} in a moving picture")
    # in slow motion a second of the walk takes more frames
    times = _times(walks, clip, fps * clip.slower)
    pace = "" if clip.slower == 1.0 else f"{clip.slower:g} times slower"
    with style():
        images = draw.frames(*moving_figure(walks, pace, clip.apart), times)
    # whether a walk ended early within the picture: the last frame then stays, so that the reason can be read
    badly = any(ending(w.trajectory) and w.trajectory.t_end <= times[-1] for w in walks.values())
    write_bytes(path, encoded(images, fps, REST if badly else 0.0))


def _times(walks: Mapping[str, Drawable], clip: Clip, rate: float) -> Array:
    """Times (K,) [s] of the frames, `rate` [1/s] of them per second of the walk.

    They fill the part that the clip shows, its stop not included; if a walk ended early the stop is added as a
    last frame, in which the reason is read.
    """
    first = min(walk.trajectory.t_start for walk in walks.values())
    # the clip's times, or from the first start (the third argument) to the last end
    start, stop = clip.part(first, max(walk.trajectory.t_end for walk in walks.values()), first)
    check_frames((stop - start) * rate)
    # round-off in the product does not add a frame
    count = math.ceil((stop - start) * rate * (1.0 - 1e-12))
    times = start + np.arange(count) / rate if count > 1 else np.array([start, stop])
    badly = any(ending(walk.trajectory) for walk in walks.values())
    return np.append(times, stop) if badly else times


def moving_figure(
    walks: Mapping[str, Drawable], pace: str, apart: bool
) -> tuple[Figure, Callable[[float], None]]:
    """Make the figure of walks, and the function that moves it to a time t [s], later at each call.

    pace: text on how slow the picture is, in the caption; empty for the pace of the walk. apart: the walks are
    side by side, in panels as high as the tallest robot needs, and not over one another.
    """
    views = {name: SideView(WalkScene.of(walk)) for name, walk in walks.items()}
    groups = [{name: view} for name, view in views.items()] if apart else [views]
    # widths of the picture [px] and of what a panel shows [m], and the share [1] of it to the left of the hip
    # of the last walk, which keeps its place; side by side or over one another
    width, shown, ahead = (WIDE, PANEL, 0.5) if apart else (WIDTH, SHOWN, 0.6)
    share, around = 1.0 / len(groups), (ahead * shown, (1.0 - ahead) * shown)
    solid = [[*group.values()][-1] for group in groups]
    tallest = max(draw.HEADROOM * view.height + draw.SOLE for view in solid)
    # a metre has the same number of pixels in width and in height
    size = width / draw.DPI, share * width * tallest / shown / draw.DPI
    figure = Figure(figsize=size, dpi=draw.DPI)
    places = (figure.add_axes((k * share, 0.0, share, 1.0)) for k in range(len(groups)))
    panels = [_panel(x, group, pace, around) for x, group in zip(places, groups, strict=True)]

    def show(t: float) -> None:
        for panel in panels:
            panel(t)

    return figure, show


def _panel(
    axes: Axes, views: Mapping[str, SideView], pace: str, around: tuple[float, float]
) -> Callable[[float], None]:
    """Prepare walks laid over one another in the same axes; returns the function that draws them at t [s],
    later at each call.

    The last walk is solid, the others are translucent; its hip keeps its place in the picture, with the metres
    of ground `around` to its left and right, and the ground moves. A caption says time, step and pace, and how
    walks have ended. views: of the walks, by name.
    """
    *ghosts, solid = views
    last = views[solid]
    axes.set_axis_off()
    draw.ground(axes, list(views.values()))
    # each walk has a layer, from 2 on, since the ground is drawn in those below
    drawn = [
        draw.DrawnWalk(axes, view, 1.0 if view is last else GHOST, k)
        for k, view in enumerate(views.values(), start=2)
    ]
    caption = f"{solid} solid, {', '.join(ghosts)} translucent" if ghosts else solid
    text = axes.text(0.02, 0.97, "", transform=axes.transAxes, va="top", fontsize=11, zorder=90)
    text.set_parse_math(False)  # a dollar in a name is no formula
    text.set_bbox({"fc": "white", "ec": "none", "alpha": 0.7, "pad": 2.0})

    def show(t: float) -> None:
        draw.follow(axes, last, t, *around)
        for walk in drawn:
            walk.show(t)
        runs = {name: view.scene.trajectory for name, view in views.items()}
        ends = {name: ending(run) for name, run in runs.items() if t >= run.t_end}
        over = [f"{name} {end}" for name, end in ends.items() if end]
        clock = ", ".join(filter(None, (f"t = {t:.2f} s, step {last.step(t)}", pace)))
        text.set_text(draw.wrapped("\n".join((caption, clock, *over)), 0.96 * axes.bbox.width))

    return show


def encoded(frames: Sequence[Array], fps: float, rest: float) -> bytes:
    """Encode frames (height, width, 3), 0 to 255, as a GIF with one palette, so that colours do not flicker.

    The palette is made from about eight of the frames and from bands of the colours MARKED. fps [1/s]: frames
    per second. rest [s]: how much longer the last frame is shown.
    """
    # every third row of some frames, to save time; MARKED: colours of the robot, of arrows and texts, which
    # bands of their own bring into the palette even where few pixels have them
    some = [frame[::3] for frame in frames[:: max(1, len(frames) // 8)]]
    height, width, _ = some[0].shape
    bands = [np.full((height // 4, width, 3), ImageColor.getrgb(c), np.uint8) for c in MARKED]
    palette = Image.fromarray(np.concatenate([*some, *bands])).quantize(64)
    pictures = (Image.fromarray(frame) for frame in frames)
    first, *others = (x.quantize(palette=palette, dither=Image.Dither.NONE) for x in pictures)
    # a GIF counts in hundredths of a second: rounded so that errors do not add up; Pillow takes milliseconds
    hundredths = np.diff(np.rint(100.0 * np.arange(len(frames) + 1) / fps))
    hundredths[-1] += round(100.0 * rest)
    buffer, durations = io.BytesIO(), [10 * int(x) for x in hundredths]
    repeated = {"duration": durations, "loop": 0, "optimize": False}
    first.save(buffer, "GIF", save_all=True, append_images=others, **repeated)
    return buffer.getvalue()


LOOKS = {
    "swing": (SWING, 1.4, (0, (4, 1.5)), "swing leg"),
    "stance": (STANCE, 2.0, "-", "stance leg"),
    "": (TRUNK, 2.6, "-", ""),
}
"""Role -> colour, width [pt], dash and name; the trunk goes by its own name."""
POSES = 13
"""Number of poses of a strip."""
MARGIN = 0.6
"""Least ground [m] shown before the first and behind the last foothold."""


def strip(axes: Axes, walk: Drawable, clip: Clip) -> Axes:
    """Draw the robot at POSES times, equally spaced over the part that `clip` shows; returns the axes.

    Without times: the last two steps. The first pose is at its start. A pose at an impact shows the end of the
    step before it, as the first pose of the next step has the same posture with the legs exchanged. The title
    has the time between poses, and the reason if the walk ended early.

    Raises InputError for times outside the walk.
    """
    scene = WalkScene.of(walk)
    run = scene.trajectory
    # the last argument: where a strip without times begins, at the start of the last single support but one
    start, stop = clip.part(run.t_start, run.t_end, float(run.arcs[-2:][0].t[0]))
    view = SideView(scene)
    times = np.linspace(start, stop, POSES)
    for k, t in enumerate(times):
        # the end of the last step is its own last pose, not the first of the next
        shown = float(np.nextafter(t, start)) if k else float(t)
        _pose(axes, view, shown, (k + 1) / POSES, k == POSES - 1)
    _ground(axes, view, start, stop)
    axes.set_aspect("equal")
    axes.grid(False)
    axes.legend(loc="upper right", bbox_to_anchor=(1.0, 1.1), ncols=4, borderaxespad=0.0)
    over = ending(run) if stop >= run.t_end else ""
    every = f"a pose every {1e3 * (times[1] - times[0]):.0f} ms"
    label(axes, "x [m]", "z [m]", f"{every}; {literal(over)}" if over else every)
    return axes


def _pose(axes: Axes, view: SideView, t: float, darkness: float, named: bool) -> None:
    """Draw one posture at t [s]: a collection of lines for each role (stance leg, swing leg, trunk), so that
    each has one entry in the legend.

    darkness: 0 to 1, for an opacity from 0.25 to 1. named: whether its lines are named in the legend.
    """
    segments, roles = view.segments(t), view.roles(t)
    for role, (colour, width, dash, name) in LOOKS.items():
        mine = [s for s, r in zip(segments, roles, strict=True) if r == role]
        # the trunk has no name in LOOKS, and goes by its link's; matplotlib leaves "_" out of the legend
        text = (name or view.scene.biped.description.trunk) if named and mine else "_"
        lines = LineCollection(mine, colors=colour, linewidths=width, linestyles=dash, label=text)
        lines.set(alpha=0.25 + 0.75 * darkness, capstyle="round", zorder=3)
        axes.add_collection(lines)


def _ground(axes: Axes, view: SideView, start: float, stop: float) -> None:
    """Draw the ground between the footholds of the strip and the footprints, and set the limits of the axes. A
    foothold is where a stance foot stands.

    start, stop [s]: of the strip. A robot that leans far, such as one that falls, makes the
    ground longer on both sides.
    """
    scene = view.scene
    # at an impact the strip ends with the step before it
    first, last = scene.arc_at(start), scene.arc_at(float(np.nextafter(stop, start)))
    x, z = scene.footholds[first : last + 1], scene.heights[first : last + 1]
    # the foothold after the strip, where the swing foot of its last step lands
    reach = scene.footholds[min(last + 1, len(scene.footholds) - 1)]
    aside = max(MARGIN, view.width + 0.05)
    low, high = float(x.min()) - aside, max(float(x.max()), float(reach)) + aside
    line = scene.surface.line(low, high)
    axes.plot(*line.T, color="black", lw=0.8, label="_", zorder=1)
    axes.plot(x, z, "^", color="black", ms=5, label="footprint", zorder=4)
    axes.set_xlim(low, high)
    axes.set_ylim(float(line[:, 1].min()) - 0.08, float(z.max()) + 1.05 * view.height)


def write_strip(path: Path, walk: Drawable, clip: Clip) -> None:
    """Write a strip of stick figures of a walk to the file `path`, .png or .svg; clip: the part shown, the last
    two steps if it has no times. Raises InputError for times outside the walk, OutputError for a file that
    cannot be written.
    """
    with new_figure(6.4, 5.2) as figure:
        strip(figure.subplots(), walk, clip)
    write_figure(path, figure)
