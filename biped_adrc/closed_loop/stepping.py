"""Sampled control of a plant that moves by itself, such as a simulator with contacts of its own.

    x = (q, q', s, own, ..)       state (nx,); .. are sensors and torques, held between sample instants

    q, v = q'     coordinates (n,) [rad] and rates (n,) [rad/s]; the first p coordinates have motors
    s, u          the controller's state; torques asked of the motors (p,) [N m], the last p numbers of x
    own           k numbers that the plant needs besides q and q' to go on, such as torques of lagging motors
    row           (q, q', own) (2 n + k,), the plant's whole state
    zeta          disturbance, a generalised force (n,) [N m]
    load          all that acts from outside, a `Load`: zeta, and the resultant force [N]; None for nothing
    mode          the single support: its number from 1 (step), and the time [s] at which it began (start)

There is no x' = f(x) and there are no event functions: the plant is asked to advance to the next sample instant
or switching time of a disturbance, and reports its contacts (`closed_loop.protocols` defines its methods). The
time from one such instant, or contact, to the next is called a stretch; over it u and load are constant, the
load with its value in the middle. Sample instants, sensors, motors and controller are those of every closed
loop, so a controller is tested unchanged on a plant of another kind. Torque and disturbance are recorded at
both ends of every stretch, since they cannot be computed again from the states. An arc is the motion of one
single support, stored at nodes (instants).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, cast

import numpy as np

from biped_adrc.closed_loop import protocols
from biped_adrc.closed_loop.protocols import Contact, FootForces, Load, Mode, SteppingPlant
from biped_adrc.closed_loop.semantics import after_contact
from biped_adrc.closed_loop.system import ClosedLoop
from biped_adrc.core.checks import handing_out, numbers, returned
from biped_adrc.core.errors import InputError, NotFiniteError
from biped_adrc.core.timing import SampledTime
from biped_adrc.core.types import Array, frozen, read_only
from biped_adrc.hardware.sample_hold import Tail, motor_torque
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.hybrid.system import FoundEvent, Mover
from biped_adrc.hybrid.trajectory import Arc, Event, Recorder, Trajectory

_ROUND_OFF = 1e-9
"""Largest difference [s] between a plant's own clock and the time that it was to reach."""


