"""A walker's walk on a plant that moves by itself: its controller, sensors, motors and pushes, another ground.

    walker -> SteppingLoop -> Trajectory with states (q, q', s, held), as the rigid plant's

What the plant keeps for itself is taken out of the states, so that whatever reads a walk reads this one.
At the nodes is recorded, since it cannot be computed again: forces of the ground, places and velocities of both
feet, where the plant has feet (`closed_loop.feet`).

A `CompiledLoop` has its sample instants in machine code, one call each,

    sample (t, step, t_start, x) -> x, xi^, least pivot

whose measurement, model, controller, limits and queue of torques are those of `closed_loop.semantics`, traced
as for a walker (`engine.equations`). A controller that cannot be compiled still gets the terms of its model and
its references from machine code. The settings of the trajectory say what ran: "compiled", or "compiled model",
where the controller runs in Python, with the reason as "why".
"""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cached_property
from threading import get_ident
from typing import Any

import numpy as np

from biped_adrc.closed_loop.feet import with_readings
from biped_adrc.closed_loop.protocols import (
    LaggingPlant,
    Load,
    OnFeet,
    SteppingPlant,
    UnevenPlant,
    lag_of,
)
from biped_adrc.closed_loop.semantics import parts
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.core.errors import InputError, ModelError
from biped_adrc.core.timing import SampledTime
from biped_adrc.core.types import Array
from biped_adrc.engine.compiled_biped import Call, CompiledBiped, compiled_references
from biped_adrc.engine.compiled_push import CompiledPush, summed
from biped_adrc.engine.kernels.record import OUTSIDE
from biped_adrc.engine.program import Program, controller_numbers
from biped_adrc.engine.run import COMPILED, PINOCCHIO
from biped_adrc.engine.symbols import NotCompiled, floats
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.simulator import Progress, RunOptions
from biped_adrc.hybrid.trajectory import Arc, Event, Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar_robot import robot_of


def stepping_loop(
    walker: Walker, plant: SteppingPlant, engine: str = COMPILED, first_step: int = 1
) -> SteppingLoop:
    """All of a walker but its plant, around another one; its sample instants compiled, or in Python.

    A lag of its motors and steps of its ground become the plant's, a rate limit stays where it is. first_step:
    number of the first single support, by which steps of the ground are counted. Raises InputError for a
    walker in continuous time, and for what only the rigid plant has: errors of the impact map.
    """
    if len(walker.gain) > 0:
        raise InputError(
            f"the walker has an error of the impact map, and {type(plant).__name__} takes none; leave that "
            "out, or walk on the rigid plant"
        )
    if not isinstance(walker.timing, SampledTime):
        raise InputError(
            f"{type(plant).__name__} is controlled at ticks, and this walker acts at every instant; give a "
            "period, as timing=SampledTime(1e-3), or period = 0.001 in a scenario"
        )
    motors = None if walker.motors is None else replace(walker.motors, lag=0.0)
    loop = CompiledLoop if engine == COMPILED else SteppingLoop
    return loop(
        _fitted(plant, walker, first_step),
        walker.controller,
        walker.disturbance,
        walker.timing,
        walker.nominal,
        walker.torque_limit,
        walker.sensors,
        motors,
        walker.touchdown,
        walker.runaway_speed,
        walker.runaway_torque,
    )


def _fitted(plant: SteppingPlant, walker: Walker, first_step: int) -> SteppingPlant:
    """The plant with the lag of the walker's motors, and on the steps of its ground.

    Raises InputError for a plant that takes none, or that has others.
    """
    name, steps = type(plant).__name__, walker.ground_steps
    lag = 0.0 if walker.motors is None else walker.motors.lag
    own = {"lag": lag_of(plant), "steps": getattr(plant, "ground_steps", ())}
    for what, kind, other in (("lag", LaggingPlant, lag), ("steps", UnevenPlant, steps)):
        if own[what] != other and (own[what] or not isinstance(plant, kind)):
            raise InputError(
                f"{name} has {what} {own[what]} and the walker {other}; give motors with lag and steps of the "
                "ground to the walker alone, and to a plant that takes them"
            )
    if lag and isinstance(plant, LaggingPlant):
        plant = plant.lagging(lag)
    return plant.on_steps(steps, first_step) if steps and isinstance(plant, UnevenPlant) else plant


