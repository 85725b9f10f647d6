"""Reading the URDF of a planar robot: frames of any orientation become parallel at zero angles.

The rest of the package works with parallel frames (`urdf.Joint`). With R_p the rotation of the parent's
frame at zero angles and (x, R) the origin of a joint in it,

    R_c = R_p R,   x_w = R_p x,   n_w = R_c n                        (joints)
    c_w = R_c c,   I_w = (R_c R_i) I (R_c R_i)^T                     (bodies)

In parallel axes the joint has the place x_w and the axis n_w, the child the COM c_w and the moments I_w; n, c
and I are those in the file, in the child's frame, and R_i is the rotation of its <inertial>. R_c, the rotation
of a link from its axes in the file to those of the world, is called its turn. So a leg that hangs down by an
origin of rpy = (0, pi, 0) becomes a leg that points along -z. Angles keep their names,
senses and zeros. A `continuous` joint becomes `revolute`, for which nq = nv. Where the joints turn about
another horizontal axis than y, the whole robot is turned about z until they do. Shapes that are meshes or stand
oblique after the turn are not kept: the tree has upright primitives only.

Kept beside the tree are <limit effort>, the friction <dynamics damping friction>, and the
inertia J of a rotor behind a gear of ratio N, reflected to its joint: N^2 J, from <transmission>
(`mechanicalReduction`, 1 if missing, and `motorInertia`). Every ModelError names file and element,
what was found and what was expected.
"""

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
from biped_adrc.model.robots import urdf
from biped_adrc.model.robots.urdf import Inertial, Joint, Link, Note, Tree, Triple, Visual, vector

MOST_LINKS = 200
"""Largest number of links of a robot."""
_LARGEST = 1e100
"""Bound on every number in a URDF, in any unit; products of larger ones overflow."""
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
PLANAR = 1e-4
"""Largest deviation of an axis from the plane, since rpy is rounded in files, dimensionless."""
_ROUND_OFF = 1e-15  # entries of a turn below this are the round-off of pi, dimensionless
_CIRCULAR = ("revolute", "continuous")


@dataclass(frozen=True)
class Contents:
    """Content of a robot's file: the tree with parallel frames, and torques, friction and rotors by joint."""

    tree: Tree
    """Links and joints with parallel frames."""
    effort: Mapping[str, float]
    """Torque limits [N m], where <limit effort> is given."""
    viscous: Mapping[str, float]
    """Viscous friction [N m s/rad], where <dynamics damping> is given."""
    static: Mapping[str, float]
    """Static friction [N m], where <dynamics friction> is given."""
    rotor: Mapping[str, float]
    """Inertia of the rotor, reflected to the joint [kg m^2], where the file has one."""
    turns: Mapping[str, Array]
    """Rotation (3, 3) by link, from the axes that it has in the file to those of the world."""
    notes: tuple[Note, ...]
    """Sentences on what the reader assumed and left out."""


def parse(path: Path) -> ET.Element:
    """The element <robot> of a URDF file; without a name it gets that of the file.

    Raises ModelError for another format, xacro macros, and more than MOST_LINKS links.
    """
    data = path.read_bytes()
    if path.suffix == ".xacro" or b"<xacro:" in data:
        raise ModelError(
            "it holds xacro macros, expected the URDF they expand to; try "
            f"'xacro {path.name} > robot.urdf' and give robot.urdf"
        )
    root = ET.fromstring(data.lstrip())
    space = root.tag.rpartition("robot")[0]
    for element in root.iter():  # a default namespace is the file's, not a part of names
        element.tag = element.tag.removeprefix(space)
    count = len(root.findall("link"))
    if root.tag != "robot" or count > MOST_LINKS:
        formats = {"mujoco": "MJCF, <mujoco>", "sdf": "SDF, <sdf>"}
        raise ModelError(
            f"{formats.get(root.tag, f'<{root.tag}>')} with {count} links, expected a URDF, <robot> with at "
            f"most {MOST_LINKS} links"
        )
    root.set("name", root.get("name", path.stem))
    return root


