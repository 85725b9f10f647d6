"""The stability of one walking cycle by every method that applies to it, section V.

A robot with motors walks a stored gait under NPD or ADRC, one without walks its known cycle down a slope. The
cycle is found by Newton on the return map. The regression (26), (27) is fed as the paper's: with the states
before the impacts of a walk that starts beside the cycle. `poincare` is the test of the reproduction: fixed
point, multipliers by central differences, delta^2.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
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
    Tolerances,
    regression_row,
    stability_table,
)
from biped_adrc.analysis.variational import periodic_orbit
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode
from biped_adrc.errors import InputError, SimulationError
from biped_adrc.gait.reference import TimeReference
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.model.biped import Biped
from biped_adrc.parts import check_part
from biped_adrc.robots.robot_toml import Limits
from biped_adrc.scenario.build import Scene, build
from biped_adrc.scenario.outcome import Outcome
from biped_adrc.scenario.run import SETTLES, Cycle, known_cycle, method_of
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.walk import default_method
from biped_adrc.shown import Shown
from biped_adrc.types import Array

DIFFERENCE = 1e-4  # [rad, rad/s], of differences that are extrapolated
BESIDE = 1e-3  # how much faster than on the cycle the regression's walk starts, dimensionless


@dataclass(frozen=True)
class CycleStability(Shown):
    """The fixed point and its multipliers by every method."""

    cycle: Cycle
    orbit: PeriodicOrbit
    table: StabilityTable


def gait_cycle(s: Scenario, observer_states: bool = True, slope: float | None = None) -> Cycle:
    """A stored gait under the controller of a scenario, its pushes left out, on its own or another slope [rad].

    RK4 at 0.5 ms is within 2e-7 of delta^2 on the published gaits; ADRC takes the exponential method at 1 ms.
    """
    cycle = gait_map(s, observer_states)
    walker = cycle.P.walker if slope is None else replace(cycle.P.walker, slope=slope)
    has_states = walker.split(Mode()) is not None
    method = default_method(walker) if has_states else RK4(5e-4)
    difference = cycle.P.difference if has_states else DIFFERENCE
    return replace(cycle, P=replace(cycle.P, walker=walker, method=method, difference=difference))


def gait_map(s: Scenario, observer_states: bool = True) -> Cycle:
    """The return map of a scenario by its own method, its pushes left out, and the state of its gait."""
    scene = Scene.of(s)
    walker = build(replace(s, pushes=()), scene)
    P = ReturnMap(walker, method_of(s, walker), observer_states)
    return Cycle(P, walker.initial_state(scene.walked.q_minus, scene.walked.v_minus))


def find_cycle(
    robot: str,
    preset: str | None = None,
    gait: str = "published",
    controller: str | None = None,
    observer_states: bool = True,
    slope: float | None = None,
    own: Mapping[str, Any] | None = None,
) -> Cycle:
    """The cycle of a robot by name: of a gait under a controller, NPD without, or passive without motors.

    own: values of the controller's. Raises InputError for a controller that does not fit the robot, and as
    Biped.load, load_gait, known_cycle.
    """
    s = Scenario(robot=robot, preset=preset, gait=gait, own=dict(own or {}))
    usual = "NPD" if Scene.of(s).gait else "passive"
    return cycle_of(replace(s, controller=controller or usual), observer_states, slope)


def cycle_of(s: Scenario, observer_states: bool = True, slope: float | None = None) -> Cycle:
    """The cycle of a scenario, its pushes left out. Raises as `find_cycle`."""
    scene = Scene.of(s)
    if scene.gait:
        return gait_cycle(s, observer_states, slope)
    return known_cycle(build(replace(s, gait=Scenario.gait), scene).plant, slope)


def cycle_stability(
    cycle: Cycle, samples: int = 25, tolerances: Tolerances | None = None
) -> CycleStability:
    """The table at the fixed point; `samples` impacts for the regression, 0 leaves it out.

    With a controller that has states there are central differences alone, since the variational equation is
    written without. Raises InputError for a number of samples that is no walk, SimulationError when no fixed
    point is found.
    """
    check_part(cycle, "cycle", Cycle)
    if samples != 0 and samples < 3:
        raise InputError(f"{samples} samples for the regression, expected 0 or at least 3")
    P, t = cycle.P, Tolerances() if tolerances is None else tolerances
    if len(cycle.guess) > 2 * P.walker.plant.n:
        guess = cycle.guess if P.controller_states else cycle.guess[: 2 * P.walker.plant.n]
        orbit = P.fixed_point(guess)
        regression = _regression(P, orbit, samples)
        rows = [MethodRow(StabilityMethod.CENTRAL, orbit.multipliers)]
        rows += [] if regression is None else [regression_row(regression)]
        return CycleStability(cycle, orbit, StabilityTable(tuple(rows), t))
    orbit, step = periodic_orbit(P, cycle.guess, SETTLES)
    table = stability_table(P, step, _regression(P, orbit, samples), t)
    return CycleStability(cycle, orbit, table)


def nominal_step(cycle: Cycle, orbit: PeriodicOrbit, limits: Limits | None = None) -> Certificate:
    """What the step at the fixed point asks of ground and motors. Raises SimulationError where it is none."""
    P, walker = cycle.P, cycle.P.walker
    start = after_impact(walker, 0.0, orbit.x_minus, Mode())
    run = simulate(
        walker, *start, P.method, t_end=walker.max_step_time, stop_after=(FOOT_STRIKE, 1)
    )
    if not run.status.ok:
        raise SimulationError(f"the step of the cycle ended before: {run.status.name}")
    none = np.zeros(walker.plant.p)
    seen = signals(walker, run, TimeReference(lambda t: (none, none, none)))
    return certificates(walker, run, seen, limits)[0]


def _regression(P: ReturnMap, orbit: PeriodicOrbit, samples: int) -> Regression | None:
    """The regression on a walk beside the cycle; None when no samples are asked for."""
    if samples == 0:
        return None
    n = 2 * P.walker.plant.n
    return regress_multipliers(walk_beside(P, orbit.x_minus, samples), orbit.x_minus[:n])


def walk_beside(P: ReturnMap, x_star: Array, impacts: int) -> Array:
    """States (impacts, 2 n) before the impacts of a walk that starts `BESIDE` faster than the cycle at x_star.

    Raises SimulationError when the walker does not walk that far.
    """
    walker, n = P.walker, P.walker.plant.n
    x = np.array(x_star)
    x[n : 2 * n] *= 1.0 + BESIDE
    run = simulate(
        walker,
        *after_impact(walker, 0.0, x, Mode()),
        P.method,
        t_end=impacts * walker.max_step_time,
        stop_after=(FOOT_STRIKE, impacts),
    )
    if not run.status.ok:
        raise SimulationError(
            f"the walk of {impacts} impacts for the regression ended before: {run.status.name}, "
            f"{run.status.value}; ask for fewer"
        )
    return np.array([event.x_minus[: 2 * n] for event in run.events(FOOT_STRIKE)])


@dataclass(frozen=True)
class PoincareResult(Shown):
    """A fixed point and its multipliers; `with_states` says whether the controller's states count."""

    controller: str
    preset: str
    reset: str
    with_states: bool
    orbit: PeriodicOrbit
    delta_squared: float
    half: PoincareResult | None = None
    """The same at half the step."""

    @property
    def gap(self) -> float:
        """Largest difference of a multiplier's magnitude from that at half the step; infinite without one."""
        if self.half is None:
            return math.inf
        one, other = (np.sort(np.abs(r.orbit.multipliers)) for r in (self, self.half))
        return float(np.max(np.abs(one - other)))

    def record(self) -> dict[str, Any]:
        """As plain values."""
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
    """As `poincare` at the run's step, or 1 ms, and at half of it."""
    h = run.h or 1e-3
    found = poincare(replace(run, h=h))
    return replace(found, half=poincare(replace(run, h=0.5 * h)))


