"""The parts of a planar biped found in its tree: planar base, feet, hip, order of the
joints, and the phase variable.

The phase is the absolute angle of the virtual stance leg from the hip to the stance foot, counter-clockwise
with x to the right and z up, so that it falls while the robot walks to +x. With a_k the absolute angles of the
links of the stance leg and l_k the lengths of the leg in them,

    Theta = sum_k l_k a_k / sum_k l_k = c q + const

which is q5 + q1 + q3/2 for RABBIT. For two links of equal length this is the angle itself (an isosceles
triangle), for others its first-order part about the straight leg; a virtual constraint needs a constant row c.

`import_robot.derive` calls `anatomy` after the base is known. What the URDF does not say is guessed only when
there is one answer, and every guess is a sentence in `Derived.guesses`.

The planar base (x, z, pitch) is found in a URDF, or added above its root. It is two prismatic joints along x
and z and one revolute joint about y, in this order from the root, with no mass in between. The stance contact
determines its position, so only the pitch remains as a coordinate, q_N. A URDF without a base floats on its
root link; the base put there turns in the sense of its other joints. Places along y do not enter planar
motion, and stay as they are. `import_robot.derive` calls `on_planar_base` first.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace
from itertools import pairwise, zip_longest

import numpy as np

from biped_adrc.core.errors import ModelError
from biped_adrc.core.types import Array
from biped_adrc.model.pinned import PIN_JOINT
from biped_adrc.model.robots.urdf import Joint, Link, Tree, absolute_angles, text_of

_FOOT_NAMES = re.compile(r"foot|feet|toe|sole", re.IGNORECASE)
"""Words in the name of a link that make it a foot."""
_AWAY = 1e-6  # [m], a foot nearer to its last joint than this is no foot


@dataclass(frozen=True)
class Anatomy:
    """Names of the parts of a biped: feet, hip, joints in order, and its phase variable."""

    feet: tuple[str, str]
    """Stance and swing foot."""
    hip: str
    """Link whose origin is the hip."""
    moving: tuple[Joint, ...]
    """Revolute joints without the pitch, in the order q1, q2, ..."""
    phase: tuple[float, ...]
    """Row c (n,) of Theta = c q, dimensionless; the last entry belongs to the pitch."""
    remarks: tuple[str, ...]
    """Sentences on what was guessed."""


def anatomy(body: PlanarBase, feet: tuple[str, ...] | None, hip: str | None) -> Anatomy:
    """Find the parts of a biped; `feet` (stance, swing) and `hip` are guessed when they are None.

    Raises ModelError with the candidates and the option to give when a guess is not certain.
    """
    guesses: tuple[str, ...] = ()
    if feet is None:
        feet, guesses = _guessed_feet(body)
    pair = _checked_feet(body, feet)
    if hip is None:
        hip, sentence = _guessed_hip(body.tree, pair)
        guesses = (*guesses, sentence)
    _check_hip(body, hip, pair[0])
    moving = _in_order(body, pair)
    pitch = next(joint for joint in body.tree.joints if joint.name == body.pitch)
    c = _phase(body.tree, pair[0], hip, (*moving, pitch))
    terms = zip(c, (*moving, pitch), strict=True)
    text = " ".join(f"{w:+.6g} {joint.name}" for w, joint in terms if w != 0.0)
    guesses = (*guesses, f"phase: Theta = {text}, the virtual leg from the hip to '{pair[0]}'")
    return Anatomy(pair, hip, moving, tuple(float(w) for w in c), guesses)


def position(tree: Tree, link: str) -> Array:
    """Position (x, z) of the frame of a link at zero angles (2,) [m]: the sum of the
    origins, as frames are parallel.
    """
    origins = [joint.origin for joint in tree.path_to_root(link)]
    return np.array([math.fsum(o[0] for o in origins), math.fsum(o[2] for o in origins)])


def _chain(body: PlanarBase, link: str) -> list[Joint]:
    """Revolute joints between `link` and the trunk, from the trunk outwards. Raises ModelError."""
    path = body.tree.path_below(link, body.trunk)
    if path is None:
        raise ModelError(
            f"URDF '{body.tree.source}': link '{link}' does not hang on the trunk '{body.trunk}'; foot and "
            "hip must"
        )
    return [joint for joint in reversed(path) if joint.type == "revolute"]


# -- feet ------------------------------------------------------------------------------------------
def _leaves(body: PlanarBase) -> list[str]:
    """Names of the links at the ends of the tree, in the order of the file."""
    tree = body.tree
    ends = (link for link in tree.links if not tree.joints_below(link))
    return [link for link in ends if tree.path_below(link, body.trunk) is not None]


def _guessed_feet(body: PlanarBase) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Guess the two feet: the two ends below the most joints, or the two whose names say
    foot; also returns the reason.

    Raises ModelError where neither rule gives exactly two.
    """
    leaves = _leaves(body)
    depth = {leaf: len(_chain(body, leaf)) for leaf in leaves}
    most = max(depth.values())
    deepest = [leaf for leaf in leaves if depth[leaf] == most]
    named = [leaf for leaf in leaves if _FOOT_NAMES.search(leaf)]
    for guess, why in (
        (deepest, f"the two ends that hang by most joints, {most} below the trunk"),
        (named, "the two ends that are called feet"),
    ):
        if len(guess) == 2:
            sentence = f"feet: '{guess[0]}' (drawn as the stance foot) and '{guess[1]}', {why}"
            return tuple(guess), (sentence,)
    raise ModelError(
        f"URDF '{body.tree.source}': which two of the links {leaves} are the feet is not certain; say it by "
        "feet=('stance', 'swing') or --feet stance,swing"
    )


