"""Many walks at once: compiled, in threads, each by itself, so that their number changes no bit of any result.

For return maps, basins and sweeps, where thousands of walks are made and only their impacts matter. A kernel is
a compiled loop over time, a node a stored instant of a walk, an arc the flow between two impacts.

What touches Python (checks, controllers that run in Python, Pinocchio) is done in the caller's thread, when a
case is prepared; the threads then run kernels without the GIL, each on arrays of its own. The memory of a run
is taken when it starts and freed when it ends, so memory does not grow with the number of runs, but for the few
numbers that each of them leaves (`BatchWalk`).

Return maps (`analysis`) ask for `strides`, studies and benchmarks for `simulate_many`.
"""

from collections import deque
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, fields, replace
from functools import cached_property
from itertools import chain, islice, repeat
from typing import Any, Self

import numpy as np

from biped_adrc.closed_loop.instant_signals import step_reading
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.control.base import Measurement, has_own_class
from biped_adrc.core.checks import Checked, PositiveInt, check_part
from biped_adrc.core.errors import InputError, ModelError, NotFiniteError, RaisedError
from biped_adrc.core.part import constant, shared
from biped_adrc.core.processes import cores
from biped_adrc.core.shown import Shown
from biped_adrc.core.tree import flatten
from biped_adrc.core.types import Array
from biped_adrc.engine.kernels.compiled_run import CompiledRun
from biped_adrc.engine.lanes import SIDE_BY_SIDE, Lanes
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.program import COMPILED, CompiledWalker
from biped_adrc.engine.run import STORE, simulate_by, simulate_compiled
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.biped import Biped

_TOGETHER = 4, 8, 16
"""Numbers of walks that a thread makes one after the other: at first, then, and from then on. To wake a thread
costs a tenth of a walk, but a short batch is shared more evenly in small groups."""
_AHEAD = 2
"""Number of such groups that are prepared beforehand for each thread, so that no thread waits for Python."""
_AT_ONCE = 25
"""Most single supports for whose nodes memory is taken at a time; a longer walk is made in several calls."""


@dataclass(frozen=True)
class Case(Checked, Shown):
    """One walk to be made, from a state or from the orbit of a gait.

    - walker: plant, controller and all the rest.
    - q (n,) [rad], v (n,) [rad/s]: the state at the start of a single support; by default the gait's.
    - method: of integration, with one step for all of the walk.
    - impacts: the walk ends after so many, at the latest after that many times `walker.max_step_time`.
    - mode: the single support in which it starts.
    - curve: the reference from which errors are measured in `BatchWalk.table`; None keeps none.
    - gait: the gait from whose orbit the walk starts where q and v are left out; a walker without a slope
      walks on the gait's.

    Raises InputError for a field of another class, and where both gait and q, v are left out.

    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    >>> case = ba.Case(walker, *gait.start(biped), ba.RK4(1e-3), impacts=3)
    >>> bool(np.all(ba.Case(walker, gait=gait, method=ba.RK4(1e-3)).q == case.q))
    True
    """

    walker: Walker
    q: Array = None  # type: ignore[assignment]  # until the gait gives it
    v: Array = None  # type: ignore[assignment]
    method: OneStepMethod = None  # type: ignore[assignment]  # refused, if it is left out
    impacts: PositiveInt = 25
    mode: Mode = Mode()  # noqa: RUF009
    curve: Reference | None = None
    gait: Gait | None = None

    def __post_init__(self) -> None:
        """Take the slope of the gait for a walker without one, and its start where q and v are left out."""
        if self.gait is not None and self.walker.slope is None:
            vars(self)["walker"] = shared(self.walker, slope=self.gait.slope)
        if self.q is None or self.v is None:
            check_part(self.gait, "the gait of a case without q and v", Gait)
            # q, v of the gait on the controller's model, put past the frozen class's own refusal
            start = self.gait.start(self.walker.nominal)
            vars(self).update(zip("qv", start, strict=True))

    @property
    def options(self) -> RunOptions:
        """Options of its run, which ends after `impacts` single supports of the longest duration at the latest;
        without a curve nodes are kept at the ends of arcs alone.
        """
        t_end = self.mode.start + self.impacts * self.walker.max_step_time
        # STORE: so many integration steps between two nodes that only the ends of arcs are kept
        strikes, every = (FOOT_STRIKE, self.impacts), STORE if self.curve is None else 1
        return RunOptions(t_end, self.mode.start, strikes, store_every=every)


