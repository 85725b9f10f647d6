"""A robot from one URDF: everything its record robot.toml says, derived and checked.

    derived = derive("walker.urdf")
    derived.biped    the Biped, with the masses of the URDF as its preset "urdf"
    derived.notes    what was read, assumed and left out, in sentences
    derived.checks   the laws it was checked against, with their numbers

The URDF describes a planar biped with point feet: revolute joints about y, equal legs, each with a
link at its tip. Frames may be turned, angles may run either way; q keeps the file's zeros and
senses. The section of the return map is the impact, where the height of the swing foot is zero; it
follows from the feet.

The way of `derive`, each stage raising ModelError with what to change in the file:

    urdf_reader.read      links and joints, frames turned parallel at zero angles
    on_planar_base        joints in the plane x-z, base (x, z, pitch) found or added
    on_feet               feet that are points, legs that hang from a trunk
    evened                the mean of legs that differ by less than 1 %
    anatomy               hip, order of the joints, phase variable (the angle that times a gait)
    drawable              shapes to draw, balls where there are none
    _motors, _torque      joints with a motor, and their torque limit
    record_of             the robot.toml, from which the Biped is made
    checks                laws of mechanics, with numbers

The trunk is the link that the base carries, the torso. The legs exchange their roles at an impact, so they have
to be alike; two links or joints that change over are twins. A note is a sentence for the user, of the kind
"read", "assumed" or "left out".

The record uses the words of a robot.toml, and is written as TOML by `to_toml`: `tomllib` reads and
does not write. Strings, numbers, lists and tables are all a record holds, and JSON's strings are
basic strings of TOML.

A robot whose URDF has no shape that can be drawn gets rows of balls, from the origin of a link to every
joint below it, or to its COM where nothing lies below. At every COM lies a ball of steel with the mass of
the body, r = (3 m / (4 pi rho))^(1/3).
"""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self

import numpy as np

from biped_adrc.core.errors import ModelError, OutputError
from biped_adrc.core.files import reading, toml_key, toml_value, write_text
from biped_adrc.core.verdict import Check
from biped_adrc.model.biped import Biped
from biped_adrc.model.physical import physical_checks
from biped_adrc.model.robot_import.anatomy import Anatomy, anatomy, on_feet
from biped_adrc.model.robot_import.base import PlanarBase, on_planar_base
from biped_adrc.model.robot_import.mjcf import read_mjcf
from biped_adrc.model.robots import urdf
from biped_adrc.model.robots.robot_toml import GRAVITY, Names, Rotors, description_of
from biped_adrc.model.robots.urdf import Joint, Link, Note, Notes, Tree, Visual, vector
from biped_adrc.model.robots.urdf_reader import Contents, read

Joints = tuple[Joint, ...]


def drawable(tree: Tree, feet: tuple[str, str]) -> tuple[Tree, Notes]:
    """The tree itself where any link has a shape, else the tree with rods and balls to draw, and a note on it.

    Links of the stance leg, the swing leg and the trunk get different colours.
    """
    if any(link.visuals for link in tree.links.values()):
        return tree, ()
    one, other = ({joint.child for joint in tree.path_to_root(foot)} for foot in feet)
    # red, green, blue, opacity of the links of the trunk, which carry both feet or none, and of either leg
    colours = dict.fromkeys(tree.links, (0.35, 0.35, 0.4, 1.0))
    colours |= dict.fromkeys(one - other, (0.0, 0.45, 0.7, 1.0))
    colours |= dict.fromkeys(other - one, (0.84, 0.37, 0.0, 1.0))
    links = {k: replace(x, visuals=_shapes(tree, x, colours[k])) for k, x in tree.links.items()}
    text = "shapes: none were read that can be drawn, so rods and balls are drawn instead"
    return replace(tree, links=links), (Note("assumed", text),)


def _shapes(tree: Tree, link: Link, rgba: tuple[float, float, float, float]) -> tuple[Visual, ...]:
    """Rods from the link's origin to the joints below it, or else to its COM, and a ball of steel at the COM.

    A rod is a cylinder along z, and in another direction a row of balls, since cylinders stand upright here.
    """
    # where rods end [m]; a joint at the link's own origin needs none
    ends = [joint.origin for joint in tree.joints_below(link.name) if any(joint.origin)]
    balls: list[Visual] = []
    if link.inertial is not None:
        com = link.inertial.com
        # 7800 kg/m^3: steel
        radius = (3.0 * link.inertial.mass / (4.0 * math.pi * 7800.0)) ** (1.0 / 3.0)
        balls = [Visual("sphere", (radius,), com, rgba)]
        ends = ends or [com]
    for end in ends:
        # radius: a share of the rod's length; shares: places of the balls of a rod, from its start to its end
        radius, shares = 0.04 * math.hypot(*end), np.linspace(0.0, 1.0, 13).tolist()
        x, y, z = end
        if z and not x and not y:
            balls.append(Visual("cylinder", (radius, abs(z)), (0.0, 0.0, 0.5 * z), rgba))
        elif radius:  # it is 0 where the COM, the end of the rod, is the origin
            balls += [Visual("sphere", (radius,), (s * x, s * y, s * z), rgba) for s in shares]
    return tuple(balls)