def walk_on(
    loop: SteppingLoop,
    walker: Walker,
    start: tuple[Array, Array],
    mode: Mode,
    impacts: int,
    progress: Progress | None = None,
) -> Trajectory:
    """Simulates a loop of `stepping_loop` from (q, v), each (n,) [rad, rad/s], until `impacts` impacts.

    The states of the result have the walker's layout, (q, q', s, held). Raises InputError where (q, v) cannot
    be a start.
    """
    assert isinstance(loop.timing, SampledTime)
    x0 = loop.initial_state(*start, mode)
    longest = walker.max_step_time + loop.timing.period  # what takes too long is seen at a tick
    options = RunOptions(
        mode.start + impacts * longest,
        mode.start,
        stop_after=(FOOT_STRIKE, impacts),
        progress=progress,
    )
    return as_walked(loop, loop.run(x0, options, mode))


def as_walked(loop: SteppingLoop, run: Trajectory) -> Trajectory:
    """Converts a run of `loop` to the layout of a walker's states, (q, q', s, held).

    The plant's own numbers are removed, but for the torque of lagging motors, which moves to where a walker has
    it. Of a plant with feet, forces [N], places [m] and velocities [m/s] of both feet are recorded besides.
    """
    if isinstance(loop.plant, OnFeet):
        run = with_readings(loop, run)
    arcs = tuple(_as_rigid(loop, arc) for arc in run.arcs)
    engine = {"engine": PINOCCHIO, "why": "the plant moves by itself"}
    settings = {**engine, **run.settings, "plant": _values(loop.plant)}
    return replace(run, arcs=arcs, settings=settings)


def _as_rigid(loop: SteppingLoop, arc: Arc) -> Arc:
    """An arc with states as the rigid plant's walker has them, and with the place of the stance foot."""
    size, p, k = loop.controller_size(arc.x[0]) + 2 * loop.plant.n, loop.plant.p, loop.held
    assert k is not None
    mine, line = slice(size, size + k.sizes.own), -p * (k.sizes.waiting + 1)

    def without(x: Array) -> Array:
        """The plant's own out, and u_m where the rigid plant's walker has it."""
        u_m = loop.motor_torque(x)[..., : p if lag_of(loop.plant) > 0.0 else 0]
        return np.concatenate(
            (np.delete(x[..., :line], mine, axis=-1), u_m, x[..., line:]), axis=-1
        )

    event = arc.event
    if event is not None:
        after = None if event.x_plus is None else without(event.x_plus)
        event = Event(event.guard, event.t, without(event.x_minus), after)
    return replace(arc, x=without(arc.x), dx=without(arc.dx), event=event)


def _values(thing: Any) -> Any:
    """A plant as plain values for the record of a run: its class and what it was made with."""
    if isinstance(thing, tuple):
        return tuple(map(_values, thing))
    if not is_dataclass(thing) or isinstance(thing, Biped):
        return thing if isinstance(thing, int | float | str) else type(thing).__name__
    values = {f.name: _values(getattr(thing, f.name)) for f in fields(thing) if f.init}
    return {"class": type(thing).__name__, **values}


COMPILED_MODEL = "compiled model"
"""Name of the engine where the controller runs in Python on a compiled model."""


class CompiledTick:
    """The function `sample` of a loop whose controller has `size` states, with room for what it is given.

    Not to be shared between threads. Raises NotCompiled where a part cannot be traced, with the reason.
    """

    def __init__(self, loop: SteppingLoop, size: int):
        if not isinstance(loop.model, Biped):
            raise NotCompiled(f"the model is a {type(loop.model).__name__}, expected a Biped")
        assert loop.held is not None
        try:
            robot = robot_of(loop.model)
        except ModelError as reason:
            raise NotCompiled(str(reason)) from reason
        self.numbers = controller_numbers(robot, loop)
        K = np.array([*floats(self.numbers), 0.0])
        if np.any(np.isnan(K)):
            raise NotCompiled(f"a parameter of {type(loop.controller).__name__} or its loop is NaN")
        program = Program(size, K, self.numbers)
        owner = program.functions(["sample"])
        n, p, nx = loop.plant.n, loop.plant.p, program.nx
        self.sample = Call(owner, "sample", K, np.zeros(3 + nx + n + OUTSIDE), nx + p + 1)
        self.x, self.xi = np.zeros(0), np.zeros(0)
        still = np.zeros(n)
        m = loop.measure(0.0, still, still, Mode())
        self.blind = loop.calls.estimate(np.zeros(size), m) is None  # no observer
        noticing = loop.held.touchdown
        self.felt = loop if noticing and noticing.needs_force else None

    def __call__(self, t: float, x: Array, mode: Mode) -> Array | None:
        """x (nx,) after the sample instant at t [s]; None where Python has to say what is wrong.

        It is kept as `x`, and the estimate of xi (p,) there as `xi`.
        """
        inp = self.sample.inp
        inp[0], inp[1], inp[2] = t, mode.step, mode.start
        inp[3 : 3 + len(x)] = x
        if self.felt is not None:
            q, v, _, tail = parts(self.felt, x)
            inp[-OUTSIDE:] = self.felt.foot_forces(t, q, v, tail, mode)
        out = self.sample()
        if not (out[-1] > 0.0 and math.isfinite(out.dot(out))):
            return None
        self.x, self.xi = out[: len(x)], out[len(x) : -1]
        if self.blind:
            self.xi = np.full(len(self.xi), math.nan)
        return self.x


