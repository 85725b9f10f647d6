"""Runs of a walker in compiled code, with the trajectory that the Python engine would leave.

Three ways, the fastest that fits is taken:

- all compiled: controller, observer, disturbance and method of integration can be compiled; an arc
  is one call of a kernel;
- compiled plant, sampled time: the same kernel, which calls Python at sample instants and impacts
  (`engine.compiled_walker`);
- compiled plant otherwise: the Python loop of `hybrid.simulator` on compiled dynamics.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

import numpy as np

from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.core.types import Array
from biped_adrc.engine.compiled_biped import CompiledBiped, compiled_references
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.kernels.compiled_run import CompiledRun
from biped_adrc.engine.run import COMPILED, COMPILED_PLANT
from biped_adrc.engine.symbols import NotCompiled
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.simulator import FlownArc, RunOptions, run_arcs
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Arc, Event, Trajectory

TERMINAL = {Status.FELL: "hip_too_low", Status.STALLED: "step_too_long"}
"""Names of the event functions that end a run, by status."""


ONWARD, STORE = 0.005, 1_000_000
"""How far Python looks past the last good state of a lost run [s]; it keeps no nodes between."""


def run_compiled(
    walker: Walker, x0: Array, mode: Mode, method: OneStepMethod, options: RunOptions
) -> Trajectory:
    """As `hybrid.simulator.run` for a walker, from x0 (nx,).

    The trajectory's settings say which engine ran and, where it is not all compiled, why. Raises
    InputError for a start that is not finite or parts that do not fit, ModelError for a robot that
    is no planar tree.
    """
    options.check(np.asarray(x0))
    try:
        compiled = CompiledWalker.of(walker, method, walker.controller_size(x0), options.t0)
    except NotCompiled as reason:
        run = on_compiled_plant(walker, x0, mode, method, options)
        text = f"{reason}; it runs in Python on the compiled plant"
        why = {"engine": COMPILED_PLANT, "why": text}
        return replace(run, settings={**run.settings, **why})
    run = run_made(compiled, x0, mode, method, options)
    return replace(run, detail=detail_of(walker, method, run))


def run_made(
    compiled: CompiledWalker, x0: Array, mode: Mode, method: OneStepMethod, options: RunOptions
) -> Trajectory:
    """The run of a walker that is compiled already, from x0 (nx,), in any thread."""
    run = compiled.plan.start(x0, options.t0, *mode, options.t_end)
    longest, left = compiled.walker.max_step_time, options.t_end - options.t0
    run.keep(left if options.t0 - mode.start >= longest else min(left, longest))
    run["every"] = options.store_every

    def fly(t: float, x: Array, mode: Mode, fired: str | None) -> FlownArc:
        arc = flown(run, mode)
        error = compiled.raised(run)
        return arc if error is None else _ended_by(error, arc.arc)

    walked = run_arcs(fly, x0, mode, method.label, options)
    return replace(walked, settings={**walked.settings, "engine": COMPILED})


def _ended_by(error: BaseException, arc: Arc) -> FlownArc:
    """The arc that ends with what Python raised at a sample instant or an impact; raises it where a mistake is
    seen at once, at the first sample instant.
    """
    if not isinstance(error, Exception):
        raise error
    status, detail = simulator.status_of(error)
    if status is Status.RAISED and len(arc.t) == 1:
        raise error
    return FlownArc(arc, status, detail)


def detail_of(walker: Walker, method: OneStepMethod, run: Trajectory) -> str:
    """The detail of a run, with what Python says of its next steps where compiled code lost its numbers.

    Machine code gives NaN without a name; the methods in Python name the class that gave it.
    """
    if run.status not in (Status.NOT_FINITE, Status.SINGULAR, Status.RAN_AWAY):
        return run.detail
    options = RunOptions(run.t_end + ONWARD, run.t_end, store_every=STORE)
    try:
        result = simulator.run(walker, run.final_state, run.arcs[-1].mode, method, options)
    except Exception as error:  # what a method raises in Python, such as a division by zero
        return f"{run.detail}: {type(error).__name__}: {error}"
    if result.status is not run.status or not result.detail:
        return run.detail
    return result.detail if run.detail in result.detail else f"{run.detail}: {result.detail}"


def on_compiled_plant(
    walker: Walker, x0: Array, mode: Mode, method: OneStepMethod, options: RunOptions
) -> Trajectory:
    """A run from x0 (nx,) with compiled dynamics and references, and sample instants in Python.

    All is in Python in continuous time, and for a disturbance or a method without a compiled form. Raises as
    `run_compiled`.
    """
    walker, compiled = compiled_plant(walker), None
    if walker.sampled:
        size = walker.controller_size(x0)
        with suppress(NotCompiled):
            compiled = CompiledWalker.of(walker, method, size, options.t0, in_python=True)
    if compiled is None:
        return simulator.run(walker, x0, mode, method, options)
    return run_made(compiled, x0, mode, method, options)


def compiled_plant(walker: Walker) -> Walker:
    """The walker with compiled dynamics and references. Raises ModelError."""
    controller = compiled_references(walker.controller, walker.plant.n)
    model = None if walker.model is None else CompiledBiped.of(walker.model)
    plant = CompiledBiped.of(walker.plant)
    return replace(walker, plant=plant, model=model, controller=controller)


def flown(run: CompiledRun, mode: Mode) -> FlownArc:
    """A run to its end or the first event, with the impact there."""
    nx, event, outcome = run.nx, None, None
    status, strikes = run.stride(1)
    for t, *x in strikes:
        outcome = np.array(x[nx:]), Mode(mode.step + 1, t)
        event = Event(FOOT_STRIKE, t, np.array(x[:nx]), outcome[0])
    if status in TERMINAL:
        event = Event(TERMINAL[status], run["t"], run.x.copy(), None)
    t, x, dx = (part.copy() for part in np.hsplit(run.rows(), (1, 1 + nx)))
    nodes = Arc(mode, t[:, 0], x, dx, event)
    detail = f"after t = {nodes.t[-1]:.6g} s" if status in simulator.FAILURES else ""
    status = Status.COMPLETED if status is Status.TIME_OUT else status
    return FlownArc(nodes, status, detail, outcome)
