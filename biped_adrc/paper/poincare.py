"""The stability test of the reproduction: fixed point, multipliers by central differences, delta^2.

A `PoincareResult` at two steps says how far the multipliers are from converged; `regression_of` is the paper's
own test beside it, and `return_map_samples` the map in Theta' for its figure.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from biped_adrc.analysis.return_map import PeriodicOrbit
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.paper.regression import Regression, regress_multipliers
from biped_adrc.scenario.build import RobotAndGait
from biped_adrc.scenario.cycle import gait_map
from biped_adrc.scenario.recording import Outcome
from biped_adrc.scenario.scenario import Scenario


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
    result = poincare(run.replace(run={"h": h}))
    return replace(result, half=poincare(run.replace(run={"h": 0.5 * h})))


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
