"""`biped-adrc gait` for gaits that are there: show, export, import.

Each command checks the name of its output first, then loads robot and gait and calls one function:
`gait.exchange` for files of other programs, `analysis.zero_report` for the zero dynamics. Gaits are
designed in `cli.design`.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rich.table import Table

from biped_adrc.cli.app import FIGURES, GAITS, console, gait_app, inputs, say, say_written, target
from biped_adrc.cli.options import options, pairs, with_sets
from biped_adrc.core.files import keep_inputs, output_path

if TYPE_CHECKING:
    from biped_adrc.gait.gait import Gait
    from biped_adrc.model.biped import Biped


@gait_app.command("show")
@options("gait.show")
def gait_show(
    gait: str | None = None,
    robot: str = "rabbit",
    preset: str | None = None,
    plot: Path | None = None,
    sets: list[str] | None = None,
) -> None:
    """List the gaits of a robot, or say what one is and what its zero dynamics allow."""
    from biped_adrc.gait.gait import load_gait
    from biped_adrc.model.biped import Biped

    plot = None if plot is None else output_path(plot, FIGURES)
    biped = Biped.load(robot, preset)
    if gait is None:
        _list(biped)
        return
    result = load_gait(gait, biped)
    for key, value in result.provenance.items():
        say(f"{key}: {value}")
    console.print(f"period {result.period:.6f} s, slope {result.slope:g} rad", highlight=False)
    _print_zero(biped, result, plot, sets)


def _list(biped: Biped) -> None:
    """Print the stored gaits of a robot in its preset."""
    from biped_adrc.gait.gait import gait_names, load_gait

    table = Table("gait", "speed [m/s]", "step [m]", "period [s]", "slope [rad]")
    for name in gait_names(biped.description.name, biped.preset):
        result = load_gait(name, biped)
        length = float(biped.swing_foot(result.q_minus)[0])
        numbers = (length / result.period, length, result.period, result.slope)
        table.add_row(name, *(f"{x:.4g}" for x in numbers))
    console.print(table)


def _print_zero(biped: Biped, found: Gait, plot: Path | None, sets: list[str] | None) -> None:
    """Print what the zero dynamics of a gait allow, and draw it where `plot` says."""
    from biped_adrc.analysis.zero_report import zero_report
    from biped_adrc.gait.zero_domain import DomainLimits

    usual = {"friction": biped.description.friction_coefficient, "slope": found.slope}
    report = zero_report(biped, found.constraint, with_sets(DomainLimits, sets, usual))
    say(report.text())
    if plot is not None:
        from biped_adrc.view.plots.zero_dynamics import zero_dynamics_figure
        from biped_adrc.view.style import write_figure

        write_figure(plot, zero_dynamics_figure(report))
        say_written(plot)


@gait_app.command("export")
@options("gait.export")
def gait_export(
    gait: str,
    out: Path,
    robot: str = "rabbit",
    preset: str | None = None,
    convention: str = "paper",
) -> None:
    """Write a gait for MATLAB or as JSON, in any angle convention."""
    from biped_adrc.gait.exchange.importing import export_gait
    from biped_adrc.gait.gait import load_gait
    from biped_adrc.model.biped import Biped

    path = output_path(out, (".json", ".mat"), default=True)
    keep_inputs((path,), inputs(robot, gait))
    biped = Biped.load(robot, preset)
    export_gait(load_gait(gait, biped), path, convention, biped)
    say_written(path)


@gait_app.command("import")
@options("gait.import")
def gait_import(
    file: Path,
    robot: str = "rabbit",
    preset: str | None = None,
    convention: str | None = None,
    name: list[str] | None = None,
    slopes: bool = True,
    degree: int = 6,
    slope: float = 0.0,
    out: Path | None = None,
) -> None:
    """Bring along a gait, or fit one to samples of a step; check that it closes, and store it for the robot."""
    from biped_adrc.gait.exchange.importing import import_gait
    from biped_adrc.model.biped import Biped

    read = (file, *inputs(robot))
    out = target(out, GAITS, read)
    biped = Biped.load(robot, preset)
    names = pairs(name, "--name", "OURS=THEIRS, such as coefficients=R.alpha")
    gait = import_gait(file, biped, convention, names, slopes, degree, slope)
    path = out or Path(gait.file_name)
    keep_inputs((path,), read)
    gait.save(path)
    console.print(f"period {gait.period:.6f} s", highlight=False)
    say_written(path)
