"""The results of a study in one SQLite file, which can be opened after a kill at any moment.

    study     configuration, hash and versions of the study; its only row
    runs      the row of results of each record, by the record's hash
    points    place in the study, varied values, and key of the run of each point

Runs and points are separate tables, since two points may share a run. Rows that are handed in together are one
transaction of SQLite's write-ahead log with synchronous = FULL: all of them are on the disk, or none.

`campaign.store_open` opens files, `campaign.execute` writes them, `bench.sweep` reads them.

A study with two points that have the same record (two cases whose values are the same, say) has two rows in
`points` and one in `runs`. Reading while another process writes is possible at any time.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from json import loads
from pathlib import Path
from typing import NamedTuple

from biped_adrc.campaign.chunk import CRASHED, NO_WALK, Ran
from biped_adrc.errors import InputError, OutputError


class About(NamedTuple):
    """Which study a results file is of: name, hash, all of it in plain values, versions, number of points.

    By the hash it is recognised; the versions are of all that decides the numbers; the number is None where
    unknown.
    """

    name: str
    hash: str
    configuration: Mapping[str, object]
    versions: Mapping[str, str]
    points: int | None = None


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
