"""Reading the URDF of a planar robot: frames of any orientation become parallel at zero angles.

The rest of the package works with parallel frames (`urdf.Joint`). With R_p the rotation of the parent's
frame at zero angles and (x, R) the origin of a joint in it,

    R_c = R_p R,   x' = R_p x,   n' = R_c n                          (joints)
    c' = R_c c,    I' = (R_c R_i) I (R_c R_i)'                       (bodies)

so a leg that hangs down by an origin of rpy = (0, pi, 0) becomes a leg that points along -z. Angles
keep their names, senses and zeros. A `continuous` joint becomes `revolute`, for which nq = nv.
Shapes that are meshes or stand oblique after the turn are not kept: the tree has upright primitives only.

The limit <limit effort> and the friction <dynamics damping friction> are kept beside the
tree. Every ModelError names the file, the element, what was found and what was expected.
"""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pinocchio as pin

from biped_adrc.core.errors import ModelError
from biped_adrc.core.files import reading
from biped_adrc.core.types import Array
from biped_adrc.model.robots.urdf import (
    FREE,
    GEOMETRY_SIZES,
    JOINT_TYPES,
    MOMENTS,
    SYMMETRIC,
    Inertial,
    Joint,
    Link,
    Tree,
    Vector,
    Visual,
    check_inertial,
)

MOST_LINKS = 200
"""Largest number of links of a robot."""
LARGEST = 1e100
"""Bound on every number in a URDF, in any unit; products of larger ones overflow."""
SMALLEST = 1e-9
"""Least size of a shape [m]."""
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
_ALMOST_ONE = 1e-6  # how far an axis may be from unit length, dimensionless
_ROUND_OFF = 1e-15  # entries of a turn below this are the round-off of pi, dimensionless
_UPRIGHT = 1e-6  # how far a shape's axes may be from the frame's, dimensionless
_SLENDER = np.array([1.0, 0.0, 0.0, 1.0, 0.0, 0.05])  # moments of a link along z over its iyy
_CIRCULAR = ("revolute", "continuous")


@dataclass(frozen=True)
class UrdfContents:
    """Content of a URDF: the tree with parallel frames, and torque limits and friction by joint."""

    tree: Tree
    """Links and joints with parallel frames."""
    effort: Mapping[str, float]
    """Torque limits [N m], where <limit effort> is given."""
    viscous: Mapping[str, float]
    """Viscous friction [N m s/rad], where <dynamics damping> is given."""
    static: Mapping[str, float]
    """Static friction [N m], where <dynamics friction> is given."""
    undrawn: tuple[str, ...]
    """Links with a shape that was not kept: a mesh, or one that stands oblique."""


def parse(path: Path | str) -> ET.Element:
    """The element <robot> of a URDF file. Raises ModelError for another file."""
    path = Path(path)
    with reading("URDF", path, ModelError):
        data = path.read_bytes()
        if path.suffix == ".xacro" or b"<xacro:" in data:
            raise ValueError(
                "it holds xacro macros, expected the URDF they expand to; try "
                f"'xacro {path.name} > robot.urdf' and give robot.urdf"
            )
        root = ET.fromstring(data)
        count = len(root.findall("link"))
        if root.tag != "robot" or count > MOST_LINKS:
            raise ValueError(
                f"<{root.tag}> with {count} links, expected <robot> with at most {MOST_LINKS}"
            )
    return root


def read(path: Path | str, tips: Mapping[str, Vector] | None = None) -> UrdfContents:
    """Read and check a URDF.

    tips: link -> a place in its own frame [m] where a link without mass, `LINK_tip`, is added: a foot for legs
    that end with a shin. Raises ModelError.
    """
    robot, file = parse(path), f"URDF '{path}'"
    for link, place in (tips or {}).items():
        _add_tip(robot, link, place)
    bodies, movers = robot.findall("link"), robot.findall("joint")
    for (tag, name), count in Counter((e.tag, _name(e, file)) for e in (*bodies, *movers)).items():
        if count > 1:
            raise ModelError(f"{file}: two {tag}s are named '{name}'; names must differ")
    ends = [_ends(joint, file) for joint in movers]
    turns = _turns([link.get("name", "") for link in bodies], movers, ends, file)
    links = {link.get("name", ""): _link(link, file, turns) for link in bodies}
    joints = tuple(_joint(j, file, turns, *pair) for j, pair in zip(movers, ends, strict=True))
    robot.set("name", robot.get("name", Path(path).stem))
    turning = [joint for joint in movers if joint.get("type") in _CIRCULAR]
    return UrdfContents(
        Tree(_name(robot, file), links, joints, str(path)),
        _by_joint(turning, "limit", "effort", file),
        _by_joint(turning, "dynamics", "damping", file),
        _by_joint(turning, "dynamics", "friction", file),
        tuple(
            link.name
            for e, link in zip(bodies, links.values(), strict=True)
            if len(e.findall("visual")) > len(link.visuals)
        ),
    )


