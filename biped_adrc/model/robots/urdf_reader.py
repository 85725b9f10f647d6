"""Reading a URDF: a strict one with parallel frames, or any planar robot, whose frames may be turned.

The rest of the package works with parallel frames at zero angles (`urdf.Joint`). `load_tree`
demands them, for the robots of the package. `read` accepts frames of any orientation and turns them
parallel, for `robot_import`. With R_p the rotation of the parent's frame at zero angles and (x, R)
the origin of a joint in it,

    R_c = R_p R,   x' = R_p x,   n' = R_c n                          (joints)
    c' = R_c c,    I' = (R_c R_i) I (R_c R_i)'                       (bodies)

so a leg that hangs down by an origin of rpy = (0, pi, 0) becomes a leg that points along -z. Angles
keep their names, senses and zeros. A `continuous` joint becomes `revolute`, for which nq = nv.
Shapes that are meshes or stand oblique after the turn are not kept: the strict tree has upright
primitives only.

The limits <limit effort lower upper> and the friction <dynamics damping friction> are kept beside
the tree. Every ModelError names the file, the element, what was found and what was expected.
"""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import numpy as np
import pinocchio as pin

from biped_adrc.errors import ModelError
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
    validated,
)
from biped_adrc.model.robots.urdf_xml import expanded, parse
from biped_adrc.types import Array

LARGEST = 1e100
"""Bound on every number in a URDF, in any unit; products of larger ones overflow."""
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
_ALMOST_ONE = 1e-6  # how far an axis may be from unit length, dimensionless
_ROUND_OFF = 1e-15  # entries of a turn below this are the round-off of pi, dimensionless
_UPRIGHT = 1e-6  # how far a shape's axes may be from the frame's, dimensionless
_CIRCULAR = ("revolute", "continuous")

Turns = Mapping[str, Array] | None
"""Rotation R (3, 3) of every link at zero angles; None where all frames have to be parallel."""


@dataclass(frozen=True)
class UrdfContents:
    """A robot with parallel frames, and what its file says beside the tree, by joint."""

    tree: Tree
    """Links and joints with parallel frames."""
    effort: Mapping[str, float]
    """Torque limits [N m], where <limit effort> is given."""
    ranges: Mapping[str, tuple[float, float]]
    """Lower and upper end [rad], of revolute joints that cannot turn all the way round."""
    viscous: Mapping[str, float]
    """Viscous friction [N m s/rad], where <dynamics damping> is given."""
    static: Mapping[str, float]
    """Static friction [N m], where <dynamics friction> is given."""
    undrawn: tuple[str, ...]
    """Links with a shape that was not kept: a mesh, or one that stands oblique."""
    flat: tuple[str, ...]
    """Links with a moment about y alone; they got moments of a slender link about x and z, which do
    not enter planar motion.
    """


def load_tree(path: Path | str) -> Tree:
    """Read and validate a URDF file with parallel frames, as the robots of the package have.

    Raises ModelError that names the file, the element, what was found and what was expected.
    """
    return _tree(parse(path), str(path), None)[0]


def read(path: Path | str, tips: Mapping[str, Vector] | None = None) -> UrdfContents:
    """Read and validate a URDF with frames of any orientation.

    tips: by link, a place in its own frame [m] where a link without mass, `LINK_tip`, is put: a
    foot for legs that end with a shin. Raises ModelError.
    """
    path = Path(path)
    source, robot = str(path), expanded(path)
    for link, place in (tips or {}).items():
        _add_tip(robot, link, place)
    tree, flat = _tree(robot, source, _turns(robot, source))
    shapes = ((e.get("name", ""), len(e.findall("visual"))) for e in robot.findall("link"))
    undrawn = tuple(name for name, count in shapes if count > len(tree.links[name].visuals))
    moving = [j for j in robot.findall("joint") if j.get("type") in _CIRCULAR]
    low, high = (_by_joint(moving, "limit", key, source, -math.inf) for key in ("lower", "upper"))
    return UrdfContents(
        tree,
        _by_joint(moving, "limit", "effort", source),
        {
            name: (low[name], high[name])
            for name in low
            if name in high and 0.0 < high[name] - low[name] < 2.0 * math.pi
        },
        _by_joint(moving, "dynamics", "damping", source),
        _by_joint(moving, "dynamics", "friction", source),
        undrawn,
        flat,
    )


