"""The legs exchange their roles at impact: the same configuration in coordinates of the next step.

    q+ = R q- + r,   v+ = R v-

Links of one leg have twins in the other; the trunk and any other link are their own twins. With A
the absolute angles of the links, a = A q, and P the exchange of twins, R solves A R = P A. So R is
a permutation for hips that count from a torso, and a combination for a hip that counts from the
other leg. r is not zero for robots with spokes; it comes from the record.

This assumes two legs that are alike, body by body, which `check_alike` tests when a robot is
imported. Twins are paired upwards from the feet. They must agree in mass, COM, inertia about y,
place on their parent, in the sense of their joints and in having a motor; then r = 0 and, where
hips count from a torso, R is a permutation.
"""

from __future__ import annotations

import math

import numpy as np

from biped_adrc.errors import ModelError
from biped_adrc.model.robots.urdf import Inertial, Joint, Tree
from biped_adrc.types import Array

_EXACT = 1e-9  # largest residual of A R = P A, dimensionless


def twins(tree: Tree, feet: tuple[str, str]) -> dict[str, str]:
    """Each link's twin, paired upwards from the feet; links that are not here are their own twins."""
    paired: dict[str, str] = {}
    chains = ([joint.child for joint in tree.path_to_root(foot)] for foot in feet)
    for one, other in zip(*chains, strict=False):
        if one == other or one in paired or other in paired:
            break
        paired |= {one: other, other: one}
    return paired


def absolute_angles(tree: Tree, joints: tuple[str, ...], links: list[str]) -> Array:
    """Rows (len(links), n), dimensionless: the absolute angle [rad] of each link as a sum of `joints`.

    An entry is +1 or -1 for a joint on the link's path to the root, the sign relative to the last
    joint, which is the pitch; 0 for other joints.
    """
    axis = next(joint.axis for joint in tree.joints if joint.name == joints[-1])
    rows = np.zeros((len(links), len(joints)))
    for row, link in zip(rows, links, strict=True):
        for joint in tree.path_to_root(link):
            if joint.name in joints:
                sign = sum(a * b for a, b in zip(joint.axis, axis, strict=True))
                row[joints.index(joint.name)] = sign
    return rows


def relabelling(tree: Tree, joints: tuple[str, ...], feet: tuple[str, str]) -> Array:
    """R (n, n) of q+ = R q- + r, dimensionless, from A R = P A by least squares.

    Entries within 1e-9 of an integer are rounded. Raises ModelError when no linear map exchanges
    the legs: the residual is not zero or R R is not the identity.
    """
    pairs = twins(tree, feet)
    chains = (joint.child for foot in feet for joint in tree.path_to_root(foot))
    turned = (joint.child for joint in tree.joints if joint.name in joints)
    links = list(dict.fromkeys((*chains, *turned)))
    A = absolute_angles(tree, joints, links)
    PA = absolute_angles(tree, joints, [pairs.get(link, link) for link in links])
    R = np.asarray(np.linalg.lstsq(A, PA, rcond=None)[0], dtype=np.float64)
    R = np.where(np.abs(R) < _EXACT, 0.0, R)
    R = np.where(np.abs(R - np.round(R)) < _EXACT, np.round(R), R) + 0.0
    if np.max(np.abs(A @ R - PA)) > _EXACT or np.max(np.abs(R @ R - np.eye(len(R)))) > _EXACT:
        raise ModelError(
            f"URDF '{tree.source}': the legs below '{feet[0]}' and '{feet[1]}' are not built alike, so they "
            f"cannot change over at impact; links were paired as {pairs}"
        )
    return R


_ALIKE = 1e-9  # relative to the numbers compared


def check_alike(tree: Tree, feet: tuple[str, str], pitch: str, actuated: tuple[str, ...]) -> None:
    """Check that twins agree in mass, COM, inertia, place, joint sense and motor.

    pitch: name of the pitch joint; actuated: joints with a motor. Raises ModelError that names the
    two bodies or joints, and what differs.
    """
    for one, other in pairs(tree, feet):
        where = f"URDF '{tree.source}': the legs differ:"
        a, b = (_numbers(tree.links[link].inertial) for link in (one, other))
        for what in a:
            if not _close(a[what], b[what]):
                raise ModelError(
                    f"{where} {what} is {text_of(a[what])} of '{one}' and {text_of(b[what])} of '{other}'; the "
                    "legs change over at impact, so make them equal, with equal zeros of their joints"
                )
        joints = tree.joint_above(one), tree.joint_above(other)
        if joints[0] is not None and joints[1] is not None:
            _check_joints(joints[0], joints[1], pitch, actuated, where)


def pairs(tree: Tree, feet: tuple[str, str]) -> tuple[tuple[str, str], ...]:
    """Links of the stance leg with their twins in the swing leg, from the feet upwards."""
    found = twins(tree, feet)
    stance = [joint.child for joint in tree.path_to_root(feet[0])]
    return tuple((link, found[link]) for link in stance if link in found)


def _numbers(inertial: Inertial | None) -> dict[str, tuple[float, ...]]:
    """What twins must have alike, by its name with unit; zeros for a link without mass."""
    body = inertial or Inertial(0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    com = body.com[0], body.com[2]
    return {
        "mass [kg]": (body.mass,),
        "COM (x, z) [m]": com,
        "inertia iyy [kg m^2]": body.inertia[3:4],
    }


def _check_joints(
    one: Joint, other: Joint, pitch: str, actuated: tuple[str, ...], where: str
) -> None:
    """Raise ModelError where the joints above two twins differ in place, type, sense or motor."""
    if pitch in (one.name, other.name):
        return  # one leg is the trunk: its place is the base's
    places = (one.origin[0], one.origin[2]), (other.origin[0], other.origin[2])
    if not _close(*places):
        raise ModelError(
            f"{where} the place (x, z) [m] is {text_of(places[0])} of '{one.name}' and {text_of(places[1])} of "
            f"'{other.name}'; make it equal"
        )
    if one.type != other.type or (one.type == "revolute" and one.axis != other.axis):
        raise ModelError(
            f"{where} '{one.name}' is {one.type} about {text_of(one.axis)} and '{other.name}' {other.type} "
            f"about {text_of(other.axis)}; give both the same type and sense"
        )
    if (one.name in actuated) != (other.name in actuated):
        raise ModelError(
            f"{where} of '{one.name}' and '{other.name}' only one has a motor; name both or none by "
            "actuated=(...) or --actuated"
        )


def _close(a: tuple[float, ...], b: tuple[float, ...]) -> bool:
    """Whether two tuples differ by no more than round-off, relative to the larger one."""
    return math.dist(a, b) <= _ALIKE * max(math.hypot(*a), math.hypot(*b))


def text_of(values: tuple[float, ...]) -> str:
    """One number, or several in parentheses, for a message."""
    text = ", ".join(f"{value:.6g}" for value in values)
    return text if len(values) == 1 else f"({text})"