@dataclass(frozen=True)
class BatchWalk(Shown):
    """The result of one walk of a batch: M impacts, states of nx numbers."""

    status: Status
    """How it ended."""
    detail: str
    """The text of the error that ended it; empty for other ends."""
    times: Array
    """Times of the impacts (M,) [s]."""
    x_minus: Array
    """States just before the impacts (M, nx)."""
    final_state: Array
    """State at the end (nx,); x+ where the last of the impacts asked for was made."""
    t_end: float
    """End of the walk [s]."""
    engine: str
    """Name of the engine that ran: compiled, compiled plant, or pinocchio."""
    t_start: float = 0.0
    """Start of the walk [s]."""
    table: Array | None = None
    """K nodes of the walk of a case with a curve, rows (K, width), each a `NodeRow` as `node_layout` has it:
    one at each integration step, after the sample instant there, and at the end of each single support. None
    without a curve, and for a walk in continuous time, in Python, or with a detector of touchdowns."""
    trajectory: Trajectory | None = None
    """The whole run of a case with a curve whose walk has no table; else None."""

    @property
    def impacts(self) -> int:
        """Number M of impacts."""
        return len(self.times)

    @property
    def durations(self) -> Array:
        """Durations of the single supports that ended in an impact (M,) [s]."""
        return np.diff(self.times, prepend=self.t_start)


def simulate_many(cases: Iterable[Case], threads: int | None = None) -> Iterator[BatchWalk]:
    """Iterate over the walks in the order of their cases; parallel threads make them meanwhile.

    - cases: may be a generator, of which a few cases are taken ahead.
    - threads: number of threads; None: the number of cores.

    A fall, a NaN or a part in Python that raises ends its own run, with a status. Raises InputError
    for a case whose parts do not fit together.

    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    >>> q, v = gait.start(biped)
    >>> cases = [ba.Case(walker, q, factor * v, ba.RK4(1e-3), impacts=2) for factor in (0.97, 1.03)]
    >>> [walk.impacts for walk in ba.simulate_many(cases)]
    [2, 2]
    """
    count = threads if threads is not None else cores()
    if count < 1:
        raise InputError(f"the batch asks for {count} threads, expected at least 1")
    return _in_order(iter(cases), count)


def _in_order(cases: Iterator[Case], threads: int) -> Iterator[BatchWalk]:
    """Yield the walks of the cases in order.

    They wait in groups in a queue of futures. Its first group is yielded when it is done, or waited for when
    the queue is full, so that cases are not prepared far ahead. Closing the generator cancels the groups that
    have not begun.
    """
    waiting: deque[Future[list[BatchWalk]]] = deque()
    prepare = Preparation()
    *first, later = _TOGETHER
    sizes = chain(*(repeat(size, threads) for size in first), repeat(later))
    with ThreadPoolExecutor(threads) as pool:
        try:
            while group := [prepare(case) for case in islice(cases, next(sizes))]:
                waiting.append(pool.submit(walks_of(group)))
                while waiting and (len(waiting) >= _AHEAD * threads or waiting[0].done()):
                    yield from waiting.popleft().result()
            while waiting:
                yield from waiting.popleft().result()
        finally:
            for future in waiting:
                future.cancel()


def walks_of(runs: Sequence[Callable[[], BatchWalk]]) -> Callable[[], list[BatchWalk]]:
    """The function that makes the walks of what `Preparation` returned; it may run in any thread.

    Walks of one structure go side by side, if there are at least SIDE_BY_SIDE of them.
    """
    alike = dict[Hashable, dict[int, Ready]]()
    for i, run in enumerate(runs):
        if isinstance(run, Ready) and run.key is not None:
            alike.setdefault(run.key, {})[i] = run
    teams = [team for team in alike.values() if len(team) >= SIDE_BY_SIDE]
    # compiled here, in the caller's thread
    firsts = [next(iter(team.values())) for team in teams]
    codes = [Lanes.of(first.compiled, bool(first.read)) for first in firsts]

    def walks_in_order() -> list[BatchWalk]:
        walks = dict[int, BatchWalk]()
        for lanes, team in zip(codes, teams, strict=True):
            beside = _side_by_side(lanes, [run.going() for run in team.values()])
            walks |= zip(team, beside, strict=True)
        return [walks[i] if i in walks else run() for i, run in enumerate(runs)]

    return walks_in_order