def tip_of(link: str) -> str:
    """Name of the link that `read` puts at the tip of `link`."""
    return f"{link}_tip"


def _add_tip(robot: ET.Element, link: str, place: Vector) -> None:
    """Add a link without mass, fixed at a place [m] in the frame of `link`."""
    ET.SubElement(robot, "link", name=tip_of(link))
    joint = ET.SubElement(robot, "joint", name=f"{tip_of(link)}_mount", type="fixed")
    ET.SubElement(joint, "parent", link=link)
    ET.SubElement(joint, "child", link=tip_of(link))
    ET.SubElement(joint, "origin", xyz=" ".join(repr(float(x)) for x in place))


def place_of(element: ET.Element, source: str) -> str:
    """How messages call a link or joint: file, kind of element and name."""
    return f"URDF '{source}', {element.tag} '{element.get('name')}'"


def _by_joint(
    joints: list[ET.Element], tag: str, key: str, source: str, least: float = 0.0
) -> dict[str, float]:
    """The number <tag key> of each joint that has it. Raises ModelError when it is below `least`."""
    found = {}
    for joint in joints:
        element = joint.find(tag)
        if element is None or key not in element.attrib:
            continue
        where = f"{place_of(joint, source)} <{tag}>"
        value = numbers(element, key, "", 1, where)[0]
        if value < least:
            raise ModelError(f"{where}: {key} is {value:g}, expected a number >= 0")
        found[joint.get("name", "")] = value
    return found


def numbers(element: ET.Element | None, key: str, default: str, count: int, where: str) -> Vector:
    """`count` finite numbers of an attribute, `default` where it is missing; for xyz, rpy, rgba and size.

    Raises ModelError that quotes the attribute after `where`. Only decimal notation counts: Python
    would also read "nan", "inf" and "1_0".
    """
    text = default if element is None else element.get(key, default)
    words = text.split()
    values = tuple(float(word) for word in words) if all(map(_NUMBER.fullmatch, words)) else ()
    if len(values) != count or not all(abs(value) < LARGEST for value in values):
        raise ModelError(
            f"{where}: {key}={text!r}, expected {count} finite number(s) below {LARGEST:g}"
        )
    return values  # type: ignore[return-value]


def _required(element: ET.Element, tag: str, where: str) -> ET.Element:
    """The first child <tag>. Raises ModelError where it is missing."""
    found = element.find(tag)
    if found is None:
        raise ModelError(f"{where}: <{tag}> is missing")
    return found


def _name(element: ET.Element, key: str, where: str) -> str:
    """The attribute `key`. Raises ModelError where it is missing or empty."""
    name = element.get(key)
    if not name:
        raise ModelError(f"{where}: <{element.tag}> has no '{key}'")
    return _printable(name, element.tag, where)


def _printable(name: str, tag: str, where: str) -> str:
    """The name itself. Raises ModelError for line breaks and tabs, which would spoil tables and messages."""
    if not name.isprintable():
        raise ModelError(
            f"{where}: <{tag}> names {name!r}, expected a name on one line, without tabs"
        )
    return name


def _turns(robot: ET.Element, source: str) -> dict[str, Array]:
    """Rotation R (3, 3) of every link at zero angles, from the roots down; each link is met once.

    Closed chains are refused later, by `validated`; here they only must not loop for ever.
    """

    def link_of(joint: ET.Element, role: str) -> str:
        found = joint.find(role)
        return "" if found is None else found.get("link", "")

    joints = robot.findall("joint")
    children = {link_of(joint, "child") for joint in joints}
    names = [link.get("name", "") for link in robot.findall("link")]
    turns = {name: np.eye(3) for name in names if name not in children}
    edge = list(turns)
    while edge:
        below = [j for j in joints if link_of(j, "parent") in edge]
        edge = []
        for joint in below:
            child = link_of(joint, "child")
            if child not in turns:
                turn = _origin(joint, place_of(joint, source), turns[link_of(joint, "parent")])[1]
                turns[child] = np.eye(3) if turn is None else turn
                edge.append(child)
    return turns


