"""The simulation loop of a hybrid system in Python: step, locate the event, reset, sample, repeat.

Every arc starts with the clock updates that are due, flows to the next switching time or sample
instant, and ends at the first event. Events are located by Brent's method on the step itself, taken
again with a shorter length, so that x- has the accuracy of the method and not of an interpolant. At
breaks the flow is asked for its limit from the left.

`run_arcs` is shared: the Python engine flies an arc with `flow_arc`, the compiled one with a
kernel (`engine.simulate`). Systems that move by themselves give a `Mover` in place of a flow.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.errors import InputError, NotFiniteError, RanAwayError, SingularError, check_count
from biped_adrc.hybrid.integrators import Form, OneStepMethod, Step, StepFailed
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.system import Clock, FoundEvent, HybridSystem, Mode, Outcome, Split
from biped_adrc.hybrid.trajectory import Arc, Event, Trajectory
from biped_adrc.hybrid.watch import Watch, interior
from biped_adrc.parts import handing_out, sentence_of
from biped_adrc.types import Array

Progress = Callable[[float, int], None]
"""Called after every event with the time [s] and the number of events so far."""


@dataclass
class Record:
    """Nodes of the arc being built: one by one, or many in rows.

    every: each k-th step is kept; the lists t [s], x (nx,) or (K, nx), dx likewise, and `read` by
    name grow with every call; skipped: steps since the last one kept.
    """

    every: int
    t: list[float | Array] = field(default_factory=list)
    x: list[Array] = field(default_factory=list)
    dx: list[Array] = field(default_factory=list)
    read: dict[str, list[Array]] = field(default_factory=dict)
    skipped: int = 0

    def add(self, t: float | Array, x: Array, dx: Array, **read: Array) -> None:
        """One node t [s], x (nx,), dx (nx,), or K of them in K rows of each; and what was read there."""
        self.t.append(t)
        self.x.append(x)
        self.dx.append(dx)
        for name, rows in read.items():
            self.read.setdefault(name, []).append(rows)
        self.skipped = 0

    def step(self, step: Step, last: bool) -> None:
        """Store the end of a step, or skip it when only every k-th is kept; `last` is always kept.

        Of a step longer than RESOLUTION interior points are stored too: dense output is a cubic,
        and a long step of a high-order method is not.
        """
        self.skipped += 1
        if last or self.skipped >= self.every:
            for t in interior(step.t0, step.t1)[:-1]:
                self.add(t, step.at(t), slope_of(step, t))
            self.add(step.t1, step.x1, step.dx1)

    def arc(self, mode: Mode, event: Event | None) -> Arc:
        """All nodes as one arc that ran in `mode` and ended in `event`."""
        read = {name: np.vstack(rows) for name, rows in self.read.items()}
        return Arc(mode, np.hstack(self.t), np.vstack(self.x), np.vstack(self.dx), event, read)


def slope_of(step: Step, t: float) -> Array:
    """x'(t) (nx,) inside a step, t in [s], by central difference of the step's own states."""
    d = 1e-4 * (step.t1 - step.t0)
    return (step.at(t + d) - step.at(t - d)) / (2.0 * d)


@dataclass(frozen=True)
class RunOptions:
    """How long a run goes on and what is kept of it."""

    t_end: float
    """Latest end [s]."""
    t0: float = 0.0
    """Start [s]."""
    stop_after: tuple[str, int] | None = None
    """(guard, count): end after that many events of that guard; then reaching t_end first is a TIME_OUT."""
    max_events: int = 100_000
    """A run with so many events ends as EVENT_LIMIT: events that accumulate (Zeno) would never end."""
    store_every: int = 1
    """Keep each k-th step for dense output."""
    progress: Progress | None = None
    """Told of every event."""

    def check(self, x: Array) -> None:
        """Raise InputError for a run from x (nx,) that cannot begin."""
        if x.ndim != 1 or not np.all(np.isfinite(x)):
            raise InputError(f"the initial state is {x}, expected a vector of finite numbers")
        if not (math.isfinite(self.t_end) and math.isfinite(self.t0) and self.t_end > self.t0):
            raise InputError(
                f"the run would go from {self.t0} s to {self.t_end} s; expected a positive duration"
            )
        if self.stop_after is not None:
            check_count(self.stop_after[1], f"stop_after asks for {self.stop_after[1]} events")
        check_count(self.store_every, f"store_every is {self.store_every}")

    def ended(self, t: float, events: Counter[str]) -> Status | None:
        """How the run ends after these events, the last of them at t [s]; None where it goes on."""
        if self.stop_after is not None and events[self.stop_after[0]] >= self.stop_after[1]:
            return Status.COMPLETED
        if events.total() >= self.max_events:
            return Status.EVENT_LIMIT
        return self.timed_out if t >= self.t_end else None

    @property
    def timed_out(self) -> Status:
        """The status of a run that has come to t_end."""
        return Status.COMPLETED if self.stop_after is None else Status.TIME_OUT


class FlownArc(NamedTuple):
    """One arc, how it ended, and (x+, mode+) after an event that is not the run's end."""

    arc: Arc
    status: Status
    """COMPLETED also where the run goes on."""
    detail: str = ""
    """The error's own text, where one ended it."""
    outcome: Outcome = None
    """None where the run ends with this arc."""


