"""A study carried out: records are handed out in chunks, and every finished chunk is stored at once.

The data flow: records -> look up in the store which are missing -> chunks -> workers -> rows -> store. Records
come from a generator and only a bounded number of chunks is on its way, so that neither a million records nor
their rows are in memory. A kill at any moment loses the chunks on their way and nothing else.

A worker may die (memory, a fault in compiled code) and take its chunk with it; a pool of processes then gives
up all chunks on their way, without saying which one was to blame. Their records are run again one by one, with
nothing beside them, and one that kills its worker again gets a row with the status CRASHED.

Rows depend on their records alone, not on the workers, their number, or the size of chunks. Knows no robots.
Called by `bench.sweep` and `bench.compare_study`.

What becomes of a chunk:

    finished              rows stored in one transaction
    the function raised   the worker has split it already (`campaign.chunk`): rows with the status RAISED
    the worker died       all that was on its way runs again, record by record: rows, or the status CRASHED
    Ctrl-C, an error      chunks that are finished are stored, the others are dropped; the same call goes on
"""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Future, wait
from contextlib import suppress
from dataclasses import dataclass, field
from typing import NamedTuple

from biped_adrc.campaign.chunk import (
    CRASHED,
    Function,
    Made,
    Point,
    Record,
    key_of,
    made,
    point,
    run_chunk,
    text_of,
)
from biped_adrc.campaign.store import Placed, Ran, Store
from biped_adrc.campaign.workers import Crew, WorkersError, held_back
from biped_adrc.errors import BipedError, InputError

LOOK_UP = 256
"""Points that are made and looked up in the store at once."""
LARGEST_CHUNK = 16
"""Most runs handed to a worker at once: what a kill may lose, and what progress is counted in."""
AHEAD = 3
"""Chunks on their way for each worker, so that none waits for this process."""
PATIENCE = 5.0
"""Time without a result [s] after which the workers are asked whether they are still there."""
MOST_CRASHED = 20
"""Records new to the store that kill their workers one after the other, and so end the study."""


class Progress(NamedTuple):
    """What is told while a study runs."""

    done: int
    """Points with a row, found in the store or run now."""
    total: int | None
    """Points of the study; None where unknown."""
    fresh: int
    """Runs made by this call."""
    left: float | None
    """Estimated time left [s]; None while unknown."""
    note: str = ""
    """What the user should hear of, such as a worker that died."""


class Summary(NamedTuple):
    """What a call did."""

    points: int
    """Points with a row at the end."""
    fresh: int
    """Runs made by this call."""
    deaths: int
    """Workers that died."""


class Job(NamedTuple):
    """A run to be made."""

    key: str
    """Of its row in the store."""
    text: str
    """Its record, JSON."""
    record: Record
    """Its record."""
    seed: int | None
    """Of the record, if it has one."""


def run_study(
    function: Function,
    records: Iterable[Record | Point],
    store: Store,
    crew: Crew,
    *,
    chunk: int | None = None,
    total: int | None = None,
    progress: Callable[[Progress], None] | None = None,
    first: int = 0,
) -> Summary:
    """Run what the store does not have yet of the records; they may come from a generator.

    function: a row for each record of a list; workers have to be able to import it by name. chunk: runs handed
    out at once, chosen by `total` and the number of workers if None. total: number of records, for progress.
    first: the place in the study of the first of them. After Ctrl-C all that is finished is in the store.
    Raises InputError, OutputError, and WorkersError when the workers die.
    """
    if chunk is not None and chunk < 1:
        raise InputError(f"the study asks for chunks of {chunk} runs, expected at least 1")
    f = _Flight(function, store, crew, total, progress, first)
    count = crew.workers.count(crew.executor)
    size = chunk or _chunk_size(count, None if total is None else total - len(store))
    try:
        jobs = f.missing(map(point, records))
        while part := tuple(itertools.islice(jobs, size)):
            f.send(part)
            while len(f.pending) >= AHEAD * count:
                f.collect()
        while f.pending:
            f.collect()
    except BaseException:
        f.abandon()
        raise
    return Summary(f.done, f.fresh, f.deaths)


