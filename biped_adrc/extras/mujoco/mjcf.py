"""The robot on soft ground as a file for MuJoCo's own viewer (MJCF).

    python -m mujoco.viewer --mjcf=FILE

What moves is what `MuJoCoPlant` computes with, to the last digits: `MjSpec.to_xml` writes six of them, so
all numbers are written again from the compiled model. Motors with lag are MuJoCo's `filter`, which gives
their torque to the accuracy of its integrator. Shapes of the URDF are added, without mass and
without contact, and the start of a gait as the keyframe `start`.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.extras.mujoco.robot import floating_spec
from biped_adrc.files import one_line, output_path, write_text, xml_comment
from biped_adrc.gait.gait import Gait
from biped_adrc.model.robots.urdf import Visual
from biped_adrc.parts import check_part
from biped_adrc.types import MuJoCoModel
from biped_adrc.versions import packages

NUMBERS = {
    "body": {"pos": "body_pos", "quat": "body_quat"},
    "joint": {"axis": "jnt_axis", "pos": "jnt_pos"},
    "geom": {"size": "geom_size", "pos": "geom_pos", "quat": "geom_quat"},
}
"""Arrays of the compiled model by attribute, of what has a name."""
INERTIAL = {
    "pos": "body_ipos", "quat": "body_iquat", "mass": "body_mass", "diaginertia": "body_inertia",
}  # fmt: skip
OF_JOINTS = {
    "armature": "dof_armature",
    "damping": "dof_damping",
    "frictionloss": "dof_frictionloss",
}
PAIR = {"friction": "pair_friction", "solref": "pair_solref", "solimp": "pair_solimp"}


def write_mjcf(plant: MuJoCoPlant, path: Path | str, gait: Gait | None = None) -> Path:
    """Write a plant as MJCF (.xml); returns the path.

    gait: whose start is the keyframe `start`; without one the robot is shown with all angles zero. Raises
    InputError for another kind of file, OutputError where it cannot be written.
    """
    path = output_path(path, (".xml",), default=True)
    write_text(path, mjcf(plant, gait))
    return path


def mjcf(plant: MuJoCoPlant, gait: Gait | None = None) -> str:
    """A plant as MJCF; see `write_mjcf`."""
    check_part(plant, "plant", MuJoCoPlant)
    if plant.ground_steps:
        raise InputError(
            f"the plant has {len(plant.ground_steps)} steps of the ground, and such a file has level ground; "
            "expected a plant without them"
        )
    spec = floating_spec(plant.biped, plant.ground, plant.slope, plant.h)
    spec.modelname = one_line(plant.biped.description.name)
    root = ET.fromstring(spec.to_xml())
    _with_all_digits(root, plant.model)
    for body in root.iter("body"):
        for visual in plant.biped.tree.links[body.get("name", "")].visuals:
            body.append(_shape(visual))
    if plant.lag > 0.0:
        for motor in root.find("actuator"):  # type: ignore[union-attr]
            motor.attrib |= {"dyntype": "filter", "dynprm": _text(plant.lag)}
    if gait is not None:
        key = {"name": "start", **_start(plant, gait)}
        ET.SubElement(ET.SubElement(root, "keyframe"), "key", key)
    ET.indent(root)
    comment = f"<!--\n{_comment(plant)}\n-->\n"
    return comment + ET.tostring(root, encoding="unicode") + "\n"


def _with_all_digits(root: ET.Element, model: MuJoCoModel) -> None:
    """Write the numbers of the compiled model in place of those with six digits."""
    option = root.find("option")
    assert option is not None
    option.set("timestep", _text(model.opt.timestep))
    option.set("gravity", _text(model.opt.gravity))
    option.set("impratio", _text(model.opt.impratio))
    for tag, attributes in NUMBERS.items():
        for element in root.find("worldbody").iter(tag):  # type: ignore[union-attr]
            _set(element, model, attributes, getattr(model, tag)(element.get("name")).id)
    for body in root.iter("body"):
        if (inertial := body.find("inertial")) is not None:
            inertial.attrib.pop("fullinertia", None)
            _set(inertial, model, INERTIAL, model.body(body.get("name")).id)
        for joint in body.findall("joint"):
            _set(joint, model, OF_JOINTS, model.joint(joint.get("name")).dofadr[0])
    for k, pair in enumerate(root.iter("pair")):
        _set(pair, model, PAIR, k)


def _set(element: ET.Element, model: MuJoCoModel, attributes: dict[str, str], k: int) -> None:
    """Entry k of the model's arrays as the attributes of an element."""
    for name, array in attributes.items():
        element.set(name, _text(getattr(model, array)[k]))


def _shape(visual: Visual) -> ET.Element:
    """A shape of the URDF, without mass and contact; MuJoCo counts from the middle to the sides."""
    size = {
        "box": 0.5 * np.array(visual.size),
        "cylinder": np.array(visual.size) * [1.0, 0.5][: len(visual.size)],
        "sphere": np.array(visual.size),
    }[visual.shape]
    none = {"mass": "0", "contype": "0", "conaffinity": "0", "group": "1"}
    place = {"pos": _text(visual.origin), "size": _text(size), "rgba": _text(visual.rgba)}
    return ET.Element("geom", {"type": visual.shape, **place, **none})


def _start(plant: MuJoCoPlant, gait: Gait) -> dict[str, str]:
    """Positions and velocities of the model at the start of a gait."""
    _, q, v, own = plant.start(0.0, *gait.start(plant.biped))
    engine = plant.engine
    engine.place(np.concatenate((q, v, own)))
    return {"qpos": _text(engine.qpos), "qvel": _text(engine.qvel)}


def _comment(plant: MuJoCoPlant) -> str:
    """Robot, parameters, ground, versions and licence, one a line."""
    biped = plant.biped
    preset = biped.description.preset(biped.preset)
    found = packages(("biped-adrc", "mujoco-core", "mujoco"))
    made = ", ".join(f"{name} {version}" for name, version in found.items() if version != "none")
    ground = ", ".join(f"{name} {x}" for name, x in vars(plant.ground).items())
    surface, deep = plant.stiffness
    lines = (
        f"robot {biped.description.name}, preset {biped.preset}: {preset.source}",
        f"joint friction: {'of the record' if biped.friction else 'none'}",
        f"ground: {ground}, slope {plant.slope:g} rad",
        f"under a foot at rest: {surface:.3g} N/m at the surface, {deep:.3g} N/m from 1 mm on",
        f"written by {made}; BSD-3-Clause, without any warranty",
    )
    return "\n".join(map(xml_comment, lines))


def _text(numbers: float | Iterable[float]) -> str:
    """Numbers with all their digits, between blanks."""
    return " ".join(repr(float(x)) for x in np.atleast_1d(np.asarray(numbers, dtype=float)))
