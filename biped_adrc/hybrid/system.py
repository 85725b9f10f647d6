"""What a hybrid system is: a flow, event functions with resets, clocks, and times at which inputs switch.

    x' = f(t, x; mode)        between events
    x+, mode+ = reset(t, x-)  when a guard's witness (event function) falls through zero
    x+ = update(t, x-, mode)  at the sample instants t0 + k T of a clock

At equal times the order is reset, sample instant, flow. `mode` is the discrete state: any immutable
value of the system's own, such as a step counter; the simulator only carries it from arc to arc. An arc is the
flow between two events. A break is a sample instant or a time at which an input switches; no integration step
goes across one.

`hybrid.simulator` runs what is defined here. `closed_loop.system.ClosedLoop` is the base of all
systems of this package; a user's own hybrid system needs `flow` alone.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Event, Recorder

AnyMode = Any
"""The discrete state, a value of the system's own; Any, since only the system itself looks inside."""
JumpResult = tuple[Array, AnyMode] | None
"""(x+, mode+) after an event; None where the run ends with it."""


class FoundEvent(NamedTuple):
    """The event that ended an arc."""

    event: Event
    """Name of the guard, time and states before and after."""
    outcome: JumpResult = None
    """(x+, mode+), None where the run ends here."""
    status: Status = Status.COMPLETED
    """How the run ends, for an event that ends it."""


Mover = Callable[[float, Array, AnyMode, float, Any], tuple[float, Array, FoundEvent | None]]
"""move(t, x, mode, until, record) -> (t, x, the event that ended the arc at this t, or None).

Moves a system from t to `until` [s], or to its next event if that is earlier, by an integration of its own. It
adds its nodes (stored instants) one by one to `record`, a `trajectory.Recorder`, so that they are kept if it
raises an error.
"""


@dataclass(frozen=True)
class Guard(Shown):
    """An event function: a named zero crossing of witness(t, x), downwards, and what follows from it.

    - witness(t, x): real function whose zero is the event.
    - reset(t, x): (x+, mode+), or None to let the crossing pass as no event.
    - terminal: with a status, the run ends at the crossing in place of a reset.

    A guard watches from the start of an arc on. A witness that is not positive there has these cases:

    - zero, then rising: the guard fires when it falls through zero again, however soon.
    - zero, then bending down, as of a body at rest on the floor that it bounces off: the run ends
      (EVENT_LIMIT).
    - zero after its own reset, then falling steadily: no event.
    - zero or below and falling, at the start of the run, after a jump of the state, or as the second of two
      events at one instant: the guard fires at once.
    - below zero and rising: the guard fires the next time that the witness falls through zero.

    So a guard whose witness is the time left until an instant must not be among the guards of the mode after
    its reset: another event at that very instant would fire it again.
    """

    name: str
    witness: Callable[[float, Array], float]
    reset: Callable[[float, Array], tuple[Array, AnyMode] | None] | None = None
    terminal: Status | None = None


@dataclass(frozen=True)
class Clock(Shown):
    """Sample instants at t0 + k * period [s], k = 0, 1, .., at which `update(t, x, mode)` gives x+.

    - restart: whether t0 is counted from the start of each arc, or once from the start of the run.
    - offset [s]: of t0 from that start.
    """

    name: str
    period: float
    update: Callable[[float, Array, AnyMode], Array]
    restart: bool = True
    offset: float = 0.0


@dataclass(frozen=True)
class Split(Shown):
    """Coordinates x -> (w, E) in which the stiff part E is linear: E' = A E + N_E, w' = N_w.

    - to(x) -> w, E and back(w, E) -> x are linear and inverse to each other; E has shape (k, c), w is a vector.
    - A (k, k) [1/s]: the linear part, constant over an arc.
    - remainder(t, w, E) -> N_w, N_E, of the shapes of w and E.
    """

    to: Callable[[Array], tuple[Array, Array]]
    back: Callable[[Array, Array], Array]
    A: Array
    remainder: Callable[[float, Array, Array], tuple[Array, Array]]


class Relaxing(NamedTuple):
    """Entries of x that relax to other entries of x, such as the torques of lagging motors to their commands.

    x_at' = speed (x_to - x_at), and x_to is constant between two breaks. RK4 integrates them exactly
    (`hybrid.relaxation`), so that a short time constant needs no shorter step.
    """

    at: slice
    """Places in x of the numbers that move."""
    to: slice
    """Places in x of the entries to which they relax, as many."""
    speed: float
    """Inverse of their time constant [1/s]."""


class HybridSystem(Shown):
    """A hybrid system; see the module for the equations. A subclass overrides the methods of what it has."""

    def flow(self, t: float, x: Array, mode: AnyMode) -> Array:
        """x' at (t, x) in `mode`, of the shape of x (nx,), t in [s]."""
        raise NotImplementedError(f"{type(self).__name__} has neither a flow nor a mover")

    def check_state(self, t: float, x: Array) -> None:
        """Raise RanAwayError for a state x (nx,) at t [s] beyond the system's bounds; this base has none."""

    def mover(self, fired: str | None) -> Mover | None:
        """The function that moves a system without flow and guards, such as another simulator, over one arc.

        None for a system with a flow and guards, which `hybrid.march` integrates. fired: name of the event that
        ended the arc before, None at the start.
        """
        return None

    def record(self, every: int) -> Recorder:
        """An empty recorder for the nodes (stored instants) of one arc; it keeps each `every`-th integration
        step.
        """
        return Recorder(every)

    def guards(self, mode: AnyMode) -> tuple[Guard, ...]:
        """The event functions that are watched in `mode`."""
        return ()

    def clocks(self) -> tuple[Clock, ...]:
        """The clocks, in the order in which they tick at equal times."""
        return ()

    def switching_times(self, mode: AnyMode) -> tuple[float, ...]:
        """Times [s] of the run at which the flow in `mode` is not smooth; no step goes across one of them."""
        return ()

    def split(self, mode: AnyMode) -> Split | None:
        """Coordinates for the exponential method in `mode`; None where the system has none."""
        return None

    def relaxing(self) -> Relaxing | None:
        """The entries of x that relax to others, such as lagging torques to their commands, and that RK4 has to
        integrate exactly; None for none.
        """
        return None