def read(path: Path | str) -> Contents:
    """Read and check a URDF. Raises ModelError that names the file and the element."""
    with reading("URDF", path, ModelError):
        return _contents(parse(Path(path)), str(path))


def _contents(robot: ET.Element, source: str) -> Contents:
    """The content of an element <robot>; source: its file. Raises ModelError that names the element only."""
    movers = robot.findall("joint")
    # names of the parent and the child link of each joint
    ends = [_ends(joint) for joint in movers]
    names = {link.get("name") for link in robot.findall("link")}
    # files may hang the robot on a link "world" that they do not define
    if "world" not in names and any(parent == "world" for parent, _ in ends):
        ET.SubElement(robot, "link", name="world")
    bodies = robot.findall("link")
    for (tag, name), count in Counter((e.tag, _name(e)) for e in (*bodies, *movers)).items():
        if count > 1:
            raise ModelError(f"two {tag}s are named '{name}'; names must differ")
    order = [link.get("name", "") for link in bodies]
    turns = _turns(order, movers, ends, np.eye(3))
    # with the root as in the file; again, turned about z, where the joints turn about another axis than y;
    # _clean: 0 in place of round-off
    yaw = _yaw(movers, ends, turns)
    if yaw:
        turns = _turns(order, movers, ends, _clean(pin.rpy.rpyToMatrix(0.0, 0.0, yaw)))
    moved = {child for _, child in ends}
    links = {link.get("name", ""): _link(link, turns, moved) for link in bodies}
    joints = tuple(_joint(j, turns, *pair) for j, pair in zip(movers, ends, strict=True))
    # those with an angle; of these limit and friction are kept, by (element, attribute)
    turning = [joint for joint in movers if joint.get("type") in _CIRCULAR]
    tree = Tree(_name(robot), links, joints, source)
    keys = ("limit", "effort"), ("dynamics", "damping"), ("dynamics", "friction")
    effort, viscous, static = (_by_joint(turning, *key) for key in keys)
    notes = _notes(robot, links, yaw)
    return Contents(tree, effort, viscous, static, _rotors(robot), turns, notes)


def _notes(robot: ET.Element, links: Mapping[str, Link], yaw: float) -> tuple[Note, ...]:
    """Notes on what the reader assumed about a URDF and what it leaves out.

    links: those that were read from `robot`. yaw [rad]: angle by which it was turned about z; 0 for none.
    """
    bodies = robot.findall("link")
    heavy = {link.get("name"): e for link in bodies if (e := link.find("inertial")) is not None}
    points = [name for name, e in heavy.items() if e.find("inertia") is None]
    frames = [name for name in heavy if name and links[name].inertial is None]
    shapes = zip(bodies, links.values(), strict=True)
    undrawn = [x.name for e, x in shapes if len(e.findall("visual")) > len(x.visuals)]
    parts = (child.tag for e in (robot, *bodies, *robot.findall("joint")) for child in e)
    # used: the elements that are read
    used = "link|joint|transmission|inertial|visual|origin|parent|child|axis|limit|dynamics"
    other = Counter(tag for tag in parts if not re.fullmatch(used, tag))
    # (kind, what was found, text): no note where it is 0 or empty
    notes = (
        ("assumed", yaw, f"direction: turned about z by {yaw:g} rad, so that axes are y"),
        ("assumed", points, f"masses of {points}: points, as they have no <inertia>"),
        ("left out", frames, f"<inertial> of {frames}: their mass is 0"),
        ("left out", undrawn, f"shapes of {undrawn}: meshes, or primitives that stand oblique"),
        ("left out", other, ", ".join(f"<{tag}> x {k}" for tag, k in other.items())),
    )
    return tuple(Note(kind, text) for kind, found, text in notes if found)


