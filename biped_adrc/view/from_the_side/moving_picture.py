"""Pictures of walks from the side, drawn by matplotlib: moving ones, and strips; no browser is needed.

*A moving picture*: times of the frames are chosen (`_times`), a figure and what moves it are made,
`moving_parts.frames` draws the frames, and `encoded` writes them as a GIF: small, shown by every page and
slide, 64 colours and at most 50 frames a second.

Walks are laid over one another, or stand side by side with the tracking errors of all of them below: an error
of a milliradian is invisible on a robot 1.4 m high, and the curves show which controller has it.

*A strip* of stick figures over a few steps, as in papers on walking: postures at equally spaced times are
drawn over one another on the ground they walk on, darker the later; stance leg, swing leg and trunk differ in
colour and dash.
"""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from PIL import Image, ImageColor

from biped_adrc.analysis.signals import Signals
from biped_adrc.core.errors import InputError
from biped_adrc.core.files import write_bytes
from biped_adrc.core.types import Array
from biped_adrc.view.colours import REACTION, STANCE, SWING, TORQUE, TRUNK
from biped_adrc.view.from_the_side import moving_parts as draw
from biped_adrc.view.from_the_side.side_view import SideView
from biped_adrc.view.placement import Clip, Drawable, WalkScene, check_frames, ending
from biped_adrc.view.plots.over_time import angle_unit
from biped_adrc.view.style import PUSH, label, literal, new_figure, style, write_figure

_GHOST = 0.35
"""Opacity of all walks but the solid one."""
WIDTH, SHOWN = 600, 2.6
"""Width of the picture of walks laid over one another [px], [m]."""
_FPS = 0.1, 50.0
"""Range of frames per second, as a GIF counts time in hundredths of a second."""
REST = 2.0
"""Extra time [s] for which the last frame is shown where a walk ended early, to read the reason."""
WIDE, PANEL = 800, 1.5
"""Width of the picture of walks side by side [px], and what the panel of one walk shows [m]."""
LINES = ("#D55E00", "#000000", "#56B4E9", "#E69F00")
"""Vermillion, black, sky blue, orange: one for the name and the error of each walk."""
HEAD, STRIP = 78, 150
"""Heights [px] of the legend above and of the errors below."""
MARKED = (*draw.COLOURS.values(), REACTION, TORQUE, *LINES, "black", "white")
"""Colours that have a place in the palette of a GIF, even where few pixels have them."""


def write_moving_picture(path: Path, walks: Mapping[str, Drawable], clip: Clip) -> None:
    """Write walks, over one another or side by side, as a GIF that repeats.

    walks: name -> walk, one or more. Where they are laid over one another, the last is drawn opaque, and the
    picture follows it. clip: the part shown, pace and arrangement.

    Raises InputError for a frame rate, a part or an arrangement that does not fit, and OutputError.
    """
    fps = clip.fps or 25.0
    if not _FPS[0] <= fps <= _FPS[1]:
        raise InputError(f"fps is {fps:g}, expected {_FPS[0]:g} to {_FPS[1]:g} in a moving picture")
    times = _times(walks, clip, fps * clip.slower)
    pace = "" if clip.slower == 1.0 else f"{clip.slower:g} times slower"
    with style():
        make = side_by_side if clip.apart else _over_one_another
        images = draw.frames(*make(walks, times, pace), times)
    badly = any(ending(w.trajectory) and w.trajectory.t_end <= times[-1] for w in walks.values())
    write_bytes(path, encoded(images, fps, REST if badly else 0.0))


def _times(walks: Mapping[str, Drawable], clip: Clip, rate: float) -> Array:
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
    walks: Mapping[str, Drawable], times: Array, pace: str
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
        draw.DrawnWalk(axes, view, 1.0 if view is last else _GHOST, k, trail=True)
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
        runs = {name: walk.trajectory for name, walk in walks.items()}
        over = [
            f"{name} {ending(run)}" for name, run in runs.items() if ending(run) and t >= run.t_end
        ]
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
    repeated = {"duration": durations, "loop": 0, "optimize": False}
    first.save(buffer, "GIF", save_all=True, append_images=others, **repeated)
    return buffer.getvalue()


