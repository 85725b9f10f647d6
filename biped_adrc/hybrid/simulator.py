"""The hybrid loop: step, locate the event, reset, tick, repeat.

Every arc starts with the ticks that are due, flows to the next switching time or tick, and ends at the
first event. Events are located by root finding on the step itself, taken again with a shorter length,
so that x- has the accuracy of the method.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from scipy.optimize import brentq

from biped_adrc.errors import InputError, NotFiniteError, SingularError, check_count
from biped_adrc.hybrid.integrators import Flow, OneStepMethod, Step, StepFailed
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.system import Clock, Guard, HybridSystem, Mode, Split
from biped_adrc.hybrid.trajectory import Arc, Event, Trajectory
from biped_adrc.types import Array

Progress = Callable[[float, int], None]
"""Called after every event with the time [s] and the number of events so far."""

RESOLUTION = 2e-3
"""Longest stretch [s] of a step over which a double crossing of a witness could pass unseen."""
_T_XTOL = 1e-15  # [s], tolerance of the event time


@dataclass
class _Recorder:
    """Nodes of the arc being built."""

    every: int
    t: list[float] = field(default_factory=list)
    x: list[Array] = field(default_factory=list)
    dx: list[Array] = field(default_factory=list)
    skipped: int = 0

    def add(self, t: float, x: Array, dx: Array) -> None:
        self.t.append(t)
        self.x.append(x)
        self.dx.append(dx)
        self.skipped = 0

    def step(self, step: Step, last: bool) -> None:
        """Store the end of a step, or skip it when only every k-th is kept."""
        self.skipped += 1
        if last or self.skipped >= self.every:
            for t in interior(step.t0, step.t1)[:-1]:
                self.add(t, step.at(t), slope_of(step, t))
            self.add(step.t1, step.x1, step.dx1)

    def arc(self, mode: Mode, event: Event | None) -> Arc:
        return Arc(mode, np.array(self.t), np.array(self.x), np.array(self.dx), event)


def interior(t0: float, t1: float) -> list[float]:
    """Times in (t0, t1] no further apart than RESOLUTION, the last one t1."""
    count = max(1, math.ceil((t1 - t0) / RESOLUTION - 1e-9))
    return [t0 + (t1 - t0) * k / count for k in range(1, count)] + [t1]


def slope_of(step: Step, t: float) -> Array:
    """x'(t) inside a step, by central difference of its own states."""
    d = 1e-4 * (step.t1 - step.t0)
    return (step.at(t + d) - step.at(t - d)) / (2.0 * d)


def simulate(
    system: HybridSystem,
    x0: Array,
    mode: Mode,
    method: OneStepMethod,
    *,
    t_end: float,
    t0: float = 0.0,
    stop_after: tuple[str, int] | None = None,
    max_events: int = 100_000,
    store_every: int = 1,
    progress: Progress | None = None,
) -> Trajectory:
    """Run `system` from (t0, x0, mode).

    t_end [s]: latest end. stop_after (guard, count): end after that many events of that guard; then
    reaching t_end first is a TIME_OUT. store_every: keep each k-th step for dense output.
    Raises InputError for a start that is not finite or a duration that is not positive. Whatever happens
    during the run is in the trajectory's status.
    """
    x = np.array(x0, dtype=float)
    check_start(x, t0, t_end, stop_after, store_every)
    arcs: list[Arc] = []
    counts: dict[str, int] = {}
    t, status, detail = t0, Status.COMPLETED, ""
    fired: str | None = None
    while True:
        with np.errstate(over="ignore", invalid="ignore"):  # ends as the status NOT_FINITE
            arc, status, detail, outcome = _flow_arc(
                system, method, t, t0, x, mode, t_end, store_every, fired
            )
        arcs.append(arc)
        if outcome is None:
            break
        event = arc.event
        assert event is not None
        t, (x, mode), fired = event.t, outcome, event.guard
        counts[event.guard] = counts.get(event.guard, 0) + 1
        if progress is not None:
            progress(t, sum(counts.values()))
        if stop_after is not None and counts.get(stop_after[0], 0) >= stop_after[1]:
            break
        if len(arcs) >= max_events:
            status = Status.EVENT_LIMIT
            break
        if t >= t_end:
            status = Status.COMPLETED if stop_after is None else Status.TIME_OUT
            break
    if outcome is None and status is Status.COMPLETED and stop_after is not None:
        status = Status.TIME_OUT
    return Trajectory(tuple(arcs), status, detail, {"method": method.label})


def check_start(
    x: Array, t0: float, t_end: float, stop_after: tuple[str, int] | None, store_every: int
) -> None:
    """Raise InputError for a run that cannot begin."""
    if x.ndim != 1 or not np.all(np.isfinite(x)):
        raise InputError(f"the initial state is {x}, expected a vector of finite numbers")
    if not (math.isfinite(t_end) and math.isfinite(t0) and t_end > t0):
        raise InputError(f"the run would go from {t0} s to {t_end} s; expected a positive duration")
    if stop_after is not None:
        check_count(stop_after[1], f"stop_after asks for {stop_after[1]} events")
    check_count(store_every, f"store_every is {store_every}")


Outcome = tuple[Array, Mode] | None


