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
from contextlib import ExitStack, closing
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
CREATE TABLE versions (id INTEGER PRIMARY KEY, versions TEXT NOT NULL UNIQUE);
CREATE TABLE runs (key TEXT PRIMARY KEY, record TEXT NOT NULL, seed INTEGER, engine TEXT, status TEXT,
  row TEXT NOT NULL, seconds REAL NOT NULL, versions INTEGER NOT NULL REFERENCES versions) WITHOUT ROWID;
CREATE TABLE points (position INTEGER PRIMARY KEY, key TEXT NOT NULL, at TEXT NOT NULL);
"""
"""The tables, as described in `campaign.store`."""
LOCKED = 5.0
"""For how long another program that is writing is waited for [s]."""


def open_store(path: Path, about: About, other_versions: bool = False) -> Store:
    """Make the results file, or open it to go on.

    about: the study that is to be run. other_versions: go on though other versions made what is there; each run
    names its own. Raises InputError for a file that is not one of this study, and OutputError where another
    process uses it, also where the file or one that SQLite keeps beside it is a link to elsewhere.
    """
    for beside in ("", "-wal", "-shm", "-journal"):
        check_place(path.with_name(path.name + beside))
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with ExitStack() as undo:
            db = undo.enter_context(closing(_connected(path, "rwc")))
            _begin(path, db, about)
            _check_study(path, _checked(path, db), about, other_versions)
            for mode in ("DELETE", "WAL"):  # refused while another process writes
                db.execute(f"PRAGMA journal_mode = {mode}")
            db.execute("PRAGMA synchronous = FULL")
            undo.pop_all()  # it stays open
            return Store(path, db, about, writes=True)
    except (sqlite3.Error, UnicodeError, OSError) as error:
        raise cannot_write(path, error) from error


def read_store(path: Path) -> Store:
    """Open a results file to read only; another process may write it at the same time.

    Raises InputError for a file that does not exist, is empty, or is not one of results.
    """
    if not os.path.isfile(path):
        raise InputError(f"there is no results file '{path}'; expected one of a sweep")
    try:
        with ExitStack() as undo:
            mode = "rw" if os.access(path, os.W_OK) else "ro"
            connection = undo.enter_context(closing(_connected(path, mode)))
            connection.execute("PRAGMA query_only = ON")
            about = _checked(path, connection)
            undo.pop_all()  # it stays open
            return Store(path, connection, about)
    except (sqlite3.Error, UnicodeError) as error:
        raise InputError(f"the results file '{path}' cannot be read: {error}") from error


def _connected(path: Path, mode: str) -> sqlite3.Connection:
    """A connection without implicit transactions; waits for `LOCKED` where another process is writing."""
    uri = f"{path.absolute().as_uri()}?mode={mode}"
    return sqlite3.connect(uri, uri=True, isolation_level=None, timeout=LOCKED)


def _checked(path: Path, db: sqlite3.Connection) -> About:
    """The study of a file that is whole. Raises InputError."""
    if _of_program(path, db) != APPLICATION:
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
    return _about(path, db)


def _of_program(path: Path, db: sqlite3.Connection) -> int:
    """The number of the program that a database belongs to. Raises InputError for what is no database."""
    try:
        (found,) = db.execute("PRAGMA application_id").fetchone()
        return int(found)
    except sqlite3.OperationalError:
        raise
    except sqlite3.DatabaseError as error:
        raise InputError(
            f"'{path}' is no results file: {error}; it is left as it is, choose another folder"
        ) from error


def _begin(path: Path, db: sqlite3.Connection, about: About) -> None:
    """Write the tables and the row of the study where nothing is there; a kill leaves all of it, or nothing."""
    if _of_program(path, db) or db.execute("SELECT 1 FROM sqlite_master").fetchone():
        return
    created = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
    texts = text_of(about.configuration), text_of(about.versions)
    with db:
        db.execute("BEGIN IMMEDIATE")
        if db.execute("SELECT 1 FROM sqlite_master").fetchone():
            return  # another process was faster
        for statement in SCHEMA.split(";")[:-1]:
            db.execute(statement)
        told = (1, about.name, about.hash, *texts, about.points, created)
        db.execute("INSERT INTO study VALUES (?, ?, ?, ?, ?, ?, ?)", told)
        db.execute(f"PRAGMA application_id = {APPLICATION}")
        db.execute(f"PRAGMA user_version = {FORMAT}")


def _about(path: Path, db: sqlite3.Connection) -> About:
    """The study that a file is of. Raises InputError where that cannot be read."""
    text = "SELECT name, hash, configuration, versions, points FROM study"
    try:
        name, key, configuration, versions, points = db.execute(text).fetchone()
        return About(name, key, loads(configuration), loads(versions), points)
    except (sqlite3.Error, TypeError, ValueError) as error:
        raise damaged(path, error) from error


def _check_study(path: Path, found: About, asked: About, other_versions: bool) -> None:
    """Raises InputError where the file is of another study, or made with other versions.

    Another version of NumPy may change the last digit, which a chaotic walk amplifies; `other_versions` allows
    it.
    """
    if found.hash != asked.hash:
        raise InputError(
            f"'{path}' holds the study '{found.name}' ({found.hash[:8]}), and the study asked for is "
            f"'{asked.name}' ({asked.hash[:8]}){_difference(found, asked)}; it is left as it is, choose "
            "another folder"
        )
    other = differences(found.versions, asked.versions)
    if other and not other_versions:
        raise InputError(
            f"results file '{path}' was made with other versions, and numbers may differ: {other}. "
            "Use another folder, or allow other versions (--other-versions); each run names its own"
        )


def _difference(found: About, asked: About) -> str:
    """Which parts of the configuration differ, in words."""
    keys = sorted({*found.configuration, *asked.configuration})
    differ = [key for key in keys if found.configuration.get(key) != asked.configuration.get(key)]
    return f", other in {', '.join(differ)}" if differ else ""
