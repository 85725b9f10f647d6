"""A record of a study and where it lies, its key, and what a worker makes of it: a row ready to be stored."""

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
    """A record in plain values, and the values by which the study tells the point from others."""

    record: Record
    at: Record


def point(of: Record | Point) -> Point:
    """A point as it is; a plain record lies at its own values."""
    return of if isinstance(of, Point) else Point(of, of)


def text_of(values: Record) -> str:
    """As JSON, from which floats come back to the last bit; the same values give the same text."""
    return json.dumps(values, sort_keys=True)


def key_of(record: str) -> str:
    """A name for a run, from the text of its record."""
    return hashlib.sha256(record.encode()).hexdigest()[:32]


REFUSED, RAISED, CRASHED = "REFUSED", "RAISED", "CRASHED"
"""Status of a record whose values do not fit, of a run that raised, and of one whose process died, which is
tried again when the study goes on."""
NO_WALK = (REFUSED, RAISED, CRASHED)
"""What neither makes all steps nor falls."""

Function = Callable[[Sequence[Record]], Sequence[Row]]
"""A row of plain values for each record, in their order."""


class Made(NamedTuple):
    """The text of a row, and the time it took [s]: in a chunk as a whole its share."""

    row: str
    status: str | None
    engine: str | None
    seconds: float


def run_chunk(function: Function, records: Sequence[Record]) -> list[Made]:
    """A row of each record. Where the function raises, record by record, so that one spoils no other."""
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
    rows = function(records)
    if len(rows) != len(records):
        raise ValueError(f"the function gave {len(rows)} rows for {len(records)} records")
    return rows


def made(row: Row, seconds: float) -> Made:
    """Ready to be stored. Raises TypeError for a value that is not plain."""
    for name, x in row.items():
        if x is not None and not isinstance(x, (float, int, str)):
            raise TypeError(
                f"the row has {type(x).__name__} {x!r} in '{name}', expected a number or text"
            )
    status, engine = row.get("status"), row.get("engine")
    return Made(json.dumps(dict(row)), _text(status), _text(engine), seconds)


def _text(x: object) -> str | None:
    return None if x is None else str(x)
