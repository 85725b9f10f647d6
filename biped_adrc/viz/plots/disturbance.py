"""What disturbs a joint and what the observer takes it for."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from biped_adrc.analysis.signals import Signals
from biped_adrc.types import Array
from biped_adrc.viz.plots.lines import Window, broken, legend, line, shade
from biped_adrc.viz.plots.tracking import chosen
from biped_adrc.viz.style import PALETTE, label

NO_OBSERVER = "no observer: nothing is estimated"


def external_torque(axes: Axes, s: Signals, push: Window | None = None) -> Axes:
    """The torque from outside on every joint that is ever pushed [N m]; on all where none is."""
    shade(axes, push)
    pushed = np.flatnonzero(np.any(s.zeta != 0.0, axis=0))
    for i in pushed.tolist() or range(s.zeta.shape[1]):
        line(axes, s, s.zeta[:, i], i, f"$\\zeta_{i + 1}$")
    label(axes, "time [s]", r"push $\zeta$ [N m]")
    return legend(axes)


def total_disturbance(axes: Axes, s: Signals, joint: int = 0, push: Window | None = None) -> Axes:
    """xi of (13), q_b'' - kappa u, and its estimate xi^ for one actuated joint [rad/s^2]."""
    chosen(s, (joint,))
    shade(axes, push)
    _pair(axes, s, s.xi[:, joint], s.xi_estimate[:, joint], r"\xi", joint)
    label(axes, "time [s]", f"$\\xi_{joint + 1}$ [rad/s²]")
    return legend(axes)


def matched_disturbance(axes: Axes, s: Signals, joint: int = 0, push: Window | None = None) -> Axes:
    """The torque from outside on one actuated joint, and what the estimate amounts to there [N m].

    Solid: zeta_b, which enters (14) as kappa zeta_b, the matched part. Dashed: kappa^-1 (xi^ - xi_nominal);
    it also holds the unmatched part and errors of the model, so the lines differ by those.
    """
    chosen(s, (joint,))
    shade(axes, push)
    _pair(axes, s, s.zeta[:, joint], s.zeta_estimate[:, joint], r"\zeta", joint)
    label(axes, "time [s]", f"$\\zeta_{joint + 1}$ [N m]")
    return legend(axes)


def _pair(axes: Axes, s: Signals, true: Array, estimate: Array, symbol: str, joint: int) -> None:
    t, index = broken(s, s.t), f"_{joint + 1}"
    axes.plot(t, broken(s, true), color=PALETTE[0], lw=2.4, alpha=0.6, label=f"${symbol}{index}$")
    if np.isnan(estimate).all():
        middle = {"ha": "center", "va": "center", "transform": axes.transAxes}
        axes.text(0.5, 0.9, NO_OBSERVER, **middle)  # type: ignore[arg-type]
        return
    axes.plot(
        t,
        broken(s, estimate),
        color="black",
        ls=(0, (4, 2)),
        lw=1.0,
        label=f"$\\hat{{{symbol}}}{index}$",
    )
