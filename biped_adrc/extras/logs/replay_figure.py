"""Figure of a replayed log over time.

Three panels: the joint torque beyond the nominal model kappa^-1 (xi^ - xi_nominal) [N m], the residual
q_b - x1^ [mrad], and the torque of the controller over the one in the log [N m]. The window of contact
after each touchdown is shaded.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from biped_adrc.extras.logs.replay_signals import ReplaySignals
from biped_adrc.view.plots.over_time import broken, curves, finished, without_observer
from biped_adrc.view.style import GREY, new_figure


def replay_figure(x: ReplaySignals, title: str = "") -> Figure:
    """Draw the three panels, a line for each joint; lines break at touchdowns."""
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
            look: Any = {
                "transform": axes.get_xaxis_transform(),
                "color": GREY,
                "alpha": 0.2,
                "lw": 0.0,
            }
            axes.fill_between(x.t, 0.0, 1.0, x.in_contact > 0.5, label="contact", **look)
            finished(axes, unit)
        for axes in (beyond, residual):
            axes.set_xlabel("")
        return figure
