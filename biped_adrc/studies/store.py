"""The rows of a study in one SQLite file, which can be opened after a kill at any moment.

    study    name, hash, the study and the versions of all that decides its numbers, as JSON; its only row
    walks    by place in the study: what locates the walk, the values of its scenario, its row, as JSON

Rows that are handed in together are one transaction. Nothing is written into a file before it is known to be of
the same study and the same versions.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from biped_adrc.core.errors import InputError, OutputError
from biped_adrc.core.files import check_folder, check_place
from biped_adrc.core.versions import differences
from biped_adrc.studies.study import Point, Study

APPLICATION = 0x62614453
"""SQLite's application_id, by which a results file is told from other databases."""
RESULTS = "results.sqlite"
"""Name of the file in the folder of a study."""
SCHEMA = """
CREATE TABLE study (name TEXT, hash TEXT, study TEXT, versions TEXT);
CREATE TABLE walks (place INTEGER PRIMARY KEY, at TEXT, record TEXT, row TEXT, status TEXT);
"""


class Result(NamedTuple):
    """A finished walk: what locates it in the study, and its row."""

    at: dict[str, Any]
    row: dict[str, Any]


@dataclass(frozen=True)
class Store:
    """An open results file; `opened` makes it."""

    path: Path
    db: sqlite3.Connection

    def add(self, walks: Iterable[tuple[Point, str, str | None]]) -> None:
        """Keep finished walks, each with its row as JSON and its status, in one transaction.

        Raises OutputError.
        """
        rows = [(p.place, json.dumps(p.at), json.dumps(p.record), *said) for p, *said in walks]
        with _errors(self.path), self.db:
            self.db.executemany("INSERT OR REPLACE INTO walks VALUES (?, ?, ?, ?, ?)", rows)

    def there(self, first: int, last: int) -> set[int]:
        """The places from `first` to `last` that have a row."""
        text = "SELECT place FROM walks WHERE place BETWEEN ? AND ?"
        with _errors(self.path):
            return {place for (place,) in self.db.execute(text, (first, last))}

    def results(self, first: int = 0, count: int = 2**62) -> Iterator[Result]:
        """Finished walks in the order of the study, read one after the other."""
        text = "SELECT at, row FROM walks WHERE place >= ? AND place < ? ORDER BY place"
        with _errors(self.path):
            for at, row in self.db.execute(text, (first, first + count)):
                yield Result(json.loads(at), json.loads(row))

    def statuses(self) -> dict[str, tuple[int, str]]:
        """By status how many walks ended so, and what the first of them says."""
        text = "SELECT status, count(*), row, min(place) FROM walks GROUP BY status ORDER BY 2 DESC"
        with _errors(self.path):
            result = self.db.execute(text).fetchall()
        return {str(s): (n, str(json.loads(row).get("detail") or "")) for s, n, row, _ in result}


@contextmanager
def opened(folder: Path, study: Study) -> Iterator[Store]:
    """The results file of a study in a folder, made where it is not there.

    Raises InputError for a file of another study, of other versions, or that is none of results, and
    OutputError.
    """
    check_folder(folder)
    path = folder / RESULTS
    check_place(path)
    versions = study.versions
    with _errors(path):
        folder.mkdir(parents=True, exist_ok=True)
        db = sqlite3.connect(path)
    try:
        with _errors(path):
            wrong = _wrong(db, study, versions)
        if wrong:
            raise InputError(f"'{path}' {wrong}; it is left as it is, choose another folder")
        yield Store(path, db)
    finally:
        db.close()


def _wrong(db: sqlite3.Connection, study: Study, versions: dict[str, str]) -> str:
    """Write the tables into an empty file; what is wrong with a file of something else, or empty."""
    (mark,) = db.execute("PRAGMA application_id").fetchone()
    if not mark and not db.execute("SELECT 1 FROM sqlite_master").fetchone():
        record = study.name, study.hash, study.model_dump_json(), json.dumps(versions)
        with db:
            db.execute("BEGIN IMMEDIATE")
            for statement in SCHEMA.split(";")[:-1]:
                db.execute(statement)
            db.execute("INSERT INTO study VALUES (?, ?, ?, ?)", record)
            db.execute(f"PRAGMA application_id = {APPLICATION}")
        return ""
    if mark != APPLICATION:
        return "is a database of another program"
    name, key, before = db.execute("SELECT name, hash, versions FROM study").fetchone()
    if key != study.hash:
        there, here = f"'{name}' ({key[:8]})", f"'{study.name}' ({study.hash[:8]})"
        return f"holds the rows of the study {there}, and the study is {here}"
    other = differences(json.loads(before), versions)
    return other and f"was made with other versions, and numbers may differ: {other}"


@contextmanager
def _errors(path: Path) -> Iterator[None]:
    """Raises OutputError where the results file cannot be written, and InputError where it is damaged."""
    try:
        yield
    except (sqlite3.Error, OSError, ValueError) as error:
        if isinstance(error, OSError | sqlite3.OperationalError):
            raise OutputError(
                f"cannot write the results file '{path}': {error}; what was finished is kept, and the same "
                "command goes on"
            ) from error
        raise InputError(
            f"'{path}' is no results file, or is empty or damaged: {error}; it is left as it is, choose "
            "another folder"
        ) from error
