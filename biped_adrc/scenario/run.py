"""Simulation of a scenario: integration method, start, walk, and what is kept of it.

`walk_scenario` builds the walker, chooses the method (`parts_of`) and simulates. `execute_twice` is what a
worker process runs: it returns an `Outcome` of a few numbers, with the same walk at half the step, whose
difference estimates the error of integration.

Robots without motors walk on their known cycle, the fixed point of the return map: Newton's method finds it
from the stored state, and a walk starts just after its impact.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import NoneType

from biped_adrc.closed_loop.other_plant import walk_on
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.base import Controller
from biped_adrc.core.checks import check_part
from biped_adrc.engine.run import COMPILED
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4, Adaptive, OneStepMethod, Stiff
from biped_adrc.hybrid.simulator import Progress
from biped_adrc.scenario.build import RIGID, RobotAndGait, build, plant_step, soft_loop, start
from biped_adrc.scenario.recording import Outcome, Walk
from biped_adrc.scenario.scenario import FREE, Scenario
from biped_adrc.scenario.walk import (
    FINE_STEP,
    Part,
    default_method,
    default_parts,
    refined,
    walk_in_parts,
)

METHODS: dict[str, Callable[..., OneStepMethod]] = {
    "rk4": RK4,
    "exponential": Exponential,
    "adaptive": Adaptive,
    "stiff": Stiff,
}


def method_of(s: Scenario, walker: Walker) -> OneStepMethod:
    """The integration method of a scenario, with its step or tolerance; the walker's default where none is
    given.
    """
    run = s.run
    if run.method in FREE:
        return METHODS[run.method](run.tolerance, run.tolerance)
    method = default_method(walker) if run.method is None else METHODS[run.method]()
    return method if run.h is None else replace(method, h=run.h)  # type: ignore[type-var]


def parts_of(s: Scenario, walker: Walker) -> tuple[Part, ...]:
    """The parts of the walk and their methods: steps of `fine` where a push switches, of h elsewhere [s]."""
    run = s.run
    if run.fine is not None:
        usual, fine = (method_of(s.replace({"run.h": h}), walker) for h in (run.h, run.fine))
        return refined(walker, run.impacts, run.first_step, usual, fine)
    if run.h is None and run.method is None:
        return default_parts(walker, run.impacts, run.first_step, run.engine)
    return (Part(run.impacts, method_of(s, walker)),)


def halved(s: Scenario, walker: Walker | None = None) -> Scenario:
    """The same scenario with every integration step half as long, to estimate the error of integration.

    A method that chooses its own step becomes the explicit adaptive one with a hundredth of the tolerance.
    """
    run = s.run
    if s.ground.plant != RIGID:
        return s.replace({"ground.plant_step": 0.5 * plant_step(s)})
    if run.method in FREE:
        return s.replace(run={"method": "adaptive", "tolerance": 1e-2 * run.tolerance})
    h, fine = run.h, run.fine
    if h is None:
        usual = method_of(s, build(s) if walker is None else walker)
        assert isinstance(usual, RK4 | Exponential)
        h = usual.h
        if fine is None and run.method is None and run.engine == COMPILED:
            fine = FINE_STEP if isinstance(usual, Exponential) else None
    return s.replace(run={"h": 0.5 * h, "fine": None if fine is None else 0.5 * fine})


def walk_scenario(
    s: Scenario,
    progress: Progress | None = None,
    controller: Controller | None = None,
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
    scene = RobotAndGait.of(s)
    walker = build(s, scene)
    kept = s if controller is None else None
    if controller is not None:
        walker = replace(walker, controller=controller)
    if scene.gait:
        begin = start(s, scene)
    else:
        from biped_adrc.scenario.cycle import cycle_start

        begin = cycle_start(scene.biped, walker.slope)
    first, engine = s.run.first_step, s.run.engine
    if (loop := soft_loop(s, walker)) is not None:
        run = walk_on(loop, walker, begin, Mode(first), s.run.impacts, progress)
        return Walk(walker, scene.gait, run, kept)
    parts = parts_of(s, walker)
    return walk_in_parts(walker, scene.gait, begin, first, parts, engine, progress, kept)


def execute_twice(s: Scenario) -> Outcome:
    """The outcome of a scenario's walk, with that at half of its integration steps in `Outcome.half`."""
    return replace(walk_scenario(s).outcome, half=walk_scenario(halved(s)).outcome)
