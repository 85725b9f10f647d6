"""Intervals that draw searches and, inside, walks; and the six questions with Holm's correction.

    best of the searches = the one of least objective on the walks of choice
    error: median over walks of log(e_one / e_other), 0 where both walks are infeasible
    share: share of feasible walks of one less that of the other

A draw takes as many searches of each side as there are, with replacement, and the best of those; then as many
walks, the same for both sides. The interval holds the middle 95 % of the draws.
"""

from __future__ import annotations

import hashlib
import math
import tomllib
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.core.types import Array

HERE = Path(__file__).parent
QUESTIONS = HERE / "questions.toml"


class Side(NamedTuple):
    """The searches of one controller at one place, walked on the same test walks."""

    choice: Array
    """Objective on the walks of choice (searches,), less is better."""
    errors: Array
    """rms errors [rad] (searches, walks), infinite where a walk is not feasible."""

    @property
    def best(self) -> int:
        """The search that is chosen."""
        return int(np.argmin(self.choice))


class Answer(NamedTuple):
    """An estimate with its interval; a ratio of errors, or a difference of shares."""

    value: float
    low: float
    high: float
    p: float
    """Twice the share of draws on the other side of "no difference"; before Holm's correction."""


def text_hash() -> str:
    """The hash of the questions' text, 12 hexadecimal digits, which stands in every row of their walks."""
    return hashlib.sha256(QUESTIONS.read_bytes()).hexdigest()[:12]


def first_seed() -> int:
    """The first seed of the test walks: a number from the hash of the questions' text."""
    return 10_000 + int(text_hash()[:7], 16)


def questions() -> dict[str, Any]:
    """The tables of questions.toml."""
    return tomllib.loads(QUESTIONS.read_text())


def logs(one: Array, other: Array) -> Array:
    """log(e_one / e_other) (searches, searches, walks); 0 where both are infinite."""
    with np.errstate(invalid="ignore", divide="ignore"):
        x = np.log(one[:, None, :]) - np.log(other[None, :, :])
    return np.nan_to_num(x, nan=0.0, posinf=np.inf, neginf=-np.inf)


def compare(one: Side, other: Side, measure: str, draws: int, seed: int = 0) -> Answer:
    """Compare two sides by "error" or "share"."""
    random = np.random.default_rng(seed)
    middle: Any = np.median if measure == "error" else np.mean
    x = logs(one.errors, other.errors)
    if measure == "share":
        fine = np.isfinite(one.errors)[:, None, :], np.isfinite(other.errors)[None, :, :]
        x = fine[0].astype(float) - fine[1]
    value = float(middle(x[one.best, other.best]))
    picks = []
    for side in (one, other):
        drawn = random.integers(len(side.choice), size=(draws, len(side.choice)))
        picks.append(drawn[np.arange(draws), np.argmin(side.choice[drawn], axis=1)])
    walks = random.integers(x.shape[2], size=(draws, x.shape[2]))
    found = middle(np.take_along_axis(x[picks[0], picks[1]], walks, axis=1), axis=1)
    low, high = np.quantile(found, [0.025, 0.975], method="inverted_cdf")
    beyond = int(min(np.sum(found <= 0.0), np.sum(found >= 0.0))) + 1
    p = min(1.0, 2.0 * beyond / (draws + 1))
    as_said = math.exp if measure == "error" else float
    return Answer(as_said(value), as_said(low), as_said(high), p)


def holm(p: list[float]) -> list[float]:
    """Holm's corrected p-values, in the order of p."""
    order, result, most = np.argsort(p), [0.0] * len(p), 0.0
    for rank, i in enumerate(order):
        most = max(most, min(1.0, (len(p) - rank) * p[i]))
        result[i] = most
    return result


def alone(side: Side, measure: str, draws: int, seed: int = 0) -> Answer:
    """The median error [rad], or the share of feasible walks, of the best search of one side, without a p."""
    random = np.random.default_rng(seed)
    middle: Any = np.median if measure == "error" else np.mean
    x = side.errors if measure == "error" else np.isfinite(side.errors).astype(float)
    drawn = random.integers(len(side.choice), size=(draws, len(side.choice)))
    picks = drawn[np.arange(draws), np.argmin(side.choice[drawn], axis=1)]
    walks = random.integers(x.shape[1], size=(draws, x.shape[1]))
    found = middle(np.take_along_axis(x[picks], walks, axis=1), axis=1)
    low, high = np.quantile(found, [0.025, 0.975], method="inverted_cdf")
    return Answer(float(middle(x[side.best])), float(low), float(high), math.nan)
