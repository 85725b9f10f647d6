"""The loop over the arcs of a hybrid system: flow with sample instants, event, reset, next arc.

An arc is the flow from one event to the next, a node a stored instant (t, x, x') of it; to fly an arc is to
integrate it. The discrete state `mode` is constant over an arc, and its meaning is known to the system alone.
`run_arcs` is the loop for both engines: in Python `flow_arc` flies an arc, by the march (`hybrid.march`), and
in the compiled engine a compiled loop does (`engine.run`). A system that moves by itself, such as another
simulator, has a function `Mover` in place of a flow.
"""

import math
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.core import errors
from biped_adrc.core.checks import handing_out, sentence_of
from biped_adrc.core.errors import InputError, check_count
from biped_adrc.core.types import Array
from biped_adrc.hybrid.constants import CROWD, EVENT_LIMIT, STEP_FAILED, TOGETHER
from biped_adrc.hybrid.integrators import OneStepMethod, StepFailed
from biped_adrc.hybrid.march import arm, travel
from biped_adrc.hybrid.on_arrays import Calendar, Run
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.system import AnyMode, HybridSystem, JumpResult
from biped_adrc.hybrid.trajectory import Arc, Event, Trajectory

Progress = Callable[[float, int], None]
"""Called after every event with the time [s] and the number of events so far."""


@dataclass(frozen=True)
class RunOptions:
    """Duration of a run, its other ends, and what is stored of it."""

    t_end: float
    """Latest end [s]."""
    t0: float = 0.0
    """Start [s]."""
    stop_after: tuple[str, int] | None = None
    """(guard, count): end after that many events of that guard; then reaching t_end first is a TIME_OUT."""
    max_events: int = 100_000
    """A run with so many events ends as EVENT_LIMIT: events that accumulate (Zeno) would never end."""
    store_every: int = 1
    """Every so many integration steps one node (t, x, x') is kept for dense output; 1 keeps all."""
    progress: Progress | None = None
    """Function that is called after every event; None for none."""

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
        """How the run ends after an event at t [s]; None where it goes on. events: name -> number so far."""
        if self.stop_after is not None and events[self.stop_after[0]] >= self.stop_after[1]:
            return Status.COMPLETED
        if events.total() >= self.max_events:
            return Status.EVENT_LIMIT
        return self.timed_out if t >= self.t_end else None

    @property
    def timed_out(self) -> Status:
        """The status of a run that has come to t_end: TIME_OUT where it waits for events."""
        return Status.COMPLETED if self.stop_after is None else Status.TIME_OUT


class FlownArc(NamedTuple):
    """One arc, how it ended, and (x+, mode+) after an event that is not the run's end."""

    arc: Arc
    status: Status
    """COMPLETED also where the run goes on."""
    detail: str = ""
    """The text of the error that ended the arc; empty without one."""
    outcome: JumpResult = None
    """None where the run ends with this arc."""


Flight = Callable[[float, Array, AnyMode, Event | None], FlownArc]
"""fly(t, x, mode, event that ended the arc before) integrates one arc. It also finds (x+, mode+) after its
event, from which the next arc starts."""


def simulate(
    system: HybridSystem, x0: Array, mode: AnyMode, method: OneStepMethod, **options: Any
) -> Trajectory:
    """Run a hybrid system from (t0, x0, mode); returns its arcs with a status.

    system: such as a Walker. x0 (nx,): its state at the start, in SI units. mode: its discrete state there, as
    `Mode()`. method: of integration. options: those of `RunOptions`, of which t_end [s] is required. Raises
    InputError for a start that is not finite or a duration that is not positive. Whatever happens during the
    run is in the trajectory's status.

    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    >>> x0 = walker.initial_state(*gait.start(biped))
    >>> ba.simulate(walker, x0, ba.Mode(), ba.RK4(1e-3), t_end=0.1).status.name
    'COMPLETED'
    """
    return run(system, x0, mode, method, RunOptions(**options))


def run(
    system: HybridSystem,
    x0: Array,
    mode: AnyMode,
    method: OneStepMethod | None,
    options: RunOptions,
) -> Trajectory:
    """Simulate a system from x0 (nx,) in `mode`, with the options as one record.

    method: of integration; None for a system that moves by itself (`HybridSystem.mover`).
    """
    label = "steps of the plant's own" if method is None else method.label
    return run_arcs(partial(flow_arc, system, method, options), x0, mode, label, options)


def run_arcs(fly: Flight, x0: Array, mode: AnyMode, label: str, options: RunOptions) -> Trajectory:
    """Run from x0 (nx,) in `mode`, arc after arc, until an end of `options` or a failure.

    fly: integrates each arc; events are counted here. label: name of the method, for the trajectory's settings.
    """
    x, t = np.array(x0, dtype=float), options.t0
    options.check(x)
    arcs, events = list[Arc](), Counter[str]()
    event: Event | None = None
    while True:
        # an overflow gives no warning, since it ends the run as NOT_FINITE; `handing_out` adds class and line
        # to an exception of the user's code
        with handing_out(), np.errstate(over="ignore", invalid="ignore"):
            # finite_part cuts the arc before its first number that is not finite
            flown = finite_part(fly(t, x, mode, event))
        arcs.append(flown.arc)
        event, status = flown.arc.event, flown.status
        if flown.outcome is None or event is None:
            # COMPLETED here means that no failure ended the arc: it has come to t_end, or to a final event
            status = options.timed_out if status is Status.COMPLETED else status
            break
        t, (x, mode) = event.t, flown.outcome
        events[event.guard] += 1
        if options.progress is not None:
            options.progress(t, len(arcs))
        # CROWD events within the time TOGETHER accumulate, as in Zeno's paradox
        crowded = len(arcs) > CROWD and t - arcs[-CROWD].t[-1] < TOGETHER
        ended = Status.EVENT_LIMIT if crowded else options.ended(t, events)
        if ended is not None:
            status = ended
            break
    return Trajectory(tuple(arcs), status, flown.detail, {"method": label})


