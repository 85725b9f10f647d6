"""The largest legal pushes of tuned settings, known to intervals alone, held against those of the reference."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import tuned_text as words
from tuned_entries import Entry, key_of, reference
from tuned_questions import LEVEL, WORST, Group
from tuned_text import at, name, number

from biped_adrc.analysis.statistics import Interval, holm, over_seeds, sign_test
from biped_adrc.types import Array


class Pushes(NamedTuple):
    """The largest legal pushes of a setting held against those of another, known to intervals alone."""

    a: Entry
    b: Entry
    median: tuple[float, float]
    """Bounds of the median of a [N m]."""
    low: Interval
    """Median ratio with the lower ends of a and the upper ends of b."""
    high: Interval
    """Median ratio with the upper ends of a and the lower ends of b."""
    won: int
    """Seeds in which a bears more for certain: its interval is above that of b."""
    lost: int
    """Seeds in which it bears less for certain."""
    p: float
    """Of the sign test over those seeds, corrected by Holm's method."""

    @property
    def verdict(self) -> str:
        """Whether a bears "larger" or "smaller" pushes; "open" where that is not carried."""
        if self.p < LEVEL and self.low.low > 1.0:
            return "larger"
        return "smaller" if self.p < LEVEL and self.high.high < 1.0 else "open"

    @property
    def within(self) -> float:
        """The factor within which both are of each other, with 95 %, wherever in its interval a push lies."""
        return max(self.high.high, 1.0 / self.low.low)


def pushes(summary: Mapping[str, Any], groups: Sequence[Group]) -> list[Pushes]:
    """The largest legal pushes of all contestants held against those of the reference, one family."""
    known = summary["beside"].get("pushes", [])
    ends = {key_of(x): np.array(x["ends"], dtype=float) for x in known}
    found = []
    for g in groups:
        base = reference(g)
        keys = {name: key_of(e._asdict()) for name, e in g.items()}
        if base is None or (of_base := ends.get(keys[base.contestant])) is None:
            continue
        found += [
            _compared(e, base, ends[keys[name]], of_base)
            for name, e in g.items()
            if e is not base and keys[name] in ends
        ]
    return [x._replace(p=p) for x, p in zip(found, holm([x.p for x in found]), strict=True)]


def _compared(a: Entry, b: Entry, x: Array, y: Array) -> Pushes:
    """The ends x of a beside the ends y of b, each (seeds, 2) [N m]."""
    low, high = (_median(_logs(x[:, i], y[:, 1 - i])) for i in (0, 1))
    won, lost = int(np.sum(x[:, 0] >= y[:, 1])), int(np.sum(x[:, 1] <= y[:, 0]))
    both = int(
        np.sum((x[:, 0] >= y[:, 1]) & (x[:, 1] <= y[:, 0]))
    )  # the same number, known exactly
    median = float(np.median(x[:, 0])), float(np.median(x[:, 1]))
    won, lost = won - both, lost - both
    return Pushes(a, b, median, low, high, won, lost, sign_test(won, lost))


def _logs(x: Array, y: Array) -> Array:
    """log(x / y) of numbers that may be 0 or infinite, at most log of `WORST` in size; 0 for two zeros."""
    with np.errstate(divide="ignore", invalid="ignore"):
        found = np.log(x) - np.log(y)
    found[np.isnan(found)] = 0.0
    return np.clip(found, -np.log(WORST), np.log(WORST))


def _median(logs: Array) -> Interval:
    found = over_seeds(logs[None, :], lambda sets: np.median(sets, axis=1))
    return Interval(*np.exp(found).tolist())


def push_sentences(asked: Sequence[Pushes]) -> list[str]:
    """What each contestant's largest legal push is beside that of the reference."""
    lines = []
    for x in asked:
        bounds = " to ".join(number(y) for y in x.median)
        told = {
            "larger": f"bears larger pushes than {name(x.b)}, by a median factor of at least "
            f"{number(x.low.low)}",
            "smaller": f"bears smaller pushes than {name(x.b)}, by a median factor of at most "
            f"{number(x.high.high)}",
            "open": f"is open against {name(x.b)}",
        }[x.verdict]
        bound = ""
        if x.verdict == "open":
            bound = (
                f", within a factor {number(x.within)} of each other"
                if x.within < words.NEVER
                else ", without a bound"
            )
        lines.append(
            f"{at(x.a)}: {name(x.a)} {told}{bound}; median {bounds} N m, larger for certain in {x.won} seeds, "
            f"smaller in {x.lost} (p {words.p_value(x.p)})."
        )
    return lines
