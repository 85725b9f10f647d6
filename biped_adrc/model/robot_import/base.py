"""The planar base of a robot: two slides along x and z, then the pitch of the trunk, q_N.

The planar base (x, z, pitch) is found in a file, or added above its root. It is two prismatic joints along x
and z and one revolute joint about y, in this order from the root, with no mass in between. The stance contact
determines its position, so only the pitch remains as a coordinate. A robot without a base floats on its
root link; the base put there turns in the sense of its other joints, as the one in place of a `floating` joint
or of a `planar` joint does, which has a sense of its own. A robot that the file pins to the ground by
a revolute joint gets slides below the pin. Places along y do not enter planar motion, and stay as they are.
`import_robot.derive` calls `on_planar_base` first.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from biped_adrc.core.errors import ModelError
from biped_adrc.model.pinned import PIN_JOINT
from biped_adrc.model.robots.urdf import Joint, Link, Note, Tree, Vector, free_name, text_of
from biped_adrc.model.robots.urdf_reader import PLANAR

_Y = 1


@dataclass(frozen=True)
class PlanarBase:
    """A tree with its planar base of two prismatic joints and the pitch."""

    tree: Tree
    base: tuple[str, str]
    """Names of the prismatic joints along x and z."""
    pitch: str
    """Name of the revolute joint about y that carries the trunk."""
    trunk: str
    """Link that the base carries."""
    notes: tuple[Note, ...]
    """Sentences on what was found or added."""

    def noting(self, *notes: Note) -> PlanarBase:
        """A copy with more notes."""
        return replace(self, notes=(*self.notes, *notes))


def on_planar_base(tree: Tree) -> PlanarBase:
    """The planar tree with the base it has, or with one added above its root.

    Raises ModelError for joints out of the plane, a base of another kind or with mass,
    and joints that move no mass.
    """
    tree = replace(tree, joints=tuple(_in_plane(tree, joint) for joint in tree.joints))
    slides = [joint for joint in tree.joints if joint.type == "prismatic"]
    root = next(link for link in tree.links if tree.joint_above(link) is None)
    top = _top(tree, root)
    if top is not None:
        on_base = _released(tree, root, top)
    else:
        on_base = _own(tree, slides) if slides else added(tree, root)
    _check_below(on_base)
    return on_base


def _in_plane(tree: Tree, joint: Joint) -> Joint:
    """The joint with its axis rounded to the nearest allowed one. Raises ModelError if it is not near one."""
    if joint.type in ("fixed", "floating"):
        return joint
    x, _, z = map(abs, joint.axis)
    along = _Y if joint.type != "prismatic" else 0 if x > z else 2
    axis = [0.0, 0.0, 0.0]
    axis[along] = math.copysign(1.0, joint.axis[along])
    if math.dist(axis, joint.axis) < PLANAR:
        return replace(joint, axis=(axis[0], axis[1], axis[2]))
    raise ModelError(
        f"'{tree.source}', joint '{joint.name}': its axis is {text_of(joint.axis)} in the frame of the "
        f"world at zero angles, expected along {'y' if along == _Y else 'x or z'}; the robot must walk in the "
        "plane x-z, so make the joint 'fixed'"
    )


def _top(tree: Tree, root: str) -> Joint | None:
    """The joint in whose place a base is put: one that floats, or the only one between robot and world.

    Raises ModelError for a joint that floats below another one.
    """
    below = tree.joints_below(root)
    floats = [joint for joint in tree.joints if joint.type in ("planar", "floating")]
    if floats and floats != [joint for joint in below if joint in floats][:1]:
        raise ModelError(
            f"'{tree.source}', joint '{floats[-1].name}': type '{floats[-1].type}', expected one joint of "
            f"this kind at most, at the root '{root}', where it leaves the robot free"
        )
    holds = ("revolute", "fixed") if root == "world" else ("revolute",)
    if not floats and len(below) == 1 and tree.links[root].inertial is None:
        floats = [joint for joint in below if joint.type in holds]
    return floats[0] if floats else None


def _released(tree: Tree, root: str, top: Joint) -> PlanarBase:
    """The tree below `top` on a base added in its place; an axis of `top` is that of the pitch."""
    names = tree.links_from(top.child)
    joints = tuple(joint for joint in tree.joints if joint.parent in names)
    rest = replace(tree, links={link: tree.links[link] for link in names}, joints=joints)
    turns = top.type in ("planar", "revolute")
    on_base = added(rest, top.child, *((top.axis, top.name) if turns else ()))
    other = sorted(set(tree.links) - {*names, root})
    text = f"{top.type} joint '{top.name}' to '{root}': the robot stands on its feet instead"
    left = f"{text}; and {other}, which do not move with it" if other else text
    return on_base.noting(Note("left out", left))


def _own(tree: Tree, slides: list[Joint]) -> PlanarBase:
    """The planar base that the URDF has already, its slides turned to the directions +x and +z.

    Raises ModelError where it is incomplete or has mass.
    """
    turning = [joint for joint in tree.joints if joint.type == "revolute"]
    above = {joint.name: tree.path_to_root(joint.parent) for joint in turning}
    tops = [j for j in turning if not any(a.type == "revolute" for a in above[j.name])]
    carriers = above[tops[0].name] if tops else ()
    heavy = [j.child for j in carriers if tree.links[j.child].inertial is not None]
    along = {("x" if joint.axis[0] else "z"): joint.name for joint in slides}
    complete = len(slides) == len(along) == 2 and all(joint in carriers for joint in slides)
    if not complete or len(tops) != 1 or heavy:
        raise ModelError(
            f"'{tree.source}': its base slides by {[j.name for j in slides]}, turns by "
            f"{[j.name for j in tops]} and has mass in {heavy}; expected one prismatic joint along x, one "
            "along z, then one revolute pitch about y, and no mass above the trunk. Complete the base, or "
            "remove it and one is put there"
        )
    (pitch,), (x, z) = tops, (along["x"], along["z"])
    forward = tuple(
        replace(j, axis=(abs(j.axis[0]), 0.0, abs(j.axis[2]))) if j in slides else j
        for j in tree.joints
    )
    text = f"base: '{x}' and '{z}' slide, '{pitch.name}' is the pitch of the trunk '{pitch.child}'"
    tree, note = replace(tree, joints=forward), Note("read", text)
    return PlanarBase(tree, (x, z), pitch.name, pitch.child, (note,))


def added(
    tree: Tree, root: str, axis: Vector | None = None, pitch: str = "base_pitch"
) -> PlanarBase:
    """The tree with a base added above the root link; its pitch turns about `axis`, or in the sense of
    the first revolute joint.
    """
    first = next((j.axis for j in tree.joints if j.type == "revolute"), (0.0, -1.0, 0.0))
    axis = axis or first
    names = ("base_x", "base_z", pitch, "world", "base_x_carriage", "base_z_carriage")
    x, z, pitch, world, cart, lift = (free_name(tree, name) for name in names)
    zero = (0.0, 0.0, 0.0)
    joints = (
        Joint(x, "prismatic", world, cart, zero, (1.0, 0.0, 0.0)),
        Joint(z, "prismatic", cart, lift, zero, (0.0, 0.0, 1.0)),
        Joint(pitch, "revolute", lift, root, zero, axis),
    )
    links = {name: Link(name, None, ()) for name in (world, cart, lift)} | dict(tree.links)
    turns = f"axis {axis[_Y]:+g} y"
    text = f"base: '{x}', '{z}' and the pitch '{pitch}' ({turns}) were put above the trunk '{root}'"
    tree = replace(tree, links=links, joints=joints + tree.joints)
    return PlanarBase(tree, (x, z), pitch, root, (Note("assumed", text),))


def _check_below(on_base: PlanarBase) -> None:
    """Check that each joint below the trunk moves some mass, and that no name of the stance contact is used.

    Raises ModelError that names the joint.
    """
    tree, where = on_base.tree, f"'{on_base.tree.source}'"
    below = [j for j in tree.joints if tree.path_below(j.child, on_base.trunk)]
    if not any(joint.type == "revolute" for joint in below):
        raise ModelError(
            f"{where}: no revolute joint below the trunk '{on_base.trunk}'; a biped has at least one between "
            "its feet"
        )
    for joint in sorted(below, key=lambda joint: joint.parent == on_base.trunk):
        wrong = ""
        carried = tree.links_from(joint.child)
        if joint.type == "revolute" and not any(tree.links[x].inertial for x in carried):
            wrong = f"it moves no mass; give link '{joint.child}' an <inertial>, or make it 'fixed'"
        elif joint.child == "ground" or joint.name == PIN_JOINT:
            wrong = f"link 'ground' and joint '{PIN_JOINT}' are of the stance contact; rename it"
        if wrong:
            raise ModelError(f"{where}, joint '{joint.name}': {wrong}")
