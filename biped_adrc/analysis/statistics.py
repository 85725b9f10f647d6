"""Statistics over many walks, by SciPy: shares, medians and paired ratios, each with an interval of 95 %.

A share has Wilson's interval (J. Am. Stat. Assoc. 22, 1927); a median that of the order statistics, which is
exact for any distribution and takes infinite numbers; a paired ratio that of its median, and the sign test.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import scipy

CONFIDENCE = 0.95
"""Confidence level of every interval."""


class Interval(NamedTuple):
    """A point estimate with its 95 % confidence interval; NaN where there are too few walks for one."""

    value: float
    low: float
    high: float


def share(successes: int, count: int) -> Interval:
    """Share of `successes` among `count` walks, at least one, with Wilson's interval."""
    result = scipy.stats.binomtest(successes, count).proportion_ci(CONFIDENCE, method="wilson")
    return Interval(successes / count, float(result.low), float(result.high))


def median(values: Sequence[float]) -> Interval:
    """Median of at least one number, infinite ones included, with the interval of its order statistics."""
    result = scipy.stats.quantile_test(values, q=0.0, p=0.5).confidence_interval(CONFIDENCE)
    return Interval(float(np.median(values)), float(result.low), float(result.high))


class Paired(NamedTuple):
    """Comparison of the numbers of two series of walks, walk by walk."""

    ratio: Interval
    """Median of the ratios, with its interval."""
    p: float
    """p-value of the sign test: probability of as many ratios on one side of 1, were both equally likely."""
    pairs: int
    """Number of pairs with a ratio: those without an infinite number on both sides."""


def paired(x: Sequence[float], y: Sequence[float]) -> Paired | None:
    """Compare two series of positive numbers or infinity, of the same walks, by their ratios x / y.

    None where no pair has a ratio.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        r = np.divide(x, y)
    r = r[~np.isnan(r)]
    if not r.size:
        return None
    apart = r[r != 1.0]
    p = (
        float(scipy.stats.binomtest(int(np.sum(apart < 1.0)), apart.size).pvalue)
        if apart.size
        else 1.0
    )
    return Paired(median(r.tolist()), p, r.size)
