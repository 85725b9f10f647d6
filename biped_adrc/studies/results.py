"""What a study found: its rows in one SQLite file, and the table of its cases under its conditions.

    study    one row: name, hash, the study and the versions of all that decides its numbers, as JSON
    walks    one row for each walk: its place in the study, a number; what locates it (`at`), the values of its
             scenario and its results, as JSON; its status; and a checksum of all of these

The file can be opened after a kill at any moment: rows that are handed in together are one transaction. Nothing
is written into a file before it is known to be of the same study and the same versions. A row that does not fit
its checksum is walked again; a file that SQLite finds damaged is refused.

A case is a named set of values that are compared, a condition one under which they are; a group is the walks of
one case under one condition. A measure is a column of the results whose median the table shows. Walks of two
cases under the same condition with the same values and the same seed are a pair. A walk that is not feasible
(ground and motors could not have carried it) counts as an infinite error. A search walks candidates, a case
with other values of some variables, on three sets of walks, "search", "choice" and "test"; on the last the
chosen one and the case as it was. Rows that are equal to the last bit count as one walk. Confidence
intervals are those of `analysis.statistics`. They exist only where the walks are a sample, by seeds or by
draws; the walks of a declared grid are no sample, so a number over them, or of one walk, has no interval.
"""

import hashlib
import json
import math
import sqlite3
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from functools import cached_property, partial
from pathlib import Path
from typing import Any, NamedTuple

from biped_adrc.analysis.statistics import Interval, Paired, median, paired, share
from biped_adrc.core.errors import InputError, OutputError
from biped_adrc.core.files import check_folder, check_place, write_csv
from biped_adrc.core.shown import Shown
from biped_adrc.core.versions import differences
from biped_adrc.scenario.dotted import flat
from biped_adrc.studies.build import NO_WALK, SEED
from biped_adrc.studies.measure import is_counted, is_made
from biped_adrc.studies.run import COLUMNS
from biped_adrc.studies.search import Candidate
from biped_adrc.studies.study import Point, Study

MARKS = {"application_id": 0x62614453, "user_version": 1}
"""Two numbers that SQLite keeps: the mark of a results file among databases, and the form of its tables."""
RESULTS = "results.sqlite"
"""Name of the file in the folder of a study."""
_MORE = "search.doublings"
"""A search goes on where this alone is another number, a larger one."""
_TABLES = [
    "CREATE TABLE study (name TEXT, hash TEXT, study TEXT, versions TEXT)",
    "CREATE TABLE walks (place INTEGER PRIMARY KEY, at TEXT, record TEXT, row TEXT, status TEXT, sum TEXT)",
]


class Result(NamedTuple):
    """A finished walk: what locates it in the study, and its row."""

    at: dict[str, Any]
    """Case, condition, of a search also set, candidate and setting, and the values that vary, by name."""
    row: dict[str, Any]
    """Its results by column of columns.toml; None for a number that does not exist."""


@dataclass(frozen=True)
class Store:
    """An open results file; `opened` makes it."""

    path: Path
    db: sqlite3.Connection
    """The connection to the file."""

    def add(self, walks: Iterable[tuple[Point, str, str | None]]) -> None:
        """Write finished walks into the file, each as (point, row as JSON, status), in one transaction.

        A walk that is there already is replaced. Raises OutputError.
        """
        # said: the row as JSON, and the status
        rows = [(p.place, json.dumps(p.at), json.dumps(p.record), *said) for p, *said in walks]
        with _errors(self.path), self.db:
            text = "INSERT OR REPLACE INTO walks VALUES (?, ?, ?, ?, ?, ?)"
            self.db.executemany(text, [(*row, checksum(row)) for row in rows])

    def mend(self) -> dict[int, bool]:
        """Delete the rows that do not fit their checksums; returns, for each place that had a row, whether that
        row fitted.

        Raises InputError for a file that SQLite finds damaged.
        """
        with _errors(self.path), self.db:
            (found,) = self.db.execute("PRAGMA quick_check(1)").fetchone()
            # `_errors` makes an InputError of it
            if found != "ok":
                raise ValueError(found)
            rows = self.db.execute("SELECT * FROM walks")
            # the last column, x, is the checksum of the others
            fits = {place: checksum((place, *row)) == x for place, *row, x in rows}
            wrong = [(place,) for place, fit in fits.items() if not fit]
            self.db.executemany("DELETE FROM walks WHERE place = ?", wrong)
        return fits

    def results(self, first: int = 0, count: int = 2**62) -> Iterator[Result]:
        """Yield the finished walks of the places first .. first + count - 1 (2**62: to the end), in their
        order, each read when it is asked for. Raises InputError for a row that does not fit its checksum.
        """
        text = "SELECT * FROM walks WHERE place >= ? AND place < ? ORDER BY place"
        with _errors(self.path):
            # the last column, x, is the checksum of the others
            for *row, x in self.db.execute(text, (first, first + count)):
                # `_errors` makes an InputError of it
                if checksum(row) != x:
                    raise ValueError(f"row {row[0]} does not fit its checksum")
                yield Result(json.loads(row[1]), json.loads(row[3]))