PRESET = "urdf"
"""Name of the preset that holds the masses of the URDF."""
FRICTION = 0.6
"""Dry friction mu of the feet [1] if the user states none: that of RABBIT."""


@dataclass(frozen=True)
class Hints:
    """Properties that a URDF does not contain. What is None is guessed, if the file leaves only one answer."""

    feet: tuple[str, ...] | None = None
    """Links of the stance and the swing foot."""
    actuated: tuple[str, ...] | None = None
    """Joints with a motor, q1, q2, ... in order."""
    hip: str | None = None
    """Link whose origin is the hip."""
    torque: float | None = None
    """Torque limit of every motor [N m]."""
    friction_coefficient: float | None = None
    """Dry friction mu of the feet, dimensionless."""
    armature: float | None = None
    """Rotor inertia per motor, reflected to the joint [kg m^2]; None for that of the file."""
    gravity: float = GRAVITY
    """Gravity [m/s^2]."""
    tip: tuple[float, ...] | None = None
    """Place (3,) of the feet in the frames of the links `feet` [m], for a URDF that ends with its shins; or
    (6,), of the stance foot, then of the swing foot."""


def _record_of(
    file: str, contents: Contents, body: PlanarBase, parts: Anatomy, hints: Hints, rotors: Rotors
) -> dict[str, Any]:
    """The tables of the robot.toml that describes this robot, as plain values.

    file: name of the URDF. contents: of that file. body: the robot on its base. parts: feet, hip, joints,
    phase. hints: of the user, with motors and torque limit filled in. rotors: inertia of the motors' rotors,
    reflected to their joints [kg m^2].
    """
    moving, actuated = [joint.name for joint in parts.moving], hints.actuated or ()
    friction = FRICTION if hints.friction_coefficient is None else hints.friction_coefficient

    def of_moving(values: Mapping[str, Any]) -> dict[str, Any]:
        """The values of the joints that move, in the order of q; an ankle may have been made a fixed joint."""
        return {name: values[name] for name in moving if name in values}

    return {
        "name": contents.tree.name,
        "urdf": file,
        "default_preset": PRESET,
        "actuated": list(actuated),
        "passive": [name for name in moving if name not in actuated],
        "unactuated": body.pitch,
        "base": list(body.base),
        "stance_foot": parts.feet[0],
        "swing_foot": parts.feet[1],
        "hip": parts.hip,
        "trunk": body.trunk,
        "phase": list(parts.phase),
        "peak_torque": hints.torque,
        "friction_coefficient": friction,
        "gravity": hints.gravity,
        "ranges": {j.name: list(j.range) for j in parts.moving if math.isfinite(j.range[0])},
        "friction": {"viscous": of_moving(contents.viscous), "static": of_moving(contents.static)},
        "links": _bodies(body.tree, parts.feet),
        "presets": {PRESET: {"source": f"The masses of {file}.", "armature": rotors}},
    }


def _bodies(tree: Tree, feet: tuple[str, str]) -> dict[str, list[str]]:
    """Names of the links with mass by body: twins are one body, with their name without left or right.

    Where that name is empty, or another body or link has it, the body has the name of the link in the stance
    leg.
    """
    twins = dict(urdf.pairs(tree, feet))
    # links with mass; of twins the second one is in the body of the first
    heavy = [name for name, link in tree.links.items() if link.inertial is not None]
    bodies: dict[str, list[str]] = {}
    for link in (x for x in heavy if x not in twins.values()):  # none of the swing leg
        group = [link, twins[link]] if link in twins else [link]
        # side: the part of a link's name that says left or right
        side = r"(^|[_-])(left|right|l|r)(?=$|[_-])"
        name = re.sub(side, "", link, flags=re.IGNORECASE).strip("_-") if link in twins else link
        occupied = not name or name in bodies or (name in heavy and name not in group)
        bodies[link if occupied else name] = group
    return bodies


def to_toml(record: Mapping[str, object]) -> str:
    """TOML text of `record`, one line for each key; a table is written inline."""
    return "".join(f"{toml_key(key)} = {toml_value(value)}\n" for key, value in record.items())


