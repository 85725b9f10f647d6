"""Plots on axes of your own: each takes a matplotlib Axes and data, draws, and returns the Axes.

Nothing here opens a window or touches pyplot. Whole figures made of these are in `biped_adrc.viz.figures`.
"""

from biped_adrc.viz.plots.comparison import error_over_time, error_sizes, torque_sizes
from biped_adrc.viz.plots.disturbance import (
    external_torque,
    matched_disturbance,
    total_disturbance,
)
from biped_adrc.viz.plots.energy import energy
from biped_adrc.viz.plots.ground import friction_cone, ground_reaction
from biped_adrc.viz.plots.phase import phase_portrait
from biped_adrc.viz.plots.stability import magnitudes, multipliers, staircase
from biped_adrc.viz.plots.tracking import angles, joint_tracking, torques, tracking_errors

__all__ = [
    "angles",
    "energy",
    "error_over_time",
    "error_sizes",
    "external_torque",
    "friction_cone",
    "ground_reaction",
    "joint_tracking",
    "magnitudes",
    "matched_disturbance",
    "multipliers",
    "phase_portrait",
    "staircase",
    "torque_sizes",
    "torques",
    "total_disturbance",
    "tracking_errors",
]
