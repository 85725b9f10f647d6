"""The results of a study in one SQLite file, which can be opened after a kill at any moment.

    study     configuration, hash and versions of the study; its only row
    runs      the row of results of each record, by the record's hash
    points    place in the study, varied values, and key of the run of each point

Runs and points are separate tables, since two points may share a run. Rows that are handed in together are one
transaction of SQLite's write-ahead log with synchronous = FULL: all of them are on the disk, or none.

Two rules keep results apart. Nothing is written into a file before it is known to be a results file of the
same study (the hash of its configuration) made with the same versions. And one process writes at a time:
SQLite turns the write-ahead log of a file on and off only for a process that has the file to itself, and a
process that writes has the log open until it ends.

A study with two points that have the same record (two cases whose values are the same, say) has two rows in
`points` and one in `runs`. Reading while another process writes is possible at any time.
"""

from __future__ import annotations

import os
import sqlite3
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from json import loads
from pathlib import Path
from typing import NamedTuple

from biped_adrc.campaign.chunk import CRASHED, NO_WALK, Ran, text_of
from biped_adrc.errors import InputError, OutputError
from biped_adrc.files import check_place
from biped_adrc.versions import differences

APPLICATION = 0x62614452
"""SQLite's application_id, by which a results file is told from other databases."""
FORMAT = 3
"""SQLite's user_version: the version of the schema below."""
SCHEMA = """
CREATE TABLE study (id INTEGER PRIMARY KEY CHECK (id = 1), name TEXT NOT NULL, hash TEXT NOT NULL,
  configuration TEXT NOT NULL, versions TEXT NOT NULL);
CREATE TABLE runs (key TEXT PRIMARY KEY, record TEXT NOT NULL, row TEXT NOT NULL, status TEXT,
  seconds REAL NOT NULL) WITHOUT ROWID;
CREATE TABLE points (position INTEGER PRIMARY KEY, key TEXT NOT NULL, at TEXT NOT NULL);
"""
"""The tables, as described above."""
LOCKED = 5.0
"""For how long another program that is writing is waited for [s]."""


class About(NamedTuple):
    """Which study a results file is of: name, hash, all of it in plain values, and versions.

    By the hash it is recognised; the versions are of all that decides the numbers.
    """

    name: str
    hash: str
    configuration: Mapping[str, object]
    versions: Mapping[str, str]


class Result(NamedTuple):
    """A finished point: its place, the key of its run, its varied values and its row."""

    position: int
    key: str
    at: dict[str, object]
    row: dict[str, object]