def _chunk_size(workers: int, runs: int | None) -> int:
    """So small that every worker gets several chunks, and at most `LARGEST_CHUNK`."""
    return LARGEST_CHUNK if runs is None else max(1, min(LARGEST_CHUNK, runs // (4 * workers)))


@dataclass
class _Flight:
    """The chunks on their way and the counters of one call of `run_study`."""

    function: Function
    """What makes rows of records."""
    store: Store
    """Where rows are looked up and kept."""
    crew: Crew
    """Whose executor is in use."""
    total: int | None
    """Number of points of the study, for progress."""
    progress: Callable[[Progress], None] | None
    """Called after each change."""
    first: int = 0
    """Place in the study of the first point."""
    pending: dict[Future[list[Made]], Sequence[Job]] = field(default_factory=dict)
    """Chunks on their way."""
    keys: set[str] = field(default_factory=set)
    """Keys of the runs on their way: a record that comes twice is not run twice."""
    done: int = 0
    """Points with a row."""
    fresh: int = 0
    """Runs made by this call."""
    deaths: int = 0
    """Workers that died in this call."""
    crashed_in_a_row: int = 0
    """Records without a row before that killed their workers, since the last finished chunk."""
    known: set[str] = field(default_factory=set)
    """Keys on their way whose runs had crashed in an earlier call: their next crash is no news."""
    begin: float = field(default_factory=time.monotonic)
    """When the call began [s], for the time left."""
    error: BaseException | None = None
    """With which the last chunk was lost."""

    def missing(self, points: Iterator[Point]) -> Iterator[Job]:
        """The runs to be made, each once; where all points lie is stored on the way.

        Runs that crashed in an earlier call come last, so that they do not stop the others.
        """
        late: list[Job] = []
        places = itertools.count(self.first)
        while batch := list(itertools.islice(points, LOOK_UP)):
            jobs = [_job(p) for p in batch]
            told = zip(jobs, batch, strict=True)
            self.store.place(Placed(next(places), job.key, text_of(p.at)) for job, p in told)
            crashed = self.store.crashed([job.key for job in jobs])
            new = {j.key: j for j in jobs if crashed.get(j.key, True) and j.key not in self.keys}
            self.done += len(batch) - len(new)
            self.keys |= new.keys()
            self.tell()
            self.known |= crashed.keys() & new.keys()
            late += [job for job in new.values() if job.key in crashed]
            yield from (job for job in new.values() if job.key not in crashed)
        yield from late

    def send(self, chunk: Sequence[Job]) -> None:
        """Hand a chunk to the executor; where that takes none, it is lost as if its worker had died."""
        try:
            with held_back():
                records = [job.record for job in chunk]
                future = self.crew.executor.submit(run_chunk, self.function, records)
        except Exception as error:
            future = Future()
            future.set_exception(error)
        self.pending[future] = chunk

    def collect(self) -> None:
        """Store what is finished, waiting for it where nothing is; what is lost is run again, one by one."""
        lost = self.finished()
        while lost and self.pending:  # nothing may be beside them
            lost += self.finished()
        if lost:
            self.renew()
        for job in lost:
            self.alone(job)

    def finished(self) -> list[Job]:
        """Wait for finished chunks and store them; returns the runs of those that were lost."""
        ended, _ = wait(self.pending, PATIENCE, FIRST_COMPLETED)
        if not ended:
            self.crew.workers.check(self.crew.executor)
        lost: list[Job] = []
        for future in ended:
            error = CancelledError() if future.cancelled() else future.exception()
            if error is None:
                self.keep(self.pending[future], future.result())
            else:
                lost += self.pending[future]
                self.error = error
            del self.pending[future]
        return lost

    def renew(self) -> None:
        """Count a worker that died, and start another executor where one is needed."""
        if not self.crew.workers.broken(error := self.error or CancelledError()):
            return
        self.deaths += 1
        self.tell("a worker process died; what it was running is run again")
        if isinstance(error, BrokenExecutor):
            self.crew.close(now=True)

    def alone(self, job: Job) -> None:
        """Run a record with nothing else on its way; it is stored as CRASHED where its worker dies.

        Raises WorkersError for any other failure, and when one record after the other kills its worker.
        """
        self.send([job])
        while self.pending:
            if not self.finished():
                continue
            if not self.crew.workers.broken(error := self.error or CancelledError()):
                raise self.failed(error)
            self.renew()
            detail = "the worker process that ran it died, each time it was tried"
            self.keep([job], [made({"status": CRASHED, "detail": detail}, 0.0)], died=True)
            self.crashed_in_a_row += job.key not in self.known
        if self.crashed_in_a_row >= MOST_CRASHED:
            raise WorkersError(
                f"{self.crashed_in_a_row} runs one after the other killed their worker processes, each alone; "
                "what they are is in the results file. Look for lack of memory, or for a fault in what they "
                "run; the study goes on with the others when it is started again"
            )

    def keep(self, chunk: Sequence[Job], rows: list[Made], died: bool = False) -> None:
        """Store the rows of a chunk in one transaction, and count them; died: they say that the worker died."""
        self.store.add(map(_ran, chunk, rows))
        self.crashed_in_a_row = self.crashed_in_a_row if died else 0
        self.done += len(chunk)
        self.fresh += len(chunk)
        self.keys -= {job.key for job in chunk}
        self.tell()

    def abandon(self) -> None:
        """Stop the workers, and store what they had finished: on an error or Ctrl-C, which waits for that."""
        with held_back():
            for future in self.pending:
                future.cancel()
            self.crew.close(now=True)
            wait([future for future in self.pending if not future.cancelled()], PATIENCE)
            for future, chunk in self.pending.items():
                if future.done() and not future.cancelled() and future.exception() is None:
                    with suppress(BipedError):
                        self.store.add(map(_ran, chunk, future.result()))

    def failed(self, error: BaseException) -> WorkersError:
        """The error for a record that reached no worker, or whose row did not come back."""
        self.crew.workers.check(self.crew.executor)
        return WorkersError(
            f"a run could not be handed to a worker or back: {type(error).__name__}: {error}. What was "
            "finished is kept; the function of the study has to be one that workers can import by name"
        )

    def tell(self, note: str = "") -> None:
        """Report progress; the time left is estimated from the runs of this call."""
        if self.progress is None:
            return
        seconds, left = time.monotonic() - self.begin, None
        if self.total is not None and self.fresh:
            left = seconds / self.fresh * max(self.total - self.done, 0)
        self.progress(Progress(self.done, self.total, self.fresh, left, note))


def _job(p: Point) -> Job:
    """The run of a point. Its seed, if any, gets a column in the store."""
    text, seed = text_of(p.record), p.at.get("seed", p.record.get("seed"))
    return Job(key_of(text), text, p.record, seed if isinstance(seed, int) else None)


def _ran(job: Job, row: Made) -> Ran:
    """A run and its row as the store keeps them."""
    return Ran(job.key, job.text, row.row, row.status, row.engine, job.seed, row.seconds)
