"""A strip of stick figures over a few steps, as in papers on walking.

Postures at equally spaced times are drawn over one another on the ground they walk on, darker the
later; stance leg, swing leg and trunk differ in colour and dash.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from biped_adrc.view.colours import STANCE, SWING, TRUNK
from biped_adrc.view.from_the_side.side_view import SideView
from biped_adrc.view.placement import Clip, Recorded, WalkScene, ending
from biped_adrc.view.style import label, literal, new_figure, write_figure

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


def strip(axes: Axes, walk: Recorded, clip: Clip) -> Axes:
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
        lines = LineCollection(
            mine,
            colors=colour,
            linewidths=width,
            linestyles=dash,
            alpha=0.25 + 0.75 * darkness,
            label=(name or view.scene.biped.description.trunk) if named and mine else "_",
            capstyle="round",
            zorder=3,
        )
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


def write_strip(path: Path, walk: Recorded, clip: Clip) -> None:
    """Write a strip of stick figures as .png or .svg; arguments as for `strip`. Raises
    InputError and OutputError.
    """
    with new_figure(6.4, 5.2) as figure:
        strip(figure.subplots(), walk, clip)
    write_figure(path, figure)
