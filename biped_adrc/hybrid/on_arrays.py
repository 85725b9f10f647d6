"""The operations of the march in Python: `hybrid.march`, the integration of one arc from an event to the next,
calls them to run any `HybridSystem` on NumPy arrays.

`Run` has the state of one arc and the work arrays of the march; the functions below it evaluate the system, add
vectors, and find breaks, which are sample instants and switching times of inputs. They write their results into
`out` or another argument. Methods of the system get copies of arrays, since the march writes into its own.

Symbols: x state of nx numbers, x' its slope; h integration step [s]; y = (w, E) coordinates of the exponential
method, w (n_slow,) and the stiff part E (k, c), with w' = N_w, E' = A E + N_E; N = (N_w, N_E) the remainder
(`hybrid.exponential`). r is a `Run`. A node is a stored instant (t, x, x'), an outcome is (x+, mode+) after an
event. A guard is an event function with what its event does, a twin the operation of the same name that is
compiled.
"""

import math
from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from biped_adrc.core.errors import NotFiniteError
from biped_adrc.core.types import Array, T
from biped_adrc.hybrid import constants, integrators
from biped_adrc.hybrid.exponential import Exponential, no_coordinates, phi_levels
from biped_adrc.hybrid.system import AnyMode, Clock, FoundEvent, HybridSystem
from biped_adrc.hybrid.trajectory import Event, Recorder


def inner(function: T) -> T:
    """Return the function itself; the compiled engine's decorator of this name inlines it into its callers."""
    return function


unit = inner
"""Returns the function itself; the compiled engine's decorator of this name makes a C function of it."""

# Each function below has a twin of the same name and arguments in `engine.kernels.operations`. Sizes are handed
# over (`size`, r.nx) although NumPy knows them, because the twin gets pointers, which have no length.


@dataclass(frozen=True)
class Calendar:
    """The times of one arc that are known beforehand: sample instants of clocks, switching times, its end."""

    system: HybridSystem
    mode: AnyMode
    t_arc: float
    """Start of the arc [s]."""
    t_first: float
    """Start of the run [s]."""
    t_end: float
    """Latest end of the arc [s]."""

    @cached_property
    def clocks(self) -> list[tuple[Clock, float]]:
        """Every clock, with the time t0 [s] from which its sample instants t0 + k period are counted."""
        # start of counting [s], for a clock that restarts with each arc and for one that does not
        first = {True: self.t_arc, False: self.t_first}
        return [(clock, first[clock.restart] + clock.offset) for clock in self.system.clocks()]

    @cached_property
    def edges(self) -> list[float]:
        """Switching times of the inputs and t_end [s] in ascending order, and infinity, so that each time has a
        next one.
        """
        return sorted([*self.system.switching_times(self.mode), self.t_end, math.inf])

    def due(self, t: float, x: Array) -> Array:
        """x (nx,) after the updates of all clocks with a sample instant exactly at t [s], in the system's
        order.
        """
        for clock, start in self.clocks:
            # before `start` a clock with an offset has no sample instants
            if t >= start and constants.is_tick(t, start, clock.period):
                x = clock.update(t, x, self.mode)
        return x

    def next_break(self, t: float) -> float:
        """The first switching time or sample instant after t [s], at most t_end: no step goes across one."""
        ticks = (constants.next_tick(t, start, clock.period) for clock, start in self.clocks)
        return min([self.edges[bisect_right(self.edges, t)], *ticks])


