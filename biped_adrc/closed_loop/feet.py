"""What the ground does to the feet along a run of a plant that moves by itself.

    footing(row, u, load) -> Feet     what a plant gives, for instance `MuJoCoPlant`

Forces of the ground follow from state, torque and load, so a run does not compute them: `with_readings` asks
the plant at every node of a finished run and adds the answers to the arcs (`Arc.read`), with which they are
stored.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from biped_adrc.closed_loop.protocols import Load, OnFeet
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.hybrid.trajectory import Arc, Trajectory

FEET = ("foot_force", "foot_place", "foot_speed", "foot_level")
"""What `with_readings` records: `Feet`, (K, 4) each, x and z of the stance foot before those of the other, and
heights of the ground (K, 2)."""


def with_readings(loop: SteppingLoop, run: Trajectory) -> Trajectory:
    """A copy of a run of this loop with `FEET` at its nodes, torques u and zeta [N m] besides.

    Raises InputError for a plant without feet.
    """
    plant, arcs = loop.plant, []
    if not isinstance(plant, OnFeet):
        raise InputError(
            f"{type(plant).__name__} does not say what its feet do, expected a plant with footing(row, u, "
            "load), such as MuJoCoPlant"
        )
    for arc in run.arcs:
        rows = []
        for x, load in _passed(loop, arc):
            feet = plant.footing(loop.row(x), x[-plant.p :], load)
            rows.append((loop.motor_torque(x), load.zeta, *map(np.ravel, feet)))
        columns = map(np.array, zip(*rows, strict=True))
        read = dict(zip(("u", "zeta", *FEET), columns, strict=True))
        arcs.append(replace(arc, read=read | arc.read))  # an arc that failed at once has no u, zeta
    return replace(run, arcs=tuple(arcs))


def _passed(loop: SteppingLoop, arc: Arc) -> Iterator[tuple[Array, Load]]:
    """Yield the state x (nx,) at each node with the load on the plant, which is constant from node to node.

    A stretch has two nodes, at its start and its end; a last node alone is where the plant was lost.
    """
    times, pieces = arc.t.tolist(), np.flatnonzero(np.diff(arc.t) > 0.0)
    for k in pieces:
        load = loop.load(0.5 * (times[k] + times[k + 1]), loop.row(arc.x[k]), arc.mode)
        yield arc.x[k], load
        yield arc.x[k + 1], load
    if len(times) > 2 * len(pieces):
        yield arc.x[-1], loop.load(times[-1], loop.row(arc.x[-1]), arc.mode)
