"""A walker's walk on a plant that moves by itself: its controller, sensors, motors and pushes, another ground.

    walker -> SteppingLoop -> Trajectory with states (q, q', s, held), as the rigid plant's

A `CompiledLoop` has its sample instants in machine code, one call each,

    sample (t, step, t_start, x) -> x, least pivot

whose measurement, model, controller, limits and queue of torques are those of `closed_loop.semantics`, traced
as for a walker (`engine.equations`). A controller that cannot be compiled still gets the terms of its model and
its references from machine code. The settings of the trajectory say what ran: "compiled", or "compiled model",
where the controller runs in Python, with the reason as "why".
"""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from biped_adrc.closed_loop.layout import as_walked
from biped_adrc.closed_loop.protocols import (
    LaggingPlant,
    Load,
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
from biped_adrc.engine.compiled_push import Terms, acting, terms_of
from biped_adrc.engine.kernels.record import OUTSIDE
from biped_adrc.engine.program import Program
from biped_adrc.engine.run import COMPILED
from biped_adrc.engine.symbols import NotCompiled
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.simulator import Progress, RunOptions
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.biped import Biped


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


COMPILED_MODEL = "compiled model"
"""Name of the engine where the controller runs in Python on a compiled model."""


@dataclass(frozen=True)
class LoopInCode(SteppingLoop):
    """A loop with what there is of it in machine code, for one run."""

    program: Program | None = None
    """Of its sample instants; None where a part of it cannot be compiled."""
    terms: Terms | None = None
    """Those of its disturbance; None for none, or for Python."""
    why: str = ""
    """Why its sample instants are not compiled."""

    @cached_property
    def sample(self) -> Call:
        """The function `sample` of the program, with room for what it is given."""
        assert self.program is not None
        code, nx = self.program.functions(["sample"]), self.program.nx
        return Call(
            code, "sample", self.program.K, np.zeros(3 + nx + self.plant.n + OUTSIDE), nx + 1
        )

    def tick(self, t: float, x: Array, mode: Mode) -> Array:
        """x (nx,) after the sample instant at t [s]; Python says what is wrong with numbers that are not
        finite.
        """
        if self.program is None:
            return super().tick(t, x, mode)
        inp = self.sample.inp
        inp[0], inp[1], inp[2] = t, mode.step, mode.start
        inp[3 : 3 + len(x)] = x
        if self.touchdown is not None and self.touchdown.needs_force:
            q, v, _, tail = parts(self, x)
            inp[-OUTSIDE:] = self.foot_forces(t, q, v, tail, mode)
        out = self.sample()
        if out[-1] > 0.0 and math.isfinite(out.dot(out)):
            return out[:-1]
        return super().tick(t, x, mode)

    def push(self, t: float, row: Array, mode: Mode) -> Load | None:
        """What acts from outside in a row of the plant at t [s]; Python says what is wrong with numbers that
        are not finite.
        """
        if self.terms is None:
            return super().push(t, row, mode)
        result = acting(self.terms, t, row[np.newaxis], mode, self.plant.n)[0]
        size = result.dot(result)
        if not math.isfinite(size):
            return super().push(t, row, mode)
        return Load(result[:-2], result[-2:]) if size > 0.0 else None

    @cached_property
    def pushed_in_python(self) -> bool:
        """Whether its disturbance is not compiled."""
        return self.disturbance is not None and self.terms is None

    def zetas(self, t: Array, rows: Array, mode: Mode) -> Array:
        """zeta (K, n) [N m] at K times [s], in the plant's rows, where Python does not compute it."""
        if self.terms is None:
            return super().zetas(t, rows, mode)
        return acting(self.terms, t, rows, mode, self.plant.n)[:, : self.plant.n]


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

    def compiled(self, size: int) -> LoopInCode:
        """The loop for a controller with `size` states, made anew for each run, for its work space.

        What cannot be compiled still gets the terms of its model and its references in machine code, where they
        have any.
        """
        result = LoopInCode(**{f.name: getattr(self, f.name) for f in fields(self)})
        if self.disturbance is not None:
            with suppress(NotCompiled):
                result = replace(result, terms=terms_of(self.disturbance, self.plant.n))
        try:
            result = replace(result, program=Program.of_loop(result, size))
            _ = result.sample
        except NotCompiled as reason:
            controller, model = compiled_references(self.controller, self.plant.n), self.model
            if isinstance(model, Biped):
                with suppress(ModelError):  # of a robot that is no planar tree
                    model = CompiledBiped.of(model)
            result = replace(
                result, program=None, model=model, controller=controller, why=str(reason)
            )
        return result
