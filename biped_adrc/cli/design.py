"""`biped-adrc gait design` and `gait library`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.status import Status
from rich.table import Table

from biped_adrc.cli.app import Robot, RobotPreset, console, gait_app
from biped_adrc.cli.output import GAITS, inputs, say_written
from biped_adrc.errors import GaitError, InputError
from biped_adrc.files import keep_inputs, output_path

if TYPE_CHECKING:
    from biped_adrc.gait.design.ipopt import Progress
    from biped_adrc.gait.design.request import StepLimits
    from biped_adrc.types import Array

Slope = Annotated[float, typer.Option(help="Of the ground [rad], positive downhill.")]
Minimise = Annotated[str, typer.Option(help="torque (squared), transport (cost of), or peak.")]
Degree = Annotated[int, typer.Option(help="Of the Bezier curves.")]
Nodes = Annotated[int, typer.Option(help="Gauss nodes at which the limits are kept.")]
Torque = Annotated[float | None, typer.Option(help="Limit of a motor [N m]; the robot's own.")]
Friction = Annotated[float | None, typer.Option(help="Limit of |F_T| / F_N; the robot's own.")]
ImpulseFriction = Annotated[
    float | None, typer.Option(help="The same of the impulse; as --friction. 'inf' for none.")
]
Clearance = Annotated[
    float,
    typer.Option(help="Swing foot in mid-step, share of the leg; 0 lets legs without knees scuff."),
]


@gait_app.command("design")
def gait_design(
    speed: Annotated[float | None, typer.Option(help="Along the ground [m/s].")] = None,
    step: Annotated[float | None, typer.Option(help="Distance between the feet [m].")] = None,
    through: Annotated[
        str | None,
        typer.Option(help="Pre-impact state instead: q-, q'- as 2 n numbers, comma separated."),
    ] = None,
    robot: Robot = "rabbit",
    preset: RobotPreset = None,
    slope: Slope = 0.0,
    minimise: Minimise = "torque",
    degree: Degree = 6,
    nodes: Nodes = 24,
    torque: Torque = None,
    friction: Friction = None,
    impulse_friction: ImpulseFriction = None,
    clearance: Clearance = 0.02,
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Where to write it (.json).")
    ] = None,
) -> None:
    """Design a periodic, feasible, stable gait for a speed, a step, or both, and certify it by walking."""
    from biped_adrc.model.biped import Biped
    from biped_adrc.studies.gait_design import design_gait

    out = None if out is None else output_path(out, GAITS, default=True)
    keep_inputs((out,) if out else (), inputs(robot))
    biped = Biped.load(robot, preset)
    limits = _limits(torque, friction, impulse_friction, clearance)
    with console.status("building the programme") as shown:
        found = design_gait(
            biped,
            speed,
            step,
            slope=slope,
            objective=minimise,
            through=None if through is None else _state(through, biped.n),
            degree=degree,
            nodes=nodes,
            limits=limits,
            progress=_progress(shown),
        )
    console.print(found.text(), highlight=False)
    path = out or Path(found.gait.file_name)
    found.gait.save(path)
    say_written(path)


@gait_app.command("library")
def gait_library(
    speeds: Annotated[
        str, typer.Option(help="[m/s], as 0.4,0.5 or FIRST:LAST:STEP.")
    ] = "0.4:1.1:0.1",
    robot: Robot = "rabbit",
    preset: RobotPreset = None,
    minimise: Minimise = "torque",
    out: Annotated[
        Path, typer.Option("--out", "-o", help="Folder for one .json file per speed.")
    ] = Path("gait-library"),
) -> None:
    """Design a gait for every speed, each from a cold start, and store those that were found."""
    from biped_adrc.model.biped import Biped
    from biped_adrc.studies.gait_design import design_gait, speeds_named

    biped = Biped.load(robot, preset)
    table = Table("m/s", "step [m]", "torque [N m]", "friction", "delta^2", "transport", "s")
    missed = []
    for speed in speeds_named(speeds):
        with console.status(f"{speed:g} m/s") as shown:
            try:
                found = design_gait(biped, speed, objective=minimise, progress=_progress(shown))
            except GaitError as error:
                missed.append(f"{speed:g} m/s: {error}")
                continue
        found.gait.save(out / found.gait.file_name)
        c = found.certificate
        table.add_row(
            f"{found.speed:.3f}",
            f"{c.step_length:.3f}",
            f"{c.peak_torque:.1f}",
            f"{c.friction:.2f}",
            f"{found.multiplier:.3f}",
            f"{c.cost_of_transport:.3f}",
            f"{found.seconds:.1f}",
        )
    if table.row_count:
        console.print(table)
        console.print(f"written to {out}")
    if missed:
        raise GaitError("; ".join(missed))


def _limits(
    torque: float | None, friction: float | None, impulse: float | None, clearance: float
) -> StepLimits:
    from biped_adrc.gait.design.request import StepLimits

    return StepLimits(friction, impulse, torque, clearance=clearance or None)


def _progress(shown: Status) -> Progress:
    def say(iteration: int, objective: float, missed: float) -> None:
        shown.update(f"iteration {iteration}, objective {objective:.4g}, missed by {missed:.1e}")

    return say


def _state(text: str, n: int) -> tuple[Array, Array]:
    """(q-, q'-) from 2 n numbers. Raises InputError."""
    import numpy as np

    try:
        values = np.array([float(word) for word in text.split(",")])
    except ValueError:
        values = np.zeros(0)
    if len(values) != 2 * n:
        raise InputError(
            f"--through is '{text}', expected {2 * n} numbers separated by commas: q- [rad], then q'- [rad/s]"
        )
    return values[:n], values[n:]