class Preparation:
    """Prepares cases one after the other, each from an earlier one if they are alike: equal but for numbers of
    the controller and for the disturbance.
    """

    def __init__(self) -> None:
        self.last: Ready | None = None
        """The last case that was prepared as a whole."""

    def __call__(self, case: Case) -> Callable[[], BatchWalk]:
        """Prepare a case and return the function that simulates it, which may run in any thread.

        Python's and Pinocchio's parts are called here only, in the caller's thread. An exception of theirs
        becomes the status of this walk, whose state stays that of the start; an InputError, a mistake of the
        caller, is raised.
        """
        try:
            with suppress(NotCompiled):  # such as a disturbance in Python
                if self.last and (ready := self.last.alike(case)):
                    return ready
            run = _prepared(case)
        except Exception as error:  # whatever a controller or a disturbance in Python may raise
            # these two are InputErrors, too, but say how the walk went and no mistake of the caller
            if isinstance(error, InputError) and type(error) not in (NotFiniteError, RaisedError):
                raise
            status, detail = simulator.status_of(error)
            x, start = np.concatenate((case.q, case.v)), case.mode.start
            # no times of impacts and no states before them; it ends at `start`, where it begins
            none = np.zeros((0, len(x)))
            walked = BatchWalk(status, detail, np.zeros(0), none, x, start, COMPILED, start)
            return lambda: walked
        # a controller of a user's class is tried at the start of each walk
        w = case.walker
        if isinstance(run, Ready) and not any(map(has_own_class, (w.controller, w.law))):
            self.last = run
        return run


@dataclass(frozen=True)
class Ready:
    """A case that is ready to run in machine code; called, it returns its walk."""

    case: Case
    x: Array
    """State at the start (nx,)."""
    compiled: CompiledWalker
    read: int
    """Address of the function that computes a row of the table; 0 for no table."""

    def __call__(self) -> BatchWalk:
        c = self.case
        # only compiled walks in sampled time that know touchdowns at once have a table; others leave their run
        if c.curve is not None and not self.read:
            return left_by(c, simulate_compiled(self.compiled, self.x, c.mode, c.options))
        return self.going().to_end()

    def going(self) -> "_Going":
        """The walk at its start."""
        c = self.case
        return _Going(self.compiled, self.x, c.mode, c.options.t_end, c.impacts, self.read)

    @cached_property
    def key(self) -> Hashable | None:
        """What it has in common with walks that may go beside it; None for none."""
        alone = self.case.curve is not None and not self.read
        return None if alone else Lanes.key(self.compiled, bool(self.read))

    @cached_property
    def begin(self) -> Measurement:
        """The measurement from which the controller's state begins."""
        c = self.case
        return c.walker.measure(c.mode.start, c.q, c.v, c.mode)

    def alike(self, case: Case) -> Self | None:
        """Another case, ready to run, which takes from this one what does not change; None if they are not
        alike.
        """
        one, w = self.case, case.walker
        started = np.array_equal(one.q, case.q) and np.array_equal(one.v, case.v)
        same = started and _equal(one, case, "walker", "q", "v")
        same = same and _equal(one.walker, w, "controller", "disturbance")
        if not same or (compiled := self.compiled.like(w)) is None:
            return None
        s, at = flatten(w.law.initial_state(self.begin)), 2 * w.plant.n
        if not np.all(np.isfinite(s)):
            return None
        vars(w)["layout"] = self.case.walker.layout_of(self.x)  # equal for laws that are alike
        x = self.x.copy()
        x[at : at + len(s)] = s
        return replace(self, case=case, x=x, compiled=compiled)


def _equal(one: Any, other: Any, *but: str) -> bool:
    """Whether two parts have the same fields, `but` for those of these names: the same objects, or equal ones
    in which nothing can change.

    Robots are not compared by value, which would take longer than it saves.
    """
    names = [f.name for f in fields(one) if f.name not in but]
    pairs = ((getattr(one, name), getattr(other, name)) for name in names)
    known = (x is y or (not isinstance(x, Biped) and constant(x) and x == y) for x, y in pairs)
    return type(one) is type(other) and all(known)


def _prepared(case: Case) -> Callable[[], BatchWalk]:
    """Prepare a case and return the function that simulates it, in any thread. Raises whatever its parts raise.

    A walk whose parts cannot all be compiled is simulated here at once, in the caller's thread.
    """
    walker, options = case.walker, case.options
    x = walker.initial_state(case.q, case.v, case.mode)
    options.check(x)
    walker.check_foot(case.q, case.v, case.mode)
    layout = walker.layout_of(x)
    try:
        compiled = CompiledWalker.of(walker, case.method, layout, case.mode.start, case.curve)
    except (NotCompiled, ModelError):
        # `simulate_by` compiles what it can, such as the plant alone
        try:
            run = simulate_by(COMPILED, walker, x, case.mode, case.method, **vars(options))
        except NotFiniteError:
            raise
        # the start has been checked, so what a user's code returned later on is no mistake in the case
        except InputError as error:
            raise RaisedError(str(error)) from error
        return lambda: left_by(case, run)
    read = 0
    if case.curve is not None and walker.sampled and walker.touchdown is None:
        read = compiled.program.reading(step_reading).addresses["reading"]
    return Ready(case, x, compiled, read)


