"""The elements of a URDF: the file as a tree of elements, and their attributes, read strictly.

`urdf_reader` makes a robot of them. Every ModelError names the file, the element, what was found and what was
expected.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from pathlib import Path

from biped_adrc.core.errors import ModelError
from biped_adrc.core.files import reading
from biped_adrc.model.robots.urdf import Vector

MOST_LINKS = 200
"""Largest number of links of a robot."""
LARGEST = 1e100
"""Bound on every number in a URDF, in any unit; products of larger ones overflow."""
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
_FORMATS = {"mujoco": "MJCF, <mujoco>", "sdf": "SDF, <sdf>"}


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
        root = ET.fromstring(data.lstrip())
        space = root.tag.rpartition("robot")[0]
        for element in root.iter():  # a default namespace is the file's, not a part of names
            element.tag = element.tag.removeprefix(space)
        count = len(root.findall("link"))
        if root.tag != "robot" or count > MOST_LINKS:
            what = _FORMATS.get(root.tag, f"<{root.tag}>")
            raise ValueError(
                f"{what} with {count} links, expected a URDF, <robot> with at most {MOST_LINKS} links"
            )
    return root


def place_of(element: ET.Element, file: str) -> str:
    """Text for messages that names a link or joint: file, kind of element and name."""
    return f"{file}, {element.tag} '{element.get('name')}'"


def name_of(element: ET.Element, where: str, key: str = "name") -> str:
    """The attribute `key` of an element, after a check that it is printable.

    Line breaks and tabs would spoil tables and messages. Raises ModelError.
    """
    name = element.get(key, "")
    if not name or not name.isprintable():
        raise ModelError(
            f"{where}: <{element.tag}> has {key}={name!r}, expected a name on one line"
        )
    return name


def required(element: ET.Element, tag: str, where: str) -> ET.Element:
    """The first child <tag>. Raises ModelError where it is missing."""
    child = element.find(tag)
    if child is None:
        raise ModelError(f"{where}: <{tag}> is missing")
    return child


def numbers(
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


def by_joint(
    joints: list[ET.Element], tag: str, key: str, file: str, least: float = 0.0
) -> dict[str, float]:
    """The number <tag key> of each joint that has it, by name of the joint."""
    values = {}
    for joint in joints:
        element = joint.find(tag)
        if element is not None and key in element.attrib:
            where = f"{place_of(joint, file)} <{tag}>"
            values[joint.get("name", "")] = numbers(element, key, "", 1, where, least)[0]
    return values
