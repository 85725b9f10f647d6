"""What a number of walks says: shares and medians with confidence intervals of 95 %.

Shares by Wilson's interval (J. Am. Stat. Assoc. 22, 1927), medians by the percentile bootstrap (Efron, 1979)
with a fixed seed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy import stats

CONFIDENCE = 0.95
RESAMPLES = 2000


class Interval(NamedTuple):
    """A number, and between what it lies with the confidence of 95 %."""

    value: float
    low: float
    high: float


def share(successes: int, count: int) -> Interval:
    """Of `count` walks, at least one."""
    found = stats.binomtest(successes, count).proportion_ci(CONFIDENCE, method="wilson")
    return Interval(successes / count, float(found.low), float(found.high))


def median(values: Sequence[float | None]) -> Interval | None:
    """Of those that are numbers; None without any."""
    x = np.array([v for v in values if v is not None and math.isfinite(v)])
    if len(x) == 0:
        return None
    random = np.random.default_rng(0)
    draws = np.median(x[random.integers(0, len(x), (RESAMPLES, len(x)))], axis=1)
    low, high = np.quantile(draws, [0.5 - CONFIDENCE / 2, 0.5 + CONFIDENCE / 2])
    return Interval(float(np.median(x)), float(low), float(high))
