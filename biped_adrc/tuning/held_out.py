"""What the chosen setting is worth on walks that no choice has touched, beside the as-published one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.statistics import Interval, over_seeds, share
from biped_adrc.tuning.measure import Measure, Walks
from biped_adrc.tuning.study import TuningStudy
from biped_adrc.types import Array

SHARES = ("survived", "feasible", "but_impact")
"""Columns of zeros and ones, whose mean is a share with Wilson's interval."""


class HeldOut(NamedTuple):
    """One measure on the test set, with 95 % intervals over seeds."""

    words: str
    """Of the measure."""
    chosen: Interval
    """Of the chosen setting."""
    published: Interval
    """Of the as-published setting."""
    ratio: Interval | None
    """Of the first to the second, walks paired by seed; None where the second is not positive and finite."""


def held_out(
    study: TuningStudy,
    chosen: tuple[Walks, Mapping[str, float | None]],
    published: tuple[Walks, Mapping[str, float | None]],
) -> tuple[HeldOut, ...]:
    """Each measure on the test set. chosen, published: walks, and columns that need no walk, by name."""
    seeds = len(study.test.seeds)
    return tuple(_measured(m, chosen, published, seeds) for m in study.measures)


def _measured(
    m: Measure,
    chosen: tuple[Walks, Mapping[str, float | None]],
    published: tuple[Walks, Mapping[str, float | None]],
    seeds: int,
) -> HeldOut:
    if m.column in chosen[1]:
        a, b = (m.measured(*x) for x in (chosen, published))
        ratio = Interval(a / b, a / b, a / b) if 0.0 < b < np.inf else None
        return HeldOut(m.words, Interval(a, a, a), Interval(b, b, b), ratio)
    x, y = (m.numbers(walks).reshape(-1, seeds) for walks, _ in (chosen, published))
    return HeldOut(m.words, _interval(m, x), _interval(m, y), _ratio(m, x, y))


def _interval(m: Measure, x: Array) -> Interval:
    """A measure of walks (conditions, seeds) with its interval."""
    if m.column in SHARES and m.over == "mean":
        return share(int(x.sum()), x.size)
    return over_seeds(x, m.of_each)


def _ratio(m: Measure, x: Array, y: Array) -> Interval | None:
    """The ratio of a measure of two settings on the same walks; None where it has no meaning."""
    both = np.concatenate([x, y])

    def ratio(sets: Array) -> Array:
        halves = np.split(sets, 2, axis=1)
        return m.of_each(halves[0]) / m.of_each(halves[1])

    if not 0.0 < m.of(y.ravel()) < np.inf:
        return None
    with np.errstate(divide="ignore", invalid="ignore"):
        found = over_seeds(both, ratio)
    return None if np.isnan(found).any() else found
