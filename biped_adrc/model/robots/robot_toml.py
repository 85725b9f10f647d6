"""The record of a robot, `robot.toml`: read, checked, and the registry of the robots in the package.

A robot is a folder of `urdf/` with a `robot.toml` beside its URDF. The record says what a URDF
cannot, here for RABBIT, abbreviated:

    actuated = ["left_hip", "right_hip", "left_knee", "right_knee"]     # q1, ..., q4
    unactuated = "torso_pitch"                                          # q5, absolute
    base = ["base_x", "base_z"]
    stance_foot = "left_foot"
    swing_foot = "right_foot"
    hip = "torso"
    phase = [1.0, 0.0, 0.5, 0.0, 1.0]                                   # Theta = q5 + q1 + q3/2
    peak_torque = 150.0                                                 # [N m]
    friction_coefficient = 0.6

    [links]                                                             # by body
    thigh = ["left_thigh", "right_thigh"]
    [presets.identified]
    armature = 0.83                                                     # [kg m^2]
    thigh = { mass = 6.8, com = 0.11, inertia = 0.47 }                  # [kg], [m], [kg m^2]

The keys are the fields of `RobotDescription`, with joint friction in a table [friction] of `viscous` and
`static`. May be missing: `passive` (none), `trunk` (the hip's link), `offset` (zero), `gravity` (9.81),
`ranges` (joints turn freely), `friction` (none), and the bodies of a preset (the URDF's own).
`load_description` makes a `RobotDescription` of it, with which `Biped.load` starts.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, fields
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import ModelError, check_positive
from biped_adrc.core.files import beside, data_folder, reading
from biped_adrc.core.shown import Shown
from biped_adrc.model.robots.urdf import Inertial, Tree
from biped_adrc.model.robots.urdf_reader import read

Rotors = float | tuple[float, ...]
"""Inertia of the rotor of every motor, or of each one, reflected to the joint [kg m^2]."""


@dataclass(frozen=True)
class BodyParameters:
    """Parameters of a link that is symmetric about its axis z."""

    mass: float
    """Mass [kg]."""
    com: float
    """Distance of the COM from the link's origin along +z [m]."""
    inertia: float
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
    """Parameters by class (torso, thigh, ...); empty where the URDF's own <inertial> elements hold."""


@dataclass(frozen=True)
class RobotDescription(Shown):
    """The content of a `robot.toml`; lengths [m], torques [N m], angles [rad]."""

    name: str
    """Name of the robot, as in `Biped.load`."""
    urdf: Path
    """Path of the URDF with the floating base."""
    actuated: tuple[str, ...]
    """Joints with a motor, q1, ..., qp in order."""
    passive: tuple[str, ...]
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
    phase: tuple[float, ...]
    """Row c (n,) of the phase variable Theta = c q, dimensionless."""
    offset: tuple[float, ...]
    """Offset r (n,) [rad] of the relabelling q+ = R q- + r; not zero for robots with spokes."""
    peak_torque: float
    """Torque limit of every motor [N m]."""
    friction_coefficient: float
    """Dry friction mu between foot and ground, dimensionless."""
    gravity: float
    """Gravity [m/s^2]."""
    viscous: Mapping[str, float]
    """Viscous joint friction by joint [N m s/rad]; 0 for joints that are not here."""
    static: Mapping[str, float]
    """Static joint friction by joint [N m]; 0 for joints that are not here."""
    links: Mapping[str, tuple[str, ...]]
    """Links by body: the class "thigh" has the links of both thighs."""
    default_preset: str
    """Name of the preset that is used by default."""
    presets: Mapping[str, Preset]
    """Parameter sets by name."""
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Lower and upper end [rad] by joint, for gait design alone; a walk is judged by what the URDF states."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of q1..qN: the actuated joints, joints without a motor, the pitch."""
        return (*self.actuated, *self.passive, self.unactuated)

    @property
    def feet(self) -> tuple[str, str]:
        """Names of the stance and the swing foot."""
        return self.stance_foot, self.swing_foot

    def preset(self, name: str | None = None) -> Preset:
        """The preset `name`, or the default one. Raises ModelError with the known names."""
        name = self.default_preset if name is None else name
        if name not in self.presets:
            raise ModelError(
                f"robot '{self.name}' has no preset '{name}'; choose one of {sorted(self.presets)}"
            )
        return self.presets[name]

    def joint_index(self, joint: str | int) -> int:
        """Index in q of a joint given by name, as "q1".."qN", or by index from 0.

        Raises ModelError with the possible names.
        """
        n = len(self.joints)
        known = [*self.joints, *(f"q{i + 1}" for i in range(n)), *range(n)]
        if joint not in known:
            raise ModelError(
                f"robot '{self.name}' has no joint '{joint}'; expected one of {list(self.joints)}, q1..q{n}, "
                "or an index from 0"
            )
        return known.index(joint) % n

    def tree(self, preset: str | None = None) -> Tree:
        """Read the floating URDF with the inertials of `preset`. Raises ModelError.

        A preset has one moment of inertia per body, about y. The moments about x and z get values of a slender
        link, since a URDF needs them and planar motion does not depend on them.
        """
        tree = read(self.urdf).tree
        inertials: dict[str, Inertial] = {}
        for body, p in self.preset(preset).bodies.items():
            for link in self.links[body]:
                # the moments about x and z do not enter planar motion
                moments = (p.inertia, 0.0, 0.0, p.inertia, 0.0, 0.05 * p.inertia)
                inertials[link] = Inertial(p.mass, (0.0, 0.0, p.com), moments)
        if unknown := sorted(set(inertials) - set(tree.links)):
            raise ModelError(
                f"robot '{self.name}' has {unknown} in its links, the URDF has {list(tree.links)}"
            )
        return tree.with_inertials(inertials)


