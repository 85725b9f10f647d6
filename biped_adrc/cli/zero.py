"""`biped-adrc gait zero`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from biped_adrc.cli.app import Robot, RobotPreset, StoredGait, console, gait_app
from biped_adrc.cli.output import FIGURES, say_written
from biped_adrc.files import output_path, write_bytes


@gait_app.command("zero")
def gait_zero(
    gait: StoredGait = "published",
    robot: Robot = "rabbit",
    preset: RobotPreset = None,
    friction: Annotated[
        float | None, typer.Option(help="Largest |F_T| / F_N; of the robot's record if not given.")
    ] = None,
    torque: Annotated[
        float | None, typer.Option(help="Largest torque of a motor [N m]; none if not given.")
    ] = None,
    slope: Annotated[
        float | None, typer.Option(help="Of the ground [rad], positive downhill; the gait's own.")
    ] = None,
    plot: Annotated[
        Path | None, typer.Option("--plot", help="Draw it: where to write the .png or .svg.")
    ] = None,
) -> None:
    """Say what the zero dynamics of a gait allow: orbit, stability, domain of attraction, speeds."""
    from biped_adrc.analysis.zero_report import zero_report
    from biped_adrc.gait.gait import load_gait
    from biped_adrc.gait.zero_orbits import Limits
    from biped_adrc.model.biped import Biped

    plot = None if plot is None else output_path(plot, FIGURES)
    biped = Biped.load(robot, preset)
    mu = biped.description.friction_coefficient if friction is None else friction
    found = load_gait(gait, biped)
    angle = found.slope if slope is None else slope
    report = zero_report(biped, found.constraint, Limits(mu, torque, angle))
    console.print(report.text(), markup=False, highlight=False, soft_wrap=True)
    if plot is not None:
        from biped_adrc.viz.plots.zero_dynamics import zero_dynamics_figure
        from biped_adrc.viz.style import render

        kind = plot.suffix.lower().removeprefix(".")
        write_bytes(plot, render(zero_dynamics_figure(report), kind))
        say_written(plot)
