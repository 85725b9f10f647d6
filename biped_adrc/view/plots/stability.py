"""Floquet multipliers of the return map.

The return map takes the state before an impact to that before the next one. A periodic walk, its fixed point,
is stable when all multipliers lambda, the eigenvalues of the map's derivative there, lie inside the unit
circle. `analysis.stability` computes them by several methods; they are drawn by name beside each other.
"""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from biped_adrc.view.style import GREY, PALETTE, label

_MARKERS = "ox^s"
"""Marks of the points, one for each method of computing multipliers."""


def multipliers(axes: Axes, found: Mapping[str, ArrayLike]) -> Axes:
    """Draw Floquet multipliers in the complex plane with the unit circle; returns the axes.

    found: name of a method -> its multipliers (k,), complex, dimensionless.
    """
    angle = np.linspace(0.0, 2.0 * np.pi, 361)
    axes.plot(np.cos(angle), np.sin(angle), color="black", lw=1.0, label="unit circle")
    for i, (name, values) in enumerate(found.items()):
        z = np.atleast_1d(np.asarray(values, dtype=complex))
        _plot(axes, i, name, z.real, z.imag, 7 + 2 * i)  # marks of later methods are larger
    axes.set_aspect("equal")
    label(axes, r"Re $\lambda$ [-]", r"Im $\lambda$ [-]")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.14), ncols=3, frameon=False)
    return axes


def magnitudes(
    axes: Axes, found: Mapping[str, ArrayLike], published: ArrayLike | None = None
) -> Axes:
    """Draw |lambda| of multipliers, in decreasing order, on a logarithmic scale; returns the axes. A walk is
    stable when all are below 1.

    found: name of a method -> its multipliers (k,), dimensionless. Zeros have no place on that scale:
    the legend counts them. published (k,): magnitudes printed in the paper; they come from a regression
    and are shown for comparison only.
    """
    axes.axhline(1.0, color="black", lw=1.0, label="unit circle")
    for i, (name, values) in enumerate(found.items()):
        size = np.sort(np.abs(np.atleast_1d(np.asarray(values, dtype=complex))))[::-1]
        zeros = int(np.sum(size == 0.0))  # a logarithmic scale has no place for them
        size = size[size > 0.0]
        name = f"{name}, {zeros} more are 0" if zeros else name
        _plot(axes, i, name, 1.0 + np.arange(len(size)), size, 6)
    if published is not None:
        size = np.sort(np.abs(np.asarray(published)))[::-1]
        name = "printed in the paper (regression)"
        axes.plot(1 + np.arange(len(size)), size, "+", color=GREY, ms=8, label=name)
    axes.set_yscale("log")
    label(axes, "number in decreasing order [-]", r"$|\lambda|$ [-]")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.14), ncols=2, frameon=False)
    return axes


def _plot(axes: Axes, i: int, name: str, x: ArrayLike, y: ArrayLike, size: int) -> None:
    """Draw y (k,) over x (k,) as open marks of the i-th kind and colour, `size` [pt] large, so that marks at
    the same place are seen; name: in the legend.
    """
    marker, colour = _MARKERS[i % 4], PALETTE[i]
    axes.plot(x, y, marker=marker, ls="", mec=colour, mfc="none", ms=size, label=name)
