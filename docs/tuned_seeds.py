"""What another seed of the optimiser finds: the spread of searches, and placebos."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from tuned_entries import Entry
from tuned_questions import LEVEL, Answer, Scatter, Searched, answered, uncorrected
from tuned_text import MRAD, at, name, number, ratio

Repeats = Sequence[Entry]
"""The searches of one contestant at one place and gait with several seeds of the optimiser."""


class Spread(NamedTuple):
    """How the logarithms of median errors of searches of one contestant scatter."""

    variance: float
    """Pooled over places and gaits."""
    freedom: int
    """Its degrees of freedom."""

    @property
    def factor(self) -> float:
        """By how much two searches differ at most, with 95 %: the limit of repeatability of ISO 5725."""
        return Searched(float(np.sqrt(2.0 * self.variance)), self.freedom).factor


def repeated(found: Sequence[Entry]) -> list[Repeats]:
    """The contestants that were searched with several seeds, at each place and gait."""
    same: dict[tuple[str, str, str], list[Entry]] = {}
    for e in found:
        same.setdefault((e.place, e.gait, e.contestant), []).append(e)
    return [some for some in same.values() if len(some) > 1]


def spread_of(repeats: Sequence[Repeats]) -> Spread | None:
    """The spread within a contestant, at one or several places and gaits; None where none was repeated."""
    logs = [np.log([float(e.medians[0]) for e in some]) for some in repeats]
    finite = [x for x in logs if np.isfinite(x).all()]
    freedom = sum(len(x) - 1 for x in finite)
    if freedom == 0:
        return None
    squares = sum(float(np.sum((x - x.mean()) ** 2)) for x in finite)
    return Spread(squares / freedom, freedom)


Spreads = dict[tuple[str, str], Spread]
"""By contestant and kind of place."""


def spreads_of(repeats: Sequence[Repeats]) -> Spreads:
    """The spread of each contestant that was repeated, at all places of a kind together."""
    same: dict[tuple[str, str], list[Repeats]] = {}
    for some in repeats:
        same.setdefault((some[0].contestant, some[0].kind), []).append(some)
    found = {key: spread_of(some) for key, some in same.items()}
    return {key: spread for key, spread in found.items() if spread is not None}


def scatter_of(repeats: Sequence[Repeats]) -> Scatter | None:
    """How searches of two contestants scatter, as Welch's t test has it; None where none was repeated.

    One without a spread of its own scatters as the contestant that does so most at places of the same kind, or
    at all places where nobody was repeated there.
    """
    own = spreads_of(repeats)
    if not own:
        return None

    def spread(e: Entry) -> Spread:
        here = [s for (_, kind), s in own.items() if kind == e.kind] or list(own.values())
        return own.get((e.contestant, e.kind)) or max(here, key=lambda s: s.factor)

    def scatter(a: Entry, b: Entry) -> Searched:
        x, y = spread(a), spread(b)
        of_a, of_b = x.variance / a.searches, y.variance / b.searches
        error = float(np.sqrt(of_a + of_b))
        if x is y or error == 0.0:  # one estimate, and not two
            return Searched(error, x.freedom)
        freedom = (of_a + of_b) ** 2 / (of_a**2 / x.freedom + of_b**2 / y.freedom)
        return Searched(error, freedom)

    return scatter


def placebos(found: Sequence[Entry]) -> tuple[list[Answer], list[Answer], list[Answer]]:
    """Two searches of one contestant as if they were two contestants: by the walks alone, by searches too, and
    so, but each asked alone and without those pairs of which a search found nothing.

    How its searches scatter is taken from other places and gaits of the same kind, and from all others where
    there are none, so that a placebo does not judge itself.
    """
    repeats = repeated(found)
    pairs = [pair for some in repeats for pair in itertools.combinations(some, 2)]

    def elsewhere(a: Entry, b: Entry) -> Searched:
        others = [x for x in repeats if (x[0].place, x[0].gait) != (a.place, a.gait)]
        scatter = scatter_of(others)
        return Searched() if scatter is None else scatter(a, b)

    able = [(a, b) for a, b in pairs if a.found and b.found]
    return answered(pairs), answered(pairs, elsewhere), uncorrected(able, elsewhere)


def placebo_sentences(found: Sequence[Entry]) -> list[str]:
    """By how much searches differ, and what came of the placebos."""
    alone, both, single = placebos(found)
    if not alone:
        return []
    spreads = spreads_of(repeated(found))
    kinds = dict.fromkeys(kind for _, kind in spreads)
    told = [
        f"{kind}: "
        + ", ".join(f"*{n}* {number(s.factor)}" for (n, k), s in spreads.items() if k == kind)
        for kind in kinds
    ]
    lost = Counter(
        f"*{some[0].contestant}*"
        for some in repeated(found)
        if any(np.isinf(e.medians[0]) for e in some)
    )
    rest = ", ".join(f"{who} at {count}" for who, count in lost.items())
    left_out = (
        f" Left out are places and gaits where a search found nothing: {rest}." if rest else ""
    )
    different = [x for x in both if x.verdict != "open"]
    chance = sum(x.verdict != "open" for x in single)
    named = "".join(
        f"; {name(x.a)} at {at(x.a)}, seeds {x.a.seed} and {x.b.seed}, {ratio(x.ratio)}"
        for x in different
    )
    return [
        f"Two searches of one contestant differ, with 95 %, by up to a factor of, by hardware and plant: "
        f"{'; '.join(told)}.{left_out}",
        f"Placebo: two searches of one contestant as if they were two contestants, {len(alone)} pairs. By "
        f"their walks alone {sum(x.verdict != 'open' for x in alone)} of them are found different, since two "
        f"searches do end at different settings. By the rule of this page, with the scatter of the same "
        f"contestant's searches at other places and gaits, {len(different)} of {len(both)} are found "
        f"different{named}. That correction over so many pairs leaves few to be found: without it {chance} of "
        f"the {len(single)} pairs of which both found something are different, where {100 * LEVEL:g} % of them "
        f"would be by chance; the other {len(both) - len(single)} cannot be.",
    ]


def errors(here: Sequence[Entry]) -> str:
    """The median errors of the contestants that were searched with several seeds."""
    told = []
    for who in dict.fromkeys(e.contestant for e in here):
        medians = [float(e.medians[0]) for e in here if e.contestant == who]
        if len(medians) > 1:
            told.append(f"{who} {', '.join(number(MRAD * x) for x in medians)}")
    return "median errors in mrad: " + "; ".join(told)
