"""One arc of a walk, the flow between two impacts or a part of it, by the compiled kernel `arc`.

`arc` makes the memory that the kernel needs, work rows and room for nodes. `engine.simulate` calls it for whole
arcs, `engine.ticks` for the stretches between sample instants.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from biped_adrc.engine.kernels import layout
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.kernels.run_plan import RunPlan
from biped_adrc.types import Array


class ArcRun(NamedTuple):
    """Nodes of one arc and how it ended."""

    code: int
    """Place in `run_plan.STATUS`, or `layout.STRUCK` for an impact; the state in s is then x-."""
    s: Array
    """The run vector at the end (HEAD + nx,): the head, whose places `layout` names, then the state x."""
    t: Array
    """Node times (m,) [s]."""
    x: Array
    """States (m, nx), in their own units."""
    dx: Array
    """Their time derivatives (m, nx)."""


def arc(made: RunPlan, K: Array, s: Array, every: int = 1, room: int = 1024) -> ArcRun:
    """Integrate one arc from the run vector s (HEAD + nx,) to its first event, or to the time s[END] [s].

    K: parameters of the walker's functions, a vector, see `CompiledWalker.K`. every: each so many-th step is
    kept as a node. room: rows for nodes; where they do not suffice, the arc is computed again with twice as
    many. s itself is not changed.
    """
    nx, W = made.nx, made.work()
    while True:
        end, R = s.copy(), np.empty((room, 1 + 2 * nx))
        end[layout.EVERY], end[layout.COUNT] = every, 0.0
        code = kernels().arc(made.P, made.F, K, W, end, R)
        if code != layout.FULL:
            R = R[: int(end[layout.COUNT])]
            return ArcRun(code, end, R[:, 0], R[:, 1 : 1 + nx], R[:, 1 + nx :])
        room *= 2
