"""A robot as a small tree of links and joints: changes of it, checks of its bodies, and its text as URDF.

Pinocchio's parser accepts negative masses and zero axes and turns a mass it cannot read into 0. So a file is
read by `urdf_reader`, which checks it; a parameter set or a model error changes this tree, `pinned.reroot`
turns it round, so that it hangs from a foot, and Pinocchio gets the text that `to_xml` writes. All data classes
here are frozen: a change makes a new tree.

The legs exchange their roles at impact: the same configuration gets the coordinates of the next walking step.

    q+ = R q- + r,   v+ = R v-

q (n,) [rad] are the coordinates, v = q' [rad/s], - and + stand for just before and just after the impact. Links
of one leg have twins in the other; the trunk, which is the torso and carries the legs, and any other link are
their own twins. With a = A q the absolute angles of the links, and P the matrix that exchanges twins in a, R
solves A R = P A. So R is a permutation for hips that count from a torso, and a combination for a hip that
counts from the other leg. r is the angle between two legs that are spokes of one rigid wheel, and zero for
other robots; the file robot.toml of the robot states it.

This assumes two legs that are alike, body by body, which `Biped.check` tests; `unlike` names those that are
not, and `evened` takes the mean of legs that nearly are. Twins are paired along the way from foot to foot,
from both ends to its middle. The feet are a pair (link of the stance foot, link of the swing foot).
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Self

import numpy as np

from biped_adrc.core.errors import ModelError
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array

Triple = tuple[float, float, float]
"""(x, y, z) [m], or a direction."""


def vector(values: Array) -> Triple:
    """The three entries of an array (3,) as a tuple of floats."""
    x, y, z = values.tolist()
    return x, y, z


JOINT_TYPES = ("revolute", "prismatic", "fixed", "planar", "floating")
"""The last two leave a robot free in the plane; `robot_import` puts a planar base in their place."""
GEOMETRY_SIZES = {"box": ("size",), "sphere": ("radius",), "cylinder": ("radius", "length")}
"""Attributes of a shape's size by the shape's name."""
MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
"""Attributes of <inertia>, in the order of `Inertial.inertia`."""
SYMMETRIC = np.array([[0, 1, 2], [1, 3, 4], [2, 4, 5]])
"""Symmetric matrix (3, 3) of indices: the inertia matrix from the six MOMENTS."""
FREE = 1000.0
"""Number that stands for no limit in <limit>, where one is compulsory."""
FREELY = (-math.inf, math.inf)
"""Range [rad] of a joint that turns all the way round, or slides."""


class Note(NamedTuple):
    """A sentence on how the file of a robot was understood."""

    kind: str
    """"read", "assumed" or "left out"."""
    text: str


Notes = tuple[Note, ...]


@dataclass(frozen=True)
class Inertial:
    """Mass properties of a link, in the axes of its frame."""

    mass: float
    """Mass [kg]."""
    com: Triple
    """COM from the origin of the link's frame [m]."""
    inertia: tuple[float, float, float, float, float, float]
    """Moments about the COM: xx, xy, xz, yy, yz, zz [kg m^2]."""

    def scaled(self, kind: str, factor: float) -> Self:
        """A copy with the field `kind`, "mass", "com" or "inertia", multiplied by a factor [1]."""
        old = getattr(self, kind)
        new: Any = factor * old if kind == "mass" else tuple(factor * x for x in old)
        return replace(self, **{kind: new})


@dataclass(frozen=True)
class Visual:
    """A primitive shape: box, sphere or cylinder (its axis is z of the link)."""

    shape: str
    """Name of the shape, a key of GEOMETRY_SIZES."""
    size: tuple[float, ...]
    """Edges of a box, radius of a sphere, radius and length of a cylinder [m]."""
    origin: Triple
    """Centre in the frame of the link [m]."""
    rgba: tuple[float, float, float, float]
    """Red, green, blue, opacity, each from 0 to 1."""


