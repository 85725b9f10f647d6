"""A walk moved on from one sample instant to the next, with a hand that acts over that sample.

    moved(now, hand) -> the nodes of this sample, and where the walk is after it

A sample goes from one sample instant, or impact, to the next sample instant or impact. `Now` is all that
the walk is made of, so it may be kept and gone back to, and the same hand gives the same sample, bit for
bit. Without a hand the samples are those of `ba.walk_scenario`.

`movers.moving_of` makes one of three kinds: a walk that is machine code as a whole, one whose controller is
plain Python, and one on a plant that moves by itself, such as MuJoCo.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass, field
from typing import Any, NamedTuple, cast

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.semantics import parts
from biped_adrc.closed_loop.system import ClosedLoop
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Walker
from biped_adrc.hardware.motors import Line
from biped_adrc.hardware.sample_hold import motor_torque, read, written
from biped_adrc.hybrid.simulator import FlownArc, RunOptions, finite, flow_arc
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.system import HybridSystem
from biped_adrc.live.hand import Hand, LinkPoints
from biped_adrc.parts import handing_out
from biped_adrc.timing import SampledTime
from biped_adrc.types import Array


class Now(NamedTuple):
    """Where a walk is."""

    t: float
    """[s]"""
    x: Array
    """State (nx,) before the sample instant at t."""
    mode: Mode
    began: float
    """Where the clock of sample instants began that restarts at impacts [s]."""
    fired: str | None = None
    """The event that has just happened; None for none."""
    s: Array = np.zeros(0)
    """Run vector of the kernels, for a walk in machine code."""


class Moved(NamedTuple):
    """One sample."""

    flown: FlownArc
    now: Now | None
    """None where the walk ended; the status of `flown` says how."""


@dataclass(frozen=True)
class Moving:
    """What moves one walker on. Ticks of a clock that does not restart are counted from t_first [s]."""

    walker: Walker
    """The walker of the scenario, in sampled time, without the hand."""
    t_first: float
    points: LinkPoints = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", LinkPoints(self.walker.plant))

    @property
    def loop(self) -> ClosedLoop[Any]:
        """The closed loop that moves."""
        return self.walker

    @property
    def timing(self) -> SampledTime:
        """Of the walker."""
        return cast(SampledTime, self.walker.timing)

    def start(
        self,
        q: Array,
        v: Array,
        mode: Mode,
        t: float,
        u: Array | None = None,
        own: Array | None = None,
    ) -> Now:
        """At t [s] in q (n,) [rad], v (n,) [rad/s], within the single support `mode`.

        The controller begins as after an impact, by its `initial_state` at what is measured there. u (p,)
        [N m]: the torque that acts until its first one; none without. own: numbers of a plant that goes on
        as it is, where it has as many.
        """
        x = self.begun(q, v, mode, own)
        return self.at(t, x if u is None else self._acting(x, u), mode, t, None)

    def begun(self, q: Array, v: Array, mode: Mode, own: Array | None) -> Array:
        """x (nx,) of `start`."""
        return self.loop.initial_state(q, v, mode)

    def own(self, now: Now) -> Array:
        """The plant's own numbers (k,), none of the rigid plant."""
        k = self.loop.held
        assert k is not None
        return parts(self.loop, now.x)[3][: k.sizes.own]

    def _acting(self, x: Array, u: Array) -> Array:
        """x (nx,) with u (p,) [N m] as every torque that is on its way."""
        tail, k = parts(self.loop, x)[3], self.loop.held
        assert k is not None
        h = read(k.sizes, tail)
        line = Line(*(np.tile(u, len(part) // len(u)) for part in h.line))
        return np.concatenate((x[: len(x) - len(tail)], written(h._replace(line=line))))

    def torque(self, now: Now) -> Array:
        """The torque on the joints (p,) [N m]."""
        k = self.loop.held
        assert k is not None
        return motor_torque(read(k.sizes, parts(self.loop, now.x)[3]).line)

    def at(self, t: float, x: Array, mode: Mode, began: float, fired: str | None) -> Now:
        """The walk in x (nx,) at t [s]."""
        return Now(t, x, mode, began, fired)

    def until(self, now: Now) -> float:
        """The first sample instant after `now` [s], by the expression that the engines have."""
        origin = now.began if self.timing.restart else self.t_first
        k = max(0, math.floor((now.t - origin) / self.timing.period))
        while origin + k * self.timing.period <= now.t:
            k += 1
        return origin + k * self.timing.period

    def moved(self, now: Now, hand: Hand | None = None) -> Moved:
        """One sample on, with a hand that acts over it. A fall is a status."""
        with handing_out(), np.errstate(over="ignore", invalid="ignore"):
            made, s = self.fly(now, hand)
            made = finite(made)
        event, t = made.arc.event, float(made.arc.t[-1])
        if made.status is not Status.COMPLETED:
            return Moved(made, None)
        if made.outcome is not None and event is not None:
            x, mode = made.outcome
            return Moved(made, self.at(event.t, x, mode, event.t, FOOT_STRIKE))
        x = made.arc.x[-1].copy()  # a view would keep all nodes of the sample
        return Moved(made, Now(t, x, now.mode, now.began, None, s))

    @abstractmethod
    def fly(self, now: Now, hand: Hand | None) -> tuple[FlownArc, Array]:
        """As `moved`, with the run vector at the end, empty for a walk that has none."""


def in_python(system: HybridSystem, moving: Moving, now: Now) -> FlownArc:
    """One sample of a system with a mover."""
    options = RunOptions(moving.until(now), moving.t_first)
    at = (now.t, now.x, now.mode, now.fired, now.began)
    return flow_arc(system, None, options, *at)