KEYS = {f.name for f in fields(RobotDescription)} - {"viscous", "static"} | {"friction"}
"""Keys of a robot.toml."""


def robot_names() -> tuple[str, ...]:
    """Names of the robots that come with the package."""
    return tuple(sorted(path.parent.name for path in data_folder("urdf").glob("*/robot.toml")))


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
    """The record from TOML's tables `data`, whose URDF lies beside `path`.

    Raises ModelError that names the key, what was found and what was expected.
    """
    with reading("robot record", path, ModelError):
        _table("the record", data, KEYS)
        friction = _table("friction", data.get("friction", {}), ("viscous", "static"))
        ranges, links = _table("ranges", data.get("ranges", {})), _table("links", data["links"])
        viscous, static = (dict(_table(x, friction.get(x, {}))) for x in ("viscous", "static"))
        _numbers("friction", rubs := [*viscous.values(), *static.values()], len(rubs), 0.0)
        actuated, base = (_names(key, data[key]) for key in ("actuated", "base"))
        passive = _names("passive", data.get("passive", ()))
        joints = (*actuated, *passive, data["unactuated"])
        _names("the list of all joints", (*joints, *base))
        _names("the list of both feet", (data["stance_foot"], data["swing_foot"]))
        bodies = {body: _names(f"links.{body}", x, 1) for body, x in links.items()}
        _names("the list of the links of all bodies", [x for row in bodies.values() for x in row])
        if len(base) != 2:
            raise ValueError(f"base is {list(base)}, expected two joints, along x and z")
        texts = ("name", "unactuated", "stance_foot", "swing_foot", "hip", "default_preset")
        for key, table in (("ranges", ranges), ("friction", viscous | static)):
            if unknown := sorted(set(table) - set(joints)):
                raise ValueError(f"{key} names {unknown}, the joints are {list(joints)}")
        phase = _numbers("phase", data["phase"], len(joints))
        if phase[-1] == 0.0:
            raise ValueError(f"phase is {list(phase)}; the last number must not be 0")
        return RobotDescription(
            **{key: _name(key, data[key]) for key in texts},
            urdf=beside(path, _name("urdf", data["urdf"])),
            actuated=actuated,
            passive=passive,
            base=(base[0], base[1]),
            trunk=_name("trunk", data.get("trunk", data["hip"])),
            phase=phase,
            offset=_numbers("offset", data.get("offset", [0.0] * len(joints)), len(joints)),
            peak_torque=_positive(data["peak_torque"], "peak_torque"),
            friction_coefficient=_positive(data["friction_coefficient"], "friction_coefficient"),
            gravity=_positive(data.get("gravity", GRAVITY), "gravity"),
            viscous=viscous,
            static=static,
            links=bodies,
            presets={
                name: _preset(name, x, data)
                for name, x in _table("presets", data["presets"]).items()
            },
            ranges={joint: _range(joint, ends) for joint, ends in ranges.items()},
        )


