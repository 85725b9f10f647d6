"""The table of claims: one row for each claim of the paper, from the abstract to its last section."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from biped_adrc.studies.claims.gathered import Evidence, gathered
from biped_adrc.studies.claims.rows_control import control_claims
from biped_adrc.studies.claims.rows_gait import gait_claims
from biped_adrc.studies.claims.rows_push import long_walk, push_claims
from biped_adrc.studies.claims.words import BY_CONSTRUCTION, NOT_TESTABLE, Claim
from biped_adrc.studies.pair import CONTROLLERS
from biped_adrc.studies.push_map import Cell
from biped_adrc.studies.verdicts import distance

PREFACE = (
    "The authors' code and data are not at hand: the robot's parameters, the polynomials of the gait "
    "and the pushes are not printed. So this is replication, the same question put to a setup of one's "
    "own, and no reproduction of their numbers. Choices that the paper leaves open were declared "
    "before the run, in admissible.toml of the package."
)
"""What the report says before the table."""


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
        *_said(),
    ]


def _said() -> list[Claim]:
    """Rows that no run can decide."""
    return [
        Claim(
            "External perturbations and model uncertainties are lumped in one signal per joint",
            "I; (13), (14)",
            BY_CONSTRUCTION,
            "xi of (14)",
            "a definition; (11) and (13) give one letter to a force and to an acceleration",
        ),
        Claim(
            "References are smooth and generated online from the state of the robot",
            "abstract; IV",
            BY_CONSTRUCTION,
            "polynomials of Theta",
            "within a step; at impact see the row of section VII",
        ),
        Claim(
            "The gains of NPD 'do not differ' from those of ADRC, for 'a comparable dynamic'",
            "VI; Table II",
            BY_CONSTRUCTION,
            "K_p = 5000 1/s^2, K_d = 50 1/s in both",
            "equal gains of the outer loop; the observer adds bandwidth that NPD has not. (28) prints "
            "estimates x1^, x2^ for NPD, which has no observer: the measured state is meant",
        ),
        Claim(
            "Figures 4, 5 and 6: the curves themselves",
            "VI",
            NOT_TESTABLE,
            "no scale, amplitude, onset or joint of the push in the text",
            "only the words about them can be tried; they are rows of their own",
        ),
        Claim(
            "Earlier approaches lack accuracy or need planar feet; little was done on tracking under "
            "disturbances",
            "I",
            NOT_TESTABLE,
            "none",
            "about other authors' work, which was not run here",
        ),
    ]
