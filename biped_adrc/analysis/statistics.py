"""Statistics over many walks: shares and medians, each with an interval of 95 %.

Shares have Wilson's interval (J. Am. Stat. Assoc. 22, 1927), medians the percentile bootstrap
(Efron, 1979) with a fixed seed. The comparison in `bench` and the tuning call this module.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from scipy import stats

from biped_adrc.types import Array

CONFIDENCE = 0.95
"""Of every interval."""
RESAMPLES = 2000
"""Number of bootstrap samples of a median."""


class Interval(NamedTuple):
    """Point estimate with its 95 % confidence interval."""

    value: float
    low: float
    high: float


def share(successes: int, count: int) -> Interval:
    """Share of `successes` among `count` walks, at least one, with Wilson's interval."""
    found = stats.binomtest(successes, count).proportion_ci(CONFIDENCE, method="wilson")
    return Interval(successes / count, float(found.low), float(found.high))


def median(values: Sequence[float | None]) -> Interval | None:
    """Median of the values that are finite numbers, with its interval; None if there are none."""
    x = np.array([v for v in values if v is not None and math.isfinite(v)])
    if len(x) == 0:
        return None
    random = np.random.default_rng(0)
    draws = np.median(x[random.integers(0, len(x), (RESAMPLES, len(x)))], axis=1)
    low, high = np.quantile(draws, [0.5 - CONFIDENCE / 2, 0.5 + CONFIDENCE / 2])
    return Interval(float(np.median(x)), float(low), float(high))


def over_seeds(x: Array, statistic: Callable[[Array], Array]) -> Interval:
    """A statistic of walks with its bootstrap interval; seeds are drawn, each with all of its conditions.

    x: a number of each walk (conditions, seeds), which may be infinite. statistic: from B sets of walks (B, N)
    to their B numbers. The draws are the same for the same number of seeds.
    """
    seeds = x.shape[1]
    drawn = np.random.default_rng(0).integers(0, seeds, (RESAMPLES, seeds))
    sets = np.moveaxis(x[:, drawn], 0, 1).reshape(RESAMPLES, -1)
    edges = [0.5 - CONFIDENCE / 2, 0.5 + CONFIDENCE / 2]
    low, high = np.quantile(statistic(sets), edges, method="inverted_cdf")
    return Interval(float(statistic(x.reshape(1, -1))[0]), float(low), float(high))