def tip_of(link: str) -> str:
    """Name of the link that `read` adds at the tip of `link`."""
    return f"{link}_tip"


def _add_tip(robot: ET.Element, link: str, place: Vector) -> None:
    """Add a link without mass, fixed at a place [m] in the frame of `link`."""
    ET.SubElement(robot, "link", name=tip_of(link))
    joint = ET.SubElement(robot, "joint", name=f"{tip_of(link)}_mount", type="fixed")
    ET.SubElement(joint, "parent", link=link)
    ET.SubElement(joint, "child", link=tip_of(link))
    ET.SubElement(joint, "origin", xyz=" ".join(repr(float(x)) for x in place))


# -- attributes ------------------------------------------------------------------------------------
def _place_of(element: ET.Element, file: str) -> str:
    """Text for messages that names a link or joint: file, kind of element and name."""
    return f"{file}, {element.tag} '{element.get('name')}'"


def _name(element: ET.Element, where: str, key: str = "name") -> str:
    """The attribute `key` of an element, after a check that it is printable.

    Line breaks and tabs would spoil tables and messages. Raises ModelError.
    """
    name = element.get(key, "")
    if not name or not name.isprintable():
        raise ModelError(
            f"{where}: <{element.tag}> has {key}={name!r}, expected a name on one line"
        )
    return name


def _required(element: ET.Element, tag: str, where: str) -> ET.Element:
    """The first child <tag>. Raises ModelError where it is missing."""
    child = element.find(tag)
    if child is None:
        raise ModelError(f"{where}: <{tag}> is missing")
    return child


def _numbers(
    element: ET.Element | None,
    key: str,
    default: str,
    count: int,
    where: str,
    least: float = -LARGEST,
) -> Vector:
    """`count` numbers of an attribute, none below `least`; `default` where it is missing.

    Raises ModelError that quotes the attribute after `where`. Only decimal notation counts: Python
    would also read "nan", "inf" and "1_0".
    """
    text = default if element is None else element.get(key, default)
    words = text.split()
    values = tuple(float(word) for word in words) if all(map(_NUMBER.fullmatch, words)) else ()
    if len(values) != count or not all(least <= value < LARGEST for value in values):
        raise ModelError(
            f"{where}: {key}={text!r}, expected {count} number(s) from {least:g} to {LARGEST:g}"
        )
    return values  # type: ignore[return-value]


def _by_joint(
    joints: list[ET.Element], tag: str, key: str, file: str, least: float = 0.0
) -> dict[str, float]:
    """The number <tag key> of each joint that has it, by name of the joint."""
    values = {}
    for joint in joints:
        element = joint.find(tag)
        if element is not None and key in element.attrib:
            where = f"{_place_of(joint, file)} <{tag}>"
            values[joint.get("name", "")] = _numbers(element, key, "", 1, where, least)[0]
    return values


# -- frames ----------------------------------------------------------------------------------------
def _ends(joint: ET.Element, file: str) -> tuple[str, str]:
    """Names of the parent and the child link of a joint."""
    where = _place_of(joint, file)
    parent, child = (
        _name(_required(joint, role, where), where, "link") for role in ("parent", "child")
    )
    return parent, child


def _turns(
    links: list[str], joints: list[ET.Element], ends: list[tuple[str, str]], file: str
) -> dict[str, Array]:
    """Rotation R (3, 3) of each link at zero angles, from its axes to those of the root; link -> R.

    ends: (parent, child) of each joint. Raises ModelError unless the links form one tree.
    """
    parents = Counter(child for _, child in ends)
    roots = [link for link in links if link not in parents]
    turns = dict.fromkeys(roots, np.eye(3))
    each = list(zip(joints, ends, strict=True))
    while below := [(j, a, b) for j, (a, b) in each if a in turns and b not in turns]:
        for joint, parent, child in below:
            turns[child] = _origin(joint, _place_of(joint, file), turns[parent])[1]
    twice = [link for link, count in parents.items() if count > 1]
    circle = [link for link in links if link not in turns]
    missing = sorted({link for pair in ends for link in pair} - set(links))
    if len(roots) != 1 or twice or circle or missing:
        raise ModelError(
            f"{file}: links must hang in one tree; found the roots {roots}, links with two parent joints "
            f"{twice}, links in a circle {circle}, and joints of links {missing} that are not there. Closed "
            "chains are not supported"
        )
    return turns


def _origin(element: ET.Element, where: str, R: Array) -> tuple[Vector, Array]:
    """Position R xyz [m] and rotation R R_rpy (3, 3) of the <origin> of `element`.

    R (3, 3): from the axes of the element to the result's. where: place in the file, for errors.

    rpy turns about the fixed axes x, y, z in this order. Round-off of pi in rpy is set to zero, so that
    turns by right angles stay exact.
    """
    origin, where = element.find("origin"), f"{where} <origin>"
    place = _numbers(origin, "xyz", "0 0 0", 3, where)
    turn = pin.rpy.rpyToMatrix(*_numbers(origin, "rpy", "0 0 0", 3, where))
    return _vector(R @ place), R @ np.where(np.abs(turn) < _ROUND_OFF, 0.0, turn)


