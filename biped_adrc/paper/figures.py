"""The figures that are drawn of any stored walk, by name: what the command `plot` draws.

Decides which signals a figure gets and where the window of the push is; the drawing is in `view.plots.figures`.
matplotlib is imported when something is drawn, since importing it takes longer than a walk.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from biped_adrc.analysis.signals import Signals
from biped_adrc.core.errors import InputError
from biped_adrc.scenario.recording import Walk

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NAMES = ("tracking", "disturbance", "ground", "energy", "phase", "comparison")
"""Figures that can be asked for."""


def draw(name: str, walks: Mapping[str, Walk]) -> Figure:
    """One figure: of the first walk, or of all walks for "phase" and "comparison".

    Raises InputError for an unknown name, no walk, or a robot without motors where the figure shows motors.
    """
    from biped_adrc.view.plots import figures
    from biped_adrc.view.style import literal

    if name not in NAMES:
        raise InputError(f"there is no figure '{name}'; choose one of {list(NAMES)}")
    if not walks:
        raise InputError("there is no walk to draw; expected at least one")
    walks = {literal(n): w for n, w in walks.items()}
    title, walk = next(iter(walks.items()))
    signals = {n: w.signals for n, w in walks.items()}
    first, push = signals[title], push_window(signals[title])
    if name in ("disturbance", "comparison") and any(s.u.shape[1] == 0 for s in signals.values()):
        raise InputError(
            f"figure '{name}' shows what motors do and these walks have a robot without; choose one of "
            "'tracking', 'ground', 'energy', 'phase'"
        )
    mu, slope = walk.walker.plant.description.friction_coefficient, walk.walker.slope
    return {
        "tracking": partial(walk.plot, title, push),
        "disturbance": partial(figures.disturbance_figure, first, title, push),
        "ground": partial(figures.ground_figure, first, title, mu, slope, push),
        "energy": partial(figures.energy_figure, first, title, push),
        "phase": partial(figures.phase_figure, signals),
        "comparison": partial(figures.comparison_figure, signals, push),
    }[name]()


def push_window(s: Signals) -> tuple[float, float] | None:
    """First and last time [s] of the first step in which an external torque acts; None where there is none."""
    pushed = np.any(s.zeta != 0.0, axis=1)
    if not pushed.any():
        return None
    t = s.t[pushed & (s.step == s.step[pushed][0])]
    return float(t[0]), float(t[-1])