@dataclass(frozen=True)
class SteppingLoop(ClosedLoop[Any]):
    """A `SteppingPlant` under a controller at sample instants; the fields are those of `ClosedLoop`.

    - plant: the plant that moves. model: the controller's model of it, a `protocols.Plant`.
    - timing: sampled, since the plant gets one torque for the time between two sample instants.

    Raises InputError for continuous time, no model, or a lag of the motors, which belongs into the plant.
    """

    plant: SteppingPlant

    def __post_init__(self) -> None:
        """Raise InputError for what does not fit; see the class."""
        if not isinstance(self.timing, SampledTime):
            raise InputError(
                f"{type(self.plant).__name__}, as a plant that moves by itself, is controlled at ticks, found "
                f"{type(self.timing).__name__}; give timing=SampledTime(1e-3), or period = 0.001 in a scenario"
            )
        if not isinstance(self.plant, SteppingPlant) or self.model is None:
            raise InputError(
                f"the plant is {self.plant!r:.60} and the model {self.model!r:.60}, expected a plant that "
                "moves by itself, with n, p, swap, start and advance, such as MuJoCoPlant(biped), and a model"
            )
        super().__post_init__()
        check_swap(self.plant)
        felt = self.touchdown is not None and self.touchdown.needs_force
        if felt and not isinstance(self.plant, protocols.OnFeet):
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
        """Two numbers for a quick test, which is sufficient and not necessary: all angles are within their
        bounds where the sum of their squares is below the first [rad^2], and all rates where the sum of squares
        of the plant's whole row (q, q', own) is below the second."""
        return self.bounds.farthest**2, float(np.min(self.bounds.fastest)) ** 2

    @property
    def own(self) -> int:
        """How many numbers of its own the plant keeps behind (q, q') in its row, found by starting it once."""
        still = np.zeros(self.plant.n)
        return len(started(self.plant, 0.0, still, still, None)) - 2 * self.plant.n

    def own_places(self, x: Array) -> slice:
        """The slice of a state x (nx,) with the plant's own numbers."""
        # the tail is what stands behind the controller's state
        return self.layout_of(x).place("tail", "own")

    def initial_state(self, q: Array, v: Array, mode: Mode | None = None) -> Array:
        """x (nx,) at the start of the single support `mode` (by default the first one, at 0 s) in q (n,) [rad],
        v (n,) [rad/s], with the row of the plant started there, which needs k = self.own numbers of its own."""
        x, mode = super().initial_state(q, v, mode), Mode() if mode is None else mode
        n = self.plant.n
        return self.with_plant(x, started(self.plant, mode.start, x[:n], x[n : 2 * n], self.own))

    def run(self, x0: Array, options: RunOptions, mode: Mode | None = None) -> Trajectory:
        """Run the loop from x0 (nx,) in the single support `mode`, by default the first one, at 0 s; the status
        of the result says how it ended. Raises InputError for an x0 that does not fit the loop."""
        mode, n = Mode() if mode is None else mode, self.plant.n
        x = numbers(x0, "the initial state")
        options.check(x)
        # handing_out() raises an exception of the user's controller again, as an error that names its line.
        # the layout follows from q and v alone, so zeros replace an x that is too short to have them
        with handing_out(), np.errstate(over="ignore", invalid="ignore"):
            expected = self.layout_of(x if len(x) >= 2 * n else np.zeros(2 * n)).size
        if len(x) != expected:
            raise InputError(
                f"the initial state has {len(x)} numbers, and a loop with {type(self.controller).__name__} has "
                f"{expected}; expected what initial_state(q, v) of this loop gives"
            )
        loop, engine = self.prepared(x)
        # engine: settings that name it. None: no method of integration, since the plant moves itself
        run = simulator.run(loop, x, mode, None, options)
        return replace(run, settings={**run.settings, **engine})

    def prepared(self, x: Array) -> tuple[SteppingLoop, dict[str, str]]:
        """The loop that runs from the state x (nx,), and what the trajectory's settings say of its engine:
        which one, and why not the compiled one. A subclass with machine code returns a copy of itself with it.
        """
        return self, {"engine": "pinocchio", "why": "the plant moves by itself"}

    def with_plant(self, x: Array, row: Array) -> Array:
        """A copy of x (nx,) in which the plant has the state `row` = (q, q', own) (2 n + k,); controller,
        sensors and torques stay as in x."""
        x, n = x.copy(), self.plant.n
        x[: 2 * n], x[self.own_places(x)] = row[: 2 * n], row[2 * n :]
        return x

    def row(self, x: Array) -> Array:
        """The plant's row (q, q', own) (2 n + k,) in x (nx,), read-only."""
        return frozen(np.concatenate((x[: 2 * self.plant.n], x[self.own_places(x)])))

    def mover(self, fired: str | None) -> Mover:
        """The function that moves the loop: always `move`, whichever event `fired` ended the arc before."""
        return self.move

    def record(self, every: int) -> Stretches:
        """A recorder for one arc, which keeps both ends of every stretch; `every` has no effect."""
        return Stretches(every, loop=self)

    def move(
        self, t: float, x: Array, mode: Mode, until: float, record: Stretches
    ) -> tuple[float, Array, FoundEvent | None]:
        """Move over one stretch, from x (nx,) at t [s] to `until` [s] or to the first contact
        (`hybrid.system.Mover`).

        Returns the time [s] and state (nx,) at its end, just before a contact, and the event of the contact or
        None. The end is recorded in `record`, unless the state there is not finite (raises NotFiniteError) or
        beyond the bounds (raises RanAwayError).
        """
        # near, slow: bounds of sums of squares, see below; the last p numbers of x are the torque of the motors
        n, (near, slow), u = self.plant.n, self.squares, x[-self.plant.p :]
        # the record has the row where the last stretch of this arc ended; x has it where the arc begins
        row = record.rows[-1] if record.rows else self.row(x)
        u.setflags(write=False)  # the plant gets it, and must not write into x
        # the load in the middle of the stretch, at the state of its start
        load = None if self.disturbance is None else self.load(0.5 * (t + until), row, mode)
        # after: the plant's row at the end; landed: its row just after the contacts there, None without
        end, after, contacts, landed = advanced(self.plant, t, row, u, load, until)
        # only now: a stretch on which the plant raises an error is not recorded
        record.begin(t, row, x, mode)
        row, q = after, after[:n]
        # all angles and rates pass at once where these sums are small; else, or with NaN, each is looked at
        if not (q.dot(q) < near and row.dot(row) < slow):
            if not np.all(np.isfinite(row)):
                raise NotFiniteError(f"the state of the plant is not finite after t = {t:.6g} s")
            self.bounds.check(end, q, row[n : 2 * n])
        record.point(end, row, mode)
        x = self.with_plant(x, row)
        return end, x, self.found(end, x, mode, contacts, landed) if contacts else None

    def load(self, t: float, row: Array, mode: Mode) -> Load:
        """The forces from outside on the plant in the state `row` (2 n + k,) at t [s], read-only."""
        n = self.plant.n
        zeta = self.external(t, frozen(row[:n]), frozen(row[n : 2 * n]), mode)
        return frozen(Load(zeta, self.resultant(t, mode)))

    @cached_property
    def pushed_in_python(self) -> bool:
        """Whether Python computes zeta at each end of a stretch during the run, so that an exception of the
        disturbance ends the run there. If not, none acts or it is compiled: `zetas` has it at an arc's end."""
        return self.disturbance is not None

    def zetas(self, t: Array, rows: Array, mode: Mode) -> Array:
        """zeta (K, n) [N m] at K times t (K,) [s], in the plant's rows (K, 2 n + k): zero, as it is called only
        without a disturbance; the subclass with a compiled disturbance overrides it."""
        return np.zeros((len(t), self.plant.n))

    def motor_torque(self, x: Array) -> Array:
        """Torque on the joints (.., p) [N m] in states x (.., nx): the torque that is asked of the motors, or
        for motors with a lag the one that the plant keeps."""
        plant, u = cast("Any", self.plant), x[..., -self.plant.p :]
        if not getattr(plant, "lag", 0.0):  # isinstance of a protocol took a fifth of a walk
            return u
        return plant.motor_torque(x[..., self.own_places(x)], u)

    def foot_forces(self, t: float, q: Array, v: Array, tail: Tail, mode: Mode) -> FootForces:
        """Vertical forces of the ground on stance and swing foot [N], by the plant's own `footing`, at t [s], q
        (n,) [rad], v (n,) [rad/s], under the torque in `tail`."""
        # tail: the part of x behind the controller's state, with the plant's own numbers and the torques (line)
        plant, row = cast("Any", self.plant), np.concatenate((q, v, tail.own))
        # (2, 2): rows of the stance and the swing foot, columns of x and z
        forces = plant.footing(row, motor_torque(tail.line), self.load(t, row, mode)).force
        return float(forces[0, 1]), float(forces[1, 1])

    def found(
        self, t: float, x: Array, mode: Mode, contacts: tuple[Contact, ...], row: Array | None
    ) -> FoundEvent:
        """The event of the contacts at t [s]: after a touchdown with x+ (nx,), in which the controller has
        jumped; with its status where a contact ends the run.

        x (nx,): the state just before. row (2 n + k,): the plant's state just after; None where a contact ends
        the run. Raises NotFiniteError for an impulse or a state after it that is not finite.
        """
        # all contacts as one: names joined, impulses added
        name, impulse, ends = _together(contacts)
        if ends is not None:
            return FoundEvent(Event(name, t, x, None), None, ends)
        n = self.plant.n
        # returned: checks the shape; numbers that are not finite have an error of their own below
        row = returned(row, self.row(x).shape, self.plant, "advance", finite=False)
        if not np.all(np.isfinite([*row, *impulse])):
            what = f"{name} at t = {t:.6g} s: its impulse or the state after it"
            raise NotFiniteError(f"{what} is not finite")
        after = Mode(mode.step + 1, t)
        x_plus = after_contact(self, t, x, row[:n], row[n : 2 * n], after)
        # after_contact sets q and v of the plant; here its own numbers after the contact are set too
        x_plus = self.with_plant(x_plus, row)
        return FoundEvent(Event(name, t, x, x_plus), (x_plus, after))


