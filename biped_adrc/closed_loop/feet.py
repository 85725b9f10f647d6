"""What the ground does to the feet along a run of a plant that moves by itself.

    footing(row, u, load) -> Feet     what a plant gives, for instance `MuJoCoPlant`

Forces of the ground follow from state, torque and load, so nothing is added to a run, nor to what it costs:
`readings` goes through an arc again, between the recorded states as finely as asked for, and asks the plant
at each of them. A state that the plant does not come to again is an error: such readings would be of another
walk. `with_readings` puts those at the nodes into the run, from where files carry them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace

import numpy as np

from biped_adrc.closed_loop.protocols import Load, OnFeet
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.core.errors import InputError, check_positive
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, freeze
from biped_adrc.hybrid.trajectory import Arc, Trajectory

AGAIN = 1e-6
"""Largest difference of a state come to again, relative to the largest of its numbers."""
NAMES = ("foot_force", "foot_place", "foot_speed", "foot_level")
"""What `with_readings` records: `Feet`, (K, 4) each, x and z of the stance foot before those of the other, and
heights of the ground (K, 2)."""


@dataclass(frozen=True)
class Readings(Shown):
    """The feet at K times of one single support. At a sample instant, and where a torque from outside jumps,
    a time occurs twice."""

    t: Array
    """(K,) [s]"""
    row: Array
    """States of the plant (K, 2 n + k): angles [rad], rates [rad/s] and its own numbers."""
    u: Array
    """Torques of the motors (K, p) [N m]."""
    zeta: Array
    """What acts from outside (K, n) [N m]."""
    force: Array
    """Of the ground (K, 2, 2) [N]."""
    place: Array
    """Of the foot points (K, 2, 2) [m]."""
    speed: Array
    """Of the points that touch the ground (K, 2, 2) [m/s]."""
    level: Array
    """Heights of the ground under the feet (K, 2) [m]."""

    def __post_init__(self) -> None:
        freeze(self, *(f.name for f in fields(self)))


def readings(loop: SteppingLoop, arc: Arc, apart: float | None = None) -> Readings:
    """The feet along an arc of a run of this loop, at the nodes and between them at most `apart` [s] apart.

    apart: the step of the plant's engine, or a multiple of it, since another step is another motion; None
    for the nodes alone, where the plant is asked and goes nowhere. Raises InputError for a plant without feet,
    and where the run is not of this loop or was thinned.
    """
    if apart is not None:
        check_positive(apart, f"readings are {apart} s apart", " or None")
    plant = loop.plant
    if not isinstance(plant, OnFeet):
        raise InputError(
            f"{type(plant).__name__} does not say what its feet do, expected a plant with footing(row, u, "
            "load), such as MuJoCoPlant"
        )
    rows = []
    for t, x, load in _passed(loop, arc, apart):
        row, u = loop.row(x), x[-plant.p :]
        rows.append((t, row, loop.motor_torque(x), load.zeta, *plant.footing(row, u, load)))
    return Readings(*(np.array(column) for column in zip(*rows, strict=True)))


def with_readings(loop: SteppingLoop, run: Trajectory) -> Trajectory:
    """A copy of a run that also has the signals `NAMES` at its nodes, so that they are stored with it."""
    arcs = []
    for arc in run.arcs:
        r = readings(loop, arc)
        feet = zip(NAMES, (r.force, r.place, r.speed, r.level), strict=True)
        read = {name: x.reshape(len(x), -1) for name, x in feet}
        acting = {"u": r.u, "zeta": r.zeta}  # which an arc that failed at once has not
        arcs.append(replace(arc, read={**acting, **arc.read, **read}))
    return replace(run, arcs=tuple(arcs))


def _passed(
    loop: SteppingLoop, arc: Arc, apart: float | None
) -> Iterator[tuple[float, Array, Load]]:
    """Times [s] and states x (nx,) that the plant passes with what acts on it, piece by piece between two nodes
    at most `apart` [s] apart, both ends of each piece among them; last that where the plant was lost."""
    times, pieces = arc.t.tolist(), np.flatnonzero(np.diff(arc.t) > 0.0)
    for k in pieces:
        t, end, x, expected = times[k], times[k + 1], arc.x[k], arc.x[k + 1]
        load = loop.load(0.5 * (t + end), loop.row(x), arc.mode)
        yield t, x, load
        for until in () if apart is None else _between(t, end, apart):
            moved = loop.plant.advance(t, loop.row(x), x[-loop.plant.p :], load, until)
            t, x = until, loop.with_plant(x, moved.row)
            yield t, x, load
        if apart is None:
            yield end, expected, load
        else:
            _check_again(loop.row(x), loop.row(expected), end)
    if len(times) > 2 * len(pieces):
        yield times[-1], arc.x[-1], loop.load(times[-1], loop.row(arc.x[-1]), arc.mode)


def _between(begin: float, end: float, apart: float) -> list[float]:
    """Times in (begin, end] [s], the same way apart, at most `apart`; the last is `end` itself."""
    count = max(1, math.ceil((end - begin) / apart - 1e-6))
    return [*(begin + (end - begin) * k / count for k in range(1, count)), end]


def _check_again(found: Array, expected: Array, t: float) -> None:
    """Raise InputError where the plant came at t [s] to another row than in the run."""
    gap = np.max(np.abs(found - expected))
    if not gap <= AGAIN * max(1.0, np.max(np.abs(expected))):
        raise InputError(
            f"from the node before t = {t:.6g} s this plant comes to a state that differs by {gap:.2g} from "
            "the run's; give the loop that made the run, the run not thinned, and readings a whole number of "
            "the engine's steps apart"
        )
