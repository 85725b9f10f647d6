"""The XML of a URDF file: well-formed, of a sensible size, without xacro macros."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

from biped_adrc.core.errors import ModelError
from biped_adrc.core.files import reading

DEEPEST, MOST_LINKS = 50, 200
"""Of elements inside one another, and links of a robot."""


def parse(path: Path | str) -> ET.Element:
    """The element <robot> of a URDF file, as it stands. Raises ModelError."""
    path = Path(path)
    with reading("URDF", path, ModelError):
        data = path.read_bytes()
        if path.suffix == ".xacro" or b"<xacro:" in data:
            raise ValueError(
                "it holds xacro macros, expected the URDF they expand to; try "
                f"'xacro {path.name} > robot.urdf' and give robot.urdf"
            )
        try:
            root = ET.fromstring(data, ET.XMLParser(target=_Shallow()))
        except (ET.ParseError, LookupError) as error:  # the last one of an encoding
            raise ValueError(f"not well-formed XML: {error}") from error
        count = len(root.findall("link"))
        if root.tag != "robot" or count > MOST_LINKS:
            raise ValueError(
                f"<{root.tag}> with {count} links, expected <robot> with at most {MOST_LINKS}"
            )
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
