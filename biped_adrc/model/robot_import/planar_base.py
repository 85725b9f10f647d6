"""A tree that moves in the plane x-z on a base (x, z, pitch): found in a URDF, or put above its root.

The base is two prismatic joints along x and z and one revolute joint about y, in this order from
the root, with no mass in between. The stance contact determines its position, so only the pitch
remains as a coordinate, q_N. A URDF without a base floats on its root link; the base put there
turns in the sense of its other joints. Called by `import_robot.derive`, before feet and hip are
looked for.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from biped_adrc.errors import ModelError
from biped_adrc.model.pinned import PIN_JOINT
from biped_adrc.model.robots.urdf import Joint, Link, Tree, Vector

PLANAR = 1e-4  # how far a rounded rpy may turn an axis out of the plane, dimensionless
"""How far an axis, or a place [m], may be out of the plane because rpy was rounded in the file."""
_Y = 1


@dataclass(frozen=True)
class PlanarBase:
    """A tree with its planar base."""

    tree: Tree
    base: tuple[str, str]
    """Names of the prismatic joints along x and z."""
    pitch: str
    """Name of the revolute joint about y that carries the trunk."""
    trunk: str
    """Link that the base carries."""
    said: tuple[str, ...]
    """What was found or added, in sentences."""


def on_planar_base(tree: Tree) -> PlanarBase:
    """The planar tree with the base it has, or with one that is put above its root.

    Raises ModelError for joints or bodies out of the plane, a base of another kind or with mass,
    and bodies that move without mass.
    """
    tree = _in_plane(tree)
    root = next(link for link in tree.links if tree.joint_above(link) is None)
    slides, link = _slides(tree, root)
    found = _found(tree, root, slides, link) if slides else _added(tree, root)
    _check_below(found)
    return found


# -- the plane -------------------------------------------------------------------------------------
def _in_plane(tree: Tree) -> Tree:
    """The same tree with axes exactly in the plane x-z or perpendicular to it. Raises ModelError."""
    for name, link in tree.links.items():
        if link.inertial is not None and abs(link.inertial.com[_Y]) > PLANAR:
            raise ModelError(
                f"URDF '{tree.source}', link '{name}': its COM lies {link.inertial.com[_Y]:g} m beside its "
                "frame (y), expected 0; motion in the plane x-z does not depend on it, write y = 0"
            )
    return replace(tree, joints=tuple(_joint_in_plane(tree, joint) for joint in tree.joints))


def _joint_in_plane(tree: Tree, joint: Joint) -> Joint:
    """The joint with y = 0 and its axis rounded to the nearest allowed one. Raises ModelError where
    none is near: the error of rounded angles is removed, a robot that leaves the plane is refused.
    """
    where = f"URDF '{tree.source}', joint '{joint.name}'"
    x, y, z = joint.origin
    if abs(y) > PLANAR:
        raise ModelError(
            f"{where}: its origin lies {y:g} m beside its parent (y), expected 0; motion in the plane x-z "
            "does not depend on it, write y = 0"
        )
    if joint.type == "fixed":
        return replace(joint, origin=(x, 0.0, z))
    allowed: tuple[Vector, ...] = ((0.0, 1.0, 0.0), (0.0, -1.0, 0.0))
    if joint.type == "prismatic":
        allowed = ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, 0.0, -1.0))
    for axis in allowed:
        if math.dist(axis, joint.axis) < PLANAR:
            return replace(joint, origin=(x, 0.0, z), axis=axis)
    axes = "y" if joint.type == "revolute" else "x or z"
    raise ModelError(
        f"{where}: its axis is ({', '.join(f'{a:.4g}' for a in joint.axis)}) in the frame of the world at zero "
        f"angles, expected along {axes}; the robot must walk in the plane x-z, so make the joint 'fixed'"
    )


# -- the base --------------------------------------------------------------------------------------
def _moves(tree: Tree, joint: Joint) -> bool:
    """Whether the joint or one below it is not fixed."""
    return joint.type != "fixed" or any(_moves(tree, j) for j in tree.joints_below(joint.child))


def _slides(tree: Tree, root: str) -> tuple[list[Joint], str]:
    """The prismatic joints above the trunk, and the link below the last of them.

    Walks down from the root as long as there is one moving joint, and stops at the first revolute
    one.
    """
    slides: list[Joint] = []
    link = root
    while True:
        below = [joint for joint in tree.joints_below(link) if _moves(tree, joint)]
        if len(below) != 1 or below[0].type == "revolute":
            return slides, link
        if below[0].type == "prismatic":
            slides.append(below[0])
        link = below[0].child


def _found(tree: Tree, root: str, slides: list[Joint], link: str) -> PlanarBase:
    """The base that the URDF has, with its slides in the sense of +x and +z. Raises ModelError where
    it is incomplete or has mass.
    """
    names = [joint.name for joint in slides]
    along = {("x" if joint.axis[0] else "z"): joint.name for joint in slides}
    pitches = [joint for joint in tree.joints_below(link) if _moves(tree, joint)]
    if len(slides) != 2 or len(along) != 2 or len(pitches) != 1:
        raise ModelError(
            f"URDF '{tree.source}': its base slides by {names} and turns by {[j.name for j in pitches]}, "
            "expected one prismatic joint along x, one along z and one revolute pitch about y; complete the "
            "base, or remove it and one is put there"
        )
    pitch = pitches[0]
    carriages = [joint.parent for joint in tree.path_to_root(pitch.child) if joint.parent != root]
    heavy = [name for name in carriages if tree.links[name].inertial is not None]
    if heavy:
        raise ModelError(
            f"URDF '{tree.source}': links {heavy} of the base have mass, expected none; a robot in the plane "
            "floats freely, give the mass to the trunk"
        )
    forward = tuple(
        replace(j, axis=(abs(j.axis[0]), 0.0, abs(j.axis[2]))) if j in slides else j
        for j in tree.joints
    )
    said = (
        f"base: '{along['x']}' and '{along['z']}' slide, '{pitch.name}' is the pitch of the trunk "
        f"'{pitch.child}'",
    )
    return PlanarBase(
        replace(tree, joints=forward), (along["x"], along["z"]), pitch.name, pitch.child, said
    )


def _added(tree: Tree, root: str) -> PlanarBase:
    """A base above the root link; its pitch turns in the sense of the first revolute joint.

    Raises ModelError where the root is a mere frame with one revolute joint: an incomplete base.
    """
    turning = [joint for joint in tree.joints if joint.type == "revolute"]
    below = [joint for joint in tree.joints_below(root) if _moves(tree, joint)]
    if len(below) == 1 and tree.links[root].inertial is None and below[0].type == "revolute":
        raise ModelError(
            f"URDF '{tree.source}': the root '{root}' has no mass and carries the robot by "
            f"'{below[0].name}' alone; if that is the pitch of the trunk, put prismatic joints along x and z "
            "above it, or remove it and a base is put there"
        )
    axis = turning[0].axis if turning else (0.0, -1.0, 0.0)
    x, z, pitch = (_free(tree, name) for name in ("base_x", "base_z", "base_pitch"))
    world, cart, lift = (
        _free(tree, name) for name in ("world", "base_x_carriage", "base_z_carriage")
    )
    zero = (0.0, 0.0, 0.0)
    joints = (
        Joint(x, "prismatic", world, cart, zero, (1.0, 0.0, 0.0)),
        Joint(z, "prismatic", cart, lift, zero, (0.0, 0.0, 1.0)),
        Joint(pitch, "revolute", lift, root, zero, axis),
    )
    links = {name: Link(name, None, ()) for name in (world, cart, lift)} | dict(tree.links)
    said = (
        f"base: the URDF has none; '{x}', '{z}' and the pitch '{pitch}' (axis {axis[_Y]:+g} y, as "
        f"the first joint) were put above its root '{root}', the trunk",
    )
    return PlanarBase(
        replace(tree, links=links, joints=joints + tree.joints), (x, z), pitch, root, said
    )


def _free(tree: Tree, name: str) -> str:
    """`name`, or `name` with underscores where link or joint is called so already."""
    while name in tree.links or any(joint.name == name for joint in tree.joints):
        name += "_"
    return name


# -- below the trunk -------------------------------------------------------------------------------
def _check_below(found: PlanarBase) -> None:
    """Joints below the trunk turn, each of them moves some mass, and no name of the stance contact is taken.

    Raises ModelError that names the joint.
    """
    tree = found.tree
    below = [j for j in tree.joints if tree.path_below(j.child, found.trunk)]
    below.sort(key=lambda joint: joint.parent == found.trunk)
    where = f"URDF '{tree.source}'"
    if not any(joint.type == "revolute" for joint in below):
        raise ModelError(
            f"{where}: no revolute joint below the trunk '{found.trunk}'; a biped has at least one between "
            "its feet"
        )
    for joint in below:
        if joint.type == "prismatic":
            raise ModelError(
                f"{where}, joint '{joint.name}': prismatic below the trunk, expected revolute or fixed; "
                "only the base slides"
            )
        if joint.type == "revolute" and not _mass(tree, joint.child) > 0:
            raise ModelError(
                f"{where}: no mass moves with joint '{joint.name}'; give link '{joint.child}' an <inertial> "
                "or make the joint 'fixed'"
            )
        if joint.child == "ground" or joint.name == PIN_JOINT:
            raise ModelError(
                f"{where}: the names of link 'ground' and joint '{PIN_JOINT}' are taken by the stance "
                f"contact; rename '{joint.child}' or '{joint.name}'"
            )


def _mass(tree: Tree, link: str) -> float:
    """Mass of `link` and all that hangs on it [kg]."""
    inertial = tree.links[link].inertial
    below = sum(_mass(tree, joint.child) for joint in tree.joints_below(link))
    return below + (0.0 if inertial is None else inertial.mass)