def checksum(row: Sequence[object]) -> str:
    """Checksum of a row of `walks`: the first 64 bits of SHA-256, in hexadecimal digits."""
    return hashlib.sha256(repr(tuple(row)).encode()).hexdigest()[:16]


@contextmanager
def opened(folder: Path, study: Study) -> Iterator[Store]:
    """Open the results file of a study in a folder, as a context; it is made where there is none.

    Raises OutputError, and InputError for a file of another study, of other versions, or of another kind.
    """
    check_folder(folder)
    path = folder / RESULTS
    check_place(path)
    versions = study.versions
    with _errors(path):
        folder.mkdir(parents=True, exist_ok=True)
        db = sqlite3.connect(path)
        # a damaged text is no error, and fits no checksum
        db.text_factory = partial(str, encoding="utf-8", errors="replace")
    with closing(db):
        with _errors(path):
            # _wrong: what is wrong with the file; into a new one it writes the tables and the study
            wrong = _wrong(db, study, versions)
        if wrong:
            raise InputError(f"'{path}' {wrong}; it is left as it is, choose another folder")
        yield Store(path, db)


def _wrong(db: sqlite3.Connection, study: Study, versions: dict[str, str]) -> str:
    """Write the tables and the study into an empty file, and the study over that of a search with fewer
    doublings; check those of any other file. Returns what is wrong with it, as the rest of a sentence that
    begins with its name; an empty text if nothing is.
    """
    # mark of results files, and form of their tables: 0 and 0 in a new file
    (mark,), (form,) = (db.execute(f"PRAGMA {x}").fetchone() for x in MARKS)
    tables = [text for (text,) in db.execute("SELECT sql FROM sqlite_master ORDER BY rowid")]
    if not mark and not tables:
        record = study.name, study.hash, study.model_dump_json(), json.dumps(versions)
        marks = (f"PRAGMA {name} = {x}" for name, x in MARKS.items())
        with db:
            db.executescript("; ".join(("BEGIN IMMEDIATE", *_TABLES, *marks)))
            db.execute("INSERT INTO study VALUES (?, ?, ?, ?)", record)
        return ""
    if mark != MARKS["application_id"]:
        return "is a database of another program"
    if form != MARKS["user_version"]:
        return f"has results of form {form}, expected form {MARKS['user_version']}"
    if tables != _TABLES:
        return f"has other tables than results have, or damaged ones: {tables}"
    key, old, before = db.execute("SELECT hash, study, versions FROM study").fetchone()
    text = study.model_dump_json()
    there, here = (flat(json.loads(x)) for x in (old, text))
    # empty where all are the same, and then so is the result
    other = differences(json.loads(before), versions)
    alike = not other and {**there, _MORE: here.get(_MORE)} == here
    more = alike and here.get(_MORE, 0) > there.get(_MORE, 0)
    if key != study.hash and not more:
        why = differences(there, here) or "its values are the same, and its hash is not theirs"
        return f"holds the rows of the study '{there['name']}', another one: {why}"
    if more:
        # its candidates are the first ones of this search, which chooses and tests anew
        with db:
            db.execute("DELETE FROM walks WHERE json_extract(at, '$.set') <> 'search'")
            db.execute("UPDATE study SET hash = ?, study = ?", (study.hash, text))
    return other and f"was made with other versions, and numbers may differ: {other}"


