"""`biped-adrc gait`: design, show, export, import.

Each command checks the name of its output first, then loads robot and gait and calls one function:
`analysis.gait_design`, which finds a gait by nonlinear optimisation with IPOPT and certifies it by
walking it; `gait.exchange` for files of other programs; `analysis.zero_report` for the zero dynamics.

A *library* is a folder of gaits, one per speed; a *family* (`gait.family`) is a smooth map from speed and step
length to gaits, in one file.

`target` checks the name of an output file, which may not be one of the files that the command reads (`inputs`).
FIGURES and GAITS are the suffixes that figures and gaits may have.
A command's docstring is its help text; its arguments are described in options.toml. `sets` are texts NAME=VALUE
of --set.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import biped_adrc as ba
from biped_adrc.cli.app import FIGURES, GAITS, command_line, console, group, inputs, target
from biped_adrc.cli.options import assignments, options, with_sets
from biped_adrc.core.errors import GaitError, InputError
from biped_adrc.core.files import check_folder
from biped_adrc.scenario.units import quantity

if TYPE_CHECKING:
    from biped_adrc.analysis.gait_design import DesignedGait
    from biped_adrc.gait.design.request import GaitRequest

gait_app = group("gait", "Design, show, import and export gaits.")


@gait_app.command("design")
@options("gait.design")
def gait_design(
    speed: float | None = None,
    step: float | None = None,
    speeds: str | None = None,
    steps: str | None = None,
    robot: str = "rabbit",
    preset: str | None = None,
    slope: float = 0.0,
    minimise: str = "torque",
    rough: str | None = None,
    sets: list[str] | None = None,
    out: Path | None = None,
) -> None:
    """Design a periodic, feasible, stable gait for a speed, a step, or both, and certify it by walking."""
    from biped_adrc.gait.design.request import GaitRequest, Objective

    # --set limits.NAME=VALUE sets a limit, any other NAME a field of the request
    of_limits = [text for text in sets or () if text.startswith("limits.")]
    others = [text for text in sets or () if text not in of_limits]
    limits = with_sets(ba.StepLimits, [text.removeprefix("limits.") for text in of_limits])
    if rough is not None:
        try:
            height = quantity(rough, "m")
        except ValueError as error:
            raise InputError(f"--rough: {error}") from None
        limits = replace(limits, rough=height)
    # --steps: a family; --speeds alone: a library; neither: one gait
    if steps is not None:
        if others:
            raise InputError(f"--set {others[0]}: a family takes limits, as limits.torque=100")
        own = limits if of_limits else None
        _family(ba.Biped.load(robot, preset), speeds, steps, own, limits.rough, out)
        return
    if speeds is None:
        out = target(out, GAITS, inputs(robot))
    elif speed is not None or step is not None:
        raise InputError("--speeds is given beside a --speed or a --step; give one of them")
    biped = ba.Biped.load(robot, preset)
    # request(speed=.., step=..) makes a request; --set may not name what is in `fixed`
    fixed: dict[str, Any] = {"slope": slope, "objective": Objective(minimise), "limits": limits}
    request = partial(with_sets, GaitRequest, others, **fixed)
    if speeds is not None:
        _library(biped, speeds, request, Path("gait-library") if out is None else out)
        return
    result = _design(biped, request(speed=speed, step=step))
    console.print(result.text(), highlight=False)
    path = out or Path(result.gait.file_name)
    result.gait.save(path)
    console.written(path)


def _design(biped: ba.Biped, request: GaitRequest) -> DesignedGait:
    """Design the gait of a request and certify it by walking; returns it with this command line in its
    provenance. Raises GaitError where there is none.
    """
    from biped_adrc.analysis.gait_design import certify
    from biped_adrc.gait.design.optimise import optimise

    with console.status(f"IPOPT designs a gait for {request.in_words()}"):
        result = certify(biped, request, optimise(biped, request))
    provenance = {**result.gait.provenance, "command": command_line()}
    return replace(result, gait=replace(result.gait, provenance=provenance))


def _library(biped: ba.Biped, speeds: str, request: Callable[..., GaitRequest], out: Path) -> None:
    """Design a gait for every speed, each from a cold start, store those that were found in the folder `out`,
    and print a table of them.

    speeds [m/s]: a text that `_numbers` reads. request: makes the request of a speed and a free step length.
    Raises GaitError at the end that names the speeds without a gait.
    """
    check_folder(out)
    rows, missed = [], []
    for speed in _numbers(speeds):
        try:
            result = _design(biped, request(speed=speed, step=None))
        except GaitError as error:
            missed.append(f"{speed:g} m/s: {error}")
            continue
        result.gait.save(out / result.gait.file_name)
        c = result.certificate  # forces and torques of a walking step of the gait
        # delta^2 [1]: factor from walking step to walking step of a deviation of the squared angular momentum
        forces, others = (c.peak_torque, c.friction), (result.multiplier, c.cost_of_transport)
        # in the order of `header`
        numbers = (result.speed, c.step_length, *forces, *others, result.seconds)
        rows.append([f"{x:.4g}" for x in numbers])
    if rows:
        header = "m/s", "step [m]", "torque [N m]", "friction", "delta^2", "transport", "s"
        console.table(header, rows)
        console.written(out)
    if missed:
        raise GaitError("; ".join(missed))


def _family(
    biped: ba.Biped,
    speeds: str | None,
    steps: str,
    limits: ba.StepLimits | None,
    rough: float,
    out: Path | None,
) -> None:
    """Design a gait for every pair of speed and step length, fit a family to them, and store it in a file.

    speeds [m/s], steps [m]: texts that `_numbers` reads. limits: None for RESERVE, which leaves room for steps
    from one gait of the family to another. rough [m]: height of the rough ground. out: None for family.json.
    Raises InputError without speeds.
    """
    from biped_adrc.analysis.family_design import RESERVE, design_family, library

    if speeds is None:
        raise InputError("--steps is given without --speeds; a family needs both")
    path = target(out or Path("family.json"), GAITS)
    kept = replace(limits or RESERVE, rough=rough)
    gaits = library(biped, _numbers(speeds), _numbers(steps), kept, done=console.say)
    with console.status("fitting the family"):
        # the package stores it as NAME-PRESET.json: the preset is no part of the family's name
        name = path.stem.removesuffix(f"-{biped.preset}")
        asked = {"limits": kept.of(biped).in_words(), "command": command_line()}
        family = design_family(name, biped, gaits, asked)
    family.save(path)
    console.written(path)


def _numbers(text: str) -> tuple[float, ...]:
    """Numbers from a text "0.4,0.5", or "0.4:1.1:0.1" for first:last:distance, the last one included where the
    distance leads to it. Raises InputError for any other text.
    """
    try:
        if ":" in text:
            first, last, by = (float(word) for word in text.split(":"))
            if not (by > 0.0 and last >= first):
                raise ValueError
            # 1e-9 and 9 digits: against round-off
            count = math.floor((last - first) / by + 1e-9) + 1
            return tuple(round(first + k * by, 9) for k in range(count))
        return tuple(float(word) for word in text.split(","))
    except ValueError:
        raise InputError(f"found '{text}', expected numbers as '0.4,0.5' or 0.4:1.1:0.1") from None


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
    from biped_adrc.gait.zero_domain import DomainLimits

    plot, biped = target(plot, FIGURES), ba.Biped.load(robot, preset)
    if gait is None:
        _list(biped)
        return
    result = ba.load_gait(gait, biped)
    _say_origin(result)
    console.print(f"period {result.period:.6f} s, slope {result.slope:g} rad", highlight=False)
    # limits of the domain of attraction, where --set has none
    usual = {"friction": biped.description.friction_coefficient, "slope": result.slope}
    report = ba.zero_report(biped, result.constraint, with_sets(DomainLimits, sets, usual))
    console.say(report.text())
    _say_rough(biped, result)
    if plot is not None:
        from biped_adrc.view.plots.zero_dynamics import zero_dynamics_figure

        console.draw(plot, zero_dynamics_figure(report))


def _say_rough(biped: ba.Biped, gait: ba.Gait) -> None:
    """Print how rough a ground the gait bears, continued and with ReferenceReset, or why that is not known."""
    from biped_adrc.gait.constraint import continued

    console.say("heights of steps that all sequences may have, with ReferenceReset:")
    try:
        law = ba.ReferenceReset(ba.NPDController(continued(gait.constraint)))
        console.say(ba.rough_ground(ba.Walker(biped, law), gait).text())
        for share in (-0.2, 0.2):  # of a trunk that the controller's model does not know
            plant = ba.ModelErrors(mass={biped.description.trunk: share}).apply(biped)
            walker = ba.Walker(plant, law, model=biped)
            reach = ba.rough_ground(walker, gait, forces=()).reach()
            console.say(f"H at {100.0 * share:+.0f} % of the trunk's mass  {reach}")
    except InputError as error:
        console.say(f"none: {error}")


def _say_origin(gait: ba.Gait) -> None:
    """Print the provenance of a gait, a line each: its origin, and what an import changed or left out."""
    for key, value in gait.provenance.items():
        console.say(f"{key}: {value}")


def _list(biped: ba.Biped) -> None:
    """Print a table of the stored gaits of a robot in its preset."""
    from biped_adrc.gait.gait import gait_names

    rows = []
    for name in gait_names(biped.description.name, biped.preset):
        result = ba.load_gait(name, biped)
        length = float(biped.swing_foot(result.q_minus)[0])  # horizontal, also on a slope
        numbers = (length / result.period, length, result.period, result.slope)
        rows.append((name, *(f"{x:.4g}" for x in numbers)))
    console.table(("gait", "speed [m/s]", "step [m]", "period [s]", "slope [rad]"), rows)


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
    path = target(out, (".json", ".mat"), inputs(robot, gait))
    biped = ba.Biped.load(robot, preset)
    ba.export_gait(ba.load_gait(gait, biped), path, convention, biped)
    console.written(path)


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
    """Import a gait, or fit one to samples of a step; check that its end is its start, and store it."""
    read = (file, *inputs(robot))
    out = target(out, GAITS, read)
    biped = ba.Biped.load(robot, preset)
    # names: our name of an entry -> the file's. slopes: whether dq/dTheta after an impact has to fit the gait.
    # degree, slope [rad]: of curves that are fitted to samples, and of the ground of these
    names = assignments(
        name, "--name", "OURS=THEIRS, such as coefficients=R.alpha or theta_minus=p(1)"
    )
    gait = ba.import_gait(file, biped, convention, names, slopes, degree, slope)
    # the default name is known only now, and has to be checked too
    path = target(out or Path(gait.file_name), GAITS, read)
    gait.save(path)
    _say_origin(gait)
    console.print(f"period {gait.period:.6f} s", highlight=False)
    console.written(path)