def side_by_side(
    walks: Mapping[str, Drawable], times: Array, pace: str
) -> tuple[Figure, Callable[[float], None]]:
    """Make the figure with a panel for each walk and the errors of all below; also returns
    the function that moves it.

    walks: name -> walk. times (K,) [s]: of the frames. pace: text above. The returned function draws
    the figure at a time t [s]. All panels have the height of the tallest robot. Raises InputError
    for walks without a reference.
    """
    for walk in walks.values():
        if walk.walker.plant.p == 0:
            raise InputError(
                "a walk without motors has no reference to deviate from; leave 'apart' out"
            )
    views = [SideView(WalkScene.of(walk)) for walk in walks.values()]
    share = 1.0 / len(views)
    body = share * WIDE * max(draw.HEADROOM * v.height + draw.SOLE for v in views) / PANEL
    height = HEAD + body + STRIP
    figure, panels = draw.blank(WIDE, height), []
    for k, (name, walk) in enumerate(walks.items()):
        axes = figure.add_axes((k * share, STRIP / height, share, body / height))
        colour = LINES[k % len(LINES)]
        panels.append(_Panel(axes, views[k], walk.signals, name, colour, float(times[0])))
    strip = figure.add_axes((0.095, 48 / height, 0.88, (STRIP - 60) / height))
    errors = _Errors(strip, panels, times)
    _legend(figure, pace, height)

    def show(t: float) -> None:
        for panel in panels:
            panel.show(t)
        errors.show(t)

    return figure, show


class _Panel:
    """The panel of one walk: the robot, its name, and its largest error so far.

    s: its signals. colour: of its name and its error. start [s]: from when the largest error counts.
    """

    def __init__(
        self, axes: Axes, view: SideView, s: Signals, name: str, colour: str, start: float
    ) -> None:
        self.axes, self.view, self.signals, self.colour, self.start = axes, view, s, colour, start
        self.ending = ending(view.scene.trajectory)
        axes.set_axis_off()
        draw.ground(axes, [view])
        self.walk = draw.DrawnWalk(axes, view, 1.0, 2)
        title = axes.text(0.04, 0.99, name, fontsize=15, color=colour, weight="bold")
        self.text = axes.text(0.04, 0.915, "", fontsize=11)
        for text in (title, self.text):
            text.set(transform=axes.transAxes, verticalalignment="top", zorder=90, parse_math=False)

    def show(self, t: float) -> None:
        """Draw the walk at t [s], with its largest error so far, or how it has ended, as text."""
        draw.follow(self.axes, self.view, t, 0.5 * PANEL, 0.5 * PANEL)
        self.walk.show(t)
        if self.ending and t >= self.view.scene.trajectory.t_end:
            width = 0.92 * self.axes.bbox.width
            self.text.set_text(draw.wrapped(self.ending.replace(": ", ":\n"), width))
            return
        s = self.signals
        so_far = np.nan_to_num(np.abs(s.error[(s.t >= self.start) & (s.t <= t)]))
        largest = float(np.max(so_far, initial=0.0))  # at the nodes of the walk
        unit, factor = angle_unit(so_far)
        size = f"{factor * largest:.3g} {unit}" if largest >= 1e-9 else "below 1 nrad"
        self.text.set_text(f"largest error so far {size}")


