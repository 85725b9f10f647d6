"""One run of a walker by one of two engines; both leave the same trajectory up to round-off.

"pinocchio" runs the loop of `hybrid.simulator` on Pinocchio's dynamics. "compiled" takes the fastest way that
fits:

- all compiled: controller, observer, disturbance and method of integration can be compiled; an arc, the
  flow between two impacts, is one call of a kernel, the compiled loop over time;
- compiled plant, sampled time: the same kernel, which calls Python at sample instants and impacts
  (`engine.ticks`);
- compiled plant otherwise: the loop of `hybrid.simulator` on compiled dynamics;
- Pinocchio, for a robot that is no planar tree.

The settings of the trajectory say what ran.
"""

from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.core.errors import InputError, ModelError
from biped_adrc.core.types import Array
from biped_adrc.engine.calls import CompiledReference, compiled_biped, compiled_references
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.program import COMPILED, CompiledWalker
from biped_adrc.engine.ticks import PythonTicks
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4, OneStepMethod
from biped_adrc.hybrid.simulator import FlownArc, RunOptions, run_arcs
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Arc, Event, Trajectory

PINOCCHIO = "pinocchio"
COMPILED_PLANT = "compiled plant"
"""Names of the engines in settings and records; the second one is what ran where a part does not compile."""
ENGINES = (PINOCCHIO, COMPILED)
"""Engines that a caller may choose."""
TERMINAL = {Status.FELL: "hip_too_low", Status.STALLED: "step_too_long"}
"""Names of the event functions that end a run, by status."""
ONWARD, STORE = 0.005, 1_000_000
"""Time [s] that `detail_of` simulates in Python after the last good state of a lost run; `store_every` there
and in batches, so large that nodes are kept at the ends of arcs alone."""


def check_engine(engine: str) -> None:
    """Raise InputError for an engine that does not exist."""
    if engine not in ENGINES:
        raise InputError(f"engine '{engine}' is unknown; choose one of {list(ENGINES)}")


def simulate_by(
    engine: str,
    walker: Walker,
    x0: Array,
    mode: Mode,
    method: OneStepMethod,
    *,
    impacts: int | None = None,
    **options: Any,
) -> Trajectory:
    """Run a walker from x0 (nx,) by an engine of ENGINES; options are the fields of `RunOptions`.

    mode: the single support in which it starts. impacts: the run ends after so many. A robot that is no planar
    tree is simulated with Pinocchio by any engine. settings["engine"] says what ran, and settings["why"] why it
    is not the `engine` of the call. Raises InputError for an unknown engine, a start that is not finite, and
    parts that do not fit together.
    """
    check_engine(engine)
    if impacts is not None:
        options["stop_after"] = FOOT_STRIKE, impacts
    run_options, why = RunOptions(**options), {}
    if engine == COMPILED:
        try:
            # with the integration step in the text of a walk that ran away
            return _with_step(run_compiled(walker, x0, mode, method, run_options), method)
        except ModelError as error:
            why = {"why": f"{error}; Pinocchio was used instead"}
    run = _with_step(simulator.run(walker, x0, mode, method, run_options), method)
    return replace(run, settings={**run.settings, "engine": PINOCCHIO, **why})


def _with_step(run: Trajectory, method: OneStepMethod) -> Trajectory:
    """The same run; where it ran away, with the method and its integration step added to the text `detail`.

    A fixed step that is too long for the controller's poles is the most frequent cause.
    """
    if run.status is not Status.RAN_AWAY or not isinstance(method, RK4 | Exponential):
        return run
    return replace(run, detail=f"{run.detail} ({method.label})")


def run_compiled(
    walker: Walker, x0: Array, mode: Mode, method: OneStepMethod, options: RunOptions
) -> Trajectory:
    """Run a walker from x0 (nx,) as `hybrid.simulator.run` does, with all of it or its plant alone in machine
    code, in the order that the module lists.

    Raises InputError for a start that is not finite or parts that do not fit, ModelError for a robot that
    is no planar tree.
    """
    options.check(np.asarray(x0))
    layout = walker.layout_of(np.asarray(x0))
    try:
        compiled = CompiledWalker.of(walker, method, layout, options.t0)
        run = simulate_compiled(compiled, x0, mode, options)
        return replace(run, detail=detail_of(walker, method, run))
    except NotCompiled as reason:
        why = f"{reason}; it runs in Python, slower, on the compiled plant"
    # `result` stays None in continuous time, and where this second way cannot be compiled either
    (walker, references), result = compiled_plant(walker), None
    if walker.sampled:
        # where this fails too, for instance by the method, the loop of `hybrid.simulator` follows below
        with suppress(NotCompiled):
            compiled = CompiledWalker.of(walker, method, layout, options.t0, in_python=True)
            ticks = PythonTicks(compiled, walker, references)
            with ticks.interrupted():  # Ctrl-C in one of these methods ends the walk, too
                result = simulate_compiled(compiled, x0, mode, options, ticks)
    result = result or simulator.run(walker, x0, mode, method, options)
    return replace(result, settings={**result.settings, "engine": COMPILED_PLANT, "why": why})


