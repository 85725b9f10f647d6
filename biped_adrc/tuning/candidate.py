"""A candidate: values of the variables, and what its walks made of objectives and limits.

Candidates are ranked by how far they miss the limits, then by the first objective. Of several objectives the
front is what counts: the candidates that keep all limits and of which none is better in one objective without
being worse in another.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from biped_adrc.bench.parameters import Value
from biped_adrc.errors import InputError
from biped_adrc.tuning.measure import Walks
from biped_adrc.tuning.study import TuningStudy
from biped_adrc.tuning.variables import Values

MOST_EXCESS = 1e6
"""Of a limit that is missed: more counts as this, so that sums are finite."""


class NoneKeepsLimits(InputError):
    """No candidate of a study keeps all of its limits."""


class Candidate(NamedTuple):
    """A setting that was proposed, and how it was judged."""

    number: int
    """Its place in the search; 0 is the as-published setting."""
    generation: int
    """The generation that it was proposed in."""
    chosen: dict[str, Value]
    """A value of every variable; empty for the as-published setting."""
    objectives: tuple[float, ...]
    """Its objectives; infinite where the walks that rank worst decide."""
    limits: tuple[float | None, ...]
    """The numbers that are limited; None for those of walks where it was not walked."""
    excess: tuple[float, ...]
    """By how much each limit is missed, as a share of its bound, at most `MOST_EXCESS`; 0 where it is kept."""
    walked: bool = True
    """False where it missed a limit that needs no walk."""

    @property
    def feasible(self) -> bool:
        """Whether it was walked and keeps all limits."""
        return self.walked and not any(self.excess)

    @property
    def total_excess(self) -> float:
        """Sum of what it misses."""
        return sum(self.excess)


def judged(
    study: TuningStudy,
    number: int,
    generation: int,
    chosen: Values,
    walks: Walks | None,
    known: Mapping[str, float | None],
) -> Candidate:
    """The candidate with these walks, None where it is not walked; known: its columns that need no walk."""
    found = [
        None if walks is None and m.column not in known else m.measured(walks or (), known)
        for m in study.limits
    ]
    pairs = zip(study.limits, found, strict=True)
    excess = [0.0 if x is None else min(m.excess(x), MOST_EXCESS) for m, x in pairs]
    objectives = [m.worst if walks is None else m.measured(walks, known) for m in study.objectives]
    made = tuple(objectives), tuple(found), tuple(excess)
    return Candidate(number, generation, dict(chosen), *made, walked=walks is not None)


def signed(study: TuningStudy, c: Candidate) -> tuple[float, ...]:
    """The objectives with the sign with which less is better."""
    pairs = zip(study.objectives, c.objectives, strict=True)
    return tuple(x if m.less_is_better else -x for m, x in pairs)


def ranked(study: TuningStudy, found: Sequence[Candidate]) -> list[Candidate]:
    """The walked candidates, best first: by what they miss, by the first objective, by number."""
    walked = [c for c in found if c.walked]
    return sorted(walked, key=lambda c: (c.total_excess, *signed(study, c), c.number))


def front(study: TuningStudy, found: Sequence[Candidate]) -> list[Candidate]:
    """The feasible candidates that none dominates, best in the first objective first; equals count once."""
    kept: list[Candidate] = []
    for c in (c for c in ranked(study, found) if c.feasible):
        mine = signed(study, c)
        others = [signed(study, k) for k in kept]
        if not any(all(a <= b for a, b in zip(o, mine, strict=True)) for o in others):
            kept.append(c)
    return kept


def finalists(study: TuningStudy, found: Sequence[Candidate]) -> list[Candidate]:
    """Those that are walked on the selection set: the front, then the best of the rest, then the published one.

    A setting that was proposed twice counts once, and so do two that differ in idle values alone.
    """
    some: dict[str, Candidate] = {}
    for c in (*front(study, found), *ranked(study, found)):
        some.setdefault(repr(sorted(study.values(c.chosen).items())), c)
    best = list(some.values())[: study.finalists]
    return best if any(c.number == 0 for c in best) else [*best, found[0]]


def why_none(study: TuningStudy, found: Sequence[Candidate], where: str) -> str:
    """The sentence for limits that no candidate keeps: what excluded how many, and the nearest one."""
    counts = [
        f"{m.sentence}: missed by {sum(c.excess[i] > 0.0 for c in found)}"
        for i, m in enumerate(study.limits)
    ]
    nearest = min(found, key=lambda c: (c.total_excess, c.number))
    told = [
        f"{m.words} = {x:g}"
        for m, x in zip(study.limits, nearest.limits, strict=True)
        if x is not None
    ]
    values = dict(nearest.chosen) or "the as-published setting"
    return (
        f"study '{study.name}': none of {len(found)} candidates keeps all limits {where}; "
        f"{'; '.join(counts)}. The nearest is number {nearest.number}, {values}, with {', '.join(told)}; "
        "ease a limit, widen a range, or give a larger budget"
    )
