"""Sampled control of a plant that moves by itself: without x' = f(x) or guards; it reports its touchdowns.

    x = (q, q', s, own, held)       own: what else the plant needs to go on, with the rest of `hardware.held`

A simulator with contacts of its own is such a plant. Ticks, sensors, motors, controller and recording are those
of every closed loop; how the plant moves is its own affair. What acted is recorded, since it cannot be computed
again from the states.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

import numpy as np

from biped_adrc.closed_loop.semantics import Mode, Plant, landed, parts, torque_held
from biped_adrc.closed_loop.system import ClosedLoop
from biped_adrc.control.base import Controller
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.errors import InputError, NotFiniteError
from biped_adrc.hardware.motors import Motors
from biped_adrc.hardware.sensors import Sensors
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.simulator import Record, RunOptions
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.system import Found, Mover
from biped_adrc.hybrid.trajectory import Event, Trajectory
from biped_adrc.timing import SampledTime
from biped_adrc.types import Array

ROUND_OFF = 1e-9
"""[s] by which a plant's own clock may differ from the time that it was to reach."""


class PlantState(NamedTuple):
    """At t [s]: q and v (n,), and what else the plant needs to go on, numbers of its own (k,)."""

    t: float
    q: Array
    v: Array
    own: Array


class Contact(NamedTuple):
    """A touchdown, which ends a single support; or, with a status, what ends the run, such as a fall."""

    name: str
    impulse: Array = np.zeros(2)
    """Of the ground (2,) [N s]."""
    ends: Status | None = None


class Advanced(NamedTuple):
    """What a plant gives back: where it is, at `until` or just after the contacts, and how it came there."""

    state: PlantState
    contacts: tuple[Contact, ...]
    nodes: tuple[PlantState, ...]
    """The states passed, at least one; the last is that before the contacts, or `state`."""


class SteppingPlant(Protocol):
    """n coordinates, the first p of them with motors."""

    @property
    def n(self) -> int: ...
    @property
    def p(self) -> int: ...
    @property
    def swap(self) -> Any:
        """Relabelling of the motors at a touchdown (p,), dtype int; `arange(p)` for none."""

    def start(self, t: float, q: Array, v: Array) -> PlantState:
        """The plant at rest in itself, moving with (q, v)."""

    def advance(
        self,
        state: PlantState,
        u: Array,
        zeta: Callable[[float, Array, Array], Array],
        until: float,
    ) -> Advanced:
        """On to `until` [s] or to the next contact, under u (p,) [N m] and zeta(t, q, v) (n,) [N m]."""


