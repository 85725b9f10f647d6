"""Whole figures made of `biped_adrc.viz.plots`: data in, Figure out, in the one style of this package."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from biped_adrc.analysis.signals import Signals
from biped_adrc.types import Array
from biped_adrc.viz import plots
from biped_adrc.viz.plots.lines import Window
from biped_adrc.viz.push_map_plot import push_map_figure
from biped_adrc.viz.style import new_figure, style

BEFORE, AFTER = 0.3, 0.6
"""[s]: what the zoom shows before and after a push."""


def tracking_figure(
    signals: Signals, title: str, push: Window | None = None, torque_limit: float | None = None
) -> Figure:
    """The paper's figures 4 and 5: references and joint angles, torques, and the tracking error.

    push: (start, stop) [s]; its window is shaded, and a second column shows the time around it.
    torque_limit [N m]: drawn as a dotted line.
    """
    halves = np.array_split(np.arange(signals.q_d.shape[1]), 2)
    with style():
        figure = new_figure(11.0 if push else 7.5, 9.0)
        figure.suptitle(title)
        grid = figure.subplots(4, 2 if push else 1, squeeze=False, sharex="col")
        for column, head in zip(grid.T, ("whole walk", "around the push"), strict=False):
            for axes, half in zip(column, halves, strict=False):
                plots.joint_tracking(axes, signals, half.tolist(), push)
            plots.torques(column[2], signals, torque_limit, push)
            plots.tracking_errors(column[3], signals, push)
            column[0].set_title(head, loc="left")
            for axes in column[:3]:
                axes.set_xlabel("")
        grid[0, 0].set_xlim(signals.t[0], signals.t[-1])
        if push:
            _zoom(grid[:, 1], signals, push)
            for axes in grid[:, 0]:
                axes.get_legend().remove()
        return figure


def passive_figure(signals: Signals, title: str = "", push: Window | None = None) -> Figure:
    """A walk without motors: its angles and energies over time, and Theta against its rate."""
    with style():
        figure = new_figure(10.5, 5.6)
        figure.suptitle(title)
        parts = figure.subplot_mosaic(
            [["angles", "phase"], ["energy", "phase"]], width_ratios=(3, 2)
        )
        plots.angles(parts["angles"], signals, push).set_xlabel("")
        plots.energy(parts["energy"], signals, push)
        plots.phase_portrait(parts["phase"], signals)
        return figure


def _zoom(column: NDArray[np.object_], s: Signals, push: Window) -> None:
    """Limits of the time axis and of each value axis around the push."""
    low = max(push[0] - BEFORE, float(s.t[0]))
    high = min(push[1] + AFTER, float(s.t[-1]))
    for axes in column:
        axes.set_xlim(low, high)
        shown = [np.asarray(line.get_data(), dtype=float) for line in axes.get_lines()]
        values = [y[(t >= low) & (t <= high)] for t, y in shown if len(t) > 2]
        ends = np.array([(np.nanmin(y), np.nanmax(y)) for y in values if np.isfinite(y).any()])
        if len(ends) and ends[:, 1].max() > ends[:, 0].min():
            pad = 0.06 * (ends[:, 1].max() - ends[:, 0].min())
            axes.set_ylim(ends[:, 0].min() - pad, ends[:, 1].max() + pad)


def phase_figure(walks: Mapping[str, Signals]) -> Figure:
    """The paper's figure 6: Theta against Theta', one panel per controller; lines break at impacts."""
    with style():
        figure = new_figure(4.6 * len(walks), 4.2)
        row = figure.subplots(1, len(walks), squeeze=False, sharex=True, sharey=True)[0]
        for i, (axes, (name, s)) in enumerate(zip(row, walks.items(), strict=True)):
            plots.phase_portrait(axes, s, name, i).set_title(name, loc="left")
        return figure


def disturbance_figure(signals: Signals, title: str = "", push: Window | None = None) -> Figure:
    """Every actuated joint's total disturbance, and the torque from outside, against their estimates."""
    p = signals.q_d.shape[1]
    with style():
        figure = new_figure(10.5, 2.1 * p)
        figure.suptitle(title)
        grid = figure.subplots(p, 2, squeeze=False, sharex=True)
        for i, row in enumerate(grid):
            plots.total_disturbance(row[0], signals, i, push)
            plots.matched_disturbance(row[1], signals, i, push)
            if i < p - 1:
                for axes in row:
                    axes.set_xlabel("")
        grid[0, 0].set_title("total disturbance", loc="left")
        grid[0, 1].set_title("matched part: torque from outside", loc="left")
        if push:
            for column in grid.T:
                _zoom(column, signals, push)
        return figure


def ground_figure(signals: Signals, title: str = "", mu: float = 0.6, slope: float = 0.0) -> Figure:
    """The ground reaction over time and against the friction cone, on a slope [rad], positive downhill."""
    with style():
        figure = new_figure(10.0, 4.0)
        figure.suptitle(title)
        over_time, cone = figure.subplots(1, 2, width_ratios=(3, 2))
        plots.ground_reaction(over_time, signals, slope=slope)
        plots.friction_cone(cone, signals, mu, slope)
        return figure


def energy_figure(signals: Signals, title: str = "", push: Window | None = None) -> Figure:
    """Energies over time."""
    with style():
        figure = new_figure(8.5, 3.4)
        plots.energy(figure.subplots(), signals, push).set_title(title, loc="left")
        return figure


def multiplier_figure(
    multipliers: Mapping[str, ArrayLike], published: ArrayLike | None = None
) -> Figure:
    """Multipliers in the unit circle, and their magnitudes in decreasing order; see `plots.magnitudes`."""
    with style():
        figure = new_figure(9.5, 4.4)
        circle, sizes = figure.subplots(1, 2)
        plots.multipliers(circle, multipliers).set_title("multipliers", loc="left")
        plots.magnitudes(sizes, multipliers, published).set_title("magnitudes", loc="left")
        return figure


def return_map_figure(before: Array, after: Array) -> Figure:
    """Theta' before one impact against Theta' before the next, both (k,) [rad/s], as a staircase."""
    with style():
        figure = new_figure(5.2, 4.8)
        plots.staircase(figure.subplots(), before, after)
        return figure


def comparison_figure(walks: Mapping[str, Signals], push: Window | None = None) -> Figure:
    """Controllers side by side: error over time, its size, and what the motors gave for it."""
    with style():
        figure = new_figure(10.0, 5.6)
        parts = figure.subplot_mosaic([["time", "time"], ["error", "torque"]])
        plots.error_over_time(parts["time"], walks, push)
        plots.error_sizes(parts["error"], walks)
        plots.torque_sizes(parts["torque"], walks)
        return figure


__all__ = [
    "comparison_figure",
    "disturbance_figure",
    "energy_figure",
    "ground_figure",
    "multiplier_figure",
    "passive_figure",
    "phase_figure",
    "push_map_figure",
    "return_map_figure",
    "tracking_figure",
]
