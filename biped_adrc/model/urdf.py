"""Strict reading of URDF into a small tree, edits on it, and writing it back.

Pinocchio's parser accepts negative masses and zero axes and turns a mass it cannot read into 0.
So the file is read and validated here first, parameters are changed on this tree, and Pinocchio
is given the text this module writes.
"""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from biped_adrc.errors import ModelError
from biped_adrc.types import Array

Vector = tuple[float, float, float]

JOINT_TYPES = ("revolute", "prismatic", "fixed")
GEOMETRY_SIZES = {"box": ("size",), "sphere": ("radius",), "cylinder": ("radius", "length")}
MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
SYMMETRIC = np.array([[0, 1, 2], [1, 3, 4], [2, 4, 5]])
"""The matrix of inertia by the numbers of its MOMENTS."""
LARGEST = 1e100
"""Of the numbers in a URDF, in any unit; products of more overflow."""
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
_FREE = {"lower": "-1000", "upper": "1000", "effort": "1000", "velocity": "1000"}  # no limit
_ALMOST_ONE = 1e-6  # how far an axis may be from unit length, dimensionless


@dataclass(frozen=True)
class Inertial:
    """Mass [kg], COM in the link frame [m], inertia about the COM [kg m^2] (xx, xy, xz, yy, yz, zz)."""

    mass: float
    com: Vector
    inertia: tuple[float, float, float, float, float, float]

    def scaled(self, kind: str, factor: float) -> Inertial:
        """With "mass", "com" or "inertia" multiplied."""
        old: Any = getattr(self, kind)
        new: Any = factor * old if kind == "mass" else tuple(factor * x for x in old)
        return replace(self, **{kind: new})


@dataclass(frozen=True)
class Visual:
    """A primitive: `shape` is box, sphere or cylinder (axis z), `size` its numbers [m], `rgba` its colour."""

    shape: str
    size: tuple[float, ...]
    origin: Vector
    rgba: tuple[float, float, float, float]


@dataclass(frozen=True)
class Link:
    """A rigid body; `inertial` is None for frames without mass."""

    name: str
    inertial: Inertial | None
    visuals: tuple[Visual, ...]


@dataclass(frozen=True)
class Joint:
    """`child` moves about or along `axis`; all link frames are parallel at zero (no rpy)."""

    name: str
    type: str
    parent: str
    child: str
    origin: Vector
    axis: Vector


@dataclass(frozen=True)
class Tree:
    """A robot as read from URDF: links by name, joints in the order of the file."""

    name: str
    links: Mapping[str, Link]
    joints: tuple[Joint, ...]
    source: str

    def joint_above(self, link: str) -> Joint | None:
        """The joint whose child is `link`, None at the root."""
        return next((j for j in self.joints if j.child == link), None)

    def joints_below(self, link: str) -> tuple[Joint, ...]:
        """The joints whose parent is `link`."""
        return tuple(j for j in self.joints if j.parent == link)

    def path_to_root(self, link: str) -> tuple[Joint, ...]:
        """Joints from `link` up to the root."""
        path: list[Joint] = []
        joint = self.joint_above(link)
        while joint is not None:
            path.append(joint)
            joint = self.joint_above(joint.parent)
        return tuple(path)

    def path_below(self, link: str, top: str) -> tuple[Joint, ...] | None:
        """Joints from `link` up to link `top`, None where it does not hang there."""
        path = self.path_to_root(link)
        ends = [k for k, joint in enumerate(path) if joint.child == top]
        return path[: ends[0]] if ends else None

    def with_inertials(self, inertials: Mapping[str, Inertial]) -> Tree:
        """The same tree with the inertials of some links replaced."""
        links = {
            name: replace(link, inertial=inertials.get(name, link.inertial))
            for name, link in self.links.items()
        }
        return _validated(replace(self, links=links))


def load_tree(path: Path | str) -> Tree:
    """Read and validate a URDF file.

    Raises ModelError that names the file, the element, what was found and what was expected.
    """
    return tree_of(parse(path), str(path))


def parse(path: Path | str) -> ET.Element:
    """The element <robot> of a URDF file, as it stands. Raises ModelError."""
    path = Path(path)
    if not path.is_file():
        raise ModelError(f"URDF '{path}' not found; give the path of an existing .urdf file")
    try:
        root = ET.fromstring(path.read_bytes())
    except ET.ParseError as error:
        raise ModelError(f"URDF '{path}' is not well-formed XML: {error}") from error
    except OSError as error:
        raise ModelError(f"URDF '{path}' cannot be read: {error.strerror}") from error
    if root.tag != "robot":
        raise ModelError(f"URDF '{path}': root element is <{root.tag}>, expected <robot>")
    return root


