"""One controller under one condition: shares of walks, why the others do not count, medians.

A walk is in one of: fell or ended otherwise (by its status), made all steps, made all steps legally. What
counts is the last.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from biped_adrc.analysis.statistics import Interval, median, share
from biped_adrc.errors import InputError
from biped_adrc.viz.comparison_text import MEASURES, NEEDS, REASONS

Row = Mapping[str, Any]
"""Of a trial, by the names of `run.COLUMNS`."""
IMPULSE = "bad_impulse"
"""Judged in a column of its own: it does not make a walk illegal."""


def is_made(row: Row) -> bool:
    """Whether the walk made all steps."""
    return row["survived"] == 1


def is_legal(row: Row) -> bool:
    """Whether it made all steps legally. Raises InputError where that is not known."""
    if is_made(row) and row.get("legal") is None:
        raise InputError(
            "a walk made all steps and does not say whether legally (column 'legal'); expected 0 or 1. It was "
            "walked by an older version: begin anew in another folder"
        )
    return is_made(row) and row["legal"] == 1


def number(row: Row, name: str) -> float | None:
    """A finite number of the row, or None."""
    x = row.get(name)
    return float(x) if x is not None and math.isfinite(x) else None


@dataclass(frozen=True)
class Cell:
    """The walks of one controller under one condition, a row per seed, at least one."""

    controller: str
    condition: str
    walks: tuple[Row, ...]
    bandwidth: float | None = None
    """Of the observer's poles, all of them [rad/s]; None for the controller's own settings."""

    @property
    def survived(self) -> Interval:
        """Share of the walks that make all steps."""
        return share(sum(is_made(w) for w in self.walks), len(self.walks))

    @property
    def legal(self) -> Interval:
        """Share of the walks that make all steps legally."""
        return share(sum(is_legal(w) for w in self.walks), len(self.walks))

    @property
    def falls(self) -> dict[str, int]:
        """How the others ended: status and number."""
        ended = [str(w["status"]) for w in self.walks if not is_made(w)]
        return {status: ended.count(status) for status in sorted(set(ended))}

    @property
    def reasons(self) -> dict[str, Interval]:
        """Share of the walks that make all steps and are not legal for this reason."""
        return self._shares(REASONS)

    @property
    def impulse(self) -> Interval | None:
        """Share of the walks that make all steps in which an impact needs more friction than there is."""
        return self._shares({IMPULSE: ""}).get(IMPULSE)

    def _shares(self, names: Mapping[str, str]) -> dict[str, Interval]:
        rows = [w for w in self.walks if is_made(w)]
        told = {name: [w[name] for w in rows if w.get(name) is not None] for name in names}
        return {name: share(x.count(1), len(x)) for name, x in told.items() if x}

    def medians(
        self, names: Mapping[str, str], which: Callable[[Row], bool] = is_legal
    ) -> dict[str, Interval | None]:
        """Over the walks that are of this kind."""
        rows = [w for w in self.walks if which(w)]
        return {name: median([number(w, name) for w in rows]) for name in names}

    def row(self) -> dict[str, Any]:
        """As plain values; the measures are medians over legal walks."""
        return {
            "controller": self.controller,
            "condition": self.condition,
            "bandwidth": self.bandwidth,
            "walks": len(self.walks),
            "survived": list(self.survived),
            "legal": list(self.legal),
            "falls": self.falls,
            "reasons": {name: list(x) for name, x in self.reasons.items()},
            "impulse": None if self.impulse is None else list(self.impulse),
            **_plain(self.medians(MEASURES)),
            "needs": _plain(self.medians(NEEDS, is_made)),
            "made": _plain(self.medians(MEASURES, is_made)),
        }


def _plain(found: Mapping[str, Interval | None]) -> dict[str, list[float] | None]:
    return {name: None if x is None else list(x) for name, x in found.items()}
