"""The record of a robot, `robot.toml`: read, checked, and the registry of the robots in the package.

A robot is a folder of `urdf/` with a `robot.toml` beside its URDF. The record says what a URDF
cannot, here for RABBIT, abbreviated:

    actuated = ["left_hip", "right_hip", "left_knee", "right_knee"]     # q1, ..., q4
    unactuated = "torso_pitch"                                          # q5, absolute
    base = ["base_x", "base_z"]
    stance_foot = "left_foot"
    swing_foot = "right_foot"
    hip = "torso"
    phase = [1.0, 0.0, 0.5, 0.0, 1.0]                                   # Theta = q5 + q1 + q3/2 [rad]
    peak_torque = 150.0                                                 # [N m]
    friction_coefficient = 0.6

    [links]                                                             # by body
    thigh = ["left_thigh", "right_thigh"]
    [presets.identified]
    armature = 0.83                                                     # [kg m^2]
    thigh = { mass = 6.8, com = 0.11, inertia = 0.47 }                  # [kg], [m], [kg m^2]

q1, ..., qN are the coordinates; Theta is the phase variable, the angle by which a gait is timed. A body, such
as thigh, is one link, or the two links that change over when the legs exchange their roles.

The keys are the fields of `RobotDescription`, with joint friction in a table [friction] of `viscous` and
`static`. May be missing: `passive` (none), `trunk` (the hip's link), `offset` (zero), `gravity` (9.81),
`ranges` (joints turn freely), `friction` (none), and the bodies of a preset (the URDF's own).
`load_description` makes a `RobotDescription` of it, with which `Biped.load` starts.
"""

import tomllib
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field, TypeAdapter, ValidationError

from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import ModelError, problem, unknown
from biped_adrc.core.files import beside, data_folder, reading
from biped_adrc.core.registry import stored
from biped_adrc.core.shown import Shown
from biped_adrc.model.robots.urdf import Inertial, Tree, Triple, text_of
from biped_adrc.model.robots.urdf_reader import read

_Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[_Number, Field(gt=0.0)]
NotNegative = Annotated[_Number, Field(ge=0.0)]
Names = tuple[str, ...]
Rotors = NotNegative | tuple[NotNegative, ...]
"""Inertia of the rotor of every motor, or of each one, reflected to the joint [kg m^2]."""


@dataclass(frozen=True)
class BodyParameters:
    """Parameters of a link that is symmetric about its axis z."""

    mass: Positive
    """Mass [kg]."""
    com: _Number
    """Distance of the COM from the link's origin along +z [m]."""
    inertia: Positive
    """Moment of inertia about the COM and the axis y [kg m^2]."""


GRAVITY = 9.81
"""Gravity [m/s^2] of a record that gives no other value."""


@dataclass(frozen=True)
class Preset:
    """A parameter set of a robot."""

    name: str
    source: str
    """Origin of the numbers."""
    armature: Rotors
    """Rotor inertia per actuated joint, reflected to it [kg m^2]; one number, or one for each motor."""
    bodies: Mapping[str, BodyParameters]
    """Parameters by body (torso, thigh, ...); empty where the URDF's own <inertial> elements hold."""


