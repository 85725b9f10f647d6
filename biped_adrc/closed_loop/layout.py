"""A run on a plant that moves by itself in the layout of a walker's states, (q, q', s, held).

What the plant keeps for itself is taken out of the states, so that whatever reads a walk reads this one. At the
nodes is recorded, since it cannot be computed again: forces of the ground, places and velocities of both feet,
where the plant has feet (`closed_loop.feet`).
"""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np

from biped_adrc.closed_loop.feet import with_readings
from biped_adrc.closed_loop.protocols import OnFeet, lag_of
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.core.types import Array
from biped_adrc.hybrid.trajectory import Arc, Event, Trajectory
from biped_adrc.model.biped import Biped


def as_walked(loop: SteppingLoop, run: Trajectory) -> Trajectory:
    """Converts a run of `loop` to the layout of a walker's states, (q, q', s, held).

    The plant's own numbers are removed, but for the torque of lagging motors, which moves to where a walker has
    it. Of a plant with feet, forces [N], places [m] and velocities [m/s] of both feet are recorded besides.
    """
    if isinstance(loop.plant, OnFeet):
        run = with_readings(loop, run)
    arcs = tuple(_as_rigid(loop, arc) for arc in run.arcs)
    return replace(run, arcs=arcs, settings={**run.settings, "plant": _values(loop.plant)})


def _as_rigid(loop: SteppingLoop, arc: Arc) -> Arc:
    """An arc with states as the rigid plant's walker has them, and with the place of the stance foot."""
    size, p, k = loop.controller_size(arc.x[0]) + 2 * loop.plant.n, loop.plant.p, loop.held
    assert k is not None
    mine, line = slice(size, size + k.sizes.own), -p * (k.sizes.waiting + 1)

    def without(x: Array) -> Array:
        """The plant's own out, and u_m where the rigid plant's walker has it."""
        u_m = loop.motor_torque(x)[..., : p if lag_of(loop.plant) > 0.0 else 0]
        return np.concatenate(
            (np.delete(x[..., :line], mine, axis=-1), u_m, x[..., line:]), axis=-1
        )

    event = arc.event
    if event is not None:
        after = None if event.x_plus is None else without(event.x_plus)
        event = Event(event.guard, event.t, without(event.x_minus), after)
    return replace(arc, x=without(arc.x), dx=without(arc.dx), event=event)


def _values(thing: Any) -> Any:
    """A plant as plain values for the record of a run: its class and what it was made with."""
    if isinstance(thing, tuple):
        return tuple(map(_values, thing))
    if not is_dataclass(thing) or isinstance(thing, Biped):
        return thing if isinstance(thing, int | float | str) else type(thing).__name__
    values = {f.name: _values(getattr(thing, f.name)) for f in fields(thing) if f.init}
    return {"class": type(thing).__name__, **values}
