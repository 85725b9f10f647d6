"""The rms of a signal; over many walks, by SciPy, shares, medians and paired ratios with intervals of 95 %.

A share has Wilson's interval (J. Am. Stat. Assoc. 22, 1927). The interval of a median has order statistics as
its ends: it holds for any distribution, and values may be infinite. A paired ratio has the interval of the
median of the ratios, and the p-value of the sign test. One walk has a number and no interval, one pair no
p-value.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import scipy

from biped_adrc.analysis.signals import integrate
from biped_adrc.core.types import Array

CONFIDENCE = 0.95
"""Confidence level of every interval."""


class Interval(NamedTuple):
    """A point estimate with its 95 % confidence interval; NaN ends where there is none, as of too few walks."""

    value: float
    low: float = math.nan
    high: float = math.nan


def share(successes: int, count: int) -> Interval:
    """Share of `successes` among `count` walks, at least one, with Wilson's interval; NaN ends for one walk."""
    if count == 1:
        return Interval(float(successes))
    result = scipy.stats.binomtest(successes, count).proportion_ci(CONFIDENCE, method="wilson")
    return Interval(successes / count, float(result.low), float(result.high))


def median(values: Sequence[float]) -> Interval:
    """Median of at least one number, infinite ones included, with the interval of its order statistics.

    An end of the interval is NaN where there are too few numbers for it.
    """
    # of the quantile p = 0.5 only the interval is used, so the value q that is tested does not matter
    result = scipy.stats.quantile_test(values, q=0.0, p=0.5).confidence_interval(CONFIDENCE)
    return Interval(float(np.median(values)), float(result.low), float(result.high))


def rms(t: Array, x: Array) -> float:
    """Root of the mean of x^2 over time t (K,) [s] and over the columns of x (K, k), in the unit of x.

    The mean over time is an integral by splines; for a single instant it is the value there.
    """
    # max: a signal without columns has the rms 0
    squares, duration = np.sum(x**2, axis=1) / max(x.shape[1], 1), float(t[-1] - t[0])
    mean = integrate(t, squares) / duration if duration > 0.0 else float(squares[0])
    return float(np.sqrt(max(mean, 0.0)))


class Paired(NamedTuple):
    """Comparison of the numbers of two series of walks, walk by walk."""

    ratio: Interval
    """Median of the ratios, with its interval."""
    p: float
    """p-value of the two-sided sign test: probability of at least as uneven signs, were both signs equally
    likely. Pairs of equal numbers are left out; NaN for a single pair."""
    pairs: int
    """Number of pairs with a ratio: all but those with infinite numbers on both sides."""


def paired(x: Sequence[float], y: Sequence[float]) -> Paired | None:
    """Compare two series of positive numbers or infinity, of the same walks, by their ratios x / y.

    Equal numbers have the ratio 1, also 0 and 0; a pair of two infinite numbers has none and is left out. None
    where no pair has a ratio.
    """
    # a pair of equal numbers stays only if they are finite
    pairs = [(a, b) for a, b in zip(x, y, strict=True) if a != b or math.isfinite(a)]
    if not pairs:
        return None
    a, b = np.array(pairs).T
    with np.errstate(invalid="ignore", divide="ignore"):
        r = np.where(a == b, 1.0, a / b)
    # the sign test: of the pairs of different numbers, how many have x < y
    less, apart = int(np.sum(a < b)), int(np.sum(a != b))
    p = float(scipy.stats.binomtest(less, apart).pvalue) if apart else 1.0
    return Paired(median(r.tolist()), p if len(pairs) > 1 else math.nan, len(pairs))
