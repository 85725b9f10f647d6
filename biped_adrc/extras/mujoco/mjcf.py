"""The robot on soft ground as a file for MuJoCo's own viewer (MJCF).

    python -m mujoco.viewer --mjcf=FILE

Its dynamics are the same XML from which `MuJoCoPlant` makes its model. Motors with lag are MuJoCo's `filter`,
which computes their torque with the accuracy of its integrator. The visual shapes of the URDF are added,
without mass and without contact, and the start of a gait as the keyframe `start`.
"""

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import InputError
from biped_adrc.core.files import output_path, write_text, xml_comment
from biped_adrc.core.versions import packages
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.extras.mujoco.robot import NO_CONTACT, floating_mjcf, text
from biped_adrc.gait.gait import Gait
from biped_adrc.model.robots.urdf import Visual

SHARES = {"box": (0.5, 0.5, 0.5), "cylinder": (1.0, 0.5), "sphere": (1.0,)}
"""Factors [1] from the URDF's sizes of a shape to MuJoCo's, which has radii and half lengths."""


def write_mjcf(plant: MuJoCoPlant, path: Path | str, gait: Gait | None = None) -> Path:
    """Write a plant as MJCF (.xml); returns the path, to which .xml is added where it has no suffix.

    gait: its start, the state just after an impact, becomes the keyframe `start`; without a gait the viewer
    shows the robot with all angles zero. Raises InputError for another suffix and for ground with steps up and
    down, OutputError where the file cannot be written.
    """
    path = output_path(path, (".xml",), default=True)
    write_text(path, mjcf(plant, gait))
    return path


def mjcf(plant: MuJoCoPlant, gait: Gait | None = None) -> str:
    """Text of a plant as MJCF, with the start of `gait` as its keyframe; None for no keyframe.

    Raises InputError for ground with steps up and down.
    """
    check_part(plant, "plant", MuJoCoPlant)
    if plant.ground_steps:
        raise InputError(
            f"the plant has {len(plant.ground_steps)} steps of the ground, and such a file has level ground; "
            "expected a plant without them"
        )
    root = floating_mjcf(plant.biped, plant.ground, plant.slope, plant.h)
    for body in root.iter("body"):
        for visual in plant.biped.tree.links[body.get("name", "")].visuals:
            body.append(_shape(visual))
    if plant.lag > 0.0:
        for motor in root.iter("general"):
            motor.attrib |= {"dyntype": "filter", "dynprm": text(plant.lag)}
    if gait is not None:
        key = {"name": "start", **_start(plant, gait)}
        ET.SubElement(ET.SubElement(root, "keyframe"), "key", key)
    ET.indent(root)
    return f"<!--\n{_comment(plant)}\n-->\n{ET.tostring(root, encoding='unicode')}\n"


def _shape(visual: Visual) -> ET.Element:
    """A visual shape of the URDF as an MJCF element <geom>, without mass and contact."""
    # SHARES: factors from sizes of URDF to those of MJCF, which are half lengths and radii
    size = np.multiply(visual.size, SHARES[visual.shape])
    place = {"pos": text(visual.origin), "size": text(size), "rgba": text(visual.rgba)}
    # group 1: MuJoCo's viewer can hide it apart from the shapes of the feet, which are of group 0
    alone = {"type": visual.shape, "mass": "0", "group": "1"}
    return ET.Element("geom", alone | place | NO_CONTACT)


def _start(plant: MuJoCoPlant, gait: Gait) -> dict[str, str]:
    """MuJoCo's qpos and qvel at the start of a gait, as text for the attributes of a keyframe."""
    engine = plant.engine
    engine.place(plant.start(0.0, *gait.start(plant.biped)))
    return {"qpos": text(engine.qpos), "qvel": text(engine.qvel)}


def _comment(plant: MuJoCoPlant) -> str:
    """Lines for the comment of the file: robot, parameters, ground, versions and licence."""
    biped = plant.biped
    preset = biped.description.preset(biped.preset)
    result = packages(("biped-adrc", "mujoco-core", "mujoco"))
    versions = ", ".join(f"{name} {x}" for name, x in result.items() if x != "none")
    ground = ", ".join(f"{name} {x}" for name, x in vars(plant.ground).items())
    surface, deep = plant.stiffness
    lines = (
        f"robot {biped.description.name}, preset {biped.preset}: {preset.source}",
        f"joint friction: {'of the record' if biped.friction else 'none'}",
        f"ground: {ground}, slope {plant.slope:g} rad",
        f"under a foot at rest: {surface:.3g} N/m at the surface, {deep:.3g} N/m from 1 mm on",
        f"written by {versions}; BSD-3-Clause, without any warranty",
    )
    return "\n".join(map(xml_comment, lines))