@dataclass(frozen=True)
class SteppingLoop(ClosedLoop[Any]):
    """A `SteppingPlant` under a controller; model: what the controller knows of it, a `semantics.Plant`.

    torque_limit [N m] saturates every motor. Raises InputError for what does not fit: a motor's lag, too, since
    between ticks the plant is given one torque.
    """

    plant: SteppingPlant
    controller: Controller
    model: Plant
    timing: SampledTime
    disturbance: Disturbance | None = None
    torque_limit: float | None = None
    sensors: Sensors | None = None
    motors: Motors | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.timing, SampledTime):
            raise InputError(
                f"a plant that moves by itself is controlled at ticks, found {type(self.timing).__name__}; "
                "give timing=SampledTime(period)"
            )
        self.check()
        if self.motors is not None and self.motors.lag > 0.0:
            raise InputError(
                f"the motors' lag is {self.motors.lag} s, expected 0: between ticks a plant that moves by "
                "itself is given one torque; put the lag into the plant"
            )

    @property
    def exact(self) -> bool:
        return False

    @property
    def limit(self) -> float | None:
        """torque_limit."""
        return self.torque_limit

    @property
    def swap(self) -> Any:
        return self.plant.swap

    @property
    def own(self) -> int:
        still = np.zeros(self.plant.n)
        return len(self.plant.start(0.0, still, still).own)

    def external(self, t: float, q: Array, v: Array, mode: Mode) -> Array:
        if self.disturbance is None:
            return np.zeros(self.plant.n)
        return self.disturbance.torque(t, mode.step, mode.start, q, v)

    def initial_state(self, q: Array, v: Array, mode: Mode | None = None) -> Array:
        x, mode = super().initial_state(q, v, mode), Mode() if mode is None else mode
        return self.with_plant(x, self.plant.start(mode.start, q, v))

    def run(self, x0: Array, options: RunOptions, mode: Mode | None = None) -> Trajectory:
        """From x0; what happens on the way is in the status. Raises InputError for a start that is none."""
        return simulator.run(self, x0, Mode() if mode is None else mode, None, options)

    def with_plant(self, x: Array, state: PlantState) -> Array:
        """x with the plant in another state."""
        n, size = self.plant.n, 2 * self.plant.n + self.controller_size(x)
        after = size + len(state.own)
        return np.concatenate((state.q, state.v, x[2 * n : size], state.own, x[after:]))

    def mover(self, fired: str | None) -> Mover:
        return self.move

    def move(
        self, t: float, x: Array, mode: Mode, until: float, record: Record
    ) -> tuple[float, Array, Found | None]:
        """From a tick to the next, or to a contact, as `hybrid.system.Mover`."""
        (q, v, _, tail), k = parts(self, x), self.held
        assert k is not None
        u, state = torque_held(k, tail), PlantState(t, q, v, tail[: k.sizes.own])

        def zeta(t: float, q: Array, v: Array) -> Array:
            return self.external(t, q, v, mode)

        moved = self.plant.advance(state, u, zeta, until)
        self.keep(x, u, (state, *moved.nodes), mode, record)
        x_minus, t = self.with_plant(x, moved.nodes[-1]), moved.state.t
        if not np.all(np.isfinite(x_minus)):
            raise NotFiniteError(f"the state of the plant is not finite at t = {t:.6g} s")
        if moved.contacts:
            return t, x_minus, self.found(t, x_minus, mode, moved)
        if not abs(t - until) <= ROUND_OFF:
            raise InputError(
                f"{type(self.plant).__name__}.advance came to {t} s without a contact, expected {until} s"
            )
        return until, x_minus, None

    def found(self, t: float, x: Array, mode: Mode, moved: Advanced) -> Found:
        """The event of the first contact, and the controller's jump."""
        name, impulse, ends = moved.contacts[0]
        if ends is not None:
            return Found(Event(name, t, x, None), None, ends)
        after, state = Mode(mode.step + 1, t), moved.state
        x_plus = self.with_plant(landed(self, t, x, state.q, state.v, impulse, after), state)
        return Found(Event(name, t, x, x_plus), (x_plus, after))

    def keep(
        self, x: Array, u: Array, states: tuple[PlantState, ...], mode: Mode, record: Record
    ) -> None:
        """Nodes with u, zeta and the observer's estimate; slopes of the rates by their differences."""
        t, v = np.array([s.t for s in states]), np.array([s.v for s in states])
        rows = np.array([self.with_plant(x, s) for s in states])
        slopes, n = np.zeros_like(rows), self.plant.n
        slopes[:, :n] = v
        slopes[:-1, n : 2 * n] = np.diff(v, axis=0) / np.diff(t)[:, np.newaxis]
        slopes[-1, n : 2 * n] = slopes[-2, n : 2 * n]
        q, s = x[:n], parts(self, x)[2]
        estimate = self.law.estimate(s, self.measure(states[0].t, q, v[0], mode))
        xi = np.full(self.plant.p, np.nan) if estimate is None else estimate.disturbance
        zeta = np.array([self.external(s.t, s.q, s.v, mode) for s in states])
        count = len(t), 1
        record.add(t, rows, slopes, u=np.tile(u, count), zeta=zeta, xi_estimate=np.tile(xi, count))
