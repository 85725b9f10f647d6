"""The table of claims: one row for each claim of the paper, from the abstract to its last section."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from biped_adrc.studies.claims.gathered import Evidence, gathered
from biped_adrc.studies.claims.rows_control import control_claims
from biped_adrc.studies.claims.rows_gait import gait_claims
from biped_adrc.studies.claims.rows_push import long_walk, push_claims
from biped_adrc.studies.claims.words import Claim, told
from biped_adrc.studies.push_map import Cell
from biped_adrc.studies.runs import CONTROLLERS
from biped_adrc.studies.verdicts import distance

UNDECIDED = ("lumped", "smooth_references", "same_gains", "curves", "earlier_approaches")
"""Rows that no run can decide."""


def claims(presets: tuple[str, ...], results: dict[str, Any]) -> list[Claim]:
    """All rows, from the results of the reproduction."""
    heads = {c: results[f"headline {c}"].outcome for c in CONTROLLERS}
    made = {c: (o.impacts, o.run.impacts) for c, o in heads.items()}
    nominal = [distance(results[f"nominal {p} {c}"]) for p in presets for c in CONTROLLERS]
    farthest = float(np.max(nominal))
    numerics = results["numerics"][1]
    return rows(gathered(presets, results), numerics, made, farthest, map_cells(results))


def map_cells(results: dict[str, Any]) -> list[Cell]:
    """The pushes of the map; none where it was not asked for."""
    return [cell for name, found in results.items() if name.startswith("map ") for cell in found]


def rows(
    e: Evidence,
    numerics: Mapping[str, float],
    made: Mapping[str, tuple[int, int]],
    farthest: float,
    cells: Sequence[Cell] = (),
) -> list[Claim]:
    """All rows, from outcomes alone; farthest: of the undisturbed walks on gait (a) from x*.

    cells: of the map of pushes.
    """
    return [
        long_walk(made),
        *push_claims(e.members, cells),
        *control_claims(e.unmatched, e.uncertainty, e.pushed_recipe, e.jumps, e.orders, numerics),
        *gait_claims(e.cycles, e.needs, e.basin, farthest),
        *(told(name) for name in UNDECIDED),
    ]
