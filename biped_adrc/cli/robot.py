"""`biped-adrc robot`: the robots that come with the package, and robots from a user's own URDF or MJCF.

`check` and `new` derive a biped from such a file (`model.robot_import.derive`): what the file does not say is
guessed, each guess is printed, and the model is checked against laws of mechanics. `check` takes a record
(robot.toml), too, in which nothing is guessed. `list` prints the records, `export` writes a robot for
MuJoCo's own viewer (`extras.mujoco.mjcf`).

n is the number of coordinates, p that of motors. A *law* is a law of mechanics by which `model.physical`
checks the model.

`target` checks the name of an output file, which may not be one of the files that the command reads (`inputs`).
FIGURES are the suffixes that figures may have.
A command's docstring is its help text; its arguments are described in options.toml. `sets` are texts NAME=VALUE
of --set.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import typer

import biped_adrc as ba
from biped_adrc.cli.app import FIGURES, ExitCode, console, errors, group, inputs, target
from biped_adrc.cli.options import options, scenario_from, with_sets
from biped_adrc.core.files import check_folder

if TYPE_CHECKING:
    from biped_adrc.model.robot_import.import_robot import Derived

robot_app = group("robot", "Show the robots there are, or bring one's own (URDF, MJCF).")


@robot_app.command("list")
@options("robot.list")
def robot_list(robot: str | None = None, preset: str | None = None) -> None:
    """List the robots of the package and all values of a scenario that --set takes; or describe one robot."""
    from biped_adrc.model.robots.robot_toml import load_description, robot_names

    if robot is not None:
        biped = ba.Biped.load(robot, preset)
        d = biped.description
        console.say(f"{d.name}, preset {biped.preset}: {d.preset(biped.preset).source}")
        _describe(biped)
        return
    rows = []
    for name in robot_names():
        d = load_description(name)
        for each in d.presets.values():
            default = " (default)" if each.name == d.default_preset else ""
            n, p = str(len(d.joints)), str(len(d.actuated))
            rows.append((name, each.name + default, n, p, each.source))
    console.table(("robot", "preset", "n", "p", "source"), rows)
    # all values of a scenario, a line each
    console.say("Values of a scenario, for --set NAME=VALUE: unit, default, range, what it is")
    for what in map(ba.Scenario.field_of, ba.Scenario.names()):
        default = "" if what.default in (None, {}) else f"{what.default}"
        words = ", ".join(x for x in (default, what.range_text) if x)
        console.say(f"  {what.name}{what.in_brackets}{f' ({words})' if words else ''}: {what.text}")
    console.say("A part takes its own parameters the same way, as controller.K_i=90000 of NPID.")


@robot_app.command("check")
@options("robot.own")
def robot_check(
    file: Path,
    feet: str | None = None,
    actuated: str | None = None,
    torque: float | None = None,
    sets: list[str] | None = None,
    plot: Path | None = None,
) -> None:
    """Read a URDF or MJCF as a biped, or a robot.toml: say what was read, assumed and left out, draw it, check
    the laws of mechanics.

    Exit code 0 when every law holds, 1 when one does not, 3 when the file is refused.
    """
    from biped_adrc.model.robot_import.import_robot import of_record

    plot = target(plot or Path(f"{file.stem}.png"), FIGURES, (file,))
    record = file.suffix == ".toml" and not any((feet, actuated, torque, sets))
    derived = of_record(file) if record else _derived(file, feet, actuated, torque, sets)
    _explain(derived)
    from biped_adrc.view.from_the_side.check_figure import check_figure

    console.draw(plot, check_figure(derived.biped))
    if derived.broken:
        for check in derived.broken:
            errors.say(f"error: {check}")
        raise typer.Exit(ExitCode.CHECK_FAILED)


@robot_app.command("new")
@options("robot.own")
def robot_new(
    file: Path,
    out: Path,
    feet: str | None = None,
    actuated: str | None = None,
    torque: float | None = None,
    sets: list[str] | None = None,
) -> None:
    """Write floating.urdf and robot.toml of a URDF or MJCF, for Biped.load("FOLDER/robot.toml")."""
    check_folder(out)
    # nothing is written for a model that breaks a law of mechanics
    derived = _derived(file, feet, actuated, torque, sets).sound()
    _explain(derived)
    console.written(derived.write(out))


@robot_app.command("export")
@options("robot.export")
def robot_export(
    robot: str, out: Path, gait: str | None = None, sets: list[str] | None = None
) -> None:
    """Write a robot with feet and motors on soft ground as MJCF, for MuJoCo's own viewer."""
    from biped_adrc.extras.mujoco.mjcf import write_mjcf
    from biped_adrc.extras.mujoco.plant import MuJoCoPlant
    from biped_adrc.model.ground import SoftGround

    path = target(out, (".xml",), inputs(robot, *(() if gait is None else (gait,))))
    s = scenario_from({"robot.name": robot}, sets)
    biped = ba.Biped.load(robot, s.robot.preset, s.hardware.friction)
    # g.own: fields of SoftGround beyond these three that --set names, such as foot_radius
    g = s.ground
    ground = SoftGround(g.friction, g.time_constant, g.damping_ratio, **g.own)
    start = None if gait is None else ba.load_gait(gait, biped)
    # slope [rad] of the scenario's ground, else of the gait's, else level
    slope = g.slope if g.slope is not None else start.slope if start else 0.0
    # start: the state of the gait that the file gets as a keyframe; h [s]: integration step
    console.written(write_mjcf(MuJoCoPlant(biped, ground, slope, h=g.engine_step), path, start))


