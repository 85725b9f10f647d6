"""The paper's figures 4 to 6, the multipliers, the return map and the map of pushes: data in, Figure out."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from biped_adrc.analysis.signals import Signals
from biped_adrc.types import Array
from biped_adrc.viz.push_map_plot import push_map_figure
from biped_adrc.viz.style import DASHES, GREY, PALETTE, PUSH, label, new_figure, style

Window = tuple[float, float]

JOINTS = ("stance hip", "swing hip", "stance knee", "swing knee")
BEFORE, AFTER = 0.3, 0.6
"""[s]: what the zoom shows before and after a push."""


def broken(s: Signals, y: Array) -> Array:
    """y (K, ...) with a row of NaN where a single support begins, so that no line crosses an impact."""
    return np.insert(y, np.flatnonzero(np.diff(s.step)) + 1, np.nan, axis=0)


def tracking_figure(
    signals: Signals, title: str, push: Window | None = None, torque_limit: float | None = None
) -> Figure:
    """The paper's figures 4 and 5: references and joint angles, torques, and the tracking error.

    push: (start, stop) [s]; its window is shaded, and a second column shows the time around it.
    torque_limit [N m]: drawn as a dotted line.
    """
    with style():
        figure = new_figure(11.0 if push else 7.5, 9.0)
        figure.suptitle(title)
        grid = figure.subplots(4, 2 if push else 1, squeeze=False, sharex="col")
        unit, factor = _angle_unit(signals.error)
        for column, head in zip(grid.T, ("whole walk", "around the push"), strict=False):
            _angles(column[0], signals, (0, 1), head)
            _angles(column[1], signals, (2, 3))
            _torques(column[2], signals, torque_limit)
            for i in range(signals.error.shape[1]):
                _line(column[3], signals, factor * signals.error[:, i], i, f"$q_{i + 1}$")
            label(column[3], "time [s]", f"tracking error [{unit}]")
            for axes in column:
                if push:
                    name = "push" if axes is column[0] else "_"
                    axes.axvspan(*push, color=PUSH, alpha=0.45, zorder=0, label=name)
                axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2)
        grid[0, 0].set_xlim(signals.t[0], signals.t[-1])
        if push:
            _zoom(grid[:, 1], signals, push)
            for axes in grid[:, 0]:
                axes.get_legend().remove()
        return figure


def _angle_unit(values: Array) -> tuple[str, float]:
    """The unit in which the largest of `values` [rad] reads well, and its factor."""
    largest = np.nanmax(np.abs(values), initial=0.0)
    for unit, factor in (("rad", 1.0), ("mrad", 1e3), ("µrad", 1e6)):
        if largest * factor >= 0.5:
            return unit, factor
    return "nrad", 1e9


def _line(axes: Axes, s: Signals, y: Array, i: int, name: str) -> None:
    axes.plot(broken(s, s.t), broken(s, y), color=PALETTE[i], ls=DASHES[i % 4], label=name)


def _angles(axes: Axes, s: Signals, joints: tuple[int, ...], title: str = "") -> None:
    """Measured angles as solid lines, their references dashed on top in black."""
    t = broken(s, s.t)
    for i in joints:
        name = f"$q_{i + 1}$ {JOINTS[i]}"
        axes.plot(t, broken(s, s.q[:, i]), color=PALETTE[i], lw=2.2, alpha=0.8, label=name)
    for i in joints:
        name = "references" if i == joints[0] else "_"
        axes.plot(t, broken(s, s.q_d[:, i]), color="black", ls=(0, (4, 3)), lw=0.8, label=name)
    label(axes, "", "angle [rad]", title)


def _torques(axes: Axes, s: Signals, limit: float | None) -> None:
    for i in range(s.u.shape[1]):
        _line(axes, s, s.u[:, i], i, f"$u_{i + 1}$")
    for sign in (-1.0, 1.0) if limit is not None else ():
        name = "limit" if sign > 0 else "_"
        axes.axhline(sign * limit, color=GREY, ls=":", label=name)  # type: ignore[operator]
    label(axes, "", "torque [N m]")


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
            axes.plot(broken(s, s.theta), broken(s, s.dtheta), color=PALETTE[i], lw=0.8, label=name)
            jumps = np.flatnonzero(np.diff(s.step))
            for k, j in enumerate(jumps):
                text = "impact" if k == 0 else "_"
                ends = slice(j, j + 2)
                axes.plot(s.theta[ends], s.dtheta[ends], color=GREY, ls=":", lw=0.6, label=text)
            axes.plot(s.theta[0], s.dtheta[0], "o", color="black", ms=4, label="start")
            label(axes, r"$\Theta$ [rad]", r"$\dot\Theta$ [rad/s]", name)
            axes.legend(loc="best")
        return figure


def multiplier_figure(
    multipliers: Mapping[str, ArrayLike], published: ArrayLike | None = None
) -> Figure:
    """Multipliers in the unit circle, and their magnitudes in decreasing order.

    multipliers: name -> complex (k,). published: magnitudes printed in the paper; they come from a
    regression and are shown for comparison only.
    """
    with style():
        figure = new_figure(9.5, 4.4)
        circle, sizes = figure.subplots(1, 2)
        angle = np.linspace(0.0, 2.0 * np.pi, 361)
        circle.plot(np.cos(angle), np.sin(angle), color="black", lw=1.0, label="unit circle")
        sizes.axhline(1.0, color="black", lw=1.0, label="unit circle")
        for i, (name, values) in enumerate(multipliers.items()):
            z = np.atleast_1d(np.asarray(values, dtype=complex))
            mark = {"marker": "ox^s"[i % 4], "ls": "", "mec": PALETTE[i], "label": name}
            circle.plot(z.real, z.imag, mfc="none", ms=7 + 2 * i, **mark)
            size = np.sort(np.abs(z))[::-1]
            sizes.plot(1 + np.arange(len(size)), size, mfc="none", ms=6, **mark)
        if published is not None:
            size = np.sort(np.abs(np.asarray(published)))[::-1]
            name = "printed in the paper (regression)"
            sizes.plot(1 + np.arange(len(size)), size, "+", color=GREY, ms=8, label=name)
        circle.set_aspect("equal")
        sizes.set_yscale("log")
        label(circle, r"Re $\lambda$ [-]", r"Im $\lambda$ [-]", "multipliers of the return map")
        label(sizes, "number in decreasing order [-]", r"$|\lambda|$ [-]", "magnitudes")
        circle.legend(loc="upper left", bbox_to_anchor=(0.0, -0.14), ncols=3)
        sizes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.14), ncols=2)
        return figure


def return_map_figure(before: Array, after: Array) -> Figure:
    """Theta' before one impact against Theta' before the next, both (k,) [rad/s], and the diagonal."""
    with style():
        figure = new_figure(5.2, 4.8)
        axes = figure.subplots()
        ends = np.array([np.nanmin(before), np.nanmax(before)])
        axes.plot(ends, ends, color=GREY, ls="--", label="the same speed")
        axes.plot(before, after, color=PALETTE[0], marker="o", ms=3, label="return map")
        crossing = int(np.nanargmin(np.abs(after - before)))
        here = before[crossing], after[crossing]
        axes.plot(*here, "s", color=PALETTE[1], ms=7, mfc="none", label="fixed point")
        label(axes, r"$\dot\Theta$ before impact $k$ [rad/s]", r"before impact $k+1$ [rad/s]")
        axes.legend(loc="best")
        return figure


__all__ = [
    "broken",
    "multiplier_figure",
    "phase_figure",
    "push_map_figure",
    "return_map_figure",
    "tracking_figure",
]
