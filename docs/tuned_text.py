"""Numbers, settings and answers of the contest in words."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy import stats
from tuned_entries import Entry, Walks
from tuned_questions import WORST, Answer

from biped_adrc.analysis.statistics import Interval, over_seeds
from biped_adrc.types import Array

MRAD = 1e3
"""mrad in a rad, and ms in a s."""
NEVER = 0.9 * WORST**0.5
"""From this ratio on a walk that is not legal decides, and the ratio has no number."""


def number(x: float, digits: int = 3) -> str:
    """So many digits, never in powers of ten; a sign for what is not finite."""
    return "∞" if np.isinf(x) else f"{float(f'{x:.{digits}g}'):.12g}"


def interval(found: Interval, factor: float = 1.0, digits: int = 3) -> str:
    """ "value (low to high)"."""
    value, low, high = (number(factor * x, digits) for x in found)
    return f"{value} ({low} to {high})" if value != "∞" or low != "∞" else "∞"


def ratio(found: Interval) -> str:
    """A ratio with its interval, to four digits near 1; 0 and ∞ where walks that are not legal decide."""
    clipped = (0.0 if x < 1.0 / NEVER else np.inf if x > NEVER else x for x in found)
    return interval(Interval(*clipped), digits=4 if abs(found.value - 1.0) < 0.1 else 3)


def middle(x: Array) -> Interval:
    """Median of walks (conditions, seeds) with its interval; walks that are infinite count."""
    return over_seeds(x, lambda sets: np.median(sets, axis=1))


def interquartile(x: Array) -> Interval:
    """Mean of the middle half of walks with its interval; infinite where more than a quarter are infinite."""
    return over_seeds(x, lambda sets: stats.trim_mean(sets, 0.25, axis=1))


def error(walks: Walks) -> str:
    """The median of the rms errors [mrad]."""
    return interval(middle(walks.rms_error), MRAD)


def legal(walks: Walks) -> str:
    """How many walks are legal."""
    return f"{int(walks.legal.sum())} of {walks.legal.size}"


def setting(e: Entry) -> str:
    """The chosen values, in SI units."""
    told = (f"{key.removeprefix('own.')} = {value(x)}" for key, x in e.chosen.items())
    return ", ".join(told) or "none that keeps the limits"


def value(x: float | str | None) -> str:
    """A chosen value: a number, a name, or "none"."""
    return number(x) if isinstance(x, float | int) else x or "none"


def at(e: Entry) -> str:
    """Place and gait."""
    return f"{e.place}, gait {e.gait}"


def name(e: Entry) -> str:
    """The contestant inside a sentence; some names have commas."""
    return f"*{e.contestant}*"


def within(x: Answer) -> str:
    """The equivalence bound of an answer that is open."""
    if x.within > NEVER:
        return "walks that are not legal leave it without a bound"
    return f"within a factor {number(x.within)} of each other"


def verdict(x: Answer, smaller: str, larger: str) -> str:
    """The answer in a few words; what is open has its bound."""
    words = {"smaller": smaller, "larger": larger}
    return words.get(x.verdict, f"open, {within(x)}")


def p_value(p: float) -> str:
    return "below 0.001" if p < 1e-3 else f"{p:.2g}"


def by_verdict(found: Sequence[Answer], tell: Callable[[Answer], str]) -> dict[str, list[str]]:
    """The answers in words, by verdict."""
    kinds = ("smaller", "larger", "open")
    return {kind: [tell(x) for x in found if x.verdict == kind] for kind in kinds}