def poincare(run: Scenario, with_states: bool = True) -> PoincareResult:
    """Fixed point by Newton and multipliers by central differences, without disturbances."""
    cycle = gait_map(replace(run, h=run.h or 1e-3, method=None), with_states)
    P, guess = cycle.P, cycle.guess
    scene = Scene.of(run)
    biped, gait = scene.biped, scene.walked
    # an observer in continuous time settles to about 1e-8 between impacts, so the residual may too
    orbit = P.fixed_point(guess if with_states else guess[: 2 * biped.n])
    delta2 = ZeroDynamics.of(biped, gait.constraint).delta ** 2
    return PoincareResult(run.controller, biped.preset, run.reset, with_states, orbit, delta2)


def regression_of(outcome: Outcome) -> Regression:
    """(26), (27) over the impacts of a (disturbed) walk, about the gait's fixed point."""
    gait = Scene.of(outcome.run).walked
    x_star = np.concatenate((gait.q_minus, gait.v_minus))
    x_minus = outcome.x_minus[:, : len(x_star)]
    return regress_multipliers(x_minus, x_star)


def return_map_samples(run: Scenario, size: float = 0.05, count: int = 21) -> tuple[Array, Array]:
    """theta' before one impact against theta' before the next, for scaled speeds of the fixed point.

    Returns both (count,) [rad/s]; NaN where the walker does not come back.
    """
    P, scene = gait_map(run, observer_states=False).P, Scene.of(run)
    biped, gait = scene.biped, scene.walked
    before = np.linspace(1.0 - size, 1.0 + size, count)
    after = np.full(count, np.nan)
    c = biped.phase
    for i, factor in enumerate(before):
        x = np.concatenate((gait.q_minus, factor * gait.v_minus))
        image = P.lift(P(P.project(x)))
        after[i] = c @ image[biped.n : 2 * biped.n]
    return before * float(c @ gait.v_minus), after


def speed_slope(biped: Biped, samples: tuple[Array, Array]) -> float:
    """Slope of the return map in Theta' at its middle, by central difference."""
    before, after = samples
    i = len(before) // 2
    return float((after[i + 1] - after[i - 1]) / (before[i + 1] - before[i - 1]))