def _origin(element: ET.Element, where: str, R: Array | None) -> tuple[Vector, Array | None]:
    """Place [m] and rotation (3, 3) of an <origin> in axes turned by R; None for R demands parallel frames.

    rpy turns about the fixed axes x, y, z in this order. Round-off of pi in rpy is set to zero, so
    that turns by right angles stay exact.
    """
    origin, where = element.find("origin"), f"{where} <origin>"
    rpy = numbers(origin, "rpy", "0 0 0", 3, where)
    if R is None and any(rpy):
        raise ModelError(
            f"{where.removesuffix(' <origin>')}: <origin> has a rotation (rpy); expected parallel frames at "
            "zero angles. Turn the geometry and the inertia into the parent's axes instead"
        )
    place = numbers(origin, "xyz", "0 0 0", 3, where)
    if R is None or origin is None:
        return place, R
    own: Array = pin.rpy.rpyToMatrix(*rpy)
    return _vector(R @ place), R @ np.where(np.abs(own) < _ROUND_OFF, 0.0, own)


def _vector(values: Array) -> Vector:
    """Three entries of an array as a tuple."""
    x, y, z = values.tolist()
    return x, y, z


def _tree(root: ET.Element, source: str, turns: Turns) -> tuple[Tree, tuple[str, ...]]:
    """The tree that <robot> describes, and its links whose moments had to be completed."""
    links: dict[str, Link] = {}
    flat: list[str] = []
    for element in root.findall("link"):
        name = _name(element, "name", f"URDF '{source}'")
        where = place_of(element, source)
        R = None if turns is None else turns.get(name, np.eye(3))
        visuals = [_visual(v, where, R) for v in element.findall("visual")]
        inertial = element.find("inertial")
        body, completed = (None, False) if inertial is None else _inertial(inertial, where, R)
        if name in links:
            raise ModelError(f"URDF '{source}': two links are named '{name}'; names must differ")
        links[name] = Link(name, body, tuple(v for v in visuals if v is not None))
        flat += [name] if completed else []
    joints = tuple(_joint(element, source, turns) for element in root.findall("joint"))
    name = _printable(root.get("name", Path(source).stem), "robot", f"URDF '{source}'")
    return validated(Tree(name, links, joints, source)), tuple(flat)


def _inertial(element: ET.Element, where: str, R: Array | None) -> tuple[Inertial, bool]:
    """The body in axes turned by R, and whether its moments had to be completed."""
    mass = numbers(_required(element, "mass", where), "value", "", 1, f"{where} <mass>")[0]
    com, own = _origin(element, f"{where} <inertial>", R)
    inertia = _required(element, "inertia", where)
    moments, completed = _moments(inertia, f"{where} <inertia>", own)
    return Inertial(mass, com, tuple(moments.tolist())), completed


def _moments(inertia: ET.Element, where: str, R: Array | None) -> tuple[Array, bool]:
    """xx, xy, xz, yy, yz, zz (6,) [kg m^2] turned by R, and whether they were completed.

    A body with yy alone, as some planar URDFs have, gets the moments of a slender link along z.
    """

    def given(default: str = "") -> Array:
        defaults = (default if key[1] == key[2] else "0" for key in MOMENTS)
        read = zip(MOMENTS, defaults, strict=True)
        return np.array([numbers(inertia, key, text, 1, where)[0] for key, text in read])

    if R is None:
        return given(), False
    parallel = np.array_equal(R, np.eye(3))
    found = given("0" if parallel else "")
    if not parallel:
        turned = R @ found[SYMMETRIC] @ R.T
        found = (0.5 * (turned + turned.T))[np.triu_indices(3)]
    yy = found[3]
    if yy > 0.0 and np.all(np.abs(np.delete(found, 3)) <= _ROUND_OFF * yy):
        return yy * np.array([1.0, 0.0, 0.0, 1.0, 0.0, 0.05]), True
    return (given() if parallel else found), False


