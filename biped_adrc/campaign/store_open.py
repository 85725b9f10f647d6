"""Opening a results file: a new one, one of the same study to go on with, or any one to read.

Two rules keep results apart. Nothing is written into a file before it is known to be a results file of the same
study (the hash of its configuration) made with the same versions: otherwise rows of two programs would stand in
one table without a mark. And one process writes at a time: a lock file beside the results is held by the
operating system for as long as the process lives, so that a kill releases it and no stale lock stays.

Called by `bench.sweep` and `bench.compare_study`; what is read and written is in `campaign.store`.
"""

from __future__ import annotations

import os
import sqlite3
import time
from contextlib import ExitStack, closing
from json import loads
from pathlib import Path

from filelock import FileLock, Timeout

from biped_adrc.campaign.chunk import text_of
from biped_adrc.campaign.store import About, Store, cannot_write, damaged, identity_of
from biped_adrc.errors import InputError, OutputError
from biped_adrc.files import check_place, replacing
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
    """Make the results file, or open it to go on; locked until the store is closed.

    about: the study that is to be run. other_versions: go on though other versions made what is there; each run
    names its own. Raises InputError for a file that is not one of this study, or that another process writes,
    and OutputError, also where the file or one that SQLite keeps beside it is a link to elsewhere.
    """
    for beside in ("", ".lock", "-wal", "-shm", "-journal"):
        check_place(path.with_name(path.name + beside))
    try:
        with ExitStack() as undo:
            lock = _locked(path)
            undo.callback(lock.release)
            if not path.exists():
                _create(path, about)
            connection = undo.enter_context(closing(_connected(path, "rw")))
            _check_study(path, _checked(path, connection), about, other_versions)
            connection.execute("PRAGMA journal_mode = WAL")
            connection.execute("PRAGMA synchronous = FULL")
            undo.pop_all()  # it stays open
            return Store(path, connection, about, lock, identity_of(path))
    except (sqlite3.Error, UnicodeError, OSError) as error:
        if isinstance(error, OutputError):
            raise
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
    _check_format(path, db)
    (found,) = db.execute("PRAGMA quick_check(1)").fetchone()
    if found != "ok":
        raise damaged(path, found)
    return _about(path, db)


def _check_format(path: Path, db: sqlite3.Connection) -> None:
    """Raise InputError for a file in which nothing is, or something other than results of this format."""
    try:
        application = db.execute("PRAGMA application_id").fetchone()[0]
        tables = db.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
    except sqlite3.OperationalError:
        raise
    except sqlite3.DatabaseError as error:
        raise InputError(
            f"'{path}' is no results file: {error}; it is left as it is, choose another folder"
        ) from error
    if application == 0 and tables == 0:
        raise InputError(
            f"the results file '{path}' is empty: nothing was begun in it, or it was cut off. Remove it to "
            "begin anew, or bring back a copy"
        )
    if application != APPLICATION:
        raise InputError(
            f"'{path}' is a database of another program (application {application:#x}, expected "
            f"{APPLICATION:#x}); it is left as it is, choose another folder"
        )
    found: int = db.execute("PRAGMA user_version").fetchone()[0]
    if found != FORMAT:
        raise InputError(
            f"results file '{path}' has the format {found}, expected {FORMAT}; it is left as it is, choose "
            "another folder"
        )


def _create(path: Path, about: About) -> None:
    """Make the file with its tables and the row of the study: a kill leaves no file, or all of it.

    Raises InputError where the log of a file is there that is not.
    """
    if path.with_name(f"{path.name}-wal").exists():
        raise InputError(
            f"the results file '{path}' was removed, and the log of one, '{path.name}-wal', is still there; "
            "bring the file back, or remove the log to begin anew"
        )
    created = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
    texts = text_of(about.configuration), text_of(about.versions)
    told = (1, about.name, about.hash, *texts, about.points, created)
    with replacing(path) as temporary, closing(_connected(temporary, "rw")) as db:
        db.execute("BEGIN IMMEDIATE")
        db.execute(f"PRAGMA application_id = {APPLICATION}")
        for statement in SCHEMA.split(";")[:-1]:
            db.execute(statement)
        db.execute("INSERT INTO study VALUES (?, ?, ?, ?, ?, ?, ?)", told)
        db.execute(f"PRAGMA user_version = {FORMAT}")
        db.execute("COMMIT")


def _about(path: Path, db: sqlite3.Connection) -> About:
    """The study that a file is of. Raises InputError where that cannot be read."""
    text = "SELECT name, hash, configuration, versions, points FROM study"
    try:
        name, key, configuration, versions, points = db.execute(text).fetchone()
        return About(name, key, loads(configuration), loads(versions), points)
    except (sqlite3.Error, TypeError, ValueError, RecursionError) as error:
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


def _locked(path: Path) -> FileLock:
    """The lock beside the file. Raises InputError where another process has it, OutputError.

    The number of this process is written into it, so that the error of a second process can name the first.
    """
    beside = path.with_name(f"{path.name}.lock")
    lock = FileLock(beside, blocking=False, thread_local=False)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        lock.acquire()
        beside.write_text(f"{os.getpid()}\n", encoding="utf-8")
    except Timeout as error:
        found = beside.read_text(encoding="utf-8", errors="replace") if beside.is_file() else ""
        holder = found.strip()
        raise InputError(
            f"the results file '{path}' is being written by process {holder or 'of another'}; expected one "
            "study at a time. Wait for it, or choose another folder"
        ) from error
    except OSError as error:
        lock.release()
        raise cannot_write(path, error) from error
    return lock
