"""A walk moved on from one sample instant to the next.

    moved(now) -> the nodes of this sample, and where the walk is after it

A sample goes from one sample instant, or impact, to the next sample instant or impact. `Now` is all that
the walk is made of. The samples are those of `ba.walk_scenario`, bit for bit.

The walker's controller is plain Python around a compiled plant, or the plant moves by itself, such as MuJoCo.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Self, cast

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.system import ClosedLoop
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Walker
from biped_adrc.engine.compiled_loop import CompiledLoop
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.program import NotCompiled
from biped_adrc.engine.simulate import compiled_plant
from biped_adrc.engine.strides import Strides
from biped_adrc.engine.ticks import TicksWithHardware, flowing
from biped_adrc.errors import InputError
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.simulator import FlownArc, RunOptions, finite, flow_arc
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.system import HybridSystem
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


class Moved(NamedTuple):
    """One sample."""

    flown: FlownArc
    now: Now | None
    """None where the walk ended; the status of `flown` says how."""


@dataclass(frozen=True)
class Moving:
    """What moves one walk on. Ticks of a clock that does not restart are counted from 0 s."""

    loop: ClosedLoop[Any]
    """The closed loop, in sampled time."""
    system: HybridSystem
    """The same as the simulator runs it."""

    @classmethod
    def of(cls, walker: Walker, method: OneStepMethod, loop: SteppingLoop | None) -> Self:
        """On the rigid plant by a method, or in a loop around another plant.

        Raises InputError for a disturbance or a method without a compiled form, on the rigid plant.
        """
        if loop is None:
            return cls(walker, _ticks(walker, method))
        if not isinstance(loop, CompiledLoop):
            return cls(loop, loop)
        still = np.zeros(loop.plant.n)
        size = len(loop.law.initial_state(loop.measure(0.0, still, still, Mode())))
        return cls(loop, loop.system(size, 0.0))

    @property
    def timing(self) -> SampledTime:
        """Of the loop."""
        return cast(SampledTime, self.loop.timing)

    def start(self, q: Array, v: Array, mode: Mode) -> Now:
        """At 0 s in q (n,) [rad], v (n,) [rad/s], within the single support `mode`."""
        return Now(0.0, self.loop.initial_state(q, v, mode), mode, 0.0)

    def until(self, now: Now) -> float:
        """The first sample instant after `now` [s], by the expression that the engines have."""
        origin = now.began if self.timing.restart else 0.0
        k = max(0, math.floor((now.t - origin) / self.timing.period))
        while origin + k * self.timing.period <= now.t:
            k += 1
        return origin + k * self.timing.period

    def moved(self, now: Now) -> Moved:
        """One sample on. A fall is a status."""
        system = self.system
        if isinstance(system, Strides):
            system = replace(system, began=now.began)
        options = RunOptions(self.until(now), 0.0)
        at = (now.t, now.x, now.mode, now.fired, now.began)
        with handing_out(), np.errstate(over="ignore", invalid="ignore"):
            made = finite(flow_arc(system, None, options, *at))
        event, t = made.arc.event, float(made.arc.t[-1])
        if made.status is not Status.COMPLETED:
            return Moved(made, None)
        if made.outcome is not None and event is not None:
            x, mode = made.outcome
            return Moved(made, Now(event.t, x, mode, event.t, FOOT_STRIKE))
        x = made.arc.x[-1].copy()  # a view would keep all nodes of the sample
        return Moved(made, Now(t, x, now.mode, now.began))


def _ticks(walker: Walker, method: OneStepMethod) -> TicksWithHardware:
    """The controller in Python on the compiled plant. Raises InputError for what has no compiled form."""
    still = np.zeros(walker.plant.n)
    size = walker.controller_size(walker.initial_state(still, still))
    try:
        fast, _ = compiled_plant(walker)
        held = CompiledWalker.held(fast, method)
    except NotCompiled as reason:
        raise InputError(f"a learner's walk is moved in machine code, and {reason}") from reason
    assert fast.held is not None
    places = flowing(fast.held.sizes, 2 * walker.plant.n + size + walker.behind)
    return TicksWithHardware(fast, held, places)
