"""Maps of a sweep: a result as colour over two parameters, in panels over a third.

`biped-adrc sweep --plot` draws them (`bench.export.write_map`) from the columns of the sweep's
table. Each axis is cut into cells (`cut`), results are averaged over all points of a cell
(`cell_means`), so parameters that are not on an axis are averaged over: of `survived` colour is the
share of walks that make all steps, of `feasible` that of feasible walks. A parameter
with few values has a cell for each of them; one that was drawn at random is cut into cells of equal
width.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure
from numpy.typing import NDArray

from biped_adrc.errors import InputError
from biped_adrc.types import Array
from biped_adrc.viz.style import label, literal, new_figure, style

MOST_LEVELS = 40
"""A parameter with more values than these is cut into `CELLS`."""
CELLS = 20
"""Cells of a parameter with many values."""
MOST_PANELS = 12
"""Most panels of one figure."""
WRITTEN = 120
"""Cells of a panel up to which their numbers are written in them."""

SHARES = {
    "survived": "share of walks that make all steps",
    "feasible": "share of walks that are feasible",
}
"""Columns of 0 and 1, and what their mean is called."""

Column = NDArray[np.generic]
"""(N,), a value for each point of the study: numbers, or texts and None as objects."""
Columns = Mapping[str, Column]
"""Columns of one table, by name."""
Level = str | float | None
"""A value of a parameter."""


@dataclass(frozen=True)
class Maps:
    """What is shown: the mean of `value` over the parameters x and y, in panels over `panel` (None for one).

    units: of columns, for the labels. log: columns that are cut into cells of equal ratio in place
    of equal width.
    """

    x: str
    y: str
    panel: str | None = None
    value: str = "survived"
    units: Mapping[str, str] | None = None
    log: frozenset[str] = frozenset()

    def name(self, column: str) -> str:
        """The name of a column with its unit in brackets, for a label."""
        unit = (self.units or {}).get(column, "1")
        return column if unit == "1" else f"{column} [{unit}]"


class Cut(NamedTuple):
    """An axis in cells.

    cell (N,): the cell of each point, counted from 0, -1 for none. texts: of each cell, for its
    tick.
    """

    cell: NDArray[np.intp]
    texts: list[str]


def sweep_map_figure(columns: Columns, maps: Maps) -> Figure:
    """One panel for each level of the third parameter.

    columns: (N,) by name, such as those of a sweep's table. maps: which of them are shown. Raises
    InputError for a column that there is not, without points, with too many panels, or for a result
    that is no number.
    """
    for name in (maps.x, maps.y, maps.value, *((maps.panel,) if maps.panel else ())):
        if name not in columns:
            raise InputError(f"the map has no column '{name}'; choose from {list(columns)}")
    if len(columns[maps.x]) == 0:
        raise InputError("the map has no points; expected at least one finished run")
    values = _numbers(columns[maps.value], maps.value)
    panels = (
        cut(columns[maps.panel], False) if maps.panel else Cut(np.zeros(len(values), np.intp), [""])
    )
    if len(panels.texts) > MOST_PANELS:
        raise InputError(
            f"the map has {len(panels.texts)} panels over '{maps.panel}', expected at most {MOST_PANELS}; put "
            "it on an axis"
        )
    x, y = (cut(columns[name], name in maps.log) for name in (maps.x, maps.y))
    means = [
        cell_means(x, y, np.where(panels.cell == k, values, np.nan))
        for k in range(len(panels.texts))
    ]
    return _draw(maps, x, y, panels, means)


def cut(column: Column, log: bool) -> Cut:
    """The cells of an axis from its column (N,), in the unit of the column.

    One for each value where these are few or no numbers; else `CELLS` of equal width, or equal
    ratio if `log`. NaN and None have a cell of their own, the last.
    """
    levels = sorted({_order(x): x for x in column.tolist()}.values(), key=_order)
    numbers = column.dtype.kind in "fi"
    if len(levels) <= MOST_LEVELS or not numbers:
        place = {_order(x): k for k, x in enumerate(levels)}
        cell = np.array([place[_order(x)] for x in column.tolist()], np.intp)
        return Cut(cell, _texts(levels))
    known = column[np.isfinite(column)]
    low, high = float(known.min()), float(known.max())
    edges = np.geomspace(low, high, CELLS + 1) if log else np.linspace(low, high, CELLS + 1)
    cell = np.clip(np.searchsorted(edges, column, side="right") - 1, 0, CELLS - 1)
    cell[np.isnan(column)] = CELLS
    cell[np.isinf(column)] = -1
    middles = np.sqrt(edges[1:] * edges[:-1]) if log else (edges[1:] + edges[:-1]) / 2
    none = [_text(None)] if np.isnan(column).any() else []
    return Cut(cell.astype(np.intp), [f"{m:.3g}" for m in middles] + none)


def _order(x: Level) -> tuple[int, float | str]:
    """A key by which any values can be sorted: numbers, then NaN, texts, None."""
    if x is None:
        return 3, 0.0
    if isinstance(x, str):
        return 2, x
    return (1, 0.0) if x != x else (0, x)


def _texts(levels: list[Level]) -> list[str]:
    """Each level with the fewest digits, from two, that tell all of them apart within 1 %.

    So 0.0015 and 0.00152 do not both become "0.0015".
    """
    numbers = [x for x in levels if not isinstance(x, str) and x is not None and x == x]
    for digits in range(2, 6):
        shown = [float(f"{x:.{digits}g}") for x in numbers]
        near = all(abs(a - x) <= 0.01 * abs(x) for a, x in zip(shown, numbers, strict=True))
        if near and len(set(shown)) == len(set(numbers)):
            break
    return [_text(x, digits) for x in levels]


def _text(x: Level, digits: int = 4) -> str:
    """A value as text, with so many significant digits; "none" for what is no value."""
    if isinstance(x, str):
        return literal(x)
    return "none" if x is None or x != x else f"{float(f'{x:.{digits}g}'):.6g}"


def cell_means(x: Cut, y: Cut, values: Array) -> Array:
    """(cells of y, cells of x): the mean of the values (N,) that are finite, NaN in a cell without."""
    shape = len(y.texts), len(x.texts)
    inside = np.isfinite(values) & (x.cell >= 0) & (y.cell >= 0)
    places = y.cell[inside] * shape[1] + x.cell[inside]
    count = np.bincount(places, minlength=shape[0] * shape[1])
    total = np.bincount(places, values[inside], minlength=shape[0] * shape[1])
    return np.where(count > 0, total / np.maximum(count, 1), np.nan).reshape(shape)


def _numbers(column: Column, name: str) -> Array:
    """The column (N,) as floats. Raises InputError for texts."""
    if column.dtype.kind not in "fib":
        raise InputError(f"the map cannot show '{name}', which is no number; choose another column")
    return column.astype(np.float64)


def _draw(maps: Maps, x: Cut, y: Cut, panels: Cut, means: list[Array]) -> Figure:
    """The figure of these means, one array (cells of y, cells of x) for each panel, with one scale of colour.

    Shares are drawn from 0 to 1, other results from the least to the largest mean. At most four
    panels in a row.
    """
    share = maps.value in SHARES
    shown = np.concatenate([m[np.isfinite(m)] for m in means])
    low, high = (0.0, 1.0) if share or not len(shown) else (float(shown.min()), float(shown.max()))
    columns = min(len(means), 4)
    rows = -(-len(means) // columns)
    with style():
        width = 1.6 + columns * (1.0 + 0.3 * min(max(len(x.texts), 5), 20))
        figure = new_figure(width, 0.8 + rows * (1.2 + 0.22 * min(max(len(y.texts), 5), 20)))
        grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
        for k, axes in enumerate(grid.flat):
            if k >= len(means):
                axes.set_axis_off()
                continue
            title = f"{maps.panel} = {panels.texts[k]}" if maps.panel else ""
            image = _panel(axes, means[k], (low, high), share)
            _axes(axes, x, y)
            bottom, left = k + columns >= len(means), k % columns == 0
            label(
                axes, maps.name(maps.x) if bottom else "", maps.name(maps.y) if left else "", title
            )
            axes.tick_params(labelbottom=bottom)
        text = SHARES.get(maps.value, f"mean of {maps.name(maps.value)}")
        figure.colorbar(image, ax=grid, label=text, shrink=0.9)
        return figure


def _panel(axes: Axes, means: Array, limits: tuple[float, float], share: bool) -> QuadMesh:
    """Draw one panel: grey where there is no number, the numbers themselves where they fit."""
    axes.set_facecolor("#DDDDDD")
    kind = "cividis" if share else "viridis"
    low, high = limits
    image = axes.pcolormesh(means, cmap=kind, vmin=low, vmax=high, ec="white", lw=0.3)
    if means.size <= WRITTEN:
        middle = (low + high) / 2
        for (j, i), value in np.ndenumerate(means):
            if np.isfinite(value):
                colour = "white" if value < middle else "black"
                at = (i + 0.5, j + 0.5)
                axes.annotate(f"{value:.2g}", at, ha="center", va="center", color=colour, size=6)
    axes.grid(False)
    return image


def _axes(axes: Axes, x: Cut, y: Cut) -> None:
    """Label the cells of both axes, at most twelve or so of each."""
    for set_ticks, cells, rotation in ((axes.set_xticks, x, 45), (axes.set_yticks, y, 0)):
        step = -(-len(cells.texts) // 12)
        places = range(0, len(cells.texts), step)
        set_ticks([k + 0.5 for k in places], [cells.texts[k] for k in places], rotation=rotation)
