"""Opening a results file: a new one, one of the same study to go on with, or any one to read.

Two rules keep results apart. Nothing is written into a file before it is known to be a results file of the same
study (the hash of its configuration) made with the same versions: otherwise rows of two programs would stand in
one table without a mark. And one process writes at a time: SQLite turns the write-ahead log of a file on and
off only for a process that has the file to itself, and a process that writes has the log open until it ends.

Called by `bench.sweep` and `bench.compare_study`; what is read and written is in `campaign.store`.
"""

from __future__ import annotations

import os
import sqlite3
import time
from collections.abc import Iterator
from contextlib import contextmanager
from json import loads
from pathlib import Path

from biped_adrc.campaign.chunk import text_of
from biped_adrc.campaign.store import About, Store, cannot_write, damaged
from biped_adrc.errors import InputError
from biped_adrc.files import check_place
from biped_adrc.versions import differences

APPLICATION = 0x62614452
"""SQLite's application_id, by which a results file is told from other databases."""
FORMAT = 3
"""SQLite's user_version: the version of the schema below."""
SCHEMA = """
CREATE TABLE study (id INTEGER PRIMARY KEY CHECK (id = 1), name TEXT NOT NULL, hash TEXT NOT NULL,
  configuration TEXT NOT NULL, versions TEXT NOT NULL, points INTEGER, created TEXT NOT NULL);
CREATE TABLE runs (key TEXT PRIMARY KEY, record TEXT NOT NULL, row TEXT NOT NULL, status TEXT,
  seconds REAL NOT NULL) WITHOUT ROWID;
CREATE TABLE points (position INTEGER PRIMARY KEY, key TEXT NOT NULL, at TEXT NOT NULL);
"""
"""The tables, as described in `campaign.store`."""
LOCKED = 5.0
"""For how long another program that is writing is waited for [s]."""


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
    text = "SELECT name, hash, configuration, versions, points FROM study"
    try:
        name, key, configuration, versions, points = db.execute(text).fetchone()
        return About(name, key, loads(configuration), loads(versions), points)
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
        created = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
        texts = text_of(about.configuration), text_of(about.versions)
        told = (1, about.name, about.hash, *texts, about.points, created)
        db.execute("INSERT INTO study VALUES (?, ?, ?, ?, ?, ?, ?)", told)
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
