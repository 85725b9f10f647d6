"""Integrals and peaks, from the stored nodes of a walk.

Nodes are unevenly spaced, and a repeated time marks a jump, at an impact or a sample instant: the
signal has a left and a right value there. So the functions work piece by piece between jumps.
`signals`, `certificate` and the metrics of a scenario use them.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.interpolate import CubicSpline

from biped_adrc.types import Array


def integrate(t: Array, y: Array) -> float:
    """Integral of y (K,) over t (K,) [s]; a repeated time separates smooth pieces.

    Cubic splines, of order 4 in the distance of the nodes; the trapezoidal rule where a piece has
    fewer than four nodes. Infinite where y is not finite, as in a walk that diverges. The result
    has the unit of y times [s].
    """
    if not np.all(np.isfinite(y)):
        return math.inf
    cuts = np.flatnonzero(np.diff(t) == 0.0) + 1
    total = 0.0
    for time, value in zip(np.split(t, cuts), np.split(y, cuts), strict=True):
        if len(time) >= 4:
            total += float(CubicSpline(time, value).integrate(time[0], time[-1]))
        elif len(time) > 1:
            total += float(np.trapezoid(value, time))
    return total


def largest(t: Array, y: Array, dy: Array) -> float:
    """max |y| over [t_0, t_K] [s] for y (K, p) with slopes dy (K, p): at the nodes and between them.

    Between two nodes y is the cubic through both with their slopes, which has the order of the
    integration method; its extrema are where its derivative a s^2 + b s + c is zero, s from 0 to 1.
    A repeated time is a jump: both sides count. Infinite where y is not finite.
    """
    if not (np.all(np.isfinite(y)) and np.all(np.isfinite(dy))):
        return math.inf
    h = np.diff(t)[:, np.newaxis]
    rise, d0, d1 = np.diff(y, axis=0), h * dy[:-1], h * dy[1:]
    a, b, c = 3.0 * (d0 + d1 - 2.0 * rise), 2.0 * (3.0 * rise - 2.0 * d0 - d1), d0
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        root = -0.5 * (b + np.copysign(np.sqrt(b * b - 4.0 * a * c), b))
        found = [np.abs(y).max(initial=0.0)]
        for s in (root / a, c / root):
            inside = np.where((s > 0.0) & (s < 1.0), s, 0.0)
            found.append(
                np.abs(y[:-1] + inside * (d0 + inside * (0.5 * b + inside * a / 3.0))).max(
                    initial=0.0
                )
            )
    return float(max(found))
