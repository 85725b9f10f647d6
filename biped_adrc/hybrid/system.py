"""What a hybrid system is: a flow, guards with resets, clocks, and the times at which inputs switch.

    x' = f(t, x; mode)        between events
    x+, mode+ = reset(t, x-)  when a guard's witness crosses zero in its direction
    x+ = update(t, x-, mode)  at the ticks t0 + k T of a clock

At equal times the order is reset, tick, flow. `mode` is any immutable value of the system's own, such as
a step counter; the loop only carries it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import Any, NamedTuple

from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Event
from biped_adrc.shown import Shown
from biped_adrc.types import Array

Mode = Any
Outcome = tuple[Array, Mode] | None
"""(x+, mode+) after an event; None where the run ends with it."""


class Found(NamedTuple):
    """The event that ended an arc."""

    event: Event
    outcome: Outcome = None
    status: Status = Status.COMPLETED


Mover = Callable[[float, Array, Mode, float, Any], tuple[float, Array, Found | None]]
"""move(t, x, mode, until, record) -> t, x, and the event that ended the arc there, if one did.

Nodes go into `record`, a `simulator.Record`, as they are made, so that they are kept where it raises.
"""


class Direction(Enum):
    """Which zero crossings of a witness count. A zero at the start never fires, a zero at the end does."""

    FALLING = -1
    EITHER = 0
    RISING = 1

    def crossed(self, before: float, after: float) -> bool:
        """Whether a witness that went from `before` to `after` crossed zero this way."""
        falling = before > 0.0 >= after
        rising = before < 0.0 <= after
        if self is Direction.FALLING:
            return falling
        return rising if self is Direction.RISING else falling or rising


@dataclass(frozen=True)
class Guard(Shown):
    """A named zero crossing of witness(t, x) over (t0, t1].

    `reset(t, x)` returns (x+, mode+), or None to let the crossing pass as no event. A guard with a
    `terminal` status ends the run instead. A guard fires only after its witness has left zero.
    """

    name: str
    witness: Callable[[float, Array], float]
    reset: Callable[[float, Array], tuple[Array, Mode] | None] | None = None
    direction: Direction = Direction.FALLING
    terminal: Status | None = None


@dataclass(frozen=True)
class Clock(Shown):
    """Ticks at t0 + k * period [s]; `update(t, x, mode)` returns x+.

    t0 is `offset` [s] after the start of the arc, or of the run when `restart` is False.
    """

    name: str
    period: float
    update: Callable[[float, Array, Mode], Array]
    restart: bool = True
    offset: float = 0.0


@dataclass(frozen=True)
class Split(Shown):
    """Coordinates x -> (p, E) in which the stiff part is linear: E' = A E + N_E, p' = N_p.

    E has shape (k, c) and A (k, k); `to` and `back` are inverse to each other; `remainder(t, p, E)`
    returns (N_p, N_E). `node(t, p, E)` returns that, x and x'; where `back` is linear none is needed.
    """

    to: Callable[[Array], tuple[Array, Array]]
    back: Callable[[Array, Array], Array]
    A: Array
    remainder: Callable[[float, Array, Array], tuple[Array, Array]]
    node: Callable[[float, Array, Array], tuple[tuple[Array, Array], Array, Array]] | None = None


class HybridSystem(Shown):
    """A hybrid system; see the module for the equations."""

    def flow(self, t: float, x: Array, mode: Mode) -> Array:
        """x' at (t, x) in `mode`."""
        raise NotImplementedError(f"{type(self).__name__} has neither a flow nor a mover")

    def mover(self, fired: str | None) -> Mover | None:
        """What moves the system over one arc where it has no flow and no guards; None where it has.

        fired: the event that ended the arc before.
        """
        return None

    def guards(self, mode: Mode) -> tuple[Guard, ...]:
        """The guards watched in `mode`."""
        return ()

    def clocks(self) -> tuple[Clock, ...]:
        """The clocks, in the order in which they tick at equal times."""
        return ()

    def switching_times(self, mode: Mode) -> tuple[float, ...]:
        """Times [s] in `mode` at which the flow is not smooth; no step goes across one."""
        return ()

    def split(self, mode: Mode) -> Split | None:
        """Coordinates for the exponential method; None when the system has none."""
        return None

    def feedback_split(self, mode: Mode) -> Split | None:
        """Those with a controller's feedback in the linear part too; None, or InputError, for none."""
        return None
