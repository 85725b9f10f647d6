"""Simulation of one walk.

`walk` is for walkers made in Python, from the orbit of a gait, `walk_scenario` for scenarios. Both return a
`Walk`. `execute_twice` is what a worker process runs: an `Outcome` of a few numbers, with that of the same walk
at half the integration step; their difference estimates the error of integration.

    walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    result = ba.walk(walker, gait, impacts=8)        # a Walk

Robots without motors walk on their known cycle, the fixed point of the return map from impact to impact:
Newton's method finds it from a stored state, and a walk starts just after the impact of the cycle. q, v (n,)
[rad, rad/s] are coordinates and rates; a mode is a single support, its number from 1 and the time at which it
began. The parts of a walk are runs of single supports with one integration step each (`integration`): on the
rigid plant, where a push switches, the step is finer.
"""

import warnings
from dataclasses import replace
from types import NoneType

from biped_adrc.closed_loop.other_plant import walk_on
from biped_adrc.closed_loop.protocols import SteppingPlant
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.base import Controller
from biped_adrc.control.outer_loop import own_reference
from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import InputError, WalkWarning, check_count
from biped_adrc.core.part import shared
from biped_adrc.core.types import Array
from biped_adrc.engine.on_plant import fastest_loop
from biped_adrc.engine.program import COMPILED
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4, OneStepMethod
from biped_adrc.hybrid.simulator import Progress
from biped_adrc.model.ground import Limits
from biped_adrc.scenario.build import RIGID, RobotAndGait, build, plant_around, soft_loop
from biped_adrc.scenario.integration import WalkPart, check_start, in_parts, methods_of, refined
from biped_adrc.scenario.recording import Outcome, Walk
from biped_adrc.scenario.scenario import RunRecord, Scenario


def halved(s: Scenario, walker: Walker) -> Scenario:
    """The same scenario with every integration step half as long, to estimate the error of integration.

    walker: that of the scenario; where the scenario states no integration step, the default one for this walker
    is halved. The scenario returned runs on the compiled engine. The adaptive method, which chooses its own
    step, gets a hundredth of the tolerance. The half of the shortest step that a scenario may have is not
    refused here, since `model_copy` checks no ranges.
    """
    run, ground, values = s.run, s.ground, dict[str, object](engine=COMPILED)
    if ground.plant != RIGID:
        ground = ground.model_copy(update={"plant_step": 0.5 * ground.engine_step})
    elif run.method == "adaptive":
        values |= {"tolerance": 1e-2 * run.tolerance}
    else:
        # the method with its step h, and the step where a push switches; None if that is h too
        usual, fine = methods_of(run, walker)
        assert isinstance(usual, RK4 | Exponential)
        values |= {"h": 0.5 * usual.h, "fine": fine and 0.5 * fine}
    return s.model_copy(update={"ground": ground, "run": run.model_copy(update=values)})


def step_options(walk: Walk, half: Walk) -> str:
    """The options with which a command walks the scenario of `walk` at the steps of `half`, which is the walk
    at half of them (`halved`).
    """
    whole, finer = (w.scenario.dotted() if w.scenario else {} for w in (walk, half))
    return " ".join(f"--set {name}={x:g}" for name, x in finer.items() if whole.get(name) != x)


