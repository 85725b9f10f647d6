"""The planar base of a robot: two slides along x and z, then the pitch of the trunk, q_N.

The planar base leaves a robot free in the plane of motion x-z. It is two slides, which are prismatic joints,
and one revolute joint about y, in this order from the root. The trunk is the link that it carries, the torso of
a biped. The contact of the stance foot determines the place of the base, so only its pitch remains as a
coordinate. `on_planar_base`, the first stage of `import_robot.derive`, makes the base of what a file has:

    a planar base           kept; slides that the file turns, as on a ramp, are put along x and z, and the zero
                            of the pitch turns with them
    no base                 a new one above the root link; its pitch turns in the sense of the first joint
    a `floating` joint, or  a new base in its place, as for no base
    a fixed one to "world"
    a `planar` joint        a new base in its place; its pitch keeps the axis of that joint
    a revolute joint to     slides below it; the joint itself becomes the pitch
    the ground, a pin

A mass above the pitch does not turn with it, and one on the first slide moves in one direction only. The
inertia matrix of a robot pinned at its foot has no such masses: light ones are left out, and a note names them,
others are refused. Places along y do not enter planar motion, and stay as they are.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from biped_adrc.core.errors import ModelError
from biped_adrc.model.pinned import PIN_JOINT, ZERO
from biped_adrc.model.robots.urdf import Joint, Link, Note, Notes, Tree, Triple, free_name, text_of
from biped_adrc.model.robots.urdf_reader import PLANAR

_NAMES = ("base_x", "base_z", "base_pitch")
LIGHT = 0.01
"""Largest share of the robot's mass that the slides of its base may have, and which is left out."""


@dataclass(frozen=True)
class PlanarBase:
    """A robot as a tree of links and joints, with its planar base of two slides (prismatic joints) and the
    pitch.
    """

    tree: Tree
    base: tuple[str, str]
    """Names of the prismatic joints along x and z."""
    pitch: str
    """Name of the revolute joint about y that carries the trunk."""
    trunk: str
    """Link that the base carries."""
    notes: Notes
    """Notes for the user on what was found, added or left out, the one on the base first."""

    def noting(self, *notes: Note) -> PlanarBase:
        """A copy with these notes behind the others."""
        return replace(self, notes=(*self.notes, *notes))


def on_planar_base(tree: Tree) -> PlanarBase:
    """The robot of a file on a planar base: the one that it has, or one added above its root or in place of the
    joint that holds it, with the axes of all joints exactly in the plane.

    Raises ModelError for joints out of the plane, a base of another kind or with mass,
    and joints that move no mass.
    """
    tree = replace(tree, joints=tuple(_in_plane(tree, joint) for joint in tree.joints))
    slides = [joint for joint in tree.joints if joint.type == "prismatic"]
    # the root is the one link that no joint carries
    root = next(link for link in tree.links if tree.joint_above(link) is None)
    # the joint by which the root holds the robot or lets it float; None without one
    top = _top(tree, root)
    # a joint above slides is a part of the base that the file has
    # _released: a new base in place of `top`; _own: the file's own base; added: a new base above the root
    if top is not None and not (slides and top.type in ("fixed", "revolute")):
        on_base = _released(tree, root, top)
    else:
        on_base = _own(tree, slides) if slides else added(tree, root)
    _check_below(on_base)
    return on_base


def _in_plane(tree: Tree, joint: Joint) -> Joint:
    """The joint with its axis rounded to y or -y, or for a slide into the plane x-z. Raises ModelError for an
    axis that deviates by PLANAR or more; the axis of a `planar` joint is the normal of its plane.
    """
    if joint.type in ("fixed", "floating"):
        return joint
    x, y, z = joint.axis
    slides = joint.type == "prismatic"
    axis = (x, 0.0, z) if slides else (0.0, math.copysign(1.0, y), 0.0)
    if math.dist(axis, joint.axis) < PLANAR:
        return replace(joint, axis=axis)
    raise ModelError(
        f"'{tree.source}', joint '{joint.name}': its axis is {text_of(joint.axis)} in the frame of the "
        f"world at zero angles, expected {'in the plane x-z' if slides else 'along y'}; the robot must walk in "
        "the plane x-z, so make the joint 'fixed'"
    )


def _top(tree: Tree, root: str) -> Joint | None:
    """The joint in whose place a base is put: one of type `planar` or `floating` (it floats), or the only joint
    on a root without mass, if it is revolute, or fixed on a root called world; else None.

    Raises ModelError for a joint that floats below another one.
    """
    below = tree.joints_below(root)
    floats = [joint for joint in tree.joints if joint.type in ("planar", "floating")]
    # allowed: a single one, on the root; [:1] is empty where none of them is on the root
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
    """The tree below the joint `top`, on a base added in place of `top` and of all that does not hang below it.

    The name and axis of a planar or revolute `top` become those of the pitch.
    """
    # _NAMES: usual names of the two slides and the pitch
    turns = top.type in ("planar", "revolute")
    on_base = added(tree, top.child, *((top.axis, (*_NAMES[:2], top.name)) if turns else ()))
    other = sorted(set(tree.links) - {*on_base.tree.links, root})
    text = f"{top.type} joint '{top.name}' to '{root}': the robot stands on its feet instead"
    rest_of = f"; and {other}, which do not move with it" if other else ""
    return on_base.noting(Note("left out", text + rest_of))


