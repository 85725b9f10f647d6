"""What an observer makes of a log, as a figure over time.

Three panels: the joint torque beyond the nominal model kappa^-1 (xi^ - xi_nominal) [N m], the residual
q_b - x1^ [mrad], and the torque asked for over the one in the log [N m]. The window of contact after each
touchdown is shaded.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from biped_adrc.core.types import Array
from biped_adrc.extras.logs.replay_signals import ReplaySignals
from biped_adrc.view.plots.over_time import NO_OBSERVER, legend
from biped_adrc.view.style import DASHES, GREY, PALETTE, label, new_figure, style


def replay_figure(x: ReplaySignals, title: str = "") -> Figure:
    """The panels, a line for each joint; lines break at touchdowns."""
    with style():
        figure = new_figure(8.0, 7.0)
        beyond, residual, torque = figure.subplots(3, 1, sharex=True)
        for axes in (beyond, residual, torque):
            _shade(axes, x)
        _lines(beyond, x, x.zeta_estimate, r"\hat\zeta")
        label(beyond, "", "beyond the model [N m]", title)
        _lines(residual, x, 1e3 * x.residual, "q")
        label(residual, "", r"residual [mrad]")
        _lines(torque, x, x.torque, "u")
        for k, u in enumerate(x.u.T):
            name = "in the log" if k == 0 else "_"
            torque.plot(_broken(x, x.t), _broken(x, u), color=GREY, lw=0.8, ls=":", label=name)
        label(torque, "time [s]", "torque asked for [N m]")
        legend(torque)
        return figure


def _lines(axes: Axes, x: ReplaySignals, values: Array, symbol: str) -> None:
    """The columns of values (K, p) over time, or that there is no observer."""
    if np.isnan(values).all():
        axes.text(0.5, 0.5, NO_OBSERVER, ha="center", va="center", transform=axes.transAxes)
        return
    for i, column in enumerate(values.T):
        colour, dash = PALETTE[i % len(PALETTE)], DASHES[i % len(DASHES)]
        name = f"${symbol}_{i + 1}$"
        axes.plot(_broken(x, x.t), _broken(x, column), color=colour, ls=dash, label=name)
    legend(axes)


def _broken(x: ReplaySignals, y: Array) -> Array:
    """y (K,) with NaN where a single support begins, at which matplotlib breaks a line."""
    return np.insert(y, np.flatnonzero(np.diff(x.step)) + 1, np.nan)


def _shade(axes: Axes, x: ReplaySignals) -> None:
    """Shade the window of contact after each touchdown."""
    inside = np.concatenate(([0.0], x.in_contact, [0.0]))
    edges = np.flatnonzero(np.diff(inside))
    for first, end in zip(edges[::2], edges[1::2], strict=True):
        name = "contact" if first == edges[0] else "_"
        axes.axvspan(x.t[first], x.t[end - 1], color=GREY, alpha=0.2, lw=0.0, label=name)
