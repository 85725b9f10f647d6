"""An arc from Python: the kernel `arc` with work rows and room for nodes made for it."""

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
    """One of `run_plan.STATUS`, or `layout.STRUCK` for an impact; x is then x-."""
    s: Array
    """The run vector at the end (HEAD + nx,)."""
    t: Array
    """Node times (m,) [s]."""
    x: Array
    """States (m, nx)."""
    dx: Array
    """Slopes (m, nx)."""


def arc(made: RunPlan, K: Array, s: Array, every: int = 1, room: int = 1024) -> ArcRun:
    """One arc from the run vector s (HEAD + nx,) to its first event or END, every k-th step kept.

    s stays as it was. Where the nodes do not fit into `room` rows, the arc is made again with twice
    as many.
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
