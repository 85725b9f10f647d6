"""Where the links of the robot are in the world, on which ground, under which loads.

All drawings of a walk, from the side or in Meshcat, start here: `WalkScene.of` lays a trajectory
out along the ground, `WalkScene.joints` gives the joint values of the URDF at any time,
`link_placements` the links, `loads_at` the forces. Kinematics are those of the URDF's tree alone;
Pinocchio is not needed to draw.

The model's stance foot is always at the origin, and at impact R (n, n) exchanges the legs in the coordinates
q (n,) [rad], so that the model walks without left and right. A drawing has both: in odd single supports the
stance leg is the one that the robot's record calls so (RABBIT: left), in even ones the other. The joints drawn
are q in odd steps and R q in even ones, so no drawn angle jumps at impact. A rimless wheel has spokes in place
of legs: it is drawn at q in every step, on the next of its equal spokes.

The ground is a slope with steps down and up,

    z(x) = -tan(slope) x - sum of the drops of the steps behind x, negative for a step up

The vertical face of a step of the ground ("edge" here) is drawn half way between the footholds on either side
of it; the walk does not depend on where it is. An arc of a trajectory is one single support; a foothold is
where its stance foot stands, a node a stored instant. A placement is a homogeneous transform (4, 4).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Annotated, NamedTuple, Protocol, Self

import numpy as np

from biped_adrc.analysis import soft_steps as meters
from biped_adrc.analysis.signals import FORCE, PLACE, Signals, footholds
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.checks import Checked, PositiveFloat, one_of
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array, Flags
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import ground_axes
from biped_adrc.model.robots.urdf import Joint, Tree, twins

MOST_FRAMES = 200_000
"""Largest number of frames of a page or a moving picture: an hour at 50 in a second."""
TILE = 0.5
"""Length [m], along x, of the light and dark tiles of the ground."""
GHOST = 0.35
"""Opacity of a ghost, a walk that another one is laid over (1 is solid)."""
VIEWS = ("side", "perspective")
"""Cameras: "side" is orthographic, so lengths can be compared anywhere in the picture."""


class Surface(NamedTuple):
    """The ground of a walk: a slope with steps down and up.

    slope [rad]: positive downhill. edges (E,) [m]: x of the steps of the ground, in increasing order. drops
    (E,) [m]: by how much the ground is lower behind each of them, negative for a step up.
    """

    slope: float
    edges: Array
    drops: Array

    def height(self, x: float, before: bool = False) -> float:
        """z [m] of the ground at x [m]; exactly at an edge the level behind it, or the level before it
        if `before`.
        """
        behind = self.edges < x if before else self.edges <= x
        return -math.tan(self.slope) * x - float(np.sum(self.drops[behind]))

    def line(self, low: float, high: float) -> Array:
        """Corners (K, 2), x and z [m], of the ground from x = low to high [m]; each edge gives two."""
        # height(x, True): the level before an edge at x, else the one behind it
        inside = self.edges[(low < self.edges) & (self.edges < high)]
        corners = [(x, self.height(x, before)) for x in inside for before in (True, False)]
        return np.array([(low, self.height(low)), *corners, (high, self.height(high, True))])

    def tiles(self, low: int, high: int) -> list[tuple[Array, bool]]:
        """Tiles of the ground, each TILE long, from x = low TILE to high TILE; at an edge a tile is cut in two.

        Returns of each tile x and z of both ends (2, 2) [m], and whether it is a light one: tiles are light and
        dark in turn, counted from x = 0, to show how far a walk has come.
        """
        inside = self.edges[(low * TILE < self.edges) & (self.edges < high * TILE)]
        cuts = np.unique([*(k * TILE for k in range(low, high + 1)), *inside])
        # True: the level before an edge at b, with which this tile ends
        tops = [((a, self.height(a)), (b, self.height(b, True))) for a, b in pairwise(cuts)]
        return [(np.array(top), math.floor(top[0][0] / TILE) % 2 == 0) for top in tops]


def turn(axis: tuple[float, float, float], angle: float) -> Array:
    """Rotation matrix (3, 3) by `angle` [rad] about the unit vector `axis`: Rodrigues' formula."""
    x, y, z = axis
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + math.sin(angle) * K + (1.0 - math.cos(angle)) * (K @ K)