def tree_of(root: ET.Element, source: str) -> Tree:
    """The tree that <robot> describes; `source` is the file that messages name. Raises ModelError."""
    links: dict[str, Link] = {}
    for element in root.findall("link"):
        link = _read_link(element, source)
        if link.name in links:
            raise ModelError(
                f"URDF '{source}': two links are named '{link.name}'; names must differ"
            )
        links[link.name] = link
    joints = tuple(_read_joint(element, source) for element in root.findall("joint"))
    name = _printable(root.get("name", Path(source).stem), "robot", f"URDF '{source}'")
    return _validated(Tree(name, links, joints, source))


def to_xml(tree: Tree) -> str:
    """URDF text of `tree`; `load_tree` of it gives the tree back."""
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
            ET.SubElement(element, "limit", _FREE)
    ET.indent(robot)
    return '<?xml version="1.0"?>\n' + ET.tostring(robot, encoding="unicode") + "\n"


def _text(*values: float) -> str:
    return " ".join(f"{value:.17g}" for value in values)


def _write_inertial(element: ET.Element, inertial: Inertial) -> None:
    ET.SubElement(element, "origin", xyz=_text(*inertial.com))
    ET.SubElement(element, "mass", value=_text(inertial.mass))
    ET.SubElement(element, "inertia", dict(zip(MOMENTS, map(_text, inertial.inertia), strict=True)))


def _write_visual(element: ET.Element, visual: Visual, link: str) -> None:
    ET.SubElement(element, "origin", xyz=_text(*visual.origin))
    keys = GEOMETRY_SIZES[visual.shape]
    sizes = [_text(*visual.size)] if len(keys) == 1 else map(_text, visual.size)
    shape = dict(zip(keys, sizes, strict=True))
    ET.SubElement(ET.SubElement(element, "geometry"), visual.shape, shape)
    material = ET.SubElement(element, "material", name=link)
    ET.SubElement(material, "color", rgba=_text(*visual.rgba))


def numbers(element: ET.Element | None, key: str, default: str, count: int, where: str) -> Vector:
    """`count` finite numbers of an attribute. Raises ModelError that quotes it after `where`."""
    text = default if element is None else element.get(key, default)
    words = text.split()
    values = tuple(float(word) for word in words) if all(map(_NUMBER.fullmatch, words)) else ()
    if len(values) != count or not all(abs(value) < LARGEST for value in values):
        raise ModelError(
            f"{where}: {key}={text!r}, expected {count} finite number(s) below {LARGEST:g}"
        )
    return values  # type: ignore[return-value]


def _origin(element: ET.Element, where: str) -> Vector:
    origin = element.find("origin")
    if any(numbers(origin, "rpy", "0 0 0", 3, f"{where} <origin>")):
        raise ModelError(
            f"{where}: <origin> has a rotation (rpy); expected parallel frames at zero angles. "
            "Turn the geometry and the inertia into the parent's axes instead"
        )
    return numbers(origin, "xyz", "0 0 0", 3, f"{where} <origin>")


def _required(element: ET.Element, tag: str, where: str) -> ET.Element:
    found = element.find(tag)
    if found is None:
        raise ModelError(f"{where}: <{tag}> is missing")
    return found


def _name(element: ET.Element, key: str, where: str) -> str:
    name = element.get(key)
    if not name:
        raise ModelError(f"{where}: <{element.tag}> has no '{key}'")
    return _printable(name, element.tag, where)


def _printable(name: str, tag: str, where: str) -> str:
    if not name.isprintable():
        raise ModelError(
            f"{where}: <{tag}> names {name!r}, expected a name on one line, without tabs"
        )
    return name


def _read_link(element: ET.Element, source: str) -> Link:
    name = _name(element, "name", f"URDF '{source}'")
    where = f"URDF '{source}', link '{name}'"
    inertial = element.find("inertial")
    visuals = tuple(_read_visual(v, where) for v in element.findall("visual"))
    return Link(name, None if inertial is None else _read_inertial(inertial, where), visuals)


def _read_inertial(element: ET.Element, where: str) -> Inertial:
    mass = numbers(_required(element, "mass", where), "value", "", 1, f"{where} <mass>")[0]
    values = moments_of(_required(element, "inertia", where), f"{where} <inertia>")
    return Inertial(mass, _origin(element, f"{where} <inertial>"), tuple(values.tolist()))


def moments_of(inertia: ET.Element, where: str, default: str = "") -> Array:
    """xx, xy, xz, yy, yz, zz (6,) of an <inertia>; default: of xx, yy and zz, which a file has to give."""
    defaults = (default if key[1] == key[2] else "0" for key in MOMENTS)
    read = zip(MOMENTS, defaults, strict=True)
    return np.array([numbers(inertia, key, text, 1, where)[0] for key, text in read])