@dataclass(frozen=True)
class Derived:
    """A biped derived from a URDF, with the notes and checks of the derivation."""

    biped: Biped
    notes: Notes
    """Sentences on what was read, assumed and left out, in this order."""
    checks: tuple[Check, ...]
    """The laws of `model.physical`, each with its relative gap, and whether it holds."""
    record: Mapping[str, Any]
    """Content of its robot.toml."""

    @property
    def broken(self) -> tuple[Check, ...]:
        """The checks of laws that do not hold; empty for a robot that can be used."""
        return tuple(check for check in self.checks if not check.holds)

    def sound(self) -> Self:
        """The same robot. Raises ModelError, with the laws that do not hold."""
        if self.broken:
            raise ModelError(f"'{self.biped.tree.source}': {'; '.join(map(str, self.broken))}")
        return self

    def write(self, folder: Path | str) -> Path:
        """Write floating.urdf and robot.toml for `Biped.load` into a folder; returns the path of robot.toml.

        Raises OutputError where one of them exists already or cannot be written.
        """
        folder = Path(folder)
        model, record = folder / "floating.urdf", folder / "robot.toml"
        if there := [str(path) for path in (model, record) if path.exists()]:
            raise OutputError(f"{there} exist already; give a new folder, or remove them first")
        write_text(model, urdf.to_xml(self.biped.tree))
        write_text(record, to_toml({**self.record, "urdf": model.name}))
        return record


def of_record(path: Path | str) -> Derived:
    """The robot of a robot.toml, in its default preset, with the checks of the laws."""
    biped = Biped.load(str(path))
    return Derived(biped, (), physical_checks(biped), {})


def biped_from_urdf(
    path: Path | str,
    feet: tuple[str, str] | None = None,
    actuated: tuple[str, ...] | None = None,
    hip: str | None = None,
    torque: float | None = None,
    armature: float | None = None,
    tip: tuple[float, ...] | None = None,
) -> Biped:
    """Make the Biped of a URDF, if every check holds; see `Hints` for the options and `derive` for the rest.

    path: of the URDF. feet: links of the feet, stance first. actuated: joints with a motor, q1 first. hip: link
    whose origin is the hip. torque [N m]: limit of every motor. armature [kg m^2]: inertia of the rotor on
    every joint with a motor. tip (3,) or (6,) [m]: place of both feet, or of one after the other, in the frames
    of the links `feet`. None: found in the file. Raises ModelError, with the laws that do not hold.

    >>> ba.biped_from_urdf(biped.description.urdf).n
    5
    """
    hints = Hints(feet, actuated, hip, torque, armature=armature, tip=tip)
    return derive(path, hints).sound().biped


def derive(path: Path | str, hints: Hints | None = None) -> Derived:
    """Derive a biped from a URDF or MJCF and check it, in the stages of the module. Laws that do not hold raise
    nothing here: they are in `Derived.broken`. hints: what the user states; None is nothing.

    Raises ModelError that names the link, joint or file, and what to give or to change.
    """
    hints = Hints() if hints is None else hints
    contents, feet = _with_tips(path, hints)
    body, pair = on_feet(on_planar_base(contents.tree), feet, hints.actuated or ())
    # names that begin with of_ are notes on a stage
    tree, of_legs = urdf.evened(body.tree, pair)
    body = replace(body, tree=tree).noting(*of_legs)
    parts = anatomy(body, pair, hints.hip)
    tree, of_shapes = drawable(body.tree, pair)
    actuated, of_motors = _motors(contents, parts.moving, hints)
    torque, of_torque = _torque(contents, actuated, hints)
    rotors, of_rotors = _armature(contents, actuated, hints)
    # known: the hints, with motors and torque limit filled in
    path, known = Path(path), replace(hints, actuated=actuated, torque=torque)
    record = _record_of(path.name, contents, body, parts, known, rotors)
    description = description_of(record, path)
    biped = Biped(description, tree, PRESET, description.preset().armature).check()
    notes = (*body.notes, *parts.notes, *of_motors, *of_torque, *of_rotors, *of_shapes)
    # _remarks: notes on friction
    notes += (*contents.notes, *_remarks(contents, parts.moving, hints))
    order = ("read", "assumed", "left out")
    ordered = tuple(sorted(notes, key=lambda note: order.index(note.kind)))
    return Derived(biped, ordered, physical_checks(biped), record)


def _with_tips(path: Path | str, hints: Hints) -> tuple[Contents, tuple[str, ...] | None]:
    """Read the file; also returns the names of the feet, (stance, swing): those of the hints (None to guess
    them), or where the hints have a `tip` new links without mass at this place. Raises ModelError.
    """
    contents, feet = _contents(Path(path)), hints.feet
    if hints.tip is None:
        return contents, feet
    if feet is None or not set(feet) <= set(contents.tree.links):
        raise ModelError(
            f"'{path}': give the links with this tip by feet=(...) or --feet, found {feet}, the links "
            f"are {list(contents.tree.links)}"
        )
    if len(hints.tip) not in (3, 6) or not all(map(math.isfinite, hints.tip)):
        raise ModelError(
            f"tip={hints.tip}, expected x, y, z of both feet or of one after the other"
        )
    tree, tips = contents.tree, []
    # np.resize repeats three numbers for the second foot; place is in the axes that the link has in the file
    for foot, place in zip(feet, np.resize(hints.tip, (len(feet), 3)), strict=True):
        tree, tip = urdf.with_tip(tree, foot, vector(contents.turns[foot] @ place))
        tips.append(tip)
    return replace(contents, tree=tree), tuple(tips)


