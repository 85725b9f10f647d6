"""Where the links of the drawn robot are: the tree of the URDF at (q, step, foothold).

In odd single supports the stance leg is the one the robot record calls so (RABBIT: left), in even ones the
other. The joints drawn are q in odd steps and q[R] in even ones, so no drawn angle jumps at impact.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.model.urdf import Joint, Tree
from biped_adrc.types import Array
from biped_adrc.walker import Walker


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
    drawn = q if odd else biped.relabel(q)
    values = dict(zip(d.joints, map(float, drawn), strict=True))
    foot = d.stance_foot if odd else d.swing_foot
    M = np.eye(4)
    for joint in biped.tree.path_to_root(foot):
        M = joint_transform(joint, values.get(joint.name, 0.0)) @ M
    values[d.base[0]] = foothold - float(M[0, 3])
    values[d.base[1]] = -float(M[2, 3])
    return values


class Recorded(Protocol):
    """A walker and what it did."""

    @property
    def walker(self) -> Walker: ...
    @property
    def trajectory(self) -> Trajectory: ...


@dataclass(frozen=True)
class Scene:
    """A walk laid out in the world; `footholds` (arcs,) is x of the stance foot [m]."""

    walker: Walker
    trajectory: Trajectory
    footholds: Array

    @classmethod
    def of(cls, walk: Recorded) -> Scene:
        """The first stance foot stands at x = 0; each impact moves it by p_2 of x-.

        Raises InputError for a walk on a slope or over steps, which cannot be drawn yet.
        """
        if walk.walker.steps_down:
            raise InputError("walks over steps down cannot be drawn yet")
        if walk.walker.slope != 0.0:
            raise InputError(
                f"walks on a slope cannot be drawn yet, this one is on {walk.walker.slope:.4g} rad"
            )
        x, footholds, plant = 0.0, [], walk.walker.plant
        for arc in walk.trajectory.arcs:
            footholds.append(x)
            if arc.event is not None and arc.event.x_plus is not None:
                x += float(plant.swing_foot(arc.event.x_minus[: plant.n])[0])
        return cls(walk.walker, walk.trajectory, np.array(footholds))

    @property
    def biped(self) -> Biped:
        """The robot drawn: the plant."""
        return self.walker.plant

    def arc_at(self, t: float) -> int:
        """Index of the arc that is shown at t [s]; at an impact, the one after it."""
        ends = [arc.t[-1] for arc in self.trajectory.arcs]
        return min(int(np.searchsorted(ends, t, side="right")), len(ends) - 1)

    def joints(self, t: float) -> dict[str, float]:
        """Joint values of the URDF at t [s]; before and after the run, those of its ends."""
        t = min(max(t, self.trajectory.t_start), self.trajectory.t_end)
        i = self.arc_at(t)
        arc = self.trajectory.arcs[i]
        q = arc(t)[: self.biped.n]
        return joint_values(self.biped, q, arc.mode.step, float(self.footholds[i]))
