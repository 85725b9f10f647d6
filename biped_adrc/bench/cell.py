"""One cell of the comparison's table: the walks of one controller under one condition, and their statistics.

A walk makes all its steps, or it does not (it fell, or ended otherwise). If it does, it may be feasible
(`analysis.feasibility`), or feasible but for the impact, which is counted apart. All others are no success,
since the model's foot is pinned and walks where no real ground holds it.

A share is (value, low, high) with Wilson's interval, dimensionless: `survived`, `feasible` and `but_impact` of
all walks, `reasons` and `impulse` of those walks that made all steps and have a value in the column. Medians
have bootstrap intervals (`analysis.statistics`). Made by `bench.comparison`, read by the comparison's page.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from biped_adrc.analysis.statistics import Interval, median, share
from biped_adrc.campaign.chunk import Row
from biped_adrc.viz.comparison_text import MEASURES, NEEDS, REASONS

IMPULSE = "bad_impulse"
"""Column: 1 where |F_T| / F_N of the impulse at some impact is above the coefficient of friction, else 0."""


def is_made(row: Row) -> bool:
    """Whether the walk made all steps that were asked for."""
    return row["survived"] == 1


def is_feasible(row: Row) -> bool:
    """Whether the walk made all steps, each of them feasible."""
    return is_made(row) and row["feasible"] == 1


def is_counted(row: Row) -> bool:
    """Whether the walk is feasible, the impact at most aside, so that its numbers enter the statistics."""
    return is_feasible(row) or (is_made(row) and row.get("but_impact") == 1)


def number(row: Row, name: str) -> float | None:
    """The value of a column where it is a finite number, else None."""
    x = row.get(name)
    return float(x) if isinstance(x, float | int) and math.isfinite(x) else None


@dataclass(frozen=True)
class Cell:
    """The walks of one controller under one condition, a row per seed, at least one."""

    controller: str
    """Its name."""
    condition: str
    """Its name."""
    walks: tuple[Row, ...]
    """Rows with the columns of `bench.run.COLUMNS`, in the order of the seeds."""
    as_published: bool = False
    """Whether it walks untuned among controllers that are tuned."""

    @property
    def survived(self) -> Interval:
        """Share of all walks that make all steps, with its interval."""
        return share(sum(is_made(w) for w in self.walks), len(self.walks))

    @property
    def feasible(self) -> Interval:
        """Share of all walks that are feasible, with its interval."""
        return share(sum(is_feasible(w) for w in self.walks), len(self.walks))

    @property
    def but_impact(self) -> Interval:
        """Share of all walks that are feasible but for the impact, with its interval."""
        return share(sum(w.get("but_impact") == 1 for w in self.walks), len(self.walks))

    @property
    def falls(self) -> dict[str, int]:
        """How the other walks ended, which do not make all steps: number of walks by name of status."""
        ended = [str(w["status"]) for w in self.walks if not is_made(w)]
        return {status: ended.count(status) for status in sorted(set(ended))}

    @property
    def reasons(self) -> dict[str, Interval]:
        """Which limits were broken: for each column of `REASONS` the share among the walks that make all steps.

        One walk may break several.
        """
        return self._shares(REASONS)

    @property
    def impulse(self) -> Interval | None:
        """How often an impact needs more friction than there is: the share among the walks that make all steps.

        None where no such walk has a value in the column `IMPULSE`.
        """
        return self._shares({IMPULSE: ""}).get(IMPULSE)

    def _shares(self, names: Mapping[str, str]) -> dict[str, Interval]:
        """For each 0/1 column the share of ones, among the walks that make all steps and have a value there.

        names: columns, with headings that are not used. Columns without values are left out.
        """
        rows = [w for w in self.walks if is_made(w)]
        told = {name: [w[name] for w in rows if w.get(name) is not None] for name in names}
        return {name: share(x.count(1), len(x)) for name, x in told.items() if x}

    def medians(
        self, names: Mapping[str, str], which: Callable[[Row], bool] = is_counted
    ) -> dict[str, Interval | None]:
        """Medians of these columns over the walks for which `which` is true; None where none has a number."""
        rows = [w for w in self.walks if which(w)]
        return {name: median([number(w, name) for w in rows]) for name in names}

    def row(self) -> dict[str, object]:
        """All of it in plain values, as in summary.json; the measures at top level are medians over the walks
        that count.
        """
        return {
            "controller": self.controller,
            "condition": self.condition,
            "as_published": self.as_published,
            "walks": len(self.walks),
            "survived": list(self.survived),
            "feasible": list(self.feasible),
            "but_impact": list(self.but_impact),
            "falls": self.falls,
            "reasons": {name: list(x) for name, x in self.reasons.items()},
            "impulse": None if self.impulse is None else list(self.impulse),
            **_plain(self.medians(MEASURES)),
            "needs": _plain(self.medians(NEEDS, is_made)),
            "made": _plain(self.medians(MEASURES, is_made)),
        }


def _plain(found: Mapping[str, Interval | None]) -> dict[str, list[float] | None]:
    """Intervals as lists [value, low, high]."""
    return {name: None if x is None else list(x) for name, x in found.items()}
