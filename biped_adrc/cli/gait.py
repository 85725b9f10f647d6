"""`biped-adrc gait` for gaits that are there: published, recipe, show, export, import, zero.

Each command checks the name of its output first, then loads robot and gait and calls one function:
`gait.published` and `studies.gait_design` for the paper's gaits (a) and (b), `gait.exchange` for
files of other programs, `analysis.zero_report` for the zero dynamics. The commands that design
gaits are in `cli.design`.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from biped_adrc.cli.app import FIGURES, GAITS, console, gait_app, inputs, say, say_written
from biped_adrc.cli.options import texts
from biped_adrc.errors import InputError
from biped_adrc.files import keep_inputs, output_path

if TYPE_CHECKING:
    from biped_adrc.gait.gait import Gait


@gait_app.command("published")
@texts("gait.paper")
def gait_published(preset: str = "identified", out: Path | None = None) -> None:
    """Design gait (a): the constraint of least torque whose orbit passes through the published x*."""
    out = None if out is None else output_path(out, GAITS, default=True)
    from biped_adrc.gait.published import design_published_gait
    from biped_adrc.model.biped import Biped

    _save(design_published_gait(Biped.load("rabbit", preset)), out)


@gait_app.command("recipe")
@texts("gait.paper")
def gait_recipe(preset: str = "identified", out: Path | None = None) -> None:
    """Design gait (b): hip sine, inverse kinematics and polynomial regression, section IV."""
    out = None if out is None else output_path(out, GAITS, default=True)
    from biped_adrc.model.biped import Biped
    from biped_adrc.studies.gait_design import design_recipe_orbit

    _save(design_recipe_orbit(Biped.load("rabbit", preset)), out)


@gait_app.command("show")
@texts("gait.stored")
def gait_show(gait: str = "published", robot: str = "rabbit", preset: str | None = None) -> None:
    """Print a stored gait's provenance and its zero dynamics."""
    from biped_adrc.gait.gait import load_gait
    from biped_adrc.gait.zero_dynamics import ZeroDynamics
    from biped_adrc.model.biped import Biped

    biped = Biped.load(robot, preset)
    found = load_gait(gait, biped)
    for key, value in found.provenance.items():
        say(f"{key}: {value}")
    if (found.robot, found.preset) != (biped.description.name, biped.preset):
        console.print(
            f"of robot {found.robot}, preset {found.preset}; below with {biped.description.name}, "
            f"{biped.preset}"
        )
    zero = ZeroDynamics.of(biped, found.constraint)
    console.print(
        f"period {found.period:.6f} s, delta^2 {zero.delta**2:.6f}, slope {found.slope:g} rad"
    )


def _save(gait: Gait, out: Path | None, read: Iterable[Path] = ()) -> None:
    """Write a gait, by default under its own name, and say its period [s]; refuses to write over what
    was read.
    """
    path = out or Path(gait.file_name)
    keep_inputs((path,), read)
    gait.save(path)
    console.print(f"period {gait.period:.6f} s", highlight=False)
    say_written(path)


@gait_app.command("export")
@texts("gait.stored")
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
@texts("gait.import")
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
    out = None if out is None else output_path(out, GAITS, default=True)
    keep_inputs((out,) if out else (), read)
    biped, names = Biped.load(robot, preset), _pairs(name or [])
    _save(import_gait(file, biped, convention, names, slopes, degree, slope), out, read)


def _pairs(texts: list[str]) -> dict[str, str]:
    """{ours: theirs} of --name OURS=THEIRS. Raises InputError."""
    for text in texts:
        if not all(word.strip() for word in text.partition("=")):
            raise InputError(
                f"--name is '{text}', expected OURS=THEIRS, such as coefficients=R.alpha"
            )
    return {ours.strip(): theirs.strip() for ours, _, theirs in (t.partition("=") for t in texts)}


@gait_app.command("zero")
@texts("gait.stored")
def gait_zero(
    gait: str = "published",
    robot: str = "rabbit",
    preset: str | None = None,
    friction: float | None = None,
    torque: float | None = None,
    slope: float | None = None,
    plot: Path | None = None,
) -> None:
    """Say what the zero dynamics of a gait allow: orbit, stability, domain of attraction, speeds."""
    from biped_adrc.analysis.zero_report import zero_report
    from biped_adrc.gait.gait import load_gait
    from biped_adrc.gait.zero_domain import DomainLimits
    from biped_adrc.model.biped import Biped

    plot = None if plot is None else output_path(plot, FIGURES)
    biped = Biped.load(robot, preset)
    mu = biped.description.friction_coefficient if friction is None else friction
    found = load_gait(gait, biped)
    angle = found.slope if slope is None else slope
    report = zero_report(biped, found.constraint, DomainLimits(mu, torque, angle))
    say(report.text())
    if plot is not None:
        from biped_adrc.viz.plots.zero_dynamics import zero_dynamics_figure
        from biped_adrc.viz.style import write_figure

        write_figure(plot, zero_dynamics_figure(report))
        say_written(plot)
