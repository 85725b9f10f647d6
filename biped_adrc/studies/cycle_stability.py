"""The stability of one walking cycle by the variational equation and by differences.

A robot with motors walks a stored gait under NPD or ADRC, one without walks its known cycle down a slope. The
cycle is found by Newton on the return map. `poincare` is the test of the reproduction: fixed
point, multipliers by central differences, delta^2.

    find_cycle, cycle_of   names or a scenario -> return map and first guess (`Cycle`)
    cycle_stability        -> fixed point, and the multipliers of each method in one table

The return map P takes the state just before one impact to that before the next; multipliers are the eigenvalues
of its derivative at the fixed point, and the cycle is stable if all lie inside the unit circle.

A `Cycle` of a controller with states (an observer) has these behind the mechanical ones in its state, unless
observer_states is False: then the controller starts anew after each impact, and the map has 2 n - 1
coordinates.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from biped_adrc.analysis.certificate import Certificate, certificates
from biped_adrc.analysis.regression import Regression, regress_multipliers
from biped_adrc.analysis.return_map import PeriodicOrbit, ReturnMap, after_impact
from biped_adrc.analysis.signals import signals
from biped_adrc.analysis.stability import (
    MethodRow,
    StabilityMethod,
    StabilityTable,
    stability_table,
)
from biped_adrc.analysis.variational import periodic_orbit
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode
from biped_adrc.errors import InputError, SimulationError
from biped_adrc.gait.reference import TimeReference
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.model.robots.limits import Limits
from biped_adrc.parts import check_part
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.outcome import Outcome
from biped_adrc.scenario.run import SETTLES, Cycle, known_cycle, method_of
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.walk import default_method
from biped_adrc.shown import Shown
from biped_adrc.types import Array

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


@dataclass(frozen=True)
class CycleStability(Shown):
    """The fixed point of a return map and its multipliers by every method that applies."""

    cycle: Cycle
    """The return map, and the state from which the fixed point was found."""
    orbit: PeriodicOrbit
    """The fixed point, its residual, and its multipliers."""
    table: StabilityTable
    """Multipliers by method, and whether they agree."""


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

        walking = ba.find_cycle("rabbit", gait="published", controller="ADRC", observer_states=False)
        passive = ba.find_cycle("compass", slope=0.05)

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
    return cycle_of(s, observer_states, slope)


def cycle_of(s: Scenario, observer_states: bool = True, slope: float | None = None) -> Cycle:
    """The cycle of a scenario, without its pushes, on its own or another slope [rad].

    Raises as `find_cycle`, and InputError for values that have no effect on a return map.
    """
    scene = RobotAndGait.of(s)
    without = NO_MAP if scene.gait else (*NO_MAP, *FIXED)
    if slope is not None:
        without = (*without, "ground.slope")
    useless = [name for name in s.dotted() if name.startswith(without)]
    if useless:
        on = "" if slope is None else f" on a slope of {slope:g} rad"
        raise InputError(
            f"the return map is of one step of the undisturbed cycle{on}"
            f"{'' if scene.gait else ', by a fixed method,'} and takes no {', '.join(useless)}: this would do "
            "nothing, leave it out"
        )
    if scene.gait:
        return gait_cycle(s, observer_states, slope)
    walker = build(s, scene)
    return known_cycle(walker.plant, walker.slope if slope is None else slope)


def cycle_stability(cycle: Cycle) -> CycleStability:
    """Fixed point of a cycle and its multipliers by every method.

        found = ba.cycle_stability(ba.find_cycle("rabbit", controller="NPD"))

    The methods are independent of each other, the variational equation along the step with the saltation at
    impact, and central differences of the return map. That they agree is the test of each.

    For a controller with states only central differences apply, since the variational equation is written for
    the mechanics alone. Raises SimulationError when no fixed point is found.
    """
    check_part(cycle, "cycle", Cycle)
    P = cycle.P
    if len(cycle.guess) > 2 * P.walker.plant.n:
        guess = cycle.guess if P.controller_states else cycle.guess[: 2 * P.walker.plant.n]
        orbit = P.fixed_point(guess)
        row = MethodRow(StabilityMethod.CENTRAL, orbit.multipliers)
        return CycleStability(cycle, orbit, StabilityTable((row,)))
    orbit, step = periodic_orbit(P, cycle.guess, SETTLES)
    return CycleStability(cycle, orbit, stability_table(P, step))


def nominal_step(cycle: Cycle, orbit: PeriodicOrbit, limits: Limits | None = None) -> Certificate:
    """The certificate of the step at the fixed point: what it asks of ground and motors, within these limits.

    Certificates depend on states, torques and forces alone, so a reference of zeros is given for the signals.

    Raises SimulationError where the step does not end with an impact.
    """
    P, walker = cycle.P, cycle.P.walker
    start, t_end = after_impact(walker, 0.0, orbit.x_minus, Mode()), walker.max_step_time
    run = simulate(walker, *start, P.method, t_end=t_end, stop_after=(FOOT_STRIKE, 1))
    if not run.status.ok:
        raise SimulationError(f"the step of the cycle ended before: {run.status.name}")
    none = np.zeros(walker.plant.p)
    seen = signals(walker, run, TimeReference(lambda t: (none, none, none)))
    return certificates(walker, run, seen, limits)[0]


@dataclass(frozen=True)
class PoincareResult(Shown):
    """A fixed point with its multipliers, and delta^2 of the zero dynamics beside them."""

    controller: str
    preset: str
    reset: str
    """What the observer does at impact, as in a scenario."""
    with_states: bool
    """Whether the controller's states belong to the state of the return map."""
    orbit: PeriodicOrbit
    delta_squared: float
    half: PoincareResult | None = None
    """The same at half the integration step."""

    @property
    def gap(self) -> float:
        """Largest change of a multiplier's magnitude when the step is halved; infinite where it was not."""
        if self.half is None:
            return math.inf
        one, other = (np.sort(np.abs(r.orbit.multipliers)) for r in (self, self.half))
        return float(np.max(np.abs(one - other)))

    def record(self) -> dict[str, Any]:
        """The result as values that JSON holds, for summary.json."""
        half = None if self.half is None else np.abs(self.half.orbit.multipliers).tolist()
        return {
            **{name: getattr(self, name) for name in ("controller", "preset", "reset")},
            "coordinates": len(self.orbit.multipliers),
            "magnitudes": np.abs(self.orbit.multipliers).tolist(),
            "x_minus": self.orbit.x_minus[:10].tolist(),
            "residual": self.orbit.residual,
            "delta_squared": self.delta_squared,
            "stable": self.orbit.stable,
            "magnitudes_at_half_the_step": half,
        }


