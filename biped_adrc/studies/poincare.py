"""The stability test of section V: fixed point, multipliers, delta^2, and the regression beside."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from biped_adrc.analysis.regression import Regression, regress_multipliers
from biped_adrc.analysis.return_map import Mapper, PeriodicOrbit, ReturnMap
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.build import Scene, build
from biped_adrc.scenario.outcome import Outcome
from biped_adrc.scenario.run import method_of
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.types import Array


@dataclass(frozen=True)
class PoincareResult:
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
        return {
            "controller": self.controller,
            "preset": self.preset,
            "reset": self.reset,
            "coordinates": len(self.orbit.multipliers),
            "magnitudes": np.abs(self.orbit.multipliers).tolist(),
            "x_minus": self.orbit.x_minus[:10].tolist(),
            "residual": self.orbit.residual,
            "delta_squared": self.delta_squared,
            "stable": self.orbit.stable,
            "magnitudes_at_half_the_step": None
            if self.half is None
            else np.abs(self.half.orbit.multipliers).tolist(),
        }


def poincare_twice(run: Scenario) -> PoincareResult:
    """As `poincare` at the run's step, or 1 ms, and at half of it."""
    h = run.h or 1e-3
    found = poincare(replace(run, h=h))
    return replace(found, half=poincare(replace(run, h=0.5 * h)))


def poincare(run: Scenario, with_states: bool = True, mapper: Mapper = map) -> PoincareResult:
    """Fixed point by Newton and multipliers by central differences, without disturbances."""
    run = replace(run, pushes=())
    scene = Scene.of(run)
    walker, biped, gait = build(run, scene), scene.biped, scene.walked
    method = method_of(replace(run, h=run.h or 1e-3, method=None), walker)
    # an observer in continuous time settles to about 1e-8 between impacts, so the residual may too
    P = ReturnMap(walker, method, with_states)
    q, v = gait.q_minus, gait.v_minus
    start = walker.initial_state(q, v)
    orbit = P.fixed_point(start if with_states else start[: 2 * biped.n])
    return PoincareResult(
        run.controller,
        biped.preset,
        run.reset,
        with_states,
        orbit,
        ZeroDynamics.of(biped, gait.constraint).delta ** 2,
    )


@dataclass(frozen=True)
class RegressionTest:
    """The paper's regression on a walk whose multipliers are known by other means."""

    regression: Regression
    controller: str

    def record(self) -> dict[str, Any]:
        """As plain values."""
        r = self.regression
        return {
            "controller": self.controller,
            "magnitudes": r.magnitudes.tolist(),
            "rank": r.rank,
            "condition": float(r.condition) if np.isfinite(r.condition) else "inf",
            "samples": r.samples,
            "warning": r.warning,
        }


def regression_of(outcome: Outcome) -> RegressionTest:
    """(26), (27) over the impacts of a (disturbed) walk, about the gait's fixed point."""
    run = outcome.run
    gait = Scene.of(run).walked
    x_star = np.concatenate((gait.q_minus, gait.v_minus))
    x_minus = outcome.x_minus[:, : len(x_star)]
    return RegressionTest(regress_multipliers(x_minus, x_star), run.controller)


def return_map_samples(run: Scenario, size: float = 0.05, count: int = 21) -> tuple[Array, Array]:
    """theta' before one impact against theta' before the next, for scaled speeds of the fixed point.

    Returns both (count,) [rad/s]; NaN where the walker does not come back.
    """
    scene = Scene.of(run)
    biped, gait = scene.biped, scene.walked
    walker = build(replace(run, pushes=()), scene)
    P = ReturnMap(walker, method_of(run, walker), controller_states=False)
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