@dataclass(frozen=True)
class Store:
    """An open results file. Made by `open_store` to write or by `read_store` to read; a context manager.

    connection: without implicit transactions. writes: whether it is open to write.
    """

    path: Path
    connection: sqlite3.Connection
    about: About
    writes: bool = False

    def place(self, points: Iterable[tuple[int, str, str]]) -> None:
        """Keep place, key and varied values (JSON) of points; one that is there stays. Raises OutputError."""
        with self._writing() as db:
            db.executemany("INSERT OR IGNORE INTO points VALUES (?, ?, ?)", points)

    def add(self, runs: Iterable[Ran]) -> None:
        """Keep finished runs in one transaction, all of them or none. Raises OutputError.

        A run that crashed before is replaced.
        """
        with self._writing() as db:
            db.executemany("INSERT OR REPLACE INTO runs VALUES (?, ?, ?, ?, ?)", runs)

    def crashed(self, keys: Sequence[str]) -> dict[str, bool]:
        """Those of the keys that have a row; True where it says that the process died."""
        return {key: status == CRASHED for key, status in self._of("coalesce(status, '')", keys)}

    def rows(self, keys: Sequence[str]) -> dict[str, dict[str, object]]:
        """The rows of those of the keys that have one."""
        return {key: loads(row) for key, row in self._of("row", keys)}

    def _of(self, column: str, keys: Sequence[str]) -> Iterator[tuple[str, str]]:
        """One column of the runs with these keys, 500 at a time, since SQLite limits the parameters of a
        statement.
        """
        for begin in range(0, len(keys), 500):
            part = keys[begin : begin + 500]
            marks = ",".join("?" * len(part))
            text = f"SELECT key, {column} FROM runs WHERE key IN ({marks})"
            with self._reading():
                yield from self.connection.execute(text, tuple(part))

    def __len__(self) -> int:
        """Number of runs with a row."""
        with self._reading():
            return int(self.connection.execute("SELECT count(*) FROM runs").fetchone()[0])

    def statuses(self) -> dict[str, int]:
        """Number of runs by status."""
        text = "SELECT coalesce(status, ''), count(*) FROM runs GROUP BY 1 ORDER BY 1"
        with self._reading():
            return dict(self.connection.execute(text).fetchall())

    def no_walks(self) -> dict[str, str]:
        """For each status that is no walk, the explanation of one such run; the one with the smallest key.

        One is shown to the user: a thousand refused points of a study mostly have the same reason.
        """
        marks = ",".join("?" * len(NO_WALK))
        text = f"SELECT status, row, min(key) FROM runs WHERE status IN ({marks}) GROUP BY 1"
        with self._reading():
            found = self.connection.execute(text, NO_WALK)
            return {s: str(loads(row).get("detail") or "") for s, row, _ in found}

    def results(self) -> Iterator[Result]:
        """Points with a row, in the order of the study; read one after the other."""
        text = "SELECT position, key, at, row FROM points JOIN runs USING (key) ORDER BY position"
        with self._reading():
            for position, key, at, row in self.connection.execute(text):
                yield Result(position, key, loads(at), loads(row))

    def close(self) -> None:
        """Merge the write-ahead log, so that one file is left."""
        try:
            if self.writes:
                self.connection.execute("PRAGMA journal_mode = DELETE")
        except sqlite3.Error:
            pass  # somebody reads it: the log stays beside the file
        finally:
            self.connection.close()

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @contextmanager
    def _writing(self) -> Iterator[sqlite3.Connection]:
        """A transaction, undone on any error. Raises OutputError."""
        try:
            with self.connection as db:
                db.execute("BEGIN IMMEDIATE")
                yield db
        except (sqlite3.Error, UnicodeError) as error:
            raise cannot_write(self.path, error) from error

    @contextmanager
    def _reading(self) -> Iterator[None]:
        """Raises InputError, which calls the file damaged, for an error of SQLite or a text that is no JSON."""
        try:
            yield
        except (sqlite3.Error, ValueError, TypeError) as error:
            raise damaged(self.path, error) from error


def damaged(path: Path, reason: object) -> InputError:
    """The error for a results file that cannot be read."""
    return InputError(
        f"the results file '{path}' cannot be read: {reason}; it is damaged, take a copy of it or begin anew "
        "in another folder"
    )


def cannot_write(path: Path, error: Exception) -> OutputError:
    """The error for a results file that cannot be written."""
    if (getattr(error, "sqlite_errorcode", 0) & 0xFF) == sqlite3.SQLITE_BUSY:
        return OutputError(
            f"the results file '{path}' is in use by another process, such as a study that is running or a "
            "program that shows databases; wait for it or close it, and the same command goes on"
        )
    reason = getattr(error, "strerror", None) or error
    return OutputError(
        f"cannot write the results file '{path}': {reason}; what was finished before is kept. Make room, or "
        "choose a folder you may write to"
    )


def open_store(path: Path, about: About) -> Store:
    """Make the results file, or open it to go on.

    Raises InputError for a file that is not one of this study, or was made with other versions, and OutputError
    where another process uses it, or where the file or one that SQLite keeps beside it is a link to elsewhere.
    """
    for beside in ("", "-wal", "-shm", "-journal"):
        check_place(path.with_name(path.name + beside))
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with _opened(path, "rwc") as db:
            _begin(db, about)
            _check_study(path, _checked(path, db), about)
            for mode in ("DELETE", "WAL"):  # refused while another process writes
                db.execute(f"PRAGMA journal_mode = {mode}")
            db.execute("PRAGMA synchronous = FULL")
            return Store(path, db, about, writes=True)
    except (sqlite3.Error, OSError) as error:
        raise cannot_write(path, error) from error


