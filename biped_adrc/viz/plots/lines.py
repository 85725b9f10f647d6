"""What the plots of signals share: lines that break at impacts, units that read well, shaded pushes."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from biped_adrc.analysis.signals import Signals
from biped_adrc.types import Array
from biped_adrc.viz.style import DASHES, PALETTE, PUSH

Window = tuple[float, float]
"""Start and stop of a push [s]."""


def broken(s: Signals, y: Array) -> Array:
    """y (K, ...) with a row of NaN where a single support begins, so that no line crosses an impact."""
    return np.insert(y, np.flatnonzero(np.diff(s.step)) + 1, np.nan, axis=0)


def line(axes: Axes, s: Signals, y: Array, i: int, name: str) -> None:
    """y (K,) over time in the i-th colour and dash."""
    axes.plot(broken(s, s.t), broken(s, y), color=PALETTE[i], ls=DASHES[i % 4], label=name)


def shade(axes: Axes, push: Window | None) -> None:
    """Mark the time of a push."""
    if push is not None:
        axes.axvspan(*push, color=PUSH, alpha=0.45, zorder=0, label="push")


def legend(axes: Axes) -> Axes:
    """A legend beside the axes, where it covers nothing."""
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2, frameon=False)
    return axes


def angle_unit(values: Array) -> tuple[str, float]:
    """The unit in which the largest of `values` [rad] reads well, and its factor."""
    largest = np.nanmax(np.abs(values), initial=0.0)
    for unit, factor in (("rad", 1.0), ("mrad", 1e3), ("µrad", 1e6)):
        if largest * factor >= 0.5:
            return unit, factor
    return "nrad", 1e9
