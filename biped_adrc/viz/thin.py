"""Fewer points for lines that have more of them than can be seen.

A walk at a sampling period of 1 ms has some 10 000 nodes a line; as SVG such a figure has
megabytes. A line keeps, of the consecutive points inside one column of the picture, the first, the
last and those with the extreme values: it looks the same, and its largest and least values stay.
`thin` is the last call of most functions in `plots.figures`.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from biped_adrc.types import Array

COLUMNS = 600
"""Columns of one panel, finer than its pixels."""
VISIBLE = 0.01
"""Share of a line's range from which on a jump counts as one."""


def thinned(x: Array, y: Array, width: float) -> NDArray[np.intp]:
    """Indices of the points to keep of the line through x, y (K,), for columns of this width in units of x.

    NaN breaks the line and is kept. Both sides of a jump are kept too: two points at one x whose y
    differ by more than `VISIBLE` of the range of y. Where x goes back, as in a phase portrait, the
    extremes of x in each column stay as well as those of y.
    """
    gap = np.isnan(x) | np.isnan(y)
    column = np.where(gap, -1, np.floor(np.where(gap, 0.0, x) / width))
    edges = np.flatnonzero((column[1:] != column[:-1]) | (gap[1:] != gap[:-1])) + 1
    bounds = np.concatenate(([0], edges, [len(x)])).astype(int)
    keep = np.zeros(len(x), dtype=bool)
    keep[bounds[:-1]] = keep[bounds[1:] - 1] = True
    with_extremes = (y,) if not np.any(np.diff(x) < 0.0) else (x, y)
    for start, stop in pairwise(bounds.tolist()):
        if stop - start <= 4 or gap[start]:
            keep[start:stop] = True
            continue
        for values in with_extremes:
            part = values[start:stop]
            keep[start + part.argmin()] = keep[start + part.argmax()] = True
    finite = y[np.isfinite(y)]
    span = float(np.ptp(finite)) if len(finite) else 0.0
    twice = np.flatnonzero(x[1:] == x[:-1])
    jump = twice[np.abs(y[twice + 1] - y[twice]) > VISIBLE * span]
    keep[jump] = keep[jump + 1] = True
    return np.flatnonzero(keep)


def inside(x: Array, low: float, high: float) -> NDArray[np.bool_]:
    """Which points (K,) of the line with these x (K,) belong to a segment that reaches into [low, high].

    The neighbours outside the limits stay, as the line goes to them; so does NaN, which breaks the
    line.
    """
    lower, upper = np.minimum(x[1:], x[:-1]), np.maximum(x[1:], x[:-1])
    seen = (upper >= low) & (lower <= high)
    kept = np.concatenate(([False], seen)) | np.concatenate((seen, [False]))
    return kept | np.isnan(x) | ((x >= low) & (x <= high))


def thin(figure: Figure) -> Figure:
    """Thin every line of the figure to what its panel shows, in place; returns the figure.

    Limits of the axes stay those of all points. Panels with a logarithmic x are left as they are.
    """
    for axes in figure.axes:
        low, high = sorted(axes.get_xlim())
        axes.get_ylim()  # the limits are those of all points
        _thin_axes(axes, low, high)
    return figure


def _thin_axes(axes: Axes, low: float, high: float) -> None:
    """Thin the lines of one panel that shows x from low to high; lines in other coordinates are left alone."""
    if axes.get_xscale() != "linear":
        return
    for line in axes.get_lines():
        x, y = (np.asarray(values, dtype=float) for values in line.get_data())
        if len(x) <= 4 or line.get_transform() != axes.transData:
            continue
        shown = np.flatnonzero(inside(x, low, high))
        kept = shown
        if len(shown) > 4:
            kept = shown[thinned(x[shown], y[shown], (high - low) / COLUMNS)]
        line.set_data(x[kept], y[kept])
