"""What an observer makes of a log, as a figure over time.

Three panels: the joint torque beyond the nominal model kappa^-1 (xi^ - xi_nominal) [N m], the residual
q_b - x1^ [mrad], and the torque asked for over the one in the log [N m]. The window of contact after each
touchdown is shaded.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from biped_adrc.extras.logs.replay_signals import ReplaySignals
from biped_adrc.view.plots.over_time import broken, curves, finished, without_observer
from biped_adrc.view.style import GREY, new_figure


def replay_figure(x: ReplaySignals, title: str = "") -> Figure:
    """The panels, a line for each joint; lines break at touchdowns."""
    with new_figure(8.0, 7.0, title) as figure:
        beyond, residual, torque = figure.subplots(3, 1, sharex=True)
        for k, u in enumerate(x.u.T):
            name = "in the log" if k == 0 else "_"
            torque.plot(broken(x, x.t), broken(x, u), color=GREY, lw=0.8, ls=":", label=name)
        for axes, values, symbol, unit in (
            (beyond, x.zeta_estimate, r"\hat\zeta", "beyond the model [N m]"),
            (residual, 1e3 * x.residual, "q", "residual [mrad]"),
            (torque, x.torque, "u", "torque asked for [N m]"),
        ):
            if np.isnan(values).all():
                without_observer(axes)
            else:
                curves(axes, x, values, symbol)
            _shade(axes, x)
            finished(axes, unit)
        for axes in (beyond, residual):
            axes.set_xlabel("")
        return figure


def _shade(axes: Axes, x: ReplaySignals) -> None:
    """Shade the window of contact after each touchdown."""
    inside = np.concatenate(([0.0], x.in_contact, [0.0]))
    edges = np.flatnonzero(np.diff(inside))
    for first, end in zip(edges[::2], edges[1::2], strict=True):
        name = "contact" if first == edges[0] else "_"
        axes.axvspan(x.t[first], x.t[end - 1], color=GREY, alpha=0.2, lw=0.0, label=name)