@dataclass(frozen=True)
class Link:
    """A rigid body, or a frame without mass."""

    name: str
    inertial: Inertial | None
    """Mass properties; None for a frame without mass."""
    visuals: tuple[Visual, ...]
    """Shapes to draw; they have no part in contact."""


@dataclass(frozen=True)
class Joint:
    """A connection of two links: `child` moves about or along `axis` relative to `parent`.

    All link frames are parallel at zero angles, so that `origin` and `axis` need no rotation.
    """

    name: str
    type: str
    """One of JOINT_TYPES."""
    parent: str
    child: str
    origin: Triple
    """Origin of the child's frame in the parent's [m]."""
    axis: Triple
    """Unit vector, the same in both frames; without meaning for a fixed joint."""
    speed: float = math.inf
    """<limit velocity> [rad/s] or [m/s]; infinite where there is none, or one that is 0 or at least FREE."""
    range: tuple[float, float] = FREELY
    """<limit lower upper> [rad]; infinite for a joint that turns all the way round, or slides."""

    @property
    def mirrored(self) -> Self:
        """The same joint with its angle counted the other way: axis and range are negated."""
        (x, y, z), (low, high) = self.axis, self.range
        return replace(self, axis=(-x, -y, -z), range=(-high, -low))


@dataclass(frozen=True)
class Tree(Shown):
    """A robot as links and joints, as read from a URDF."""

    name: str
    """Name of the robot."""
    links: Mapping[str, Link]
    """Links by name, in the order of the file."""
    joints: tuple[Joint, ...]
    """Joints in the order of the file."""
    source: str
    """File named in messages."""

    def joint_above(self, link: str) -> Joint | None:
        """The joint whose child is `link`; None for the root."""
        return next((j for j in self.joints if j.child == link), None)

    def joints_below(self, link: str) -> tuple[Joint, ...]:
        """The joints whose parent is `link`."""
        return tuple(j for j in self.joints if j.parent == link)

    def path_to_root(self, link: str) -> tuple[Joint, ...]:
        """Joints from `link` up to the root, the nearest one first."""
        path: list[Joint] = []
        while (joint := self.joint_above(link)) is not None:
            path.append(joint)
            link = joint.parent
        return tuple(path)

    def path_below(self, link: str, top: str) -> tuple[Joint, ...] | None:
        """Joints from `link` up to link `top`, the nearest first; () for `top` itself, None where `link` does
        not hang below it. For a `top` that is the root, which no joint carries, it is always None.
        """
        path = self.path_to_root(link)
        ends = [k for k, joint in enumerate(path) if joint.child == top]
        return path[: ends[0]] if ends else None

    def links_from(self, top: str) -> list[str]:
        """Names of link `top` and all links below it, in the file's order; [] for the root of the tree."""
        return [link for link in self.links if self.path_below(link, top) is not None]

    def with_inertials(self, inertials: Mapping[str, Inertial]) -> Self:
        """A copy of the tree in which the links named in `inertials` have these mass properties. Raises
        ModelError for those of no body.
        """
        links = dict(self.links)
        for name, inertial in inertials.items():
            check_inertial(inertial, f"'{self.source}', link '{name}'")
            links[name] = replace(links[name], inertial=inertial)
        return replace(self, links=links)


def with_tip(tree: Tree, link: str, place: Triple, name: str = "") -> tuple[Tree, str]:
    """The tree with a new link without mass, a foot, fixed to `link` at a place [m] in its frame; and its name.

    That is `name`, or if empty the link's name and "_tip", with underscores where another link or joint has it.
    """
    tip = free_name(tree, name or f"{link}_tip")
    mount = free_name(tree, f"{tip}_mount")
    joint = Joint(mount, "fixed", link, tip, place, (1.0, 0.0, 0.0))  # its axis has no meaning
    links = {**tree.links, tip: Link(tip, None, ())}
    return replace(tree, links=links, joints=(*tree.joints, joint)), tip


def free_name(tree: Tree, name: str) -> str:
    """The name itself, or with underscores appended until no link or joint of the tree has it."""
    while name in tree.links or any(joint.name == name for joint in tree.joints):
        name += "_"
    return name


