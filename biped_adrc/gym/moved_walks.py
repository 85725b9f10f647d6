"""N walks of learners moved on sample by sample, one after the other: plants that move by themselves, such as
MuJoCo, and controllers that run in Python.

A sample goes from one sample instant, or impact, to the next sample instant or impact. `Now` is all that a walk
is made of. The samples are those of `ba.walk_scenario`, bit for bit.

The walker's controller runs in Python around a compiled plant, or the plant moves by itself.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple, cast

import numpy as np

from biped_adrc.analysis.certificate import Support
from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.system import ClosedLoop
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Walker
from biped_adrc.control.base import Measurement
from biped_adrc.engine.compiled_loop import CompiledLoop
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.kernels.run_plan import STATUS
from biped_adrc.engine.program import NotCompiled
from biped_adrc.engine.simulate import compiled_plant
from biped_adrc.engine.strides import Strides
from biped_adrc.engine.ticks import TicksWithHardware, flowing
from biped_adrc.errors import InputError
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.gym.compiled_walks import place_of_torque
from biped_adrc.gym.episode import Episode, Needs
from biped_adrc.gym.view import learner_view
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.simulator import RunOptions, finite, flow_arc
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.system import HybridSystem
from biped_adrc.hybrid.trajectory import Arc
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


class MovedWalk:
    """One walk, where it is, and the arcs of this single support so far.

    Ticks of a clock that does not restart are counted from 0 s.
    """

    def __init__(self, episode: Episode):
        """At its start. Raises InputError for what cannot walk sample by sample."""
        self.episode = episode
        self.loop, self.system = moving(episode)
        self.timing = cast(SampledTime, self.loop.timing)
        start = self.loop.initial_state(episode.q, episode.v, episode.mode)
        self.now = Now(0.0, start, episode.mode, 0.0)
        self.arcs: list[Arc] = []

    def give(self, torque: Array) -> None:
        """The learner's torque (p,) [N m] of the coming sample, where the controller reads it."""
        self.episode.torque[:] = torque
        if isinstance(self.system, Strides) and self.system.code is not None:
            at = place_of_torque(self.system.code.numbers)
            self.system.code.K[at : at + len(torque)] = torque

    def sample(self, over: Callable[[Support], None]) -> Status:
        """To the next sample instant; COMPLETED where it goes on, else `now` is at the end.

        over is told what each single support that ends on the way needed.
        """
        while True:
            until, now, system = self._until(), self.now, self.system
            if isinstance(system, Strides):
                system = replace(system, began=now.began)
            at = (now.t, now.x, now.mode, now.fired, now.began)
            with handing_out(), np.errstate(over="ignore", invalid="ignore"):
                made = finite(flow_arc(system, None, RunOptions(until, 0.0), *at))
            self.arcs.append(made.arc)
            if made.arc.event is not None or made.status is not Status.COMPLETED:
                over(self.episode.needed(joined(self.arcs)))
                self.arcs = []
            event, t, x = made.arc.event, float(made.arc.t[-1]), made.arc.x[-1]
            if made.status is not Status.COMPLETED:
                self.now = now._replace(t=t, x=x)
                return made.status
            if made.outcome is None or event is None:
                self.now = Now(t, x.copy(), now.mode, now.began)  # a view would keep all nodes
                return Status.COMPLETED
            self.now = Now(event.t, *made.outcome, event.t, FOOT_STRIKE)
            if self.timing.restart or event.t >= until:
                return Status.COMPLETED

    def _until(self) -> float:
        """The first sample instant after `now` [s], by the expression that the engines have."""
        t, period = self.now.t, self.timing.period
        origin = self.now.began if self.timing.restart else 0.0
        k = max(0, math.floor((t - origin) / period))
        while origin + k * period <= t:
            k += 1
        return origin + k * period

    def seen(self, reference: Reference) -> Array:
        """The numbers of `view.LearnerView` where it is, in one row."""

        def point(s: Array, m: Measurement) -> ReferencePoint:
            return reference(m.t, m.q, m.v)

        view = learner_view(self.loop, self.now.t, self.now.x, self.now.mode, point)
        return np.concatenate(view)


def joined(arcs: Sequence[Arc]) -> Arc:
    """One arc of arcs of the same single support that follow one another."""
    kept = [arc for arc in arcs if arc.read] or arcs  # one that failed at once has read nothing
    t, x, dx = (np.concatenate([getattr(arc, name) for arc in kept]) for name in ("t", "x", "dx"))
    read = {name: np.concatenate([arc.read[name] for arc in kept]) for name in kept[0].read}
    return Arc(arcs[0].mode, t, x, dx, arcs[-1].event, read)


def moving(episode: Episode) -> tuple[ClosedLoop[Any], HybridSystem]:
    """The closed loop of an episode, in sampled time, and the same as the simulator runs it.

    Raises InputError for a disturbance or a method without a compiled form, on the rigid plant.
    """
    walker, loop = episode.walker, episode.loop
    if loop is None:
        return walker, _ticks(walker, episode.method)
    if not isinstance(loop, CompiledLoop):
        return loop, loop
    still = np.zeros(loop.plant.n)
    size = len(loop.law.initial_state(loop.measure(0.0, still, still, Mode())))
    return loop, loop.system(size, 0.0)


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


class MovedWalks:
    """N walks; what it hands out is as of `compiled_walks.CompiledWalks`."""

    def __init__(self, count: int, reference: Reference):
        """reference: the curve that errors refer to."""
        self.reference, self.needs = reference, Needs(count)
        self.walks: list[MovedWalk | None] = [None] * count
        self.codes = np.ones(count, dtype=np.int64)
        self.seen = np.zeros((count, 0))

    def begin(self, i: int, episode: Episode) -> None:
        """Walk i anew; row i of `seen` is what is to be seen at its start."""
        walk = self.walks[i] = MovedWalk(episode)
        row = walk.seen(self.reference)
        if self.seen.shape[1] != len(row):
            self.seen = np.zeros((len(self.codes), len(row)))
        self.seen[i], self.codes[i] = row, 0
        self.needs.begin(i)

    def move(self, torques: Array) -> None:
        """Every walk whose code is 0 by one sample, under its row of torques (N, p) [N m]."""
        for i, walk in enumerate(self.walks):
            if walk is not None and self.codes[i] == 0:
                walk.give(torques[i])
                self.codes[i] = STATUS.index(walk.sample(partial(self.needs.add, i)))
                self.seen[i] = walk.seen(self.reference)
