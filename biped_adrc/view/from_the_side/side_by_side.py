"""Walks side by side in a moving picture, and the tracking errors of all of them below.

A tracking error of a milliradian is invisible on a robot 1.4 m high: the curves show which controller has it.
One `_Panel` for each walk, one `_Errors` for all, put together by `side_by_side`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from biped_adrc.analysis.signals import Signals
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.view.colours import REACTION, TORQUE
from biped_adrc.view.from_the_side import moving_parts as draw
from biped_adrc.view.from_the_side.side_view import SideView, Tracked
from biped_adrc.view.placement import Recorded, WalkScene, ending
from biped_adrc.view.plots.over_time import angle_unit
from biped_adrc.view.style import PUSH

WIDTH, SHOWN = 800, 1.5
"""Width of the picture [px], and what the panel of one walk shows [m]."""
LINES = ("#D55E00", "#000000", "#56B4E9", "#E69F00")
"""Vermillion, black, sky blue, orange: one for the name and the error of each walk."""
HEAD, STRIP = 78, 150
"""Heights [px] of the legend above and of the errors below."""


def side_by_side(
    walks: Mapping[str, Recorded], times: Array, pace: str
) -> tuple[Figure, Callable[[float], None]]:
    """Make the figure with a panel for each walk and the errors of all below; also returns
    the function that moves it.

    walks: name -> walk. times (K,) [s]: of the frames. pace: text above. The returned function draws
    the figure at a time t [s]. All panels have the height of the tallest robot. Raises InputError
    for walks without a reference.
    """
    for walk in walks.values():
        if not isinstance(walk, Tracked) or walk.walker.plant.p == 0:
            raise InputError(
                "a walk without motors has no reference to deviate from; leave 'apart' out"
            )
    views = [SideView(WalkScene.of(walk)) for walk in walks.values()]
    share = 1.0 / len(views)
    body = share * WIDTH * max(draw.HEADROOM * v.height + draw.SOLE for v in views) / SHOWN
    height = HEAD + body + STRIP
    figure, panels = draw.blank(WIDTH, height), []
    for k, (name, walk) in enumerate(walks.items()):
        axes = figure.add_axes((k * share, STRIP / height, share, body / height))
        colour, signals = LINES[k % len(LINES)], cast(Tracked, walk).signals
        panels.append(_Panel(axes, views[k], signals, name, colour, float(times[0])))
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
        draw.follow(self.axes, self.view, t, 0.5 * SHOWN, 0.5 * SHOWN)
        self.walk.show(t)
        if self.ending and t >= self.view.scene.trajectory.t_end:
            width = 0.92 * self.axes.bbox.width
            self.text.set_text(draw.wrapped(self.ending.replace(": ", ":\n"), width))
            return
        s = self.signals
        so_far = np.abs(s.error[(s.t >= self.start) & (s.t <= t)])
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
