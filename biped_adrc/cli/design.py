"""`biped-adrc gait design` and `gait library`: gaits found by optimisation.

Both call `studies.gait_design.design_gait`, which solves the programme with IPOPT and certifies the
gait by walking it; `library` repeats that for a range of speeds and stores each gait that was
found. The line that moves while IPOPT runs is fed by its iterations.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rich.status import Status
from rich.table import Table

from biped_adrc.cli.app import GAITS, console, gait_app, inputs, say_written
from biped_adrc.cli.options import texts
from biped_adrc.errors import GaitError, InputError
from biped_adrc.files import check_folder, keep_inputs, output_path

if TYPE_CHECKING:
    from biped_adrc.gait.design.ipopt import IpoptProgress
    from biped_adrc.types import Array


@gait_app.command("design")
@texts("gait.design")
def gait_design(
    speed: float | None = None,
    step: float | None = None,
    through: str | None = None,
    robot: str = "rabbit",
    preset: str | None = None,
    slope: float = 0.0,
    minimise: str = "torque",
    curve: str = "bezier",
    degree: int = 6,
    nodes: int = 24,
    torque: float | None = None,
    friction: float | None = None,
    impulse_friction: float | None = None,
    clearance: float = 0.02,
    out: Path | None = None,
) -> None:
    """Design a periodic, feasible, stable gait for a speed, a step, or both, and certify it by walking."""
    from biped_adrc.gait.design.request import StepLimits
    from biped_adrc.model.biped import Biped
    from biped_adrc.studies.gait_design import design_gait

    out = None if out is None else output_path(out, GAITS, default=True)
    keep_inputs((out,) if out else (), inputs(robot))
    biped = Biped.load(robot, preset)
    limits = StepLimits(friction, impulse_friction, torque, clearance=clearance or None)
    with console.status("building the programme") as shown:
        found = design_gait(
            biped,
            speed,
            step,
            slope=slope,
            objective=minimise,
            through=None if through is None else _state(through, biped.n),
            curve=curve,
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
@texts("gait.library")
def gait_library(
    speeds: str = "0.4:1.1:0.1",
    robot: str = "rabbit",
    preset: str | None = None,
    minimise: str = "torque",
    out: Path = Path("gait-library"),
) -> None:
    """Design a gait for every speed, each from a cold start, and store those that were found."""
    from biped_adrc.model.biped import Biped
    from biped_adrc.studies.gait_design import design_gait, speeds_named

    check_folder(out)
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


def _progress(shown: Status) -> IpoptProgress:
    """Shows the iterations of IPOPT: number, objective, and how far the constraints are missed."""

    def say(iteration: int, objective: float, missed: float) -> None:
        shown.update(f"iteration {iteration}, objective {objective:.4g}, missed by {missed:.1e}")

    return say


def _state(text: str, n: int) -> tuple[Array, Array]:
    """(q-, q'-), each (n,) [rad], [rad/s], from a text of 2 n numbers between commas.

    Raises InputError for what is no number, and for too many or too few.
    """
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
