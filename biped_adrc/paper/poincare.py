"""The stability test of the reproduction: fixed point, multipliers by central differences, delta^2.

A `PoincareResult` has them at two integration steps, which says how far they have converged. The paper's own
test is a linear regression, its (26), (27), through the states before impacts:

    x-(k + 1) - x* = Phi (x-(k) - x*)

x-(k) is the state before impact k of one walk. Ten states are regressed on a section of nine dimensions, and a
walk that converges along one direction excites one direction: Phi is not determined by such data. So rank and
condition number are returned with the eigenvalues, and `warning` says what they are worth.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from biped_adrc.analysis.return_map import PeriodicOrbit
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.paper.scenarios import COARSE
from biped_adrc.scenario.build import RobotAndGait
from biped_adrc.scenario.cycle import gait_map
from biped_adrc.scenario.recording import Outcome
from biped_adrc.scenario.scenario import Scenario


@dataclass(frozen=True)
class PoincareResult(Shown):
    """A fixed point with its multipliers, and delta^2 of the zero dynamics beside them."""

    run: Scenario
    """The walk whose return map was taken."""
    orbit: PeriodicOrbit
    """Fixed point and multipliers at an integration step of 1 ms."""
    half: PeriodicOrbit
    """The same at an integration step of 0.5 ms."""
    delta_squared: float
    """delta^2 of the zero dynamics [1], the largest multiplier in closed form."""

    @property
    def gap(self) -> float:
        """Largest change of a multiplier's magnitude [1] when the integration step is halved; the multipliers
        are paired in the order of their magnitudes.
        """
        one, other = (np.sort(np.abs(x.multipliers)) for x in (self.orbit, self.half))
        return float(np.max(np.abs(one - other)))

    def record(self) -> dict[str, Any]:
        """The result as values that JSON holds, for summary.json; of the fixed point only (q, q')."""
        return {
            "controller": self.run.controller.name,
            "preset": self.run.robot.preset,
            "reset": self.run.controller.observer.reset,
            "coordinates": len(self.orbit.multipliers),
            "magnitudes": np.abs(self.orbit.multipliers).tolist(),
            "x_minus": self.orbit.x_minus[:10].tolist(),
            "residual": self.orbit.residual,
            "delta_squared": self.delta_squared,
            "stable": self.orbit.stable,
            "magnitudes_at_half_the_step": np.abs(self.half.multipliers).tolist(),
        }


def poincare(run: Scenario, with_states: bool = True) -> PoincareResult:
    """Fixed point of the return map by Newton's method and its multipliers by central differences, without the
    pushes of the scenario, at two integration steps.

    with_states: whether the controller's states belong to the state of the return map; without them the
    controller starts anew after each impact.
    """
    scene = RobotAndGait.of(run)

    def orbit(h: float) -> PeriodicOrbit:
        cycle = gait_map(run.replace(run={"h": h}), with_states)
        # the guess is the gait's orbit; a map without the controller's states takes (q, q') of it
        return cycle.P.fixed_point(cycle.guess if with_states else cycle.guess[: 2 * scene.biped.n])

    delta = ZeroDynamics.of(scene.biped, scene.walked.constraint).delta
    return PoincareResult(run, orbit(COARSE), orbit(0.5 * COARSE), delta**2)


RANK = 1e-8
"""Least singular value, over the largest, of a direction that counts for the rank."""


@dataclass(frozen=True)
class Regression(Shown):
    """Phi of (27), its eigenvalues, and how well the data determine it."""

    Phi: Array
    """(n, n), mixed units of the states."""
    magnitudes: Array
    """|eigenvalues| (n,), the largest first."""
    rank: int
    """Number of directions that the deviations x- - x* span."""
    condition: float
    """Condition number of the matrix of these deviations; infinite if there are fewer of them than n."""
    samples: int
    """Number of states before impact, one more than pairs (x-(k), x-(k + 1))."""

    @property
    def warning(self) -> str:
        """Why Phi is not to be trusted, in words; empty when the data determine all of it."""
        n = self.Phi.shape[0]
        if self.rank >= n and self.condition < 1e8:
            return ""
        return (
            f"the {self.samples} sampled states span {self.rank} of {n} directions (condition "
            f"{self.condition:.1e}); the section itself has {n - 1}. The eigenvalues of this regression "
            "are no multipliers: use central differences of the return map"
        )


def regress_multipliers(x_minus: Array, x_star: Array) -> Regression:
    """The regression (27) of the paper by least squares, from the states before k impacts x_minus (k, n)
    [rad, rad/s], k >= 3, and the fixed point x_star (n,).
    """
    chi = x_minus - x_star  # in rows, so that least squares gives the transpose of Phi
    before, after = chi[:-1], chi[1:]
    result, _, _, singular = np.linalg.lstsq(before, after, rcond=None)
    solution = np.asarray(result, dtype=np.float64)
    magnitudes = np.sort(np.abs(np.linalg.eigvals(solution.T)))[::-1]
    rank = int(np.sum(singular > RANK * singular[0]))
    smallest = float(singular[-1]) if len(singular) == x_minus.shape[1] else 0.0
    condition = float(singular[0]) / smallest if smallest > 0 else float("inf")
    return Regression(solution.T, magnitudes, rank, condition, len(x_minus))


def regression_of(outcome: Outcome) -> Regression:
    """The regression (26), (27) over the impacts of a walk, also a disturbed one, about the fixed point (q-,
    q'-) of its gait; the controller's states are left out.
    """
    gait = RobotAndGait.of(outcome.run).walked
    x_star = np.concatenate((gait.q_minus, gait.v_minus))
    x_minus = outcome.x_minus[:, : len(x_star)]
    return regress_multipliers(x_minus, x_star)