def _read_visual(element: ET.Element, where: str) -> Visual:
    geometry = _required(element, "geometry", f"{where} <visual>")
    shape = next((g for g in geometry if g.tag in GEOMETRY_SIZES), None)
    if shape is None:
        found = ", ".join(f"<{g.tag}>" for g in geometry) or "nothing"
        raise ModelError(f"{where} <visual>: found {found}, expected one of {list(GEOMETRY_SIZES)}")
    count = 3 if shape.tag == "box" else 1
    read = (
        numbers(shape, k, "", count, f"{where} <{shape.tag}>") for k in GEOMETRY_SIZES[shape.tag]
    )
    size = tuple(chain.from_iterable(read))
    if min(size) <= 0:
        raise ModelError(f"{where} <{shape.tag}>: sizes {size}, expected positive numbers")
    colour = element.find("material/color")
    rgba = numbers(colour, "rgba", "0.5 0.5 0.5 1", 4, f"{where} <color>")
    if not all(0.0 <= part <= 1.0 for part in rgba):
        raise ModelError(f"{where} <color>: rgba {rgba}, expected numbers between 0 and 1")
    return Visual(shape.tag, size, _origin(element, f"{where} <visual>"), rgba)  # type: ignore[arg-type]


def _read_joint(element: ET.Element, source: str) -> Joint:
    name = _name(element, "name", f"URDF '{source}'")
    where = f"URDF '{source}', joint '{name}'"
    kind = _name(element, "type", where)
    if kind not in JOINT_TYPES:
        hint = "; give a 'continuous' joint as 'revolute' with wide limits"
        raise ModelError(f"{where}: type '{kind}', expected one of {list(JOINT_TYPES)}{hint}")
    axis = numbers(element.find("axis"), "xyz", "1 0 0", 3, f"{where} <axis>")
    if abs(math.hypot(*axis) - 1.0) > _ALMOST_ONE:
        raise ModelError(f"{where}: axis {axis} has length {math.hypot(*axis):g}, expected 1")
    return Joint(
        name,
        kind,
        _name(_required(element, "parent", where), "link", where),
        _name(_required(element, "child", where), "link", where),
        _origin(element, where),
        axis,
    )


def _validated(tree: Tree) -> Tree:
    """Check that the links form one tree and that every moving body is physical."""
    where = f"URDF '{tree.source}'"
    names = [joint.name for joint in tree.joints]
    for name in names:
        if names.count(name) > 1:
            raise ModelError(f"{where}: two joints are named '{name}'; names must differ")
    for joint in tree.joints:
        for link in (joint.parent, joint.child):
            if link not in tree.links:
                raise ModelError(f"{where}, joint '{joint.name}': there is no link '{link}'")
    children = [joint.child for joint in tree.joints]
    for link in tree.links:
        if children.count(link) > 1:
            raise ModelError(
                f"{where}: link '{link}' has two parent joints; closed chains are not supported"
            )
    roots = [link for link in tree.links if link not in children]
    if len(roots) != 1:
        raise ModelError(f"{where}: found root links {roots}, expected exactly one")
    loose = set(tree.links) - _below(tree, roots[0])
    if loose:
        raise ModelError(
            f"{where}: links {sorted(loose)} hang on each other in a circle, not on '{roots[0]}'; closed "
            "chains are not supported"
        )
    for body in tree.links.values():
        if body.inertial is not None:
            _check_inertial(body.inertial, f"{where}, link '{body.name}'")
    return tree


def _below(tree: Tree, root: str) -> set[str]:
    """`root` and every link that hangs on it; each has one parent, so no link is met twice."""
    found, edge = {root}, [root]
    while edge:
        edge = [joint.child for link in edge for joint in tree.joints_below(link)]
        found.update(edge)
    return found


def _check_inertial(inertial: Inertial, where: str) -> None:
    if not 0 < inertial.mass < math.inf:
        raise ModelError(
            f"{where}: mass {inertial.mass:g} kg, expected a positive number; a frame without mass has no "
            "<inertial>"
        )
    size = sum(abs(moment) for moment in inertial.inertia)
    if not 0 < size < math.inf:
        raise ModelError(
            f"{where}: the moments of inertia are {inertial.inertia}, expected finite ones"
        )
    J = np.array(inertial.inertia)[SYMMETRIC] / size
    if min(np.linalg.det(J[:k, :k]) for k in (1, 2, 3)) <= 0:
        raise ModelError(f"{where}: the inertia matrix is not positive definite")
    if np.any(2 * np.diag(J) > np.trace(J) * (1 + 1e-9)):
        xx, _, _, yy, _, zz = inertial.inertia
        raise ModelError(
            f"{where}: inertia ({xx:g}, {yy:g}, {zz:g}) kg m^2 breaks the triangle inequality; "
            "no body has a principal moment above the sum of the other two"
        )
