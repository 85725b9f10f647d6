"""Controllers side by side on the same walk: tracking error over time, its size, and peak torques.

Each plot takes `Signals` by name of the controller; the i-th one has the i-th colour and mark in
all of them. `plots.figures.comparison_figure` puts them together.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from biped_adrc.analysis.quadrature import integrate
from biped_adrc.analysis.signals import Signals
from biped_adrc.view.plots.over_time import Window, broken, finished, legend
from biped_adrc.view.style import DASHES, PALETTE, label

MARKERS = "osD^"
"""Marks by controller, repeated from the fifth on."""
FLOOR = 1e-13
"""[rad], drawn for any smaller error: below round-off nothing can be told apart on a logarithmic scale."""


def error_over_time(axes: Axes, walks: Mapping[str, Signals], push: Window | None = None) -> Axes:
    """max_i |q_i - q_di| [rad] over the actuated joints against time [s], on one logarithmic scale.

    push: (start, stop) [s], shaded. Lines break at impacts.
    """
    for i, (name, s) in enumerate(walks.items()):
        largest = np.maximum(np.max(np.abs(s.error), axis=1), FLOOR)
        x, y = broken(s, s.t), broken(s, largest)
        axes.plot(x, y, label=name, color=PALETTE[i], ls=DASHES[i % 4], lw=1.0)
    axes.set_yscale("log")
    return finished(axes, "largest tracking error [rad]", push)


def error_sizes(axes: Axes, walks: Mapping[str, Signals]) -> Axes:
    """Peak and root-mean-square tracking error [rad] by controller, on one logarithmic scale, with the
    numbers.
    """
    for i, (name, s) in enumerate(walks.items()):
        sizes = [max(float(np.max(np.abs(s.error))), FLOOR), max(_rms(s), FLOOR)]
        axes.plot([0, 1], sizes, color=PALETTE[i], marker=MARKERS[i % 4], ls="", ms=8, label=name)
        for k, size in enumerate(sizes):
            axes.annotate(
                f"{size:.1e}", (k, size), xytext=(9, 0), textcoords="offset points", va="center"
            )
    axes.set_xticks([0, 1], ["largest", "root mean square"])
    axes.set_xlim(-0.5, 1.8)
    axes.set_yscale("log")
    axes.margins(y=0.15)
    label(axes, "", "tracking error [rad]")
    return axes


def _rms(s: Signals) -> float:
    """Root of the mean over time and joints of (q_b - q_d)^2 [rad].

    The mean over time is an integral over the nodes, as their distances differ between methods.
    """
    squares, duration = np.mean(s.error**2, axis=1), float(s.t[-1] - s.t[0])
    mean = integrate(s.t, squares) / duration if duration > 0.0 else float(squares[0])
    return float(np.sqrt(mean))


def torque_sizes(axes: Axes, walks: Mapping[str, Signals]) -> Axes:
    """Peak torque [N m] of every motor as bars, a colour and hatch for each controller."""
    width = 0.8 / len(walks)
    for i, (name, s) in enumerate(walks.items()):
        peaks = np.max(np.abs(s.u), axis=0)
        at = np.arange(len(peaks)) + (i - 0.5 * (len(walks) - 1)) * width
        hatch = ("", "///", "...", "xxx")[i % 4]
        axes.bar(at, peaks, width, color=PALETTE[i], ec="white", hatch=hatch, label=name)
    axes.set_xticks(np.arange(len(peaks)), [f"$u_{k + 1}$" for k in range(len(peaks))])
    label(axes, "", "peak torque [N m]")
    return legend(axes)
