"""The legs change over at impact: the same configuration in the coordinates of the next single support.

    q+ = R q- + r,   v+ = R v-

Links of one leg have twins in the other; the trunk, and what else turns, is its own. With A the absolute
angles of the links, a = A q, and P the exchange of twins, R solves A R = P A. So R is a permutation for hips
that count from a torso, and a combination for a hip that counts from the other leg. r is not zero for robots
with spokes.
"""

from __future__ import annotations

import numpy as np

from biped_adrc.errors import ModelError
from biped_adrc.model.urdf import Tree
from biped_adrc.types import Array

_EXACT = 1e-9  # largest residual of A R = P A, dimensionless


def twins(tree: Tree, feet: tuple[str, str]) -> dict[str, str]:
    """Each link's twin, paired upwards from the feet; links that are not here are their own."""
    paired: dict[str, str] = {}
    chains = ([joint.child for joint in tree.path_to_root(foot)] for foot in feet)
    for one, other in zip(*chains, strict=False):
        if one == other or one in paired or other in paired:
            break
        paired |= {one: other, other: one}
    return paired


def absolute_angles(tree: Tree, joints: tuple[str, ...], links: list[str]) -> Array:
    """Rows (len(links), n): the absolute angle of each link as a sum of the coordinates `joints`."""
    axis = next(joint.axis for joint in tree.joints if joint.name == joints[-1])
    rows = np.zeros((len(links), len(joints)))
    for row, link in zip(rows, links, strict=True):
        for joint in tree.path_to_root(link):
            if joint.name in joints:
                sign = sum(a * b for a, b in zip(joint.axis, axis, strict=True))
                row[joints.index(joint.name)] = sign
    return rows


def relabelling(tree: Tree, joints: tuple[str, ...], feet: tuple[str, str]) -> Array:
    """R (n, n). Raises ModelError when no linear relabelling exchanges the legs."""
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
