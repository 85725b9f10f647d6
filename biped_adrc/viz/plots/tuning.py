"""Figures of `biped-adrc tune`: the path of the search, the front of two objectives, which variable decides.

They are drawn from the summary's plain values (`tuning.page.summary`), so that they can be drawn anew from
summary.json. A candidate whose objective is infinite has no mark.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from biped_adrc.types import PlainRecord
from biped_adrc.viz.style import GREY, PALETTE, label, literal, new_figure, style

PUBLISHED: dict[str, Any] = {
    "marker": "D",
    "color": "black",
    "ls": "none",
    "ms": 6.0,
    "label": "as published",
}
"""The mark of the as-published setting."""


def tuning_figures(told: PlainRecord) -> dict[str, Figure]:
    """The figures of a summary by name: "path", "front" for two objectives or more, "importances"."""
    found = {"path": path_figure(told)}
    if len(told["objectives"]) > 1:
        found["front"] = front_figure(told)
    if told["importances"]:
        found["importances"] = importance_figure(told["importances"])
    return found


def path_figure(told: PlainRecord) -> Figure:
    """The first objective over the number of the candidate, and the best feasible one so far as a line."""
    of = told["objectives"][0]
    walked = [c for c in told["candidates"] if c["walked"]]
    with style():
        figure = new_figure(7.0, 3.2)
        axes = figure.subplots()
        searched = [c for c in walked if c["number"] > 0]
        _candidates(axes, searched, lambda c: (c["number"], _number(c["objectives"][0])))
        axes.plot([0], [_number(walked[0]["objectives"][0])], **PUBLISHED)
        best = _best_so_far(walked, of["goal"] == "minimise")
        axes.step(
            [n for n, _ in best],
            [x for _, x in best],
            where="post",
            color=PALETTE[1],
            label="best so far",
        )
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        label(axes, "candidate", literal(of["words"]))
        axes.legend()
        return figure


def front_figure(told: PlainRecord) -> Figure:
    """The first two objectives of all walked candidates against each other, and the front as a line."""
    names = [literal(of["words"]) for of in told["objectives"][:2]]
    walked = [c for c in told["candidates"] if c["walked"]]
    by_number = {c["number"]: c for c in walked}
    with style():
        figure = new_figure(5.5, 4.2)
        axes = figure.subplots()
        _candidates(axes, walked, lambda c: tuple(map(_number, c["objectives"][:2])))
        line = sorted([_number(x) for x in by_number[n]["objectives"][:2]] for n in told["front"])
        axes.plot([x for x, _ in line], [y for _, y in line], color=PALETTE[1], label="front")
        axes.plot(*([_number(x)] for x in walked[0]["objectives"][:2]), **PUBLISHED)
        label(axes, *names)
        axes.legend()
        return figure


def importance_figure(shares: dict[str, float]) -> Figure:
    """How much each variable decides whether a candidate is among the best, a bar for each."""
    names = sorted(shares, key=lambda name: shares[name])
    with style():
        figure = new_figure(6.0, 0.9 + 0.28 * len(names))
        axes = figure.subplots()
        axes.barh(
            [literal(name) for name in names], [shares[name] for name in names], color=PALETTE[0]
        )
        axes.set_xlim(0.0, 1.0)
        label(axes, "share of what decides", "")
        return figure


def _candidates(
    axes: Axes, walked: Sequence[PlainRecord], point: Callable[[PlainRecord], tuple[float, ...]]
) -> None:
    """Draw candidates at their points (x, y), one mark for those that keep all limits, another for the rest."""
    for feasible, words, mark, color in (
        (True, "keeps all limits", "o", PALETTE[0]),
        (False, "misses a limit", "x", GREY),
    ):
        x, y = np.array([point(c) for c in walked if c["feasible"] is feasible]).reshape(-1, 2).T
        axes.plot(x, y, mark, color=color, ms=4.0, ls="none", label=words)


def _best_so_far(walked: Sequence[PlainRecord], less: bool) -> list[tuple[int, float]]:
    """Number of the candidate and best feasible objective so far, from the first feasible one on."""
    found: list[tuple[int, float]] = []
    for c in walked:
        x = _number(c["objectives"][0])
        if c["feasible"] and math.isfinite(x):
            last = found[-1][1] if found else x
            found.append((c["number"], min(last, x) if less else max(last, x)))
    return found


def _number(x: float | str) -> float:
    """A number of the summary, NaN for what is not finite and so has no mark."""
    return float(x) if not isinstance(x, str) else math.nan