def simulate_compiled(
    compiled: CompiledWalker,
    x0: Array,
    mode: Mode,
    options: RunOptions,
    ticks: PythonTicks | None = None,
) -> Trajectory:
    """Run a walker that is compiled already from x0 (nx,); any thread may do so.

    compiled: its program, method and plan. mode: the single support in which it starts. ticks: the Python
    functions of its sample instants and impacts, which `compiled.plan` calls; None where machine code has them.
    """
    run = compiled.plan.start(x0, options.t0, *mode, options.t_end)
    longest, left = compiled.walker.max_step_time, options.t_end - options.t0
    # room for the nodes (stored instants) of one arc: to t_end where the single support is too long already,
    # else to its latest end
    run.keep(left if options.t0 - mode.start >= longest else min(left, longest))
    run["every"] = options.store_every

    def flown(t: float, x: Array, mode: Mode, fired: Event | None) -> FlownArc:
        """Move one arc to the end of the run or to its first event, and make the impact there.

        Its arguments, which `run_arcs` gives to any engine, are not read: the run in memory is already where
        the last arc ended.
        """
        # the run ends after one impact at the latest
        nx, event, outcome = run.nx, None, None
        strikes, status = run.strikes(1), run.stride()
        for t, *x in strikes[: int(run["struck"])]:  # one row (t, x-, x+), or none
            outcome = np.array(x[nx:]), Mode(mode.step + 1, t)
            event = Event(FOOT_STRIKE, t, np.array(x[:nx]), outcome[0])
        # TERMINAL: status -> name of the event function that ends a run so
        if status in TERMINAL:
            event = Event(TERMINAL[status], run["t"], run.x.copy(), None)
        # rows (t, x, x') of the nodes
        at, x, dx = (part.copy() for part in np.hsplit(run.rows(), (1, 1 + nx)))
        arc = Arc(mode, at[:, 0], x, dx, event)
        # an exception in Python's sample instant; an arc of one node has not begun, and its error is raised
        if ticks is not None and ticks.error is not None:
            return FlownArc(arc, *simulator.status_of(ticks.error, begun=len(arc.t) > 1))
        # `run_arcs` decides whether the end of the time is a TIME_OUT
        detail = f"after t = {arc.t[-1]:.6g} s" if status in simulator.FAILURES else ""
        status = Status.COMPLETED if status is Status.TIME_OUT else status
        return FlownArc(arc, status, detail, outcome)

    walked = run_arcs(flown, x0, mode, compiled.still.label, options)
    return replace(walked, settings={**walked.settings, "engine": COMPILED})


def detail_of(walker: Walker, method: OneStepMethod, run: Trajectory) -> str:
    """The text `detail` of a run of machine code; where it was lost, with what Python says of the same failure.

    Machine code returns NaN, or notes a singular matrix or a run away, and cannot say in which class that
    arose; Python names the class. So Python simulates on from the last good state for ONWARD seconds; where
    that does not fail in the same way, the text stays as it is.
    """
    if run.status not in (Status.NOT_FINITE, Status.SINGULAR, Status.RAN_AWAY):
        return run.detail
    # ONWARD: how long Python goes on [s]; STORE: each so many steps a node is stored
    options = RunOptions(run.t_end + ONWARD, run.t_end, store_every=STORE)
    try:
        result = simulator.run(walker, run.final_state, run.arcs[-1].mode, method, options)
    except Exception as error:  # what a method raises in Python, such as a division by zero
        return f"{run.detail}: {type(error).__name__}: {error}"
    if result.status is not run.status or not result.detail:
        return run.detail
    return result.detail if run.detail in result.detail else f"{run.detail}: {result.detail}"


def compiled_plant(walker: Walker) -> tuple[Walker, list[CompiledReference]]:
    """A copy of the walker with the dynamics of plant and model, and the references of its controller, in
    machine code; and a list of these references. Raises ModelError for a robot that is no planar tree.
    """
    references = list[CompiledReference]()
    controller = compiled_references(walker.controller, walker.plant.n, references)
    model = None if walker.model is None else compiled_biped(walker.model)
    plant = compiled_biped(walker.plant)
    return replace(walker, plant=plant, model=model, controller=controller), references
