"""What a walk needed of the ground and of the motors, step by step, as the terminal shows it."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING

from rich.box import SIMPLE_HEAD
from rich.table import Column, Table

from biped_adrc.cli.app import console

if TYPE_CHECKING:
    from biped_adrc.analysis.certificate import Certificate
    from biped_adrc.analysis.feasibility import Feasibility
    from biped_adrc.analysis.soft_steps import SoftStep


def print_supports(
    feasibility: Feasibility, certificates: Sequence[Certificate], ended: str
) -> None:
    """Print what every step needed of ground and motors, a row each; below how the walk ended, in words."""
    from biped_adrc.analysis.certificate import ratio_text

    columns = (
        "step",
        "time [s]",
        "length [m]",
        "torque [N m]",
        "F_N [N]",
        Column("friction", min_width=8),
        "at impact",
        "scuffs [mm]",
        Column("breaks", min_width=8),
    )
    table = Table(*columns, box=SIMPLE_HEAD, pad_edge=False, padding=(0, 1, 0, 0))
    for s, c in zip_longest(feasibility.supports, certificates):
        table.add_row(
            f"{s.step}",
            f"{s.duration:.4f}",
            f"{c.step_length:.4f}" if c else "",
            f"{s.peak_torque:.1f}",
            f"{s.mean_normal_force:.1f}",
            ratio_text(s.mean_friction),
            ratio_text(s.impulse_ratio) if c else "",
            f"{1e3 * s.scuffing:.2g}",
            ", ".join(name.replace("_", " ") for name in s.infeasible()),
        )
    console.print(table)
    console.print(
        f"F_N and friction: least and largest mean over {1e3 * feasibility.limits.window:g} ms\n"
        f"{ended}\n{feasibility.text()}"
    )


def print_on_ground(steps: tuple[SoftStep, ...]) -> None:
    """Print what the feet did on soft ground, a row for each single support; nothing without."""
    if not steps:
        return
    table = Table(
        "step", "slip [mm]", "in the air [ms]", "on both feet [ms]", "depth [mm]", "friction"
    )
    for k, s in enumerate(steps, 1):
        slip, depth = f"{1e3 * max(s.slip):.2g}", f"{1e3 * s.depth:.2g}"
        flight, both = f"{1e3 * s.flight:.1f}", f"{1e3 * s.double_support:.1f}"
        table.add_row(f"{k}", slip, flight, both, depth, f"{s.friction_used:.3f}")
    console.print(table)