def _contents(path: Path) -> Contents:
    """Read a file as an MJCF if <mujoco> comes first in it, else as a URDF. Raises ModelError."""
    with reading("file of a robot", path, ModelError):
        first = re.search(rb"<(robot|mujoco)\b", path.read_bytes())
    return read_mjcf(path) if first and first[1] == b"mujoco" else read(path)


# -- motors ----------------------------------------------------------------------------------------
def _motors(contents: Contents, moving: Joints, hints: Hints) -> tuple[Names, Notes]:
    """Names of the joints with a motor, q1, q2, ..., and a note where they were guessed.

    moving: all joints but the pitch, in order. The guess is all of them but those whose <limit effort> is 0.
    Raises ModelError for unknown or doubled names.
    """
    names = tuple(joint.name for joint in moving)
    if hints.actuated is None:
        result = tuple(name for name in names if contents.effort.get(name) != 0.0)
        free = ", ".join(f"'{name}'" for name in names if name not in result)
        motors = ", ".join(f"q{i + 1} = '{name}'" for i, name in enumerate(result)) or "none"
        text = f"motors: {motors}" + (f"; {free} free (effort 0)" if free else "")
        return result, (Note("assumed", text),)
    if len(set(hints.actuated) & set(names)) < len(hints.actuated):  # a name is unknown or doubled
        raise ModelError(
            f"'{contents.tree.source}': motors {list(hints.actuated)}, expected each at most once and "
            f"from {list(names)}"
        )
    return hints.actuated, ()


def _torque(contents: Contents, actuated: Names, hints: Hints) -> tuple[float, Notes]:
    """The torque limit of every motor [N m]: that of the hints, or else the least one of the joints `actuated`
    in the file; and a note on it in the second case.

    It is 1 for a robot without motors, as a record needs a number. Raises ModelError where a motor has none.
    """
    if hints.torque is not None or not actuated:
        return (1.0 if hints.torque is None else hints.torque), ()
    without = [name for name in actuated if not contents.effort.get(name, 0.0) > 0.0]
    if without:
        raise ModelError(
            f"'{contents.tree.source}': motors {without} have no torque limit; write "
            '<limit effort="..."/> into the joints, or give torque=... [N m] or --torque'
        )
    efforts = {name: contents.effort[name] for name in actuated}
    least = min(efforts.values())
    which = "every motor" if least == max(efforts.values()) else f"the weakest of {efforts}"
    return least, (Note("read", f"torque limit: {least:g} N m, of {which}"),)


def _armature(contents: Contents, actuated: Names, hints: Hints) -> tuple[Rotors, Notes]:
    """The inertia of the motors' rotors, reflected to their joints [kg m^2], of the hints or else of the file;
    and notes.

    One number if all motors have the same, else one for each of `actuated`. The rotor of a joint without a
    motor is left out.
    """
    if hints.armature is not None:
        return hints.armature, ()
    each = tuple(contents.rotor.get(name, 0.0) for name in actuated)
    rotors = zip(actuated, each, strict=True)
    text = ", ".join(f"{x:g} kg m^2 on '{name}'" for name, x in rotors if x)
    none = Note("assumed", "rotor inertia: none; the file does not say. --set armature= gives it")
    notes = [Note("read", f"rotor inertia, reflected to the joint: {text}") if text else none]
    if other := sorted(name for name, x in contents.rotor.items() if x and name not in actuated):
        notes.append(Note("left out", f"rotor inertia of {other}, without a motor or welded"))
    return each[0] if len(set(each)) == 1 else each or 0.0, tuple(notes)  # 0.0 without motors


def _remarks(contents: Contents, moving: Joints, hints: Hints) -> Notes:
    """Notes on friction: of the feet, where the hints do not state it, and of the joints in the file."""
    text = (
        f"dry friction of the feet: {FRICTION}, as of RABBIT; --set friction_coefficient= gives it"
    )
    notes = [Note("assumed", text)] if hints.friction_coefficient is None else []
    units = ("viscous", contents.viscous, "N m s/rad"), ("static", contents.static, "N m")
    for what, values, unit in units:
        each = [f"{values[j.name]:g} on '{j.name}'" for j in moving if values.get(j.name)]
        text = f"{what} joint friction [{unit}]: {', '.join(each)}; it acts where hardware.friction is set"
        notes += [Note("read", text)] if each else []
    return tuple(notes)
