"""Figures of `biped-adrc compare`: whose walks are feasible under what, and at what error.

They are drawn from the summary's plain values, the rows of `bench.cell.Cell`, so they can be drawn anew
from summary.json. Shares and medians
come as [value, low, high] with an interval of 95 %.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.container import ErrorbarContainer
from matplotlib.figure import Figure

from biped_adrc.errors import InputError
from biped_adrc.types import PlainRecord
from biped_adrc.viz.style import PALETTE, label, named_cells, new_figure, style

MARKERS = ("o", "s", "D", "^", "v", "P", "X", "*")
"""Marks by controller."""
GREYS = LinearSegmentedColormap.from_list("feasible", ["0.62", "1.0"])
"""White where all walks are feasible, grey where none is."""


def feasible_figure(cells: Sequence[PlainRecord]) -> Figure:
    """A table in cells: the share of walks that are feasible, and below it, smaller, those that are but for the
    impact, and those with all steps made.

    cells: for each controller and condition "controller", "condition", "feasible", "but_impact" and
    "survived" [share, low, high]. The figure has a row for each condition and a column for each controller;
    white is feasible, grey is not. A pair that is not among the cells stays empty. Raises InputError
    without cells.
    """
    rows, columns = _names(cells, "condition"), _names(cells, "controller")
    with style():
        figure = new_figure(1.9 + 0.95 * len(columns), 0.9 + 0.46 * len(rows))
        axes = figure.subplots()
        shares = np.full((len(rows), len(columns)), np.nan)
        for cell in cells:
            x, y = columns.index(cell["controller"]), rows.index(cell["condition"])
            value, low, high = cell["feasible"]
            shares[y, x] = value
            span = f"{100 * low:.0f} to {100 * high:.0f}"
            but_impact, made = (100 * cell[kind][0] for kind in ("but_impact", "survived"))
            others = f"but impact: {but_impact:.0f} %, all steps: {made:.0f} %"
            for text, down, size in (
                (f"{100 * value:.0f} %", -0.22, 9.0),
                (span, 0.1, 6.0),
                (others, 0.34, 4.5),
            ):
                axes.text(x, y + down, text, ha="center", va="center", fontsize=size, color="black")
        edges = [np.arange(len(names) + 1) - 0.5 for names in (columns, rows)]
        axes.pcolormesh(*edges, shares, cmap=GREYS, vmin=0.0, vmax=1.0, ec="black", lw=0.4)
        named_cells(axes, rows, columns, 20)
        label(
            axes,
            "",
            "",
            "walks that are feasible, 95 % intervals;\nbelow, feasible but for the impact, and all steps made",
        )
        return figure


def measure_figure(cells: Sequence[PlainRecord], measure: str, title: str) -> Figure:
    """Medians of one measure with their intervals: a row for each condition, a mark for each controller.

    cells: as in `feasible_figure`, with `measure` [median, low, high] over walks that are feasible, the impact
    at most aside, or None, and the same in "made" over walks that make all steps, drawn hollow where none is. A
    controller that never makes all steps has no mark. measure: one of `comparison_text.MEASURES`.
    title: label of the axis, with its unit. Errors and costs of transport have a logarithmic scale.

    Raises InputError without cells.
    """
    rows, columns = _names(cells, "condition"), _names(cells, "controller")
    with style():
        figure = new_figure(7.0, 1.2 + 0.36 * len(rows))
        axes = figure.subplots()
        offsets = np.linspace(-0.32, 0.32, len(columns)) if len(columns) > 1 else [0.0]
        shown = []
        for i, name in enumerate(columns):
            for kind in ("feasible", "made"):
                here = [
                    (rows.index(c["condition"]) + offsets[i], found)
                    for c in cells
                    if c["controller"] == name and (found := _shown(c, measure, kind)) is not None
                ]
                if kind == "feasible":
                    shown.append(_marks(axes, here, i, name, filled=True))
                elif here:
                    _marks(axes, here, i, f"{name}, not feasible", filled=False)
        if measure in ("rms_error", "peak_error", "cost_of_transport"):
            axes.set_xscale("log")
        axes.set_yticks(range(len(rows)), rows)
        axes.set_ylim(len(rows) - 0.5, -0.5)
        label(axes, title, "", "")
        figure.legend(handles=shown, loc="outside lower center", ncols=min(len(columns), 5))
        return figure


def _shown(cell: PlainRecord, measure: str, kind: str) -> Sequence[float] | None:
    """[median, low, high] of the walks that count, or, for kind "made", of all that make their steps where
    none counts.
    """
    if kind == "feasible":
        return cell[measure]
    return cell["made"][measure] if cell[measure] is None else None


def _marks(
    axes: Axes,
    here: Sequence[tuple[float, Sequence[float]]],
    i: int,
    name: str,
    filled: bool,
) -> ErrorbarContainer:
    """Draw the marks of controller i at pairs of a height and [value, low, high]; filled for what counts."""
    found = np.array([x for _, x in here]).reshape(-1, 3)
    return axes.errorbar(
        found[:, 0],
        [y for y, _ in here],
        xerr=np.maximum([found[:, 0] - found[:, 1], found[:, 2] - found[:, 0]], 0.0),
        fmt=MARKERS[i % len(MARKERS)],
        ms=4,
        lw=1.0,
        mfc=PALETTE[i % len(PALETTE)] if filled else "white",
        color=PALETTE[i % len(PALETTE)],
        label=name,
    )


def _names(rows: Sequence[PlainRecord], key: str) -> list[str]:
    """The different values of `key` in order of appearance. Raises InputError without rows."""
    if not rows:
        raise InputError("the comparison has no cells to draw; expected at least one")
    return list(dict.fromkeys(row[key] for row in rows))
