"""What a hybrid system is: a flow, event functions with resets, clocks, and times at which inputs switch.

    x' = f(t, x; mode)        between events
    x+, mode+ = reset(t, x-)  when a guard's witness (event function) crosses zero in its direction
    x+ = update(t, x-, mode)  at the sample instants t0 + k T of a clock

At equal times the order is reset, sample instant, flow. `mode` is the discrete state: any immutable
value of the system's own, such as a step counter; the simulator only carries it from arc to arc.

`hybrid.simulator` runs what is defined here. `closed_loop.system.ClosedLoop` is the base of all
systems of this package; a user's own hybrid system needs `flow` alone.
"""

from __future__ import annotations

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
    """Guard, time and states."""
    outcome: JumpResult = None
    """(x+, mode+), None where the run ends here."""
    status: Status = Status.COMPLETED
    """How the run ends, for an event that ends it."""


Mover = Callable[[float, Array, AnyMode, float, Any], tuple[float, Array, FoundEvent | None]]
"""move(t, x, mode, until, record) -> t, x, and the event that ended the arc there, if one did.

Moves a system from t to `until` [s] or to its next event in whatever way it likes. Nodes go into
`record`, a `trajectory.Recorder`, as they are made, so that they are kept where it raises.
"""


@dataclass(frozen=True)
class Guard(Shown):
    """An event function: a named zero crossing of witness(t, x), downwards, and what follows from it.

    - witness(t, x): real function whose zero is the event.
    - reset(t, x): (x+, mode+), or None to let the crossing pass as no event.
    - terminal: with a status, the run ends at the crossing in place of a reset.

    A guard watches from the start of an arc on. Where its witness begins at zero, as after its own reset, it
    fires after the witness has risen, however shortly. A witness that bends down from zero, a body at rest on
    what it would bounce off, ends the run as EVENT_LIMIT; one that falls steadily after its own reset is let
    pass. One that begins at zero or below and falls, at the start, after a jump of the state, or as the second
    of two events at one instant, fires at once; so a time that is over leaves the guards with its reset's mode,
    or another event at that very instant fires it again. One that begins below zero and rises fires the next
    time that it falls through zero.
    """

    name: str
    witness: Callable[[float, Array], float]
    reset: Callable[[float, Array], tuple[Array, AnyMode] | None] | None = None
    terminal: Status | None = None


@dataclass(frozen=True)
class Clock(Shown):
    """Sample instants at t0 + k * period [s], at which `update(t, x, mode)` gives x+.

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
    """Coordinates x -> (p, E) in which the stiff part is linear: E' = A E + N_E, p' = N_p.

    - to(x) -> p, E and back(p, E) -> x are linear and inverse to each other; E has shape (k, c).
    - A (k, k) [1/s]: the linear part, constant over an arc.
    - remainder(t, p, E) -> N_p, N_E.
    """

    to: Callable[[Array], tuple[Array, Array]]
    back: Callable[[Array, Array], Array]
    A: Array
    remainder: Callable[[float, Array, Array], tuple[Array, Array]]


class Relaxing(NamedTuple):
    """Numbers of x that go to others, which are constant between breaks: x_at' = speed (x_to - x_at).

    RK4 steps over them exactly (`hybrid.relaxation`), so that a fast one needs no shorter step.
    """

    at: slice
    """Places in x of the numbers that move."""
    to: slice
    """Places in x of their limits, as many."""
    speed: float
    """Inverse of their time constant [1/s]."""


class HybridSystem(Shown):
    """A hybrid system; see the module for the equations. Override what the system has."""

    def flow(self, t: float, x: Array, mode: AnyMode) -> Array:
        """x' at (t, x) in `mode`, of the shape of x (nx,), t in [s]."""
        raise NotImplementedError(f"{type(self).__name__} has neither a flow nor a mover")

    def check_state(self, t: float, x: Array) -> None:
        """Raise RanAwayError for a state x (nx,) at t [s] beyond what the system can have; none by default."""

    def mover(self, fired: str | None) -> Mover | None:
        """The object that moves the system over one arc where it has no flow and no guards; None where it has
        them.

        fired: name of the event that ended the arc before, None at the start.
        """
        return None

    def record(self, every: int) -> Recorder:
        """Room for the nodes of one arc, of which each `every`-th is kept."""
        return Recorder(every)

    def guards(self, mode: AnyMode) -> tuple[Guard, ...]:
        """The event functions that are watched in `mode`."""
        return ()

    def clocks(self) -> tuple[Clock, ...]:
        """The clocks, in the order in which they tick at equal times."""
        return ()

    def switching_times(self, mode: AnyMode) -> tuple[float, ...]:
        """Times [s] in `mode` at which the flow is not smooth; no step goes across one of them."""
        return ()

    def split(self, mode: AnyMode) -> Split | None:
        """Coordinates for the exponential method; None when the system has none."""
        return None

    def relaxing(self) -> Relaxing | None:
        """The numbers of x that RK4 has to step over exactly; None for none."""
        return None
