"""The figures of docs/tuned.md, a panel for each place and gait, drawn from the searches."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from tuned_entries import Entry, group
from tuned_questions import Group, against_reference, answered
from tuned_text import MRAD, NEVER, middle

from biped_adrc.analysis.statistics import Interval
from biped_adrc.viz.style import GREY, PALETTE, label, new_figure, style

MARKERS = "osD^"
"""Marks by series."""
ACROSS = 2
"""Panels beside each other."""
Marks = Mapping[str, Interval]
"""A number with its interval by contestant."""


def drawn(found: Sequence[Entry]) -> dict[str, Figure]:
    """The figures by name: "ratios" and "errors"."""
    return {"ratios": ratios_figure(found), "errors": errors_figure(found)}


def ratios_figure(found: Sequence[Entry]) -> Figure:
    """Ratios of errors to the better of NPD and NPID, for each seed of the optimiser."""
    seeds = sorted({e.seed for e in found})
    panels: dict[str, dict[str, Marks]] = {}
    for place, gait in dict.fromkeys((e.place, e.gait) for e in found):
        series = {f"optimiser seed {s}": _ratios(group(found, place, gait, s)) for s in seeds}
        if shown := {name: marks for name, marks in series.items() if marks}:
            panels[f"{place}, gait {gait}"] = shown
    return _panels(panels, "ratio of rms errors [1]", beside=1.0)


def _ratios(g: Group) -> Marks:
    return {x.a.contestant: x.ratio for x in answered(against_reference([g]))}


def errors_figure(found: Sequence[Entry]) -> Figure:
    """Median errors, tuned and of the first setting, of the first seed of the optimiser."""
    first = min((e.seed for e in found), default=0)
    panels: dict[str, dict[str, Marks]] = {}
    for e in found:
        if e.seed != first:
            continue
        panel = panels.setdefault(f"{e.place}, gait {e.gait}", {"first setting": {}, "tuned": {}})
        for name, walks in (("first setting", e.published), ("tuned", e.tuned)):
            if walks is not None:
                x = Interval(*(MRAD * y for y in middle(walks.rms_error)))
                panel[name] = {**panel[name], e.contestant: x}
    return _panels(panels, "rms error [mrad]")


def _panels(
    panels: Mapping[str, Mapping[str, Marks]], quantity: str, beside: float | None = None
) -> Figure:
    """A panel for each title, with marks for each series and contestants from the top down."""
    down = max(1, -(-len(panels) // ACROSS))
    with style():
        figure = new_figure(9.0, 0.6 + 2.5 * down)
        grid = figure.subplots(down, ACROSS, squeeze=False).ravel()
        for axes in grid[len(panels) :]:
            axes.set_axis_off()
        for axes, (title, series) in zip(grid, panels.items(), strict=False):
            longest = sorted(series.values(), key=len, reverse=True)
            names = list(dict.fromkeys(name for marks in longest for name in marks))
            axes.set_xscale("log")
            for i, (words, marks) in enumerate(series.items()):
                _draw(axes, i, len(series), words, [marks.get(name) for name in names])
            axes.set_xlim(*_span(series.values()))
            axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
            axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
            axes.xaxis.set_minor_formatter(NullFormatter())
            if beside is not None:
                axes.axvline(beside, color=GREY, lw=0.8)
            axes.set_yticks(range(len(names)), names)
            axes.set_ylim(max(len(names), 1) - 0.5, -0.5)
            label(axes, quantity, "", title)
        _legend(figure)
        return figure


def _legend(figure: Figure) -> None:
    """One legend below all panels."""
    known = {}
    for axes in figure.axes:
        handles, names = axes.get_legend_handles_labels()
        known |= dict(zip(names, handles, strict=True))
    if known:
        figure.legend(known.values(), known.keys(), loc="outside lower center", ncols=len(known))


def _span(series: Iterable[Marks]) -> tuple[float, float]:
    """From where to where the axis goes, so that all that is finite is seen."""
    x = np.array([y for marks in series for m in marks.values() for y in m])
    x = x[(x > 1.0 / NEVER) & (x < NEVER)]
    return (float(x.min()) / 1.3, float(x.max()) * 1.3) if len(x) else (0.5, 2.0)


def _draw(axes: Axes, i: int, count: int, words: str, marks: Sequence[Interval | None]) -> None:
    """The marks of the i-th of `count` series, slightly apart; None and what is infinite has none."""
    shown = [(k, m) for k, m in enumerate(marks) if m is not None and 1.0 / NEVER < m.value < NEVER]
    if not shown:
        return
    at = np.array([k for k, _ in shown]) + 0.22 * (i - 0.5 * (count - 1))
    x = np.clip(np.array([m for _, m in shown]), 1.0 / NEVER, NEVER)
    widths = np.abs(x[:, 1:] - x[:, :1]).T
    color, mark = PALETTE[i], MARKERS[i % len(MARKERS)]
    axes.errorbar(x[:, 0], at, xerr=widths, fmt=mark, color=color, ms=4.0, lw=1.0, label=words)