def simulate(
    system: HybridSystem,
    x0: Array,
    mode: Mode,
    method: OneStepMethod,
    **options: Any,
) -> Trajectory:
    """Run `system` from (t0, x0, mode), x0 (nx,).

    options are those of `RunOptions`, of which t_end has to be given. Raises InputError for a start
    that is not finite or a duration that is not positive. Whatever happens during the run is in the
    trajectory's status.
    """
    return run(system, x0, mode, method, RunOptions(**options))


def run(
    system: HybridSystem, x0: Array, mode: Mode, method: OneStepMethod | None, options: RunOptions
) -> Trajectory:
    """As `simulate`, from x0 (nx,) with options as a record; a system with a mover needs no method."""
    label = "steps of the plant's own" if method is None else method.label
    return run_arcs(partial(flow_arc, system, method, options), x0, mode, label, options)


def run_arcs(
    fly: Callable[[float, Array, Mode, str | None], FlownArc],
    x0: Array,
    mode: Mode,
    label: str,
    options: RunOptions,
) -> Trajectory:
    """A run from x0 (nx,), arc after arc made by fly(t, x, mode, name of the guard that has just fired).

    label: of the method, for the settings. Counts events, applies resets and decides when the run
    is over. Overflow is no warning here: a state that is not finite ends the run as NOT_FINITE and
    is not kept, whatever flew the arc.
    """
    x, t = np.array(x0, dtype=float), options.t0
    options.check(x)
    arcs, events = list[Arc](), Counter[str]()
    fired: str | None = None
    while True:
        # what overflows ends as the status NOT_FINITE
        with handing_out(), np.errstate(over="ignore", invalid="ignore"):
            flown = finite(fly(t, x, mode, fired))
        arcs.append(flown.arc)
        event, status = flown.arc.event, flown.status
        if flown.outcome is None or event is None:
            status = options.timed_out if status is Status.COMPLETED else status
            break
        t, (x, mode), fired = event.t, flown.outcome, event.guard
        events[fired] += 1
        if options.progress is not None:
            options.progress(t, len(arcs))
        ended = options.ended(t, events)
        if ended is not None:
            status = ended
            break
    return Trajectory(tuple(arcs), status, flown.detail, {"method": label})


def finite(flown: FlownArc) -> FlownArc:
    """The arc up to its last node that is finite, and without an event whose states are not."""
    arc, event = flown.arc, flown.arc.event
    rows = (arc.t[:, np.newaxis], arc.x, arc.dx)
    good = np.logical_and.accumulate(np.all([np.all(np.isfinite(a), axis=1) for a in rows], axis=0))
    states = () if event is None else (event.x_minus, event.x_plus)
    if good[-1] and all(x is None or np.all(np.isfinite(x)) for x in states):
        return flown
    if not good[0]:  # what an arc starts from is finite, its slope may not be
        good[0], arc = True, replace(arc, dx=np.zeros_like(arc.dx))
    read = {name: rows[good] for name, rows in arc.read.items()}
    kept = replace(arc, t=arc.t[good], x=arc.x[good], dx=arc.dx[good], event=None, read=read)
    detail = flown.detail or f"the state or its slope is not finite after t = {kept.t[-1]:.6g} s"
    lost = flown.status if flown.status in FAILURES else Status.NOT_FINITE
    return FlownArc(kept, lost, detail)


FAILURES: Mapping[Status, type[Exception]] = {
    Status.NOT_FINITE: NotFiniteError,
    Status.RAN_AWAY: RanAwayError,
    Status.SINGULAR: SingularError,
    Status.STEP_FAILED: StepFailed,
}
"""The errors that end a run with a status in place of being raised."""