def _flow_arc(
    system: HybridSystem,
    method: OneStepMethod,
    t: float,
    t_first: float,
    x: Array,
    mode: Mode,
    t_end: float,
    store_every: int,
    fired: str | None,
) -> tuple[Arc, Status, str, Outcome]:
    """One arc from (t, x): returns it, the status so far, its detail, and (x+, mode+) after an event."""
    record = _Recorder(store_every)
    split = method.split(system, mode)
    t_arc, status, detail = t, Status.COMPLETED, ""
    watch = _Watch(system.guards(mode), t, x, fired)
    event: Event | None = None
    outcome: Outcome = None
    try:
        while t < t_end and event is None:
            x = _tick(system.clocks(), t, t_arc, t_first, x, mode)
            t_next = _next_break(system, mode, t, t_arc, t_first, t_end)
            for step in _segment(system, method, split, t, x, t_next, mode, record):
                found = watch.first(step)
                t, x = step.t1, step.x1
                if found is not None:
                    event, outcome, status = found
                    t, x = event.t, event.x_minus
                    record.add(t, x, system.flow(math.nextafter(t, -math.inf), x, mode))
                    break
                record.step(step, last=step.t1 >= t_next)
    except NotFiniteError as error:
        status, detail = Status.NOT_FINITE, str(error)
    except SingularError as error:
        status, detail = Status.SINGULAR, str(error)
    except StepFailed as error:
        status, detail = Status.STEP_FAILED, str(error)
    if not record.t:
        record.add(t, x, np.zeros_like(x))
    return record.arc(mode, event), status, detail, outcome


def _segment(
    system: HybridSystem,
    method: OneStepMethod,
    split: Split | None,
    t: float,
    x: Array,
    t_next: float,
    mode: Mode,
    record: _Recorder,
) -> Any:
    """Steps from (t, x) to t_next; the flow is asked for its limit from the left at t_next."""
    just_before = math.nextafter(t_next, -math.inf)

    def f(s: float, y: Array) -> Array:
        return system.flow(min(s, just_before), y, mode)

    clamped: Flow = f
    if split is not None:
        split = _until(split, just_before)
    first = True
    for step in method.steps(clamped, split, t, x, t_next):
        if first:
            record.add(step.t0, step.x0, step.dx0)
            first = False
        if not math.isfinite(step.x1.dot(step.x1)):
            raise NotFiniteError(f"the state is not finite after t = {step.t0:.6g} s")
        yield step


def _until(split: Split, last: float) -> Split:
    """The split with no time after `last` asked for."""
    remainder, node = split.remainder, split.node
    clamped = replace(split, remainder=lambda t, p, E: remainder(min(t, last), p, E))
    if node is None:
        return clamped
    return replace(clamped, node=lambda t, p, E: node(min(t, last), p, E))


def _ticks(clock: Clock, t_arc: float, t_first: float) -> float:
    return (t_arc if clock.restart else t_first) + clock.offset


def _tick(
    clocks: tuple[Clock, ...], t: float, t_arc: float, t_first: float, x: Array, mode: Mode
) -> Array:
    for clock in clocks:
        start = _ticks(clock, t_arc, t_first)
        k = round((t - start) / clock.period)
        if k >= 0 and t == start + k * clock.period:
            x = clock.update(t, x, mode)
    return x


def _next_break(
    system: HybridSystem, mode: Mode, t: float, t_arc: float, t_first: float, t_end: float
) -> float:
    """The first switching time or tick after t, at most t_end."""
    times = [s for s in system.switching_times(mode) if s > t]
    for clock in system.clocks():
        start = _ticks(clock, t_arc, t_first)
        k = max(0, math.floor((t - start) / clock.period))
        while start + k * clock.period <= t:
            k += 1
        times.append(start + k * clock.period)
    return min([*times, t_end])


class _Watch:
    """The witnesses along one arc; a guard is armed once its witness has left zero."""

    def __init__(self, guards: tuple[Guard, ...], t: float, x: Array, fired: str | None):
        """`fired` has just ended the last arc: what is left of its witness is round-off, taken as zero."""
        self.guards = guards
        self.values = [0.0 if g.name == fired else g.witness(t, x) for g in guards]

    def first(self, step: Step) -> tuple[Event, Outcome, Status] | None:
        """The earliest crossing in `step` that is an event."""
        before_t = step.t0
        for t in interior(step.t0, step.t1):
            x = step.x1 if t == step.t1 else step.at(t)
            after = [guard.witness(t, x) for guard in self.guards]
            crossed = [
                (*self._locate(guard, step, before_t, t), guard)
                for guard, w0, w1 in zip(self.guards, self.values, after, strict=True)
                if guard.direction.crossed(w0, w1)
            ]
            self.values, before_t = after, t
            for te, xe, guard in sorted(crossed, key=lambda c: c[0]):
                if guard.terminal is not None:
                    return Event(guard.name, te, xe, None), None, guard.terminal
                outcome = guard.reset(te, xe) if guard.reset is not None else None
                if outcome is not None:
                    return Event(guard.name, te, xe, outcome[0]), outcome, Status.COMPLETED
        return None

    @staticmethod
    def _locate(guard: Guard, step: Step, ta: float, tb: float) -> tuple[float, Array]:
        """Time and state of the crossing in (ta, tb]."""

        def witness(t: float) -> float:
            return guard.witness(t, step.x0 if t == step.t0 else step.at(t))

        if witness(tb) == 0.0:
            return tb, step.at(tb)
        te = float(brentq(witness, ta, tb, xtol=_T_XTOL, rtol=4.5e-16 * 2))
        return te, step.at(te)
