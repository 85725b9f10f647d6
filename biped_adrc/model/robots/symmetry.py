"""The legs exchange their roles at impact: the same configuration in coordinates of the next step.

    q+ = R q- + r,   v+ = R v-

Links of one leg have twins in the other; the trunk and any other link are their own twins. With A
the absolute angles of the links, a = A q, and P the exchange of twins, R solves A R = P A. So R is
a permutation for hips that count from a torso, and a combination for a hip that counts from the
other leg. r is not zero for robots with spokes; it comes from the record.

This assumes two legs that are alike, body by body, which `Biped.check` tests; `unlike` names those that are
not. Twins are paired upwards from the feet.
"""

from __future__ import annotations

import numpy as np

from biped_adrc.core.errors import ModelError
from biped_adrc.core.types import Array
from biped_adrc.model.robots.urdf import Inertial, Tree

_EXACT = 1e-9  # largest residual of A R = P A, dimensionless


def twins(tree: Tree, feet: tuple[str, str]) -> dict[str, str]:
    """Each link's twin in the other leg, paired upwards from the feet; links not in the
    result are their own twins.
    """
    paired: dict[str, str] = {}
    chains = ([joint.child for joint in tree.path_to_root(foot)] for foot in feet)
    for one, other in zip(*chains, strict=False):
        if one == other or one in paired or other in paired:
            break
        paired |= {one: other, other: one}
    return paired


def absolute_angles(tree: Tree, joints: tuple[str, ...], links: list[str]) -> Array:
    """Absolute angle of each link as a sum of `joints`: rows (len(links), n), dimensionless.

    An entry is +1 or -1 for a joint on the link's path to the root, the sign relative to the last joint, which
    is the pitch; 0 for other joints.
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

    Entries within 1e-9 of an integer are rounded. Raises ModelError when no linear map exchanges the legs: the
    residual is not zero or R R is not the identity.
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


def pairs(tree: Tree, feet: tuple[str, str]) -> tuple[tuple[str, str], ...]:
    """Pairs (link of the stance leg, its twin in the swing leg), from the feet upwards."""
    result = twins(tree, feet)
    stance = [joint.child for joint in tree.path_to_root(feet[0])]
    return tuple((link, result[link]) for link in stance if link in result)


def unlike(tree: Tree, feet: tuple[str, str]) -> list[tuple[str, str]]:
    """Pairs of twins that differ in mass, COM or inertia, or in their place on their parent."""
    return [(one, other) for one, other in pairs(tree, feet) if not _alike(tree, one, other)]


def _alike(tree: Tree, one: str, other: str) -> bool:
    """Whether two links have the same numbers in the plane, up to round-off."""
    rows = []
    for link in (one, other):
        body = tree.links[link].inertial or Inertial(0.0, (0.0,) * 3, (0.0,) * 6)
        joint = tree.joint_above(link)
        place = (0.0, 0.0) if joint is None else joint.origin[::2]
        rows.append((body.mass, body.inertia[3], *body.com[::2], *place))
    a, b = np.array(rows)
    return bool(np.allclose(a, b, rtol=_EXACT, atol=0.0))


def text_of(values: tuple[float, ...]) -> str:
    """Text of one number, or of several in parentheses, for a message."""
    text = ", ".join(f"{value:.6g}" for value in values)
    return text if len(values) == 1 else f"({text})"
