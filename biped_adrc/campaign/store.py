"""The results of a study in one SQLite file, which opens after a kill at any moment.

    study     configuration, hash and versions of the study; its only row
    versions  the versions that runs were made with
    runs      a row of results for each record, by the record's hash
    points    where the study's points lie, and which run each has

What is handed in together is one transaction of SQLite's write-ahead log: all of it is kept, or nothing. A lock
beside the file, which the system gives up with its process, keeps a second writer away.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from json import JSONDecodeError, loads
from pathlib import Path
from typing import NamedTuple

from filelock import FileLock

from biped_adrc.campaign.chunk import CRASHED, NO_WALK, text_of
from biped_adrc.campaign.workers import undisturbed
from biped_adrc.errors import InputError, OutputError


class About(NamedTuple):
    """Which study a file is of; points: how many there are in all, where that is known."""

    name: str
    hash: str
    configuration: Mapping[str, object]
    versions: Mapping[str, str]
    points: int | None = None


class Ran(NamedTuple):
    """A finished run: texts of record and row, and its wall time [s]."""

    key: str
    record: str
    row: str
    status: str | None
    engine: str | None
    seed: int | None
    seconds: float


class Placed(NamedTuple):
    """A point: its place in the study, the key of its run, and the text of where it lies."""

    position: int
    key: str
    at: str


class Result(NamedTuple):
    """A point and the row of its run."""

    position: int
    key: str
    at: dict[str, object]
    row: dict[str, object]


@dataclass(frozen=True)
class Store:
    """An open file of results, made by `open_store` or `read_store`; `about` has the versions of now."""

    path: Path
    connection: sqlite3.Connection
    about: About
    lock: FileLock | None = None

    def place(self, points: Iterable[Placed]) -> None:
        """Keep where points lie. Raises OutputError."""
        with self._writing() as db:
            db.executemany("INSERT OR IGNORE INTO points VALUES (?, ?, ?)", points)

    def add(self, runs: Iterable[Ran]) -> None:
        """Keep finished runs, all of them or none. Raises OutputError."""
        with self._writing() as db:
            versions = text_of(self.about.versions)
            db.execute("INSERT OR IGNORE INTO versions (versions) VALUES (?)", (versions,))
            found = db.execute("SELECT id FROM versions WHERE versions = ?", (versions,))
            (which,) = found.fetchone()
            db.executemany(
                "INSERT OR REPLACE INTO runs (key, record, row, status, engine, seed, seconds, versions) "
                "VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                ((*run, which) for run in runs),
            )

    def crashed(self, keys: Sequence[str]) -> dict[str, bool]:
        """Those of the keys that there are; true where the process died, the last time it was tried."""
        return {key: status == CRASHED for key, status in self._of("coalesce(status, '')", keys)}

    def rows(self, keys: Sequence[str]) -> dict[str, dict[str, object]]:
        """Rows of results by key, of those of the keys that are finished."""
        return {key: self._plain(key, row) for key, row in self._of("row", keys)}

    def _of(self, column: str, keys: Sequence[str]) -> Iterator[tuple[str, str]]:
        for begin in range(0, len(keys), 500):
            part = keys[begin : begin + 500]
            marks = ",".join("?" * len(part))
            text = f"SELECT key, {column} FROM runs WHERE key IN ({marks})"
            with self._reading():
                yield from self.connection.execute(text, tuple(part))

    def __len__(self) -> int:
        """Finished runs."""
        with self._reading():
            return int(self.connection.execute("SELECT count(*) FROM runs").fetchone()[0])

    def statuses(self) -> dict[str, int]:
        """How many runs ended with each status."""
        text = "SELECT coalesce(status, ''), count(*) FROM runs GROUP BY 1 ORDER BY 1"
        with self._reading():
            return dict(self.connection.execute(text).fetchall())

    def no_walks(self) -> dict[str, str]:
        """What one run says of each status that is no walk."""
        marks = ",".join("?" * len(NO_WALK))
        text = f"SELECT status, row, min(key) FROM runs WHERE status IN ({marks}) GROUP BY 1"
        with self._reading():
            found = self.connection.execute(text, NO_WALK).fetchall()
        return {s: str(self._plain(key, row).get("detail") or "") for s, row, key in found}

    def _plain(self, key: str, text: str) -> dict[str, object]:
        try:
            found = loads(text)
            if isinstance(found, dict):
                return found
            reason = f"found {found!r}"
        except JSONDecodeError as error:
            reason = str(error)
        raise damaged(self.path, f"the run {key} has no values, {reason}")

    def results(self) -> Iterator[Result]:
        """Points with finished runs, in the order of the study, a few at a time in memory."""
        text = "SELECT position, key, at, row FROM points JOIN runs USING (key) ORDER BY position"
        with self._reading():
            for position, key, at, row in self.connection.execute(text):
                yield Result(position, key, self._plain(key, at), self._plain(key, row))

    def close(self) -> None:
        """Leave one file behind, and let go of the lock; a second Ctrl-C does not come between."""
        with undisturbed():
            try:
                if self.lock is not None:
                    self.connection.execute("PRAGMA journal_mode = DELETE")
            except sqlite3.Error:
                pass  # somebody reads it: the log stays beside the file
            finally:
                self.connection.close()
                if self.lock is not None:
                    Path(self.lock.lock_file).unlink(missing_ok=True)
                    self.lock.release()

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @contextmanager
    def _writing(self) -> Iterator[sqlite3.Connection]:
        try:
            with self.connection as db:
                db.execute("BEGIN IMMEDIATE")
                yield db
        except sqlite3.Error as error:
            raise cannot_write(self.path, error) from error
        except OverflowError as error:
            raise InputError(
                f"a number of a run, such as its seed, is too large for the results file '{self.path}': {error}"
                "; expected at most 2^63 - 1"
            ) from error

    @contextmanager
    def _reading(self) -> Iterator[None]:
        try:
            yield
        except sqlite3.DatabaseError as error:
            raise damaged(self.path, error) from error


def damaged(path: Path, reason: object) -> InputError:
    """The error to raise for a file that cannot be read."""
    return InputError(
        f"the results file '{path}' cannot be read: {reason}; it is damaged, take a copy of it or begin anew "
        "in another folder"
    )


def cannot_write(path: Path, error: Exception) -> OutputError:
    """The error to raise."""
    reason = getattr(error, "strerror", None) or error
    return OutputError(
        f"cannot write the results file '{path}': {reason}; what was finished before is kept. Make room, or "
        "choose a folder you may write to"
    )
