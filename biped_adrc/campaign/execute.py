"""A study carried out: in chunks, a bounded number of them at once, each stored when it is finished.

What is in the store is not run again. When a worker dies, what was on its way is run again, each chunk alone;
where that kills a worker too, record by record, and the record that does it has a row that says so. Rows do not
depend on workers, their number, or the size of chunks.
"""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, CancelledError, Executor, Future, wait
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
from biped_adrc.campaign.workers import (
    Workers,
    WorkersError,
    held_back,
    undisturbed,
    workers_of,
)
from biped_adrc.errors import BipedError, InputError

LOOK_UP = 256
"""Points that are made and looked up at once."""
LARGEST_CHUNK = 16
AHEAD = 3
"""Chunks on their way for each worker."""
PATIENCE = 5.0
"""[s] without a result, after which the workers are asked whether they are still there."""
MOST_DEATHS = 6
"""Workers that die one after the other, without a run between them or a record to blame, after which the
study ends."""
MOST_CRASHED = 20
"""New records one after the other that kill their workers, after which the study ends."""


class Progress(NamedTuple):
    """Points done, in all, and run just now; time left [s]. What is not known is None."""

    done: int
    total: int | None
    fresh: int
    left: float | None
    note: str = ""
    """What the user should hear of, such as a worker that died."""


class Summary(NamedTuple):
    """Points of the study, runs made now, and workers that died."""

    points: int
    fresh: int
    deaths: int


class Job(NamedTuple):
    """A run to be made."""

    key: str
    text: str
    record: Record
    seed: int | None


Chunk = tuple[Job, ...]


def run_study(
    function: Function,
    records: Iterable[Record | Point],
    store: Store,
    workers: Workers | Executor | int | None = None,
    *,
    chunk: int | None = None,
    total: int | None = None,
    progress: Callable[[Progress], None] | None = None,
    first: int = 0,
) -> Summary:
    """Run what the store does not have yet of the records, a generator perhaps.

    first: the place in the study of the first of them.
    function: a row for each record of a list; it and its module can be found by name where the workers are.
    chunk: runs that are handed out at once, by `total` and the number of workers if None. Ctrl-C ends it, with
    all that is finished in the store. Raises InputError, OutputError, and WorkersError when the workers die.
    """
    if chunk is not None and chunk < 1:
        raise InputError(f"the study asks for chunks of {chunk} runs, expected at least 1")
    crew = workers_of(workers)
    f = _Flight(function, store, crew, crew.start(), total, progress, first)
    count = crew.count(f.executor)
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
        with undisturbed():  # Ctrl-C once more
            f.abandon()
        raise
    crew.stop(f.executor, False)
    return Summary(f.done, f.fresh, f.deaths)


