"""One arc of a compiled run with its nodes, by the kernel `arc`."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.kernels.run_plan import CompiledRun
from biped_adrc.hybrid.constants import FULL
from biped_adrc.types import Array


class ArcNodes(NamedTuple):
    """Nodes of one arc and how it ended."""

    code: int
    """One of `hybrid.constants`; after STRUCK the run is at x-."""
    t: Array
    """Node times (m,) [s]."""
    x: Array
    """States (m, nx), in their own units."""
    dx: Array
    """Their time derivatives (m, nx)."""


def arc(run: CompiledRun, every: int = 1, room: int = 1024) -> ArcNodes:
    """March a run to its first event, or to run["t_end"] [s].

    every: each so many-th step is kept as a node. room: rows for nodes; where they do not suffice, the arc is
    marched again with twice as many.
    """
    nx, run["every"], run["count"] = run.nx, every, 0
    while True:
        rows = np.empty((room, 1 + 2 * nx))
        run.set_nodes(rows)
        code = kernels().arc(run.cells)
        if code != FULL:
            rows = rows[: int(run["count"])]
            return ArcNodes(code, rows[:, 0], rows[:, 1 : 1 + nx], rows[:, 1 + nx :])
        room *= 2
