"""Integrals over the nodes of a walk, piece by piece between jumps."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

from biped_adrc.types import Array


def integrate(t: Array, y: Array) -> float:
    """Integral of y (K,) over t (K,); a repeated time separates smooth pieces.

    Cubic splines, of order 4 in the distance of the nodes; the trapezoidal rule where a piece has fewer
    than four nodes.
    """
    cuts = np.flatnonzero(np.diff(t) == 0.0) + 1
    total = 0.0
    for time, value in zip(np.split(t, cuts), np.split(y, cuts), strict=True):
        if len(time) >= 4:
            total += float(CubicSpline(time, value).integrate(time[0], time[-1]))
        elif len(time) > 1:
            total += float(np.trapezoid(value, time))
    return total
