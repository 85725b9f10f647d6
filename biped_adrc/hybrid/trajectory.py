"""The result of a run: arcs of dense output joined by events, and a status.

An arc is the flow between two events. It is stored as nodes, which are instants (t, x, x'), and evaluated
between them by the cubic Hermite polynomial. `hybrid.simulator` makes trajectories, and so do the compiled
loops of `engine`; `hybrid.storage` writes them to disk, `analysis.signals` reads signals off them.
"""

from dataclasses import dataclass, field, replace
from typing import Any, Self

import numpy as np

from biped_adrc.core.errors import InputError
from biped_adrc.core.shown import Frozen, Shown
from biped_adrc.core.types import Array, freeze, frozen
from biped_adrc.hybrid.status import Status


@dataclass(frozen=True)
class Event(Frozen):
    """An event function that fired."""

    guard: str
    """Name of the event function."""
    t: float
    """Time of the event [s]."""
    x_minus: Array
    """State before (nx,)."""
    x_plus: Array | None
    """State after (nx,); None where the run ended there."""


@dataclass(frozen=True)
class Arc(Shown):
    """One flow between two events, as K nodes; at a sample instant or a switch of an input a time
    occurs twice.
    """

    mode: Any
    """Discrete state in which the arc ran, for a walker its `Mode`."""
    t: Array
    """Times of the nodes (K,) [s]."""
    x: Array
    """States (K, nx)."""
    dx: Array
    """Slopes x' (K, nx)."""
    event: Event | None = None
    """The event that ended the arc; None at the end of a run without one."""
    read: dict[str, Array] = field(default_factory=dict)
    """Name -> signal at the nodes (K, ..) that cannot be computed again from the states and so was recorded."""

    def __post_init__(self) -> None:
        freeze(self, "t", "x", "dx")
        object.__setattr__(self, "read", {name: frozen(x) for name, x in self.read.items()})

    @property
    def seen(self) -> Array:
        """Node times (K,) [s] at which a signal has its left limit where it jumps.

        The first of the two equal times of a jump, and the end of the arc, are the next smaller float: a signal
        evaluated there is what acted until the jump, such as the torque before a sample instant.
        """
        later = np.append(self.t[1:], self.t[-1])  # the next node's time, for the last node its own
        return np.where(self.t == later, np.nextafter(self.t, -np.inf), self.t)

    def thinned(self, apart: float) -> Self:
        """A copy of the arc with fewer nodes, at least `apart` [s] apart; ends and both sides of jumps stay."""
        # keep: at first both nodes of each pair of equal times, the first node and the last one
        same = np.diff(self.t) == 0.0
        keep = np.append(same, True) | np.concatenate(([True], same))
        last = self.t[0]
        for k in np.flatnonzero(~keep):
            if self.t[k] - last >= apart * (1.0 - 1e-9):  # round-off of the times does not decide
                keep[k], last = True, self.t[k]
        read = {name: rows[keep] for name, rows in self.read.items()}
        return replace(self, t=self.t[keep], x=self.x[keep], dx=self.dx[keep], read=read)

    def __call__(self, t: float, side: str = "right") -> Array:
        """x(t) (nx,) by cubic Hermite interpolation, t in [s]; the limit from `side` where x or x' jumps.

        side: "right" or "left". A t outside of the arc continues its first or last cubic.
        """
        if len(self.t) == 1:
            return self.x[0].copy()
        # i: the interval from node i to i + 1 that has t, the later one of two for the limit from the right
        i = int(np.searchsorted(self.t, t, side="right" if side == "right" else "left")) - 1
        i = min(max(i, 0), len(self.t) - 2)
        (x0, x1), (dx0, dx1), h = self.x[i : i + 2], self.dx[i : i + 2], self.t[i + 1] - self.t[i]
        if h == 0.0:
            return x1.copy()
        s = (t - self.t[i]) / h
        r = 1.0 - s
        return r * r * (1 + 2 * s) * x0 + s * s * (3 - 2 * s) * x1 + h * s * r * (r * dx0 - s * dx1)