def _own(tree: Tree, slides: list[Joint]) -> PlanarBase:
    """The robot on the planar base that the file has already; its slides get the axes +x and +z, also if those
    of the file are turned in the plane, as on a slope.

    slides: all prismatic joints of the tree. Raises ModelError where the base is incomplete or its moving links
    have more than the share LIGHT of the robot's mass.
    """
    turning = [joint for joint in tree.joints if joint.type == "revolute"]
    # tops: revolute joints with no other above them, one if it is the pitch; carriers: joints above it;
    # carried: links below it
    tops = [j for j in turning if not set(turning) & set(tree.path_to_root(j.parent))]
    carriers = tree.path_to_root(tops[0].parent) if tops else ()
    carried = tree.links_from(tops[0].child) if tops else []
    # still: masses [kg] that the pitch does not carry; heavy: those of them that a slide moves
    masses = {x: body.mass for x, link in tree.links.items() if (body := link.inertial)}
    still = {x: masses.pop(x) for x in list(masses) if x not in carried}
    heavy = {x: m for x, m in still.items() if set(slides) & set(tree.path_to_root(x))}
    robot = sum(masses.values())  # what the pitch carries, as the other masses were popped
    # the slide nearer to x first; two slides are parallel where the determinant of their axes (x, z) is 0
    flat = sorted(slides, key=lambda joint: abs(joint.axis[2]))
    # PLANAR: at most so parallel
    plane = len(flat) == 2 and abs(np.linalg.det([j.axis[::2] for j in flat])) > PLANAR
    plane = plane and set(slides) <= set(carriers) and len(tops) == 1
    if not plane or sum(heavy.values()) > LIGHT * robot:
        raise ModelError(
            f"'{tree.source}': its base slides by {[j.name for j in slides]}, turns by "
            f"{[j.name for j in tops]} and has mass in {heavy} kg; expected two prismatic joints in the plane "
            f"x-z, then one revolute pitch about y, and above the trunk at most {LIGHT:.0%} of the robot's "
            f"{robot:.5g} kg. Complete the base, or remove it and one is put there"
        )
    (pitch,), x = tops, flat[0]
    names = tuple(joint.name for joint in (*flat, pitch))
    on_base = added(tree, pitch.child, pitch.axis, names)
    text = "base: '{}' and '{}' slide, '{}' is the pitch of the trunk".format(*names)
    slope = math.atan(-x.axis[2] / x.axis[0])  # positive downhill
    # (kind, whether it is so, text), in place of the note of `added` that a new base was put there
    notes = (
        ("read", True, f"{text} '{pitch.child}'"),
        ("left out", still, f"masses [kg] that stand still, or only slide with the base: {still}"),
        ("left out", abs(slope) > PLANAR, f"slope of '{x.name}', {slope:g} rad: see ground.slope"),
    )
    return replace(on_base, notes=tuple(Note(kind, text) for kind, found, text in notes if found))


def added(
    tree: Tree, root: str, axis: Triple | None = None, names: tuple[str, ...] = _NAMES
) -> PlanarBase:
    """The tree from link `root` downwards with a new planar base above it, and nothing else.

    Its pitch turns about `axis`; None: in the sense of the first revolute joint of the tree. names: of the
    slides along x and z and of the pitch, with underscores where another link or joint has the name.
    """
    # `links_from` is empty for the root of the tree: then all links are carried
    carried = {link: tree.links[link] for link in tree.links_from(root) or tree.links}
    tree = replace(tree, links=carried, joints=tuple(j for j in tree.joints if j.parent in carried))
    # without any revolute joint about -y, which is counter-clockwise with x to the right and z up
    axis = axis or next((j.axis for j in tree.joints if j.type == "revolute"), (0.0, -1.0, 0.0))
    every = (*names, "world", "base_x_carriage", "base_z_carriage")
    x, z, pitch, world, cart, lift = (free_name(tree, name) for name in every)
    joints = (
        Joint(x, "prismatic", world, cart, ZERO, (1.0, 0.0, 0.0)),
        Joint(z, "prismatic", cart, lift, ZERO, (0.0, 0.0, 1.0)),
        Joint(pitch, "revolute", lift, root, ZERO, axis),
    )
    # three links without mass and shapes
    links = {name: Link(name, None, ()) for name in (world, cart, lift)} | carried
    text = f"base: '{x}', '{z}' and pitch '{pitch}' (axis {axis[1]:+g} y) put above '{root}'"
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
    # joints away from the trunk first: where a whole leg has no mass, the message names a lower link of it
    for joint in sorted(below, key=lambda joint: joint.parent == on_base.trunk):
        wrong = ""
        carried = tree.links_from(joint.child)
        if joint.type == "revolute" and not any(tree.links[x].inertial for x in carried):
            wrong = f"it moves no mass; give link '{joint.child}' an <inertial>, or make it 'fixed'"
        elif joint.child == "ground" or joint.name == PIN_JOINT:
            wrong = f"link 'ground' and joint '{PIN_JOINT}' are of the stance contact; rename it"
        if wrong:
            raise ModelError(f"{where}, joint '{joint.name}': {wrong}")
