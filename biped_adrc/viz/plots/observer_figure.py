"""Frequency responses of ADRC loops, from the linear loop of one joint (`observer_design`).

Three panels: disturbance xi to tracking error e [s^2], disturbance to its estimate xi^ [1], and an
error n of the measured angle to torque u [N m/rad]. `biped-adrc observer --out` draws it: a faster
observer lowers the first curve and raises the last.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from biped_adrc.errors import InputError
from biped_adrc.observer_design.observer_report import ObserverReport
from biped_adrc.viz.style import DASHES, GREY, PALETTE, label, new_figure, style

FEWEST, FLOOR = 400, 1e-12
"""Frequencies of a curve, and how far below a panel's largest value it is drawn, as a share of it."""


def observer_figure(reports: Sequence[ObserverReport]) -> Figure:
    """|e / xi|, |xi^ / xi| and |u / n| over the frequency [rad/s], a curve for each report.

    Dotted: half the sampling frequency of the first report, above which a sampled loop sees
    aliases. An observer without extended states (m = 0) has no estimate and no curve in the second
    panel. Raises InputError when there is no report.
    """
    if not reports:
        raise InputError("the figure of transfer functions has no report; expected at least one")
    grids = [report.frequencies for report in reports]
    grid = np.geomspace(min(g[0] for g in grids), max(g[-1] for g in grids), FEWEST)
    with style():
        figure = new_figure(9.0, 3.4)
        panels = figure.subplots(1, 3)
        for i, report in enumerate(reports):
            loop = report.loop
            curves = (
                loop.tracking_error(grid),
                loop.estimate(grid),
                loop.noise(grid) * report.hardware.inertia,
            )
            colour, dash = PALETTE[i % len(PALETTE)], DASHES[i % len(DASHES)]
            for axes, curve in zip(panels, curves, strict=True):
                level = np.abs(curve)
                if np.any(level > 0.0):  # m = 0 has no estimate
                    axes.loglog(grid, level, label=report.name, color=colour, ls=dash)
        titles = (
            ("|e / xi| [s$^2$]", "error from a disturbance"),
            ("|xi^ / xi|", "estimate of the disturbance"),
            ("|u / n| [N m/rad]", "torque from an angle's error"),
        )
        for axes, (name, title) in zip(panels, titles, strict=True):
            label(axes, "frequency [rad/s]", name, title)
            if not axes.lines:
                axes.set_xscale("log")
                axes.text(0.5, 0.5, "m = 0 has none", ha="center", transform=axes.transAxes)
                continue
            highest = max(np.max(line.get_ydata()) for line in axes.lines)
            axes.set_ylim(bottom=max(axes.get_ylim()[0], FLOOR * highest))
            axes.axvline(np.pi / reports[0].hardware.period, color=GREY, lw=0.8, ls=":")
        handles, names = panels[0].get_legend_handles_labels()
        figure.legend(handles, names, loc="outside lower center", ncols=min(3, len(names)))
        return figure
