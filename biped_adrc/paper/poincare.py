"""The stability test of the reproduction: fixed point, multipliers by central differences, delta^2.

The return map takes the state x- = (q, q', states of the controller) just before an impact to that before the
next one. A periodic walk is its fixed point x*; the multipliers are the eigenvalues of its derivative at x*,
and the walk is stable if all are below 1 in magnitude. delta is the ratio of the angular momenta about the
stance foot after and before an impact, on the zero dynamics (the motion with the joints exactly on the gait);
delta^2 is the largest multiplier in closed form.

A `PoincareResult` has them at two integration steps, which says how far they have converged. The paper's own
test is a linear regression, its (26), (27), through the states before impacts:

    x-(k + 1) - x* = Phi (x-(k) - x*)

x-(k) is (q, q') before impact k of one walk: ten numbers, on a section of nine dimensions, as the swing foot is
on the ground there. A walk that converges along one direction excites one direction: Phi is not determined by
such data. So the rank of the data is returned with the eigenvalues, and `warning` says what they are worth.
"""

from dataclasses import dataclass
from typing import NamedTuple

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


def poincare(run: Scenario, with_states: bool = True) -> PoincareResult:
    """Fixed point of the return map by Newton's method and its multipliers by central differences, without the
    pushes of the scenario, at two integration steps.

    with_states: whether the controller's states belong to the state of the return map; without them the
    controller starts anew after each impact.
    """
    scene = RobotAndGait.of(run)  # robot and gait of the scenario; `walked` is the gait

    # fixed point and multipliers at the integration step h [s]
    def orbit(h: float) -> PeriodicOrbit:
        cycle = gait_map(run.replace(run={"h": h}), with_states)
        # P is the return map, the guess the state on the gait's orbit, of which P takes what it maps
        return cycle.P.fixed_point(cycle.guess)

    delta = ZeroDynamics.of(scene.biped, scene.walked.constraint).delta
    return PoincareResult(orbit(COARSE), orbit(0.5 * COARSE), delta**2)


RANK = 1e-8
"""Least singular value, over the largest, of a direction that counts for the rank."""


class Regression(NamedTuple):
    """The eigenvalues of Phi of (27), and how well the data determine it."""

    magnitudes: Array
    """|eigenvalues| (n,), the largest first."""
    rank: int
    """Number of directions that the deviations x- - x* span."""

    @property
    def warning(self) -> str:
        """Why Phi is not to be trusted, in words; empty when the data determine all of it."""
        n = len(self.magnitudes)
        if self.rank >= n:
            return ""
        return (
            f"the sampled states span {self.rank} of {n} directions, and the section itself has {n - 1}. The "
            "eigenvalues of this regression are no multipliers: use central differences of the return map"
        )


def regress_multipliers(x_minus: Array, x_star: Array) -> Regression:
    """The regression (27) of the paper: the eigenvalues of the Phi (n, n) that takes x-(k) - x* to
    x-(k + 1) - x* with least squares of the error. x_minus (k, n) [rad, rad/s]: states before k >= 3 impacts.
    x_star (n,): the fixed point x*.
    """
    chi = x_minus - x_star  # in rows, so that least squares gives the transpose of Phi
    Phi = np.linalg.lstsq(chi[:-1], chi[1:], rcond=None)[0].T
    magnitudes = np.sort(np.abs(np.linalg.eigvals(Phi)))[::-1]
    # rtol: singular values below this share of the largest count as 0
    return Regression(magnitudes, int(np.linalg.matrix_rank(chi[:-1], rtol=RANK)))


def regression_of(outcome: Outcome) -> Regression:
    """The regression (26), (27) over the impacts of a walk, also a disturbed one, about the fixed point (q-,
    q'-) of its gait; the controller's states are left out.
    """
    gait = RobotAndGait.of(outcome.run).walked
    x_star = np.concatenate((gait.q_minus, gait.v_minus))
    return regress_multipliers(outcome.x_minus[:, : len(x_star)], x_star)
