"""A walk sampled for a player that draws it at any time, by cubic Hermite interpolation between nodes.

Nodes are the frames, both ends of every single support, the edges of pushes, and on soft ground the times at
which the other foot touches or leaves it, or a foot begins or ends to slip; where that is not
enough for the joints to be within `TOLERANCE` of the trajectory between two nodes, the interval is
halved. `view` packs the nodes into the page.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.core.types import Array
from biped_adrc.hybrid.trajectory import Arc
from biped_adrc.view.placement import (
    WalkScene,
    check_frames,
    contact_changes,
    joint_values,
    loads,
)

TOLERANCE = 1e-6
"""Largest error [rad] of an interpolated joint angle."""
HALVINGS = 6
"""How often an interval between two frames is halved at most."""
EPSILON = 1e-6
"""Half the interval [s] of the central difference that gives the rates of the joints, the base among them."""


class Pose(NamedTuple):
    """Everything that is drawn of a walk at one time."""

    joints: Array
    """(J,) values of the moving joints, in the order of the URDF [rad], [m]."""
    rates: Array
    """(J,) rates of these joints [rad/s], [m/s]."""
    loads: Array
    """(2 + n,): F_T, F_N [N], and the external torque on the drawn joints of q1..qn [N m]."""
    points: Array
    """(4,): x and z of the hip and of the swing foot in the world [m]."""
    contact: Array
    """(5,): x and z of the stance foot [m], F_T and F_N on the other foot [N], and 1 where a foot slips."""


@dataclass(frozen=True)
class Frames:
    """A walk sampled at its nodes, one in each row (K,); a node at an impact is there
    twice, before and after it.
    """

    t: Array
    """Times (K,) [s]."""
    arc: Array
    """(K,) index of the single support, from 0."""
    poses: Pose
    """The poses at the nodes, as arrays with K rows: (K, J), (K, J), (K, 2 + n), (K, 4), (K, 5)."""

    @classmethod
    def of(cls, scene: WalkScene, fps: float) -> Frames:
        """Sample a walk at `fps` [1/s] or finer, and at all its nodes. Raises InputError for too many
        frames.
        """
        check_frames((scene.trajectory.t_end - scene.trajectory.t_start) * fps)
        t, arcs, poses = [], [], []
        for i, arc in enumerate(scene.trajectory.arcs):
            nodes = _nodes(scene, arc, fps)
            t.append(nodes)
            arcs.append(np.full(len(nodes), i))
            poses += [pose(scene, i, float(node)) for node in nodes]
        columns = map(np.array, zip(*poses, strict=True))
        return cls(np.concatenate(t), np.concatenate(arcs), Pose(*columns))


def pose(scene: WalkScene, i: int, t: float) -> Pose:
    """Pose of the robot in arc i at t [s].

    At the end of the arc it is the state before the impact: the arc after it has a
    pose of its own for that time.
    """
    arc, biped, foothold = scene.trajectory.arcs[i], scene.biped, scene.foot(i, t)
    n, step = biped.n, arc.mode.step
    x = arc(t, "left" if t == arc.t[-1] else "right")
    q, v = x[:n], x[n : 2 * n]
    moving = [joint.name for joint in biped.tree.joints if joint.type != "fixed"]
    at, later, earlier = (
        joint_values(biped, q + s * EPSILON * v, step, *foothold) for s in (0.0, 1.0, -1.0)
    )
    rates = [(later[name] - earlier[name]) / (2.0 * EPSILON) for name in moving]
    acting = loads(scene, min(t, math.nextafter(float(arc.t[-1]), -math.inf)))
    return Pose(
        np.array([at[name] for name in moving]),
        np.array(rates),
        np.concatenate((acting.ground_reaction, acting.zeta)),
        scene.points(i, t, q),
        np.array([*foothold, *acting.other, acting.slips]),
    )


def _nodes(scene: WalkScene, arc: Arc, fps: float) -> Array:
    """Times (K,) [s] at which one single support is sampled; see the module."""
    start, end = float(arc.t[0]), float(arc.t[-1])
    first = scene.trajectory.t_start
    frames = first + np.arange(math.ceil((start - first) * fps), (end - first) * fps) / fps
    edges = scene.walker.switching_times(arc.mode)
    inside = [t for t in (*frames, *edges, *contact_changes(scene, arc)) if start < t < end]
    nodes = np.unique([start, *inside, end])
    for _ in range(HALVINGS):
        q, v = _states(arc, nodes, scene.biped.n)
        h, middles = np.diff(nodes)[:, np.newaxis], 0.5 * (nodes[:-1] + nodes[1:])
        guess = 0.5 * (q[:-1] + q[1:]) + h * (v[:-1] - v[1:]) / 8.0  # the cubic in the middle
        result, _ = _states(arc, middles, scene.biped.n)
        rough = np.max(np.abs(guess - result), axis=1, initial=0.0) > TOLERANCE
        if not rough.any():
            break
        nodes = np.sort(np.append(nodes, middles[rough]))
    return nodes


def _states(arc: Arc, times: Array, n: int) -> tuple[Array, Array]:
    """q and v, both (K, n) [rad], [rad/s], of the arc at `times` (K,) [s]."""
    last = float(arc.t[-1])
    x = np.array([arc(float(t), "left" if t == last else "right") for t in times])
    x = x.reshape(len(times), arc.x.shape[1])
    return x[:, :n], x[:, n : 2 * n]
