"""The equations of a robot by itself on symbols, for controllers in plain Python.

terms (q, v) -> D, Omega, kappa, xi, ... of (11)-(15),   body (q, v) -> G, C' q', F_a, F_0
accelerate (q, v, force) -> q'',   ground (q, v, a) -> F
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

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
        """By name; `terms` and `body` give the parts of their tuples one after the other."""
        robot = self.robot
        found: dict[str, tuple[Callable[..., Any], int]] = {
            "terms": (robot.reduction, 2),
            "body": (robot.body_terms, 2),
            "accelerate": (robot.acceleration, 3),
            "ground": (robot.ground_reaction, 3),
        }
        return {name: partial(self._made, *how) for name, how in found.items()}

    def _made(self, law: Callable[..., Any], count: int) -> Function:
        """The function of `count` vectors (n,)."""
        inp = Vector("inp", count * self.robot.n)
        given = (inp.take(self.robot.n) for _ in range(count))
        parts = law(*given)
        return Function(self.K, inp.symbol, column(*parts))