def finite_part(flown: FlownArc) -> FlownArc:
    """The arc up to the node before the first t, x or x' that is not finite, without its event, and a failure
    as status; an arc whose numbers are all finite is returned as it is.
    """
    arc, event = flown.arc, flown.arc.event
    rows, states = (arc.t, arc.x, arc.dx), () if event is None else (event.x_minus, event.x_plus)
    if all(x is None or np.isfinite(x).all() for x in (*rows, *states)):
        return flown
    # each: by node, whether t, x and x' are finite; good: True up to the first node where one of them is not
    each = [np.isfinite(x.reshape(len(arc.t), -1)).all(axis=1) for x in rows]
    good = np.logical_and.accumulate(np.all(each, axis=0))
    if not good[0]:  # what an arc starts from is finite, its slope may not be
        good[0], arc = True, replace(arc, dx=np.zeros_like(arc.dx))
    # read: signals that were recorded at the nodes, by name
    read = {name: rows[good] for name, rows in arc.read.items()}
    kept = replace(arc, t=arc.t[good], x=arc.x[good], dx=arc.dx[good], event=None, read=read)
    detail = flown.detail or f"the state or its slope is not finite after t = {kept.t[-1]:.6g} s"
    # FAILURES: statuses of a run that failed, which say more than NOT_FINITE
    lost = flown.status if flown.status in FAILURES else Status.NOT_FINITE
    return FlownArc(kept, lost, detail)


FAILURES: Mapping[Status, type[Exception]] = {
    Status.NOT_FINITE: errors.NotFiniteError,
    Status.RAN_AWAY: errors.RanAwayError,
    Status.SINGULAR: errors.SingularError,
    Status.STEP_FAILED: StepFailed,
}
"""The errors that end a run with a status in place of being raised."""


def status_of(error: BaseException, begun: bool = True) -> tuple[Status, str]:
    """The status and the text with which a run ends when a controller or another part of the system raises
    `error`.

    An error of `FAILURES` has its status there, any other of the user's code RAISED. The error is raised again
    where it comes from elsewhere, as Ctrl-C, and where the arc has not `begun`: an error at its first sample
    instant is a mistake in the user's class.
    """
    for status, kind in FAILURES.items():
        if isinstance(error, kind):
            return status, str(error)
    if not (begun and isinstance(error, Exception)):
        raise error
    detail = str(error) if isinstance(error, InputError) else sentence_of(error)
    # no line of the user's code was running: a mistake in this package, which is not hidden
    if not detail:
        raise error
    return Status.RAISED, detail


def flow_arc(
    system: HybridSystem,
    method: OneStepMethod | None,
    options: RunOptions,
    t: float,
    x: Array,
    mode: AnyMode,
    fired: Event | None,
    began: float | None = None,
) -> FlownArc:
    """Integrate one arc in Python from x (nx,) at t [s], to an event, to t_end, or to an error, which becomes a
    status.

    method: None for a system with a `Mover`. fired: the event that ended the arc before, None at the start.
    began [s]: time at which the arc began, where (t, x) is in the middle of one; None: it begins at t. An arc
    that fails before its first node has its start as the only node, with the slope zero.
    """
    # result: the `FoundEvent` that ended the arc, None without one
    record, result = system.record(options.store_every), None
    status, detail = Status.COMPLETED, ""
    # calendar: sample instants, switching times and latest end; move: None for a system that has a flow
    calendar = Calendar(system, mode, t if began is None else began, options.t0, options.t_end)
    move = system.mover(fired.guard if fired else None)
    run = None
    # arm: compute the event functions at the start; outside of `try`, so an error there is raised
    if move is None:
        assert method is not None
        run = Run(calendar, method, record, t, x, fired)
        arm(run)
    try:
        if run is not None:
            code = travel(run)
            if code == STEP_FAILED:
                raise StepFailed(f"no step from t = {run.t:.6g} s on")
            # an event has its status in run.event, and the end of the time is no failure
            status = Status.EVENT_LIMIT if code == EVENT_LIMIT else status
            result = run.event
        while move is not None and t < options.t_end and result is None:
            x = calendar.due(t, x)
            t, x, result = move(t, x, mode, calendar.next_break(t), record)
    except Exception as error:
        status, detail = status_of(error, begun=bool(record.t))
    if not record.t:
        record.add(t, x, np.zeros_like(x))
    if result is None:
        return FlownArc(record.arc(mode, None), status, detail)  # None: no event
    return FlownArc(record.arc(mode, result.event), result.status, "", result.outcome)