def _chunk_size(workers: int, runs: int | None) -> int:
    """So that every worker has several."""
    return LARGEST_CHUNK if runs is None else max(1, min(LARGEST_CHUNK, runs // (4 * workers)))


@dataclass
class _Flight:
    """What is on its way, and what has come of it."""

    function: Function
    store: Store
    crew: Workers
    executor: Executor
    total: int | None
    progress: Callable[[Progress], None] | None
    first: int = 0
    pending: dict[Future[list[Made]], tuple[Chunk, Executor]] = field(default_factory=dict)
    keys: set[str] = field(default_factory=set)
    done: int = 0
    fresh: int = 0
    deaths: int = 0
    in_a_row: int = 0
    crashed_in_a_row: int = 0
    known: set[str] = field(default_factory=set)
    """Keys on their way that had killed their workers before."""
    begin: float = field(default_factory=time.monotonic)

    def missing(self, points: Iterator[Point]) -> Iterator[Job]:
        """The runs that have to be made, each once, those that killed their workers before at the end.

        Where the points lie is stored on the way.
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

    def send(self, chunk: Chunk) -> None:
        records = [job.record for job in chunk]
        try:
            with held_back():
                future = self.executor.submit(run_chunk, self.function, records)
        except BaseException as error:
            if not self.crew.broken(error):
                raise
            future = Future()
            future.set_exception(error)
        self.pending[future] = chunk, self.executor

    def collect(self) -> None:
        """Store what is finished; wait for it where nothing is."""
        suspects = self.died()
        while suspects and self.pending:  # they would be suspects too
            suspects += self.died()
        for chunk in suspects:
            self.alone(chunk)

    def died(self) -> list[Chunk]:
        """Wait for chunks and store them; those of them whose worker died."""
        finished, _ = wait(self.pending, PATIENCE, FIRST_COMPLETED)
        if not finished:
            self.crew.check(self.executor)
        return [chunk for future in finished if (chunk := self.take(future)) is not None]

    def take(self, future: Future[list[Made]]) -> Chunk | None:
        """Store what has come; the chunk itself where its worker died."""
        chunk, executor = self.pending[future]
        try:
            rows = future.result()
        except (Exception, CancelledError) as error:
            if not self.crew.broken(error):
                raise self.named(error) from error
            del self.pending[future]
            if executor is self.executor:
                self.restart(error)
            return chunk
        self.keep(chunk, rows)
        del self.pending[future]
        return None

    def alone(self, chunk: Chunk) -> None:
        """Run a chunk again with nothing beside it, so that it is known who kills a worker."""
        self.send(chunk)
        died: list[Chunk] = []
        while self.pending:
            died += self.died()
        if not died:
            return
        if len(chunk) > 1:
            for job in chunk:
                self.alone((job,))
        else:
            detail = "the worker process that ran it died, each time it was tried"
            self.keep(chunk, [made({"status": CRASHED, "detail": detail}, 0.0)], died=True)
            self.blame(chunk[0])

    def blame(self, job: Job) -> None:
        """Count a record that killed its worker. Raises WorkersError when all of them seem to."""
        self.crashed_in_a_row += job.key not in self.known
        if self.crashed_in_a_row >= MOST_CRASHED:
            raise WorkersError(
                f"{self.crashed_in_a_row} runs one after the other killed their worker processes, each alone; "
                "what they are is in the results file. Look for lack of memory, or for a fault in what they "
                "run; the study goes on with the others when it is started again"
            )

    def restart(self, error: BaseException) -> None:
        self.deaths += 1
        self.in_a_row += 1
        if self.in_a_row >= MOST_DEATHS:
            raise WorkersError(
                f"{self.in_a_row} worker processes died one after the other, without a run between them "
                f"({error}); look for lack of memory, or for a fault in what they import"
            ) from error
        self.executor = self.crew.restart(self.executor)
        self.tell("a worker process died; what it was running is run again")

    def keep(self, chunk: Chunk, rows: list[Made], died: bool = False) -> None:
        self.store.add(map(_ran, chunk, rows))
        self.in_a_row = 0
        self.crashed_in_a_row = self.crashed_in_a_row if died else 0
        self.done += len(chunk)
        self.fresh += len(chunk)
        self.keys -= {job.key for job in chunk}
        self.tell()

    def abandon(self) -> None:
        """End the workers, and store what they had finished."""
        for future in self.pending:
            future.cancel()
        self.crew.stop(self.executor, True)
        wait([future for future in self.pending if not future.cancelled()], PATIENCE)
        for future, (chunk, _) in self.pending.items():
            if future.done() and not future.cancelled() and future.exception() is None:
                with suppress(BipedError):
                    self.store.add(map(_ran, chunk, future.result()))

    def named(self, error: BaseException) -> BaseException:
        """An error of what is between this process and its workers."""
        self.crew.check(self.executor)
        if isinstance(error, BipedError):
            return error
        return WorkersError(
            f"a chunk of runs could not be handed to a worker or back: {type(error).__name__}: {error}. What "
            "was finished is kept; the function of the study has to be one that workers can import by name"
        )

    def tell(self, note: str = "") -> None:
        if self.progress is None:
            return
        seconds, left = time.monotonic() - self.begin, None
        if self.total is not None and self.fresh:
            left = seconds / self.fresh * max(self.total - self.done, 0)
        self.progress(Progress(self.done, self.total, self.fresh, left, note))


def _job(p: Point) -> Job:
    text, seed = text_of(p.record), p.at.get("seed", p.record.get("seed"))
    return Job(key_of(text), text, p.record, seed if isinstance(seed, int) else None)


def _ran(job: Job, row: Made) -> Ran:
    return Ran(job.key, job.text, row.row, row.status, row.engine, job.seed, row.seconds)