def _rotors(robot: ET.Element) -> dict[str, float]:
    """Inertia N^2 J [kg m^2] of the rotor of each <transmission>, by the name of its joint.

    N is the text of <mechanicalReduction>, 1 if missing; without <motorInertia> J the joint is left out.
    """
    result, tags = {}, ("mechanicalReduction", "motorInertia")
    for e in robot.iterfind("transmission[joint]"):
        texts = {tag: e.findtext(f".//{tag}", "1") for tag in tags}
        if e.find(".//motorInertia") is not None:
            # `_numbers` reads attributes, so the texts become those of an element
            numbers = ET.Element("transmission", texts)
            N, J = (_numbers(numbers, tag, "", 1, "<transmission>")[0] for tag in texts)
            result[_required(e, "joint", "<transmission>").get("name", "")] = N * N * J
    return result


# -- attributes ------------------------------------------------------------------------------------
def _place_of(element: ET.Element) -> str:
    """Text for messages that names a link or joint: kind of element and name."""
    return f"{element.tag} '{element.get('name')}'"


def _name(element: ET.Element, where: str = "", key: str = "name") -> str:
    """The attribute `key` of an element, after a check that it is printable text; where: start of the message.

    Line breaks and tabs would spoil tables and messages. Raises ModelError.
    """
    name = element.get(key, "")
    if not name or not name.isprintable():
        raise ModelError(f"{where}<{element.tag}> has {key}={name!r}, expected a name on one line")
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
    least: float = -_LARGEST,
) -> Triple:
    """`count` numbers of the attribute `key` of an element, none below `least`; those of the text `default`
    where the attribute or the element (None) is missing.

    Raises ModelError that quotes the attribute after `where`; so does a missing one with default "". Only
    decimal notation counts: Python would also read "nan", "inf" and "1_0".
    """
    text = default if element is None else element.get(key, default)
    words = text.split()
    values = tuple(float(word) for word in words) if all(map(_NUMBER.fullmatch, words)) else ()
    if len(values) != count or not all(least <= value < _LARGEST for value in values):
        raise ModelError(
            f"{where}: {key}={text!r}, expected {count} number(s) from {least:g} to {_LARGEST:g}"
        )
    return values  # type: ignore[return-value]


def _by_joint(joints: list[ET.Element], tag: str, key: str) -> dict[str, float]:
    """The number <tag key>, at least 0, of each joint that has it, by name of the joint."""
    values = {}
    for joint in joints:
        element = joint.find(tag)
        if element is not None and key in element.attrib:
            where = f"{_place_of(joint)} <{tag}>"
            # one number, no default, at least 0
            values[joint.get("name", "")] = _numbers(element, key, "", 1, where, 0.0)[0]
    return values


# -- frames ----------------------------------------------------------------------------------------
def _ends(joint: ET.Element) -> tuple[str, str]:
    """Names of the parent and the child link of a joint: the attribute `link` of its elements <parent> and
    <child>. Raises ModelError where one is missing."""
    where = _place_of(joint)
    elements = (_required(joint, role, where) for role in ("parent", "child"))
    parent, child = (_name(element, f"{where}: ", "link") for element in elements)
    return parent, child


def _turns(
    links: list[str], joints: list[ET.Element], ends: list[tuple[str, str]], R: Array
) -> dict[str, Array]:
    """Turn (3, 3) of each link at zero angles, from its axes to those of the world, by the link's name.

    ends: (parent, child) of each joint. R (3, 3): of the root. Raises ModelError unless the links are one tree.
    """
    parents = Counter(child for _, child in ends)
    roots = [link for link in links if link not in parents]
    turns = dict.fromkeys(roots, R)
    each = list(zip(joints, ends, strict=True))
    # from the root outwards: joints whose parent has its turn and whose child has none yet
    while below := [(j, a, b) for j, (a, b) in each if a in turns and b not in turns]:
        for joint, parent, child in below:
            # [1]: of (place, rotation) the rotation
            turns[child] = _origin(joint, _place_of(joint), turns[parent])[1]
    twice = [link for link, count in parents.items() if count > 1]
    circle = [link for link in links if link not in turns]
    missing = sorted({link for pair in ends for link in pair} - set(links))
    if len(roots) != 1 or twice or circle or missing:
        raise ModelError(
            f"links must hang in one tree; found the roots {roots}, links with two parent joints "
            f"{twice}, links in a circle {circle}, and joints of links {missing} that are not there. Closed "
            "chains are not supported"
        )
    return turns


