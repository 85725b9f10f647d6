"""Linear analysis of a scenario: the cycle of its return map, and the specification of its loop.

    cycle_of(s)    a `Cycle`, which `analysis.stability.cycle_stability` takes: return map, and a state from
                   which Newton's method finds the fixed point
    specified(s)   the specification, numbers by name: `stable` (does every mode of the linear loop decay),
                   `growth` [1/s] of the mode that decays least, `delay_margin` [s] of all motors together,
                   `disk_margin` [1], and `ripple` [N m], the rms of the torque that errors of encoders cause

A robot with motors walks a stored gait under its controller; a robot without motors walks its known (stored)
cycle down a slope. The return map P takes the state just before an impact to that before the next one. Its
multipliers are the eigenvalues of its derivative at the fixed point. A scene is a `RobotAndGait`: the robot of
a scenario without model errors, and its gait.

q (n,) [rad] are the coordinates, q_N the last one, which has no motor. The map drops it, since the swing foot
is on the ground, and finds it again from that. The controller's states (an observer's) belong to the state of
the map unless observer_states is False: then the controller starts anew after each impact, and the map has
2 n - 1 coordinates.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

from biped_adrc.analysis.loops.frozen_gait import FrozenGait
from biped_adrc.analysis.return_map import ReturnMap
from biped_adrc.analysis.stability import Cycle, known_cycle
from biped_adrc.closed_loop.walker import Mode
from biped_adrc.core.errors import InputError
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.scenario.build import RIGID, RobotAndGait, build, plant_of
from biped_adrc.scenario.integration import methods_of
from biped_adrc.scenario.scenario import ErrorRecord, Scenario

if TYPE_CHECKING:
    from biped_adrc.analysis.loops.gang import Gang
    from biped_adrc.analysis.loops.specification import Specification

_DIFFERENCE = 1e-4
"""Half width of the central differences of P [rad, rad/s], for walkers that RK4 integrates by default. It is
ten times the usual one, since the round-off of P is divided by it."""


NO_MAP = (
    *("run.impacts", "run.first_step", "run.fine", "run.engine"),
    *("pushes", "ground.drop", "start"),
)
"""Values and records of a scenario that have no effect on a return map."""
FIXED = ("run.method", "run.h", "run.tolerance", "run.runaway_speed", "run.max_step_time")
"""Further values that have no effect on the return map of a robot without motors."""


def gait_map(s: Scenario, observer_states: bool = True) -> Cycle:
    """The return map of a scenario without its pushes, and the state (nx,) just before the impact of the gait's
    orbit, as the guess of its fixed point. The integration method is the scenario's own, or the default one.

    observer_states: whether the controller's states belong to the state of the map. Raises InputError for a
    robot without motors.
    """
    # walked: the gait
    scene = RobotAndGait.of(s)
    walker = build(s.replace(pushes=()), scene)
    q, v = scene.walked.q_minus, scene.walked.v_minus
    # where the search for q_N begins: 0 where q_N is the pitch of a trunk, pi where it is the angle of a leg
    upright = math.pi * round(q[-1] / math.pi)
    # [0] is the method; [1], a finer step where pushes switch, is not needed without pushes
    P = ReturnMap(walker, methods_of(s.run, walker)[0], observer_states, pitch=upright)
    return Cycle(P, walker.initial_state(q, v))


def cycle_of(s: Scenario, observer_states: bool = True) -> Cycle:
    """The cycle of a scenario without its pushes: of a gait under its controller, or a passive one.

        walking = cycle_of(ba.Scenario("ADRC"), observer_states=False)
        passive = cycle_of(ba.Scenario("passive", robot="compass", ground={"slope": 0.01}))

    observer_states: whether the controller's states belong to the state of the map. The map is integrated by
    the scenario's method and step, if it has them; else by the exponential method at 0.5 ms where the observer
    is linear and time continuous, as under ADRC, and by RK4 at 0.5 ms for others. With the latter the largest
    multiplier is within 2e-7 of the exact one of the hybrid zero dynamics, on the published gaits. Raises
    InputError for values that have no effect on a return map, and for a controller that does not fit the
    robot; GaitError where no cycle is stored.
    """
    gait = RobotAndGait.of(s).gait
    # without motors `known_cycle` fixes method and bounds of the run, so these values have no effect either
    # NO_MAP, FIXED: names of values that have no effect on the map
    without = NO_MAP if gait else (*NO_MAP, *FIXED)
    useless = [name for name in s.dotted() if name.startswith(without)]
    if useless:
        raise InputError(f"a return map takes no {', '.join(useless)}; leave it out")
    if not gait:
        walker = build(s)
        return known_cycle(walker.plant, walker.ground_slope)
    cycle = gait_map(s, observer_states)
    # `split` gives the linear stiff part of the loop; it is None where the exponential method does not apply
    if cycle.P.walker.split(Mode()) is not None:
        return cycle
    # RK4 with half of its usual step, and wider differences of P, by whose width the round-off of P is divided
    method = RK4(5e-4) if s.run.method is None and s.run.h is None else cycle.P.method
    return replace(cycle, P=replace(cycle.P, method=method, difference=_DIFFERENCE))


def specification_of(s: Scenario, scene: RobotAndGait | None = None) -> Specification:
    """The specification of the walker of a scenario: stability, margins and ripple of its linearised loop,
    without a walk.

    Pushes, ground and start of the scenario do not count. Its model errors do: they make the plant differ from
    the controller's model. scene: robot and gait, loaded if None; with the same object for many scenarios, such
    as the candidates of a search, the gait is linearised once. Raises InputError for a scenario in continuous
    time, on another plant than the rigid one, without motors, or whose controller has to notice touchdowns.
    """
    # imported here, since it imports SciPy's optimisation, which a cycle does without
    from biped_adrc.analysis.loops.specification import specification

    if s.ground.plant != RIGID:
        raise InputError(f"a specification on plant '{s.ground.plant}', expected '{RIGID}'")
    scene = RobotAndGait.of(s) if scene is None else scene
    return specification(build(s, scene), _frozen(scene, s.errors, s.run.seed))


def gang_of(s: Scenario, scene: RobotAndGait) -> tuple[Specification, Gang]:
    """The specification of the walker of a scenario, and the gang of six of its loop on the plant itself.

    Raises InputError as `specification_of`, and for a controller whose loop is not linear.
    """
    from biped_adrc.analysis.loops.gang import gang_of_six

    spec = specification_of(s, scene)
    return spec, gang_of_six(build(s, scene), _frozen(scene, s.errors, s.run.seed), spec)


@lru_cache(maxsize=16)
def _frozen(scene: RobotAndGait, errors: ErrorRecord, seed: int) -> FrozenGait:
    """The gait linearised, at several phases of its orbit, for a plant with these model errors, drawn from this
    seed; the orbit itself is that of the robot without errors.

    It does not depend on the controller, so the candidates of a search share it.
    """
    # `plant_of` reads only errors and seed of a scenario
    plant = plant_of(Scenario(errors=errors, run={"seed": seed}), scene.biped)
    return FrozenGait.of(plant, scene.walked, scene.biped)


def specified(s: Scenario, scene: RobotAndGait | None = None) -> dict[str, float]:
    """The specification of a scenario: its numbers by the names and in the units of the module's table, none of
    them NaN; of an unstable loop the margins are 0 and the ripple is infinite.

    scene: robot and gait, loaded if None. Raises InputError for a scenario without a specification: in
    continuous time, not on the rigid plant, without motors, or with a detector of touchdowns.

        specified(ba.Scenario({"name": "LESO", "observer": {"bandwidth": 160.0}}, hardware="rabbit"))
    """
    return specification_of(s, scene).columns()
