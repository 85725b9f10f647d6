"""Means of a signal over a window that slides along its nodes."""

from __future__ import annotations

import numpy as np
from scipy.integrate import cumulative_trapezoid

from biped_adrc.types import Array


def window_means(t: Array, y: Array, window: float) -> tuple[Array, Array]:
    """Means of y (K, m) over [s - window, s] within t (K,): the ends s in order (M,), and the means (M, m).

    y is taken as linear between nodes; a repeated time is a jump with both its sides. The windows are those
    that begin or end at a node; the mean of one between them may be more extreme by what y changes from node to
    node. What is shorter than the window is averaged as a whole.
    """
    duration = t[-1] - t[0]
    if duration <= 0.0:
        return t[-1:].copy(), y[-1:].copy()
    length = min(window, duration)
    ends = np.concatenate((t[t >= t[0] + length], t[t <= t[-1] - length] + length))
    ends = np.unique(np.append(ends, t[0] + length))
    return ends, (integral(t, y, ends) - integral(t, y, ends - length)) / length


def integral(t: Array, y: Array, s: Array) -> Array:
    """The integral of y (K, m), linear between nodes, from t[0] to each of the times s (M,): (M, m)."""
    h = np.diff(t)
    whole = cumulative_trapezoid(y, t, axis=0, initial=0.0)
    i = np.clip(np.searchsorted(t, s, side="right") - 1, 0, len(t) - 2)
    past = np.clip(s - t[i], 0.0, h[i])[:, np.newaxis]
    slope = (y[i + 1] - y[i]) / np.where(h[i] > 0.0, h[i], 1.0)[:, np.newaxis]
    found: Array = whole[i] + past * (y[i] + 0.5 * past * slope)
    return found