def _yaw(joints: list[ET.Element], ends: list[tuple[str, str]], turns: dict[str, Array]) -> float:
    """Angle [rad] by which the robot must turn about z, so that the axis of its first revolute or continuous
    joint is y or -y; 0 if it is so already, or the axis is not horizontal.

    It is in [-pi/2, pi/2); -pi/2 makes a robot that walks along y walk along x.
    """
    for joint, pair in zip(joints, ends, strict=True):
        if joint.get("type") in _CIRCULAR:
            # sin(yaw) is 0 for an axis along y; the turn is modulo pi, as y and -y will both do
            x, y, z = _joint(joint, turns, *pair).axis
            yaw = (math.atan2(x, y) + 0.5 * math.pi) % math.pi - 0.5 * math.pi
            # PLANAR: largest deviation of an axis
            return yaw if abs(z) < PLANAR and abs(math.sin(yaw)) > PLANAR else 0.0
    return 0.0


def _clean(turn: Array) -> Array:
    """The turn (3, 3) with 0 for entries that are round-off of pi, so that right angles are exact."""
    return np.where(np.abs(turn) < _ROUND_OFF, 0.0, turn)


def _origin(element: ET.Element, where: str, R: Array) -> tuple[Triple, Array]:
    """Position R xyz [m] and rotation R R_rpy (3, 3) of the <origin> of `element`; 0 and
    R if there is none.

    R (3, 3): from the axes of the element to those of the result. where: place in the file, for errors.

    rpy turns about the fixed axes x, y, z in this order.
    """
    origin, where = element.find("origin"), f"{where} <origin>"
    place = _numbers(origin, "xyz", "0 0 0", 3, where)
    turn = pin.rpy.rpyToMatrix(*_numbers(origin, "rpy", "0 0 0", 3, where))
    return vector(R @ place), R @ _clean(turn)


# -- links and joints ------------------------------------------------------------------------------
def _link(element: ET.Element, turns: Mapping[str, Array], moved: set[str]) -> Link:
    """The link of an element <link>, in the axes of the world. Raises ModelError.

    Without mass and moments it is a frame, and so is a root without mass, such as a world. turns: turn (3, 3)
    by link. moved: names of the links that a joint carries, all but the root.
    """
    where, R = _place_of(element), turns[element.get("name", "")]
    visuals = tuple(v for e in element.findall("visual") if (v := _visual(e, where, R)) is not None)
    body, inertial = element.find("inertial"), None
    if body is not None:
        inertial = _inertial(body, where, R)
        if inertial.mass == 0.0 and not (any(inertial.inertia) and element.get("name") in moved):
            inertial = None  # moments without mass on a link that a joint carries are refused below
        else:
            urdf.check_inertial(inertial, where)
    return Link(element.get("name", ""), inertial, visuals)


def _inertial(element: ET.Element, where: str, R: Array) -> Inertial:
    """Mass properties of an element <inertial>, in the axes of the world.

    where: its link, for messages. R (3, 3): turn of its link.

    A body with a moment about y alone, as some planar URDFs have, gets those of a slender link along z,
    which do not enter planar motion. Without <inertia> it is a point.
    """
    mass = _numbers(_required(element, "mass", where), "value", "", 1, f"{where} <mass>")[0]
    com, turn = _origin(element, f"{where} <inertial>", R)
    inertia, where = element.find("inertia"), f"{where} <inertia>"
    moments = np.array([_numbers(inertia, key, "0", 1, where)[0] for key in urdf.MOMENTS])
    turned = turn @ moments[urdf.SYMMETRIC] @ turn.T
    # symmetric but for round-off; upper triangle in the order of MOMENTS, where entry 3 is yy
    moments = (0.5 * (turned + turned.T))[np.triu_indices(3)]
    yy = moments[3]
    flat = bool(yy > 0.0 and np.all(np.abs(np.delete(moments, 3)) <= _ROUND_OFF * yy))
    # moments of a slender link along z over its iyy, in place of a body that has one about y alone
    slender = np.array([1.0, 0.0, 0.0, 1.0, 0.0, 0.05])
    return Inertial(mass, com, tuple((yy * slender if flat else moments).tolist()))


