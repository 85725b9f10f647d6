"""The equations of a robot by itself on symbols, for controllers in plain Python.

terms (q, v) -> D, Omega, kappa, xi, ... of (11)-(15),   body (q, v) -> G, C' q', F_a, F_0
accelerate (q, v, force) -> q'',   ground (q, v, a) -> F
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from biped_adrc.engine.equations import Function, count
from biped_adrc.engine.mechanics import PlanarRobot, Structure
from biped_adrc.engine.symbols import Vector, column
from biped_adrc.model.planar import PlantArrays


@dataclass(frozen=True)
class PlantEquations:
    """The functions of a robot by itself; K is CasADi's column of the symbols in it."""

    robot: PlanarRobot
    K: Any

    @classmethod
    def of(cls, structure: Structure, example: PlantArrays) -> PlantEquations:
        """With symbols for the floats of an example."""
        K = Vector("K", count(example))
        return cls(PlanarRobot.of(structure, K.like(example)), K.symbol)

    def functions(self) -> dict[str, Callable[[], Function]]:
        """By name; `terms` gives a `Reduction`, one part below the other in rows of n numbers."""
        robot, n = self.robot, self.robot.n

        def terms(q: Any, v: Any) -> Any:
            return [_rows(part, n) for part in robot.reduction(q, v)]

        found: dict[str, tuple[Callable[..., Any], int]] = {
            "terms": (terms, 2),
            "body": (robot.body_terms, 2),
            "accelerate": (lambda *given: (robot.acceleration(*given),), 3),
            "ground": (lambda *given: (robot.ground_reaction(*given),), 3),
        }
        return {name: partial(self._made, *how) for name, how in found.items()}

    def _made(self, law: Callable[..., Any], count: int) -> Function:
        """The function of `count` vectors (n,)."""
        inp = Vector("inp", count * self.robot.n)
        given = (inp.take(self.robot.n) for _ in range(count))
        return Function(self.K, inp.symbol, column(*law(*given)))


def _rows(part: Any, n: int) -> Any:
    """A vector or matrix in rows of n numbers, filled up with zeros."""
    part = np.atleast_2d(part)
    rows = np.full((len(part), n), 0.0, dtype=object)
    rows[:, : part.shape[1]] = part
    return rows
