"""Mean force of the ground, by Newton's law from the momentum of the robot at the nodes of a walk.

    F = (P(t) - P(t - w) - int f dt) / w + m g e_z        P = m v_com, f the force from outside

over windows of length w that end at a node; whatever the force does between the nodes, its mean is exact where
a window begins at one too, and P is taken as linear between nodes where it does not. A stiff sampled
controller makes the force jump from sample to sample, and a foot slides by what acts over some milliseconds:
so a step is judged by means (`certificate`). The impulse of an impact is the change of P in it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.types import Array, Indices
from biped_adrc.model.ground import ground_axes

SHORTEST = 1e-9
"""Shortest single support with a mean force [s]."""


@dataclass(frozen=True)
class Nodes:
    """The signals of a walk that feasibility depends on, at its K nodes; forces and points are (x, z)."""

    t: Array
    """(K,) [s]; a repeated time is a jump."""
    step: Array
    """Number of the single support (K,)."""
    error: Array
    """q_b - q_d (K, p) [rad]."""
    u: Array
    """Torque of the motors (K, p) [N m]."""
    q_b: Array
    """(K, p) [rad]."""
    momentum: Array
    """m v_com (K, 2) [N s]."""
    swing_foot: Array
    """Place of the swing foot relative to the stance foot (K, 2) [m]."""
    outside: Array
    """Resultant external force (K, 2) [N]."""

    @classmethod
    def of(cls, s: Signals) -> Nodes:
        """Take the nodes from the signals of a walk."""
        q_b = s.q[:, : s.u.shape[1]]
        return cls(s.t, s.step, s.error, s.u, q_b, s.momentum, s.swing_foot, s.outside)

    @classmethod
    def of_table(cls, table: Array, p: int) -> Nodes:
        """Take the nodes from the table of a compiled walk with p joints (`engine.batch.BatchWalk.table`)."""
        parts = (rows.T for rows in np.split(table, np.cumsum([1, 1, 2, p, p, p, 2])))
        t, step, outside, error, u, q_b, momentum, foot = parts
        return cls(t[:, 0], step[:, 0].astype(int), error, u, q_b, momentum, foot, outside)

    @cached_property
    def supports(self) -> Supports:
        """First and last node of each single support."""
        first = np.flatnonzero(np.diff(self.step, prepend=self.step[0] - 1))
        last = np.append(first[1:], len(self.step)) - 1
        return Supports(first, last, np.repeat(np.arange(len(first)), last - first + 1))


class Supports(NamedTuple):
    """Which of K nodes belong to which of S single supports."""

    first: Indices
    """First node of each (S,)."""
    last: Indices
    """Last node of each (S,)."""
    of: Indices
    """Index of the single support of each node (K,)."""


class MeanForces(NamedTuple):
    """Mean forces of the ground over M windows, in order of time."""

    of: Indices
    """Index of the single support of each window (M,)."""
    t: Array
    """Ends of the windows (M,) [s]."""
    F: Array
    """(F_T, F_N) (M, 2) [N], along the ground and perpendicular to it."""


def mean_forces(walker: Walker, n: Nodes, window: float) -> MeanForces:
    """Mean force of the ground over all windows [t - window, t] [s] within a single
    support, t the time of a node.

    A single support shorter than the window is averaged as a whole.
    """
    first, last, of = n.supports
    t, length = n.t, np.minimum(window, n.t[last] - n.t[first])
    long, whole = length[of], n.momentum
    ends = np.flatnonzero((t - t[first][of] >= long) & (long > SHORTEST))
    of, long = of[ends], long[ends]
    if n.outside.any():
        pieces = np.diff(t)[:, np.newaxis] * (n.outside[1:] + n.outside[:-1]) / 2.0
        whole = whole - np.vstack((np.zeros(2), np.cumsum(pieces, axis=0)))
    begins = t[ends] - long
    i = np.searchsorted(t, begins, side="right") - 1
    i = np.minimum(np.maximum(i, first[of]), last[of] - 1)
    h = t[i + 1] - t[i]
    share = np.clip((begins - t[i]) / np.where(h > 0.0, h, 1.0), 0.0, 1.0)
    F_x, F_z = ((w[ends] - w[i] - share * (w[i + 1] - w[i])) / long for w in whole.T)
    F = np.array([F_x, F_z + walker.plant.weight]).T
    return MeanForces(of, t[ends], F @ np.array(ground_axes(walker.slope)).T)


def impulse_ratios(walker: Walker, n: Nodes, impacts: int, after: Array | None) -> Array:
    """|F_T| / F_N of the impulse of the impact that ends each of the S single supports (S,).

    Infinite where the ground would have had to pull, 0 for those behind the first `impacts`, which end in
    none. after (2,) [N s]: momentum after the last impact, where the walk ends with it.
    """
    first, last, _ = n.supports
    result = np.zeros(len(first))
    plus = n.momentum[first[1:]]
    if after is not None:
        plus = np.vstack((plus, after))
    impulse = plus[:impacts] - n.momentum[last[:impacts]]
    result[:impacts] = ratios(impulse @ np.array(ground_axes(walker.slope)).T, np.inf)
    return result


def ratios(F: Array, without: float) -> Array:
    """|F_T| / F_N of the rows of F (M, 2), and `without` where F_N is not positive; NaN stays."""
    pushes = F[:, 1] > 0.0
    result = np.abs(F[:, 0]) / np.where(pushes, F[:, 1], 1.0)
    return np.where(pushes | np.isnan(F[:, 1]), result, without)
