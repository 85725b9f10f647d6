"""Figures of a study, many walks that differ in some values of their scenario: dots with intervals, maps, and
paths of a search for the best values.

They take plain values and draw any study: rows and columns are names, numbers come with the ends of a
confidence interval of 95 %, which are NaN where there is none. A number that is not finite has no mark. A field
is a value of the scenario that a study varies, its levels the values that it takes.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from biped_adrc.core.types import Array, Indices
from biped_adrc.view.style import GREY, PALETTE, label, literal, new_figure

_MARKERS = ("o", "s", "D", "^", "v", "P", "X", "*")
"""Marks by series."""
MOST_LEVELS, CELLS = 40, 20
"""An axis with more numbers than the first is cut into as many cells as the second."""
MOST_PANELS = 12
"""Panels of a map; more are left out."""
_WRITTEN = 120
"""Cells of a panel up to which their numbers are written in them."""

_Numbers = Mapping[tuple[str, str], Sequence[float]]
"""(row, series) -> a number with the lower and the upper end of its interval."""


def dots_figure(
    numbers: _Numbers, title: str, scale: str, reference: float | None = None
) -> Figure:
    """Draw numbers with their intervals: a row for each name, a mark for each series.

    numbers: (row, series) -> (number, low, high). title: of the axis, with its unit. scale: "log" or "linear".
    reference: number at which a line is drawn.
    """
    rows, series = (list(dict.fromkeys(pair[i] for pair in numbers)) for i in (0, 1))
    # so that the marks of the series in a row do not cover one another
    offsets = np.linspace(-0.22, 0.22, len(series)) if len(series) > 1 else [0.0]
    with new_figure(6.5, 1.1 + 0.36 * len(rows)) as figure:
        axes = figure.subplots()
        axes.set_xscale(scale)
        if reference is not None:
            axes.axvline(reference, color=GREY, lw=0.8)
        for i, name in enumerate(series):
            # (place on the y axis, number, low, high) of this series
            here = [
                (rows.index(row) + offsets[i], *x)
                for (row, of), x in numbers.items()
                if of == name and math.isfinite(x[0])
            ]
            y, x, low, high = np.array(here).reshape(-1, 4).T
            # lengths of the bars to either side; an end that is NaN or infinite has none
            ends = np.nan_to_num([x - low, high - x], posinf=0.0, neginf=0.0).clip(0.0)
            mark, colour = _MARKERS[i % len(_MARKERS)], PALETTE[i % len(PALETTE)]
            text = literal(name) or None
            axes.errorbar(x, y, xerr=ends, fmt=mark, color=colour, ms=4, lw=1.0, label=text)
        axes.set_yticks(range(len(rows)), [literal(row) for row in rows])
        axes.set_ylim(len(rows) - 0.5, -0.5)
        label(axes, title, "")
        if len(series) > 1:
            figure.legend(loc="outside lower center", ncols=min(len(series), 4))
        return figure


def map_figure(
    panels: Mapping[str, tuple[Sequence[Any], Sequence[Any], Array]],
    names: tuple[str, str],
    title: str,
    log: bool,
) -> Figure:
    """Draw a number as colour over two fields of a study, in one panel for each case.

    panels: name -> (x (N,), y (N,), numbers (N,)) of its N walks, x and y the levels of both fields. Numbers in
    the same cell are averaged, those that are not finite left out. Only the first MOST_PANELS are drawn. names:
    labels of x and y, with units. title: of the colour bar. log: logarithmic scale of colour; otherwise it goes
    from 0 to 1.
    """
    shown = dict(list(panels.items())[:MOST_PANELS])
    # all panels have the same cells: each axis is cut once for the walks of all, one panel after the other.
    # xs, ys: (index of the cell of each walk, names of the cells)
    xs, ys = (cut([x for panel in shown.values() for x in panel[i]]) for i in (0, 1))
    means, begin = [], 0
    for panel in shown.values():
        part = slice(begin, begin := begin + len(panel[2]))
        means.append(_means(xs[0][part], ys[0][part], panel[2], (len(ys[1]), len(xs[1]))))
    known = np.concatenate([m[np.isfinite(m)] for m in means])
    low, high = (known.min(), known.max()) if log and known.size else (0.0, 1.0)
    norm = LogNorm(low, max(high, low * 1.001)) if log and low > 0.0 else Normalize(low, high)
    # sizes in inches grow with the number of cells, within bounds
    columns = min(len(means), 4)
    rows = -(-len(means) // columns)  # rounded up
    width = 1.6 + columns * (1.0 + 0.3 * min(max(len(xs[1]), 5), 20))
    with new_figure(width, 0.8 + rows * (1.2 + 0.22 * min(max(len(ys[1]), 5), 20))) as figure:
        grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
        for axes in grid.flat[len(means) :]:
            axes.set_axis_off()
        for k, (axes, name, m) in enumerate(zip(grid.flat, shown, means, strict=False)):
            texts = [[f"{x:.2g}" if np.isfinite(x) else "" for x in row] for row in m]
            axes.set_facecolor("#DDDDDD")  # where there is no number
            image = _cells(axes, m, texts if m.size <= _WRITTEN else (), norm)
            _ticks(axes, xs[1], ys[1])
            below, left = k + columns >= len(means), k % columns == 0
            label(axes, names[0] if below else "", names[1] if left else "", literal(name))
            axes.tick_params(labelbottom=below)
        figure.colorbar(image, ax=grid, label=title, shrink=0.9)
        return figure


def path_figure(
    paths: Mapping[str, Sequence[tuple[int, float, bool]]], title: str, less: bool
) -> Figure:
    """Draw how a search went: the objective of each candidate over its number as a dot, as a cross where it
    breaks a limit. A line follows the best objective so far of those that keep all limits.

    paths: case, in a colour of its own -> (number of the candidate, objective, whether it keeps all limits) of
    each. title: of the axis of the objective, with its unit. less: whether a smaller objective is better.
    """
    with new_figure(6.5, 3.2) as figure:
        axes = figure.subplots()
        axes.set_yscale("log")
        for i, (name, path) in enumerate(paths.items()):
            color = PALETTE[i % len(PALETTE)]
            for kept, mark in ((True, "o"), (False, "x")):
                x = [(n, x) for n, x, feasible in path if feasible is kept and math.isfinite(x)]
                axes.plot(*np.array(x).reshape(-1, 2).T, mark, color=color, ms=2.5, ls="none")
            # a candidate that breaks a limit is never the best
            numbers = [x if kept else math.inf if less else -math.inf for _, x, kept in path]
            best = (np.minimum if less else np.maximum).accumulate(numbers)
            numbered = [n for n, *_ in path]
            axes.step(numbered, best, where="post", color=color, label=literal(name) or None)
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        label(axes, "candidate", literal(title))
        if len(paths) > 1:
            figure.legend(loc="outside lower center", ncols=min(len(paths), 4))
        return figure


def cut(values: Sequence[Any]) -> tuple[Indices, list[str]]:
    """Sort values (N,) into the cells of an axis; returns the cell's index of each (N,), and the cells' names.

    Each level is a cell; more than MOST_LEVELS numbers are cut into `CELLS` intervals of equal width, with the
    middles as names.
    """
    values = [repr(x) if isinstance(x, list) else x for x in values]  # such as b_0 of each joint
    # numbers first, then None, then texts, which cannot be compared with one another
    levels = sorted(
        set(values), key=lambda x: (isinstance(x, str), x is None, 0 if x is None else x)
    )
    if len(levels) <= MOST_LEVELS or not all(isinstance(x, int | float) for x in levels):
        places = {x: i for i, x in enumerate(levels)}
        return np.array([places[x] for x in values]), [_text(x) for x in levels]
    edges = np.linspace(levels[0], levels[-1], CELLS + 1)
    cells = np.clip(np.searchsorted(edges, values, side="right") - 1, 0, CELLS - 1)
    return cells, [f"{x:.3g}" for x in (edges[1:] + edges[:-1]) / 2]


def _text(x: Any) -> str:
    """Text of a level on an axis: texts as they are, numbers with four digits, "none" for None."""
    return literal(x) if isinstance(x, str) else "none" if x is None else f"{x:.4g}"


def _means(x: Indices, y: Indices, numbers: Array, shape: tuple[int, int]) -> Array:
    """Mean of the finite numbers (N,) in each cell, (cells of y, cells of x); NaN where a cell has none.

    x, y (N,): index of the cell of each number along both axes. shape: (cells of y, cells of x).
    """
    known = np.isfinite(numbers)
    places = (y * shape[1] + x)[known]
    count = np.bincount(places, minlength=shape[0] * shape[1])
    total = np.bincount(places, numbers[known], minlength=shape[0] * shape[1])
    return np.where(count > 0, total / np.maximum(count, 1), np.nan).reshape(shape)


def _cells(axes: Axes, values: Array, texts: Sequence[Sequence[str]], norm: Normalize) -> Any:
    """Draw a table of values (rows, columns) as coloured cells, cell (i, j) at x = j, y = i, with texts on
    them, white on dark cells.

    texts: by row and column, () for none. norm: maps values to the range 0 to 1 of colours. Returns
    matplotlib's mesh, for a colour bar.
    """
    edges = [np.arange(count + 1) - 0.5 for count in reversed(values.shape)]
    image = axes.pcolormesh(*edges, values, cmap="cividis", norm=norm, ec="white", lw=0.3)
    for (y, x), text in np.ndenumerate(texts):
        colour = "white" if norm(values[y, x]) < 0.5 else "black"
        axes.text(x, y, text, ha="center", va="center", color=colour, size=6.5)
    axes.grid(False)
    return image


def _ticks(axes: Axes, x: Sequence[str], y: Sequence[str]) -> None:
    """Label the cells of both axes with their names, at most about twelve of each."""
    for set_ticks, names, rotation in ((axes.set_xticks, x, 45), (axes.set_yticks, y, 0)):
        places = range(0, len(names), -(-len(names) // 12))  # -(-a // b) is a / b rounded up
        set_ticks(list(places), [names[k] for k in places], rotation=rotation)
