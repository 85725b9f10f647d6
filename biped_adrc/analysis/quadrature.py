"""Integrals and peaks of signals, from the stored nodes of a walk.

Nodes are unevenly spaced, and a repeated time marks a jump, at an impact or a sample instant: the
signal has a left and a right value there. So the functions work piece by piece between jumps.
`signals`, `certificate` and the metrics of a scenario use them.
"""

from __future__ import annotations

import math

import numpy as np

from biped_adrc.core.linear import lapack
from biped_adrc.core.types import Array


def integrate(t: Array, y: Array) -> float:
    """Integrate y (K,) over t (K,) [s]; a repeated time separates smooth pieces.

    Cubic splines, of order 4 in the distance of the nodes; the trapezoidal rule where a piece
    has fewer than four nodes. Infinite where y is not finite, as in a walk that diverges. The
    result has the unit of y times [s].
    """
    if not np.all(np.isfinite(y)):
        return math.inf
    cuts = np.flatnonzero(np.diff(t) == 0.0) + 1
    total = 0.0
    for time, value in zip(np.split(t, cuts), np.split(y, cuts), strict=True):
        if len(time) >= 4:
            total += _under_spline(time, value)
        elif len(time) > 1:
            total += float(np.trapezoid(value, time))
    return total


def _under_spline(t: Array, y: Array) -> float:
    """Integral of the cubic spline through y (K,) at t (K,), K >= 4, not-a-knot at both ends.

    Its slopes s solve a tridiagonal system; each interval adds h (y_0 + y_1) / 2 + h^2 (s_0 - s_1) / 12. As
    SciPy's CubicSpline, whose module takes long to load.
    """
    h = np.diff(t)
    m = np.diff(y) / h
    A, b = np.zeros((3, len(t))), np.empty(len(t))  # above, on and below the diagonal
    A[0, 2:], A[1, 1:-1], A[2, :-2] = h[:-1], 2.0 * (h[:-1] + h[1:]), h[1:]
    b[1:-1] = 3.0 * (h[1:] * m[:-1] + h[:-1] * m[1:])
    for i, j, row in ((0, 1, 0), (-1, -2, 2)):
        d = h[i] + h[j]
        A[1, i], A[row, j] = h[j], d
        b[i] = ((h[i] + 2.0 * d) * h[j] * m[i] + h[i] ** 2 * m[j]) / d
    s = lapack.dgtsv(A[2, :-1], A[1], A[0, 1:], b)[3]
    return float(np.trapezoid(y, t) + np.sum(h * h * (s[:-1] - s[1:])) / 12.0)


def largest(t: Array, y: Array, dy: Array) -> float:
    """max |y| over [t_0, t_K] [s] for y (K, p) with slopes dy (K, p), at the nodes and between them.

    Between two nodes y is the cubic through both with their slopes, which has the order of the integration
    method; its extrema are where its derivative a s^2 + b s + c is zero, s from 0 to 1. A repeated time is a
    jump: both sides count. Infinite where y is not finite.
    """
    if not (np.all(np.isfinite(y)) and np.all(np.isfinite(dy))):
        return math.inf
    h = np.diff(t)[:, np.newaxis]
    rise, d0, d1 = np.diff(y, axis=0), h * dy[:-1], h * dy[1:]
    a, b, c = 3.0 * (d0 + d1 - 2.0 * rise), 2.0 * (3.0 * rise - 2.0 * d0 - d1), d0
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        root = -0.5 * (b + np.copysign(np.sqrt(b * b - 4.0 * a * c), b))
        result = [np.abs(y).max(initial=0.0)]
        for s in (root / a, c / root):
            inside = np.where((s > 0.0) & (s < 1.0), s, 0.0)
            result.append(
                np.abs(y[:-1] + inside * (d0 + inside * (0.5 * b + inside * a / 3.0))).max(
                    initial=0.0
                )
            )
    return float(max(result))
