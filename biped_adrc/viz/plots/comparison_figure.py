"""Figures of `biped-adrc compare`: who walks legally under what, at what error, and the largest pushes.

They are drawn from the summary's plain values (the rows of `bench.cell.Cell` and
`bench.largest_push`), so the documentation can draw them anew from summary.json. Shares and medians
come as [value, low, high] with an interval of 95 %.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import cycle

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.container import ErrorbarContainer
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from biped_adrc.errors import InputError
from biped_adrc.types import Array, PlainRecord
from biped_adrc.viz.style import PALETTE, label, named_cells, new_figure, style

MARKERS = ("o", "s", "D", "^", "v", "P", "X", "*")
"""Marks by controller."""
GREYS = LinearSegmentedColormap.from_list("legal", ["0.62", "1.0"])
"""White where all walks are legal, grey where none is."""
KINDS = {"survived": "all steps", "legal": "legal"}
"""The two answers about a largest push and their words: with all steps made, and walked legally."""


def legal_figure(cells: Sequence[PlainRecord]) -> Figure:
    """A table in cells: the share of walks that are legal, and below it, smaller, that of walks with
    all steps made.

    cells: for each controller and condition "controller", "condition", "legal" and "survived"
    [share, low, high]. The figure has a row for each condition and a column for each controller;
    white is legal, grey is not. A pair that is not among the cells stays empty. Raises InputError
    without cells.
    """
    rows, columns = _names(cells, "condition"), _names(cells, "controller")
    with style():
        figure = new_figure(1.9 + 0.95 * len(columns), 0.9 + 0.46 * len(rows))
        axes = figure.subplots()
        shares = np.full((len(rows), len(columns)), np.nan)
        for cell in cells:
            x, y = columns.index(cell["controller"]), rows.index(cell["condition"])
            value, low, high = cell["legal"]
            shares[y, x] = value
            span = f"{100 * low:.0f} to {100 * high:.0f}"
            made = f"all steps: {100 * cell['survived'][0]:.0f} %"
            for text, down, size in (
                (f"{100 * value:.0f} %", -0.22, 9.0),
                (span, 0.1, 6.0),
                (made, 0.34, 5.5),
            ):
                axes.text(x, y + down, text, ha="center", va="center", fontsize=size, color="black")
        edges = [np.arange(len(names) + 1) - 0.5 for names in (columns, rows)]
        axes.pcolormesh(*edges, shares, cmap=GREYS, vmin=0.0, vmax=1.0, ec="black", lw=0.4)
        named_cells(axes, rows, columns, 20)
        label(
            axes, "", "", "walks that are legal, 95 % intervals;\nbelow, those that make all steps"
        )
        return figure


def measure_figure(cells: Sequence[PlainRecord], measure: str, title: str) -> Figure:
    """Medians of one measure with their intervals: a row for each condition, a mark for each controller.

    cells: as in `legal_figure`, with `measure` [median, low, high] over legal walks or None, and
    the same in "made" over walks that make all steps, drawn hollow where no walk is legal. A
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
            for kind in ("legal", "made"):
                here = [
                    (rows.index(c["condition"]) + offsets[i], found)
                    for c in cells
                    if c["controller"] == name and (found := _shown(c, measure, kind)) is not None
                ]
                if kind == "legal":
                    shown.append(_marks(axes, here, i, name, filled=True))
                elif here:
                    _marks(axes, here, i, f"{name}, not legal", filled=False)
        if measure in ("rms_error", "peak_error", "cost_of_transport"):
            axes.set_xscale("log")
        axes.set_yticks(range(len(rows)), rows)
        axes.set_ylim(len(rows) - 0.5, -0.5)
        label(axes, title, "", "")
        figure.legend(handles=shown, loc="outside lower center", ncols=min(len(columns), 5))
        return figure


def _shown(cell: PlainRecord, measure: str, kind: str) -> Sequence[float] | None:
    """[median, low, high] of the legal walks, or, for kind "made", of all that make their steps where
    none is legal.
    """
    if kind == "legal":
        return cell[measure]
    return cell["made"][measure] if cell[measure] is None else None


def _marks(
    axes: Axes,
    here: Sequence[tuple[float, Sequence[float]]],
    i: int,
    name: str,
    filled: bool,
) -> ErrorbarContainer:
    """Draw the marks of controller i at pairs of a height and [value, low, high]; filled for legal walks."""
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


