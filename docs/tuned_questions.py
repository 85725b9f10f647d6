"""Questions about two settings that walked the same test set, and their answers with intervals and tests.

What is paired is a walk: the same seed and the same condition. What is independent is a seed: intervals draw
seeds with all of their conditions, and tests count seeds.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from tuned_entries import Entry, reference

from biped_adrc.analysis.statistics import Interval, holm, mcnemar, over_seeds, share, sign_test
from biped_adrc.types import Array

LEVEL = 0.05
"""A difference is carried by its test where Holm's p is below this."""
WORST = 1e6
"""A ratio of a walk that is not legal to one that is; that of two which are not is 1."""
RUNGS = (
    ("observer's rates", "NPD", "the rates of an observer, with the nominal xi"),
    ("NPID", "NPD", "an integral of the error"),
    ("assisted, m = 1", "observer's rates", "what is left of xi, estimated with m = 1"),
    ("assisted, m = 1", "NPID", "an observer in place of the integral"),
    ("m = 1", "assisted, m = 1", "all of xi estimated, none from the model"),
    ("m = 2", "m = 1", "order 2 in place of 1"),
    ("m = 3", "m = 2", "order 3 in place of 2"),
    ("m = 7", "m = 3", "order 7 in place of 3"),
)
"""The ladder: a contestant, the one below it, and what it has besides."""
ORDERS = tuple((name, "m = 1", name) for name in ("m = 2", "m = 3", "m = 7"))
"""The orders above 1, held against order 1."""


class Answer(NamedTuple):
    """How the error of a is to that of b, and how often each walks legally."""

    a: Entry
    b: Entry
    ratio: Interval
    """Median of the paired ratios of rms errors, between 1 / `WORST` and `WORST`."""
    won: int
    """Seeds in which the error of a is smaller, by the mean of the logarithms over the conditions."""
    lost: int
    """Seeds in which it is larger."""
    p: float
    """Of the sign test over seeds, corrected by Holm's method over the family."""
    legal_p: float
    """Of McNemar's test over seeds of which all walks are legal, corrected in the same way."""
    legal_bound: float
    """The shares of such seeds differ by at most this, with 95 %."""
    spread: float = 1.0
    """The factor by which searches of the same contestant may differ; 1 for settings of one search."""

    @property
    def verdict(self) -> str:
        """Whether the error of a is "smaller" or "larger"; "open" where test or searches carry neither."""
        if self.p < LEVEL and self.ratio.high * self.spread < 1.0:
            return "smaller"
        return "larger" if self.p < LEVEL and self.ratio.low > self.spread else "open"

    @property
    def within(self) -> float:
        """The factor within which both errors are of each other, with 95 %, after other searches too."""
        return max(self.ratio.high, 1.0 / self.ratio.low) * self.spread


def log_ratios(a: Array, b: Array) -> Array:
    """Logarithms of a / b (conditions, seeds), both positive or infinite, between -log and log of `WORST`."""
    with np.errstate(invalid="ignore"):
        found = np.log(a) - np.log(b)
    found[np.isinf(a) & np.isinf(b)] = 0.0
    return np.clip(found, -np.log(WORST), np.log(WORST))


def answered(
    pairs: Sequence[tuple[Entry, Entry]], spread: Callable[[int], float] | None = None
) -> list[Answer]:
    """The answers of one family of questions, corrected for each other.

    spread: from a number of searches to the factor by which their means may differ; None for settings of one
    search, which is not repeated.
    """
    found = [_answer(a, b) for a, b in pairs]
    if spread is not None:
        found = [x._replace(spread=spread(min(x.a.searches, x.b.searches))) for x in found]
    errors, legal = holm([x.p for x in found]), holm([x.legal_p for x in found])
    both = zip(found, errors, legal, strict=True)
    return [x._replace(p=p, legal_p=legal_p) for x, p, legal_p in both]


def _answer(a: Entry, b: Entry) -> Answer:
    """The answer to one question, not corrected."""
    logs = log_ratios(a.tuned.rms_error, b.tuned.rms_error)
    middle = over_seeds(logs, lambda sets: np.median(sets, axis=1))
    each = logs.mean(axis=0)
    won, lost = int(np.sum(each < 0.0)), int(np.sum(each > 0.0))
    x, y = (np.all(e.tuned.legal == 1.0, axis=0) for e in (a, b))
    apart = [share(int(np.sum(one & ~other)), len(x)).high for one, other in ((x, y), (y, x))]
    ratio = Interval(*np.exp(middle).tolist())
    return Answer(
        a, b, ratio, won, lost, sign_test(won, lost), mcnemar(list(x), list(y)), max(apart)
    )


Group = Mapping[str, Entry]
"""The searches of one place, gait and seed of the optimiser, by contestant."""


def against_reference(groups: Sequence[Group]) -> list[tuple[Entry, Entry]]:
    """Each contestant beside the better of NPD and NPID of its group; none where neither keeps the limits."""
    pairs = []
    for contestants in groups:
        best = reference(contestants)
        if best is not None and best.found:
            pairs += [(e, best) for e in contestants.values() if e is not best]
    return pairs


def first_of(contestants: Group) -> Entry | None:
    """The best one on the selection set; None where nobody keeps the limits."""
    some = [e for e in contestants.values() if e.found]
    return min(some, key=lambda e: e.selected) if some else None


def first_two(groups: Sequence[Group]) -> list[tuple[Entry, Entry]]:
    """The best one on the selection set beside the next, of each group that has two."""
    ranked = [sorted(g.values(), key=lambda e: e.selected) for g in groups]
    return [(some[0], some[1]) for some in ranked if len(some) > 1 and some[1].found]


def between(
    groups: Sequence[Group], named: Sequence[tuple[str, str, str]]
) -> list[tuple[Entry, Entry]]:
    """The named pairs of each group of which both were searched, and one at least keeps the limits."""
    return [
        (g[a], g[b])
        for g in groups
        for a, b, _ in named
        if a in g and b in g and (g[a].found or g[b].found)
    ]
