"""A walk that is moved on sample by sample, under a torque and a force from outside.

    u = u_c + torque,    zeta = zeta_w + J(q)' force

u_c and zeta_w are those of the walker; torque (p,) [N m] adds to the motors', force (2,) [N] acts on the origin
of the trunk (`control.added_torque`, `disturbances.added_force`). A sample goes from one sample instant to the
next; where an impact restarts the clock, it ends there.

A `CompiledWalk` lies in memory, and the kernel `samples` moves many of them in one call. A `PythonWalk` is
moved by `hybrid.simulator.flow_arc`: a controller in Python on the compiled plant, or a plant of its own.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Self, cast

import numpy as np

from biped_adrc.closed_loop.protocols import Loop, Mode
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.system import ClosedLoop
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Walker
from biped_adrc.control.added_torque import AddedTorque
from biped_adrc.control.base import Measurement
from biped_adrc.disturbances.added_force import AddedForce
from biped_adrc.engine.compiled_loop import CompiledLoop
from biped_adrc.engine.compiled_push import CompiledPush
from biped_adrc.engine.compiled_signals import Reading, SignalNumbers, reading_code
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.equations import WalkerNumbers
from biped_adrc.engine.kernels.run_plan import CompiledRun
from biped_adrc.engine.machine import LoadedCode
from biped_adrc.engine.program import NotCompiled
from biped_adrc.engine.simulate import compiled_plant
from biped_adrc.engine.strides import Strides
from biped_adrc.engine.symbols import floats
from biped_adrc.engine.ticks import TicksWithHardware, flowing
from biped_adrc.errors import RaisedError
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.simulator import RunOptions, finite, flow_arc
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.system import HybridSystem
from biped_adrc.model.planar import link_point
from biped_adrc.parts import handing_out
from biped_adrc.timing import SampledTime
from biped_adrc.types import Array


class Driven(NamedTuple):
    """A walker under a torque and a force from outside."""

    walker: Walker
    torque: Array
    """(p,) [N m]; what runs in Python reads it here."""
    force: Array
    """(2,) [N], likewise."""

    @classmethod
    def of(cls, walker: Walker) -> Self:
        """Both are zero."""
        plant, torque, force = walker.plant, np.zeros(walker.plant.p), np.zeros(2)
        added = AddedForce(force, link_point(plant, plant.description.trunk))
        push = added if walker.disturbance is None else walker.disturbance + added
        law = AddedTorque(walker.controller, torque)
        return cls(replace(walker, controller=law, disturbance=push), torque, force)


def torque_place(numbers: WalkerNumbers) -> int:
    """Where the torque from outside is among the numbers of a driven walker."""
    inner = cast(AddedTorque, numbers.controller).inner
    return len(floats((numbers.plant, numbers.model, inner)))


def force_place(made: CompiledWalker) -> int:
    """Cell of a run at which the force from outside is: it is the last term of the disturbance."""
    assert made.walker.disturbance is not None
    return made.plan.term(len(made.walker.disturbance.terms) - 1)


def read_in_python(
    loop: ClosedLoop[Any], t: float, x: Array, mode: Mode, view: Reading, reference: Reference
) -> Array:
    """What `view` says of a loop in x (nx,) at t [s], in one row."""

    def point(s: Array, m: Measurement) -> ReferencePoint:
        return reference(m.t, m.q, m.v)

    return np.concatenate([np.ravel(part) for part in view(cast(Loop, loop), t, x, mode, point)])


@dataclass(frozen=True)
class CompiledWalk:
    """One walk in memory."""

    made: CompiledWalker
    run: CompiledRun
    """Where it is; moved by the kernel `samples`."""

    @classmethod
    def of(
        cls,
        driven: Driven,
        method: OneStepMethod,
        start: tuple[Array, Array],
        mode: Mode,
        reference: Reference | None,
    ) -> Self:
        """From (q, v), each (n,). reference: for `code`. Raises NotCompiled for a part without machine code."""
        walker, t = driven.walker, mode.start
        x = walker.initial_state(*start, mode)
        made = CompiledWalker.of(walker, method, walker.controller_size(x), t, reference)
        return cls(made, made.plan.start(x, t, *mode, t))

    @property
    def addresses(self) -> list[int]:
        """In the order of `kernels.samples.WALK`."""
        torque = self.run.place("K") + torque_place(self.made.program.numbers)
        at = self.run.address
        return [at, at + 8 * torque, at + 8 * force_place(self.made)]

    @property
    def row(self) -> Array:
        """(t, step, x) where it is (2 + nx,)."""
        return np.array([self.run["t"], self.run["step"], *self.run.x])

    def copied(self) -> Self:
        """The same walk in memory of its own."""
        run = self.run
        return replace(self, run=CompiledRun(run.block, run.pointers, run.nx))

    def code(self, view: Reading, reference: Reference) -> LoadedCode:
        """Machine code with a function "read", for what `view` says."""
        watched = SignalNumbers(self.made.program.numbers, reference)
        return reading_code("read", view, self.made.program.make, watched)

    def read(self, view: Reading, reference: Reference) -> Array:
        """What `view` says where it is, in one row, by Python."""
        mode = Mode(int(self.run["step"]), self.run["t_start"])
        return read_in_python(self.made.walker, self.run["t"], self.run.x, mode, view, reference)


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


@dataclass(frozen=True)
class PythonWalk:
    """One walk by `flow_arc`. Sample instants of a clock that does not restart are counted from 0 s."""

    loop: ClosedLoop[Any]
    system: HybridSystem
    """The loop as the simulator runs it."""
    method: OneStepMethod | None
    """None where the system moves by itself."""
    torques: tuple[Array, ...]
    """Where the torque from outside is read, each (p,) [N m]."""
    forces: tuple[Array, ...]
    """Where the force from outside is read, each (2,) [N]."""
    now: Now

    @classmethod
    def of(
        cls,
        driven: Driven,
        loop: SteppingLoop | None,
        method: OneStepMethod,
        start: tuple[Array, Array],
        mode: Mode,
    ) -> Self:
        """From (q, v), each (n,). loop: the walker's around a plant of its own; None for the rigid plant."""
        of = driven.walker if loop is None else loop
        x = of.initial_state(*start, mode)
        made = _rigid(driven, method, len(x)) if loop is None else _moving(driven, loop, x)
        return cls(*made, Now(mode.start, x, mode, mode.start))

    @property
    def row(self) -> Array:
        """(t, step, x) where it is (2 + nx,)."""
        return np.array([self.now.t, self.now.mode.step, *self.now.x])

    def copied(self) -> Self:
        """Itself: `sample` gives another walk."""
        return self

    def sample(self, torque: Array, force: Array) -> tuple[Self, Status]:
        """The walk at its next sample instant, with COMPLETED, or at its end.

        Raises RaisedError where a class of the user's raises.
        """
        for places, x in ((self.torques, torque), (self.forces, force)):
            for place in places:
                place[:] = x
        walk, timing = self, cast(SampledTime, self.loop.timing)
        while True:
            now, until, system = walk.now, walk._until(), self.system
            if isinstance(system, Strides):
                system = replace(system, began=now.began)
            at = (now.t, now.x, now.mode, now.fired, now.began)
            with handing_out(), np.errstate(over="ignore", invalid="ignore"):
                flown = finite(flow_arc(system, self.method, RunOptions(until, 0.0), *at))
            event, t, x = flown.arc.event, float(flown.arc.t[-1]), flown.arc.x[-1].copy()
            if flown.status is Status.RAISED:
                raise RaisedError(flown.detail)
            if flown.status is not Status.COMPLETED:
                return replace(walk, now=now._replace(t=t, x=x)), flown.status
            if flown.outcome is None or event is None:
                return replace(walk, now=Now(t, x, now.mode, now.began)), flown.status
            walk = replace(walk, now=Now(event.t, *flown.outcome, event.t, FOOT_STRIKE))
            if timing.restart or event.t >= until:
                return walk, flown.status

    def _until(self) -> float:
        """The first sample instant after `now` [s], by the expression that the engines have."""
        timing, t = cast(SampledTime, self.loop.timing), self.now.t
        origin, period = self.now.began if timing.restart else 0.0, timing.period
        k = max(0, math.floor((t - origin) / period))
        while origin + k * period <= t:
            k += 1
        return origin + k * period

    def read(self, view: Reading, reference: Reference) -> Array:
        """What `view` says where it is, in one row."""
        return read_in_python(self.loop, *self.now[:3], view, reference)