class Run:
    """One arc of a system while the march moves it: time and state now, settings, and work arrays.

    The fields have the names of the compiled run (`engine.kernels.record.Run`), where each is explained. Those
    of the functions in this module:

        t, t_end, limit             time now, latest end of the arc, latest time at which the flow is asked [s]
        x0, dx0, x1, dx1, x_e       state and slope at both ends of a step; state at the time tried last (nx,)
        before, values, after       event functions (guards,) just before the last event, at both ends of a step
        event_functions, accepted   the guards of the mode; number of a guard -> its event that was accepted
        phi, form                   matrices and coordinates (`system.Split`) of the exponential method
        t_next, steps               aim [s] and iterator of a solver, which takes its own steps
        n_slow, nN, levels          numbers in w and in the remainder, and of step lengths h 2^-level
        t_b, t_far, f_far           where sub-steps towards an event end: results of `march.halve`
    """

    # for a type checker alone: the arrays are set by name when a run is made
    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Array:
            """One of the work arrays (nx,) of constants.X_ROWS and Y_ROWS."""

    step: integrators.Step

    def __init__(
        self,
        calendar: Calendar,
        method: integrators.OneStepMethod,
        record: Recorder,
        t: float,
        x: Array,
        fired: Event | None,
    ):
        """Prepare the arc from x (nx,) at t [s]; fired: the event that ended the arc before, None at the start.

        Raises InputError where the method is `Exponential` and the system has no coordinates for it.
        """
        self.calendar, self.method, self.record = calendar, method, record
        self.system, self.mode = calendar.system, calendar.mode
        self.t, self.t_end, self.limit, self.t_event = t, calendar.t_end, math.inf, 0.0
        self.t_from = t
        self.event_functions = self.system.guards(self.mode)
        names = [guard.name for guard in self.event_functions]
        self.guards, self.before = len(names), np.zeros(len(names))
        # number of the guard that ended the arc before; -1 for none, or for one that this mode has not
        self.fired = names.index(fired.guard) if fired and fired.guard in names else -1
        self.t_arc, self.armed, self.sloped, self.every = t, 0, 0, record.every
        # look, pulled, pause and sloped stay 0, and all of x flows: the march reads other values in compiled
        # runs alone
        self.look = self.pulled = self.done = self.pause = 0
        self.nx, self.moving, self.p = len(x), len(x), 0
        self.accepted: dict[int, FoundEvent] = {}
        self.event: FoundEvent | None = None
        for name in constants.X_ROWS:
            setattr(self, name, np.zeros(self.nx))
        self.values, self.after, self.tried = (np.zeros(self.guards) for _ in range(3))
        self.x0[:] = x
        # `before`: the event functions just before the last event, zero where the state had another size
        if fired and len(fired.x_minus) == self.nx:
            watch(self, fired.t, fired.x_minus, self.before)
        self.kind, self.h, self.lags, self.lag_speed = constants.SOLVER, math.inf, 0, 0.0
        # nan: no time, so that the first call of `solve` starts the solver
        self.t_next, self.steps = math.nan, iter(tuple[integrators.Step, ...]())
        self.nN = self.n_slow = self.levels = 0
        self.t_b = self.t_far = self.f_far = 0.0
        if isinstance(method, integrators.RK4):
            self.kind, self.h, relaxing = constants.RK4, method.h, self.system.relaxing()
            if relaxing is not None:
                # lags 1: the march asks only whether it is above 0
                self.lags, self.lag_speed, self.relaxing = 1, relaxing.speed, relaxing
        elif isinstance(method, Exponential):
            self._set_etd(method)

    def _set_etd(self, method: Exponential) -> None:
        """Make the matrices and arrays of the exponential method, in the coordinates y = (w, E)."""
        form = self.system.split(self.mode)
        if form is None:
            raise no_coordinates()
        w, E = form.to(self.x0)
        self.kind, self.h, self.form, self.E_shape = constants.ETD, method.h, form, E.shape
        self.phi = phi_levels(method.h, form.A)
        self.n_slow, self.levels = len(w), len(self.phi)
        self.nN = self.nx  # N has all rows of N_E; the compiled twin has one, the others being zero
        for name in constants.Y_ROWS:
            setattr(self, name, np.zeros(self.nx))

    def parts(self, y: Array) -> tuple[Array, Array]:
        """w (n_slow,) and E (k, c) of y (nx,), as copies."""
        return y[: self.n_slow].copy(), y[self.n_slow :].reshape(self.E_shape).copy()

    def block(self, y: Array) -> Array:
        """E (k, c) of y (nx,) as a view: to write into it changes y."""
        return y[self.n_slow :].reshape(self.E_shape)


