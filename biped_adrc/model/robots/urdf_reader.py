"""Reading the URDF of a planar robot: frames of any orientation become parallel at zero angles.

The rest of the package works with parallel frames (`urdf.Joint`). With R_p the rotation of the parent's
frame at zero angles and (x, R) the origin of a joint in it,

    R_c = R_p R,   x' = R_p x,   n' = R_c n                          (joints)
    c' = R_c c,    I' = (R_c R_i) I (R_c R_i)'                       (bodies)

so a leg that hangs down by an origin of rpy = (0, pi, 0) becomes a leg that points along -z. Angles
keep their names, senses and zeros. A `continuous` joint becomes `revolute`, for which nq = nv. Where the
joints turn about another horizontal axis than y, the whole robot is turned about z until they do.
Shapes that are meshes or stand oblique after the turn are not kept: the tree has upright primitives only.

Kept beside the tree are <limit effort lower upper>, the friction <dynamics damping friction>, and the
inertia J of a rotor behind a gear of ratio N, reflected to its joint: N^2 J, from <transmission>
(`mechanicalReduction` and `motorInertia`, or Drake's `gear_ratio` and `rotor_inertia`). Every ModelError names
the file, the element, what was found and what was expected.
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
    Note,
    Tree,
    Vector,
    Visual,
    check_inertial,
)
from biped_adrc.model.robots.urdf_elements import (
    LARGEST,
    by_joint,
    name_of,
    numbers,
    parse,
    place_of,
    required,
)

PLANAR = 1e-4
"""Largest deviation of an axis from the plane, since rpy is rounded in files, dimensionless."""
SMALLEST = 1e-9
"""Least size of a shape [m]."""
_ALMOST_ONE = 1e-6  # how far an axis may be from unit length, dimensionless
_ROUND_OFF = 1e-15  # entries of a turn below this are the round-off of pi, dimensionless
_UPRIGHT = 1e-6  # how far a shape's axes may be from the frame's, dimensionless
_SLENDER = np.array([1.0, 0.0, 0.0, 1.0, 0.0, 0.05])  # moments of a link along z over its iyy
_CIRCULAR = ("revolute", "continuous")
_SLIDING = ("prismatic", "planar", "floating")
_GEARS, _ROTORS = ("mechanicalReduction", "gear_ratio"), ("motorInertia", "rotor_inertia")
_USED = re.compile(
    "link|joint|transmission|inertial|visual|origin|parent|child|axis|limit|dynamics"
)


@dataclass(frozen=True)
class Contents:
    """Content of a robot's file: the tree with parallel frames, and limits, friction and rotors by joint."""

    tree: Tree
    """Links and joints with parallel frames."""
    effort: Mapping[str, float]
    """Torque limits [N m], where <limit effort> is given."""
    ranges: Mapping[str, tuple[float, float]]
    """Lower and upper end [rad] of revolute joints that cannot turn all the way round."""
    viscous: Mapping[str, float]
    """Viscous friction [N m s/rad], where <dynamics damping> is given."""
    static: Mapping[str, float]
    """Static friction [N m], where <dynamics friction> is given."""
    rotor: Mapping[str, float]
    """Inertia of the rotor, reflected to the joint [kg m^2], where the file has one."""
    notes: tuple[Note, ...]
    """What was assumed and left out."""


def read(path: Path | str, tips: Mapping[str, Vector] | None = None) -> Contents:
    """Read and check a URDF.

    tips: link -> a place in its own frame [m] where a link without mass, `LINK_tip`, is added: a foot for legs
    that end with a shin. Raises ModelError.
    """
    robot, file = parse(path), f"URDF '{path}'"
    for link, place in (tips or {}).items():
        _add_tip(robot, link, place)
    movers = robot.findall("joint")
    ends = [_ends(joint, file) for joint in movers]
    names = {link.get("name") for link in robot.findall("link")}
    if "world" not in names and any(parent == "world" for parent, _ in ends):
        ET.SubElement(robot, "link", name="world")
    bodies = robot.findall("link")
    for (tag, name), count in Counter(
        (e.tag, name_of(e, file)) for e in (*bodies, *movers)
    ).items():
        if count > 1:
            raise ModelError(f"{file}: two {tag}s are named '{name}'; names must differ")
    order = [link.get("name", "") for link in bodies]
    turns = _turns(order, movers, ends, file, np.eye(3))
    yaw = _yaw(movers, ends, turns, file)
    if yaw:
        turns = _turns(order, movers, ends, file, _clean(pin.rpy.rpyToMatrix(0.0, 0.0, yaw)))
    still = _still(robot, movers, ends)
    links = {link.get("name", ""): _link(link, file, turns) for link in bodies}
    joints = tuple(_joint(j, file, turns, *pair) for j, pair in zip(movers, ends, strict=True))
    robot.set("name", robot.get("name", Path(path).stem))
    turning = [joint for joint in movers if joint.get("type") in _CIRCULAR]
    low, high = (by_joint(turning, "limit", key, file, -LARGEST) for key in ("lower", "upper"))
    return Contents(
        Tree(name_of(robot, file), links, joints, str(path)),
        by_joint(turning, "limit", "effort", file),
        {
            name: (low[name], high[name])
            for name in low
            if name in high and 0.0 < high[name] - low[name] < 2.0 * math.pi
        },
        by_joint(turning, "dynamics", "damping", file),
        by_joint(turning, "dynamics", "friction", file),
        _rotors(robot, file),
        _notes(robot, links, still, yaw),
    )