def placed(origin: Sequence[float] | Array = (0.0, 0.0, 0.0), R: Array | None = None) -> Array:
    """Placement (4, 4) at `origin` (3,) [m] with the rotation R (3, 3), the identity if None."""
    M = np.eye(4)
    M[:3, 3] = origin
    M[:3, :3] = np.eye(3) if R is None else R
    return M


def joint_transform(joint: Joint, value: float) -> Array:
    """Placement (4, 4) of a joint's child link in its parent at this value of the joint, [rad] or [m]; a fixed
    joint ignores it.
    """
    if joint.type == "revolute":
        return placed(joint.origin, turn(joint.axis, value))
    moved = value if joint.type == "prismatic" else 0.0
    return placed(joint.origin + moved * np.array(joint.axis))


def link_placements(tree: Tree, values: dict[str, float]) -> dict[str, Array]:
    """World placement (4, 4) of every link, by name; joints that `values` does not name stand at 0.

    values: joint name -> [rad] or [m], as `joint_values` returns them, with those of the base.
    """
    return {name: link_placement(tree, values, name) for name in tree.links}


def link_placement(tree: Tree, values: dict[str, float], link: str) -> Array:
    """World placement (4, 4) of one link; values: joint name -> [rad] or [m], 0 for joints that it does not
    name.
    """
    M = np.eye(4)  # from the link up to the root
    for joint in tree.path_to_root(link):
        M = joint_transform(joint, values.get(joint.name, 0.0)) @ M
    return M


def is_wheel(biped: Biped) -> bool:
    """Whether the robot is a rimless wheel: the relabelling R at impact is the identity."""
    return np.array_equal(biped.R, np.eye(biped.n))


def spokes(biped: Biped) -> list[Array]:
    """Rotations (3, 3) that take the spoke in the URDF to each spoke of the wheel; the
    identity alone for legs.

    The URDF of a wheel draws one spoke; the angle between two is the change of q in the relabelling at impact.
    """
    if not is_wheel(biped):
        return [np.eye(3)]
    pitch = next(j for j in biped.tree.joints if j.name == biped.description.unactuated)
    between = float(biped.relabel(np.zeros(biped.n))[-1])
    count = round(2.0 * math.pi / abs(between))
    return [turn(pitch.axis, k * between) for k in range(count)]


def exchanged(biped: Biped, step: int) -> bool:
    """Whether in single support `step` (from 1) the drawn robot stands on the other leg than in the first one:
    in even ones, but never for a wheel.
    """
    return step % 2 == 0 and not is_wheel(biped)


