"""What a study found: its rows, and the table of its cases under its conditions.

Walks of two cases under the same condition with the same values and the same seed are a pair. A walk that is
not feasible counts as an infinite error. Intervals are those of `analysis.statistics`, where walks were
drawn; over walks that were declared there is a count and no interval.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

from biped_adrc.analysis.statistics import Interval, Paired, median, paired, share
from biped_adrc.core.errors import optional
from biped_adrc.core.files import output_path, replacing
from biped_adrc.core.shown import Shown
from biped_adrc.studies.build import NO_WALK
from biped_adrc.studies.measure import is_counted, is_made
from biped_adrc.studies.run import COLUMNS
from biped_adrc.studies.search import Candidate
from biped_adrc.studies.store import Result, opened
from biped_adrc.studies.study import CASE, CONDITION, Study, measure_of

SET, CANDIDATE, SETTING = "set", "candidate", "setting"
"""Names under which the set of walks, the candidate and which of the two settings of a test stand."""
CHOSEN, BEFORE = "chosen", "before"
"""The settings that are walked on the test set: what the search chose, and the case as it was."""
TABLES = (".csv", ".parquet")
"""Suffixes of tables that can be written."""


class Choice(NamedTuple):
    """What a search found for a case."""

    candidates: tuple[Candidate, ...]
    """All of them by number, judged on the first set of walks."""
    selected: tuple[Candidate, ...]
    """Those of the second set, as judged there, best first: the first one was chosen."""

    @property
    def values(self) -> dict[str, Any]:
        """The values of the chosen scenario, without condition and seed."""
        return self.selected[0].values


class Group(NamedTuple):
    """The walks of a case under a condition."""

    name: str
    condition: str
    rows: tuple[Result, ...]
    numbers: tuple[float, ...]
    """Of each walk in the column that is shown; infinite where it does not count."""

    @property
    def feasible(self) -> int:
        """Walks that are feasible, the impact at most aside."""
        return sum(is_counted(x.row) for x in self.rows)

    @property
    def made(self) -> int:
        """Walks that make all steps."""
        return sum(is_made(x.row) for x in self.rows)


class Line(NamedTuple):
    """A line of the table; intervals are NaN where nothing was drawn."""

    name: str
    condition: str
    walks: int
    feasible: Interval
    made: int
    median: Interval
    ratio: Paired | None
    """To the first case, walk by walk; None of the first case itself."""


@dataclass(frozen=True)
class Results(Shown):
    """The results of a study, read from its file each time they are asked for."""

    study: Study
    folder: Path
    choices: Mapping[str, Choice] = field(default_factory=dict)
    """What the search found, by name of the case; empty without a search."""
    failures: tuple[str, ...] = ()
    """Of the cases of which no candidate keeps all limits, which are not tested."""

    def results(self) -> Iterator[Result]:
        """Finished walks in the order of the study."""
        with opened(self.folder, self.study) as store:
            yield from store.results()

    def rows(self) -> Iterator[dict[str, Any]]:
        """For each finished walk what varies, and its results.

        A field of the same name as a result has "parameter." before it.
        """
        for at, row in self.results():
            yield {f"parameter.{k}" if k in COLUMNS else k: x for k, x in at.items()} | row

    @cached_property
    def groups(self) -> list[Group]:
        """The walks by case and condition, those of a search on its test set; the first case comes first."""
        measure, results = measure_of(self.study), dict[tuple[str, str], list[Result]]()
        for result in self.results():
            if result.at.get(SET, "test") == "test" and result.row["status"] not in NO_WALK:
                where = _name(result.at), str(result.at.get(CONDITION, ""))
                results.setdefault(where, []).append(result)
        return [
            Group(*where, tuple(rows), tuple(measure.number(x.row) for x in rows))
            for where, rows in results.items()
        ]

    def table(self) -> list[Line]:
        """A line for each case and condition."""
        first, lines = dict[str, Group](), []
        for g in self.groups:
            reference = first.setdefault(g.condition, g)
            ratio = None if g is reference else paired(*_pairs(g, reference))
            counted, middle = share(g.feasible, len(g.rows)), median(g.numbers)
            if not self.study.drawn:
                counted, middle = _alone(counted), _alone(middle)
                ratio = ratio and Paired(_alone(ratio.ratio), float("nan"), ratio.pairs)
            lines.append(Line(g.name, g.condition, len(g.rows), counted, g.made, middle, ratio))
        return lines

    def statuses(self) -> dict[str, tuple[int, str]]:
        """By status how many walks ended so, and what the first of them says."""
        with opened(self.folder, self.study) as store:
            return store.statuses()

    def export(self, path: Path) -> None:
        """Write all rows as CSV or Parquet, by the suffix of `path`. Raises InputError, OutputError."""
        check_table(path)
        names = {name: None for row in self.rows() for name in row}
        if path.suffix.lower() == ".csv":
            with replacing(path) as made, open(made, "w", newline="", encoding="utf-8") as file:
                writer = csv.DictWriter(file, names)
                writer.writeheader()
                writer.writerows(self.rows())
            return
        import pyarrow
        from pyarrow import parquet

        rows = list(self.rows())
        columns = {name: [row.get(name) for row in rows] for name in names}
        for name, x in columns.items():
            if any(isinstance(one, str) for one in x):  # one type in a column
                columns[name] = [None if one is None else str(one) for one in x]
        with replacing(path) as made:
            parquet.write_table(pyarrow.table(columns), made)


def check_table(path: Path) -> None:
    """Raises InputError for a kind of table that cannot be written, or Parquet without pyarrow installed."""
    if output_path(path, TABLES).suffix.lower() == ".parquet":
        with optional("study", "Parquet needs pyarrow, which is not installed"):
            import pyarrow  # noqa: F401


def _name(at: Mapping[str, Any]) -> str:
    """What a table calls the walks of a case, and of a setting of it."""
    case, setting = str(at.get(CASE, "")), str(at.get(SETTING, ""))
    return ", ".join(x for x in (case, "" if case and setting == CHOSEN else setting) if x)


def _pairs(a: Group, b: Group) -> tuple[list[float], list[float]]:
    """The numbers of the walks that two groups have in common, told apart by what varies besides the case."""

    def by_place(g: Group) -> dict[str, float]:
        apart = (CASE, SETTING, CANDIDATE)
        keys = (repr([(k, v) for k, v in x.at.items() if k not in apart]) for x in g.rows)
        return dict(zip(keys, g.numbers, strict=True))

    one, other = by_place(a), by_place(b)
    both = [key for key in one if key in other]
    return [one[key] for key in both], [other[key] for key in both]


def _alone(x: Interval) -> Interval:
    """The number without an interval."""
    return Interval(x.value, float("nan"), float("nan"))
