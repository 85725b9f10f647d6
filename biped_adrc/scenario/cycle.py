"""The return map of a scenario, and a state from which Newton's method finds its cycle.

A robot with motors walks a stored gait under NPD or ADRC, one without walks its known cycle down a slope.

    find_cycle, cycle_of   names or a scenario -> `Cycle`, which `analysis.stability.cycle_stability` takes

The controller's states (an observer's) belong to the state of the map unless observer_states is False: then the
controller starts anew after each impact, and the map has 2 n - 1 coordinates.
"""

from __future__ import annotations

import math
from dataclasses import replace

from biped_adrc.analysis.return_map import ReturnMap
from biped_adrc.analysis.stability import SETTLES, Cycle
from biped_adrc.analysis.variational import periodic_orbit
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.passive import Passive
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.gait.published import passive_cycle
from biped_adrc.hybrid.integrators import RK4, Adaptive
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.run import method_of
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.walk import default_method

DIFFERENCE = 1e-4
"""Half width of the central differences of P [rad, rad/s], for controllers without states."""


NO_MAP = (
    "run.impacts",
    "run.first_step",
    "run.fine",
    "run.engine",
    "pushes",
    "ground.drop",
    "start",
)
"""Values and records of a scenario that have no effect on a return map."""
FIXED = ("run.method", "run.h", "run.tolerance", "run.runaway_speed")
"""The same of a robot without motors."""
LIGHT_FEET = 5e-4
"""Half width of central differences of the return map P for robots without motors [rad, rad/s]: wider than
usual, since light feet leave a round-off of 1e-10 in P."""


def known_cycle(biped: Biped, slope: float | None = None) -> Cycle:
    """The stored cycle of a robot without motors, on its own slope or another one [rad] nearby.

    Raises GaitError when none is stored, SimulationError when the robot does not come to a first impact.
    """
    known = passive_cycle(biped)
    angle = known.slope if slope is None else slope
    walker = Walker(biped, Passive(), slope=angle, max_step_time=known.max_step_time)
    P = ReturnMap(walker, Adaptive(1e-12, 1e-12), difference=LIGHT_FEET, pitch=math.pi)
    start = walker.initial_state(known.q_plus, known.v_plus)
    return Cycle(P, P.next_impact(walker, start, Mode()).x_minus)


def cycle_start(biped: Biped, slope: float) -> tuple[Array, Array]:
    """(q, v), each (n,) [rad, rad/s], just after the impact of the cycle on a slope [rad].

    Raises SimulationError where Newton's method finds no cycle.
    """
    cycle, n = known_cycle(biped, slope), biped.n
    orbit, _ = periodic_orbit(cycle.P, cycle.guess, SETTLES)
    after = biped.impact(orbit.x_minus[:n], orbit.x_minus[n:])
    return after.q, after.v


def gait_cycle(s: Scenario, observer_states: bool = True, slope: float | None = None) -> Cycle:
    """Return map of a stored gait under the controller of a scenario, without its pushes.

    observer_states: whether the controller's states belong to the state of the map. slope: [rad], of another
    ground than the gait's. By the scenario's method and step where it has them, else by a fixed one: RK4 at 0.5
    ms is within 2e-7 of delta^2 on the published gaits; ADRC takes the exponential method at 1 ms.
    """
    cycle = gait_map(s, observer_states)
    walker = cycle.P.walker if slope is None else replace(cycle.P.walker, slope=slope)
    has_states = walker.split(Mode()) is not None
    method = default_method(walker) if has_states else RK4(5e-4)
    if s.run.method is not None or s.run.h is not None:
        method = cycle.P.method
    difference = cycle.P.difference if has_states else DIFFERENCE
    return replace(cycle, P=replace(cycle.P, walker=walker, method=method, difference=difference))


def gait_map(s: Scenario, observer_states: bool = True) -> Cycle:
    """Return map of a scenario by its own integration method, without its pushes; the guess is the gait's
    orbit.
    """
    scene = RobotAndGait.of(s)
    walker = build(s.replace(pushes=()), scene)
    q, v = scene.walked.q_minus, scene.walked.v_minus
    upright = math.pi * round(q[-1] / math.pi)  # a leg that stands is at pi
    P = ReturnMap(walker, method_of(s, walker), observer_states, pitch=upright)
    return Cycle(P, walker.initial_state(q, v))


def find_cycle(
    robot: str,
    preset: str | None = None,
    gait: str = "published",
    controller: str | None = None,
    observer_states: bool = True,
    slope: float | None = None,
) -> Cycle:
    """The cycle of a robot by name: of a gait under a controller (by default NPD), passive without motors.

        walking = find_cycle("rabbit", gait="published", controller="ADRC", observer_states=False)
        passive = find_cycle("compass", slope=0.05)

    observer_states: whether the controller's states belong to the state of the return map. slope: [rad], of
    another ground. Raises InputError for a controller that does not fit the
    robot, and as Biped.load, load_gait, known_cycle.
    """
    s = Scenario(
        {"name": controller or "NPD"},
        robot={"name": robot, "preset": preset},
        gait=gait,
    )
    if controller is None and RobotAndGait.of(s).gait is None:
        s = s.replace(controller="passive")
    return _cycle(s, observer_states, slope)


def cycle_of(s: Scenario, observer_states: bool = True) -> Cycle:
    """The cycle of a scenario, without its pushes.

    Raises as `find_cycle`, and InputError for values that have no effect on a return map.
    """
    gait = RobotAndGait.of(s).gait
    without = NO_MAP if gait else (*NO_MAP, *FIXED)
    useless = [name for name in s.dotted() if name.startswith(without)]
    if useless:
        raise InputError(
            f"the return map is of one step of the undisturbed cycle{'' if gait else ', by a fixed method,'} "
            f"and takes no {', '.join(useless)}: this would do nothing, leave it out"
        )
    return _cycle(s, observer_states, None)


def _cycle(s: Scenario, observer_states: bool, slope: float | None) -> Cycle:
    """The cycle on a slope [rad], None for the scenario's own."""
    if RobotAndGait.of(s).gait:
        return gait_cycle(s, observer_states, slope)
    walker = build(s)
    return known_cycle(walker.plant, walker.slope if slope is None else slope)