@dataclass
class Recorder:
    """The nodes of an arc while it is integrated.

    The lists t, x and dx grow by one entry with every call of `add`: t [s], x (nx,), dx (nx,) of one node, or
    (K,), (K, nx), (K, nx) of K nodes.
    """

    every: int
    """Each `every`-th integration step is to be added; whoever adds nodes counts."""
    t: list[float | Array] = field(default_factory=list)
    x: list[Array] = field(default_factory=list)
    dx: list[Array] = field(default_factory=list)

    def add(self, t: float | Array, x: Array, dx: Array) -> None:
        """Add one node t [s], x (nx,), dx (nx,), or K nodes as K rows of each."""
        self.t.append(t)
        self.x.append(x)
        self.dx.append(dx)

    def arc(self, mode: Any, event: Event | None) -> Arc:
        """Make an arc of the nodes recorded so far, which ran in `mode` and ended in `event`, None for none."""
        return Arc(mode, np.hstack(self.t), np.vstack(self.x), np.vstack(self.dx), event)


@dataclass(frozen=True)
class Trajectory(Shown):
    """A whole run: arcs in order of time. Call it with t [s] for the state.

    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    >>> run = ba.walk(walker, gait, impacts=2).trajectory
    >>> run(0.1).shape, len(run.events())
    ((10,), 2)
    """

    arcs: tuple[Arc, ...]
    """The arcs in order of time, at least one."""
    status: Status
    """How the run ended."""
    detail: str = ""
    """What is known beyond the status, such as the time and the error's own text."""
    settings: dict[str, Any] = field(default_factory=dict)
    """Method, engine and whatever else a caller adds: plain values, which are written to disk with the run."""

    def __repr__(self) -> str:
        first, nodes = self.arcs[0], sum(len(arc.t) for arc in self.arcs)
        time = f"{self.t_start:.4g} to {self.t_end:.4g} s: {len(self.arcs)} arcs, {nodes} nodes"
        return f"Trajectory({self.status.name}, {time} of {first.x.shape[1]} numbers)"

    @property
    def t_start(self) -> float:
        """Start of the first arc [s]."""
        return float(self.arcs[0].t[0])

    @property
    def t_end(self) -> float:
        """End of the last arc [s]."""
        return float(self.arcs[-1].t[-1])

    def __call__(self, t: float, side: str = "right") -> Array:
        """x(t) (nx,), t in [s]; at an event x+ for side "right" (the default), x- for side "left".

        Raises InputError outside [t_start, t_end] or for another side.
        """
        if side not in ("left", "right"):
            raise InputError(f"side is '{side}', expected 'left' or 'right'")
        if not self.t_start <= t <= self.t_end:
            raise InputError(f"t = {t} s is outside [{self.t_start}, {self.t_end}] s")
        # at an event the next arc begins with x+; after the last arc there is only the event's own x_plus
        ends = [arc.t[-1] for arc in self.arcs]
        i = int(np.searchsorted(ends, t, side="right" if side == "right" else "left"))
        last = self.arcs[-1].event
        if side == "right" and t == self.t_end and last is not None and last.x_plus is not None:
            return last.x_plus.copy()
        return self.arcs[min(i, len(self.arcs) - 1)](t, side)

    def events(self, guard: str | None = None) -> tuple[Event, ...]:
        """All events in order of time, or those of the event function named `guard`."""
        result = (arc.event for arc in self.arcs if arc.event is not None)
        return tuple(e for e in result if guard is None or e.guard == guard)

    def before(self, guard: str) -> Array:
        """States x- (events, nx) just before every event of `guard`: points on the section of a return map."""
        return np.array([event.x_minus for event in self.events(guard)])

    @property
    def final_state(self) -> Array:
        """The state at the end (nx,): x+ when the run ended at an event."""
        return self(self.t_end)
