"""What the ground does to the feet along a run of a plant that moves by itself.

    footing(state, u, load) -> Feet     what a plant gives, for instance `MuJoCoPlant`

Forces of the ground follow from state, torque and load, so nothing is added to a run, nor to what it costs:
`readings` goes through an arc again, between the recorded states as finely as asked for, and asks the plant
at each of them. A state that the plant does not come to again is an error: such readings would be of another
walk. `with_readings` puts those at the nodes into the run, from where files carry them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.stepping_plant import Load, PlantState, motor_torque
from biped_adrc.core.errors import InputError, check_positive
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, freeze
from biped_adrc.hybrid.trajectory import Arc, Trajectory

AGAIN = 1e-6
"""Largest difference of a state come to again, relative to the largest of its numbers."""
NAMES = ("foot_force", "foot_place", "foot_speed")
"""What `with_readings` records: `Feet`, (K, 4) each, x and z of the stance foot before those of the other."""


class Feet(NamedTuple):
    """Both feet at one time, the stance foot first; (x, z) of each."""

    force: Array
    """Of the ground on the feet (2, 2) [N]."""
    place: Array
    """Of the foot points (2, 2) [m]."""
    speed: Array
    """Of the points that touch the ground, or would (2, 2) [m/s]."""


@runtime_checkable
class OnFeet(Protocol):
    """A plant that can say what its feet do."""

    def footing(self, state: PlantState, u: Array, load: Load) -> Feet:
        """In a state under u (p,) [N m] and what acts from outside."""


@dataclass(frozen=True)
class Readings(Shown):
    """The feet at K times of one single support. At a sample instant, and where a torque from outside jumps,
    a time occurs twice."""

    t: Array
    """(K,) [s]"""
    q: Array
    """Angles (K, n) [rad]."""
    v: Array
    """Rates (K, n) [rad/s]."""
    own: Array
    """The plant's own numbers (K, k)."""
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
            f"{type(plant).__name__} does not say what its feet do, expected a plant with footing(state, "
            "u, load), such as MuJoCoPlant"
        )
    rows = [
        (*state, motor_torque(plant, state.own, u), load.zeta, *plant.footing(state, u, load))
        for state, u, load in _passed(loop, arc, apart)
    ]
    return Readings(*(np.array(column) for column in zip(*rows, strict=True)))


def with_readings(loop: SteppingLoop, run: Trajectory) -> Trajectory:
    """The same run with `NAMES` at its nodes, so that they are stored with it."""
    arcs = []
    for arc in run.arcs:
        r = readings(loop, arc)
        feet = zip(NAMES, (r.force, r.place, r.speed), strict=True)
        read = {name: x.reshape(len(x), -1) for name, x in feet}
        acting = {"u": r.u, "zeta": r.zeta}  # which an arc that failed at once has not
        arcs.append(replace(arc, read={**acting, **arc.read, **read}))
    return replace(run, arcs=tuple(arcs))


def _passed(
    loop: SteppingLoop, arc: Arc, apart: float | None
) -> Iterator[tuple[PlantState, Array, Load]]:
    """States that the plant passes with what acts on it, piece by piece between two nodes at most `apart` [s]
    apart, both ends of each piece among them; last that where the plant was lost."""
    states = [_state(loop, t, x) for t, x in zip(arc.t, arc.x, strict=True)]
    pieces, torques = np.flatnonzero(np.diff(arc.t) > 0.0), arc.x[:, -loop.plant.p :]
    for k in pieces:
        state, end, u = states[k], states[k + 1], torques[k]
        load = _load(loop, 0.5 * (state.t + end.t), state, arc.mode)
        yield state, u, load
        if apart is None:
            yield end, u, load
            continue
        for until in _between(state.t, end.t, apart):
            state = loop.plant.advance(state, u, lambda *_, load=load: load, until).nodes[-1]
            yield state, u, load
        _check_again(state, end)
    if len(states) > 2 * len(pieces):
        yield states[-1], torques[-1], _load(loop, states[-1].t, states[-1], arc.mode)


def _between(begin: float, end: float, apart: float) -> list[float]:
    """Times in (begin, end] [s], the same way apart, at most `apart`; the last is `end` itself."""
    count = max(1, math.ceil((end - begin) / apart - 1e-6))
    return [*(begin + (end - begin) * k / count for k in range(1, count)), end]


def _state(loop: SteppingLoop, t: float, x: Array) -> PlantState:
    """Of the plant in x (nx,) at t [s]."""
    n, own = loop.plant.n, len(x) - loop.behind
    assert loop.held is not None
    return PlantState(float(t), x[:n], x[n : 2 * n], x[own : own + loop.held.sizes.own])


def _load(loop: SteppingLoop, t: float, state: PlantState, mode: Mode) -> Load:
    return Load(loop.external(t, state.q, state.v, mode), loop.resultant(t, mode))


def _check_again(found: PlantState, expected: PlantState) -> None:
    """Raise InputError where the plant came elsewhere than in the run."""
    a, b = (np.concatenate(state[1:]) for state in (found, expected))
    if not np.max(np.abs(a - b)) <= AGAIN * max(1.0, np.max(np.abs(b))):
        raise InputError(
            f"from the node before t = {expected.t:.6g} s this plant comes to a state that differs by "
            f"{np.max(np.abs(a - b)):.2g} from the run's; give the loop that made the run, the run not "
            "thinned, and readings a whole number of the engine's steps apart"
        )
