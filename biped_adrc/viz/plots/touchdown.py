"""xi^ through a touchdown, on the rigid plant and on soft ground, per policy across contact.

xi is the lumped disturbance of a joint; in grey the true one, from the motion. On the rigid plant the touchdown
takes no time and the controller is told of it. On soft ground the force of contact acts for some milliseconds,
and an observer takes it for a disturbance unless a policy keeps it from doing so.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from biped_adrc.analysis.signals import Signals
from biped_adrc.types import Array, Indices
from biped_adrc.viz.style import DASHES, GREY, PALETTE, label, new_figure, style

STEP, JOINT = 3, 2
"""The single support that begins with the touchdown, and the joint: the knee of the stance leg."""
BEFORE, AFTER = 0.005, 0.06
"""[s], shown around the touchdown."""

Walks = Mapping[str, Mapping[str, Signals]]
"""Signals by plant and policy."""


def touchdown_figure(walks: Walks) -> Figure:
    """A column for each plant: xi^ of one joint [rad/s^2] above, its tracking error [mrad] below, over the time
    since the touchdown [ms].

    A walk that does not come to the touchdown is left out.
    """
    with style():
        figure = new_figure(3.4 * len(walks), 5.4)
        panels = figure.subplots(2, len(walks), squeeze=False, sharex=True)
        for column, (plant, by_policy) in enumerate(walks.items()):
            _estimates(panels[0, column], by_policy)
            _errors(panels[1, column], by_policy)
            label(panels[0, column], "", "", plant)
            label(panels[1, column], "time since touchdown [ms]", "")
        panels[0, 0].set_ylabel("xi^ of the stance knee [rad/s$^2$]")
        panels[1, 0].set_ylabel("its error [mrad]")
        lines = panels[0, 0].get_legend_handles_labels()
        figure.legend(*lines, loc="outside lower center", ncols=3)
        return figure


def _estimates(axes: Axes, by_policy: Mapping[str, Signals]) -> None:
    """The estimates, and in grey the true xi of the first walk, cut off where it is far from them."""
    for k, (t, x, rows) in enumerate(_shown(by_policy)):
        if k == 0:
            axes.plot(t, x.xi[rows, JOINT], color=GREY, lw=0.8, label="xi itself, without a policy")
        axes.plot(t, x.xi_estimate[rows, JOINT], **_look(by_policy, k))
    estimates = [line.get_ydata() for line in axes.lines[1:]]
    low, high = (float(pick([pick(y) for y in estimates])) for pick in (np.min, np.max))
    room = 0.15 * (high - low)
    axes.set_ylim(low - room, high + room)


def _errors(axes: Axes, by_policy: Mapping[str, Signals]) -> None:
    """Tracking errors of the joint."""
    for k, (t, x, rows) in enumerate(_shown(by_policy)):
        axes.plot(t, 1e3 * x.error[rows, JOINT], **_look(by_policy, k))


def _shown(by_policy: Mapping[str, Signals]) -> list[tuple[Array, Signals, Indices]]:
    """Times since the touchdown [ms], signals and rows of each walk."""
    found = []
    for x in by_policy.values():
        at = x.t[x.step == STEP]
        if len(at):
            rows = np.flatnonzero((x.t >= at[0] - BEFORE) & (x.t <= at[0] + AFTER))
            found.append((1e3 * (x.t[rows] - at[0]), x, rows))
    return found


def _look(by_policy: Mapping[str, Signals], k: int) -> dict[str, Any]:
    return {
        "label": list(by_policy)[k],
        "color": PALETTE[k % len(PALETTE)],
        "ls": DASHES[k % len(DASHES)],
        "lw": 1.4,
    }
