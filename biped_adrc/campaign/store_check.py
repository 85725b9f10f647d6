"""Whether a results file is whole: pages, a checksum for each row, and the number of rows.

SQLite notices a page that makes no sense, but neither a changed letter inside of a text nor a row that is
gone. So each row carries a checksum over its other columns (`sum`), and the table `tally` says how many rows
there are, changed in the same transaction as they are. Checksums are made outside of SQLite: in a function that
SQLite calls, Ctrl-C would be lost and look like a damaged file.

Called by `campaign.store_open` for each file that is opened.
"""

from __future__ import annotations

import hashlib
import json
import sqlite3
from pathlib import Path

from biped_adrc.errors import InputError

COLUMNS = {
    "study": "id, name, hash, configuration, versions, points, created",
    "versions": "id, versions",
    "runs": "key, record, row, status, engine, seed, seconds, versions",
    "points": "position, key, at",
}
"""What the checksum of a row covers, by table."""
COUNTED = ("runs", "points")
"""Tables whose rows are counted."""


def damaged(path: Path, reason: object) -> InputError:
    """The error for a results file that cannot be read."""
    return InputError(
        f"the results file '{path}' cannot be read: {reason}; it is damaged, take a copy of it or begin anew "
        "in another folder"
    )


def checksum(*values: object) -> str:
    """The checksum of a row, of the texts and numbers of its columns; 16 hexadecimal digits."""
    return hashlib.blake2b(json.dumps(values, default=repr).encode(), digest_size=8).hexdigest()


def check_whole(path: Path, db: sqlite3.Connection) -> None:
    """Raise InputError for a results file with damaged pages, changed rows, or another number of rows.

    One transaction, as another process may write.
    """
    db.execute("BEGIN")
    try:
        (found,) = db.execute("PRAGMA quick_check(1)").fetchone()
        if found != "ok":
            raise damaged(path, found)
        _check_rows(path, db)
    finally:
        db.execute("ROLLBACK")


def _check_rows(path: Path, db: sqlite3.Connection) -> None:
    """The checksums of all rows, and their number. Raises InputError."""
    counts = ", ".join(f"(SELECT count(*) FROM {name}), {name}" for name in COUNTED)
    numbers = db.execute(f"SELECT {counts} FROM tally").fetchone()
    if numbers is None:
        raise damaged(path, "the number of its rows is missing")
    for name, here, noted in zip(COUNTED, numbers[::2], numbers[1::2], strict=True):
        if here != noted:
            raise damaged(path, f"it has {here} {name} of {noted}")
    for name, columns in COLUMNS.items():
        for found, *row in db.execute(f"SELECT sum, {columns} FROM {name}"):
            if found != checksum(*row):
                raise damaged(path, f"the row {row[0]} of '{name}' has another checksum")