def _still(robot: ET.Element, joints: list[ET.Element], ends: list[tuple[str, str]]) -> set[str]:
    """Links that cannot move: "world", and a root on which a base slides; their masses are not the robot's.

    They are taken off the elements, so that nothing checks them; the result names those that had masses.
    """
    children = {child for _, child in ends}
    bases = {a for j, (a, _) in zip(joints, ends, strict=True) if j.get("type") in _SLIDING}
    heavy = set()
    for link in robot.findall("link"):
        name = link.get("name", "")
        if name not in children and (name == "world" or name in bases):
            for body in link.findall("inertial"):
                link.remove(body)
                heavy.add(name)
    return heavy


def _notes(
    robot: ET.Element, links: Mapping[str, Link], still: set[str], yaw: float
) -> tuple[Note, ...]:
    """What was assumed of a URDF, and what of it was left out."""
    bodies = robot.findall("link")
    points = [
        e.get("name")
        for e in bodies
        if e.find("inertial") is not None and e.find("inertial/inertia") is None
    ]
    undrawn = [
        link.name
        for e, link in zip(bodies, links.values(), strict=True)
        if len(e.findall("visual")) > len(link.visuals)
    ]
    parts = (child.tag for e in (robot, *bodies, *robot.findall("joint")) for child in e)
    other = Counter(tag for tag in parts if not _USED.fullmatch(tag))
    return tuple(
        Note(kind, text)
        for kind, text, applies in (
            (
                "assumed",
                f"direction: turned by {math.degrees(yaw):g} deg about z, so that axes are y",
                yaw,
            ),
            ("assumed", f"masses of {points}: points, as they have no <inertia>", points),
            ("left out", f"masses of {sorted(still)}, which do not move", still),
            ("left out", f"shapes of {undrawn}: meshes, or primitives that stand oblique", undrawn),
            ("left out", ", ".join(f"<{tag}> x {k}" for tag, k in other.items()), other),
        )
        if applies
    )


def _rotors(robot: ET.Element, file: str) -> dict[str, float]:
    """N^2 J [kg m^2] by joint of each <transmission> that has the inertia J of its rotor; N is 1 if missing."""
    result = {}
    for transmission in robot.findall("transmission"):
        found = {e.tag.rpartition("}")[2]: e for e in transmission.iter()}
        J, N = (next((found[t] for t in tags if t in found), None) for tags in (_ROTORS, _GEARS))
        joint = transmission.find("joint")
        if J is None or joint is None:
            continue
        where = f"{place_of(transmission, file)} <{J.tag}>"
        for e in (J, *(() if N is None else (N,))):  # a text, or Drake's attribute
            e.set("value", e.get("value", e.text or ""))
        inertia = numbers(J, "value", "", 1, where, 0.0)[0]
        result[joint.get("name", "")] = numbers(N, "value", "1", 1, where)[0] ** 2 * inertia
    return result


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


# -- frames ----------------------------------------------------------------------------------------
def _ends(joint: ET.Element, file: str) -> tuple[str, str]:
    """Names of the parent and the child link of a joint."""
    where = place_of(joint, file)
    parent, child = (
        name_of(required(joint, role, where), where, "link") for role in ("parent", "child")
    )
    return parent, child


def _turns(
    links: list[str], joints: list[ET.Element], ends: list[tuple[str, str]], file: str, R: Array
) -> dict[str, Array]:
    """Rotation (3, 3) of each link at zero angles, from its axes to those of the world; link -> rotation.

    ends: (parent, child) of each joint. R (3, 3): of the root. Raises ModelError unless the links are one tree.
    """
    parents = Counter(child for _, child in ends)
    roots = [link for link in links if link not in parents]
    turns = dict.fromkeys(roots, R)
    each = list(zip(joints, ends, strict=True))
    while below := [(j, a, b) for j, (a, b) in each if a in turns and b not in turns]:
        for joint, parent, child in below:
            turns[child] = _origin(joint, place_of(joint, file), turns[parent])[1]
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


