"""The XML of a URDF file: well-formed, of a sensible size, without xacro macros."""

from __future__ import annotations

import os
import xml.etree.ElementTree as ET
from pathlib import Path

from biped_adrc.errors import ModelError
from biped_adrc.files import check_regular

DEEPEST, MOST_LINKS = 50, 200
"""Of elements inside one another, and links of a robot."""


def parse(path: Path | str) -> ET.Element:
    """The element <robot> of a URDF file, as it stands. Raises ModelError."""
    path = Path(path)
    check_regular(path, f"URDF '{path}'", ModelError)
    if not os.path.isfile(path):
        raise ModelError(f"URDF '{path}' not found; give the path of an existing .urdf file")
    try:
        root = ET.fromstring(path.read_bytes(), ET.XMLParser(target=_Shallow()))
    except (ET.ParseError, ValueError, LookupError) as error:  # the last two of an encoding
        raise ModelError(f"URDF '{path}' is not well-formed XML: {error}") from error
    except OSError as error:
        raise ModelError(f"URDF '{path}' cannot be read: {error.strerror}") from error
    if root.tag != "robot":
        raise ModelError(f"URDF '{path}': root element is <{root.tag}>, expected <robot>")
    count = len(root.findall("link"))
    if count > MOST_LINKS:
        raise ModelError(f"URDF '{path}' has {count} links, expected at most {MOST_LINKS}")
    return root


class _Shallow(ET.TreeBuilder):
    """Builds elements down to a depth. Raises ValueError below, where functions that recurse would crash."""

    depth = 0

    def start(self, tag: str, attrs: dict[str, str], /) -> ET.Element:
        self.depth += 1
        if self.depth > DEEPEST:
            raise ValueError(f"elements are nested {self.depth} deep, expected at most {DEEPEST}")
        return super().start(tag, attrs)

    def end(self, tag: str, /) -> ET.Element:
        self.depth -= 1
        return super().end(tag)


def expanded(path: Path) -> ET.Element:
    """<robot> of a file without xacro macros. Raises ModelError that says how to expand them."""
    try:
        robot = parse(path)
        macros = path.suffix == ".xacro" or any("xacro}" in element.tag for element in robot.iter())
    except ModelError:
        if not os.path.isfile(path) or b"<xacro:" not in path.read_bytes():
            raise
        macros = True
    if macros:
        raise ModelError(
            f"'{path}' holds xacro macros, expected the URDF they expand to; try "
            f"'xacro {path.name} > robot.urdf' and give robot.urdf"
        )
    return robot
