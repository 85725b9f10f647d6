"""Kinetic, potential and total energy."""

from __future__ import annotations

from matplotlib.axes import Axes

from biped_adrc.analysis.signals import Signals
from biped_adrc.viz.plots.lines import Window, legend, line, shade
from biped_adrc.viz.style import label


def energy(axes: Axes, s: Signals, push: Window | None = None) -> Axes:
    """Energies over time [J], potential energy from its least value; impacts take kinetic energy only."""
    shade(axes, push)
    potential = s.potential - s.potential.min()
    for i, (values, name) in enumerate(
        ((s.kinetic, "kinetic"), (potential, "potential"), (s.kinetic + potential, "total"))
    ):
        line(axes, s, values, i, name)
    label(axes, "time [s]", "energy [J]")
    return legend(axes)