@contextmanager
def _errors(path: Path) -> Iterator[None]:
    """Context for work on the results file at `path`, whose errors become the package's.

    OutputError: the file cannot be written. InputError: it is damaged, or no results file.
    """
    try:
        yield
    except (sqlite3.Error, OSError, ValueError, TypeError, LookupError, AttributeError) as error:
        if isinstance(error, OSError | sqlite3.OperationalError):
            raise OutputError(
                f"cannot write '{path}': {error}; what was finished is kept, and the same command goes on"
            ) from error
        raise InputError(
            f"'{path}' is no results file, or is empty or damaged: {error}; choose another folder"
        ) from error


class Choice(NamedTuple):
    """The result of a search for one case: all candidates, and the best of them, walked again."""

    candidates: tuple[Candidate, ...]
    """All candidates by number, judged on the first set of walks ("search")."""
    selected: tuple[Candidate, ...]
    """The candidates walked on the second set ("choice"), as judged there, best first: the first was chosen."""
    stop: str = ""
    """What stopped the search, in words."""

    @property
    def values(self) -> dict[str, Any]:
        """The values of the chosen scenario, without condition and seed."""
        return self.selected[0].values


class Group(NamedTuple):
    """The walks of a case (`name`, in tables) under a condition, one row each."""

    name: str
    condition: str
    rows: tuple[Result, ...]


class TableLine(NamedTuple):
    """A line of the table: a case under a condition. Ends of intervals are NaN where walks are no sample."""

    name: str
    condition: str
    walks: int
    """Number of different walks: rows that are equal to the last bit count as one."""
    feasible: Interval
    """Share of these walks that count as feasible, in 0 .. 1."""
    made: int
    """How many of these walks were made to their last step, feasible or not."""
    median: Interval
    """Median of the study's measure over these walks, in the unit of its column."""
    ratio: Paired | None
    """Measure of this case over that of the first under this condition, walk by walk; None for the first."""