def _checked_feet(body: PlanarBase, feet: tuple[str, ...]) -> tuple[str, str]:
    """The feet (stance, swing), after a check that they are two links that a joint moves against each other.

    Raises ModelError that names what is wrong.
    """
    known = len(feet) == 2 and set(feet) <= set(body.tree.links)
    if not known or _chain(body, feet[0]) == _chain(body, feet[1]):
        raise ModelError(
            f"URDF '{body.tree.source}': feet {list(feet)}, expected two links that a joint moves against each "
            f"other, the stance foot first, by feet=(...) or --feet; the ends of the tree are {_leaves(body)}"
        )
    for foot in feet:
        _check_foot(body.tree, foot)
    return feet[0], feet[1]


def _check_foot(tree: Tree, foot: str) -> None:
    """Raise ModelError unless the foot lies away from the joint that moves it, with a hint how to add a tip."""
    last = next(joint for joint in tree.path_to_root(foot) if joint.type == "revolute")
    if math.dist(position(tree, foot), position(tree, last.child)) < _AWAY:
        raise ModelError(
            f"URDF '{tree.source}': foot '{foot}' lies on the axis of its own joint '{last.name}', so the "
            "leg has no end; put a link without mass at its tip and name it by feet=(...) or --feet, or give "
            "the place of the tip in the link's frame by tip=(x, y, z) or --tip x,y,z"
        )


# -- joints ----------------------------------------------------------------------------------------
def _in_order(body: PlanarBase, feet: tuple[str, str]) -> tuple[Joint, ...]:
    """Order the joints: stance hip, swing hip, stance knee, swing knee, ...; then the joints
    that belong to no leg alone.

    From the trunk outwards, a joint of the stance leg before its twin of the swing leg: the paper's order.
    """
    one, other = (_chain(body, foot) for foot in feet)
    pairs = zip_longest((j for j in one if j not in other), (j for j in other if j not in one))
    legs = [joint for pair in pairs for joint in pair if joint is not None]
    turning = [j for j in body.tree.joints if j.type == "revolute" and j.name != body.pitch]
    return (*legs, *(joint for joint in turning if joint not in legs))


