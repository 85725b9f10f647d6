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
    """A run of a study: all values that make it, and those by which the study tells it from its others."""

    record: Record
    at: Record


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


class Job(NamedTuple):
    """A run to be made: the key of its row, its record as JSON and as values, and whether it crashed before."""

    key: str
    text: str
    record: Record
    tried: bool = False


class Ran(NamedTuple):
    """A finished run as it is stored: key, record and row as JSON, the row's status, and wall time [s].

    The time of a run is its share where a chunk was run as a whole.
    """

    key: str
    record: str
    row: str
    status: str | None
    seconds: float


def run_chunk(function: Function, jobs: Sequence[Job]) -> list[Ran]:
    """The runs of a chunk, in their order. Called in a worker process.

    Where the function raises on the chunk, it is called again with one record at a time, so that one bad record
    spoils no other; that record's row has the status RAISED and the error's text. A SystemExit counts as an
    error too: a library that calls exit() must not end the worker.
    """
    begin = time.perf_counter()
    try:
        rows = function([job.record for job in jobs])
        if len(rows) != len(jobs):
            raise ValueError(f"the function gave {len(rows)} rows for {len(jobs)} records")
        share = (time.perf_counter() - begin) / max(len(jobs), 1)
        return [ran(job, row, share) for job, row in zip(jobs, rows, strict=True)]
    except (Exception, SystemExit) as error:
        if len(jobs) > 1:
            return [one for job in jobs for one in run_chunk(function, [job])]
        row = {"status": RAISED, "detail": f"{type(error).__name__}: {error}"}
        return [ran(jobs[0], row, time.perf_counter() - begin)]


def ran(job: Job, row: Row, seconds: float) -> Ran:
    """The run as it is stored. Raises TypeError for a value of the row that is not a number, text or None."""
    for name, x in row.items():
        if x is not None and not isinstance(x, (float, int, str)):
            raise TypeError(
                f"the row has {type(x).__name__} {x!r} in '{name}', expected a number or text"
            )
    status = row.get("status")
    return Ran(
        job.key, job.text, json.dumps(dict(row)), None if status is None else str(status), seconds
    )
