"""The equations of a robot by itself on symbols, for controllers in plain Python.

terms (q, v) -> D, Omega, kappa, xi, ... of (11)-(15),   body (q, v) -> G, C' q', F_a, F_0
accelerate (q, v, force) -> q'',   ground (q, v, a) -> F
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from biped_adrc.engine import mechanics
from biped_adrc.engine.equations import Function, count
from biped_adrc.engine.mechanics import Structure
from biped_adrc.engine.symbols import Tracer, Vector, column, solve_positive
from biped_adrc.model import planar
from biped_adrc.model.planar import PlantArrays
from biped_adrc.model.reduction import reduce


@dataclass(frozen=True)
class PlantEquations:
    """The functions of a robot by itself, for controllers in plain Python."""

    robot: Structure
    K: Any
    numbers: PlantArrays

    @classmethod
    def of(cls, robot: Structure, example: PlantArrays) -> PlantEquations:
        """With symbols for the floats of an example."""
        K = Vector("K", count(example))
        return cls(robot, K.symbol, mechanics.without_zeros(robot, K.like(example)))

    def functions(self) -> dict[str, Callable[[], Function]]:
        """By name."""
        names = ("terms", "body", "accelerate", "ground")
        return {name: getattr(self, name) for name in names}

    def terms(self) -> Function:
        """A `Reduction`, one part below the other in rows of n numbers."""
        K = self.numbers
        n, p = self.robot.n, self.robot.p
        inp = Vector("inp", 2 * n)
        q, v = inp.take(n), inp.take(n)
        D, Omega = planar.inertia_and_bias(self.robot, K, q, v)
        rows = [_rows(part, n) for part in Tracer()(reduce)(D, Omega, p)]
        return Function(self.K, inp.symbol, column(*rows))

    def body(self) -> Function:
        """A `BodyTerms`, one part after the other."""
        n = self.robot.n
        inp = Vector("inp", 2 * n)
        body = mechanics.body_terms(self.robot, self.numbers, inp.take(n), inp.take(n))
        return Function(self.K, inp.symbol, column(*body))

    def accelerate(self) -> Function:
        """q''."""
        K = self.numbers
        n = self.robot.n
        inp = Vector("inp", 3 * n)
        q, v, force = inp.take(n), inp.take(n), inp.take(n)
        D, Omega = planar.inertia_and_bias(self.robot, K, q, v)
        return Function(self.K, inp.symbol, column(solve_positive(D, force - Omega, "D_s")))

    def ground(self) -> Function:
        """(F_T, F_N) and the end of the swing foot."""
        K = self.numbers
        n = self.robot.n
        inp = Vector("inp", 3 * n)
        q, v, a = inp.take(n), inp.take(n), inp.take(n)
        return Function(self.K, inp.symbol, column(planar.ground_reaction(self.robot, K, q, v, a)))


def _rows(part: Any, n: int) -> Any:
    """A vector or matrix in rows of n numbers, filled up with zeros."""
    part = np.atleast_2d(part)
    rows = np.full((len(part), n), 0.0, dtype=object)
    rows[:, : part.shape[1]] = part
    return rows