def _vector(values: Array) -> Vector:
    """The three entries of an array as a tuple."""
    x, y, z = values.tolist()
    return x, y, z


# -- links and joints ------------------------------------------------------------------------------
def _link(element: ET.Element, file: str, turns: Mapping[str, Array]) -> Link:
    """The link of an element, in parallel axes; turns: rotation of each link. Raises ModelError."""
    where, R = _place_of(element, file), turns[element.get("name", "")]
    visuals = tuple(v for e in element.findall("visual") if (v := _visual(e, where, R)) is not None)
    body, inertial = element.find("inertial"), None
    if body is not None:
        inertial = _inertial(body, where, R)
        check_inertial(inertial, where)
    return Link(element.get("name", ""), inertial, visuals)


def _inertial(element: ET.Element, where: str, R: Array) -> Inertial:
    """Mass properties of an element, in axes turned by R.

    A body with a moment about y alone, as some planar URDFs have, gets those of a slender link along z,
    which do not enter planar motion.
    """
    mass = _numbers(_required(element, "mass", where), "value", "", 1, f"{where} <mass>")[0]
    com, turn = _origin(element, f"{where} <inertial>", R)
    inertia, where = _required(element, "inertia", where), f"{where} <inertia>"
    moments = np.array([_numbers(inertia, key, "0", 1, where)[0] for key in MOMENTS])
    turned = turn @ moments[SYMMETRIC] @ turn.T
    moments = (0.5 * (turned + turned.T))[np.triu_indices(3)]
    yy = moments[3]
    flat = bool(yy > 0.0 and np.all(np.abs(np.delete(moments, 3)) <= _ROUND_OFF * yy))
    return Inertial(mass, com, tuple((yy * _SLENDER if flat else moments).tolist()))


def _visual(element: ET.Element, where: str, R: Array) -> Visual | None:
    """The shape of an element in axes turned by R; None where it is no upright primitive then."""
    shape = next((g for g in element.iterfind("geometry/*") if g.tag in GEOMETRY_SIZES), None)
    if shape is None:
        return None
    place, turn = _origin(element, f"{where} <visual>", R)
    axes = np.asarray(np.round(np.abs(turn)), dtype=np.float64)
    oblique = {"box": np.max(np.abs(np.abs(turn) - axes)), "cylinder": 1.0 - abs(turn[2, 2])}
    if not abs(oblique.get(shape.tag, 0.0)) < _UPRIGHT:
        return None
    where, box = f"{where} <{shape.tag}>", shape.tag == "box"
    count, keys = 3 if box else 1, GEOMETRY_SIZES[shape.tag]
    size = sum((_numbers(shape, key, "", count, where, SMALLEST) for key in keys), ())
    rgba = _numbers(element.find("material/color"), "rgba", "0.5 0.5 0.5 1", 4, where)
    size = _vector(axes @ size) if box else size
    return Visual(shape.tag, size, place, tuple(np.clip(rgba, 0.0, 1.0).tolist()))


def _joint(
    element: ET.Element, file: str, turns: Mapping[str, Array], parent: str, child: str
) -> Joint:
    """The joint of an element, with its place and axis in the turned axes, its speed limit and its range.

    A range of a whole turn or more is none. Raises ModelError for unknown types, mimic joints and axes that are
    not of unit length.
    """
    where, kind = _place_of(element, file), element.get("type", "")
    if kind not in (*JOINT_TYPES, "continuous") or element.find("mimic") is not None:
        raise ModelError(
            f"{where}: type '{kind}', expected one of {['continuous', *JOINT_TYPES]}, without <mimic>; coupled "
            "joints are not supported, and a robot that floats needs no joint, its planar base is added"
        )
    axis_element = None if kind == "fixed" else element.find("axis")
    axis = np.array(_numbers(axis_element, "xyz", "1 0 0", 3, f"{where} <axis>"))
    if abs(math.hypot(*axis) - 1.0) > _ALMOST_ONE:
        raise ModelError(f"{where}: axis {axis} has length {math.hypot(*axis):g}, expected 1")
    if kind != "fixed":
        axis = turns[child] @ axis
    limit = element.find("limit")
    speed, low, high = (
        _numbers(limit, key, "0", 1, f"{where} <limit>")[0]
        for key in ("velocity", "lower", "upper")
    )
    place = _origin(element, where, turns[parent])[0]
    speed = speed if 0.0 < speed < FREE else math.inf
    stated = limit is not None and {"lower", "upper"} <= limit.attrib.keys() and kind == "revolute"
    stated = stated and 0.0 < high - low < 2.0 * math.pi
    ends = (low, high) if stated else (-math.inf, math.inf)
    kind = "revolute" if kind == "continuous" else kind
    return Joint(element.get("name", ""), kind, parent, child, place, _vector(axis), speed, ends)
