"""Numbers of the goal on RABBIT's hardware, from the rows of walks: shares, medians, quantiles, ratios.

A walk of an ADRC that is not legal counts as infinite beside a rival's; a rival's counts with its number even
where it is not legal, so that no ratio is flattered. Intervals are those of `analysis.statistics`, of 95 %,
with walks paired by seed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from biped_adrc.analysis.statistics import over_seeds, share
from biped_adrc.bench.cell import is_legal, is_made, number
from biped_adrc.campaign.chunk import Row
from biped_adrc.types import Array

SHARE = 292.0 / 300.0
"""Of the walks that have to be legal: the friction that they need is this quantile over walks."""
Span = Sequence[tuple[float, float]]
"""Lower and upper end of the largest push of each seed [N m]."""


def of_walks(rows: Sequence[Row]) -> dict[str, Any]:
    """error [rad], torque [N m], cost of transport: medians; legal, made: shares; friction: quantile."""
    x = {name: column(rows, name) for name in ("rms_error", "rms_torque", "cost_of_transport")}
    legal, made = sum(map(is_legal, rows)), sum(map(is_made, rows))
    return {
        "walks": len(rows),
        "error": float(np.median(x["rms_error"])),
        "torque": float(np.median(x["rms_torque"])),
        "cost": float(np.median(x["cost_of_transport"])),
        "legal": share(legal, len(rows)),
        "made": share(made, len(rows)),
        "friction": float(needed(column(rows, "mean_friction")[None, :])[0]),
        "median_friction": float(np.median(column(rows, "mean_friction"))),
    }


def column(rows: Sequence[Row], name: str) -> Array:
    """A number of each walk (N,), infinite where it has none or did not make all steps."""
    found = [number(row, name) if is_made(row) else None for row in rows]
    return np.array([math.inf if x is None else x for x in found])


def needed(x: Array) -> Array:
    """The friction with which `SHARE` of the walks are within it, of each set of walks (B, N), as (B,)."""
    return np.sort(x, axis=1)[:, math.ceil(SHARE * x.shape[1]) - 1]


def beside(
    rows: Sequence[Row], rival: Sequence[Row], rivals: Sequence[Sequence[Row]]
) -> dict[str, Any]:
    """Ratios to the rival's walks of the same seeds, each with its interval.

    ratio: median of the ratios of rms errors. ratio_each: the same to the better of all rivals, walk by walk.
    cost: median of the ratios of costs of transport. friction: ratio of the friction that is `needed`.
    """
    legal = np.array([is_legal(row) for row in rows])

    def ratio(name: str, other: Array) -> Array:
        mine = np.where(legal, column(rows, name), np.inf)
        return np.where(np.isfinite(other), mine / other, np.where(legal, 0.0, np.inf))

    better = np.min([column(each, "rms_error") for each in rivals], axis=0)
    friction = np.array([column(some, "mean_friction") for some in (rows, rival)])
    return {
        "ratio": median(ratio("rms_error", column(rival, "rms_error"))),
        "ratio_each": median(ratio("rms_error", better)),
        "cost_ratio": median(ratio("cost_of_transport", column(rival, "cost_of_transport"))),
        "friction_ratio": over_seeds(friction, _of_halves(needed)),
    }


def median(x: Array) -> tuple[float, float, float]:
    """Median of (N,) with its interval."""
    return over_seeds(x[None, :], lambda sets: np.median(sets, axis=1))


def _of_halves(statistic: Callable[[Array], Array]) -> Callable[[Array], Array]:
    """The ratio of a statistic of the first half of each set of walks to that of its second half."""
    return lambda sets: np.divide(*(statistic(half) for half in np.split(sets, 2, axis=1)))


def pushes_beside(mine: Span, rival: Span) -> dict[str, Any]:
    """Bounds of the median largest push [N m], and of the median ratio to the rival's by seed.

    The interval of the ratio is that of its lower ends, by which a push is larger for certain: the lower end of
    its largest push over the upper end of the rival's.
    """
    low, high = (np.array(x) for x in zip(*mine, strict=True))
    of_rival = np.array([b for _, b in rival])
    ratio = np.where(
        np.isfinite(of_rival) & (of_rival > 0.0), low / np.maximum(of_rival, 1e-9), 1.0
    )
    return {"median": [float(np.median(low)), float(np.median(high))], "ratio": median(ratio)}


def plain(x: Any) -> Any:
    """Nested values for JSON, which has no infinity: the text "inf" in its place."""
    if isinstance(x, dict):
        return {key: plain(value) for key, value in x.items()}
    if isinstance(x, list | tuple):
        return [plain(value) for value in x]
    return "inf" if isinstance(x, float) and x == math.inf else x