def _yaw(
    joints: list[ET.Element], ends: list[tuple[str, str]], turns: Mapping[str, Array], file: str
) -> float:
    """Angle [rad] about z that turns the axis of the first joint to y or -y; 0 where it is not horizontal.

    From -pi/2, which makes a robot that walks along y walk along x, to below pi/2.
    """
    for joint, pair in zip(joints, ends, strict=True):
        if joint.get("type") in _CIRCULAR:
            x, y, z = _joint(joint, file, turns, *pair).axis
            yaw = (math.atan2(x, y) + 0.5 * math.pi) % math.pi - 0.5 * math.pi
            return yaw if abs(z) < PLANAR and abs(math.sin(yaw)) > PLANAR else 0.0
    return 0.0


def _clean(turn: Array) -> Array:
    """A turn whose round-off of pi is set to zero, so that turns by right angles stay exact."""
    return np.where(np.abs(turn) < _ROUND_OFF, 0.0, turn)


def _origin(element: ET.Element, where: str, R: Array) -> tuple[Vector, Array]:
    """Position R xyz [m] and rotation R R_rpy (3, 3) of the <origin> of `element`.

    R (3, 3): from the axes of the element to the result's. where: place in the file, for errors.

    rpy turns about the fixed axes x, y, z in this order.
    """
    origin, where = element.find("origin"), f"{where} <origin>"
    place = numbers(origin, "xyz", "0 0 0", 3, where)
    turn = pin.rpy.rpyToMatrix(*numbers(origin, "rpy", "0 0 0", 3, where))
    return _vector(R @ place), R @ _clean(turn)


def _vector(values: Array) -> Vector:
    """The three entries of an array as a tuple."""
    x, y, z = values.tolist()
    return x, y, z


# -- links and joints ------------------------------------------------------------------------------
def _link(element: ET.Element, file: str, turns: Mapping[str, Array]) -> Link:
    """The link of an element, in parallel axes; turns: rotation of each link. Raises ModelError."""
    where, R = place_of(element, file), turns[element.get("name", "")]
    visuals = tuple(v for e in element.findall("visual") if (v := _visual(e, where, R)) is not None)
    body, inertial = element.find("inertial"), None
    if body is not None:
        inertial = _inertial(body, where, R)
        if inertial.mass or any(inertial.inertia):  # else it is a frame
            check_inertial(inertial, where)
        else:
            inertial = None
    return Link(element.get("name", ""), inertial, visuals)


def _inertial(element: ET.Element, where: str, R: Array) -> Inertial:
    """Mass properties of an element, in axes turned by R.

    A body with a moment about y alone, as some planar URDFs have, gets those of a slender link along z,
    which do not enter planar motion. Without <inertia> it is a point.
    """
    mass = numbers(required(element, "mass", where), "value", "", 1, f"{where} <mass>")[0]
    com, turn = _origin(element, f"{where} <inertial>", R)
    inertia, where = element.find("inertia"), f"{where} <inertia>"
    moments = np.array([numbers(inertia, key, "0", 1, where)[0] for key in MOMENTS])
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
    size = sum((numbers(shape, key, "", count, where, SMALLEST) for key in keys), ())
    rgba = numbers(element.find("material/color"), "rgba", "0.5 0.5 0.5 1", 4, where)
    size = _vector(axes @ size) if box else size
    return Visual(shape.tag, size, place, tuple(np.clip(rgba, 0.0, 1.0).tolist()))


def _joint(
    element: ET.Element, file: str, turns: Mapping[str, Array], parent: str, child: str
) -> Joint:
    """The joint of an element, with its place and axis in the turned axes.

    Raises ModelError for unknown types, mimic joints and axes that are not of unit length.
    """
    where, kind = place_of(element, file), element.get("type", "")
    if kind not in (*JOINT_TYPES, "continuous") or element.find("mimic") is not None:
        raise ModelError(
            f"{where}: type '{kind}', expected one of {['continuous', *JOINT_TYPES]}, without <mimic>; coupled "
            "joints are not supported"
        )
    axis_element = None if kind in ("fixed", "floating") else element.find("axis")
    axis = np.array(numbers(axis_element, "xyz", "1 0 0", 3, f"{where} <axis>"))
    if abs(math.hypot(*axis) - 1.0) > _ALMOST_ONE:
        raise ModelError(f"{where}: axis {axis} has length {math.hypot(*axis):g}, expected 1")
    if kind != "fixed":
        axis = turns[child] @ axis
    speed = numbers(element.find("limit"), "velocity", "0", 1, f"{where} <limit>")[0]
    place = _origin(element, where, turns[parent])[0]
    speed = speed if 0.0 < speed < FREE else math.inf
    kind = "revolute" if kind == "continuous" else kind
    return Joint(element.get("name", ""), kind, parent, child, place, _vector(axis), speed)