def legs(biped: Biped) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Names of the links of the leg that carries odd single supports, and of the other, each from the foot up.

    Empty for a wheel, whose links have no sides.
    """
    if is_wheel(biped):
        return (), ()
    # the links of both legs, in turn of the leg of `stance_foot` and of the other one
    pairs = tuple(twins(biped.tree, biped.description.feet))
    return pairs[::2], pairs[1::2]


def joint_values(
    biped: Biped, q: Array, step: int = 1, foothold: float = 0.0, height: float = 0.0
) -> dict[str, float]:
    """Values of all joints of the URDF, the base's among them, by name [rad], [m]; for q (n,) [rad] in single
    support `step` (from 1).

    The two prismatic joints of the base, along x and z, are chosen so that the stance foot stands at
    x = foothold, z = height [m].
    """
    d = biped.description
    other = exchanged(biped, step)
    drawn = biped.relabel(q) if other else q
    values = dict(zip(d.joints, map(float, drawn), strict=True))
    # where the foot is while the base, not yet in `values`, is at 0
    M = link_placement(biped.tree, values, d.swing_foot if other else d.stance_foot)
    values[d.base[0]] = foothold - float(M[0, 3])
    values[d.base[1]] = height - float(M[2, 3])
    return values


@dataclass(frozen=True)
class Clip(Checked):
    """The part of the walks that is shown, and how; None leaves the choice to the kind of picture.

    start, stop [s]: of the part shown; None: the whole walk, or its last two steps for a strip. fps [1/s]:
    frames per second; None: 60 for a page and 25 for a moving picture. view: camera of a page at the start,
    one of `VIEWS`. apart: walks of a moving picture side by side and not over one another. slower [1]: how many
    times slower than the walk a moving picture plays. Raises InputError for values that do not fit.
    """

    start: float | None = None
    stop: float | None = None
    fps: PositiveFloat | None = None
    view: Annotated[str, one_of(VIEWS)] = "side"
    apart: bool = False
    slower: PositiveFloat = 1.0

    def part(self, begin: float, end: float, usual: float) -> tuple[float, float]:
        """Start and stop [s] of the part shown of walks that last from `begin` to `end` [s].

        usual [s]: the start of a clip without one; its stop is `end`. Raises InputError for times outside the
        walks.
        """
        start = usual if self.start is None else self.start
        stop = end if self.stop is None else self.stop
        if not begin <= start < stop <= end:
            raise InputError(
                f"the part from {start:g} to {stop:g} s was asked for, expected a part of the walk, which "
                f"lasts from {begin:g} to {end:g} s"
            )
        return start, stop


class Drawable(Protocol):
    """The walk that a drawing needs; `scenario.recording.Walk` is one."""

    @property
    def walker(self) -> Walker: ...
    @property
    def trajectory(self) -> Trajectory: ...
    @property
    def signals(self) -> Signals: ...


@dataclass(frozen=True)
class WalkScene:
    """A walk laid out in the world: every single support with the place of its stance foot.

    footholds, heights (arcs,): x and z of the stance foot [m] in each arc.
    """

    walker: Walker
    trajectory: Trajectory
    footholds: Array
    heights: Array
    walk: Drawable | None = None
    """The walk, whose signals have the loads; None for a robot that stands, which has none."""

    @classmethod
    def of(cls, walk: Drawable) -> Self:
        """Lay a walk out along the ground, its first foothold at x = z = 0."""
        x, z = footholds(walk.walker, walk.trajectory).T
        return cls(walk.walker, walk.trajectory, x, z, walk)

    @property
    def biped(self) -> Biped:
        """The robot that is drawn: the plant, not the controller's nominal model."""
        return self.walker.plant

    def foothold(self, i: int) -> tuple[float, float]:
        """x and z [m] of the stance foot at the start of arc i, counted from 0."""
        return float(self.footholds[i]), float(self.heights[i])

    def foot(self, i: int, t: float) -> tuple[float, float]:
        """x and z [m] of the stance foot in arc i at t [s]: its foothold; on soft ground, where it may slip,
        its recorded place.
        """
        # `read` has what a simulator of soft ground recorded at the nodes, by name; PLACE: places of the feet
        arc = self.trajectory.arcs[i]
        if PLACE not in arc.read:
            return self.foothold(i)
        x, z = (float(np.interp(t, arc.t, arc.read[PLACE][:, k])) for k in (0, 1))
        return x, z

    @cached_property
    def surface(self) -> Surface:
        """The ground under the footholds: the walker's slope, and the steps of the ground between them."""
        # behind the last foothold no step of the ground is known
        arcs = self.trajectory.arcs[: len(self.footholds) - 1]
        drops = np.array([self.walker.drop(arc.mode.step) for arc in arcs])
        middles = 0.5 * (self.footholds[:-1] + self.footholds[1:])
        return Surface(self.walker.ground_slope, middles[drops != 0.0], drops[drops != 0.0])

    def level(self, x: float) -> float:
        """z [m] of the ground at x [m], with its steps smoothed: between footholds the line through them, so
        that a camera does not jump at a step; before and behind them the slope goes on.
        """
        fall = math.tan(self.walker.ground_slope)
        return float(np.interp(x, self.footholds, self.heights + fall * self.footholds)) - fall * x

    def arc_at(self, t: float) -> int:
        """Index, from 0, of the arc (single support) that is shown at t [s]; at an impact, of that after it."""
        ends = [arc.t[-1] for arc in self.trajectory.arcs]
        return min(int(np.searchsorted(ends, t, side="right")), len(ends) - 1)

    def posture(self, t: float) -> tuple[int, Array]:
        """Index of the arc shown at t [s], and q (n,) [rad]; before and after the run, those at its ends."""
        t = min(max(t, self.trajectory.t_start), self.trajectory.t_end)
        i = self.arc_at(t)
        return i, self.trajectory.arcs[i](t)[: self.biped.n]

    def joints(self, t: float) -> dict[str, float]:
        """Values of all joints of the URDF at t [s], the base's among them: name -> [rad] or [m]."""
        i, q = self.posture(t)
        return joint_values(self.biped, q, self.trajectory.arcs[i].mode.step, *self.foot(i, t))

    def points(self, i: int, t: float, q: Array) -> Array:
        """x and z [m] of the hip and of the swing foot in the world (4,), at q (n,) [rad] in arc i at t [s]."""
        # both are relative to the stance foot
        ends = np.concatenate((self.biped.hip(q), self.biped.swing_foot(q)))
        return ends + np.tile(self.foot(i, t), 2)