def push_figure(pushes: Sequence[PlainRecord]) -> Figure:
    """The largest push [N m] walked legally (filled) and with all steps made (hollow), a panel for each phase.

    pushes: "controller", "direction" (joints), "phase", and in "legal" and "survived" the "median"
    and the "seeds", each [low, high] [N m] with None for "at least". Thin lines span the seeds of
    legal walks, an arrow means that even the largest push tried was passed. Raises InputError
    without pushes.
    """
    directions, columns = _names(pushes, "direction"), _names(pushes, "controller")
    phases = list(dict.fromkeys(p["phase"] for p in pushes))
    with style():
        figure = new_figure(2.6 * len(phases) + 0.8, 1.3 + 0.16 * len(directions) * len(columns))
        panels = figure.subplots(1, len(phases), sharey=True, sharex=True, squeeze=False)[0]
        for axes, phase in zip(panels, phases, strict=True):
            for i, name in enumerate(columns):
                here = [p for p in pushes if (p["phase"], p["controller"]) == (phase, name)]
                own = -0.4 + 0.8 * (i + 0.5) / len(columns)
                _pushes(axes, here, [directions.index(p["direction"]) + own for p in here], i)
            for k in range(1, len(directions)):
                axes.axhline(k - 0.5, color="#bbbbbb", lw=0.6)
            axes.set_yticks(range(len(directions)), directions)
            axes.set_ylim(len(directions) - 0.5, -0.5)
            axes.set_xlim(0.0, 1.12 * _farthest(pushes))
            label(axes, "largest push [N m]", "", f"{phase} in the step")
        handles = [
            Line2D([], [], ls="", marker=marker, color=colour, label=name)
            for name, marker, colour in zip(columns, cycle(MARKERS), cycle(PALETTE), strict=False)
        ]
        figure.legend(handles=handles, loc="outside lower center", ncols=min(len(columns), 5))
        return figure


def _farthest(pushes: Sequence[PlainRecord]) -> float:
    """The largest push that is drawn [N m], at least 1."""
    ends = [
        x for p in pushes for k in ("legal", "survived") for x in p[k]["median"] + p[k]["seeds"]
    ]
    return max(1.0, *(float(x) for x in ends if x is not None))


def _pushes(axes: Axes, pushes: Sequence[PlainRecord], heights: list[float], i: int) -> None:
    """Draw the pushes of controller i at these heights: a mark at what is reached at least, with an
    arrow to the right where the largest push tried was passed, so that no more is known.
    """
    colour, marker = PALETTE[i % len(PALETTE)], MARKERS[i % len(MARKERS)]
    for kind, face in (("survived", "white"), ("legal", colour)):
        least = np.array([p[kind]["median"][0] for p in pushes], dtype=float)
        axes.errorbar(
            least,
            heights,
            xerr=_over_seeds(pushes, least) if kind == "legal" and pushes else None,
            fmt=marker,
            ms=3.5,
            mfc=face,
            mec=colour,
            mew=0.8,
            ecolor=colour,
            elinewidth=1.2,
            label=f"{pushes[0]['controller']}, {KINDS[kind]}" if pushes else "_",
        )
        for p, x, y in zip(pushes, least, heights, strict=True):
            if p[kind]["median"][1] is None:
                arrow = {"arrowstyle": "->", "color": colour, "lw": 0.8}
                axes.annotate("", (x * 1.09, y), (x, y), arrowprops=arrow)


def _over_seeds(pushes: Sequence[PlainRecord], least: Array) -> Array:
    """How far the seeds of legal walks go below and above the marks (N,): (2, N) [N m]; open above: 0."""
    low, high = zip(*(p["legal"]["seeds"] for p in pushes), strict=True)
    known = np.array([x if h is None else h for x, h in zip(least, high, strict=True)], dtype=float)
    return np.maximum([least - np.array(low, dtype=float), known - least], 0.0)


def _names(rows: Sequence[PlainRecord], key: str) -> list[str]:
    """The different values of `key` in order of appearance. Raises InputError without rows."""
    if not rows:
        raise InputError("the comparison has no cells to draw; expected at least one")
    return list(dict.fromkeys(row[key] for row in rows))
