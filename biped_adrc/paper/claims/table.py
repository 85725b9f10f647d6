"""The table of claims: one row for each claim of the paper, from the abstract to its last section.

Puts the rows of `rows_push`, `rows_control` and `rows_gait` in order, with the claims that no run can decide.
`claims` takes the results of a reproduction, `rows` plain outcomes, so that a row can be tested without runs.
Called by `paper.reproduction`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from biped_adrc.paper.claims.rows_control import control_claims
from biped_adrc.paper.claims.rows_gait import gait_claims
from biped_adrc.paper.claims.rows_push import long_walk, push_claims
from biped_adrc.paper.claims.tasks import Evidence, gathered
from biped_adrc.paper.claims.words import Claim, told
from biped_adrc.paper.plan import Plan
from biped_adrc.paper.push_map import PushCell
from biped_adrc.paper.results import Results
from biped_adrc.paper.verdicts import distance

UNDECIDED = ("lumped", "smooth_references", "same_gains", "curves", "earlier_approaches")
"""Claims that no run can decide; their rows are texts alone."""


def claims(plan: Plan, r: Results) -> list[Claim]:
    """All rows, from the results of a reproduction."""
    made = {c: (head.outcome.impacts, head.outcome.run.run.impacts) for c, head in r.heads.items()}
    farthest = float(np.max([distance(o) for _, o in r.nominal(plan)]))
    return rows(gathered(r.claims.values()), r.figures, made, farthest, r.cells)


def rows(
    e: Evidence,
    numerics: Mapping[str, float],
    made: Mapping[str, tuple[int, int]],
    farthest: float,
    cells: Sequence[PushCell] = (),
) -> list[Claim]:
    """All rows, from outcomes alone.

    e: the evidence; numerics: figures of the held joint by name; made: impacts made and asked for, by
    controller; farthest: largest distance of the undisturbed walks on gait (a) from x*; cells: of the map of
    pushes.
    """
    return [
        long_walk(made),
        *push_claims(e.members, cells),
        *control_claims(e.unmatched, e.uncertainty, e.pushed_recipe, e.jumps, e.orders, numerics),
        *gait_claims(e.cycles, e.needs, e.basin, farthest),
        *(told(name) for name in UNDECIDED),
    ]