@dataclass(frozen=True)
class LoopInCode(SteppingLoop):
    """A loop with what there is of it in machine code, in one thread."""

    code: CompiledTick | None = None
    """Its sample instants; None where a part of it cannot be compiled."""
    compiled_push: CompiledPush | None = None
    """Its disturbance; None for none, or for Python."""
    why: str = ""
    """Why its sample instants are not compiled."""

    def tick(self, t: float, x: Array, mode: Mode) -> Array:
        """x (nx,) after the sample instant at t [s]."""
        after = None if self.code is None else self.code(t, x, mode)
        return super().tick(t, x, mode) if after is None else after

    def estimated(self, t: float, x: Array, mode: Mode) -> Array:
        """The estimate of xi (p,) [rad/s^2] at (t, x), t in [s]; the sample instant that gave x has left it."""
        if self.code is not None and x is self.code.x:
            return self.code.xi
        return super().estimated(t, x, mode)

    def push(self, t: float, row: Array, mode: Mode) -> Load | None:
        """What acts from outside in a row of the plant at t [s]; Python says what is wrong with numbers that
        are not finite.
        """
        if self.compiled_push is None:
            return super().push(t, row, mode)
        result = self.compiled_push(t, row, mode)
        size = result.dot(result)
        if not math.isfinite(size):
            return super().push(t, row, mode)
        return Load(result[:-2], result[-2:]) if size > 0.0 else None

    @cached_property
    def pushed_in_python(self) -> bool:
        """Whether its disturbance is not compiled."""
        return self.disturbance is not None and self.compiled_push is None

    def zetas(self, t: Array, rows: Array, mode: Mode) -> Array:
        """zeta (K, n) [N m] at K times [s], in the plant's rows, where Python does not compute it."""
        if self.compiled_push is None:
            return super().zetas(t, rows, mode)
        n = self.plant.n
        return summed(self.compiled_push.terms, t, rows[:, :n], rows[:, n : 2 * n], mode)


@dataclass(frozen=True)
class CompiledLoop(SteppingLoop):
    """As `SteppingLoop`, which says what its fields are: the same walk to round-off, much faster."""

    def run(self, x0: Array, options: RunOptions, mode: Mode | None = None) -> Trajectory:
        """As `SteppingLoop.run`, from x0 (nx,)."""
        began = Mode() if mode is None else mode
        x0 = self.checked_start(x0, options, began)
        loop = self.compiled(self.controller_size(x0))
        run = simulator.run(loop, x0, began, None, options)
        settings = {"engine": COMPILED_MODEL, "why": loop.why} if loop.why else {"engine": COMPILED}
        return replace(run, settings={**run.settings, **settings})

    def __getstate__(self) -> dict[str, object]:
        return {name: x for name, x in super().__getstate__().items() if name != "_made"}

    def compiled(self, size: int) -> LoopInCode:
        """The loop for a controller with `size` states, made once in each thread, for its work space."""
        loops: dict[tuple[int, int], LoopInCode] = vars(self).setdefault("_made", {})
        key = size, get_ident()
        if key not in loops:
            loops[key] = self._made_for(size)
        return loops[key]

    def _made_for(self, size: int) -> LoopInCode:
        """As `compiled`."""
        push = None
        if self.disturbance is not None:
            with suppress(NotCompiled):
                push = CompiledPush(self.disturbance, self.plant.n)
        parts = LoopInCode(
            **{f.name: getattr(self, f.name) for f in fields(self)}, compiled_push=push
        )
        try:
            return replace(parts, code=CompiledTick(parts, size))
        except NotCompiled as reason:
            return replace(on_compiled_model(parts), why=str(reason))


def on_compiled_model(loop: LoopInCode) -> LoopInCode:
    """The loop with the terms of its model and the references of its controller in machine code, where they
    have any.
    """
    controller = compiled_references(loop.controller, loop.plant.n)
    model = loop.model
    if isinstance(model, Biped):
        with suppress(ModelError):  # of a robot that is no planar tree
            model = CompiledBiped.of(model)
    return replace(loop, model=model, controller=controller)
