"""Figures of a comparison: who survives what, at what error, and the largest push of each kind."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from biped_adrc.errors import InputError
from biped_adrc.viz.style import PALETTE, label, new_figure, style

MARKERS = ("o", "s", "D", "^", "v", "P", "X", "*")


def survival_figure(cells: Sequence[Mapping[str, Any]]) -> Figure:
    """Share of walks that survive, as text and shade; a row per condition, a column per controller.

    cells: "controller", "condition", "survived" [share, low, high]. Raises InputError without cells.
    """
    rows, columns = _names(cells, "condition"), _names(cells, "controller")
    with style():
        figure = new_figure(1.9 + 0.95 * len(columns), 0.9 + 0.32 * len(rows))
        axes = figure.subplots()
        for cell in cells:
            x, y = columns.index(cell["controller"]), rows.index(cell["condition"])
            value, low, high = cell["survived"]
            axes.add_patch(_box(x, y, value))
            ink = "black"
            axes.text(x, y - 0.12, f"{100 * value:.0f} %", ha="center", va="center", color=ink)
            span = f"{100 * low:.0f} to {100 * high:.0f}"
            axes.text(x, y + 0.24, span, ha="center", va="center", fontsize=6.0, color=ink)
        _grid(axes, rows, columns)
        label(axes, "", "", "walks that make all steps, with 95 % intervals")
        return figure


def _box(x: int, y: int, value: float) -> Rectangle:
    """White where all survive, grey where none does."""
    grey = str(round(1.0 - 0.38 * (1.0 - value), 3))
    return Rectangle((x - 0.5, y - 0.5), 1, 1, fc=grey, ec="black", lw=0.4)


def measure_figure(cells: Sequence[Mapping[str, Any]], measure: str, title: str) -> Figure:
    """Medians of one measure with their intervals, a row per condition, a mark per controller.

    cells: as in `survival_figure`, with `measure` [median, low, high] or None.
    """
    rows, columns = _names(cells, "condition"), _names(cells, "controller")
    with style():
        figure = new_figure(7.0, 1.2 + 0.36 * len(rows))
        axes = figure.subplots()
        offsets = np.linspace(-0.32, 0.32, len(columns)) if len(columns) > 1 else [0.0]
        for i, name in enumerate(columns):
            here = [c for c in cells if c["controller"] == name and c[measure] is not None]
            value = np.array([c[measure][0] for c in here])
            low, high = (np.array([c[measure][k] for c in here]) for k in (1, 2))
            y = np.array([rows.index(c["condition"]) for c in here]) + offsets[i]
            axes.errorbar(
                value,
                y,
                xerr=[np.maximum(value - low, 0.0), np.maximum(high - value, 0.0)],
                fmt=MARKERS[i % len(MARKERS)],
                ms=4,
                lw=1.0,
                color=PALETTE[i % len(PALETTE)],
                label=name,
            )
        if measure in ("peak_error", "cost_of_transport"):
            axes.set_xscale("log")
        axes.set_yticks(range(len(rows)), rows)
        axes.set_ylim(len(rows) - 0.5, -0.5)
        label(axes, title, "", "")
        figure.legend(loc="outside lower center", ncols=min(len(columns), 5))
        return figure


def push_figure(pushes: Sequence[Mapping[str, Any]]) -> Figure:
    """The largest push survived, a panel per phase of the step, bars by direction and controller.

    pushes: "controller", "direction", "phase", "push" [median, low, high] [N m], "beyond".
    """
    directions, columns = _names(pushes, "direction"), _names(pushes, "controller")
    phases = list(dict.fromkeys(p["phase"] for p in pushes))
    with style():
        figure = new_figure(2.6 * len(phases) + 0.8, 1.3 + 0.42 * len(directions))
        panels = figure.subplots(1, len(phases), sharey=True, sharex=True, squeeze=False)[0]
        height = 0.8 / len(columns)
        for axes, phase in zip(panels, phases, strict=True):
            for i, name in enumerate(columns):
                here = [p for p in pushes if p["phase"] == phase and p["controller"] == name]
                y = np.array([directions.index(p["direction"]) for p in here])
                value, low, high = (np.array([p["push"][k] for p in here]) for k in range(3))
                axes.barh(
                    y - 0.4 + (i + 0.5) * height,
                    value,
                    height,
                    xerr=[np.maximum(value - low, 0.0), np.maximum(high - value, 0.0)],
                    color=PALETTE[i % len(PALETTE)],
                    error_kw={"lw": 0.7},
                    label=name if axes is panels[0] else None,
                )
            axes.set_yticks(range(len(directions)), directions)
            axes.set_ylim(len(directions) - 0.5, -0.5)
            label(axes, "largest push survived [N m]", "", f"{phase} in the step")
        figure.legend(loc="outside lower center", ncols=min(len(columns), 5))
        return figure


def _names(rows: Sequence[Mapping[str, Any]], key: str) -> list[str]:
    if not rows:
        raise InputError("the comparison has no cells to draw; expected at least one")
    return list(dict.fromkeys(row[key] for row in rows))


def _grid(axes: Axes, rows: list[str], columns: list[str]) -> None:
    axes.set_xlim(-0.5, len(columns) - 0.5)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.set_xticks(range(len(columns)), columns, rotation=20, ha="right")
    axes.set_yticks(range(len(rows)), rows)
    axes.grid(False)