def walk(
    walker: Walker,
    gait: Gait | None = None,
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

    - walker: plant, controller and all the rest. A walker without a slope walks on that of its plant, or of
      the gait.
    - gait: whose orbit is the start, and from which errors are measured. It may be None beside a `start`:
      errors are then measured from the controller's own reference, which it must have on a robot with motors.
    - impacts: the walk ends after so many.
    - method: of integration; by default that of `methods_of`. Every step of it is kept, so that peaks and
      certificates miss none.
    - start: (q, v), each (n,) [rad, rad/s], in place of the gait's. first_step: number of the first single
      support.
    - progress: called after every event with the time [s] and the number of events.
    - engine: "compiled", whose place Pinocchio takes where it cannot run, or "pinocchio"; the trajectory's
      settings say what ran ("engine") and why not what was asked for ("why"). Under ADRC and a push the
      default step of "pinocchio", 0.5 ms, is too long for ADRC's errors after the push begins or ends (ten
      times too large under Table I), which a remark says; "compiled" takes 0.05 ms there.
    - within: the walk ends, with the status INFEASIBLE, where it would leave these limits; without,
      `Walk.feasibility` alone judges by them.
    - plant: in place of the rigid one, by name ("mujoco", soft ground) or itself, as MuJoCoPlant(biped,
      ground); then the walker acts at sample instants, and there is no method.

    A fall is a status of the trajectory. Each of `Walk.remarks` is also a `WalkWarning`. Raises InputError for
    parts that do not fit together.

    >>> walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, impacts=3)
    >>> walk.trajectory.status.name, walk.feasibility.status.name
    ('COMPLETED', 'COMPLETED')
    """
    check_part(walker, "what is to walk", Walker)
    # the gait may be None beside a start, unless errors of joints could then be measured from nothing
    tracks = walker.plant.p == 0 or own_reference(walker.controller) is not None
    # a list times False is empty, times True unchanged
    check_part(gait, "the gait of the walk", Gait, *[NoneType] * (start is not None and tracks))
    check_part(method, "the method of the walk", OneStepMethod, NoneType)
    check_count(impacts, f"the walk asks for {impacts} impacts")
    check_count(first_step, f"the walk begins in single support {first_step}")
    if start is None:
        assert gait is not None
        if (count := len(gait.q_minus)) != (n := walker.nominal.n):
            raise InputError(
                f"gait '{gait.name}' is of '{gait.robot}' with {count} coordinates, and the walker is "
                f"'{walker.nominal.description.name}' with {n}; expected a gait of this robot"
            )
        start = gait.start(walker.nominal)
    parts = tuple[WalkPart, ...]()
    # `shared` is a copy with another field; equal calls give the same object
    if walker.slope is None:
        walker = shared(walker, slope=getattr(plant, "slope", gait.slope if gait else 0.0))
    if plant is not None:
        check_part(method, "the method on a plant of its own", NoneType)
        # {}: no further values for the plant's constructor
        moved = plant_around(plant, walker, {}) if isinstance(plant, str) else plant
        loop = fastest_loop(walker, moved, engine, first_step)
        check_start(*start, walker)
        run = walk_on(loop, walker, start, Mode(first_step), impacts, progress)
    else:
        usual = RunRecord.model_construct(engine=engine)  # all else by default
        # (method, integration step where a push switches); a method that was asked for has one step everywhere
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
    """Simulate a scenario from just after the impact of the gait's periodic orbit, or of the cycle of a robot
    without motors, with the scenario's offsets added to that state (its record `start`).

    The same scenario gives the same walk in every process: all random numbers come from its seed.

    s: the scenario. progress: called after every event with the time [s] and the number of events. controller:
    in place of the scenario's, such as an exported one; the walk then keeps no scenario. A fall is a status of
    the trajectory, not an error. Raises InputError for values that do not fit together.

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
    begin, parts = scene.start(s), tuple[WalkPart, ...]()
    # the loop of a plant that moves by itself, such as MuJoCo's; None on the rigid plant
    if (loop := soft_loop(s, walker)) is not None:
        run = walk_on(loop, walker, begin, mode, s.run.impacts, progress)
    else:
        parts = refined(walker, s.run.impacts, mode.step, *methods_of(s.run, walker))
        run = in_parts(walker, begin, mode, parts, s.run.engine, progress)
    return Walk(walker, scene.gait, run, s if controller is None else None, parts=parts)


def execute_twice(s: Scenario) -> Outcome:
    """Walk a scenario twice: its `Outcome`, whose `half` is the outcome with integration steps half as long."""
    walk = walk_scenario(s)
    return replace(walk.outcome, half=walk_scenario(halved(s, walk.walker)).outcome)
