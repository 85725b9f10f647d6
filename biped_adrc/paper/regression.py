"""The paper's own stability test: linear regression (26), (27) through the sampled states.

    x-(k + 1) - x* = Phi (x-(k) - x*)

x-(k) is the state before impact k of one walk. Ten states are regressed on a section of nine
dimensions, and a walk that converges along one direction excites one direction: Phi is not
determined by such data. So rank and condition number are returned with the eigenvalues, and
`warning` says what they are worth.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.core.errors import InputError
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array

RANK = 1e-8
"""Relative size below which a direction does not count for the rank."""


@dataclass(frozen=True)
class Regression(Shown):
    """Phi of (27), its eigenvalues, and how well the data determine it."""

    Phi: Array
    """(n, n), mixed units of the states."""
    magnitudes: Array
    """|eigenvalues| (n,), the largest first."""
    rank: int
    """Number of directions that the samples span."""
    condition: float
    """Condition number of the samples; infinite if they do not span all directions."""
    samples: int
    """Number of states before impact."""

    @property
    def warning(self) -> str:
        """Why Phi is not to be trusted, in words; empty when the data determine it."""
        n = self.Phi.shape[0]
        if self.rank >= n and self.condition < 1e8:
            return ""
        return (
            f"the {self.samples} sampled states span {self.rank} of {n} directions (condition "
            f"{self.condition:.1e}); the section itself has {n - 1}. The eigenvalues of this regression "
            "are no multipliers: use central differences of the return map"
        )


def regress_multipliers(x_minus: Array, x_star: Array) -> Regression:
    """(27) from states before impact (k, n) [rad, rad/s] and the fixed point (n,).

    Directions below RANK of the largest do not count for the rank. Raises InputError for fewer than three
    samples.
    """
    if x_minus.ndim != 2 or x_minus.shape[0] < 3:
        raise InputError(f"found samples of shape {x_minus.shape}, expected (k, n) with k >= 3")
    chi = x_minus - x_star
    before, after = chi[:-1], chi[1:]
    result, _, _, singular = np.linalg.lstsq(before, after, rcond=None)
    solution = np.asarray(result, dtype=np.float64)
    magnitudes = np.sort(np.abs(np.linalg.eigvals(solution.T)))[::-1]
    rank = int(np.sum(singular > RANK * singular[0]))
    smallest = float(singular[-1]) if len(singular) == x_minus.shape[1] else 0.0
    condition = float(singular[0]) / smallest if smallest > 0 else float("inf")
    return Regression(solution.T, magnitudes, rank, condition, len(x_minus))
