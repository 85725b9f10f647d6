"""`biped-adrc gait`."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any

import typer

from biped_adrc.cli.app import Preset, Robot, RobotPreset, StoredGait, console, gait_app
from biped_adrc.cli.output import GAITS, inputs, say_written
from biped_adrc.files import keep_inputs, output_path


@gait_app.command("published")
def gait_published(
    preset: Preset = "identified",
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Where to write it (.json).")
    ] = None,
) -> None:
    """Design gait (a): the constraint of least torque whose orbit passes through the published x*."""
    out = None if out is None else output_path(out, GAITS, default=True)
    from biped_adrc.gait.published import design_published_gait
    from biped_adrc.model.biped import Biped

    _save(design_published_gait(Biped.load("rabbit", preset)), out)


@gait_app.command("recipe")
def gait_recipe(
    preset: Preset = "identified",
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Where to write it (.json).")
    ] = None,
) -> None:
    """Design gait (b): hip sine, inverse kinematics and polynomial regression, section IV."""
    out = None if out is None else output_path(out, GAITS, default=True)
    from biped_adrc.model.biped import Biped
    from biped_adrc.studies.gait_design import design_recipe_orbit

    _save(design_recipe_orbit(Biped.load("rabbit", preset)), out)


@gait_app.command("show")
def gait_show(
    gait: StoredGait = "published",
    robot: Robot = "rabbit",
    preset: RobotPreset = None,
) -> None:
    """Print a stored gait's provenance and its zero dynamics."""
    from biped_adrc.gait.gait import load_gait
    from biped_adrc.gait.zero_dynamics import ZeroDynamics
    from biped_adrc.model.biped import Biped

    biped = Biped.load(robot, preset)
    found = load_gait(gait, biped)
    for key, value in found.provenance.items():
        console.print(f"{key}: {value}", markup=False, highlight=False, soft_wrap=True)
    if (found.robot, found.preset) != (biped.description.name, biped.preset):
        console.print(
            f"of robot {found.robot}, preset {found.preset}; below with {biped.description.name}, "
            f"{biped.preset}"
        )
    zero = ZeroDynamics.of(biped, found.constraint)
    console.print(
        f"period {found.period:.6f} s, delta^2 {zero.delta**2:.6f}, slope {found.slope:g} rad"
    )


def _save(gait: Any, out: Path | None, read: Iterable[Path] = ()) -> None:
    path = out or Path(gait.file_name)
    keep_inputs((path,), read)
    gait.save(path)
    console.print(f"period {gait.period:.6f} s", highlight=False)
    say_written(path)


@gait_app.command("export")
def gait_export(
    gait: StoredGait,
    out: Annotated[Path, typer.Option("--out", "-o", help="Where to write it (.mat or .json).")],
    robot: Robot = "rabbit",
    preset: RobotPreset = None,
    convention: Annotated[
        str, typer.Option(help="Angle convention: paper, tac2003, frost or optimtraj.")
    ] = "paper",
) -> None:
    """Write a gait for MATLAB or as JSON, in any angle convention."""
    from biped_adrc.gait.exchange.importing import export_gait
    from biped_adrc.gait.gait import load_gait
    from biped_adrc.model.biped import Biped

    path = output_path(out, (".json", ".mat"), default=True)
    keep_inputs((path,), inputs(robot, gait))
    export_gait(load_gait(gait, Biped.load(robot, preset)), path, convention)
    say_written(path)


@gait_app.command("import")
def gait_import(
    file: Annotated[Path, typer.Argument(help="A gait as .mat or .json.")],
    robot: Robot = "rabbit",
    preset: RobotPreset = None,
    convention: Annotated[
        str | None, typer.Option(help="Angle convention, of a file that does not say its own.")
    ] = None,
    slopes: Annotated[
        bool, typer.Option(help="Ask that the slopes close through the impact.")
    ] = True,
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Where to write it (.json).")
    ] = None,
) -> None:
    """Bring along a gait: check that it closes, store it in this paper's convention."""
    from biped_adrc.gait.exchange.importing import import_gait
    from biped_adrc.model.biped import Biped

    read = (file, *inputs(robot))
    out = None if out is None else output_path(out, GAITS, default=True)
    keep_inputs((out,) if out else (), read)
    _save(import_gait(file, Biped.load(robot, preset), convention, slopes=slopes), out, read)
