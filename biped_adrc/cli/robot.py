"""`biped-adrc robot`: the robots that come with the package, and robots from a user's own URDF.

`check` and `new` derive a biped from a URDF (`robot_import.derive`): what the file does not say is
guessed, each guess is printed, and the model is checked against laws of mechanics. `list` and
`show` print the records (robot.toml), `export` writes a robot for MuJoCo's own viewer (`soft.mjcf`).
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer
from rich.table import Table

from biped_adrc.cli.app import (
    EXIT_CHECK_FAILED,
    app,
    complain,
    console,
    inputs,
    say,
    say_written,
)
from biped_adrc.cli.options import texts
from biped_adrc.errors import InputError, ModelError
from biped_adrc.files import check_folder, keep_inputs, output_path
from biped_adrc.robots.robot_toml import GRAVITY

if TYPE_CHECKING:
    from biped_adrc.model.biped import Biped
    from biped_adrc.robot_import.import_robot import Derived, Hints

robot_app = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode=None,
    help="Show the robots there are, or bring one's own from a URDF.",
)
app.add_typer(robot_app, name="robot")


@robot_app.command("check")
@texts("robot.own")
def robot_check(
    file: Path,
    feet: str | None = None,
    actuated: str | None = None,
    hip: str | None = None,
    torque: float | None = None,
    friction: float | None = None,
    armature: float = 0.0,
    gravity: float = GRAVITY,
    tip: str | None = None,
) -> None:
    """Read a URDF as a biped: say what was guessed, and check it against the laws of mechanics.

    Exit code 0 when every law holds, 1 when one does not, 3 when the URDF is refused.
    """
    from biped_adrc.robot_import.import_robot import derive

    derived = derive(file, _hints(feet, actuated, hip, torque, friction, armature, gravity, tip))
    _explain(derived)
    if derived.broken:
        for check in derived.broken:
            complain(f"error: {check}")
        raise typer.Exit(EXIT_CHECK_FAILED)


@robot_app.command("new")
@texts("robot.own")
def robot_new(
    file: Path,
    out: Path,
    feet: str | None = None,
    actuated: str | None = None,
    hip: str | None = None,
    torque: float | None = None,
    friction: float | None = None,
    armature: float = 0.0,
    gravity: float = GRAVITY,
    tip: str | None = None,
) -> None:
    """Write floating.urdf and robot.toml of a URDF, for Biped.load("FOLDER/robot.toml")."""
    from biped_adrc.robot_import.import_robot import derive

    check_folder(out)
    derived = derive(file, _hints(feet, actuated, hip, torque, friction, armature, gravity, tip))
    if derived.broken:
        raise ModelError(f"URDF '{file}': {'; '.join(map(str, derived.broken))}")
    record = derived.write(out)
    _explain(derived)
    say(f"written to {record}")


@robot_app.command("list")
def robot_list() -> None:
    """The robots that come with the package: presets, coordinates n, motors p, sources."""
    from biped_adrc.robots.robot_toml import load_description, robot_names

    table = Table("robot", "preset", "n", "p", "source")
    for name in robot_names():
        d = load_description(name)
        for preset in d.presets.values():
            default = " (default)" if preset.name == d.default_preset else ""
            n, p = str(len(d.joints)), str(len(d.actuated))
            table.add_row(name, preset.name + default, n, p, preset.source)
    console.print(table)


@robot_app.command("show")
@texts("robot.show")
def robot_show(robot: str, preset: str | None = None) -> None:
    """Print what the record of a robot says, and its masses."""
    from biped_adrc.model.biped import Biped

    biped = Biped.load(robot, preset)
    d = biped.description
    say(f"{d.name}, preset {biped.preset}: {d.preset(biped.preset).source}")
    _describe(biped)


@robot_app.command("export")
@texts("robot.export")
def robot_export(
    robot: str,
    mjcf: Path,
    preset: str | None = None,
    joint_friction: bool = False,
    friction: float = 0.6,
    time_constant: float = 2e-3,
    foot_radius: float = 1e-3,
    slope: float = 0.0,
    gait: str | None = None,
) -> None:
    """Write a robot with feet and motors on soft ground as MJCF, for MuJoCo's own viewer."""
    from biped_adrc.gait.gait import load_gait
    from biped_adrc.model.biped import Biped
    from biped_adrc.soft.ground import SoftGround
    from biped_adrc.soft.mjcf import write_mjcf
    from biped_adrc.soft.mujoco_plant import MuJoCoPlant

    path = output_path(mjcf, (".xml",), default=True)
    keep_inputs((path,), inputs(robot, *(() if gait is None else (gait,))))
    biped = Biped.load(robot, preset, joint_friction)
    ground = SoftGround(friction, time_constant, foot_radius=foot_radius)
    start = None if gait is None else load_gait(gait, biped)
    plant = MuJoCoPlant(biped, ground, slope, h=min(MuJoCoPlant.h, 0.1 * time_constant))
    say_written(write_mjcf(plant, path, start))