class _Going:
    """A walk that is being made in machine code, a few single supports at a time, and what it has left so far.

    It ends after so many impacts, at t_end [s] at the latest. x (nx,): the state at the start of the single
    support `mode`. read: address of the function that computes a row of the table, 0 for no table.
    """

    def __init__(
        self, of: CompiledWalker, x: Array, mode: Mode, t_end: float, impacts: int, read: int = 0
    ):
        self.run, self.read = of.plan.start(x, mode.start, *mode, t_end), read
        self.left, self.start, self.status = impacts, mode.start, Status.COMPLETED
        self.parts, self.rows = list[Array](), list[Array]()
        """Rows (t, x-, x+) of the impacts, and those of the table."""
        if read:  # memory for the rows of so many single supports
            self.run.keep(of.walker.max_step_time, min(impacts, _AT_ONCE), read)

    def next(self) -> CompiledRun:
        """The run, ready to be moved over the next impacts."""
        # _AT_ONCE: most single supports for whose nodes memory is taken at a time
        self.parts.append(self.run.strikes(min(self.left, _AT_ONCE) if self.read else self.left))
        return self.run

    def add(self, status: Status) -> None:
        """Add what the run has left, which has been moved over those impacts or to another end."""
        struck = int(self.run["struck"])
        self.parts[-1] = self.parts[-1][:struck]
        self.status, self.left = status, self.left - struck if status is Status.COMPLETED else 0
        # a run that is over leaves its memory; one that goes on overwrites it
        self.rows.append(self.run.rows().copy() if self.left > 0 else self.run.rows())

    def to_end(self) -> BatchWalk:
        """The walk, made by itself."""
        while self.left > 0:
            self.next()
            self.add(self.run.stride())
        return self.walk()

    def walk(self) -> BatchWalk:
        """The walk, when it is over."""
        run, nx = self.run, self.run.nx
        strikes = self.parts[0] if len(self.parts) == 1 else np.vstack(self.parts)
        times, before, after = strikes[:, 0].copy(), strikes[:, 1 : 1 + nx].copy(), run.x.copy()
        table, end = None, run["t"]
        if self.read:
            table = self.rows[0] if len(self.rows) == 1 else np.vstack(self.rows)
        return BatchWalk(self.status, "", times, before, after, end, COMPILED, self.start, table)


def _side_by_side(lanes: Lanes, walks: Sequence[_Going]) -> list[BatchWalk]:
    """Make walks at their starts, which have a key of `Lanes` in common."""
    while going := [one for one in walks if one.left > 0]:
        runs = [one.next() for one in going]
        for one, status in zip(going, lanes.run(runs), strict=True):
            one.add(status)
    return [one.walk() for one in walks]


def left_by(case: Case, run: Trajectory) -> BatchWalk:
    """Make the `BatchWalk` of a run of a case; the run itself is in it where the case has a curve."""
    x, engine = run.final_state, run.settings["engine"]
    times = np.array([event.t for event in run.events(FOOT_STRIKE)])
    # reshape: (0, nx) without an impact
    before, start = run.before(FOOT_STRIKE).reshape(-1, len(x)), case.mode.start
    walk = BatchWalk(run.status, run.detail, times, before, x, run.t_end, engine, start)
    return walk if case.curve is None else replace(walk, trajectory=run)


def strides(
    compiled: CompiledWalker, starts: Sequence[tuple[Array, Mode]], t_end: float
) -> list[BatchWalk]:
    """Simulate one single support from each of many starts (x, mode), for return maps, in parallel threads.

    Each ends at its impact, or with another status. x (nx,) is the state right after the impact that began the
    single support `mode`. t_end [s]: longest duration of one single support.
    """
    # 1: each ends after one impact
    going = [_Going(compiled, x, m, m.start + t_end, 1) for x, m in starts]
    threads = cores()
    beside = len(starts) >= SIDE_BY_SIDE and Lanes.key(compiled, False) is not None
    lanes = Lanes.of(compiled, False) if beside else None
    size = max(1, -(-len(going) // threads))
    parts = [going[i : i + size] for i in range(0, len(going), size)]

    def to_end(part: Sequence[_Going]) -> list[BatchWalk]:
        return _side_by_side(lanes, part) if lanes else [one.to_end() for one in part]

    with ThreadPoolExecutor(threads) as pool:
        return [*chain(*pool.map(to_end, parts))]