def _name(key: str, value: object) -> str:
    """Check a name or a text. Raises ValueError that names the key."""
    if not isinstance(value, str):
        raise ValueError(f"{key} is {value!r}, expected a text")
    return value


def _names(key: str, values: Sequence[object], least: int = 0) -> tuple[str, ...]:
    """Check a list of different names, at least so many. Raises ValueError that names the key."""
    if not isinstance(values, list | tuple) or len(set(map(str, values))) < max(len(values), least):
        raise ValueError(
            f"{key} is {values!r}, expected a list of different names" + ", one at least" * least
        )
    return tuple(_name(f"a name in {key}", x) for x in values)


def _table(key: str, value: object, known: Collection[str] = ()) -> Mapping[str, Any]:
    """Check a table, and its keys where they are known. Raises ValueError that names the key."""
    if not isinstance(value, Mapping):
        raise ValueError(f"{key} is {value!r}, expected a table")
    for name in sorted(set(value) - set(known)) if known else ():
        near = get_close_matches(name, known, 1) or sorted(known)
        raise ValueError(f"{key} has the unknown key '{name}', expected {' or '.join(near)}")
    return value


def _numbers(
    key: str, values: Sequence[Any], count: int, least: float = -math.inf
) -> tuple[float, ...]:
    """Check a list of `count` finite numbers, none below `least`. Raises ValueError that names the key."""
    row = values if isinstance(values, list | tuple) and bool not in map(type, values) else ()
    numbers = tuple(float(x) if isinstance(x, int | float) else math.nan for x in row)
    if len(numbers) != count or not all(least <= x and math.isfinite(x) for x in numbers):
        above = f", at least {least:g}" if math.isfinite(least) else ""
        raise ValueError(f"{key} is {values!r}, expected {count} finite numbers{above}")
    return numbers


def _range(joint: str, ends: Sequence[float]) -> tuple[float, float]:
    """Lower and upper end of a joint's range [rad], after a check of their order. Raises ValueError."""
    low, high = _numbers(f"ranges.{joint}", ends, 2)
    if not low < high:
        raise ValueError(f"ranges.{joint} is [{low}, {high}], expected the lower angle first")
    return low, high


def _preset(name: str, table: object, data: Mapping[str, Any]) -> Preset:
    """One of the tables [presets.NAME]: parameters of all bodies of the record, or of none. Raises
    ValueError.
    """
    bodies, where = {}, f"presets.{name}"
    record = _table(where, table, (*data["links"], "armature", "source"))
    for body in data["links"] if any(body in record for body in data["links"]) else ():
        p = _table(f"{where}.{body}", record[body], ("mass", "com", "inertia"))
        bodies[body] = BodyParameters(
            _positive(p["mass"], f"{where}.{body}.mass"),
            _numbers(f"{where}.{body}.com", [p["com"]], 1)[0],
            _positive(p["inertia"], f"{where}.{body}.inertia"),
        )
    rotors: Any = record["armature"]
    each = rotors if isinstance(rotors, list | tuple) else [rotors]
    count = len(data["actuated"]) if each is rotors else 1
    armature = _numbers(f"{where}.armature", each, count, least=0.0)
    source = _name(f"{where}.source", record["source"])
    return Preset(name, source, armature if each is rotors else armature[0], bodies)


def _positive(value: Any, what: str) -> float:
    """Check that a value is a number above zero. Raises InputError that names it by `what`."""
    (number,) = _numbers(what, [value], 1)
    check_positive(number, f"{what} is {value}")
    return number