# -- parts -----------------------------------------------------------------------------------------
def _hints(
    feet: str | None,
    actuated: str | None,
    hip: str | None,
    torque: float | None,
    friction: float | None,
    armature: float,
    gravity: float,
    tip: str | None,
) -> Hints:
    """What the options say about the robot, so that it need not be guessed."""
    from biped_adrc.robot_import.import_robot import Hints

    place = None if tip is None else _place(tip)
    given = {"armature": armature, "gravity": gravity, "tip": place}
    return Hints(_names(feet), _names(actuated), hip, torque, friction, **given)  # type: ignore[arg-type]


def _place(text: str) -> tuple[float, float, float]:
    """Three numbers x, y, z [m] between commas. Raises InputError."""
    try:
        x, y, z = (float(word) for word in text.split(","))
    except ValueError as error:
        raise InputError(f"--tip {text}: expected three numbers x,y,z [m], as 0,0,0.4") from error
    return x, y, z


def _names(text: str | None) -> tuple[str, ...] | None:
    """Names between commas; an empty text is no name, None leaves them to be guessed."""
    if text is None:
        return None
    return tuple(name.strip() for name in text.split(",") if name.strip())


def _explain(derived: Derived) -> None:
    """Print the robot, what was guessed about it, and whether each law holds."""
    _describe(derived.biped)
    for sentence in derived.said:
        say(f"guessed  {sentence}")
    for check in derived.checks:
        say(f"{'holds' if check.holds else 'BROKEN':<8} {check}")


def _describe(biped: Biped) -> None:
    """Print coordinates and their joints, Theta, feet, section, limits, and mass and inertia of the links."""
    d = biped.description
    say(f"n = {biped.n} coordinates, p = {biped.p} motors, {biped.mass:.6g} kg")
    for i, joint in enumerate(d.joints):
        role = (
            "motor" if joint in d.actuated else "free" if joint in d.passive else "absolute pitch"
        )
        say(f"  q{i + 1} = {joint} ({role})")
    terms = " ".join(f"{c:+.6g} q{i + 1}" for i, c in enumerate(d.phase) if c != 0.0)
    say(f"Theta = {terms}")
    say(f"stance foot {d.stance_foot}, swing foot {d.swing_foot}, hip {d.hip}, trunk {d.trunk}")
    say(f"section: foot strike, where the height of {d.swing_foot} comes down to zero")
    limit = f"torque limit {d.peak_torque:g} N m, " if biped.p else ""
    say(f"{limit}friction {d.friction_coefficient:g}, gravity {d.gravity:g} m/s^2")
    for name, link in biped.tree.links.items():
        if link.inertial is not None:
            mass, (x, _, z), iyy = link.inertial.mass, link.inertial.com, link.inertial.inertia[3]
            say(f"  {name}: {mass:.6g} kg, COM ({x:.6g}, {z:.6g}) m, iyy {iyy:.6g} kg m^2")
