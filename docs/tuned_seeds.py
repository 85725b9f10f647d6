"""What another seed of the optimiser finds: the spread of searches, placebos, and conclusions that move."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from scipy import stats
from tuned_entries import Entry, group
from tuned_questions import ORDERS, Answer, against_reference, answered, between
from tuned_text import MRAD, at, name, number, ratio

from biped_adrc.analysis.statistics import CONFIDENCE

Repeats = Sequence[Entry]
"""The searches of one contestant at one place and gait with several seeds of the optimiser."""


class Spread(NamedTuple):
    """By how much searches of the same contestant differ."""

    log: float
    """Logarithm of the factor by which two of them differ at most, with 95 %; 0 where none was repeated."""
    contestants: int
    """Of so many it is taken."""
    left_out: tuple[str, ...]
    """Contestants of which a search found no setting, or whose median walk is not legal."""

    def factor(self, searches: int = 1) -> float:
        """By how much the means of so many searches each differ at most, with 95 %."""
        return float(np.exp(self.log / np.sqrt(searches)))


def repeated(found: Sequence[Entry]) -> list[Repeats]:
    """The contestants that were searched with several seeds, at each place and gait."""
    same: dict[tuple[str, str, str], list[Entry]] = {}
    for e in found:
        same.setdefault((e.place, e.gait, e.contestant), []).append(e)
    return [some for some in same.values() if len(some) > 1]


def spread_of(repeats: Sequence[Repeats]) -> Spread:
    """The spread from the pooled variance of the logarithms of median errors within a contestant.

    As the limit of repeatability of ISO 5725: t s sqrt(2), with t of the degrees of freedom.
    """
    logs = [np.log([_median(e) for e in some]) for some in repeats]
    left_out = tuple(
        some[0].contestant
        for some, x in zip(repeats, logs, strict=True)
        if not np.isfinite(x).all()
    )
    logs = [x for x in logs if np.isfinite(x).all()]
    freedom = sum(len(x) - 1 for x in logs)
    if freedom == 0:
        return Spread(0.0, 0, left_out)
    variance = sum(float(np.sum((x - x.mean()) ** 2)) for x in logs) / freedom
    t = stats.t.ppf(0.5 + CONFIDENCE / 2, freedom)
    return Spread(float(t * np.sqrt(2.0 * variance)), len(logs), left_out)


def _median(e: Entry) -> float:
    return float(np.median(e.tuned.rms_error))


def placebos(found: Sequence[Entry]) -> tuple[list[Answer], list[Answer]]:
    """Two searches of one contestant as if they were two contestants: by the walks alone, and with the spread.

    The spread is that of the other contestants, so that a placebo does not judge itself.
    """
    repeats = repeated(found)
    pairs = [pair for some in repeats for pair in itertools.combinations(some, 2)]
    alone = answered(pairs)
    spreads = {
        (r[0].place, r[0].gait, r[0].contestant): spread_of([x for x in repeats if x is not r])
        for r in repeats
    }
    with_spread = [
        x._replace(spread=spreads[x.a.place, x.a.gait, x.a.contestant].factor()) for x in alone
    ]
    return alone, with_spread


def placebo_sentences(found: Sequence[Entry]) -> list[str]:
    """What came of the placebos."""
    alone, both = placebos(found)
    if not alone:
        return []
    spread = spread_of(repeated(found))
    rest = f"; left out of it: {', '.join(spread.left_out)}" if spread.left_out else ""
    different = [x for x in both if x.verdict != "open"]
    named = "".join(
        f"; {name(x.a)}, seeds {x.a.seed} and {x.b.seed}, {ratio(x.ratio)}" for x in different
    )
    most = max(x.spread for x in both)
    return [
        f"Two searches of one contestant differ by up to a factor {number(spread.factor())} with 95 % (from "
        f"{spread.contestants} contestants{rest}).",
        f"Placebo: two searches of one contestant as if they were two contestants, {len(alone)} pairs. By "
        f"their walks alone {sum(x.verdict != 'open' for x in alone)} of them are found different, since two "
        f"searches do end at different settings. With the spread of the searches of all others (at most "
        f"{number(most)}) {len(different)} of {len(both)} are found different{named}.",
    ]


def other_seeds(found: Sequence[Entry], spread: Callable[[int], float] | None = None) -> list[str]:
    """For each place and gait with several seeds of the optimiser: how errors and conclusions move."""
    lines = []
    for place, gait in dict.fromkeys((e.place, e.gait) for e in found):
        here = [e for e in found if (e.place, e.gait) == (place, gait)]
        seeds = sorted({e.seed for e in here})
        if len(seeds) < 2:
            continue
        groups = [group(found, place, gait, seed) for seed in seeds]
        lines.append(f"**{at(here[0])}**, seeds {', '.join(map(str, seeds))}: {errors(here)}.")
        for question, pairs in (
            ("the reference", against_reference(groups)),
            ("m = 1", between(groups, ORDERS)),
        ):
            lines.append(f"Held against {question}: {moved(answered(pairs, spread))}.")
    return lines


def errors(here: Sequence[Entry]) -> str:
    """The median errors of the contestants that were searched with several seeds."""
    told = []
    for who in dict.fromkeys(e.contestant for e in here):
        medians = [_median(e) for e in here if e.contestant == who]
        if len(medians) > 1:
            told.append(f"{who} {', '.join(number(MRAD * x) for x in medians)}")
    return "median errors in mrad: " + "; ".join(told)


def moved(answers: Sequence[Answer]) -> str:
    """Which verdicts differ between the seeds, all of one family."""
    by_name: dict[str, list[Answer]] = {}
    for x in answers:
        by_name.setdefault(x.a.contestant, []).append(x)
    asked = {name: found for name, found in by_name.items() if len(found) > 1}
    turned = [
        f"{name} ({', '.join(f'seed {x.a.seed}: {x.verdict}, {ratio(x.ratio)}' for x in found)})"
        for name, found in asked.items()
        if len({x.verdict for x in found}) > 1
    ]
    if not asked:
        return "asked with one seed alone so far"
    if turned:
        opposite = sum(
            {"smaller", "larger"} <= {x.verdict for x in found} for found in asked.values()
        )
        return (
            f"another seed moves {len(turned)} of {len(asked)} conclusions, {opposite} of them from smaller to "
            f"larger: {'; '.join(turned)}"
        )
    return f"another seed moves none of {len(asked)} conclusions"