def read_store(path: Path) -> Store:
    """Open a results file to read only; another process may write it at the same time.

    Raises InputError for a file that does not exist, is empty, or is not one of results.
    """
    if not os.path.isfile(path):
        raise InputError(f"there is no results file '{path}'; expected one of a sweep")
    try:
        with _opened(path, "rw" if os.access(path, os.W_OK) else "ro") as db:
            db.execute("PRAGMA query_only = ON")
            return Store(path, db, _checked(path, db))
    except sqlite3.Error as error:
        raise InputError(f"the results file '{path}' cannot be read: {error}") from error


@contextmanager
def _opened(path: Path, mode: str) -> Iterator[sqlite3.Connection]:
    """A connection without implicit transactions, which stays open unless an error is raised in the block.

    It waits for `LOCKED` where another process is writing. Raises InputError for what is no database.
    """
    uri = f"{path.absolute().as_uri()}?mode={mode}"
    db = sqlite3.connect(uri, uri=True, isolation_level=None, timeout=LOCKED)
    try:
        yield db
    except BaseException as error:
        db.close()
        if getattr(error, "sqlite_errorcode", 0) in (sqlite3.SQLITE_NOTADB, sqlite3.SQLITE_CORRUPT):
            raise InputError(
                f"'{path}' is no results file: {error}; it is left as it is, choose another folder"
            ) from error
        raise


def _checked(path: Path, db: sqlite3.Connection) -> About:
    """The study of a file that is whole. Raises InputError."""
    if db.execute("PRAGMA application_id").fetchone() != (APPLICATION,):
        raise InputError(
            f"'{path}' is no results file, but empty or a database of another program; it is left as it is, "
            "choose another folder"
        )
    (found,) = db.execute("PRAGMA user_version").fetchone()
    if found != FORMAT:
        raise InputError(
            f"results file '{path}' has the format {found}, expected {FORMAT}; it is left as it is, choose "
            "another folder"
        )
    (found,) = db.execute("PRAGMA quick_check(1)").fetchone()
    if found != "ok":
        raise damaged(path, found)
    text = "SELECT name, hash, configuration, versions FROM study"
    try:
        name, key, configuration, versions = db.execute(text).fetchone()
        return About(name, key, loads(configuration), loads(versions))
    except (TypeError, ValueError) as error:
        raise damaged(path, error) from error


def _begin(db: sqlite3.Connection, about: About) -> None:
    """Write the tables and the row of the study where nothing is there; a kill leaves all of it, or nothing."""
    with db:
        db.execute("BEGIN IMMEDIATE")
        (mark,) = db.execute("PRAGMA application_id").fetchone()
        if mark or db.execute("SELECT 1 FROM sqlite_master").fetchone():
            return
        for statement in SCHEMA.split(";")[:-1]:
            db.execute(statement)
        texts = text_of(about.configuration), text_of(about.versions)
        told = (1, about.name, about.hash, *texts)
        db.execute("INSERT INTO study VALUES (?, ?, ?, ?, ?)", told)
        db.execute(f"PRAGMA application_id = {APPLICATION}")
        db.execute(f"PRAGMA user_version = {FORMAT}")


def _check_study(path: Path, found: About, asked: About) -> None:
    """Raises InputError where the file is of another study, or made with other versions.

    Another version of NumPy may change the last digit, which a chaotic walk amplifies.
    """
    if found.hash != asked.hash:
        keys = sorted({*found.configuration, *asked.configuration})
        parts = [k for k in keys if found.configuration.get(k) != asked.configuration.get(k)]
        raise InputError(
            f"'{path}' holds the study '{found.name}' ({found.hash[:8]}), and the study asked for is "
            f"'{asked.name}' ({asked.hash[:8]}), other in {', '.join(parts) or 'its hash'}; it is left as it "
            "is, choose another folder"
        )
    if other := differences(found.versions, asked.versions):
        raise InputError(
            f"results file '{path}' was made with other versions, and numbers may differ: {other}; choose "
            "another folder"
        )