@dataclass(frozen=True)
class RobotDescription(Shown):
    """The content of a `robot.toml`; lengths [m], torques [N m], angles [rad]."""

    name: str
    """Name of the robot, as in `Biped.load`."""
    urdf: Path
    """Path of the URDF with the floating base."""
    actuated: Names
    """Joints with a motor, q1, ..., qp in order."""
    passive: Names
    """Relative joints without a motor."""
    unactuated: str
    """Joint of the base that is the absolute pitch of the trunk, q_N."""
    base: tuple[str, str]
    """Prismatic joints of the base along x and z."""
    stance_foot: str
    """Link at the tip of the stance leg; the contact point is its origin."""
    swing_foot: str
    """Link at the tip of the swing leg."""
    hip: str
    """Link whose origin is the hip."""
    trunk: str
    """Link that the floating base carries; that of the hip if the record names no other."""
    phase: tuple[_Number, ...]
    """Row c (n,) of the phase variable Theta = c q, dimensionless."""
    offset: tuple[_Number, ...]
    """Offset r (n,) [rad] of the relabelling q+ = R q- + r; not zero for robots with spokes."""
    peak_torque: Positive
    """Torque limit of every motor [N m]."""
    friction_coefficient: Positive
    """Dry friction mu between foot and ground, dimensionless."""
    gravity: Positive
    """Gravity [m/s^2]."""
    viscous: Mapping[str, NotNegative]
    """Viscous joint friction by joint [N m s/rad]; 0 for joints that are not here."""
    static: Mapping[str, NotNegative]
    """Static joint friction by joint [N m]; 0 for joints that are not here."""
    links: Mapping[str, Annotated[Names, Field(min_length=1)]]
    """Names of links by body: the body "thigh" has the links of both thighs."""
    default_preset: str
    """Name of the preset that is used by default."""
    presets: Mapping[str, Preset]
    """Parameter sets by name."""
    ranges: Mapping[str, tuple[_Number, _Number]] = field(default_factory=dict)
    """Lower and upper end [rad] by joint, for gait design alone; a walk is judged by what the URDF states."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the joints whose angles are q1, ..., qN: those with a motor, those without, the pitch."""
        return (*self.actuated, *self.passive, self.unactuated)

    @property
    def feet(self) -> tuple[str, str]:
        """Names of the stance and the swing foot."""
        return self.stance_foot, self.swing_foot

    @property
    def theta(self) -> str:
        """Theta = c q as text, such as "+1 q1 +0.5 q3 +1 q5"."""
        return " ".join(f"{c:+.6g} q{i}" for i, c in enumerate(self.phase, 1) if c != 0.0)

    def preset(self, name: str | None = None) -> Preset:
        """The preset `name`; None: the default one. Raises ModelError with the known names for another name."""
        name = self.default_preset if name is None else name
        if name not in self.presets:
            known = sorted(self.presets)
            raise ModelError(f"robot '{self.name}' has no preset '{name}'; choose one of {known}")
        return self.presets[name]

    def joint_index(self, joint: str | int) -> int:
        """Index in q, from 0, of a joint by its name, by one of "q1" to "qN", or by that index itself.

        Raises ModelError with the possible names.
        """
        n = len(self.joints)
        known = [*self.joints, *(f"q{i + 1}" for i in range(n)), *range(n)]
        if joint not in known:
            raise ModelError(
                f"robot '{self.name}' has no joint '{joint}'; expected one of {list(self.joints)}, q1..q{n}, "
                "or an index from 0"
            )
        return known.index(joint) % n  # `known` has the n joints three times

    def tree(self, preset: str | None = None) -> Tree:
        """Read the URDF with the floating base, and replace mass, COM and inertia of its links by those of a
        preset (None: the default one). Raises ModelError.

        A preset has one moment of inertia per body, about y. The moments about x and z get values of a slender
        link along z, since a URDF needs them and planar motion does not depend on them.
        """
        tree = read(self.urdf).tree
        inertials: dict[str, Inertial] = {}
        for body, p in self.preset(preset).bodies.items():
            for link in self.links[body]:
                # xx, xy, xz, yy, yz, zz
                moments = (p.inertia, 0.0, 0.0, p.inertia, 0.0, 0.05 * p.inertia)
                inertials[link] = Inertial(p.mass, (0.0, 0.0, p.com), moments)
        # names of links in the record that the URDF does not have
        if unknown := sorted(set(inertials) - set(tree.links)):
            raise ModelError(
                f"robot '{self.name}' has {unknown} in its links, the URDF has {list(tree.links)}"
            )
        return tree.with_inertials(inertials)

    def check_planar(self, tree: Tree) -> None:
        """Check that the joints of this record turn about y or -y in a tree, and that its base slides along +x
        and +z.

        Raises ModelError that names the joint, its axis and the expected one.
        """
        x, y, z = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
        axes: dict[str, Triple] = dict(zip(self.base, (x, z), strict=True))
        joints = {joint.name: joint for joint in tree.joints}
        missing = f"missing in {list(joints)}"
        for name, axis in (axes | dict.fromkeys(self.joints, y)).items():
            kind, joint = "revolute" if axis == y else "prismatic", joints.get(name)
            along = 0.0 if joint is None else float(np.dot(joint.axis, axis))
            # a revolute joint may turn about -y, a slide must not be turned round
            off = 1.0 - (abs(along) if kind == "revolute" else along)
            # off: 1 - cos of the angle between the axes; 1e-6 of it is 0.08 degrees
            if joint is None or joint.type != kind or not abs(off) <= 1e-6:
                found = f"{joint.type} along {text_of(joint.axis)}" if joint else missing
                raise ModelError(
                    f"'{tree.source}': joint '{name}' of the record of robot '{self.name}' is {found}, "
                    f"expected {kind} along {text_of(axis)}: a planar robot moves in x and z"
                )


_READER = TypeAdapter(RobotDescription)
"""Reads a record from TOML's tables, by the types of its fields."""
RECORD_KEYS = {f.name for f in fields(RobotDescription)} - {"viscous", "static"} | {"friction"}
"""Keys of a record."""


def robot_names() -> tuple[str, ...]:
    """Names of the robots that come with the package, as `load_description` takes them."""
    return stored("robot")