def _visual(element: ET.Element, where: str, R: Array | None) -> Visual | None:
    """A shape in axes turned by R; None where frames may be turned and it is no upright primitive then.

    Raises ModelError for sizes or colours that are impossible.
    """
    geometry = element.find("geometry")
    if geometry is None and R is None:
        geometry = _required(element, "geometry", f"{where} <visual>")
    shapes = () if geometry is None else tuple(geometry)
    shape = next((g for g in shapes if g.tag in GEOMETRY_SIZES), None)
    if shape is None and R is None:
        found = ", ".join(f"<{g.tag}>" for g in shapes) or "nothing"
        raise ModelError(f"{where} <visual>: found {found}, expected one of {list(GEOMETRY_SIZES)}")
    place, own = _origin(element, f"{where} <visual>", R)
    if shape is None:
        return None
    axes = np.eye(3)
    if own is not None:
        axes = np.asarray(np.round(np.abs(own)), dtype=np.float64)
        oblique = {"box": np.max(np.abs(np.abs(own) - axes)), "cylinder": 1.0 - abs(own[2, 2])}
        if not abs(oblique.get(shape.tag, 0.0)) < _UPRIGHT:
            return None
    count, keys = (3 if shape.tag == "box" else 1), GEOMETRY_SIZES[shape.tag]
    read = (numbers(shape, k, "", count, f"{where} <{shape.tag}>") for k in keys)
    size = tuple(chain.from_iterable(read))
    if shape.tag == "box":
        size = _vector(axes @ size)
    if min(size) <= 0:
        raise ModelError(f"{where} <{shape.tag}>: sizes {size}, expected positive numbers")
    colour = element.find("material/color")
    rgba = numbers(colour, "rgba", "0.5 0.5 0.5 1", 4, f"{where} <color>")
    if not all(0.0 <= part <= 1.0 for part in rgba):
        raise ModelError(f"{where} <color>: rgba {rgba}, expected numbers between 0 and 1")
    return Visual(shape.tag, size, place, rgba)  # type: ignore[arg-type]


def _joint(element: ET.Element, source: str, turns: Turns) -> Joint:
    """A joint with its place and axis in the turned axes. Raises ModelError for unknown types, mimic
    joints and axes that are not of unit length.
    """
    name = _name(element, "name", f"URDF '{source}'")
    where = place_of(element, source)
    kind = _name(element, "type", where)
    known = JOINT_TYPES if turns is None else ("continuous", *JOINT_TYPES)
    if kind not in known:
        hint = (
            "give a 'continuous' joint as 'revolute' with wide limits"
            if turns is None
            else "a robot that floats needs no joint for that, its planar base is added"
        )
        raise ModelError(f"{where}: type '{kind}', expected one of {list(known)}; {hint}")
    if turns is not None and element.find("mimic") is not None:
        raise ModelError(
            f"{where}: it mimics another joint; coupled joints are not supported, give it a motor of its own "
            "or make it 'fixed'"
        )
    parent, child = (
        _name(_required(element, role, where), "link", where) for role in ("parent", "child")
    )
    above, below = (None if turns is None else turns.get(x, np.eye(3)) for x in (parent, child))
    given = None if below is not None and kind == "fixed" else element.find("axis")
    axis = numbers(given, "xyz", "1 0 0", 3, f"{where} <axis>")
    if below is not None and kind != "fixed":
        axis = _vector(below @ axis)
    if abs(math.hypot(*axis) - 1.0) > _ALMOST_ONE:
        raise ModelError(f"{where}: axis {axis} has length {math.hypot(*axis):g}, expected 1")
    kind = "revolute" if kind == "continuous" else kind
    speed = numbers(element.find("limit"), "velocity", "0", 1, f"{where} <limit>")[0]
    place = _origin(element, where, above)[0]
    return Joint(name, kind, parent, child, place, axis, speed if 0.0 < speed < FREE else math.inf)