class _Errors:
    """The panel of errors: max_i |q_i - q_di| of every walk up to now, on one scale, with the push shaded.

    The push is that of the first walk, as all walks are under the same one. times (K,) [s]: those of the
    frames; the unit is the one in which the largest error among them reads well.
    """

    def __init__(self, axes: Axes, panels: list[_Panel], times: Array) -> None:
        self.axes, self.lines = axes, []
        low, high = float(times[0]), float(times[-1])
        signals = [panel.signals for panel in panels]
        largest = [np.max(np.abs(s.error), axis=1) for s in signals]
        inside = [(s.t >= low) & (s.t <= high) for s in signals]
        tops = np.concatenate([e[rows] for e, rows in zip(largest, inside, strict=True)])
        tops = tops[np.isfinite(tops)]
        unit, factor = angle_unit(tops)
        band, pushed = axes.get_xaxis_transform(), np.any(signals[0].zeta != 0.0, axis=1)
        look: dict[str, Any] = {"transform": band, "color": PUSH, "alpha": 0.45, "lw": 0}
        axes.fill_between(signals[0].t, 0, 1, pushed, **look)
        for panel, s, error in zip(panels, signals, largest, strict=True):
            (line,) = axes.plot([], [], color=panel.colour, lw=2.0)
            (dot,) = axes.plot([], [], "o", color=panel.colour, ms=5)
            self.lines.append((line, dot, s.t, factor * error))
        top = factor * float(tops.max(initial=0.0)) or 1.0
        axes.set(xlim=(low, high), ylim=(-0.06 * top, 1.15 * top), xlabel="time [s]")
        axes.set_ylabel(f"error [{unit}]")

    def show(self, t: float) -> None:
        """Draw the errors up to t [s]."""
        for line, dot, at, error in self.lines:
            rows = at <= t
            line.set_data(at[rows], error[rows])
            dot.set_data(at[rows][-1:], error[rows][-1:])


def _legend(figure: Figure, pace: str, height: float) -> None:
    """Draw the legend of the colours, and the text `pace` above it; height [px] of the picture."""
    entries = [Patch(color=draw.COLOURS[leg], label=f"{leg} leg") for leg in ("stance", "swing")]
    entries += [Patch(color=REACTION, label="ground force"), Patch(color=TORQUE, label="push")]
    legend = figure.legend(
        handles=entries, loc="upper center", ncols=4, fontsize=11, columnspacing=1.4
    )
    legend.set_bbox_to_anchor((0.5, 1.0 - 26 / height))
    figure.text(0.5, 1.0 - 6 / height, pace, ha="center", va="top", fontsize=13)


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
    """Draw one posture at t [s]: a collection of lines for each role, so that each has
    one entry in the legend.

    darkness: 0 to 1, sets the opacity. named: whether its lines are named in the legend.
    """
    segments, roles = view.segments(t), view.roles(t)
    for role, (colour, width, dash, name) in LOOKS.items():
        mine = [s for s, r in zip(segments, roles, strict=True) if r == role]
        text = (name or view.scene.biped.description.trunk) if named and mine else "_"
        lines = LineCollection(mine, colors=colour, linewidths=width, linestyles=dash, label=text)
        lines.set(alpha=0.25 + 0.75 * darkness, capstyle="round", zorder=3)
        axes.add_collection(lines)


def _ground(axes: Axes, view: SideView, start: float, stop: float) -> None:
    """Draw the ground between the footholds of the strip and the footprints, and set the limits of the axes.

    start, stop [s]: of the strip. A robot that leans far, such as one that falls, makes the
    ground longer on both sides.
    """
    scene = view.scene
    first, last = scene.arc_at(start), scene.arc_at(float(np.nextafter(stop, start)))
    x, z = scene.footholds[first : last + 1], scene.heights[first : last + 1]
    reach = scene.footholds[min(last + 1, len(scene.footholds) - 1)]
    aside = max(MARGIN, view.width + 0.05)
    low, high = float(x.min()) - aside, max(float(x.max()), float(reach)) + aside
    line = scene.surface.line(low, high)
    axes.plot(*line.T, color="black", lw=0.8, label="_", zorder=1)
    axes.plot(x, z, "^", color="black", ms=5, label="footprint", zorder=4)
    axes.set_xlim(low, high)
    axes.set_ylim(float(line[:, 1].min()) - 0.08, float(z.max()) + 1.05 * view.height)


def write_strip(path: Path, walk: Drawable, clip: Clip) -> None:
    """Write a strip of stick figures as .png or .svg; arguments as for `strip`. Raises
    InputError and OutputError.
    """
    with new_figure(6.4, 5.2) as figure:
        strip(figure.subplots(), walk, clip)
    write_figure(path, figure)