def flow_arc(
    system: HybridSystem,
    method: OneStepMethod | None,
    options: RunOptions,
    t: float,
    x: Array,
    mode: Mode,
    fired: str | None,
    began: float | None = None,
) -> FlownArc:
    """One arc from (t, x) in Python: clock updates and moves until an event, t_end, or an error of
    `FAILURES`.

    fired: the event that ended the arc before. began [s]: where the arc did, for what goes on from
    the middle of one. An arc that fails before its first node keeps its start.
    """
    record, t_arc, found = Record(options.store_every), t if began is None else began, None
    status, detail = Status.COMPLETED, ""
    move = system.mover(fired)
    if move is None:
        assert method is not None
        watch = Watch(system.guards(mode), t, x, fired)
        move = _Steps(system, method, method.split(system, mode), watch)
    try:
        while t < options.t_end and found is None:
            x = _tick(system.clocks(), t, t_arc, options.t0, x, mode)
            t_next = _next_break(system, mode, t, t_arc, options.t0, options.t_end)
            t, x, found = move(t, x, mode, t_next, record)
    except tuple(FAILURES.values()) as error:
        status = next(s for s, kind in FAILURES.items() if isinstance(error, kind))
        detail = str(error)
    except Exception as error:
        detail = str(error) if isinstance(error, InputError) else sentence_of(error)
        if not (detail and record.t):
            raise
        status = Status.RAISED
    if not record.t:
        record.add(t, x, np.zeros_like(x))
    if found is None:
        return FlownArc(record.arc(mode, None), status, detail)
    return FlownArc(record.arc(mode, found.event), found.status, "", found.outcome)


@dataclass(frozen=True)
class _Steps:
    """Moves a system over one arc by the steps of a one-step method, and watches its event functions."""

    system: HybridSystem
    method: OneStepMethod
    split: Form | None
    watch: Watch

    def __call__(
        self, t: float, x: Array, mode: Mode, until: float, record: Record
    ) -> tuple[float, Array, FoundEvent | None]:
        """To `until` [s] or the first event, as `system.Mover`; nodes go into `record`."""
        for step in self.steps(t, x, mode, until, record):
            found = self.watch.first(step)
            if found is not None:
                te, xe = found.event.t, found.event.x_minus
                record.add(te, xe, self.system.flow(math.nextafter(te, -math.inf), xe, mode))
                return te, xe, found
            record.step(step, last=step.t1 >= until)
            t, x = step.t1, step.x1
        return t, x, None

    def steps(self, t: float, x: Array, mode: Mode, until: float, record: Record) -> Iterator[Step]:
        """Steps from (t, x) to `until` [s]; the flow is asked for its limit from the left there.

        Raises NotFiniteError after a step to a state that is not finite, RanAwayError after one to
        a state beyond what the system can have.
        """
        just_before = math.nextafter(until, -math.inf)
        split = _until(self.split, just_before) if isinstance(self.split, Split) else self.split
        first = True

        def f(s: float, y: Array) -> Array:
            return self.system.flow(min(s, just_before), y, mode)

        for step in self.method.steps(f, split, t, x, until):
            if first:
                record.add(step.t0, step.x0, step.dx0)
                first = False
            if not math.isfinite(step.x1.dot(step.x1)):
                raise NotFiniteError(f"the state is not finite after t = {step.t0:.6g} s")
            self.system.check_state(step.t1, step.x1)
            yield step


def _until(split: Split, last: float) -> Split:
    """The split with no time after `last` [s] asked for, so that a step that ends at a break sees
    its left limit.
    """
    return replace(split, remainder=lambda t, p, E: split.remainder(min(t, last), p, E))


def _ticks(clock: Clock, t_arc: float, t_first: float) -> float:
    """Time [s] of the first sample instant of a clock in this arc."""
    return (t_arc if clock.restart else t_first) + clock.offset


def _tick(
    clocks: tuple[Clock, ...], t: float, t_arc: float, t_first: float, x: Array, mode: Mode
) -> Array:
    """x (nx,) after the updates of all clocks that are due at t [s], in the order of the system's clocks.

    A clock is due where t equals start + k period exactly; breaks are computed by the same
    expression.
    """
    for clock in clocks:
        start = _ticks(clock, t_arc, t_first)
        k = round((t - start) / clock.period)
        if k >= 0 and t == start + k * clock.period:
            x = clock.update(t, x, mode)
    return x


def _next_break(
    system: HybridSystem, mode: Mode, t: float, t_arc: float, t_first: float, t_end: float
) -> float:
    """The first switching time or sample instant after t [s], at most t_end: no step goes across one."""
    times = [s for s in system.switching_times(mode) if s > t]
    for clock in system.clocks():
        start = _ticks(clock, t_arc, t_first)
        k = max(0, math.floor((t - start) / clock.period))
        while start + k * clock.period <= t:
            k += 1
        times.append(start + k * clock.period)
    return min([*times, t_end])
