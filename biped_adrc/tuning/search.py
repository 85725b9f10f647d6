"""The search: generations of candidates, proposed, walked and judged, until the budget is spent.

The core knows no robots: `Walk` turns settings into rows, by walking or in any other way. A generation is
proposed as a whole, after all earlier ones have been judged; its candidates that miss a limit which needs no
walk are told to the sampler at once and replaced, in a few rounds, so that walks are spent on the others.

Who calls it decides where rows come from: a store that has them gives the same candidates without a walk,
which is how a search that was killed goes on.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence

from biped_adrc.bench.parameters import Value
from biped_adrc.errors import InputError
from biped_adrc.tuning.candidate import Candidate, NoneKeepsLimits, judged, why_none
from biped_adrc.tuning.measure import Walks
from biped_adrc.tuning.proposals import proposed
from biped_adrc.tuning.study import TuningStudy
from biped_adrc.tuning.variables import Values
from biped_adrc.tuning.without_walk import WITHOUT_WALK, numbers_without_walk

ROUNDS = 8
"""How often a generation asks again for candidates in place of those that miss a limit without a walk."""
MOST_EMPTY = 5
"""Generations one after the other in which no proposal may be walked, and so end the search."""

Walk = Callable[[Sequence[tuple[int, Values]]], Sequence[Walks]]
"""From numbers and settings of candidates to their walks, in the same order."""
Told = Callable[[Sequence[Candidate]], None]
"""What is called after each generation, with all candidates so far."""


def search(study: TuningStudy, walk: Walk, told: Told | None = None) -> tuple[Candidate, ...]:
    """All candidates, by number; the as-published setting is the first.

    Raises InputError where no walk has a number in the column of a measure, or no candidate may be walked.
    """
    found: list[Candidate] = []
    empty = 0
    for generation in itertools.count():
        left = study.budget - sum(c.walked for c in found)
        if left <= 0:
            break
        new = _generation(study, found, generation, min(left, study.generation), walk)
        empty = 0 if any(c.walked for c in new) else empty + 1
        found += new
        if told is not None:
            told(found)
        if empty == MOST_EMPTY:
            break
    if sum(c.walked for c in found) == 1 and len(found) > 1:
        raise NoneKeepsLimits(why_none(study, found, "that need no walk"))
    return tuple(found)


def _generation(
    study: TuningStudy, found: Sequence[Candidate], generation: int, count: int, walk: Walk
) -> list[Candidate]:
    """The candidates of one generation, of which at most `count` are walked."""
    columns = {m.column for m in study.measures} & WITHOUT_WALK.keys()
    known: dict[int, Mapping[str, float | None]] = {}
    asked: list[tuple[int, dict[str, Value]]] = []
    out: list[Candidate] = []
    numbers = itertools.count(len(found))
    if not found:
        asked.append((next(numbers), {}))
        known[0] = numbers_without_walk(columns, study.values({}))
    for round_ in range(ROUNDS):
        if len(asked) == count:
            break
        for chosen in proposed(study, [*found, *out], generation, round_, count - len(asked)):
            number = next(numbers)
            known[number] = numbers_without_walk(columns, study.values(chosen))
            c = judged(study, number, generation, chosen, None, known[number])
            if any(c.excess):
                out.append(c)
            else:
                asked.append((number, chosen))
    walks = walk([(number, study.values(chosen)) for number, chosen in asked])
    for (number, chosen), rows in zip(asked, walks, strict=True):
        out.append(judged(study, number, generation, chosen, rows, known[number]))
    _check_columns(study, walks)
    return sorted(out, key=lambda c: c.number)


def _check_columns(study: TuningStudy, walks: Sequence[Walks]) -> None:
    """Raises InputError for a measure of which no walk that counts has a number, though walks count."""
    rows = [row for one in walks for _, row in one]
    for m in study.measures:
        counted = [row for row in rows if m.fine(row)]
        if m.column in WITHOUT_WALK or not counted:
            continue
        if all(row.get(m.column) is None for row in counted):
            have = sorted(
                {k for row in counted for k, x in row.items() if isinstance(x, int | float)}
            )
            raise InputError(
                f"study '{study.name}' asks for '{m.column}', of which none of {len(counted)} walks has a "
                f"number; expected one of {have}"
            )