def check_swap(plant: SteppingPlant) -> None:
    """Raise InputError where `swap` of a plant is no relabelling of its p motors: joint i gets entry swap[i] of
    (y, -y), so each joint is named once, by its number from 0, or by that plus p for a change of sign."""
    swap = np.asarray(plant.swap)
    if swap.dtype.kind != "i" or sorted(swap - plant.p * (swap >= plant.p)) != [*range(plant.p)]:
        raise InputError(
            f"{type(plant).__name__}.swap is {plant.swap!r}, expected an array of int with each of the numbers "
            f"0 to {plant.p - 1} once, plus {plant.p} where an angle changes its sign"
        )


def started(plant: SteppingPlant, t: float, q: Array, v: Array, own: int | None) -> Array:
    """The row (2 n + k,) that `plant.start` returns at t [s] for q (n,) [rad], v (n,) [rad/s], checked. own:
    how many numbers of its own (k) it must have; None accepts any. Raises InputError where the row does not
    begin with q and v."""
    found = plant.start(t, read_only(q), read_only(v))
    shape = None if own is None else (2 * len(q) + own,)
    row = returned(found, shape, plant, "start", finite=False).copy()
    if not np.array_equal(row[: 2 * len(q)], (*q, *v)):
        raise InputError(
            f"{type(plant).__name__}.start gives {row}, expected a row that begins with the q = {q}, v = {v} "
            "that it was given"
        )
    return row


