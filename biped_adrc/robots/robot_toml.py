"""The registry: a robot is a folder of `urdf/` with a `robot.toml` beside its URDF.

The record names the actuated joints in the order q1, q2, ..., the unactuated pitch, the planar base,
the feet, the phase variable, and parameter presets with their sources.

`Limits` are what ground and motors can give, within which a walk is legal. A walk makes a single support
legally when the force of the ground, averaged over any window within it, lies in the friction cone (F_N > 0 and
|F_T| <= mu F_N), every torque is within the motors' limit, and the swing foot does not scuff away from the ends
of the step. The impulse at impact is not part of it. A mean and not an instant: the edge of a push breaks the
cone for a millisecond and a foot does not move in it, while torques that chatter break it in the mean as well.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from biped_adrc.errors import InputError, ModelError, check_positive
from biped_adrc.files import reading
from biped_adrc.parts import check_part
from biped_adrc.resources import data_folder
from biped_adrc.robots.urdf import Inertial, Tree
from biped_adrc.robots.urdf_reader import load_tree
from biped_adrc.shown import Shown


@dataclass(frozen=True)
class BodyParameters:
    """mass [kg], com [m] along +z of the link, inertia [kg m^2] about the COM."""

    mass: float
    com: float
    inertia: float


GRAVITY = 9.81
"""[m/s^2], where a record does not say otherwise."""


@dataclass(frozen=True)
class Preset:
    """A parameter set: bodies by class (torso, thigh, ...), armature [kg m^2] per actuated joint.

    Without bodies the URDF's own <inertial> elements hold.
    """

    name: str
    source: str
    armature: float
    bodies: Mapping[str, BodyParameters]


@dataclass(frozen=True)
class RobotDescription(Shown):
    """What `robot.toml` says; lengths [m], torques [N m], angles [rad]."""

    name: str
    urdf: Path
    actuated: tuple[str, ...]
    passive: tuple[str, ...]
    """Relative joints without a motor."""
    unactuated: str
    """The absolute pitch of the link that the base carries."""
    base: tuple[str, str]
    stance_foot: str
    swing_foot: str
    hip: str
    """Frame of the hip."""
    trunk: str
    """Link that the floating base carries; the hip's own if the record names no other."""
    phase: tuple[float, ...]
    offset: tuple[float, ...]
    """What relabelling adds to q [rad]; not zero for spokes."""
    peak_torque: float
    friction_coefficient: float
    gravity: float
    viscous: Mapping[str, float]
    static: Mapping[str, float]
    links: Mapping[str, tuple[str, ...]]
    default_preset: str
    presets: Mapping[str, Preset]
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """[rad] by joint, where gaits are designed; joints that are not here turn freely."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of q1..qN: the actuated joints, joints without a motor, the pitch."""
        return (*self.actuated, *self.passive, self.unactuated)

    @property
    def feet(self) -> tuple[str, str]:
        """Stance and swing foot."""
        return self.stance_foot, self.swing_foot

    def preset(self, name: str | None = None) -> Preset:
        """The preset `name`, or the default one. Raises ModelError with the names there are."""
        name = self.default_preset if name is None else name
        if name not in self.presets:
            raise ModelError(
                f"robot '{self.name}' has no preset '{name}'; choose one of {sorted(self.presets)}"
            )
        return self.presets[name]

    def joint_index(self, joint: str | int) -> int:
        """Index in q of a joint given by name, as "q1".."qN", or by index from 0."""
        names = self.joints
        if isinstance(joint, int):
            if 0 <= joint < len(names):
                return joint
        elif joint in names:
            return names.index(joint)
        elif joint in (aliases := [f"q{i + 1}" for i in range(len(names))]):
            return aliases.index(joint)
        raise ModelError(
            f"robot '{self.name}' has no joint '{joint}'; "
            f"expected one of {list(names)}, q1..q{len(names)}, or an index from 0"
        )

    def tree(self, preset: str | None = None) -> Tree:
        """The floating URDF with the inertials of `preset`."""
        tree = load_tree(self.urdf)
        inertials: dict[str, Inertial] = {}
        for body, p in self.preset(preset).bodies.items():
            for link in self.links[body]:
                # the moments about x and z do not enter planar motion
                moments = (p.inertia, 0.0, 0.0, p.inertia, 0.0, 0.05 * p.inertia)
                inertials[link] = Inertial(p.mass, (0.0, 0.0, p.com), moments)
        return tree.with_inertials(inertials)


def robot_names() -> tuple[str, ...]:
    """Names of the robots that come with the package."""
    return tuple(sorted(path.parent.name for path in data_folder("urdf").glob("*/robot.toml")))


def load_description(robot: str | Path) -> RobotDescription:
    """The record of a robot by name, or from the path of a `robot.toml`.

    Raises ModelError that names the robot or the key, what was found and what was expected.
    """
    check_part(robot, "robot", str, Path)
    path = Path(robot)
    if path.suffix.lower() == ".urdf":
        raise ModelError(
            f"robot '{robot}' is a URDF, expected a name or a robot.toml; biped_from_urdf('{robot}') "
            "takes a URDF, and 'biped-adrc robot new' makes a robot.toml of it"
        )
    if path.suffix != ".toml":
        if str(robot) not in robot_names():
            raise ModelError(
                f"there is no robot '{robot}'; choose one of {list(robot_names())}, "
                "or give the path of a robot.toml"
            )
        path = data_folder("urdf") / str(robot) / "robot.toml"
    with reading("robot record", path, ModelError):
        data = tomllib.loads(path.read_text(encoding="utf-8"))
    return description_of(data, path)


