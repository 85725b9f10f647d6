"""The robot as a model of MuJoCo (MJCF, its XML format), from the links and joints of the robot's URDF, with
rotor inertias, joint friction and motors.

    qpos = (x, z of the base, q)      in the order of the model's joints

The robot of `floating_mjcf` stands on a `SoftGround` with spheres for feet; that of `pinned_mjcf` turns about
its stance foot and has no contact; `model_of` makes a model of either. MuJoCo's bodies that move must have a
mass, so the joints of the base belong to the trunk. The integrator is RK4. MuJoCo's Euler methods with the step
h turn a joint of the acceleration a in a sampling period T by (1 + h/T) a T^2 / 2 in place of a T^2 / 2; a fast
observer takes that for a disturbance, and with the observer of Table I of the paper the robot does not walk.
Static friction is MuJoCo's `frictionloss`, a bound on a constraint's force, where the rigid plant has tanh.
"""

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
"""Attributes of a shape that touches nothing, except the shape that an element <pair> names with it."""


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
    """MJCF of the robot pinned at its stance foot, without contact; h [s]: MuJoCo's integration step."""
    tree = biped.pinned_tree  # hangs from the link "ground" by the joints of its stance foot
    # {}: no options beside those of every robot
    root, world = _world(biped, h, {}, {"contact": "disable"})
    _add(world, tree, tree.joints_below("ground"), biped)
    return root


def floating_mjcf(
    biped: Biped, ground: SoftGround, slope: float, h: float, planes: tuple[str, ...] = PLANES[:1]
) -> ET.Element:
    """MJCF of the robot on soft ground of a slope [rad], positive downhill; h [s]: MuJoCo's integration step.

    planes: names of the ground's planes, one for both feet or one for each. A plane lies a foot's radius below
    the ground itself, so that the sphere of a foot touches when its centre, the foot point, is on the ground.
    """
    d = biped.description
    # root: the element <mujoco>, world: its <worldbody>; {}: MuJoCo's usual flags
    root, world = _world(biped, h, {"cone": "elliptic", "impratio": text(ground.impratio)}, {})
    joints = {joint.name: joint for joint in biped.tree.joints}
    # place (x, 0, z) of the planes, along the normal ground_axes(..)[1] = (x, z) of the ground, and rotation by
    # the slope about y as a quaternion (w, x, y, z)
    below = -ground.foot_radius * np.insert(ground_axes(slope)[1], 1, 0.0)
    tilt = np.cos(slope / 2), 0.0, np.sin(slope / 2), 0.0
    for name in planes:
        plane = {"name": name, "type": "plane", "pos": text(below), "quat": text(tilt)}
        # size 0 0: without end; NO_CONTACT: it touches only the foot of its <pair> below
        ET.SubElement(world, "geom", plane | {"size": "0 0 1"} | NO_CONTACT)
    # the trunk, which moves by the joints of the base and the pitch, and below it all that it carries
    _add(world, biped.tree, [joints[name] for name in (*d.base, d.unactuated)], biped)
    bodies = {body.get("name"): body for body in world.iter("body")}
    radius, pairs = text(ground.foot_radius), ET.SubElement(root, "contact")
    # solimp: impedance at the surface and deep inside, then width [m], midpoint and power of its rise;
    # friction: two tangential directions, none of torsion and rolling
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
    """Text of numbers with all their digits, separated by blanks."""
    return " ".join(repr(float(x)) for x in np.atleast_1d(np.asarray(numbers, dtype=float)))


def _world(
    biped: Biped, h: float, options: dict[str, str], flags: dict[str, str]
) -> tuple[ET.Element, ET.Element]:
    """The element <mujoco> with motors and gravity, and its empty child <worldbody>.

    h [s]: integration step. options, flags: further attributes of <option> and of its child <flag>. Warm starts
    are off, so that a state alone decides what follows. One robot is one island of constraints, and MuJoCo's
    search for islands, which costs 7 % of the time, is off too.
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
    """Add to `parent` a body that moves by all of `joints`, with the link that the last of them carries, and
    below it the links that this one carries.

    joints: one, but for the trunk all joints of the base in their order. biped: with rotors and friction.
    """
    d, link = biped.description, joints[-1].child
    place = np.sum([j.origin for j in joints], axis=0)
    body = ET.SubElement(parent, "body", name=link, pos=text(place))
    if (inertial := tree.links[link].inertial) is not None:  # None: a frame without mass
        xx, xy, xz, yy, yz, zz = inertial.inertia
        full = {"mass": text(inertial.mass), "fullinertia": text((xx, yy, zz, xy, xz, yz))}
        ET.SubElement(body, "inertial", {"pos": text(inertial.com)} | full)
    # [N m s/rad] and [N m] by coordinate; zero for a robot without friction (biped.friction False)
    viscous, static = np.array(biped.friction_coefficients) * biped.friction
    for joint in (x for x in joints if x.type != "fixed"):
        # _KINDS: type of a joint -> MuJoCo's type
        own = {"name": joint.name, "type": _KINDS[joint.type], "axis": text(joint.axis)}
        if joint.name in d.actuated:
            # inertia of the motors' rotors, seen at the joints [kg m^2]
            rotors = np.broadcast_to(biped.armature, biped.p)
            own["armature"] = text(float(rotors[d.actuated.index(joint.name)]))
        if joint.name in d.joints:
            k = d.joints.index(joint.name)
            own |= {"damping": text(viscous[k]), "frictionloss": text(static[k])}
        ET.SubElement(body, "joint", own)
    for joint in tree.joints_below(link):
        _add(body, tree, [joint], biped)
