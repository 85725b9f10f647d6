"""Gait (b) as it walks: the fixed point of the closed loop, since the impact leaves its constraint."""

from __future__ import annotations

from dataclasses import replace

from biped_adrc.analysis.return_map import ReturnMap
from biped_adrc.control.npd import NPDController
from biped_adrc.errors import SimulationError
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.recipe import RecipeParameters, design_recipe_gait
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.walk import walk
from biped_adrc.walker import FOOT_STRIKE, Walker

SETTLE = 25
"""Impacts walked before Newton starts."""


def design_recipe_orbit(biped: Biped, parameters: RecipeParameters | None = None) -> Gait:
    """Gait (b) with the pre-impact state of its walking cycle under NPD.

    When no cycle is found the state of the zero dynamics is kept, and the provenance says so.
    """
    gait = design_recipe_gait(biped, parameters)
    walker = Walker(biped, NPDController(gait.constraint))
    settled = walk(walker, gait, SETTLE, RK4(1e-3))
    try:
        if not settled.trajectory.status.ok:
            raise SimulationError(settled.trajectory.status.value)
        guess = settled.trajectory.before(FOOT_STRIKE)[-1]
        orbit = ReturnMap(walker, RK4(1e-3)).fixed_point(guess)
    except SimulationError as error:
        return replace(gait, provenance={**gait.provenance, "cycle": f"none found: {error}"})
    n = biped.n
    found = replace(
        gait,
        q_minus=orbit.x_minus[:n],
        v_minus=orbit.x_minus[n : 2 * n],
        provenance={
            **gait.provenance,
            "cycle": "fixed point of the return map under NPD, Table II, continuous time; largest "
            f"multiplier {abs(orbit.multipliers[0]):.4f}",
        },
    )
    step = walk(walker, found, 1, RK4(1e-3))
    return replace(found, period=step.trajectory.t_end)