# -- hip and phase ---------------------------------------------------------------------------------
def _guessed_hip(tree: Tree, feet: tuple[str, str]) -> tuple[str, str]:
    """Guess the link whose origin is the hip, where the legs meet at the first joint of the
    swing leg; with the reason.

    Raises ModelError where the swing foot is fixed to the stance leg.
    """
    one, other = ([foot, *(j.parent for j in tree.path_to_root(foot))] for foot in feet)
    meet = next(link for link in one if link in other)
    swing = [j for j in tree.path_to_root(feet[1]) if j.child not in one and j.type == "revolute"]
    if not swing:
        raise ModelError(
            f"URDF '{tree.source}': the swing foot '{feet[1]}' is fixed to the stance leg; give the feet the "
            f"other way round, feet=('{feet[1]}', '{feet[0]}')"
        )
    here = math.dist(position(tree, meet), position(tree, swing[-1].child)) < _AWAY
    link = meet if here and _keeps_its_origin(tree, meet, feet[0]) else swing[-1].child
    return link, f"hip: the origin of '{link}', where '{swing[-1].name}' joins the legs"


def _check_hip(body: PlanarBase, hip: str, foot: str) -> None:
    """Raise ModelError unless the hip hangs on the trunk and its origin survives re-rooting at the foot."""
    tree = body.tree
    below = [link for link in tree.links if tree.path_below(link, body.trunk) is not None]
    fits = [link for link in below if _keeps_its_origin(tree, link, foot)]
    if hip not in fits:
        raise ModelError(
            f"URDF '{tree.source}': hip '{hip}', expected a link whose origin stays when the tree is turned "
            f"round at the stance foot '{foot}': one of {fits}"
        )


def _keeps_its_origin(tree: Tree, link: str, foot: str) -> bool:
    """Whether re-rooting at `foot` leaves the origin of `link` where it is.

    `pinned.reroot` moves the frame of a link on the stance leg to the joint below it.
    """
    outwards = [joint for joint in tree.path_to_root(foot) if joint.parent == link]
    return all(math.hypot(*joint.origin[::2]) < _AWAY for joint in outwards)


def _phase(tree: Tree, foot: str, hip: str, joints: tuple[Joint, ...]) -> Array:
    """Row c (n,) of Theta, from the lengths [m] of the stance leg's links between foot and hip."""
    carriers = {hip, *(joint.parent for joint in tree.path_to_root(hip))}
    points, links = [position(tree, foot)], []
    for joint in tree.path_to_root(foot):
        links.append(joint.child)
        if joint.child in carriers:
            break
        points.append(position(tree, joint.child))
    points.append(position(tree, hip))
    lengths = np.array([math.dist(a, b) for a, b in pairwise(points)])
    counter_clockwise = -joints[-1].axis[1]
    rows = absolute_angles(tree, tuple(joint.name for joint in joints), links)
    c: Array = counter_clockwise * lengths @ rows / np.sum(lengths) + 0.0
    return c


PLANAR = 1e-4
"""Largest deviation of an axis from the plane, since rpy is rounded in files, dimensionless."""
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
    remarks: tuple[str, ...]
    """Sentences on what was found or added."""


def on_planar_base(tree: Tree) -> PlanarBase:
    """The planar tree with the base it has, or with one added above its root.

    Raises ModelError for joints out of the plane, a base of another kind or with mass,
    and joints that move no mass.
    """
    tree = replace(tree, joints=tuple(_in_plane(tree, joint) for joint in tree.joints))
    slides = [joint for joint in tree.joints if joint.type == "prismatic"]
    on_base = _own(tree, slides) if slides else _added(tree)
    _check_below(on_base)
    return on_base


