"""Which conclusions stand without any one seed of the optimiser: of a place that was searched with several.

A verdict is carried where it is the same without each of the seeds; a seed that decides it leaves it open.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from tuned_entries import Entry, groups_of
from tuned_questions import (
    ORDERS,
    RUNGS,
    Answer,
    Group,
    Scatter,
    against_reference,
    answered,
    between,
)
from tuned_seeds import errors
from tuned_text import at, ratio

Asked = Callable[[Sequence[Group]], list[tuple[Entry, Entry]]]
"""The pairs of one family of questions."""
Key = tuple[str, str, str]
"""Of an answer: place and gait, and both contestants."""


def rungs(groups: Sequence[Group]) -> list[tuple[Entry, Entry]]:
    """The rungs of the ladder."""
    return between(groups, RUNGS)


def orders(groups: Sequence[Group]) -> list[tuple[Entry, Entry]]:
    """The orders above 1 beside order 1."""
    return between(groups, ORDERS)


FAMILIES: dict[str, Asked] = {
    "the reference": against_reference,
    "the rung below": rungs,
    "m = 1": orders,
}
"""The families of questions, by what is held against."""


def families(
    groups: Sequence[Group], found: Sequence[Entry] = (), scatter: Scatter | None = None
) -> dict[str, list[Answer]]:
    """The answers of each family, each corrected by itself. found: the searches that seeds are left out of."""
    return {name: steadied(groups, found, asked, scatter) for name, asked in FAMILIES.items()}


def key_of(x: Answer) -> Key:
    return at(x.a), x.a.contestant, x.b.contestant


def steadied(
    groups: Sequence[Group], found: Sequence[Entry], asked: Asked, scatter: Scatter | None
) -> list[Answer]:
    """The answers of one family; one that is another without a seed of the optimiser is not steady."""
    whole = answered(asked(groups), scatter)
    seeds = sorted({e.seed for e in found})
    verdicts = [
        {key_of(x): x.verdict for x in answered(asked(groups_of(rest)), scatter)}
        for seed in seeds
        if (rest := [e for e in found if e.seed != seed]) and len(seeds) > 1
    ]

    def steady(x: Answer) -> bool:
        several = x.a.searches > 1
        return not several or all(v.get(key_of(x)) == x.verdict for v in verdicts)

    return [x._replace(steady=steady(x)) for x in whole]


def other_seeds(found: Sequence[Entry], asked: dict[str, list[Answer]]) -> list[str]:
    """For each place and gait with several seeds of the optimiser the errors, then what a seed decides."""
    lines = []
    for place, gait in dict.fromkeys((e.place, e.gait) for e in found):
        here = [e for e in found if (e.place, e.gait) == (place, gait)]
        seeds = sorted({e.seed for e in here})
        if len(seeds) > 1:
            lines.append(f"**{at(here[0])}**, seeds {', '.join(map(str, seeds))}: {errors(here)}.")
    for question, answers in asked.items():
        several = [x for x in answers if x.a.searches > 1]
        if several:
            lines.append(
                f"Held against {question}: {stands(several)} {directions(found, question, several)}"
            )
    return lines


def stands(answers: Sequence[Answer]) -> str:
    """How many conclusions stand without any one seed, and which are open because one seed decides them."""
    carried = sum(x.verdict != "open" for x in answers)
    decided = [x for x in answers if not x.steady and x._replace(steady=True).verdict != "open"]
    named = "; ".join(
        f"{x.a.contestant} at {at(x.a)} ({x._replace(steady=True).verdict}, {ratio(x.ratio)})"
        for x in decided
    )
    told = f"of {len(answers)} conclusions {carried} are carried, each of them without any one seed too"
    if decided:
        return f"{told}; {len(decided)} more would be by all seeds together, and one seed decides: {named}."
    return f"{told}."


def directions(found: Sequence[Entry], question: str, answers: Sequence[Answer]) -> str:
    """Whether the walks of one seed alone say the opposite of a carried conclusion."""
    carried = {key_of(x): x for x in answers if x.verdict != "open"}
    against = []
    for seed in sorted({e.seed for e in found}):
        alone = answered(FAMILIES[question](groups_of([e for e in found if e.seed == seed])))
        against += [
            f"{x.a.contestant} at {at(x.a)} (seed {seed}: {ratio(x.ratio)})"
            for x in alone
            if key_of(x) in carried and opposite(x, carried[key_of(x)])
        ]
    return f"By the walks of one seed alone the opposite: {'; '.join(against) or 'none'}."


def opposite(x: Answer, carried: Answer) -> bool:
    """Whether the interval of x lies on the other side of 1 than a carried verdict."""
    return x.ratio.low > 1.0 if carried.verdict == "smaller" else x.ratio.high < 1.0
