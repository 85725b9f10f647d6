"""The robot as a model of MuJoCo (MJCF), from the same tree, with rotors, joint friction and motors.

    qpos = (x, z of the base, q)      in the order of the model's joints

The robot of `floating_mjcf` stands on a `SoftGround` with spheres for feet; that of `pinned_mjcf` turns about
its stance foot and has no contact; `model_of` makes a model of either. MuJoCo's bodies that move must have a
mass, so the joints of the base belong to the trunk. The integrator is RK4: MuJoCo's Euler methods move the
angles over a sampling period T by (1 + h/T) a T^2 / 2, with the step h, which a fast observer takes for a
disturbance; the observer of Table I does not walk on them. Static friction is MuJoCo's `frictionloss`, a bound
on a constraint's force, where the rigid plant has tanh.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Sequence
from functools import cache
from types import ModuleType

import numpy as np

from biped_adrc.core.errors import optional
from biped_adrc.core.files import one_line
from biped_adrc.core.types import MuJoCoModel
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import SoftGround, ground_axes
from biped_adrc.model.robots.urdf import Joint, Tree

_KINDS = {"revolute": "hinge", "prismatic": "slide"}
"""Type of a joint in the tree -> MuJoCo's type."""
PLANES = ("ground", "ground ahead")
"""Names of the planes: one for both feet; on steps, one under the stance foot and one under the other."""
NO_CONTACT = {"contype": "0", "conaffinity": "0"}
"""Attributes of a shape that touches nothing except by a <pair>."""


@cache
def mujoco() -> ModuleType:
    """Import MuJoCo and return the module. Raises InputError where it is not installed."""
    with optional("mujoco", "MuJoCo is not installed"):
        import mujoco as module
    # warnings are counted in MuJoCo's data and read there; by default it would write them into a file
    module.set_mju_user_warning(lambda _: None)
    return module


def model_of(root: ET.Element) -> MuJoCoModel:
    """Compile an MJCF element <mujoco> to a model of MuJoCo."""
    return mujoco().MjModel.from_xml_string(ET.tostring(root, encoding="unicode"))


def pinned_mjcf(biped: Biped, h: float) -> ET.Element:
    """The robot pinned at its stance foot, without contact; h [s]: step of the engine."""
    tree = biped.pinned_tree
    root, world = _world(biped, h, {}, {"contact": "disable"})
    _add(world, tree, tree.joints_below("ground"), biped)
    return root


def floating_mjcf(
    biped: Biped, ground: SoftGround, slope: float, h: float, planes: tuple[str, ...] = PLANES[:1]
) -> ET.Element:
    """The robot on soft ground of a slope [rad]; h [s]: step of the engine. planes: one, or one a foot.

    A plane lies a foot's radius below the plane of the foot points, so that a foot touches where a point
    would.
    """
    d = biped.description
    contact = {"cone": "elliptic", "impratio": text(ground.impratio)}
    root, world = _world(biped, h, contact, {})
    joints = {joint.name: joint for joint in biped.tree.joints}
    below = -ground.foot_radius * np.insert(ground_axes(slope)[1], 1, 0.0)
    tilt = np.cos(slope / 2), 0.0, np.sin(slope / 2), 0.0
    for name in planes:
        plane = {"name": name, "type": "plane", "pos": text(below), "quat": text(tilt)}
        ET.SubElement(world, "geom", plane | {"size": "0 0 1"} | NO_CONTACT)
    _add(world, biped.tree, [joints[name] for name in (*d.base, d.unactuated)], biped)
    bodies = {body.get("name"): body for body in world.iter("body")}
    radius, pairs = text(ground.foot_radius), ET.SubElement(root, "contact")
    law = {
        "condim": "3",
        "friction": text((ground.friction, ground.friction, 0.0, 0.0, 0.0)),
        "solref": text((ground.time_constant, ground.damping_ratio)),
        "solimp": text((*ground.impedance, 1e-3, 0.5, 2.0)),
    }
    for foot, under in zip(d.feet, (planes[0], planes[-1]), strict=True):
        sphere = {"name": foot, "type": "sphere", "size": radius, "mass": "0"}
        ET.SubElement(bodies[foot], "geom", sphere | NO_CONTACT)
        ET.SubElement(pairs, "pair", {"geom1": under, "geom2": foot} | law)
    return root


def text(numbers: float | Iterable[float]) -> str:
    """Numbers with all their digits, separated by blanks."""
    return " ".join(repr(float(x)) for x in np.atleast_1d(np.asarray(numbers, dtype=float)))


def _world(
    biped: Biped, h: float, options: dict[str, str], flags: dict[str, str]
) -> tuple[ET.Element, ET.Element]:
    """<mujoco> with motors and gravity, and its empty <worldbody>.

    Warm starts are off, so that a state alone decides what follows. One robot is one island of constraints, and
    MuJoCo's search for islands, which costs 7 % of the time, is off too.
    """
    root = ET.Element("mujoco", model=one_line(biped.description.name))
    ET.SubElement(root, "compiler", angle="radian")
    gravity = text((0.0, 0.0, -biped.description.gravity))
    method = {"integrator": "RK4", "jacobian": "dense"}
    option = {"timestep": text(h), "gravity": gravity} | method | options
    alone = {"warmstart": "disable", "island": "disable"}
    ET.SubElement(ET.SubElement(root, "option", option), "flag", alone | flags)
    world, motors = ET.SubElement(root, "worldbody"), ET.SubElement(root, "actuator")
    for joint in biped.description.actuated:
        ET.SubElement(motors, "general", name=joint, joint=joint)
    return root, world


def _add(parent: ET.Element, tree: Tree, joints: Sequence[Joint], biped: Biped) -> None:
    """Add a body that moves by `joints`, the last of which carries its link, and below it
    all links that it carries.
    """
    d, link = biped.description, joints[-1].child
    place = np.sum([j.origin for j in joints], axis=0)
    body = ET.SubElement(parent, "body", name=link, pos=text(place))
    if (inertial := tree.links[link].inertial) is not None:  # None: a frame without mass
        xx, xy, xz, yy, yz, zz = inertial.inertia
        full = {"mass": text(inertial.mass), "fullinertia": text((xx, yy, zz, xy, xz, yz))}
        ET.SubElement(body, "inertial", {"pos": text(inertial.com)} | full)
    viscous, static = np.array(biped.friction_coefficients) * biped.friction
    for joint in joints:
        if joint.type == "fixed":
            continue
        own = {"name": joint.name, "type": _KINDS[joint.type], "axis": text(joint.axis)}
        if joint.name in d.actuated:
            rotors = np.broadcast_to(biped.armature, biped.p)
            own["armature"] = text(float(rotors[d.actuated.index(joint.name)]))
        if joint.name in d.joints:
            k = d.joints.index(joint.name)
            own |= {"damping": text(viscous[k]), "frictionloss": text(static[k])}
        ET.SubElement(body, "joint", own)
    for joint in tree.joints_below(link):
        _add(body, tree, [joint], biped)
