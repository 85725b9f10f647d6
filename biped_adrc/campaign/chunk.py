"""The unit of work of a campaign: records in, rows out, and how both are written as text.

A campaign carries out many independent runs and knows nothing of robots. A run is given by its *record*, plain
values by name; its *row* is what came out of it, plain values again. The JSON text of a record, with sorted
keys, identifies the run: its hash is the key under which the store keeps the row, so that a run which two
studies or two calls have in common is made once. JSON writes a float such that it reads back to the same bits.

`run_chunk` is what a worker executes. `campaign.execute` hands out chunks and `campaign.store` keeps the rows.

An example, with the function `run_trials` of `bench.run`:

    record   {"controller": "NPD", "hardware": "ideal", "seed": 3}
    row      {"status": "COMPLETED", "survived": 1, "peak_error": 0.0113, ...}
"""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

Record = Mapping[str, object]
"""Values of one run by name, plain as JSON has them: what a worker is handed."""
Row = Mapping[str, object]
"""Results of one run by name, numbers, text or None: what a worker hands back."""


class Point(NamedTuple):
    """A run of a study and where it lies in it."""

    record: Record
    """All values that make the run."""
    at: Record
    """The values by which the study tells the point from its others: what is varied."""


def point(of: Record | Point) -> Point:
    """A `Point` as it is; for a plain record all of its values tell it from others."""
    return of if isinstance(of, Point) else Point(of, of)


def text_of(values: Record) -> str:
    """The values as JSON with sorted keys: equal values give equal texts, floats read back to the same bits."""
    return json.dumps(values, sort_keys=True)


def key_of(record: str) -> str:
    """The key of a run: 32 hexadecimal digits of the SHA-256 of its record's text."""
    return hashlib.sha256(record.encode()).hexdigest()[:32]


REFUSED, RAISED, CRASHED = "REFUSED", "RAISED", "CRASHED"
"""Statuses that are no result of a run. REFUSED: the values do not fit together. RAISED: the function raised.
CRASHED: the worker process died; such a run is tried again when the study goes on.
"""
NO_WALK = (REFUSED, RAISED, CRASHED)
"""Statuses of rows that count neither as a success nor as a fall."""

Function = Callable[[Sequence[Record]], Sequence[Row]]
"""What workers run: a row of plain values for each record, in their order."""


class Made(NamedTuple):
    """A row ready to be stored."""

    row: str
    """Its text, JSON."""
    status: str | None
    """Its status, if it has one: a column of its own in the store."""
    engine: str | None
    """What ran, if the row says so."""
    seconds: float
    """Wall time of the run [s]; of a chunk that was run as a whole, its share."""


def run_chunk(function: Function, records: Sequence[Record]) -> list[Made]:
    """A row of each record, in their order. Runs in a worker process.

    Where the function raises on the chunk, it is called again with one record at a time, so that one bad record
    spoils no other; that record's row has the status RAISED and the error's text. A SystemExit counts as an
    error too: a library that calls exit() must not end the worker.
    """
    begin = time.perf_counter()
    try:
        rows = _rows(function, records)
        share = (time.perf_counter() - begin) / max(len(records), 1)
        return [made(row, share) for row in rows]
    except (Exception, SystemExit) as error:
        if len(records) > 1:
            return [one for record in records for one in run_chunk(function, [record])]
        detail = f"{type(error).__name__}: {error}"
        return [made({"status": RAISED, "detail": detail}, time.perf_counter() - begin)]


def _rows(function: Function, records: Sequence[Record]) -> Sequence[Row]:
    """What the function gives. Raises ValueError for another number of rows than records."""
    rows = function(records)
    if len(rows) != len(records):
        raise ValueError(f"the function gave {len(rows)} rows for {len(records)} records")
    return rows


def made(row: Row, seconds: float) -> Made:
    """The row, checked and as text. Raises TypeError for a value that is not a number, text or None."""
    for name, x in row.items():
        if x is not None and not isinstance(x, (float, int, str)):
            raise TypeError(
                f"the row has {type(x).__name__} {x!r} in '{name}', expected a number or text"
            )
    status, engine = row.get("status"), row.get("engine")
    return Made(json.dumps(dict(row)), _text(status), _text(engine), seconds)


def _text(x: object) -> str | None:
    return None if x is None else str(x)