# -- parts -----------------------------------------------------------------------------------------
def _derived(
    file: Path, feet: str | None, actuated: str | None, torque: float | None, sets: list[str] | None
) -> Derived:
    """The robot of `file`, with its notes and checks; what the options say of it is not guessed.

    feet, actuated: names of two links and of the joints with motors, between commas; torque [N m]: limit of
    every motor; sets: other fields of `Hints`. What is None is guessed.
    """
    from biped_adrc.model.robot_import.import_robot import Hints, derive

    links, joints = _names(feet), _names(actuated)
    return derive(file, with_sets(Hints, sets, feet=links, actuated=joints, torque=torque))


def _names(text: str | None) -> tuple[str, ...] | None:
    """The names between the commas of a text: () for an empty text (there are none), None for None (they will
    be guessed).
    """
    return None if text is None else tuple(filter(None, map(str.strip, text.split(","))))


def _explain(derived: Derived) -> None:
    """Print the robot, what was read, assumed and left out of its file, and whether each law holds."""
    _describe(derived.biped)
    for note in derived.notes:
        console.say(f"{note.kind:<8} {note.text}")
    for check in derived.checks:
        console.say(f"{'holds' if check.holds else 'BROKEN':<8} {check}")


def _describe(biped: ba.Biped) -> None:
    """Print n, p and mass; coordinates and their joints; the phase Theta; feet; section; limits of the joints,
    torque limit and friction; and the inertia of each link, about its COM.
    """
    d = biped.description
    console.say(f"n = {biped.n} coordinates, p = {biped.p} motors, {biped.mass:.6g} kg")
    # a coordinate that is no joint's angle is the absolute pitch of a link
    roles = dict.fromkeys(d.passive, "free") | dict.fromkeys(d.actuated, "motor")
    for i, joint in enumerate(d.joints, 1):
        console.say(f"  q{i} = {joint} ({roles.get(joint, 'absolute pitch')})")
    console.say(f"Theta = {d.theta}")
    feet = f"stance foot {d.stance_foot}, swing foot {d.swing_foot}"
    console.say(f"{feet}, hip {d.hip}, trunk {d.trunk}")
    console.say(f"section: foot strike, where the height of {d.swing_foot} comes down to zero")
    for j in biped.motor_joints[1]:  # of the first single support
        rate = f"{j.speed:g} rad/s" if j.speed < math.inf else "not stated"
        ends = "{:g} to {:g} rad".format(*j.range) if j.range[1] < math.inf else "not stated"
        console.say(f"  {j.name}: rate {rate}, range {ends}")
    limit = f"torque limit {d.peak_torque:g} N m, " if biped.p else ""
    console.say(f"{limit}friction {d.friction_coefficient:g}, gravity {d.gravity:g} m/s^2")
    for name, link in biped.tree.links.items():
        if link.inertial is not None:
            # inertia is (ixx, ixy, ixz, iyy, iyz, izz) of a URDF; motions are in the x-z plane
            mass, (x, _, z), iyy = link.inertial.mass, link.inertial.com, link.inertial.inertia[3]
            console.say(f"  {name}: {mass:.6g} kg, COM ({x:.6g}, {z:.6g}) m, iyy {iyy:.6g} kg m^2")
