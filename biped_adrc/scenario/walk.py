"""Simulation of one walk by one integration method, or by several in turn.

ADRC's observer answers the edge of a push by a transient of 1 to 2 ms, far shorter than the step that suffices
elsewhere. A walk is therefore cut at impacts into parts (`Part`), with a fine step in the single supports in
which the disturbance switches and a usual one in the others; the trajectories are joined.

`walk` is for walkers made in Python, from the orbit of a gait, `walk_scenario` for scenarios. Both return a
`Walk`. `execute_twice` is what a worker process runs: an `Outcome` of a few numbers, with the same walk at half
the step, whose difference estimates the error of integration.

    walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    made = ba.walk(walker, gait, impacts=8)          # a Walk
    refined(walker, 8, 1, RK4(), 5e-5)               # parts: usual, fine where the push switches, usual

Robots without motors walk on their known cycle, the fixed point of the return map: Newton's method finds it
from the stored state, and a walk starts just after its impact.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from types import NoneType
from typing import NamedTuple

import numpy as np

from biped_adrc.closed_loop.other_plant import walk_on
from biped_adrc.closed_loop.protocols import SteppingPlant
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.base import Controller
from biped_adrc.core.checks import check_part, handing_out, numbers
from biped_adrc.core.errors import InputError, WalkWarning, check_count
from biped_adrc.core.types import Array
from biped_adrc.engine.on_plant import stepping_loop
from biped_adrc.engine.program import COMPILED
from biped_adrc.engine.run import simulate_by
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4, Adaptive, OneStepMethod, Stiff
from biped_adrc.hybrid.simulator import Progress
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.model.robots.limits import Limits
from biped_adrc.scenario.build import RIGID, RobotAndGait, build, plant_around, soft_loop
from biped_adrc.scenario.recording import Outcome, Walk
from biped_adrc.scenario.scenario import FREE, RunRecord, Scenario


class Part(NamedTuple):
    """Consecutive single supports of a walk that are integrated by one method."""

    impacts: int
    """How many impacts it ends with."""
    method: OneStepMethod


METHODS: dict[str, Callable[..., OneStepMethod]] = {
    "rk4": RK4,
    "exponential": Exponential,
    "adaptive": Adaptive,
    "stiff": Stiff,
}
FINE_STEP = 5e-5
"""[s] of the exponential method where a push switches. After an edge the error of ADRC is a spike of 1 to 2 ms;
this step gives its peak within 0.2 %, one of 1 ms is wrong by a factor of five."""


HARDWARE_STEP = 2.5e-4
"""[s] of RK4 behind sensors, motors or a torque limit. Of 200 random walks 191 have the
same results at a quarter of it; of those at 1 ms, 176."""
STABLE = 2.5
"""Largest |lambda| h of RK4 [1], which is stable up to 2.78 on the real axis."""
RESOLVED = 0.5
"""Largest |lambda| h [1] at which RK4 follows what decays (static friction around zero rate) within 0.05 %."""


ASIDE = 1e-12
"""Offset of a start [rad, rad/s] by which rounding is judged: between round-off and the error of a step."""
DECIDES = 1e-7
"""[rad, s]: walks that begin ASIDE of each other and are farther apart at an impact depend on rounding. Smooth
flows take them some 400 times apart at most (of 22 laws and robots)."""


def default_method(walker: Walker) -> OneStepMethod:
    """The exponential method where the walker has a linear stiff part (an observer), RK4 at 1 ms elsewhere.

    At less behind hardware, whose counts and limits magnify an error of the motion, where a controller's own
    motion would make that unstable, such as a short line of delay, or where static friction acts on little
    inertia.
    """
    method: Exponential | RK4 = Exponential() if walker.split(Mode()) is not None else RK4()
    hardware = (walker.sensors, walker.motors, walker.torque_limit)
    if walker.sampled and any(x is not None for x in hardware):
        method = RK4(HARDWARE_STEP)
    if isinstance(method, RK4) and method.h * (rate := rate_of_law(walker)) >= STABLE:
        method = RK4(1.0 / rate)
    rubs = rate_of_friction(walker.plant)
    return method if method.h * rubs <= RESOLVED else replace(method, h=RESOLVED / rubs)


def rate_of_friction(plant: Biped) -> float:
    """Largest |eigenvalue| [1/s] of D_s^-1 dF/dq' of joint friction F at q = q' = 0; 0 for none."""
    if not plant.friction:
        return 0.0
    still = np.zeros(plant.n)
    J = np.linalg.solve(plant.inertia(still), plant.friction_derivative(still))
    return float(np.max(np.abs(np.linalg.eigvals(J))))


def rate_of_law(walker: Walker) -> float:
    """Largest |eigenvalue| [1/s] of ds'/ds of a controller, by differences at q = q' = 0; 0 for none.

    In sampled time no state of a controller flows.
    """
    if walker.sampled:
        return 0.0
    still = np.zeros(walker.plant.n)
    try:
        with handing_out():
            m = walker.measure(0.0, still, still, Mode())
            s, law = walker.law.initial_state(m), walker.law
            if len(s) == 0:
                return 0.0
            u, moved = law.output(s, m), np.diag(1e-3 * np.maximum(1.0, np.abs(s)))
            ahead, behind = ([law.flow(s + d * side, m, u) for d in moved] for side in (1.0, -1.0))
        J = (np.array(ahead) - np.array(behind)) / (2.0 * np.diag(moved))[:, np.newaxis]
        return float(np.max(np.abs(np.linalg.eigvals(J))))
    except Exception:  # whatever a method may raise: the walk itself says what is wrong
        return 0.0


def methods_of(run: RunRecord, walker: Walker) -> tuple[OneStepMethod, float | None]:
    """The integration method of a walk, and its step where a push switches [s]; None for the usual one.

    The walker's default where the record gives neither method nor step: on the compiled engine with `FINE_STEP`
    for the exponential method. In Python the fine steps would take minutes; there they have to be asked for,
    and `Walk.remarks` says so.
    """
    if run.method in FREE:
        return METHODS[run.method](run.tolerance, run.tolerance), None
    method = default_method(walker) if run.method is None else METHODS[run.method]()
    if run.h is not None:
        return replace(method, h=run.h), run.fine  # type: ignore[type-var]
    usual = run.fine is None and run.method is None and run.engine == COMPILED
    return method, FINE_STEP if usual and isinstance(method, Exponential) else run.fine


def refined(
    walker: Walker, impacts: int, first_step: int, usual: OneStepMethod, fine: float | None
) -> tuple[Part, ...]:
    """Parts with steps of `fine` [s] in the single supports in which the disturbance switches and those after.

    Where it switches at times of the walk rather than of a single support, all of the walk is fine, since it is
    not known beforehand in which single support that will be.
    """
    if fine is None:
        return (Part(impacts, usual),)
    steps = range(first_step, first_step + impacts)
    times = walker.disturbance.switching_times if walker.disturbance else lambda *at: ()
    late, short = walker.max_step_time, replace(usual, h=fine)  # type: ignore[type-var]
    switched = {k for k in steps if any(map(math.isfinite, times(k, k * late)))}
    methods = (short if {k, k - 1} & switched else usual for k in steps)
    return tuple(Part(len(list(group)), method) for method, group in groupby(methods))


def halved(s: Scenario, walker: Walker) -> Scenario:
    """The same scenario with every integration step half as long, to estimate the error of integration.

    On the compiled engine. A method that chooses its own step becomes the explicit adaptive one with a
    hundredth of the tolerance. Steps below the range of a scenario are not refused: its shortest has a half.
    """
    run, ground, values = s.run, s.ground, dict[str, object](engine=COMPILED)
    if ground.plant != RIGID:
        ground = ground.model_copy(update={"plant_step": 0.5 * ground.engine_step})
    elif run.method in FREE:
        values |= {"method": "adaptive", "tolerance": 1e-2 * run.tolerance}
    else:
        usual, fine = methods_of(run, walker)
        assert isinstance(usual, RK4 | Exponential)
        values |= {"h": 0.5 * usual.h, "fine": fine and 0.5 * fine}
    return s.model_copy(update={"ground": ground, "run": run.model_copy(update=values)})


def walk(
    walker: Walker,
    gait: Gait = None,  # type: ignore[assignment]  # so that a scenario alone is answered in words
    impacts: int = 25,
    method: OneStepMethod | None = None,
    *,
    start: tuple[Array, Array] | None = None,
    first_step: int = 1,
    progress: Progress | None = None,
    engine: str = COMPILED,
    within: Limits | None = None,
    plant: str | SteppingPlant | None = None,
) -> Walk:
    """Walk from (q+, q'+) after the impact of the gait's orbit, or from `start`, for some impacts.

    Each of `Walk.remarks` is also a `WalkWarning`. A walker without a slope walks on that of its plant, or of
    the gait. start: (q, v), each (n,) [rad, rad/s]. first_step: number of the first single support. method: by
    default that of `methods_of`. engine: "compiled", whose place Pinocchio takes where it cannot run, or
    "pinocchio"; the trajectory's settings say what ran ("engine") and why not what was asked for ("why"). Under
    ADRC and a push the default step of "pinocchio", 0.5 ms, is too long for ADRC's errors after an edge (ten
    times too large under Table I), which a remark says; "compiled" takes 0.05 ms there. Every step of the
    method is kept, so that peaks and certificates miss none. A fall is a status of the trajectory. within: the
    walk ends, with the status INFEASIBLE, where it would leave these limits; without, `Walk.feasibility` alone
    judges by them. plant: in place of the rigid one, by name ("mujoco", soft ground) or itself, as
    MuJoCoPlant(biped, ground); then the walker acts at ticks, and there is no method. Raises InputError for
    parts that do not fit together.

    >>> walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, impacts=3)
    >>> walk.trajectory.status.name, walk.feasibility.status.name
    ('COMPLETED', 'COMPLETED')
    """
    check_part(walker, "what is to walk", Walker)
    check_part(gait, "the gait of the walk", Gait)
    check_part(method, "the method of the walk", OneStepMethod, NoneType)
    check_count(impacts, f"the walk asks for {impacts} impacts")
    check_count(first_step, f"the walk begins in single support {first_step}")
    if start is None:
        if (count := len(gait.q_minus)) != (n := walker.nominal.n):
            raise InputError(
                f"gait '{gait.name}' is of robot '{gait.robot}' with {count} coordinates, and the walker is "
                f"'{walker.nominal.description.name}' with {n}; expected a gait of this robot: "
                "load_gait(name, biped) or design_gait(biped, speed)"
            )
        start = gait.start(walker.nominal)
    parts = tuple[Part, ...]()
    if walker.slope is None:
        walker = replace(walker, slope=getattr(plant, "slope", gait.slope))
    if plant is not None:
        check_part(method, "the method on a plant of its own", NoneType)
        moved = plant_around(plant, walker, {}) if isinstance(plant, str) else plant
        loop = stepping_loop(walker, moved, engine, first_step)
        check_start(*start, walker)
        run = walk_on(loop, walker, start, Mode(first_step), impacts, progress)
    else:
        usual = RunRecord.model_construct(engine=engine)
        methods = methods_of(usual, walker) if method is None else (method, None)
        parts = refined(walker, impacts, first_step, *methods)
        run = in_parts(walker, start, Mode(first_step), parts, engine, progress)
    result = Walk(walker, gait, run, parts=parts)
    for remark in result.remarks:
        warnings.warn(remark, WalkWarning, stacklevel=2)
    return result if within is None else result.until_infeasible(within)


def walk_scenario(
    s: Scenario, progress: Progress | None = None, controller: Controller | None = None
) -> Walk:
    """Simulate a scenario from the impact of the gait's periodic orbit, or of a passive robot's cycle.

    The same scenario gives the same walk in every process: all random numbers come from its seed.

    progress: called as the walk goes on. controller: in place of the scenario's, such as an exported one; the
    walk then keeps no scenario. A fall is a status of the trajectory, not an error.
    Raises InputError for values that do not fit together.

    >>> walk = ba.walk_scenario(ba.Scenario("NPD", run={"impacts": 2}))
    >>> walk.outcome.status
    'COMPLETED'
    """
    check_part(s, "what is to walk", Scenario)
    check_part(controller, "the controller of the walk", Controller, NoneType)
    scene, mode = RobotAndGait.of(s), Mode(s.run.first_step)
    walker = build(s, scene)
    if controller is not None:
        walker = replace(walker, controller=controller)
    begin, parts = scene.start(s), tuple[Part, ...]()
    if (loop := soft_loop(s, walker)) is not None:
        run = walk_on(loop, walker, begin, mode, s.run.impacts, progress)
    else:
        parts = refined(walker, s.run.impacts, mode.step, *methods_of(s.run, walker))
        run = in_parts(walker, begin, mode, parts, s.run.engine, progress)
    return Walk(walker, scene.gait, run, s if controller is None else None, parts=parts)


def execute_twice(s: Scenario) -> Outcome:
    """The outcome of a scenario's walk, with that at half of its integration steps in `Outcome.half`."""
    walk = walk_scenario(s)
    return replace(walk.outcome, half=walk_scenario(halved(s, walk.walker)).outcome)