def _in_plane(tree: Tree, joint: Joint) -> Joint:
    """The joint with its axis rounded to the nearest allowed one. Raises ModelError if it is not near one."""
    if joint.type == "fixed":
        return joint
    x, _, z = map(abs, joint.axis)
    along = _Y if joint.type == "revolute" else 0 if x > z else 2
    axis = [0.0, 0.0, 0.0]
    axis[along] = math.copysign(1.0, joint.axis[along])
    if math.dist(axis, joint.axis) < PLANAR:
        return replace(joint, axis=(axis[0], axis[1], axis[2]))
    raise ModelError(
        f"URDF '{tree.source}', joint '{joint.name}': its axis is {text_of(joint.axis)} in the frame of the "
        f"world at zero angles, expected along {'y' if along == _Y else 'x or z'}; the robot must walk in the "
        "plane x-z, so make the joint 'fixed'"
    )


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
            f"URDF '{tree.source}': its base slides by {[j.name for j in slides]}, turns by "
            f"{[j.name for j in tops]} and has mass in {heavy}; expected one prismatic joint along x, one "
            "along z, then one revolute pitch about y, and no mass above the trunk. Complete the base, or "
            "remove it and one is put there"
        )
    (pitch,), (x, z) = tops, (along["x"], along["z"])
    forward = tuple(
        replace(j, axis=(abs(j.axis[0]), 0.0, abs(j.axis[2]))) if j in slides else j
        for j in tree.joints
    )
    remark = (
        f"base: '{x}' and '{z}' slide, '{pitch.name}' is the pitch of the trunk '{pitch.child}'"
    )
    return PlanarBase(replace(tree, joints=forward), (x, z), pitch.name, pitch.child, (remark,))


def _added(tree: Tree) -> PlanarBase:
    """The tree with a base added above the root link; its pitch turns in the sense of
    the first revolute joint.
    """
    root = next(link for link in tree.links if tree.joint_above(link) is None)
    axis = next((j.axis for j in tree.joints if j.type == "revolute"), (0.0, -1.0, 0.0))
    names = ("base_x", "base_z", "base_pitch", "world", "base_x_carriage", "base_z_carriage")
    x, z, pitch, world, cart, lift = (_free(tree, name) for name in names)
    zero = (0.0, 0.0, 0.0)
    joints = (
        Joint(x, "prismatic", world, cart, zero, (1.0, 0.0, 0.0)),
        Joint(z, "prismatic", cart, lift, zero, (0.0, 0.0, 1.0)),
        Joint(pitch, "revolute", lift, root, zero, axis),
    )
    links = {name: Link(name, None, ()) for name in (world, cart, lift)} | dict(tree.links)
    remark = (
        f"base: the URDF has none; '{x}', '{z}' and the pitch '{pitch}' (axis {axis[_Y]:+g} y, as "
        f"the first joint) were put above its root '{root}', the trunk"
    )
    tree = replace(tree, links=links, joints=joints + tree.joints)
    return PlanarBase(tree, (x, z), pitch, root, (remark,))


def _free(tree: Tree, name: str) -> str:
    """The name itself, or with underscores appended until no link or joint of the tree has it."""
    while name in tree.links or any(joint.name == name for joint in tree.joints):
        name += "_"
    return name


def _check_below(on_base: PlanarBase) -> None:
    """Check that each joint below the trunk moves some mass, and that no name of the stance contact is used.

    Raises ModelError that names the joint.
    """
    tree, where = on_base.tree, f"URDF '{on_base.tree.source}'"
    below = [j for j in tree.joints if tree.path_below(j.child, on_base.trunk)]
    if not any(joint.type == "revolute" for joint in below):
        raise ModelError(
            f"{where}: no revolute joint below the trunk '{on_base.trunk}'; a biped has at least one between "
            "its feet"
        )
    for joint in sorted(below, key=lambda joint: joint.parent == on_base.trunk):
        wrong = ""
        if joint.type == "revolute" and not _mass(tree, joint.child) > 0:
            wrong = f"it moves no mass; give link '{joint.child}' an <inertial>, or make it 'fixed'"
        elif joint.child == "ground" or joint.name == PIN_JOINT:
            wrong = f"link 'ground' and joint '{PIN_JOINT}' are of the stance contact; rename it"
        if wrong:
            raise ModelError(f"{where}, joint '{joint.name}': {wrong}")


def _mass(tree: Tree, link: str) -> float:
    """Mass of `link` and all links below it [kg]."""
    inertial = tree.links[link].inertial
    below = sum(_mass(tree, joint.child) for joint in tree.joints_below(link))
    return below + (0.0 if inertial is None else inertial.mass)
