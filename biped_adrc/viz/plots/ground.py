"""The ground reaction, and whether dry friction could have given it."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from biped_adrc.analysis.signals import Signals
from biped_adrc.errors import InputError
from biped_adrc.ground import ground_axes
from biped_adrc.viz.plots.lines import Window, broken, legend, line, shade
from biped_adrc.viz.style import GREY, PALETTE, label


def friction_cone(axes: Axes, s: Signals, mu: float = 0.6, slope: float = 0.0) -> Axes:
    """F_T against F_N [N] in single support and the cone |F_T| = mu F_N; outside it a foot would slip.

    mu: coefficient of dry friction, 0.6 for RABBIT (its record names the source). slope [rad] of the ground,
    positive downhill; F_T is along it. Impulses at impact are not forces and are not drawn. Raises InputError
    for a coefficient that is not positive.
    """
    if not (np.isfinite(mu) and mu > 0.0):
        raise InputError(f"the coefficient of friction is {mu}, expected a positive number")
    tangent, normal = (s.ground_reaction @ axis for axis in ground_axes(slope))
    top = 1.1 * max(float(np.max(normal)), 1.0)
    axes.fill([0.0, mu * top, -mu * top], [0.0, top, top], color="#dddddd", zorder=0)
    for sign in (-1.0, 1.0):
        name = f"cone, $\\mu$ = {mu:g}" if sign > 0 else "_"
        axes.plot([0.0, sign * mu * top], [0.0, top], color=GREY, ls="--", label=name)
    axes.plot(
        broken(s, tangent), broken(s, normal), color=PALETTE[0], lw=0.9, label="ground reaction"
    )
    axes.axhline(0.0, color="black", lw=0.8, label="_")
    label(axes, "$F_T$ [N]", "$F_N$ [N]")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.14), ncols=2, frameon=False)
    return axes


def ground_reaction(axes: Axes, s: Signals, push: Window | None = None, slope: float = 0.0) -> Axes:
    """F_T and F_N over time [N], along and out of ground of this slope [rad], positive downhill."""
    shade(axes, push)
    for i, (name, axis) in enumerate(zip(("$F_T$", "$F_N$"), ground_axes(slope), strict=True)):
        line(axes, s, s.ground_reaction @ axis, i, name)
    axes.axhline(0.0, color="black", lw=0.8, label="_")
    label(axes, "time [s]", "ground reaction [N]")
    return legend(axes)