def to_xml(tree: Tree) -> str:
    """URDF text of `tree`; `urdf_reader.read` makes the same tree of it.

    Torque limits are not in a tree, so every <limit effort> is FREE. <limit> is compulsory in URDF: FREE stands
    for a limit that the tree does not state.
    """
    robot = ET.Element("robot", name=tree.name)
    for link in tree.links.values():
        body = ET.SubElement(robot, "link", name=link.name)
        if link.inertial is not None:
            _write_inertial(ET.SubElement(body, "inertial"), link.inertial)
        for visual in link.visuals:
            _write_visual(ET.SubElement(body, "visual"), visual, link.name)
    for joint in tree.joints:
        element = ET.SubElement(robot, "joint", name=joint.name, type=joint.type)
        ET.SubElement(element, "parent", link=joint.parent)
        ET.SubElement(element, "child", link=joint.child)
        ET.SubElement(element, "origin", xyz=_text(*joint.origin))
        if joint.type != "fixed":
            ET.SubElement(element, "axis", xyz=_text(*joint.axis))
            (low, high), speed = np.clip(joint.range, -FREE, FREE), min(joint.speed, FREE)
            limit = {"lower": low, "upper": high, "effort": FREE, "velocity": speed}
            ET.SubElement(element, "limit", {key: _text(x) for key, x in limit.items()})
    ET.indent(robot)
    return '<?xml version="1.0"?>\n' + ET.tostring(robot, encoding="unicode") + "\n"


def _text(*values: float) -> str:
    """Text of numbers with 17 digits, which is exact for doubles."""
    return " ".join(f"{value:.17g}" for value in values)


def _write_inertial(element: ET.Element, inertial: Inertial) -> None:
    """Add origin, mass and moments to the element <inertial>."""
    ET.SubElement(element, "origin", xyz=_text(*inertial.com))
    ET.SubElement(element, "mass", value=_text(inertial.mass))
    ET.SubElement(element, "inertia", dict(zip(MOMENTS, map(_text, inertial.inertia), strict=True)))


def _write_visual(element: ET.Element, visual: Visual, link: str) -> None:
    """Add origin, geometry and colour of a shape to the element <visual>; link: name of its link."""
    ET.SubElement(element, "origin", xyz=_text(*visual.origin))
    keys = GEOMETRY_SIZES[visual.shape]
    # a box has its three edges in one attribute; the others have one number for each attribute
    sizes = [_text(*visual.size)] if len(keys) == 1 else map(_text, visual.size)
    shape = dict(zip(keys, sizes, strict=True))
    ET.SubElement(ET.SubElement(element, "geometry"), visual.shape, shape)
    # URDF wants a name for a material; nobody reads it
    material = ET.SubElement(element, "material", name=link)
    ET.SubElement(material, "color", rgba=_text(*visual.rgba))


def check_inertial(inertial: Inertial, where: str) -> None:
    """Raise ModelError unless mass and moments are those of a rigid body.

    The mass must be positive, no principal moment negative or above the sum of the other two. A point mass or a
    rod has moments that are zero, which is right: D_s of the whole robot must be definite, not the inertia of
    each body. Moments are scaled, so that tiny bodies do not underflow. where: file and link, for the message.
    """
    J = np.array(inertial.inertia)[SYMMETRIC]  # (3, 3) from the six moments
    size = float(np.sum(np.abs(J)))
    fits = 0.0 < inertial.mass < math.inf and size < math.inf
    # `or 1.0`: a point mass has the size 0; -1 fails the test below
    principal = np.linalg.eigvalsh(J / (size or 1.0)) if fits else np.array([-1.0, 0.0, 0.0])
    # least principal moment, and least gap of the triangle inequality, relative to the sum of the moments
    least = min(float(principal[0]), float(np.sum(principal) - 2.0 * principal[2]))
    if not least >= -1e-9:
        raise ModelError(
            f"{where}: mass {inertial.mass:g} kg and moments of inertia {inertial.inertia} kg m^2 are those of "
            "no body; expected a positive mass and a positive semidefinite matrix that obeys the triangle "
            "inequality. A frame without mass has no <inertial>"
        )


