"""Reading any URDF of a planar robot: the tree with parallel frames, and what its joints can do.

Frames are turned by `biped_adrc.model.straighten`; the limits <limit effort lower upper> and the friction
<dynamics damping friction> are kept beside the tree.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from biped_adrc.errors import ModelError
from biped_adrc.model.straighten import place_of, straightened
from biped_adrc.model.urdf import Tree, Vector, numbers, parse, tree_of


@dataclass(frozen=True)
class Reading:
    """A robot with parallel frames, and what its file says beside the tree, by joint."""

    tree: Tree
    effort: Mapping[str, float]
    """[N m], where <limit effort> is given."""
    ranges: Mapping[str, tuple[float, float]]
    """[rad], of revolute joints that cannot turn all the way round."""
    viscous: Mapping[str, float]
    """[N m s], where <dynamics damping> is given."""
    static: Mapping[str, float]
    """[N m], where <dynamics friction> is given."""
    undrawn: tuple[str, ...]
    """Links with a shape that was not kept."""
    flat: tuple[str, ...]
    """Links that had no moments about x and z."""


def read(path: Path | str, tips: Mapping[str, Vector] | None = None) -> Reading:
    """Read and validate a URDF with frames of any orientation.

    tips: by link, a place in its own frame [m] where a link without mass, `LINK_tip`, is put.
    Raises ModelError.
    """
    path = Path(path)
    source = str(path)
    raw = _expanded(path)
    for link, place in (tips or {}).items():
        _add_tip(raw, link, place)
    robot, undrawn, flat = straightened(raw, source)
    moving = [j for j in robot.findall("joint") if j.get("type") == "revolute"]
    return Reading(
        tree_of(robot, source),
        _by_joint(moving, "limit", "effort", source),
        _ranges(moving, source),
        _by_joint(moving, "dynamics", "damping", source),
        _by_joint(moving, "dynamics", "friction", source),
        undrawn,
        flat,
    )


def tip_of(link: str) -> str:
    """Name of the link that `read` puts at the tip of `link`."""
    return f"{link}_tip"


def _add_tip(robot: ET.Element, link: str, place: Vector) -> None:
    ET.SubElement(robot, "link", name=tip_of(link))
    joint = ET.SubElement(robot, "joint", name=f"{tip_of(link)}_mount", type="fixed")
    ET.SubElement(joint, "parent", link=link)
    ET.SubElement(joint, "child", link=tip_of(link))
    ET.SubElement(joint, "origin", xyz=" ".join(repr(float(x)) for x in place))


def _expanded(path: Path) -> ET.Element:
    """<robot> of a file without macros. Raises ModelError."""
    try:
        robot = parse(path)
        macros = path.suffix == ".xacro" or any("xacro}" in element.tag for element in robot.iter())
    except ModelError:
        if not path.is_file() or b"<xacro:" not in path.read_bytes():
            raise
        macros = True
    if macros:
        raise ModelError(
            f"'{path}' holds xacro macros, expected the URDF they expand to; try "
            f"'xacro {path.name} > robot.urdf' and give robot.urdf"
        )
    return robot


def _by_joint(
    joints: list[ET.Element], tag: str, key: str, source: str, least: float = 0.0
) -> dict[str, float]:
    """A number of <tag key> by joint, where it is given. Raises ModelError when it is below `least`."""
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


def _ranges(joints: list[ET.Element], source: str) -> dict[str, tuple[float, float]]:
    low, high = (_by_joint(joints, "limit", key, source, -math.inf) for key in ("lower", "upper"))
    return {
        name: (low[name], high[name])
        for name in low
        if name in high and 0.0 < high[name] - low[name] < 2.0 * math.pi
    }
