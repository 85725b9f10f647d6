"""Sampled control of a plant that moves by itself, such as a simulator with contacts of its own.

    x = (q, q', s, own, held)       own: numbers that the plant needs to go on

There is no x' = f(x) and there are no event functions: the plant is asked to advance to the next sample instant
or edge of a disturbance and reports its touchdowns (`closed_loop.stepping_plant` defines what it has to give).
Sample instants, sensors, motors, controller and recording are those of every closed loop, so a controller is
tested unchanged on a plant of another kind. Torque, disturbance and estimate are recorded at the nodes, since
they cannot be computed again from the states.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, cast

import numpy as np

from biped_adrc.closed_loop.noticing import estimated
from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.semantics import after_contact, parts, torque_held
from biped_adrc.closed_loop.stepping_plant import (
    Contact,
    Load,
    PlantState,
    SteppingPlant,
    StridingPlant,
    advanced,
    check_swap,
    motor_torque,
    started,
    state_of,
)
from biped_adrc.closed_loop.stretches import Stretches
from biped_adrc.closed_loop.system import ClosedLoop
from biped_adrc.core.checks import handing_out, numbers
from biped_adrc.core.errors import InputError, NotFiniteError
from biped_adrc.core.timing import SampledTime
from biped_adrc.core.types import Array, Indices, frozen
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.hybrid.system import FoundEvent, Mover
from biped_adrc.hybrid.trajectory import Event, Trajectory


@dataclass(frozen=True)
class SteppingLoop(ClosedLoop[Any]):
    """A `SteppingPlant` under a controller at sample instants; the fields are those of `ClosedLoop`.

    - plant: what moves. model: what the controller knows of it, a `protocols.Plant`.
    - timing: sampled, since between sample instants the plant is given one torque.
    - disturbance: asked for by the plant as often as it likes.

    Raises InputError for what does not fit: continuous time, no model, or a motor's lag, which belongs into
    the plant.
    """

    plant: SteppingPlant

    def __post_init__(self) -> None:
        """Raise InputError for what does not fit; see the class."""
        if not isinstance(self.timing, SampledTime):
            raise InputError(
                f"a plant that moves by itself is controlled at ticks, found {type(self.timing).__name__}; "
                "give timing=SampledTime(period)"
            )
        if not isinstance(self.plant, SteppingPlant) or self.model is None:
            raise InputError(
                f"the plant is {self.plant!r:.60} and the model {self.model!r:.60}, expected a plant that "
                "moves by itself, with n, p, swap, start and advance, such as MuJoCoPlant(biped), and a model"
            )
        super().__post_init__()
        check_swap(self.plant)
        felt = self.touchdown is not None and self.touchdown.needs_force
        if felt and not hasattr(self.plant, "footing"):
            raise InputError(
                f"{type(self.plant).__name__} does not say what its feet carry (footing), and "
                f"{type(self.touchdown).__name__} goes by that; give another touchdown, such as ByKinematics()"
            )
        if self.motors is not None and self.motors.lag > 0.0:
            raise InputError(
                f"the motors' lag is {self.motors.lag} s, expected 0: between ticks a plant that moves by "
                "itself is given one torque; put the lag into the plant, as MuJoCoPlant(biped, lag=1e-3)"
            )

    @cached_property
    def squares(self) -> tuple[float, float]:
        """Squares of sums below which all angles, and all angles and rates, are within the bounds."""
        return self.bounds.farthest**2, float(np.min(self.bounds.fastest)) ** 2

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

    def record(self, every: int) -> Stretches:
        """Room for the nodes of one arc, of which each `every`-th of a stretch is kept."""
        return Stretches(every, loop=self)

    def move(
        self, t: float, x: Array, mode: Mode, until: float, record: Stretches
    ) -> tuple[float, Array, FoundEvent | None]:
        """One stretch from x (nx,) at t [s] to `until` [s] or to a contact, as `hybrid.system.Mover`.

        Nodes are recorded before a state that is not finite raises NotFiniteError, or one beyond the
        bounds RanAwayError, so that the last good motion can be looked at.
        """
        assert self.held is not None
        n, p, (near, slow) = self.held.sizes.n, self.held.sizes.p, self.squares
        xi, row = self.estimated(t, x, mode), record.row(x)
        nodes, contacts, after = self.stretch(t, row, x[-p:], mode, until)
        record.begin(t, row, x, xi, mode)
        for end, row in nodes:
            q = row[:n]
            if not (q.dot(q) < near and row.dot(row) < slow):  # two products test all of them
                if not np.all(np.isfinite(row)):
                    raise NotFiniteError(
                        f"the state of the plant is not finite after t = {t:.6g} s"
                    )
                self.bounds.check(end, q, row[n : 2 * n])
            record.point(end, row, mode)
            t = end
        x = x.copy()
        x[: 2 * n], x[self.own_places] = row[: 2 * n], row[2 * n :]
        return t, x, None if after is None else self.found(t, x, mode, contacts, after)

    def stretch(
        self, t: float, row: Array, u: Array, mode: Mode, until: float
    ) -> tuple[list[tuple[float, Array]], tuple[Contact, ...], PlantState | None]:
        """Times [s] and rows (2 n + k,) that the plant passes from a row at t [s] under u (p,) [N m], its
        contacts, and its state after them, None without.

        On a plant that strides what acts from outside is taken in the middle.
        """
        plant, n = self.strides, self.plant.n
        if plant is not None:
            load = None if self.disturbance is None else self.push(0.5 * (t + until), row, mode)
            row, contacts = plant.stride(t, row, u, load, until)
            after = plant.landed(state_of(until, row, n), contacts) if contacts else None
            return [(until, row)], contacts, after

        def outside(t: float, q: Array, v: Array) -> Load:
            return self.load(t, q, v, mode)

        moved = advanced(self.plant, state_of(t, row, n), u, outside, until)
        nodes = [(node.t, np.concatenate(node[1:])) for node in moved.nodes]
        return nodes, moved.contacts, moved.state if moved.contacts else None

    @cached_property
    def strides(self) -> StridingPlant | None:
        """The plant, where its word is taken."""
        return self.plant if isinstance(self.plant, StridingPlant) else None

    @cached_property
    def own_places(self) -> slice:
        """Places in x of the plant's own numbers, counted from its end."""
        assert self.held is not None
        return slice(-self.behind, self.held.sizes.own - self.behind)

    def load(self, t: float, q: Array, v: Array, mode: Mode) -> Load:
        """What acts from outside at t [s], q (n,) [rad], v (n,) [rad/s], read-only."""
        zeta = self.external(t, frozen(q), frozen(v), mode)
        return frozen(Load(zeta, self.resultant(t, mode)))

    def push(self, t: float, row: Array, mode: Mode) -> Load | None:
        """As `load`, in a row of the plant; None may stand for nothing."""
        n = self.plant.n
        return self.load(t, row[:n], row[n : 2 * n], mode)

    @cached_property
    def pushed_in_python(self) -> bool:
        """Whether zeta is computed point by point, so that what it raises ends the run there."""
        return self.disturbance is not None

    def zetas(self, t: Array, rows: Array, mode: Mode) -> Array:
        """zeta (K, n) [N m] at K times [s], in the plant's rows, where it is not computed point by point."""
        return np.zeros((len(t), self.plant.n))

    def motor_torque(self, x: Array) -> Array:
        """Torque on the joints (.., p) [N m] in states x (.., nx): the plant's, where its motors have a lag."""
        return motor_torque(self.plant, x[..., self.own_places], x[..., -self.plant.p :])

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

    def found(
        self, t: float, x: Array, mode: Mode, contacts: tuple[Contact, ...], state: PlantState
    ) -> FoundEvent:
        """The event of the contacts at t [s], x (nx,) the state just before and `state` the plant's after, with
        the controller's jump.

        A contact with a status ends the run. Raises NotFiniteError for an impulse or a state after
        it that is not finite.
        """
        name, impulse, ends = together(contacts)
        if ends is not None:
            return FoundEvent(Event(name, t, x, None), None, ends)
        if not np.all(np.isfinite([*state.q, *state.v, *state.own, *impulse])):
            raise NotFiniteError(
                f"{name} at t = {t:.6g} s: its impulse or the state after it is not finite"
            )
        after = Mode(mode.step + 1, t)
        x_plus = self.with_plant(after_contact(self, t, x, state.q, state.v, after), state)
        return FoundEvent(Event(name, t, x, x_plus), (x_plus, after))


def together(contacts: tuple[Contact, ...]) -> Contact:
    """Contacts of one moment as one: names joined by +, impulses added; if some end the run, those alone."""
    ends = tuple(contact for contact in contacts if contact.ends is not None)
    names, impulses, statuses = zip(*(ends or contacts), strict=True)
    return Contact("+".join(dict.fromkeys(names)), np.sum(impulses, axis=0), statuses[0])