def _visual(element: ET.Element, where: str, R: Array) -> Visual | None:
    """The shape of an element <visual> in the axes of the world; None if it is no box, sphere or cylinder, or
    stands oblique to these axes. where: its link, for messages. R (3, 3): turn of its link.
    """
    shape = next((g for g in element.iterfind("geometry/*") if g.tag in urdf.GEOMETRY_SIZES), None)
    if shape is None:
        return None
    place, turn = _origin(element, f"{where} <visual>", R)
    # the permutation of axes next to the turn; a cylinder must only have its axis along z
    axes = np.asarray(np.round(np.abs(turn)), dtype=np.float64)
    oblique = {"box": np.max(np.abs(np.abs(turn) - axes)), "cylinder": 1.0 - abs(turn[2, 2])}
    # 1e-6, dimensionless: how far the shape's axes may be from those of the frame
    if not abs(oblique.get(shape.tag, 0.0)) < 1e-6:
        return None
    where, box = f"{where} <{shape.tag}>", shape.tag == "box"
    count, keys = 3 if box else 1, urdf.GEOMETRY_SIZES[shape.tag]
    # the tuples of numbers of its attributes, joined to one; none is below 1e-9 m
    size = sum((_numbers(shape, key, "", count, where, 1e-9) for key in keys), ())
    rgba = _numbers(element.find("material/color"), "rgba", "0.5 0.5 0.5 1", 4, where)
    size = vector(axes @ size) if box else size
    return Visual(shape.tag, size, place, tuple(np.clip(rgba, 0.0, 1.0).tolist()))


def _joint(element: ET.Element, turns: Mapping[str, Array], parent: str, child: str) -> Joint:
    """The joint of an element <joint>, with place and axis in the axes of the world, speed limit and range.

    turns: turn (3, 3) by link. parent, child: names of its links. A range of a whole turn or more is none.
    Raises ModelError for unknown types, mimic joints and axes that are not of unit length.
    """
    where, kind = _place_of(element), element.get("type", "")
    if kind not in (*urdf.JOINT_TYPES, "continuous") or element.find("mimic") is not None:
        raise ModelError(
            f"{where}: type '{kind}', expected one of {['continuous', *urdf.JOINT_TYPES]}, without <mimic>; "
            "coupled joints are not supported"
        )
    axis_element = None if kind in ("fixed", "floating") else element.find("axis")
    axis = np.array(_numbers(axis_element, "xyz", "1 0 0", 3, f"{where} <axis>"))
    # files round their axes, so 1e-6 from unit length will do
    if abs(math.hypot(*axis) - 1.0) > 1e-6:
        raise ModelError(f"{where}: axis {axis} has length {math.hypot(*axis):g}, expected 1")
    if kind != "fixed":  # <axis> is in the child's frame
        axis = turns[child] @ axis
    limit = element.find("limit")
    speed, low, high = (
        _numbers(limit, key, "0", 1, f"{where} <limit>")[0]
        for key in ("velocity", "lower", "upper")
    )
    place = _origin(element, where, turns[parent])[0]  # [0]: of (place, rotation) the place
    # FREE or more, or 0: no limit
    speed = speed if 0.0 < speed < urdf.FREE else math.inf
    stated = limit is not None and {"lower", "upper"} <= limit.attrib.keys() and kind == "revolute"
    ends = (low, high) if stated and 0.0 < high - low < 2.0 * math.pi else urdf.FREELY
    kind = "revolute" if kind == "continuous" else kind
    return Joint(element.get("name", ""), kind, parent, child, place, vector(axis), speed, ends)