# -- vectors ---------------------------------------------------------------------------------------
def shift(x: Array, i: int) -> Array:
    """x from its entry i on."""
    return x[i:]


def copy(x: Array, out: Array, size: int) -> None:
    """out (size,) = x (size,)."""
    out[:size] = x[:size]


def add(x: Array, h: float, dx: Array, out: Array, size: int) -> None:
    """out (size,) = x + h dx."""
    out[:size] = x[:size] + h * dx[:size]


def rk4_sum(
    x: Array, h: float, k1: Array, k2: Array, k3: Array, k4: Array, out: Array, size: int
) -> None:
    """out (size,) = x + h / 6 (k1 + 2 (k2 + k3) + k4)."""
    slopes = k1[:size] + 2.0 * (k2[:size] + k3[:size]) + k4[:size]
    out[:size] = x[:size] + (h / 6.0) * slopes


def finite(x: Array, size: int) -> bool:
    """Whether every number of x (size,) is finite."""
    return bool(np.all(np.isfinite(x)))


def matrix(r: Run, level: int, which: int) -> Array:
    """One of the six matrices (k, k) of `hybrid.exponential.matrices` of step h 2^-level; which: HALF, .."""
    return r.phi[level, which]


def matvec(r: Run, M: Array, y: Array, out: Array) -> None:
    """E of out = M (k, k) times E of y; w of out is left as it is."""
    r.block(out)[:] = M @ r.block(y)


def apply_input(r: Run, M: Array, factor: float, N: Array, out: Array) -> None:
    """Add factor M N_E to E of out; M is (k, k)."""
    r.block(out)[:] += factor * (M @ r.block(N))


# -- the system ------------------------------------------------------------------------------------
def flow(r: Run, t: float, x: Array, dx: Array) -> None:
    """dx (nx,) = x'(t, x), t in [s].

    The system is asked at min(t, r.limit), with r.limit just before the next break: a step that ends at the
    break then takes the input's left limit there, and not its value after the jump.
    """
    dx[:] = r.system.flow(min(t, r.limit), x.copy(), r.mode)


def split(r: Run, x: Array, y: Array) -> None:
    """y (nx,) = (w, E) of the state x (nx,)."""
    w, E = r.form.to(x.copy())
    y[: r.n_slow], r.block(y)[:] = w, E  # block: the part of y that is E (k, c), as a view


def join(r: Run, y: Array, x: Array) -> None:
    """x (nx,) = the state whose coordinates are y = (w, E)."""
    x[:] = r.form.back(*r.parts(y))


def remainder(r: Run, t: float, y: Array, N: Array) -> None:
    """N = (N_w, N_E) at (t, y), t in [s], but no later than r.limit, just before the next break, so that inputs
    have their left limit there.
    """
    N_w, N_E = r.form.remainder(min(t, r.limit), *r.parts(y))
    N[: r.n_slow], r.block(N)[:] = N_w, N_E


def relax(r: Run, x: Array, weight: float, out: Array) -> None:
    """Set the entries of out (nx,) that relax (`system.Relaxing`), such as torques of lagging motors, to their
    final value plus `weight` [1] times their distance from it in x (nx,).
    """
    at, to = r.relaxing.at, r.relaxing.to
    out[at] = x[to] + weight * (x[at] - x[to])


def relax_slope(r: Run, x: Array, steep: float, dx: Array) -> None:
    """Set the entries of the slope dx (nx,) that relax (`system.Relaxing`) to `steep` [1/s] times their
    distance from their final value in x (nx,).
    """
    at, to = r.relaxing.at, r.relaxing.to
    dx[at] = steep * (x[at] - x[to])


def slow(r: Run, t: float, x: Array) -> bool:
    """Check that x (nx,) at t [s] is within the bounds of the system: returns True, or raises RanAwayError.

    The name is that of its compiled twin, which cannot raise: it returns False for a rate or angle too large.
    """
    r.system.check_state(t, x)
    return True


