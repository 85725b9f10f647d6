"""Theta against its rate, the paper's figure 6."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from biped_adrc.analysis.signals import Signals
from biped_adrc.viz.plots.lines import broken
from biped_adrc.viz.style import GREY, PALETTE, label


def phase_portrait(axes: Axes, s: Signals, name: str = "walk", colour: int = 0) -> Axes:
    """Theta [rad] against Theta' [rad/s]: solid in single support, dotted across impacts."""
    axes.plot(broken(s, s.theta), broken(s, s.dtheta), color=PALETTE[colour], lw=0.8, label=name)
    for k, j in enumerate(np.flatnonzero(np.diff(s.step))):
        ends, text = slice(j, j + 2), "impact" if k == 0 else "_"
        axes.plot(s.theta[ends], s.dtheta[ends], color=GREY, ls=":", lw=0.6, label=text)
    axes.plot(s.theta[0], s.dtheta[0], "o", color="black", ms=4, label="start")
    label(axes, r"$\Theta$ [rad]", r"$\dot\Theta$ [rad/s]")
    axes.legend(loc="best", frameon=False)
    return axes
