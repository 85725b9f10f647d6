"""Where the links of the drawn robot are: the tree of the URDF at (q, step, foothold).

In odd single supports the stance leg is the one the robot record calls so (RABBIT: left), in even ones the
other. The joints drawn are q in odd steps and q[R] in even ones, so no drawn angle jumps at impact.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.model.urdf import Joint, Tree
from biped_adrc.types import Array


def turn(axis: tuple[float, float, float], angle: float) -> Array:
    """Rotation (3, 3) by `angle` [rad] about the unit vector `axis`: Rodrigues' formula."""
    x, y, z = axis
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + math.sin(angle) * K + (1.0 - math.cos(angle)) * (K @ K)


def joint_transform(joint: Joint, value: float) -> Array:
    """Placement (4, 4) of the child link in its parent; value [rad] or [m], ignored when fixed."""
    M = np.eye(4)
    M[:3, 3] = joint.origin
    if joint.type == "revolute":
        M[:3, :3] = turn(joint.axis, value)
    elif joint.type == "prismatic":
        M[:3, 3] += value * np.array(joint.axis)
    return M


def link_placements(tree: Tree, values: dict[str, float]) -> dict[str, Array]:
    """World placement (4, 4) of every link; joints that `values` does not name stand at 0."""
    placements: dict[str, Array] = {}
    for name in tree.links:
        M = np.eye(4)
        for joint in tree.path_to_root(name):
            M = joint_transform(joint, values.get(joint.name, 0.0)) @ M
        placements[name] = M
    return placements


def joint_values(biped: Biped, q: Array, step: int = 1, foothold: float = 0.0) -> dict[str, float]:
    """Joint values of the floating URDF [rad], [m] for q (n,) in single support `step` (from 1).

    The stance foot stands at x = foothold [m], z = 0.
    """
    d = biped.description
    odd = step % 2 == 1
    drawn = q if odd else q[biped.relabelling]
    values = dict(zip(d.joints, map(float, drawn), strict=True))
    foot = d.stance_foot if odd else d.swing_foot
    M = np.eye(4)
    for joint in biped.tree.path_to_root(foot):
        M = joint_transform(joint, values.get(joint.name, 0.0)) @ M
    values[d.base[0]] = foothold - float(M[0, 3])
    values[d.base[1]] = -float(M[2, 3])
    return values


@dataclass(frozen=True)
class Walk:
    """A trajectory laid out in the world; `footholds` (arcs,) is x of the stance foot [m]."""

    biped: Biped
    trajectory: Trajectory
    footholds: Array

    @classmethod
    def of(cls, biped: Biped, trajectory: Trajectory) -> Walk:
        """The first stance foot stands at x = 0; each impact moves it by p_2 of x-."""
        x, footholds = 0.0, []
        for arc in trajectory.arcs:
            footholds.append(x)
            if arc.event is not None and arc.event.x_plus is not None:
                x += float(biped.swing_foot(arc.event.x_minus[: biped.n])[0])
        return cls(biped, trajectory, np.array(footholds))

    def joints(self, t: float) -> dict[str, float]:
        """Joint values of the URDF at t [s]; before and after the run, those of its ends."""
        arcs = self.trajectory.arcs
        t = min(max(t, self.trajectory.t_start), self.trajectory.t_end)
        i = int(np.searchsorted([arc.t[-1] for arc in arcs], t, side="right"))
        i = min(i, len(arcs) - 1)
        q = arcs[i](t)[: self.biped.n]
        return joint_values(self.biped, q, arcs[i].mode.step, float(self.footholds[i]))