def broken(r: Run) -> int:
    """Raise NotFiniteError, for an arc whose state or slope is not finite; the compiled twin, which cannot
    raise, returns a code.
    """
    raise NotFiniteError(f"the state is not finite after t = {r.t:.6g} s")


def watch(r: Run, t: float, x: Array, out: Array) -> None:
    """out (guards,) = the event functions (witnesses of the guards) at (t, x), t in [s]."""
    x = x.copy()
    for i, guard in enumerate(r.event_functions):
        out[i] = guard.witness(t, x)


def suspect(r: Run, t0: float, t1: float, count: int) -> bool:
    """Whether an event may lie inside a step of integration from t0 to t1 [s] that has `count` > 1 stretches:
    always True, so the step is taken again at the points between them.
    """
    # the compiled twin may look at a cubic first: it knows that the events of a walker depend on q and t alone
    return True


def passed(r: Run, guard: int, fall: float) -> bool:
    """Whether an event function crossed zero more than TOGETHER [s] before the last event, so that its own
    event is over and not one of this instant.

    guard: its number. r.before: its value just before the last event. fall > 0: how far it falls in the first
    TOGETHER [s] after that event. At the same speed, a function that crossed zero TOGETHER [s] before the event
    had come down to -fall at the event. Closer events are not told apart.
    """
    return bool(r.before[guard] + fall <= 0.0)


def accepts(r: Run, guard: int, te: float) -> bool:
    """Whether the crossing of zero at te [s] in the state r.x_e is an event; its outcome goes into r.accepted.

    It is no event where the guard has no status and its reset returns None.
    """
    # guard: its number. One with a status (`terminal`) ends the run; any other has a reset
    it, x_minus = r.event_functions[guard], r.x_e.copy()
    if it.terminal is not None:
        r.accepted[guard] = FoundEvent(Event(it.name, te, x_minus, None), None, it.terminal)
        return True
    outcome = it.reset(te, x_minus) if it.reset is not None else None
    if outcome is None:
        return False
    r.accepted[guard] = FoundEvent(Event(it.name, te, x_minus, outcome[0]), outcome)
    return True


def code_of(r: Run, guard: int) -> int:
    """Keep the accepted event of a guard as r.event; returns STRUCK, the code of an arc that an event ends."""
    r.event = r.accepted[guard]
    return constants.STRUCK


def due(r: Run) -> int:
    """Update x0 (nx,) at the sample instants that are due; returns 0, the code for no failure."""
    r.x0[:] = r.calendar.due(r.t, r.x0.copy())
    return 0


def next_break(r: Run) -> float:
    """The first break after t [s], at most t_end."""
    return r.calendar.next_break(r.t)


def node(r: Run, t: float, x: Array, dx: Array) -> None:
    """Store the node (t, x, dx), t in [s], in the record of the arc."""
    r.record.add(t, x.copy(), dx.copy())


# -- a solver's steps ------------------------------------------------------------------------------
def solve(r: Run, t_next: float) -> float:
    """Take the solver's next step towards t_next [s]; its end goes into x1, dx1 (nx,), its time [s] is
    returned.

    A new t_next starts the solver anew at (r.t, x0). The flow is asked no later than r.limit, just before the
    next break. Raises NotFiniteError after a step to a state that is not finite, RanAwayError after one beyond
    the bounds.
    """
    if r.t_next != t_next:
        assert isinstance(r.method, integrators.Solver)

        def f(t: float, x: Array) -> Array:
            return r.system.flow(min(t, r.limit), x, r.mode)

        r.t_next, r.steps = t_next, iter(r.method.steps(f, r.t, r.x0.copy(), t_next))
    r.step = step = next(r.steps)
    r.x1[:], r.dx1[:] = step.x, step.dx
    if not finite(r.x1, r.nx):
        broken(r)
    slow(r, step.t, r.x1)
    return step.t


def dense(r: Run, s: float) -> None:
    """x_e (nx,) = the state at s [s], within the solver's last step, by its dense output."""
    r.x_e[:] = r.step.at(s)
