"""Questions about two settings that walked the same test set, and their answers with intervals and tests.

What is paired is a walk: the same seed and the same condition. What is independent is a seed: intervals draw
seeds with all of their conditions, and tests count seeds.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from scipy import stats
from tuned_entries import Entry, reference

from biped_adrc.analysis.statistics import (
    CONFIDENCE,
    Interval,
    holm,
    mcnemar,
    over_seeds,
    share,
    sign_test,
)
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


class Searched(NamedTuple):
    """How far the logarithms of two contestants' errors lie apart by their searches alone."""

    error: float = 0.0
    """Standard error of their difference."""
    freedom: float = 1.0
    """Its degrees of freedom."""

    def p(self, log: float) -> float:
        """Of the t test that a difference of logarithms is 0; 0 where searches are not repeated."""
        if self.error == 0.0:
            return 0.0
        return float(2.0 * stats.t.sf(abs(log) / self.error, self.freedom))

    @property
    def factor(self) -> float:
        """By how much both may differ with 95 %."""
        return float(np.exp(stats.t.ppf(0.5 + CONFIDENCE / 2.0, self.freedom) * self.error))


Scatter = Callable[[Entry, Entry], Searched]
"""How the searches of two contestants scatter."""


class Answer(NamedTuple):
    """How the error of a is to that of b, and how often each walks legally."""

    a: Entry
    b: Entry
    ratio: Interval
    """Median of the paired ratios of rms errors, between 1 / `WORST` and `WORST`."""
    won: int
    """Seeds in which the error of a is smaller, by the median of the logarithms of their walks."""
    lost: int
    """Seeds in which it is larger."""
    p: float
    """The larger one of the sign test over seeds and of the t test over searches, corrected by Holm's method
    over the family."""
    legal_p: float
    """Of McNemar's test over seeds of which all walks are legal, corrected in the same way; 1 where a search of
    several found nothing, of which there are no walks."""
    legal_bound: float
    """The shares of such seeds differ by at most this, with 95 %."""
    searched: Searched = Searched()
    """How its searches scatter; nothing for settings of one search, which is not repeated."""
    steady: bool = True
    """Whether its verdict is the same without any one seed of the optimiser (`tuned_steady`)."""

    @property
    def verdict(self) -> str:
        """Whether the error of a is "smaller" or "larger"; "open" where walks or searches carry neither."""
        if not self.steady:
            return "open"
        if self.p < LEVEL and self.ratio.high < 1.0:
            return "smaller"
        return "larger" if self.p < LEVEL and self.ratio.low > 1.0 else "open"

    @property
    def within(self) -> float:
        """The factor within which both errors are of each other, with 95 %, after other searches too."""
        bound = max(self.ratio.high, 1.0 / self.ratio.low) * self.searched.factor
        return float("inf") if mixed(self.a) or mixed(self.b) else bound


def mixed(e: Entry) -> bool:
    """Whether some searches of a contestant have a legal median walk, and some have not."""
    some = np.isfinite(e.medians)
    return bool(some.any() and not some.all())


def partly_failed(e: Entry) -> bool:
    """Whether some searches of a contestant found a setting, and some did not."""
    return 0 < e.failed < e.searches


def log_ratios(a: Array, b: Array) -> Array:
    """Logarithms of a / b (conditions, seeds), both positive or infinite, between -log and log of `WORST`."""
    with np.errstate(invalid="ignore"):
        found = np.log(a) - np.log(b)
    found[np.isinf(a) & np.isinf(b)] = 0.0
    return np.clip(found, -np.log(WORST), np.log(WORST))


def paired(a: Entry, b: Entry) -> Array:
    """Logarithms of the ratios of errors of the same walk (pairs of searches and conditions, seeds).

    Each search of a stands beside each of b: the seed of the optimiser pairs nothing.
    """
    x, y = (np.array(np.split(e.tuned.rms_error, e.searches)) for e in (a, b))
    logs = log_ratios(*np.broadcast_arrays(x[:, None], y[None, :]))
    return logs.reshape(-1, logs.shape[-1])


def answered(pairs: Sequence[tuple[Entry, Entry]], scatter: Scatter | None = None) -> list[Answer]:
    """The answers of one family of questions, corrected for each other.

    scatter: of the searches of two contestants; None for settings of one search, which is not repeated.
    """
    found = uncorrected(pairs, scatter)
    errors, legal = holm([x.p for x in found]), holm([x.legal_p for x in found])
    both = zip(found, errors, legal, strict=True)
    return [x._replace(p=p, legal_p=legal_p) for x, p, legal_p in both]


def uncorrected(
    pairs: Sequence[tuple[Entry, Entry]], scatter: Scatter | None = None
) -> list[Answer]:
    """The answers of questions that are each asked alone."""
    return [_answer(a, b, Searched() if scatter is None else scatter(a, b)) for a, b in pairs]


def _answer(a: Entry, b: Entry, searched: Searched) -> Answer:
    """The answer to one question, not corrected."""
    logs = paired(a, b)
    middle = over_seeds(logs, lambda sets: np.median(sets, axis=1))
    each = np.median(logs, axis=0)
    won, lost = int(np.sum(each < 0.0)), int(np.sum(each > 0.0))
    p = max(sign_test(won, lost), searched.p(least(a, b, middle.value)))
    x, y = (np.all(e.tuned.legal == 1.0, axis=0) for e in (a, b))
    legal_p = 1.0 if partly_failed(a) or partly_failed(b) else mcnemar(list(x), list(y))
    apart = [share(int(np.sum(one & ~other)), len(x)).high for one, other in ((x, y), (y, x))]
    ratio = Interval(*np.exp(middle).tolist())
    return Answer(a, b, ratio, won, lost, p, legal_p, max(apart), searched)


def least(a: Entry, b: Entry, log: float) -> float:
    """The logarithm of the ratio that searches are asked about, log where one found nothing in all of them.

    It is the difference of what scatters, the means over searches of the logarithms of median errors.
    Where only some searches of a contestant found something it is the one of two single searches that is
    nearest to 0, and 0 where they do not agree in sign. That one search found nothing says nothing: another
    one may.
    """
    sides = [(np.isfinite(e.medians), e.searches) for e in (a, b)]
    if any(not found.any() and searches == 1 for found, searches in sides):
        return 0.0
    if all(found.all() for found, _ in sides):
        return float(np.mean(np.log(a.medians)) - np.mean(np.log(b.medians)))
    if not (mixed(a) or mixed(b)):
        return log
    each = log_ratios(a.medians[:, None], b.medians[None, :])
    return float(np.min(np.abs(each))) if abs(np.sign(each).sum()) == each.size else 0.0


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
    return min(some, key=lambda e: e.rank) if some else None


def first_two(groups: Sequence[Group]) -> list[tuple[Entry, Entry]]:
    """The best one on the selection set beside the next, of each group that has two."""
    ranked = [sorted(g.values(), key=lambda e: e.rank) for g in groups]
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
