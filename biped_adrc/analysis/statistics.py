"""Statistics over many walks: shares, medians, pairs of walks with the same seed, and tests of both.

Shares have Wilson's interval (J. Am. Stat. Assoc. 22, 1927), medians the percentile bootstrap
(Efron, 1979) with a fixed seed. Tests are exact: the sign test, McNemar's (Psychometrika 12, 1947)
for shares of the same seeds, and Holm's correction (Scand. J. Statistics 6, 1979) over all that is
asked in one family. Comparisons of controllers pair the walks by seed, because one disturbance may
be harder than another for all of them. The comparison study in `bench` calls this module.
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


class Tested(NamedTuple):
    """Median over pairs with its interval, and the p-value of an exact test of it."""

    pairs: int
    """Number of pairs."""
    value: Interval
    """Median with its interval."""
    p: float
    """p-value of the exact test."""


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


def paired_ratio(a: Sequence[float], b: Sequence[float], margin: float) -> Tested | None:
    """Median of a_i / b_i (positive numbers) by its logarithm; None without pairs.

    The p-value is that of two one-sided sign tests of "within a factor `margin` of 1", doubled.
    """
    ratios = [x / y for x, y in zip(a, b, strict=True)]
    if not ratios:
        return None
    logs, edge = [math.log(x) for x in ratios], math.log(margin)
    beside = ([x < -edge for x in logs], [x > edge for x in logs])
    p = min(1.0, 2.0 * min(map(_more_than_half, beside)))
    return Tested(len(ratios), median_ratio(ratios), p)


def median_ratio(ratios: Sequence[float]) -> Interval:
    """Median of positive numbers, at least one, by their logarithms: 2 and 1/2 are equally far from 1."""
    found = median([math.log(x) for x in ratios])
    assert found is not None
    return Interval(*(math.exp(x) for x in found))


def paired_equal(a: Sequence[float], b: Sequence[float], margin: float) -> Tested | None:
    """Median of a_i - b_i; None without pairs. The test: more than half of them within `margin` of 0."""
    differences = [x - y for x, y in zip(a, b, strict=True)]
    found = median(differences)
    if found is None:
        return None
    return Tested(len(differences), found, _more_than_half([abs(x) < margin for x in differences]))


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


def _more_than_half(so: Sequence[bool]) -> float:
    """One-sided p-value of the sign test that more than half of all cases hold."""
    return float(stats.binomtest(sum(so), len(so), 0.5, alternative="greater").pvalue)


def sign_test(larger: int, smaller: int) -> float:
    """Two-sided p-value of the sign test without ties; 1 where there are only ties."""
    if larger + smaller == 0:
        return 1.0
    return float(stats.binomtest(larger, larger + smaller, 0.5).pvalue)


def mcnemar(a: Sequence[bool], b: Sequence[bool]) -> float:
    """McNemar's p-value for paired a_i, b_i: that "a without b" is as frequent as "b without a"."""
    pairs = list(zip(a, b, strict=True))
    return sign_test(sum(x and not y for x, y in pairs), sum(y and not x for x, y in pairs))


def holm(p: Sequence[float]) -> list[float]:
    """The p-values of one family, each corrected for all of them by Holm's method, in the given order."""
    out, worst = [0.0] * len(p), 0.0
    for rank, i in enumerate(sorted(range(len(p)), key=lambda i: p[i])):
        worst = max(worst, min(1.0, (len(p) - rank) * p[i]))
        out[i] = worst
    return out