@dataclass(frozen=True)
class Results(Shown):
    """The results of a study, read from its file each time they are asked for."""

    study: Study
    folder: Path
    choices: Mapping[str, Choice] = field(default_factory=dict)
    """What the search found, by name of the case; empty without a search."""
    failures: tuple[str, ...] = ()
    """A sentence on each case of which no candidate keeps all limits; it is not walked on the test set."""

    def results(self) -> Iterator[Result]:
        """Finished walks in the order of the study."""
        with opened(self.folder, self.study) as store:
            yield from store.results()

    def rows(self) -> Iterator[dict[str, Any]]:
        """For each finished walk the values that vary and its results, by name.

        A value that varies and has the name of a column of results has "parameter." before its name.
        """
        for at, row in self.results():
            yield {f"parameter.{k}" if k in COLUMNS else k: x for k, x in at.items()} | row

    @cached_property
    def groups(self) -> list[Group]:
        """The walks by case and condition, those of a search on its test set; the first case comes first. Rows
        of what was no walk, as REFUSED, are left out.
        """
        results = dict[tuple[str, str], list[Result]]()
        for result in self.results():
            # walks of a study without a search have no set
            # NO_WALK: statuses of what was no walk
            if result.at.get("set", "test") == "test" and result.row["status"] not in NO_WALK:
                # _name: its case as tables show it
                where = _name(result.at), str(result.at.get("condition", ""))
                results.setdefault(where, []).append(result)
        return [Group(*where, tuple(rows)) for where, rows in results.items()]

    def _same(self, *walks: Result) -> str:
        """A text that is equal for walks (or pairs of walks) whose rows are equal to the last bit, so that they
        count once; walks at different levels of the grid (but for the seed as an axis) have different texts.
        """
        # x.at: the values that locate a walk; of these its levels of the grid
        cell = [name for name in self.study.grid if name != SEED]
        return repr([([x.at.get(name) for name in cell], x.row) for x in walks])

    def different(self, g: Group) -> list[Result]:
        """The walks of a group that differ: of those with equal levels of the grid and rows that are equal to
        the last bit (seeds that changed nothing) one is kept.
        """
        return list({self._same(x): x for x in g.rows}.values())

    def table(self) -> list[TableLine]:
        """A line for each group, that is for each case under each condition.

        The first group under a condition is that of the first case: it is the reference to which the ratios of
        all groups under this condition are taken, and has no ratio itself. Where the walks are no sample
        (`Study.drawn`) numbers stand without interval and p-value.
        """
        # first: condition -> its first group. paired: ratio of two lists of numbers, entry by entry, with an
        # interval and a p-value; share and median: with an interval; Interval(x): the number x alone
        first, lines = dict[str, Group](), []
        for g in self.groups:
            reference, rows = first.setdefault(g.condition, g), self.different(g)
            ratio = None if g is reference else paired(*self._pairs(g, reference))
            feasible, made = (sum(f(x.row) for x in rows) for f in (is_counted, is_made))
            numbers = [self.study.measure.number(x.row) for x in rows]
            counted, middle = share(feasible, len(rows)), median(numbers)
            if not self.study.drawn:
                counted, middle = Interval(counted.value), Interval(middle.value)
                ratio = ratio and Paired(Interval(ratio.ratio.value), float("nan"), ratio.pairs)
            lines.append(TableLine(g.name, g.condition, len(rows), counted, made, middle, ratio))
        return lines

    def _pairs(self, a: Group, b: Group) -> tuple[list[float], list[float]]:
        """Values of the study's measure of the walks of two groups, in its unit: entry i of both lists is one
        pair.

        A pair is a walk of a and a walk of b with the same condition, levels and seed; case, setting and
        candidate may differ. A walk in which nothing is drawn has no seed: it is a partner for the walk of each
        seed. A walk without a partner is left out, and so is a pair equal to the last bit to another one. A
        value is infinite, on the worse side of the measure, for a walk that ended early or, unless the measure
        takes all walks that were made, is infeasible.
        """
        # one, other: (levels, seed) -> walk
        number, one, other = self.study.measure.number, _by_place(a), _by_place(b)
        pairs: dict[str, tuple[float, float]] = {}
        for levels, seed in one | other:
            x, y = (z.get((levels, seed)) or z.get((levels, None)) for z in (one, other))
            if x and y:  # the key is a text that is equal for pairs that are equal to the last bit
                pairs[self._same(x, y)] = number(x.row), number(y.row)
        return [x for x, _ in pairs.values()], [y for _, y in pairs.values()]

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on what the table counts: walks without a seed, equal ones, too few for an interval."""
        # pairs (case, condition) whose walks have no seed, as nothing is drawn in them
        once = [(g.name, g.condition) for g in self.groups if all(SEED not in x.at for x in g.rows)]
        lines, many = self.table(), len(self.study.every_seed) > 1
        equal = sum(len(g.rows) for g in self.groups) - sum(x.walks for x in lines)
        # a sample of several walks, of which the median has no interval
        few = self.study.drawn and any(x.walks > 1 and math.isnan(x.median.low) for x in lines)
        # sentence -> whether it holds
        notes = {
            self.study.walked_once(once): once and many,
            f"{equal} walks are equal to the last bit to another one, and do not count again.": equal,
            "An interval of a median takes at least 6 walks.": few,
        }
        return tuple(note for note, holds in notes.items() if holds)

    def statuses(self) -> dict[str, tuple[int, str]]:
        """For each status, the most frequent first, the number of walks that ended so, and the column `detail`
        of the first of them.
        """
        details: dict[str, list[str]] = {}
        for _, row in self.results():
            details.setdefault(str(row["status"]), []).append(str(row.get("detail") or ""))
        return {s: (len(x), x[0]) for s, x in sorted(details.items(), key=lambda one: -len(one[1]))}

    def export(self, path: Path) -> None:
        """Write all rows as CSV, with a column for each name in any of them, empty where a row has no value.
        Raises InputError, OutputError.
        """
        rows = list(self.rows())
        names = dict.fromkeys(name for row in rows for name in row)
        write_csv({name: [row.get(name) for row in rows] for name in names}, path)


def _name(at: Mapping[str, Any]) -> str:
    """The name that tables show for a walk: its case, and after it "before" for the case as it was before a
    search; without cases "chosen" or "before".
    """
    case, setting = str(at.get("case", "")), str(at.get("setting", ""))
    return ", ".join(x for x in (case, "" if case and setting == "chosen" else setting) if x)


def _by_place(g: Group) -> dict[tuple[str, int | None], Result]:
    """Walks of a group by (levels, seed): the text of all that locates them but case, setting, candidate and
    seed; and the seed, None where nothing is drawn.
    """
    apart = ("case", "setting", "candidate", SEED)
    keys = (repr([(k, v) for k, v in x.at.items() if k not in apart]) for x in g.rows)
    return {(key, x.at.get(SEED)): x for key, x in zip(keys, g.rows, strict=True)}
