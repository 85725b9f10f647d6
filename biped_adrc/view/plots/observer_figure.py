"""Frequency responses of ADRC loops, from the linear loop of one joint (`analysis.observer`).

Three panels: disturbance xi to tracking error e [s^2], disturbance to its estimate xi^ [1], and an
error n of the measured angle to torque u [N m/rad]. `biped-adrc observer --out` draws it: a faster
observer lowers the first curve and raises the last.
"""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from biped_adrc.analysis.observer.report import ObserverReport
from biped_adrc.view.style import DASHES, GREY, PALETTE, label, new_figure

FEWEST, FLOOR = 400, 1e-12
"""Frequencies of a curve, and how far below a panel's largest value it is drawn, as a share of it."""


def observer_figure(report: ObserverReport) -> Figure:
    """|e / xi|, |xi^ / xi| and |u / n| over the frequency [rad/s].

    Dotted: half the sampling frequency, above which a sampled loop sees aliases. An observer without extended
    states (m = 0) has no estimate and no curve in the second panel.
    """
    frequencies, responses = report.loop.frequencies, report.responses
    grid = np.geomspace(frequencies[0], frequencies[-1], FEWEST)
    curves = (
        ("e / xi", "|e / xi| [s$^2$]", "error from a disturbance"),
        ("xi^ / xi", "|xi^ / xi|", "estimate of the disturbance"),
        ("u / n", "|u / n| [N m/rad]", "torque from an angle's error"),
    )
    with new_figure(9.0, 3.4) as figure:
        panels = figure.subplots(1, 3)
        for axes, (response, name, title) in zip(panels, curves, strict=True):
            label(axes, "frequency [rad/s]", name, title)
            level = np.abs(responses[response](grid))
            if not np.any(level > 0.0):
                axes.set_xscale("log")
                axes.text(0.5, 0.5, "m = 0 has none", ha="center", transform=axes.transAxes)
                continue
            axes.loglog(grid, level, label=report.name, color=PALETTE[0], ls=DASHES[0])
            axes.set_ylim(bottom=max(axes.get_ylim()[0], FLOOR * np.max(level)))
            axes.axvline(np.pi / report.hardware.period, color=GREY, lw=0.8, ls=":")
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center")
        return figure