def poincare_twice(run: Scenario) -> PoincareResult:
    """As `poincare` at the step of the scenario (by default 1 ms), and once more at half of it."""
    h = run.run.h or 1e-3
    found = poincare(run.replace(run={"h": h}))
    return replace(found, half=poincare(run.replace(run={"h": 0.5 * h})))


def poincare(run: Scenario, with_states: bool = True) -> PoincareResult:
    """Fixed point by Newton's method and multipliers by central differences, without disturbances.

    with_states: whether the controller's states belong to the state of the return map.
    """
    cycle = gait_map(run.replace(run={"h": run.run.h or 1e-3, "method": None}), with_states)
    P, guess = cycle.P, cycle.guess
    scene = RobotAndGait.of(run)
    biped, gait = scene.biped, scene.walked
    # an observer in continuous time settles to about 1e-8 between impacts, so the residual may too
    orbit = P.fixed_point(guess if with_states else guess[: 2 * biped.n])
    delta2 = ZeroDynamics.of(biped, gait.constraint).delta ** 2
    law = run.controller
    return PoincareResult(law.name, biped.preset, law.observer.reset, with_states, orbit, delta2)


def regression_of(outcome: Outcome) -> Regression:
    """The regression (26), (27) over the impacts of a (disturbed) walk, about the fixed point of its gait."""
    gait = RobotAndGait.of(outcome.run).walked
    x_star = np.concatenate((gait.q_minus, gait.v_minus))
    x_minus = outcome.x_minus[:, : len(x_star)]
    return regress_multipliers(x_minus, x_star)


def return_map_samples(run: Scenario, size: float = 0.05, count: int = 21) -> tuple[Array, Array]:
    """Samples of the return map in Theta': its value before one impact, and before the next.

    The rates of the fixed point are scaled by 1 - size to 1 + size. Returns both arrays (count,) [rad/s].
    Raises SimulationError where the walker does not reach another impact.
    """
    P, scene = gait_map(run, observer_states=False).P, RobotAndGait.of(run)
    biped, gait = scene.biped, scene.walked
    before = np.linspace(1.0 - size, 1.0 + size, count)
    after = np.empty(count)
    c = biped.phase
    for i, factor in enumerate(before):
        x = np.concatenate((gait.q_minus, factor * gait.v_minus))
        image = P.lift(P(P.project(x)))
        after[i] = c @ image[biped.n : 2 * biped.n]
    return before * float(c @ gait.v_minus), after
