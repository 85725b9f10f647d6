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
    Job,
    Point,
    Ran,
    key_of,
    ran,
    run_chunk,
    text_of,
)
from biped_adrc.campaign.store import Store
from biped_adrc.campaign.workers import Crew, WorkersError, held_back
from biped_adrc.errors import BipedError, InputError

LOOK_UP = 256
"""Points that are made and looked up in the store at once."""
LARGEST_CHUNK = 16
"""Most runs handed to a worker at once: what a kill may lose, and what progress is counted in."""
AHEAD = 3
"""Chunks on their way for each worker, so that none waits for this process."""
PATIENCE = 5.0
"""Time that runs get to end in an executor of the user's when a study is stopped [s]."""
MOST_CRASHED = 20
"""Records new to the store that kill their workers one after the other, and so end the study."""


class Progress(NamedTuple):
    """What is told while a study runs.

    done: points with a row, found in the store or run now. total: points of the study, None where unknown.
    fresh: runs made by this call. left: estimated time [s], None while unknown. note: what the user should hear
    of, such as a worker that died.
    """

    done: int
    total: int | None
    fresh: int
    left: float | None
    note: str = ""


class Summary(NamedTuple):
    """What a call did: points with a row at the end, runs made by this call, and workers that died."""

    points: int
    fresh: int
    deaths: int


def run_study(
    function: Function,
    points: Iterable[Point],
    store: Store,
    crew: Crew,
    *,
    chunk: int | None = None,
    total: int | None = None,
    progress: Callable[[Progress], None] | None = None,
    first: int = 0,
) -> Summary:
    """Run what the store does not have yet of the points; they may come from a generator.

    function: a row for each record of a list; workers have to be able to import it by name. chunk: runs handed
    out at once, chosen by `total` and the number of workers if None. total: number of points, for progress.
    first: the place in the study of the first of them. After Ctrl-C all that is finished is in the store.
    Raises InputError, OutputError, and WorkersError when the workers die.
    """
    if chunk is not None and chunk < 1:
        raise InputError(f"the study asks for chunks of {chunk} runs, expected at least 1")
    f = _Flight(function, store, crew, total, progress, first)
    count = crew.workers.count(crew.executor)
    size = chunk or _chunk_size(count, None if total is None else total - len(store))
    try:
        jobs = f.missing(iter(points))
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
    """The chunks on their way (`pending`) and the counters of one call of `run_study`.

    keys: of the runs on their way: a record that comes twice is not run twice. crashed: records without a row
    before that killed their workers, since the last finished chunk. begin: when the call began [s]. error: with
    which the last chunk was lost.
    """

    function: Function
    store: Store
    crew: Crew
    total: int | None
    progress: Callable[[Progress], None] | None
    first: int
    pending: dict[Future[list[Ran]], Sequence[Job]] = field(default_factory=dict)
    keys: set[str] = field(default_factory=set)
    done: int = 0
    fresh: int = 0
    deaths: int = 0
    crashed: int = 0
    begin: float = field(default_factory=time.monotonic)
    error: BaseException = field(default_factory=CancelledError)

    def missing(self, points: Iterator[Point]) -> Iterator[Job]:
        """The runs to be made, each once; where all points lie is stored on the way.

        Runs that crashed in an earlier call come last, so that they do not stop the others.
        """
        late: list[Job] = []
        places = itertools.count(self.first)
        while batch := list(itertools.islice(points, LOOK_UP)):
            jobs = [_job(p) for p in batch]
            told = zip(jobs, batch, strict=True)
            self.store.place((next(places), job.key, text_of(p.at)) for job, p in told)
            crashed = self.store.crashed([job.key for job in jobs])
            new = {j.key: j for j in jobs if crashed.get(j.key, True) and j.key not in self.keys}
            self.done += len(batch) - len(new)
            self.keys |= new.keys()
            self.tell()
            late += [job._replace(tried=True) for job in new.values() if job.key in crashed]
            yield from (job for job in new.values() if job.key not in crashed)
        yield from late

    def send(self, chunk: Sequence[Job]) -> None:
        """Hand a chunk to the executor; where that takes none, it is lost as if its worker had died."""
        try:
            with held_back():
                future = self.crew.executor.submit(run_chunk, self.function, chunk)
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
        ended, _ = wait(self.pending, return_when=FIRST_COMPLETED)
        lost: list[Job] = []
        for future in ended:
            error = CancelledError() if future.cancelled() else future.exception()
            if error is None:
                self.keep(future.result())
            else:
                lost += self.pending[future]
                self.error = error
            del self.pending[future]
        return lost

    def renew(self) -> None:
        """Count a worker that died, and start another executor where one is needed."""
        if not self.crew.workers.broken(self.error):
            return
        self.deaths += 1
        self.tell("a worker process died; what it was running is run again")
        if isinstance(self.error, BrokenExecutor):
            self.crew.close(now=True)

    def alone(self, job: Job) -> None:
        """Run a record with nothing else on its way; it is stored as CRASHED where its worker dies.

        Raises WorkersError for any other failure, and when one record after the other kills its worker.
        """
        self.send([job])
        while self.pending:
            if not self.finished():
                continue
            if not self.crew.workers.broken(self.error):
                raise WorkersError(
                    f"a run could not be handed to a worker or back: {self.error!r}. What was finished is "
                    "kept; look whether the workers are there and can import the function of the study by name"
                )
            self.renew()
            detail = "the worker process that ran it died, each time it was tried"
            self.keep([ran(job, {"status": CRASHED, "detail": detail}, 0.0)], died=not job.tried)
        if self.crashed >= MOST_CRASHED:
            raise WorkersError(
                f"{self.crashed} runs one after the other killed their worker processes, each alone; "
                "what they are is in the results file. Look for lack of memory, or for a fault in what they "
                "run; the study goes on with the others when it is started again"
            )

    def keep(self, runs: list[Ran], died: bool = False) -> None:
        """Store runs in one transaction, and count them; died: their worker died, which is news."""
        self.store.add(runs)
        self.crashed = self.crashed + 1 if died else 0
        self.done += len(runs)
        self.fresh += len(runs)
        self.keys -= {run.key for run in runs}
        self.tell()

    def abandon(self) -> None:
        """Stop the workers, and store what they had finished: on an error or Ctrl-C, which waits for that."""
        with held_back():
            self.crew.close(now=True)
            for future in self.pending:  # a pool has told each of the death of its workers by now
                future.cancel()
            wait([future for future in self.pending if not future.cancelled()], PATIENCE)
            for future in self.pending:
                if future.done() and not future.cancelled() and future.exception() is None:
                    with suppress(BipedError):
                        self.store.add(future.result())

    def tell(self, note: str = "") -> None:
        """Report progress; the time left is estimated from the runs of this call."""
        if self.progress is None:
            return
        seconds, left = time.monotonic() - self.begin, None
        if self.total is not None and self.fresh:
            left = seconds / self.fresh * max(self.total - self.done, 0)
        self.progress(Progress(self.done, self.total, self.fresh, left, note))


def _job(p: Point) -> Job:
    """The run of a point."""
    text = text_of(p.record)
    return Job(key_of(text), text, p.record)
