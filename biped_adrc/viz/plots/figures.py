"""Whole figures made of the plots in `biped_adrc.viz.plots`: data in, Figure out, in this package's style.

`Walk.plot`, the reproduction of the paper and `biped-adrc plot` draw these. With a push most of
them get more columns: the time around the push, and the milliseconds after either edge of it, in
which a fast observer has its say. Lines are thinned to what can be seen (`viz.thin`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.gridspec import SubplotSpec
from numpy.typing import ArrayLike

from biped_adrc.analysis.signals import Signals
from biped_adrc.types import Array
from biped_adrc.viz import plots
from biped_adrc.viz.plots.over_time import Window
from biped_adrc.viz.style import new_figure, style
from biped_adrc.viz.thin import thin

BEFORE, AFTER = 0.3, 0.6
"""What the zoom shows before and after a push [s]."""
EDGE_BEFORE, EDGE_AFTER = 1e-3, 6e-3
"""What is shown before and after an edge of a push [s]."""
EDGES = ("push begins", "push ends")
"""Titles of the columns of the two edges."""


def tracking_figure(
    signals: Signals, title: str, push: Window | None = None, torque_limit: float | None = None
) -> Figure:
    """The paper's figures 4 and 5: references and joint angles [rad], torques [N m], and the tracking error.

    signals: of a walk with motors. title: above all panels. push: (start, stop) [s]; its window is
    shaded, a row shows its torque, a second column the time around it, and two more the
    milliseconds after either edge, without angles, as these do not move within milliseconds.
    torque_limit [N m]: drawn as a dotted line.
    """
    k = min(2, signals.q_d.shape[1])  # panels of angles
    heights = (*(3.0,) * k, 1.6, 3.0, 3.0) if push else (1.0,) * (k + 2)
    shares = (1.5, 1.5, 1.0, 1.0) if push else (1.0,)
    with style():
        figure = new_figure(13.0 if push else 7.5, 9.6 if push else 9.0)
        figure.suptitle(title)
        spec = figure.add_gridspec(
            len(heights), len(shares), width_ratios=shares, height_ratios=heights
        )
        # angles do not move within milliseconds: they have no panels at the edges
        columns = [
            _column(figure, [spec[i, j] for i in range(0 if j < 2 else k, len(heights))])
            for j in range(len(shares))
        ]
        for j, column in enumerate(columns):
            _tracking_column(column, k if j < 2 else 0, signals, push, torque_limit)
        columns[0][0].set_xlim(signals.t[0], signals.t[-1])
        columns[0][0].set_title("whole walk", loc="left")
        if push:
            _zoom(columns[1], signals, push)
            columns[1][0].set_title("around the push", loc="left")
            _edges(columns[2:], signals, push)
            _one_legend_a_row([*columns[0], *columns[1][k:], *columns[2]], columns[1][:k])
        return thin(figure)


def _column(figure: Figure, places: Sequence[SubplotSpec]) -> list[Axes]:
    """Panels one above the other that share one time axis, whose numbers stand below the lowest."""
    first = figure.add_subplot(places[0])
    column = [first, *(figure.add_subplot(place, sharex=first) for place in places[1:])]
    for axes in column[:-1]:
        axes.tick_params(labelbottom=False)
    return column


def _tracking_column(
    column: Sequence[Axes], angles: int, s: Signals, push: Window | None, limit: float | None
) -> None:
    """Fill the panels of a column from top to bottom: so many of angles, the push if any, torques, errors.

    limit [N m]: of the torques, drawn as a line.
    """
    halves = np.array_split(np.arange(s.q_d.shape[1]), angles) if angles else []
    for axes, half in zip(column, halves, strict=False):
        plots.joint_tracking(axes, s, half.tolist(), push)
    if push:
        plots.external_torque(column[-3], s, push)
    plots.torques(column[-2], s, limit, push)
    plots.tracking_errors(column[-1], s, push)
    for axes in column[:-1]:
        axes.set_xlabel("")


def _edges(columns: Sequence[Sequence[Axes]], s: Signals, push: Window) -> None:
    """Set the limits of two columns around either edge of the push, and label their time in [ms] from it."""
    for column, edge, name in zip(columns, push, EDGES, strict=True):
        _limits(column, max(edge - EDGE_BEFORE, s.t[0]), min(edge + EDGE_AFTER, s.t[-1]))
        column[0].set_title(name, loc="left")
        at = np.arange(0.0, EDGE_AFTER + 1e-9, 2e-3)
        for axes in column:
            axes.set_xticks(edge + at, [f"{1e3 * t:g}" for t in at])
            axes.set_xlabel("")
        column[-1].set_xlabel("after the edge [ms]")


def _one_legend_a_row(without: Sequence[Axes], beside_empty: Sequence[Axes]) -> None:
    """Take the legends away from `without`; those of `beside_empty` reach into an empty place and take
    no room.
    """
    for axes in without:
        legend = axes.get_legend()
        if legend is not None:
            legend.remove()
    for axes in beside_empty:
        legend = axes.get_legend()
        if legend is not None:
            legend.set_in_layout(False)


def passive_figure(signals: Signals, title: str = "", push: Window | None = None) -> Figure:
    """A walk without motors: its angles [rad] and energies [J] over time [s], and Theta against its rate.

    push: (start, stop) [s], shaded.
    """
    with style():
        figure = new_figure(10.5, 5.6)
        figure.suptitle(title)
        parts = figure.subplot_mosaic(
            [["angles", "phase"], ["energy", "phase"]], width_ratios=(3, 2)
        )
        plots.angles(parts["angles"], signals, push).set_xlabel("")
        plots.energy(parts["energy"], signals, push)
        plots.phase_portrait(parts["phase"], signals)
        return thin(figure)


def _zoom(column: Sequence[Axes], s: Signals, push: Window) -> None:
    """Set the limits of a column to the time around the push, and of each value axis to what is drawn there."""
    _limits(column, max(push[0] - BEFORE, float(s.t[0])), min(push[1] + AFTER, float(s.t[-1])))


def _limits(column: Sequence[Axes], low: float, high: float) -> None:
    """Set the time axis from low to high [s], and each value axis to what is drawn there.

    A panel with nothing to show there, or a constant, keeps its limits.
    """
    for axes in column:
        axes.set_xlim(low, high)
        shown = [np.asarray(line.get_data(), dtype=float) for line in axes.get_lines()]
        values = [y[(t >= low) & (t <= high)] for t, y in shown if len(t) > 2]
        values = [y[np.isfinite(y)] for y in values]
        ends = np.array([(y.min(), y.max()) for y in values if len(y)])
        if not len(ends) or not ends[:, 1].max() > ends[:, 0].min():
            continue
        if axes.get_yscale() == "log":
            axes.set_ylim(0.5 * ends[:, 0].min(), 2.0 * ends[:, 1].max())
            continue
        pad = 0.06 * (ends[:, 1].max() - ends[:, 0].min())
        axes.set_ylim(ends[:, 0].min() - pad, ends[:, 1].max() + pad)


def phase_figure(walks: Mapping[str, Signals]) -> Figure:
    """The paper's figure 6: Theta [rad] against Theta' [rad/s], a panel for each controller; lines
    break at impacts.
    """
    with style():
        figure = new_figure(4.6 * len(walks), 4.2)
        row = figure.subplots(1, len(walks), squeeze=False, sharex=True, sharey=True)[0]
        for i, (axes, (name, s)) in enumerate(zip(row, walks.items(), strict=True)):
            plots.phase_portrait(axes, s, name, i).set_title(name, loc="left")
        return thin(figure)


def disturbance_figure(signals: Signals, title: str = "", push: Window | None = None) -> Figure:
    """Every actuated joint's total disturbance, and the torque from outside, against their estimates.

    A row for each joint: xi of (13) [rad/s^2] at the left, the torque zeta and what the estimate
    amounts to [N m] at the right. push: (start, stop) [s]; the time around it is shown, and in two
    more columns the torque at either edge.
    """
    p = signals.q_d.shape[1]
    with style():
        figure = new_figure(13.0 if push else 10.5, 2.1 * p)
        figure.suptitle(title)
        shares = [1.5, 1.5, 1.0, 1.0] if push else [1.0, 1.0]
        grid = figure.subplots(p, len(shares), squeeze=False, sharex="col", width_ratios=shares)
        for i, row in enumerate(grid):
            plots.total_disturbance(row[0], signals, i, push)
            for axes in row[1:]:
                plots.matched_disturbance(axes, signals, i, push)
            if i < p - 1:
                for axes in row:
                    axes.set_xlabel("")
        grid[0, 0].set_title("total disturbance", loc="left")
        grid[0, 1].set_title("matched part: torque from outside", loc="left")
        if push:
            for column in grid.T[:2]:
                _zoom(column, signals, push)
            _edges([list(column) for column in grid.T[2:]], signals, push)
            for axes in grid[:, :2].flat:
                axes.legend(loc="best", frameon=False)
            _one_legend_a_row(list(grid[:, 2:].flat), ())
        return thin(figure)


def ground_figure(signals: Signals, title: str = "", mu: float = 0.6, slope: float = 0.0) -> Figure:
    """The ground reaction [N] over time, and its tangential against its normal part in the friction cone.

    mu [1]: coefficient of friction. slope [rad]: of the ground, positive downhill.
    """
    with style():
        figure = new_figure(10.0, 4.0)
        figure.suptitle(title)
        over_time, cone = figure.subplots(1, 2, width_ratios=(3, 2))
        plots.ground_reaction(over_time, signals, slope=slope)
        plots.friction_cone(cone, signals, mu, slope)
        return thin(figure)


def energy_figure(signals: Signals, title: str = "", push: Window | None = None) -> Figure:
    """Kinetic, potential and total energy [J] over time [s]. push: (start, stop) [s], shaded."""
    with style():
        figure = new_figure(8.5, 3.4)
        plots.energy(figure.subplots(), signals, push).set_title(title, loc="left")
        return thin(figure)


def multiplier_figure(
    multipliers: Mapping[str, ArrayLike], published: ArrayLike | None = None
) -> Figure:
    """Floquet multipliers (k,), complex, by name in the unit circle, and their magnitudes in decreasing order.

    published (k,): magnitudes printed in the paper, shown for comparison; see `plots.magnitudes`.
    """
    with style():
        figure = new_figure(9.5, 4.4)
        circle, sizes = figure.subplots(1, 2)
        plots.multipliers(circle, multipliers).set_title("multipliers", loc="left")
        plots.magnitudes(sizes, multipliers, published).set_title("magnitudes", loc="left")
        return figure


def return_map_figure(before: Array, after: Array) -> Figure:
    """The return map of Theta' as a staircase; see `plots.staircase`.

    before, after (k,): Theta' before one impact and before the next [rad/s].
    """
    with style():
        figure = new_figure(5.2, 4.8)
        plots.staircase(figure.subplots(), before, after)
        return figure


def comparison_figure(walks: Mapping[str, Signals], push: Window | None = None) -> Figure:
    """Controllers side by side: tracking error over time, its size, and the peak torques.

    walks: signals by name of the controller. push: (start, stop) [s]; a row shows it, and two
    columns the milliseconds after either edge.
    """
    with style():
        figure = new_figure(11.0 if push else 10.0, 7.2 if push else 5.6)
        heights = (1.0, 2.6, 2.4) if push else (1.0, 1.0)
        spec = figure.add_gridspec(len(heights), 4, height_ratios=heights)
        if push:
            columns = [
                _column(figure, [spec[0, place], spec[1, place]])
                for place in (slice(0, 2), slice(2, 3), slice(3, 4))
            ]
            _pushed_columns(columns, walks, push)
        else:
            plots.error_over_time(figure.add_subplot(spec[0, :]), walks)
        plots.error_sizes(figure.add_subplot(spec[-1, :2]), walks)
        plots.torque_sizes(figure.add_subplot(spec[-1, 2:]), walks)
        return thin(figure)


def _pushed_columns(
    columns: Sequence[Sequence[Axes]], walks: Mapping[str, Signals], push: Window
) -> None:
    """Draw the push, the same for all walks, above their errors: over the whole walk, and at either edge."""
    first = next(iter(walks.values()))
    for above, axes in columns:
        plots.external_torque(above, first, push).set_xlabel("")
        plots.error_over_time(axes, walks, push)
    _limits(columns[0], float(first.t[0]), float(first.t[-1]))
    columns[0][0].set_title("whole walk", loc="left")
    _edges(columns[1:], first, push)
    _one_legend_a_row([columns[0][0], columns[1][0], columns[1][1], columns[2][1]], ())
