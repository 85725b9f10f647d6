"""Nodes of a walk, and what they demand of the ground: the force in the mean, the impulse of an impact.

The mean force is that of `analysis.demands`; the impulse is the change of the robot's momentum.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.timing import SAME_INSTANT
from biped_adrc.core.types import Array, Indices
from biped_adrc.engine.kernels.load import compiled
from biped_adrc.model.ground import ground_axes
from biped_adrc.model.robots.limits import ENDS


@dataclass(frozen=True)
class Nodes:
    """The signals of a walk that feasibility depends on, at its K nodes; forces and points are (x, z)."""

    rows: Array
    """(K, 8 + 4 p), as `engine.batch.BatchWalk.table`: t, step, resultant external force (2,) [N], and what
    `StepReading` has, last m v_com (2,) [N s] and place of the swing foot (2,) [m]."""

    @classmethod
    def of(cls, s: Signals) -> Nodes:
        """Take the nodes from the signals of a walk."""
        joints = [x[:, : s.u.shape[1]] for x in (s.q, s.v)]
        parts = (s.t, s.step, s.outside, joints[0] - s.q_d, s.u, *joints, s.momentum, s.swing_foot)
        return cls(np.ascontiguousarray(np.column_stack(parts)))

    @property
    def t(self) -> Array:
        """(K,) [s]; a repeated time is a jump."""
        return self.rows[:, 0]

    @property
    def p(self) -> int:
        """Number of joints."""
        return (self.rows.shape[1] - 8) // 4

    @property
    def steps(self) -> range:
        """Numbers of the S single supports."""
        return range(int(self.rows[0, 1]), int(self.rows[-1, 1]) + 1)

    @cached_property
    def edges(self) -> Indices:
        """First node of each single support, and K: (S + 1,)."""
        return np.searchsorted(self.rows[:, 1], [*self.steps, self.steps.stop])

    @property
    def last(self) -> Indices:
        """Last node of each single support (S,)."""
        return self.edges[1:] - 1


LOOPS = (
    *(f"biped_adrc.engine.kernels.{name}" for name in ("record", "call")),
    "biped_adrc.analysis.demands",
)


def loops() -> Any:
    """The compiled loops over nodes."""
    return compiled(LOOPS, demands=7, totals=4)


def demands(walker: Walker, n: Nodes, window: float, impacts: int) -> Array:
    """F_N [N] and |F_T| / F_N in the mean over the window [s] that ends at each node, depth of the
    swing foot below the ground [m], largest |u_i| [N m], largest |q_i'| as a share of its limit [1], largest
    angle beyond a range [rad]; and which joint has that torque, share and angle, from 0: (9, K).

    F_N is inf and the ratio -inf where no window ends, the ratio also where the ground does not push. A
    single support shorter than the window is averaged as a whole. The ground is taken at the height of the
    lower of the two footholds. Depth counts once the foot has been above it, since it may come from lower
    ground, and not near the ends of a single support, but at the end of one behind the first `impacts`.
    """
    slope, plant = walker.ground_slope, walker.plant
    falls = [max(walker.drop(step), 0.0) for step in n.steps]
    known = [window, plant.weight, math.tan(slope), ENDS, *np.ravel(ground_axes(slope))]
    joints = np.ravel([[(j.speed, *j.range) for j in side] for side in plant.motor_joints])
    result, numbers = np.empty((11, len(n.rows))), np.array([*known, SAME_INSTANT, *falls, *joints])
    rows, first, numbers_at, out = (x.ctypes.data for x in (n.rows, n.edges, numbers, result))
    loops().demands(rows, n.p, first, len(falls), impacts, numbers_at, out)
    return result[:9]


def totals(n: Nodes) -> list[float]:
    """Largest |e_i| [rad]; root mean squares of e [rad] and u [N m] over nodes and joints, a jump weighing
    nothing; int |u_i| |dq_i| and int u_i dq_i [J], summed over motors.
    """
    out = np.zeros(6)
    loops().totals(n.rows.ctypes.data, n.p, len(n.rows), out.ctypes.data)
    out[2:4] = np.sqrt(out[2:4] / max(out[1] * n.p, 1.0))
    return [out[0], *out[2:]]


def impulse_ratios(walker: Walker, n: Nodes, impacts: int, after: Array | None) -> Array:
    """|F_T| / F_N of the impulse of the impact that ends each of the S single supports (S,).

    Infinite where the ground would have had to pull, 0 for those behind the first `impacts`, which end in
    none. after (2,) [N s]: momentum after the last impact, where the walk ends with it.
    """
    result, P = np.zeros(len(n.steps)), n.rows[:, -4:-2]
    plus = P[n.edges[1:-1]]
    if after is not None:
        plus = np.vstack((plus, after))
    impulse = plus[:impacts] - P[n.last[:impacts]]
    result[:impacts] = ratios(impulse @ np.array(ground_axes(walker.ground_slope)).T, np.inf)
    return result


def ratios(F: Array, without: float) -> Array:
    """|F_T| / F_N of the rows of F (M, 2), and `without` where F_N is not positive; NaN stays."""
    pushes = F[:, 1] > 0.0
    result = np.abs(F[:, 0]) / np.where(pushes, F[:, 1], 1.0)
    return np.where(pushes | np.isnan(F[:, 1]), result, without)
