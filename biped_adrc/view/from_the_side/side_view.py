"""The robot from the side: its links as lines in the x-z plane, from the primitives of the URDF.

`bones` finds a line for each link in the frame of that link; `SideView` moves these lines with a
walk. Strips, moving pictures and the scale of the page in Meshcat are made from it. A line belongs to the
"stance" leg, to the "swing" leg, or "" to the trunk; a placement is a homogeneous transform (4, 4). A wheel is
a rimless one, with spokes in place of legs, of which its URDF draws one.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from biped_adrc.core.types import Array
from biped_adrc.model.biped import Biped
from biped_adrc.model.robots.urdf import Link, Tree, Visual
from biped_adrc.view.placement import WalkScene, exchanged, legs, link_placements, spokes


@dataclass(frozen=True)
class Bone:
    """A line that stands for a link, in the frame of the link.

    link: its name. leg: "stance" for links of the leg that carries odd steps, "swing" for
    the other, "" for the trunk.
    """

    link: str
    ends: Array
    """Both ends (2, 3) [m] in the frame of the link."""
    leg: str


def bones(biped: Biped) -> list[Bone]:
    """Find the lines of a robot, by links in the order of its URDF; a wheel has them once for each spoke."""
    # legs: links of the leg that carries odd single supports, and of the other
    leg = dict.fromkeys(legs(biped)[0], "stance") | dict.fromkeys(legs(biped)[1], "swing")
    result = [
        Bone(name, ends, leg.get(name, ""))
        for name, link in biped.tree.links.items()
        for ends in _lines(biped.tree, link)
    ]
    # spokes: rotations from the drawn spoke to each; the identity alone for legs
    return [replace(bone, ends=bone.ends @ R.T) for R in spokes(biped) for bone in result]


def _lines(tree: Tree, link: Link) -> list[Array]:
    """Ends (2, 3) [m] of the lines of a link, in its frame: axes of cylinders and longest sides of boxes.

    Without such a primitive they go from its origin to the joints below it, or, where there is none (a torso),
    to its COM. A line along y, not seen from the side, is left out.
    """
    axes = [ends for visual in link.visuals if (ends := _axis(visual)) is not None]
    # [::2]: x and z
    seen = [j.origin for j in tree.joints_below(link.name) if any(j.origin[::2])]
    if not seen and link.inertial is not None and any(link.inertial.com[::2]):
        seen = [link.inertial.com]
    return axes or [np.array([(0.0, 0.0, 0.0), end]) for end in seen]


def placed_lines(lines: list[Bone], placements: dict[str, Array]) -> list[Array]:
    """x and z [m] of both ends (2, 2) of every line in the world; placements: world placement (4, 4) of each
    link, by name.
    """
    result = ((bone, placements[bone.link]) for bone in lines)
    return [(bone.ends @ M[:3, :3].T + M[:3, 3])[:, [0, 2]] for bone, M in result]


def roles_of(lines: list[Bone], biped: Biped, step: int) -> list[str]:
    """ "stance", "swing" or "" (trunk) of every line in single support `step` (from 1): at every impact stance
    and swing leg are exchanged.
    """
    if not exchanged(biped, step):
        return [bone.leg for bone in lines]
    other = {"stance": "swing", "swing": "stance", "": ""}
    return [other[bone.leg] for bone in lines]


def _axis(visual: Visual) -> Array | None:
    """Ends (2, 3) [m] of the line that a primitive stands for, in the frame of its link; None for a ball."""
    if visual.shape == "sphere":
        return None
    # a cylinder has the size (radius, length) and lies along z; a box has three edges
    edges = np.array((0.0, 0.0, visual.size[1]) if visual.shape == "cylinder" else visual.size)
    # along: half of the longest edge, on its axis
    along = np.where(np.arange(3) == np.argmax(edges), 0.5 * edges, 0.0)
    return np.array(visual.origin) + np.array([-along, along])


@dataclass(frozen=True)
class SideView:
    """The lines of a walk in the x-z plane of the world, at any time."""

    scene: WalkScene

    @cached_property
    def bones(self) -> list[Bone]:
        """The robot's lines in the frames of their links; rows of `segments` and `roles` are in their order."""
        return bones(self.scene.biped)

    def placements(self, t: float) -> dict[str, Array]:
        """World placement (4, 4) of every link, by name, at t [s]."""
        return link_placements(self.scene.biped.tree, self.scene.joints(t))

    def segments(self, t: float) -> Array:
        """(bones, 2, 2), x and z [m] of both ends of every line at t [s], in the order of `bones`."""
        return np.array(placed_lines(self.bones, self.placements(t)))

    def step(self, t: float) -> int:
        """Number of the single support at t [s], counted from 1."""
        return self.scene.trajectory.arcs[self.scene.arc_at(t)].mode.step

    def roles(self, t: float) -> list[str]:
        """ "stance", "swing" or "" (trunk) of each line at t [s], in the order of `bones`."""
        return roles_of(self.bones, self.scene.biped, self.step(t))

    def points(self, t: float) -> Array:
        """x and z [m] of the hip and of the swing foot at t [s], (4,)."""
        # i: number of the single support, from 0; q (n,): the robot's coordinates
        i, q = self.scene.posture(t)
        return self.scene.points(i, t, q)

    @cached_property
    def _about_foot(self) -> Array:
        """x and z [m] of the ends of all lines, relative to the stance foot, at 50 equally spaced times of the
        walk (K, 2), K = 100 times the number of lines.
        """
        scene = self.scene
        times = np.linspace(scene.trajectory.t_start, scene.trajectory.t_end, 50).tolist()
        feet = [scene.foothold(scene.arc_at(t)) for t in times]
        shown = zip(times, feet, strict=True)
        return np.concatenate([self.segments(t).reshape(-1, 2) - foot for t, foot in shown])

    @cached_property
    def height(self) -> float:
        """Highest point of the robot above its stance foot on this walk [m], for the limits of a picture."""
        return float(self._about_foot[:, 1].max())

    @cached_property
    def width(self) -> float:
        """Largest horizontal distance of the robot from its stance foot on this walk, to either side [m]."""
        return float(np.abs(self._about_foot[:, 0]).max())