def rounding(walk: Walk) -> float:
    """How far apart a walk and one from a start ASIDE are: max |dq| [rad], |dt| [s] at impacts and the end.

    Infinite where one makes more impacts. Where a comparison decides, as in an encoder, neighbours may read
    other counts and walk apart from then on; around an unstable motion a quantised loop does so by and by
    (Delchamps, IEEE TAC 35(8), 1990), at any step. Raises InputError for a walk without parts.
    """
    if not walk.parts:
        what = "a walk from a file, on another plant or cut short has no steps to repeat"
        raise InputError(f"{what}; ask one just made by walk or walk_scenario")
    n, first = walk.walker.plant.n, walk.trajectory.arcs[0]
    k = np.arange(len(first.x[0]))
    x = first.x[0] + np.where(k < 2 * n, ASIDE * np.cos(k), 0.0)  # in no direction of symmetry
    beside = runs_in_parts(walk.walker, x, first.mode, walk.parts)
    runs = walk.trajectory.arcs, [arc for run in beside for arc in run.arcs]
    a, b = (np.array([(arc.t[-1], *arc.x[-1, :n]) for arc in arcs]) for arcs in runs)
    return float(np.max(np.abs(a - b))) if len(a) == len(b) else math.inf


def in_parts(
    walker: Walker,
    start: tuple[Array, Array],
    mode: Mode,
    parts: Sequence[Part],
    engine: str,
    progress: Progress | None = None,
) -> Trajectory:
    """The run from `start` by several methods in turn.

    Each part begins after the last impact of the one before. start: (q, v), each (n,) [rad, rad/s]. Ends early
    with a fall. Raises InputError for more than one part under a clock that does not restart at impact, since a
    part begins with a sample instant.
    """
    if len(parts) > 1 and not getattr(walker.timing, "restart", True):
        raise InputError(
            f"the walk has {len(parts)} parts, and its clock does not restart at impact; expected one part, or "
            "SampledTime(..., restart=True)"
        )
    check_start(*start, walker)
    walker.check_foot(*start, mode)
    x = walker.initial_state(*start, mode)
    return _joined(list(runs_in_parts(walker, x, mode, parts, progress, engine)))


