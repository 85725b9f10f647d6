"""What the ground does to the feet along a run of a plant that moves by itself.

    footing(row, u, load) -> Feet     a method of the plant, for instance of `MuJoCoPlant`

Such a plant has an integration and contacts of its own. row (2 n + k,) is its whole state, (q, q', and k
numbers of its own), u (p,) [N m] the torque asked of the p motors, load what acts from outside: the disturbance
zeta (n,) [N m] and its resultant force [N]. Forces of the ground follow from these, so a run does not compute
them: `with_readings` asks the plant at every node of a finished run and adds the answers to the arcs
(`Arc.read`). An arc is the motion of one single support, a node an instant whose state x (nx,) is stored.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from biped_adrc.closed_loop.protocols import Load, OnFeet
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.hybrid.trajectory import Arc, Trajectory

FEET = ("foot_force", "foot_place", "foot_speed", "foot_level")
"""Names of what `with_readings` records, in the order of `Feet`: forces [N], places [m] and velocities [m/s],
(K, 4) each, x and z of the stance foot before those of the other; heights of the ground [m], (K, 2)."""


def with_readings(loop: SteppingLoop, run: Trajectory) -> Trajectory:
    """A copy of a run of this loop whose arcs have, in `Arc.read`, the readings FEET at their K nodes; also "u"
    (K, p), the motors' torque, and "zeta" (K, n) [N m], where an arc does not have them yet. `_passed` gives
    state and load of each node. Raises InputError for a plant without feet."""
    plant, arcs = loop.plant, []
    if not isinstance(plant, OnFeet):
        raise InputError(
            f"{type(plant).__name__} does not say what its feet do, expected a plant with footing(row, u, "
            "load), such as MuJoCoPlant"
        )
    for arc in run.arcs:
        rows = []
        for x, load in _passed(loop, arc):
            # the last p numbers of x are the torque that is asked of the motors
            feet = plant.footing(loop.row(x), x[-plant.p :], load)
            # ravel: (2, 2) of both feet becomes a row of 4
            rows.append((loop.motor_torque(x), load.zeta, *map(np.ravel, feet)))
        columns = map(np.array, zip(*rows, strict=True))
        read = dict(zip(("u", "zeta", *FEET), columns, strict=True))
        # read | arc.read: what the arc recorded itself counts; one that failed at once has no u and zeta
        arcs.append(replace(arc, read=read | arc.read))
    return replace(run, arcs=tuple(arcs))


def _passed(loop: SteppingLoop, arc: Arc) -> Iterator[tuple[Array, Load]]:
    """Yield the state x (nx,) at each node of an arc, and the load under which the plant moved there.

    The time between two sample instants or switching times is a stretch: it has two nodes, at its start and its
    end, and the load is constant over it, with its value in the middle. A last node alone is where the plant
    could not go on.
    """
    # a stretch begins at each node after which time goes on; where one ends the next begins, at the same time
    times, pieces = arc.t.tolist(), np.flatnonzero(np.diff(arc.t) > 0.0)
    for k in pieces:
        load = loop.load(0.5 * (times[k] + times[k + 1]), loop.row(arc.x[k]), arc.mode)
        yield arc.x[k], load
        yield arc.x[k + 1], load
    if len(times) > 2 * len(pieces):
        yield arc.x[-1], loop.load(times[-1], loop.row(arc.x[-1]), arc.mode)