class DrawnLoads(NamedTuple):
    """Forces on the drawn robot at one stored node, an instant at which the walk's state is stored."""

    ground_reaction: Array
    """Force (2,) of the ground on the stance foot [N], along x and z of the world, also on a slope."""
    zeta: Array
    """External torque (n,) on the drawn joints of q1..qn [N m]."""
    other: Array = np.zeros(2)
    """Force (2,) of the ground on the other foot [N], along x and z, where both touch soft ground; else 0."""
    slips: bool = False
    """Whether a foot slides with its force at the friction cone."""


def loads_at(scene: WalkScene, t: float) -> DrawnLoads:
    """Forces and torques on the robot at the last stored node up to t [s]; before and after the run, at its
    ends.

    They are not interpolated between nodes: under a fast observer they change faster than nodes follow.
    """
    assert scene.walk is not None
    arcs, at, s = scene.trajectory.arcs, scene.arc_at(t), scene.walk.signals
    arc, other, slips = arcs[at], np.zeros(2), False
    k = min(max(int(np.searchsorted(arc.t, t, side="right")) - 1, 0), len(arc.t) - 1)
    if FORCE in arc.read:  # on soft ground: forces on stance foot and other foot (K, 4)
        other, slips = arc.read[FORCE][k, 2:], bool(foot_slips(scene, arc)[k])
    row = k + sum(len(before.t) for before in arcs[:at])  # signals have the nodes of all arcs
    force, zeta = s.ground_reaction[row], s.zeta[row]
    # with q drawn as R q, the power zeta . q' is that of R^-T zeta, and R is its own inverse
    drawn = scene.biped.R.T @ zeta if exchanged(scene.biped, arc.mode.step) else zeta
    return DrawnLoads(force, drawn, other, slips)


def foot_slips(scene: WalkScene, arc: Arc) -> Flags:
    """Whether one of the feet slips, at each of the K nodes of an arc on soft ground (K,): its force is at the
    friction cone and it moves, as `analysis.soft_steps` counts it.
    """
    mu = scene.trajectory.settings["plant"]["ground"]["friction"]
    F, _, v = meters.feet_of(arc)  # forces, places, velocities of both feet
    return np.any(meters.slipping(F, v, mu, ground_axes(scene.walker.ground_slope)), axis=1)


def contact_changes(scene: WalkScene, arc: Arc) -> Array:
    """Times (K,) [s] of the first nodes after the other foot touches or leaves soft ground, or a foot begins or
    ends to slip; none on the rigid plant.
    """
    if FORCE not in arc.read:
        return np.zeros(0)
    # [:, 2:]: the force on the other foot, 0 where it does not touch
    contact = np.column_stack((foot_slips(scene, arc), np.any(arc.read[FORCE][:, 2:], axis=1)))
    return arc.t[1:][np.any(contact[1:] != contact[:-1], axis=1)]


def check_frames(count: float) -> None:
    """Raise InputError for a number of frames above MOST_FRAMES."""
    if not count <= MOST_FRAMES:  # also for NaN
        raise InputError(
            f"this would be {count:.6g} frames, expected at most {MOST_FRAMES}; show a part of the "
            "walk, or fewer frames per second"
        )


def ending(trajectory: Trajectory) -> str:
    """Text such as "fell at 3.42 s: hip too low" for a walk that did not reach its end; else empty.

    The reason is the terminal event of the run, the detail of its status, or the status itself, in this order.
    """
    status = trajectory.status
    if status.ok:
        return ""
    event = trajectory.arcs[-1].event
    reason = trajectory.detail or status.value.split(";")[0]  # without the advice behind it
    if event is not None and event.x_plus is None:  # no state follows: a terminal event
        reason = event.guard.replace("_", " ")
    return f"{status.name.lower().replace('_', ' ')} at {trajectory.t_end:.2f} s: {reason}"