def description_of(data: Mapping[str, Any], path: Path) -> RobotDescription:
    """The record `data`, whose URDF lies beside `path`. Raises ModelError that names the key."""
    with reading("robot record", path, ModelError):
        return _description(data, path)


_PLAIN = ("name", "unactuated", "stance_foot", "swing_foot", "hip", "default_preset")


def _description(data: Mapping[str, Any], path: Path) -> RobotDescription:
    friction = data.get("friction", {})
    description = RobotDescription(
        **{key: data[key] for key in _PLAIN},
        urdf=path.parent / data["urdf"],
        actuated=tuple(data["actuated"]),
        passive=tuple(data.get("passive", ())),
        base=(data["base"][0], data["base"][1]),
        trunk=data.get("trunk", data["hip"]),
        phase=_numbers(data, "phase", data["phase"]),
        offset=_numbers(data, "offset", data.get("offset", [0.0] * _count(data))),
        peak_torque=_positive(data["peak_torque"], "peak_torque"),
        friction_coefficient=_positive(data["friction_coefficient"], "friction_coefficient"),
        gravity=_positive(data.get("gravity", GRAVITY), "gravity"),
        viscous=dict(friction.get("viscous", {})),
        static=dict(friction.get("static", {})),
        links={body: tuple(names) for body, names in data["links"].items()},
        presets={name: _preset(name, record, data) for name, record in data["presets"].items()},
        ranges={joint: _range(joint, ends) for joint, ends in data.get("ranges", {}).items()},
    )
    unknown = sorted(set(description.ranges) - set(description.joints))
    if unknown:
        raise ValueError(f"ranges names {unknown}, the joints are {list(description.joints)}")
    if description.phase[-1] == 0.0:
        raise ValueError(f"phase is {list(description.phase)}; the last number must not be 0")
    return description


def _count(data: Mapping[str, Any]) -> int:
    """Number of coordinates."""
    return len(data["actuated"]) + len(data.get("passive", ())) + 1


def _numbers(data: Mapping[str, Any], key: str, values: Any) -> tuple[float, ...]:
    """One number per coordinate."""
    found = tuple(float(c) for c in values)
    if len(found) != _count(data) or not all(map(math.isfinite, found)):
        raise ValueError(f"{key} is {list(values)}, expected {_count(data)} finite numbers")
    return found


def _range(joint: str, ends: Any) -> tuple[float, float]:
    low, high = (float(end) for end in ends)
    if not low < high:
        raise ValueError(
            f"ranges.{joint} is [{low}, {high}], expected two angles, the lower one first"
        )
    return low, high


def _preset(name: str, record: Mapping[str, Any], data: Mapping[str, Any]) -> Preset:
    bodies = {}
    own = not any(body in record for body in data["links"])
    for body in () if own else data["links"]:
        p = record[body]
        where = f"presets.{name}.{body}"
        bodies[body] = BodyParameters(
            _positive(p["mass"], f"{where}.mass"),
            float(p["com"]),
            _positive(p["inertia"], f"{where}.inertia"),
        )
    armature = float(record["armature"])
    if not (math.isfinite(armature) and armature >= 0):
        raise ValueError(f"presets.{name}.armature is {armature}, expected a number >= 0")
    return Preset(name, record["source"], armature, bodies)


def _positive(value: object, what: str) -> float:
    number = float(value)  # type: ignore[arg-type]
    check_positive(number, f"{what} is {value}")
    return number


WINDOW = 5e-3
"""[s]"""
ROUND_OFF = 1e-9
"""By which a force on the friction cone may lie outside of it, relative."""
ENDS = 0.03
"""Share of a step at either end in which the swing foot may be at the ground."""


class KnownLimits(NamedTuple):
    """`Limits` of one robot."""

    friction: float
    """mu."""
    torque: float
    """[N m]"""
    window: float
    """[s]"""


@dataclass(frozen=True)
class Limits(Shown):
    """friction: mu of the ground; torque [N m]: of every motor; None is what the robot's record says.

    window [s]: over which the force of the ground is averaged. Raises InputError for a friction that is not
    above 0 and at most 1, or a torque or window that is not positive.
    """

    friction: float | None = None
    torque: float | None = None
    window: float = WINDOW

    def __post_init__(self) -> None:
        mu, torque = self.friction, self.torque
        if mu is not None and not 0.0 < mu <= 1.0:
            raise InputError(
                f"the friction limit is {mu}, expected a number above 0 and at most 1, or None for the "
                "robot's record"
            )
        if torque is not None and not torque > 0.0:
            raise InputError(
                f"the torque limit is {torque} N m, expected a positive number, or None for the robot's record"
            )
        check_positive(self.window, f"the force window is {self.window} s")

    def of(self, robot: RobotDescription) -> KnownLimits:
        """With what the robot's record says where None was given."""
        mu, torque = self.friction, self.torque
        return KnownLimits(
            robot.friction_coefficient if mu is None else float(mu),
            robot.peak_torque if torque is None else float(torque),
            float(self.window),
        )
