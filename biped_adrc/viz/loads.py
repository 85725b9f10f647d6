"""What pushes on the drawn robot: the ground reaction and the external torques at one time."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from biped_adrc.types import Array
from biped_adrc.viz.placement import Scene, exchanged


class Loads(NamedTuple):
    """Forces at one stored node."""

    ground_reaction: Array
    """(2,), (F_T, F_N) on the stance foot [N]."""
    zeta: Array
    """(n,) external torque on the drawn joints of q1..qn [N m]."""


def loads(scene: Scene, t: float) -> Loads:
    """The loads at the last stored node up to t [s]; of the ends of the run outside it.

    Controller states are not interpolated: a fast observer's would not survive it.
    """
    arc = scene.trajectory.arcs[scene.arc_at(t)]
    k = min(max(int(np.searchsorted(arc.t, t, side="right")) - 1, 0), len(arc.t) - 1)
    i = scene.walker.instant(float(arc.t[k]), arc.x[k], arc.mode)
    # with q drawn as R q, power zeta' q' is that of R^-T zeta, and R is its own inverse
    zeta = scene.biped.R.T @ i.zeta if exchanged(scene.biped, arc.mode.step) else i.zeta
    return Loads(scene.walker.ground_reaction(i, arc.mode), zeta)
