"""Sampled control of a plant that moves by itself, such as a simulator with contacts of its own.

    x = (q, q', s, own, held)       own: numbers that the plant needs to go on

There is no x' = f(x) and there are no event functions: the plant is asked to advance to the next
sample instant and reports its touchdowns (`closed_loop.stepping_plant` defines what it has to
give). Sample instants, sensors, motors, controller and recording are those of every closed loop, so
a controller is tested unchanged on a plant of another kind. Torque, disturbance and estimate are
recorded at the nodes, since they cannot be computed again from the states.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, cast

import numpy as np

from biped_adrc.closed_loop.bounds import Bounds
from biped_adrc.closed_loop.noticing import estimated
from biped_adrc.closed_loop.protocols import Mode, Plant
from biped_adrc.closed_loop.semantics import landed, parts, torque_held
from biped_adrc.closed_loop.stepping_plant import (
    Advanced,
    Contact,
    Load,
    PlantState,
    SteppingPlant,
    advanced,
    check_swap,
    motor_torque,
    started,
)
from biped_adrc.closed_loop.system import ClosedLoop
from biped_adrc.control.base import Controller
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.errors import InputError, NotFiniteError, check_positive
from biped_adrc.hardware.motors import Motors
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hardware.touchdown import Touchdown
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.hybrid.system import FoundEvent, Mover
from biped_adrc.hybrid.trajectory import Event, Record, Trajectory
from biped_adrc.parts import handing_out, numbers
from biped_adrc.timing import SampledTime, check_ends
from biped_adrc.types import Array, Indices, frozen


@dataclass(frozen=True)
class SteppingLoop(ClosedLoop[Any]):
    """A `SteppingPlant` under a controller at sample instants.

    - plant: what moves. model: what the controller knows of it, a `protocols.Plant`.
    - timing: sampled, since between sample instants the plant is given one torque.
    - disturbance: zeta (n,) [N m] and its resultant, asked for by the plant as often as it likes.
    - torque_limit [N m]: saturates every motor; None for no limit.
    - sensors, motors: between controller and plant.
    - touchdown: how the controller is told of one, with restart=False; None: as the plant reports it.
    - runaway_speed, runaway_torque [1]: ends of a run, as of a `Walker`, where the model is a Biped.

    Raises InputError for what does not fit: continuous time, or a motor's lag, which belongs into
    the plant.
    """

    plant: SteppingPlant
    controller: Controller
    model: Plant
    timing: SampledTime
    disturbance: Disturbance | None = None
    torque_limit: float | None = None
    sensors: Sensor | None = None
    motors: Motors | None = None
    touchdown: Touchdown | None = None
    runaway_speed: float = 20.0
    runaway_torque: float = 1000.0

    def __post_init__(self) -> None:
        """Raise InputError for what does not fit; see the class."""
        if not isinstance(self.timing, SampledTime):
            raise InputError(
                f"a plant that moves by itself is controlled at ticks, found {type(self.timing).__name__}; "
                "give timing=SampledTime(period)"
            )
        if not isinstance(self.plant, SteppingPlant):
            raise InputError(
                f"the plant is {self.plant!r:.60}, expected one that moves by itself, with n, p, swap, start "
                "and advance, such as MuJoCoPlant(biped)"
            )
        self.check()
        if (limit := self.torque_limit) is not None:
            check_positive(limit, f"the torque limit is {limit} N m", " or None")
        check_swap(self.plant)
        felt = self.touchdown is not None and self.touchdown.needs_force
        if felt and not hasattr(self.plant, "footing"):
            raise InputError(
                f"{type(self.plant).__name__} does not say what its feet carry (footing), and "
                f"{type(self.touchdown).__name__} goes by that; give another touchdown, such as ByKinematics()"
            )
        check_ends(math.inf, 0.0, self.runaway_speed, self.runaway_torque)
        if self.motors is not None and self.motors.lag > 0.0:
            raise InputError(
                f"the motors' lag is {self.motors.lag} s, expected 0: between ticks a plant that moves by "
                "itself is given one torque; put the lag into the plant, as MuJoCoPlant(biped, lag=1e-3)"
            )

    @property
    def exact(self) -> bool:
        """Never: the model is not the plant."""
        return False

    @cached_property
    def bounds(self) -> Bounds:
        """Angles, rates and torque beyond which the run ends as run away."""
        return Bounds.of(self.nominal, self.plant.n, self.runaway_speed, self.runaway_torque)

    def bounded(self, u: Array) -> Array:
        """u (p,) [N m] itself. Raises RanAwayError for one beyond the bounds."""
        return self.bounds.bounded(u)

    @property
    def swap(self) -> Indices:
        """Relabelling of the motors at a touchdown (p,), dtype int."""
        return self.plant.swap

    @property
    def own(self) -> int:
        """How many numbers of its own the plant keeps, found by starting it once at rest."""
        still = np.zeros(self.plant.n)
        return len(started(self.plant, 0.0, still, still, None).own)

    def initial_state(self, q: Array, v: Array, mode: Mode | None = None) -> Array:
        """x (nx,) at the start of a single support in q (n,) [rad], v (n,) [rad/s], the plant started there."""
        x, mode = super().initial_state(q, v, mode), Mode() if mode is None else mode
        n = self.plant.n
        return self.with_plant(x, started(self.plant, mode.start, x[:n], x[n : 2 * n], self.own))

    def run(self, x0: Array, options: RunOptions, mode: Mode | None = None) -> Trajectory:
        """A run from x0 (nx,); what happens on the way is in the status. Raises InputError for a
        start that is none.
        """
        mode = Mode() if mode is None else mode
        return simulator.run(self, self.checked_start(x0, options, mode), mode, None, options)

    def checked_start(self, x0: Array, options: RunOptions, mode: Mode) -> Array:
        """x0 (nx,) as an array. Raises InputError for one that is no state of this loop."""
        x, n = numbers(x0, "the initial state"), self.plant.n
        options.check(x)
        size, expected = len(x), 2 * n + self.behind
        if whole := expected <= size:
            with handing_out(), np.errstate(over="ignore", invalid="ignore"):
                m = self.measure(mode.start, x[:n], x[n : 2 * n], mode)
                expected += len(self.law.initial_state(m))
        if size != expected:
            has = f"{'' if whole else 'at least '}{expected}"
            raise InputError(
                f"the initial state has {size} numbers, and a loop with {type(self.controller).__name__} has "
                f"{has}; expected what initial_state(q, v) of this loop gives"
            )
        return x

    def with_plant(self, x: Array, state: PlantState) -> Array:
        """x (nx,) with the plant in another state, all else kept."""
        n, size = self.plant.n, 2 * self.plant.n + self.controller_size(x)
        after = size + len(state.own)
        return np.concatenate((state.q, state.v, x[2 * n : size], state.own, x[after:]))

    def mover(self, fired: str | None) -> Mover:
        """One function for all arcs; the plant does not need to know what fired."""
        return self.move

    def move(
        self, t: float, x: Array, mode: Mode, until: float, record: Record
    ) -> tuple[float, Array, FoundEvent | None]:
        """From a sample instant at t [s] to the next, or to a contact: time, x (nx,), and the event
        if there is one.

        Nodes are recorded before a state that is not finite raises NotFiniteError, or one beyond the
        bounds RanAwayError, so that the last good motion can be looked at.
        """
        (q, v, _, tail), k = parts(self, x), self.held
        assert k is not None
        u, state = torque_held(k, tail), PlantState(t, q, v, tail[: k.sizes.own])

        def outside(t: float, q: Array, v: Array) -> Load:
            return self.load(t, q, v, mode)

        moved = advanced(self.plant, state, u, outside, until)
        passed = np.array([state.t, *(node.t for node in moved.nodes)])
        rows = np.array([self.with_plant(x, s) for s in (state, *moved.nodes)])
        angles, rates = rows[:, : len(q)], rows[:, len(q) : 2 * len(q)]
        finite = np.all(np.isfinite(rows), axis=1)
        good = np.logical_and.accumulate(finite & self.bounds.hold(angles, rates))
        self.keep(passed[good], rows[good], mode, record)
        if not np.all(good):
            bad = int(np.argmin(good))
            if finite[bad]:
                self.bounds.check(passed[bad], angles[bad], rates[bad])
            last = np.max(passed[good], initial=t)
            raise NotFiniteError(f"the state of the plant is not finite after t = {last:.6g} s")
        t, x_minus = moved.state.t, rows[-1]
        return t, x_minus, self.found(t, x_minus, mode, moved) if moved.contacts else None

    def load(self, t: float, q: Array, v: Array, mode: Mode) -> Load:
        """What acts from outside at t [s], q (n,) [rad], v (n,) [rad/s], read-only."""
        return frozen(Load(self.external(t, q, v, mode), self.resultant(t, mode)))

    def motor_torque(self, x: Array) -> Array:
        """Torque on the joints (.., p) [N m] in states x (.., nx): the plant's, where its motors have a lag."""
        u, end = x[..., -self.plant.p :], x.shape[-1] - self.behind
        assert self.held is not None
        return motor_torque(self.plant, x[..., end : end + self.held.sizes.own], u)

    def estimated(self, t: float, x: Array, mode: Mode) -> Array:
        """The observer's estimate of xi (p,) [rad/s^2] at (t, x), t in [s]; NaN without an observer."""
        q, v, s, tail = parts(self, x)
        xi = estimated(self, s, tail, self.measure(t, q, v, mode), mode)
        return np.full(self.plant.p, np.nan) if xi is None else xi

    def foot_forces(
        self, t: float, q: Array, v: Array, tail: Array, mode: Mode
    ) -> tuple[float, float]:
        """On stance and swing foot [N], as the plant says (`closed_loop.feet`)."""
        k, plant = self.held, cast("Any", self.plant)
        assert k is not None
        state, u = PlantState(t, q, v, tail[: k.sizes.own]), torque_held(k, tail)
        stance, swing = plant.footing(state, u, self.load(t, q, v, mode)).force[:, 1]
        return float(stance), float(swing)

    def found(self, t: float, x: Array, mode: Mode, moved: Advanced) -> FoundEvent:
        """The event of the contacts at t [s], x (nx,) the state just before, with the controller's jump.

        A contact with a status ends the run. Raises NotFiniteError for an impulse or a state after
        it that is not finite.
        """
        (name, impulse, ends), state = together(moved.contacts), moved.state
        if ends is not None:
            return FoundEvent(Event(name, t, x, None), None, ends)
        if not np.all(np.isfinite([*state.q, *state.v, *state.own, *impulse])):
            raise NotFiniteError(
                f"{name} at t = {t:.6g} s: its impulse or the state after it is not finite"
            )
        after = Mode(mode.step + 1, t)
        x_plus = self.with_plant(landed(self, t, x, state.q, state.v, after), state)
        return FoundEvent(Event(name, t, x, x_plus), (x_plus, after))

    def keep(self, t: Array, x: Array, mode: Mode, record: Record) -> None:
        """Record each `store_every`-th of K nodes, t (K,) [s] and x (K, nx), both ends among them.

        Beside them the motors' torque (p,) and zeta (n,) [N m] and the observer's estimate (p,)
        [rad/s^2]. Slopes of the rates are their differences, since the plant does not give q''.
        """
        if len(t) == 0:
            return
        slopes, n = np.zeros_like(x), self.plant.n
        slopes[:, :n] = v = x[:, n : 2 * n]
        if len(t) > 1:
            a = np.diff(v, axis=0) / np.diff(t)[:, np.newaxis]
            slopes[:, n : 2 * n] = np.vstack((a, a[-1:]))
        xi = self.estimated(t[0], x[0], mode)
        kept = np.unique(np.append(np.arange(0, len(t), record.every), len(t) - 1))
        zeta = np.array([self.load(t[k], x[k, :n], v[k], mode).zeta for k in kept])
        count = len(kept), 1
        read = {"u": self.motor_torque(x[kept]), "zeta": zeta, "xi_estimate": np.tile(xi, count)}
        record.add(t[kept], x[kept], slopes[kept], **read)


def together(contacts: tuple[Contact, ...]) -> Contact:
    """Contacts of one moment as one: names joined by +, impulses added; if some end the run, those alone."""
    ends = tuple(contact for contact in contacts if contact.ends is not None)
    names, impulses, statuses = zip(*(ends or contacts), strict=True)
    return Contact("+".join(dict.fromkeys(names)), np.sum(impulses, axis=0), statuses[0])