_EXACT = 1e-9  # largest residual of A R = P A, and of the relative difference of equal legs, dimensionless


def way(tree: Tree, feet: tuple[str, str]) -> list[tuple[Joint, str]]:
    """Joints on the way from feet[0] to feet[1], each with the name of the link to which it leads."""
    one, other = (tree.path_to_root(foot) for foot in feet)
    # up to the link where the two paths to the root meet, then down
    up = [(joint, joint.parent) for joint in one if joint not in other]
    return up + [(joint, joint.child) for joint in reversed(other) if joint not in one]


def bodies_between(tree: Tree, feet: tuple[str, str]) -> list[list[str]]:
    """Names of the links on the way from feet[0] to feet[1]: one list for each rigid body, whose links fixed
    joints hold together.
    """
    bodies = [[feet[0]]]
    for joint, link in way(tree, feet):
        if joint.type == "fixed":
            bodies[-1].append(link)
        else:
            bodies.append([link])
    return bodies


def twins(tree: Tree, feet: tuple[str, str]) -> dict[str, str]:
    """Name of a link -> its twin in the other leg, for the links of both legs; a link that is not in the result
    is its own twin.

    Rigid bodies on the way from foot to foot are paired from both ends to the middle, and in a pair of bodies
    the links, each counted from its foot.
    """
    bodies, paired = bodies_between(tree, feet), dict[str, str]()
    # near: a body counted from feet[0], far: from feet[1]; of an odd number the middle one has no partner
    for near, far in zip(bodies[: len(bodies) // 2], reversed(bodies), strict=False):
        for one, other in zip(near, reversed(far), strict=False):
            paired |= {one: other, other: one}
    return paired


def absolute_angles(tree: Tree, joints: tuple[str, ...], links: list[str]) -> Array:
    """Matrix A (len(links), n) of the absolute angles a = A q of some links, q the angles of the n `joints`.

    An entry is +1 or -1 for a joint on the link's path to the root, +1 where it turns in the sense of the last
    of `joints`, which is the pitch; 0 for other joints.
    """
    axis = next(joint.axis for joint in tree.joints if joint.name == joints[-1])
    rows = np.zeros((len(links), len(joints)))
    for row, link in zip(rows, links, strict=True):
        for joint in tree.path_to_root(link):
            if joint.name in joints:
                # product of two unit vectors along y or -y: 1 or -1
                sign = sum(a * b for a, b in zip(joint.axis, axis, strict=True))
                row[joints.index(joint.name)] = sign
    return rows


def relabelling(tree: Tree, joints: tuple[str, ...], feet: tuple[str, str]) -> Array:
    """R (n, n) of q+ = R q- + r, dimensionless, from A R = P A by least squares; q are the angles of `joints`.

    Entries within 1e-9 of an integer are rounded. Raises ModelError when no linear map exchanges the legs: the
    residual is not zero or R R is not the identity.
    """
    pairs = twins(tree, feet)
    # first the links that have a twin, then those that one of `joints` carries
    turned = (joint.child for joint in tree.joints if joint.name in joints)
    links = list(dict.fromkeys((*pairs, *turned)))
    A = absolute_angles(tree, joints, links)
    # a link fixed to one that has a twin turns as that one does: a hip welded to a leg has no rule of its own
    paired = A[: len(pairs)].tolist()
    own = [k for k, row in enumerate(A.tolist()) if k < len(paired) or row not in paired]
    A, links = A[own], [links[k] for k in own]
    # row by row the angle of the twin
    PA = absolute_angles(tree, joints, [pairs.get(link, link) for link in links])
    R = np.asarray(np.linalg.lstsq(A, PA, rcond=None)[0], dtype=np.float64)
    R = np.where(np.abs(R) < _EXACT, 0.0, R)
    # + 0.0 turns -0.0 into 0.0
    R = np.where(np.abs(R - np.round(R)) < _EXACT, np.round(R), R) + 0.0
    if np.max(np.abs(A @ R - PA)) > _EXACT or np.max(np.abs(R @ R - np.eye(len(R)))) > _EXACT:
        raise ModelError(
            f"'{tree.source}': the legs below '{feet[0]}' and '{feet[1]}' are not built alike, so they "
            f"cannot change over at impact; links were paired as {pairs}"
        )
    return R


def pairs(tree: Tree, feet: tuple[str, str]) -> tuple[tuple[str, str], ...]:
    """Pairs (link of the stance leg, its twin in the swing leg), from the feet upwards."""
    return tuple(twins(tree, feet).items())[::2]  # `twins` has every pair in both directions


def unlike(tree: Tree, feet: tuple[str, str]) -> dict[tuple[str, str], float]:
    """Pairs of twins -> largest relative difference [1] of mass, moment about y, COM and place on the parent;
    only the pairs that differ by more than round-off.
    """
    # where these four begin among the six numbers of `_in_plane`; COM and place are vectors
    starts, gaps = (0, 1, 2, 4), dict[tuple[str, str], float]()
    for pair in pairs(tree, feet):
        a, b = (_in_plane(tree, link) for link in pair)
        # lengths of the four parts, of the difference and of either twin
        gap, *sizes = (np.sqrt(np.add.reduceat(x * x, starts)) for x in (a - b, a, b))
        # below 1e-6 kg, kg m^2 or m the legs differ by round-off
        gaps[pair] = float(np.max(gap / np.maximum(np.maximum(*sizes), 1e-6)))
    return {pair: gap for pair, gap in gaps.items() if gap > _EXACT}


def _in_plane(tree: Tree, link: str) -> Array:
    """Mass [kg], moment about y [kg m^2], COM (x, z) and place (x, z) on the parent [m] of a link, (6,).

    0 for what it does not have: mass properties, or a joint above it.
    """
    body = tree.links[link].inertial or Inertial(0.0, (0.0,) * 3, (0.0,) * 6)
    joint = tree.joint_above(link)
    # [::2]: x and z of (x, y, z); inertia[3] is the moment about y
    place = (0.0, 0.0) if joint is None else joint.origin[::2]
    return np.array([body.mass, body.inertia[3], *body.com[::2], *place])


def evened(tree: Tree, feet: tuple[str, str]) -> tuple[Tree, Notes]:
    """The tree in which both legs have the mean of their masses, moments, COMs and lengths, and a note on it.

    This is done only where they differ by at most 1 %, as in exports of CAD; else the result is the tree
    itself without a note.
    """
    gaps = unlike(tree, feet)
    if not gaps or max(gaps.values()) > 0.01:
        return tree, ()
    links, joints = dict(tree.links), {joint.child: joint for joint in tree.joints}
    for pair in gaps:
        # means over both links: mass, moment about y, COM (x, z) and place (x, z) on the parent
        m, yy, x, z, px, pz = np.mean([_in_plane(tree, link) for link in pair], axis=0).tolist()
        for name in pair:
            link, joint = links[name], joints[name]
            joints[name] = replace(joint, origin=(px, joint.origin[1], pz))
            if body := link.inertial:
                # all six moments are scaled alike, so that they remain those of a body
                body = body.scaled("inertia", yy / body.inertia[3] if yy else 1.0)
                body = replace(body, mass=m, com=(x, body.com[1], z))
                links[name] = replace(link, inertial=body)
    worst = max(gaps, key=lambda pair: gaps[pair])
    text = f"legs: the mean of both; they differ by {gaps[worst]:.2%} at most, in {list(worst)}"
    return replace(tree, links=links, joints=tuple(joints.values())), (Note("assumed", text),)


def text_of(values: Triple) -> str:
    """Text of a vector, for a message."""
    return f"({', '.join(f'{value:.6g}' for value in values)})"
