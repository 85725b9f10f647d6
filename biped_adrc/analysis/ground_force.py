"""The ground force that a walk needs: its mean over a window at each node, and the impulse of each impact.

A node is an instant at which a run keeps its state. `Nodes` holds the signals there, `demands` gives the mean
forces by the momentum of the robot (equation in `analysis.demands`), with the largest torque, rate and angle of
the joints. The impulse of an impact is the change of the robot's momentum (`impulse_ratios`). F_T and F_N are
the force of the ground along it and out of it, S is the number of single supports.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import numpy as np

from biped_adrc.analysis.signals import Signals, nodes_before_fall
from biped_adrc.closed_loop.instant_signals import NodeRow, StepReading, node_layout
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.part import once
from biped_adrc.core.timing import SAME_INSTANT
from biped_adrc.core.types import Array, Indices, read_only
from biped_adrc.engine.kernels.load import compiled
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import ENDS, ground_axes


@dataclass(frozen=True)
class Nodes:
    """The signals at the K nodes of a walk that decide whether it is feasible; forces and points are (x, z)."""

    rows: Array
    """(K, width), a `NodeRow` in each, as in `engine.batch.BatchWalk.table`."""
    n: int
    """Number of coordinates."""
    p: int
    """Number of joints with a motor."""

    @classmethod
    def of(cls, s: Signals) -> Nodes:
        """Take the nodes from the signals of a walk."""
        # the columns in the order of `NodeRow`
        parts = np.column_stack((s.t, s.step, s.outside, *StepReading.of(s.q, s.v, s)))
        return cls(np.ascontiguousarray(parts), s.q.shape[1], s.u.shape[1])

    def before_fall(self, h: VirtualConstraint, phase: Array) -> Nodes:
        """The nodes of a walk that fell, without those in the fall, where no tracking error is defined, as
        the curve has ended.

        h: the curve that is tracked (`signals.nodes_before_fall`). phase (n,) [1]: c of Theta = c q.
        """
        count = nodes_before_fall(self.at.step, self.at.reading.q @ phase, h)
        return Nodes(self.rows[:count], self.n, self.p)

    @cached_property
    def at(self) -> NodeRow:
        """The columns of `rows` by name, with a leading axis of K; a repeated time is a jump."""
        return node_layout(self.n, self.p).tree(self.rows)

    @property
    def pointers(self) -> tuple[int, int, int, int]:
        """The first arguments of the compiled loops: address of the rows, how many numbers a row has, address
        of the indices at which its columns begin, p.
        """
        columns = _columns(self.n, self.p)
        return self.rows.ctypes.data, self.rows.shape[1], columns.ctypes.data, self.p

    @cached_property
    def steps(self) -> range:
        """Numbers of the S single supports."""
        return range(int(self.at.step[0]), int(self.at.step[-1]) + 1)

    @cached_property
    def edges(self) -> Indices:
        """Index of the first node of each single support, and K behind them: (S + 1,)."""
        first = np.empty(len(self.steps) + 1, dtype=np.int64)
        *place, _ = self.pointers
        _loops().edges(*place, len(self.rows), len(self.steps), first.ctypes.data)
        return first

    @property
    def last(self) -> Indices:
        """Index of the last node of each single support (S,)."""
        # edges (S + 1,): first node of each, and K
        return self.edges[1:] - 1


@cache
def _columns(n: int, p: int) -> Indices:
    """Index in a `NodeRow` of the first number of each column that the compiled loops read, in the order of
    T, STEP .. in `analysis.demands`."""
    layout, read = node_layout(n, p), ("error", "u", "q", "v_b", "momentum", "swing_foot")
    paths = ("t",), ("step",), ("outside",), *(("reading", name) for name in read)
    return np.array([layout.place(*path).start for path in paths])


@once
def _known(plant: Biped, slope: float, window: float) -> Array:
    """The constants of the loop over nodes, read-only; `analysis.demands` reads them by their place.

    They are, in this order:

        window, m g          length w [s] of the window of a mean force, and the robot's weight [N]
        tangent              of the ground's slope [1], positive where it falls ahead
        ENDS                 share of a single support at either end in which the swing foot's depth is free [1]
        along, normal        unit vectors along the ground (2,) and out of it (2,)
        SAME_INSTANT         by how much two times of one instant may differ [s]
        joints               (2, p, 3), in even and odd single supports: largest rate [rad/s], range [rad]
    """
    # motor_joints: the joints in even single supports, then those in odd ones, where the other leg stands
    joints = np.ravel([[(j.speed, *j.range) for j in side] for side in plant.motor_joints])
    head = window, plant.weight, math.tan(slope), ENDS
    return read_only([*head, *np.ravel(ground_axes(slope)), SAME_INSTANT, *joints])


# `load` joins these texts in this order: a decorator has to stand before the function that uses it.
_TEXTS = ("engine.kernels.record", "engine.kernels.call", "analysis.demands")
LOOPS = tuple(f"biped_adrc.{name}" for name in _TEXTS)


def _loops() -> Any:
    """The functions of `analysis.demands`, compiled, which get arrays by address."""
    # LOOPS: the modules with these functions; the numbers count their arguments
    return compiled(LOOPS, edges=6, demands=10, totals=6)


def demands(walker: Walker, n: Nodes, window: float, impacts: int) -> tuple[Array, Array]:
    """Compute what each of the K nodes `n` of a walk demands of ground and joints, rows (10, K), and the worst
    of them in each of the S single supports (10, S).

    0, 1: F_N [N] and |F_T| / F_N of the mean ground force over the window [s] that ends at the node; 2: depth
    of the swing foot below the ground [m]; 3, 4, 5: over the joints the largest |u_i| [N m], |q_i'| over its
    limit [1], and angle beyond its range [rad]; 6, 7, 8: the joint, from 0, that has each of these three; 9:
    the depth if risers stood just before the footholds [m]. The worst is the least F_N and the largest of the
    others, or NaN.

    Where no window ends at a node, F_N is inf and the ratio -inf; the ratio is -inf too where the ground does
    not push. In a single support shorter than the window the mean is over all of it. Footholds are joined by
    straight lines; with risers the ground is level up to the next foothold. Depth does not count near the ends
    of a single support. Only the first `impacts` single supports ended in an impact; of the others the end
    counts too, and the ground ahead has the height of the lower foothold.
    """
    # how much the ground at the end of each single support is lower than at its start [m], 0 if higher
    falls = [max(walker.drop(step), 0.0) for step in n.steps]
    known = np.concatenate((_known(walker.plant, walker.ground_slope, window), falls))
    # the compiled loop gets addresses, so what they lead to needs names: it has to live until the loop returns
    result, worst = np.empty((12, len(n.rows))), np.empty((len(falls), 10))
    first, *more = (x.ctypes.data for x in (n.edges, known, result, worst))
    # _loops: the compiled functions of `analysis.demands`
    _loops().demands(*n.pointers, first, len(falls), impacts, *more)
    # the last two rows are intermediate results of the loop
    return result[:10], worst.T


def totals(n: Nodes) -> list[float]:
    """Five numbers of a walk: the largest |e_i| [rad]; root mean squares of e [rad] and u [N m] over nodes and
    joints; the integrals of |u_i| |dq_i| and of u_i dq_i [J], summed over motors.

    e (p,) is the tracking error, dq_i the change of joint i to the next node. Of the two nodes at a jump only
    the second counts in means and integrals.
    """
    # _loops: the compiled functions of `analysis.demands`, which get arrays by address. out: largest |e_i|,
    # number of nodes that count, sums of |e|^2, |u|^2, |u_i dq_i| and u_i dq_i over them
    out = np.zeros(6)
    _loops().totals(*n.pointers, len(n.rows), out.ctypes.data)
    # to root mean squares over nodes and joints; 1.0 for no nodes or no joints
    out[2:4] = np.sqrt(out[2:4] / max(out[1] * n.p, 1.0))
    return [out[0], *out[2:]]


def impulse_ratios(walker: Walker, n: Nodes, impacts: int, after: Array | None) -> Array:
    """|F_T| / F_N of the impulse of the impact that ends each of the S single supports (S,).

    Infinite where the ground would have had to pull; 0 for the single supports after the first `impacts`, which
    did not end in an impact. after (2,) [N s]: momentum just after the impact with which the walk ends, as no
    node follows it, else None.
    """
    # the momentum after an impact is that at the first node of the next single support; edges: index of the
    # first node of each single support, then the number of all nodes, so [1:-1] are those after an impact;
    # n.last: index of the last node of each single support, just before the impact
    result, P = np.zeros(len(n.steps)), n.at.reading.momentum
    plus = P[n.edges[1:-1]]
    if after is not None:
        plus = np.vstack((plus, after))
    impulse = plus[:impacts] - P[n.last[:impacts]]
    # the product has the components along the ground and out of it, (F_T, F_N) of each impulse
    result[:impacts] = ratios(impulse @ np.array(ground_axes(walker.ground_slope)).T, np.inf)
    return result


def ratios(F: Array, without: float) -> Array:
    """|F_T| / F_N (M,) of the rows (F_T, F_N) of F (M, 2); `without` where F_N is not positive; NaN stays."""
    pushes = F[:, 1] > 0.0
    result = np.abs(F[:, 0]) / np.where(pushes, F[:, 1], 1.0)
    return np.where(pushes | np.isnan(F[:, 1]), result, without)