def advanced(
    plant: SteppingPlant, t: float, row: Array, u: Array, load: Load | None, until: float
) -> tuple[float, Array, tuple[Contact, ...], Array | None]:
    """Call `plant.advance` from `row` at t [s] under torques u (p,) [N m] and load, and check the result.

    Returns the time [s], a copy of the row there, the contacts, and the row after them (None without). A time
    within round-off of `until` [s] becomes `until`. Raises InputError for what breaks the contract of
    `protocols.SteppingPlant`; `found` checks the row after the contacts.
    """
    moved = plant.advance(t, row, u, load, until)
    if type(moved) is not protocols.Moved or type(moved.contacts) is not tuple:
        raise InputError(
            f"{type(plant).__name__}.advance gives {moved!r:.60}, expected a Moved(t, row, contacts, after)"
        )
    end, found, contacts, after = moved
    # it has to come to `until`, unless a contact stops it before
    if not (at_end := abs(end - until) <= _ROUND_OFF) and not (contacts and t < end < until):
        here = f"a contact at {end} s, expected after {t} s, not after {until} s"
        here = here if contacts else f"{end} s without a contact, expected {until} s"
        raise InputError(f"{type(plant).__name__}.advance came to {here}")
    found = returned(found, row.shape, plant, "advance", finite=False).copy()
    found.setflags(write=False)
    return until if at_end else end, found, contacts, after


def _together(contacts: tuple[Contact, ...]) -> Contact:
    """Contacts at one time as one: names joined by +, impulses added; where some of them end the run, those
    alone count, with the status of the first."""
    ends = tuple(contact for contact in contacts if contact.ends is not None)
    names, impulses, statuses = zip(*(ends or contacts), strict=True)
    # dict.fromkeys: each name once, in order
    return Contact("+".join(dict.fromkeys(names)), np.sum(impulses, axis=0), statuses[0])


@dataclass
class Stretches(Recorder):
    """The record of one arc, stretch after stretch: each from a sample instant or switching time to the next.

    Lists grow with every stretch and become arrays once per arc, in `arc`, since a stretch costs microseconds.
    `t` has the times [s] of `rows`.
    """

    loop: SteppingLoop = field(kw_only=True)
    rows: list[Array] = field(default_factory=list)
    """The plant's row (2 n + k,) where the arc begins, and at the end of every stretch."""
    zeta: list[Array] = field(default_factory=list)
    """The disturbance (n,) [N m] at these instants, where Python computes it."""
    held: list[Array] = field(default_factory=list)
    """The loop's state x (nx,) at the start of every stretch; all but its row is held until the next one."""

    def begin(self, t: float, row: Array, x: Array, mode: Mode) -> None:
        """Record that a stretch begins at t [s], in the plant's row (2 n + k,) and the state x (nx,). Its row
        is recorded only for the first stretch: any other begins where the one before has ended."""
        if not self.rows:
            self.point(t, row, mode)
        self.held.append(x)

    def point(self, t: float, row: Array, mode: Mode) -> None:
        """Record that the plant is in the row (2 n + k,) at t [s], an end of a stretch, and zeta there where
        Python computes it."""
        if self.loop.pushed_in_python:
            self.zeta.append(self.loop.load(t, row, mode).zeta)
        self.t.append(t)
        self.rows.append(row)

    def arc(self, mode: Mode, event: Event | None) -> Arc:
        """Join all stretches into one arc, whose nodes are both ends of each stretch; a stretch that failed has
        its start alone. The arc also has the motors' torque "u" (p,) and "zeta" (n,) [N m] at its nodes. q'' is
        constant over a stretch, the difference of the rates by its duration, as the plant does not compute
        it."""
        if not self.rows:  # no stretch has begun: what the base class has recorded
            return super().arc(mode, event)
        n, t, rows = self.loop.plant.n, np.array(self.t), np.array(self.rows)
        # K stretches have K starts in `held` and K + 1 rows, or K rows where the last stretch failed; their
        # nodes are 2 K, or 2 K - 1
        nodes = len(self.held) + len(t) - 1
        # node -> its stretch 0 0 1 1 2 2 .., and its index in `rows` 0 1 1 2 2 3 ..
        of = np.repeat(np.arange(len(self.held)), 2)[:nodes]
        at, v = of + np.arange(nodes) % 2, rows[:, n : 2 * n]
        # q'' (K, n) of each stretch; the last row of zeros is for a stretch that failed
        a = np.vstack((np.diff(v, axis=0) / np.diff(t)[:, np.newaxis], np.zeros(n)))
        x = np.array(self.held)[of]
        x[:, : 2 * n], x[:, self.loop.own_places(x[0])] = rows[at, : 2 * n], rows[at, 2 * n :]
        dx = np.zeros_like(x)
        dx[:, :n], dx[:, n : 2 * n] = v[at], a[of]
        zeta = np.array(self.zeta) if self.zeta else self.loop.zetas(t, rows, mode)
        read = {"u": self.loop.motor_torque(x), "zeta": zeta[at]}
        return Arc(mode, t[at], x, dx, event, read)