Made = tuple[
    ClosedLoop[Any],
    HybridSystem,
    OneStepMethod | None,
    tuple[Array, ...],
    tuple[Array, ...],
]
"""The fields of a `PythonWalk` but `now`."""


def _rigid(driven: Driven, method: OneStepMethod, size: int) -> Made:
    """The rigid plant compiled: the controller in Python, or all but the plant where a push or method is so.

    size: numbers in a state.
    """
    fast, _ = compiled_plant(driven.walker)
    try:
        held = CompiledWalker.held(fast, method)
    except NotCompiled:
        return fast, fast, method, (driven.torque,), (driven.force,)
    assert fast.held is not None
    cells = held.plan.cells.copy()
    held = replace(held, plan=replace(held.plan, cells=cells))
    at = force_place(held)
    forces = driven.force, cells.view(np.float64)[at : at + 2]
    system = TicksWithHardware(fast, held, flowing(fast.held.sizes, size))
    return fast, system, None, (driven.torque,), forces


def _moving(driven: Driven, loop: SteppingLoop, x: Array) -> Made:
    """A plant that moves by itself, its sample instants and what acts on it compiled where they can be."""
    torques, forces = [driven.torque], [driven.force]
    if not isinstance(loop, CompiledLoop):
        return loop, loop, None, tuple(torques), tuple(forces)
    size = loop.controller_size(x)
    system, tick = loop.system(size, 0.0), loop.compiled(size).tick
    if tick is not None:
        at = torque_place(tick.numbers)
        torques.append(tick.K[at : at + loop.plant.p])
    if isinstance(system, Strides) and isinstance(system.push, CompiledPush):
        forces.append(system.push.K[-1][:2])
    return loop, system, None, tuple(torques), tuple(forces)