def runs_in_parts(
    walker: Walker,
    x: Array,
    mode: Mode,
    parts: Sequence[Part],
    progress: Progress | None = None,
    engine: str = COMPILED,
) -> Iterator[Trajectory]:
    """The trajectory of each part from state x (nx,) in a mode on; none after a fall."""
    done = 0

    def shown(t: float, events: int) -> None:
        assert progress is not None
        progress(t, done + events)

    report = progress and shown
    for part in parts:
        t0, count = mode.start, part.impacts
        end = t0 + count * walker.max_step_time
        run = simulate_by(
            engine, walker, x, mode, part.method, t0=t0, t_end=end, impacts=count, progress=report
        )
        yield run
        event, done = run.arcs[-1].event, done + len(run.arcs)
        if not run.status.ok or event is None or event.x_plus is None:
            return
        x, mode = event.x_plus, Mode(run.arcs[-1].mode.step + 1, event.t)


def check_start(q: Array, v: Array, walker: Walker) -> None:
    """Raise InputError for a start that is no state, or has angles beyond a whole turn, as in degrees."""
    n = walker.plant.n
    for name, x in (("q", q), ("q'", v)):
        if np.shape(x) != (n,) or not np.all(np.isfinite(numbers(x, f"the start {name}"))):
            raise InputError(f"the start {name} is {x}, expected {n} finite numbers")
    if np.max(np.abs(q)) > 2.0 * math.pi:
        raise InputError(
            f"the start q is {q} rad, with an angle beyond a whole turn; expected radians: np.radians(q) and "
            "np.radians(v) if these are degrees"
        )


def _joined(runs: Sequence[Trajectory]) -> Trajectory:
    """One trajectory of runs that follow one another.

    Its settings["method"] says which single supports each method took.
    """
    last = runs[-1]
    if len(runs) == 1:
        return last
    labels = [
        f"{run.settings['method']} (steps {run.arcs[0].mode.step} to {run.arcs[-1].mode.step})"
        for run in runs
    ]
    arcs = tuple(arc for run in runs for arc in run.arcs)
    return replace(last, arcs=arcs, settings={**last.settings, "method": "; ".join(labels)})