def load_description(robot: str | Path) -> RobotDescription:
    """Load the record of a robot by name, or from the path of a `robot.toml`.

    Raises ModelError that names the robot or the key, what was found and what was expected.
    """
    check_part(robot, "robot", str, Path)
    path = Path(robot)
    if str(robot) in robot_names():
        path = data_folder("urdf") / str(robot) / "robot.toml"
    elif path.suffix != ".toml":
        raise ModelError(
            f"there is no robot '{robot}'; choose one of {list(robot_names())}, or give the path of a "
            "robot.toml; biped_from_urdf takes a URDF, and 'biped-adrc robot new' makes a robot.toml of it"
        )
    with reading("robot record", path, ModelError):
        data = tomllib.loads(path.read_text(encoding="utf-8"))
    return description_of(data, path)


def description_of(data: Mapping[str, Any], path: Path) -> RobotDescription:
    """The record from the tables `data` of a robot.toml at `path`; the URDF's place is relative to that file.

    Raises ModelError that names the key, what was found and what was expected.
    """
    with reading("robot record", path, ModelError):
        _table("the record", data, RECORD_KEYS)
        links, presets = _table("links", data["links"]), _table("presets", data["presets"])
        rubbing = _table("friction", data.get("friction", {}), ("viscous", "static"))
        # what a record may leave out; "offset" gets its n zeros below, when n is known
        usual = {"trunk": data["hip"], "passive": (), "offset": (), "gravity": GRAVITY}
        friction, urdf = {"viscous": {}, "static": {}, **rubbing}, data["urdf"]
        # values that are not taken as they stand in the file
        own = {
            "urdf": beside(path, urdf) if isinstance(urdf, str) else urdf,
            "presets": {name: _preset(name, x, links) for name, x in presets.items()},
        }
        try:
            # _READER: makes a RobotDescription and checks each value against the type of its field
            d = _READER.validate_python({**usual, **friction, **data, **own})
        except ValidationError as error:
            # a type with alternatives reports an error for each: the one at the deepest place says most. The
            # bodies of a preset are keys of its table, so the file has no word "bodies"
            innermost = max(error.errors(), key=lambda one: len(one["loc"]))
            raise ValueError(problem(innermost).replace(".bodies.", ".")) from None
        lists = {"joints": (*d.joints, *d.base), "feet": d.feet, "links": sum(d.links.values(), ())}
        for what, names in lists.items():
            if len(set(names)) < len(names):
                raise ValueError(f"the {what} are {names}, expected a list of different names")
        n = len(d.joints)
        d = d if "offset" in data else replace(d, offset=(0.0,) * n)
        # rows of numbers, with the number of entries that each must have
        rows = {"phase": (d.phase, n), "offset": (d.offset, n)}
        for name, preset in d.presets.items():
            if isinstance(preset.armature, tuple):
                rows[f"presets.{name}.armature"] = preset.armature, len(d.actuated)
        for key, (row, count) in rows.items():
            if len(row) != count:
                raise ValueError(f"{key} is {list(row)}, expected {count} finite numbers")
        for key, table in (("ranges", d.ranges), ("friction", {**d.viscous, **d.static})):
            if others := sorted(set(table) - set(d.joints)):
                raise ValueError(f"{key} names {others}, the joints are {list(d.joints)}")
        if falling := {x: list(ends) for x, ends in d.ranges.items() if not ends[0] < ends[1]}:
            raise ValueError(f"ranges are {falling}, expected the lower angle first")
        if d.phase[-1] == 0.0:  # Theta is an absolute angle, so the pitch has a part in it
            raise ValueError(f"phase is {list(d.phase)}; the last number must not be 0")
        return d


def _table(key: str, value: object, known: Collection[str] = ()) -> Mapping[str, Any]:
    """Return `value` after a check that it is a table and `known` has all its keys; () allows every key.

    key: its name in messages. Raises ValueError.
    """
    if not isinstance(value, Mapping):
        raise ValueError(f"{key} is {value!r}, expected a table")
    for name in sorted(set(value) - set(known)) if known else ():
        raise ValueError(f"'{name}' in {key}: {unknown(name, known)}")
    return value


def _preset(name: str, value: object, links: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of a `Preset` from its table [presets.NAME], which has parameters of all bodies or of none.

    links: the record's table of bodies. Raises ValueError for unknown keys, KeyError for a missing body.
    """
    record = _table(f"presets.{name}", value, (*links, "armature", "source"))
    keys = [f.name for f in fields(BodyParameters)]
    all_or_none = links if any(x in record for x in links) else ()
    bodies = {x: _table(f"presets.{name}.{x}", record[x], keys) for x in all_or_none}
    return {**record, "name": name, "bodies": bodies}
