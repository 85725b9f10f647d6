"""Carry out walks: chunks of points go to an executor, and every finished chunk is stored at once.

A point is one walk that is to be made: its place in the study (a number from 0), the names that locate it
(`at`), and its record. A record is the values of a walk's scenario by name, a row its results. A chunk is some
points that one worker, a process, walks together. An executor is one of `concurrent.futures`; a future stands
for a chunk that it has and for the rows to come.

A kill at any moment loses the chunks on their way and nothing else; the same command walks them again. A worker
that dies takes its chunk with it, and a pool all chunks on their way: their walks are then made one by one, and
one that kills its worker again has a row with the status CRASHED. Rows depend on their records alone, not on
workers, their number, or the size of chunks.
"""

import itertools
import json
import math
import os
from collections.abc import Callable, Container, Iterable, Iterator, Sequence
from concurrent import futures
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Self

from biped_adrc.core.errors import SimulationError
from biped_adrc.core.processes import NO_GUARD, cores, end_all, processes
from biped_adrc.core.registry import FOLDERS
from biped_adrc.studies.build import CRASHED
from biped_adrc.studies.results import Store
from biped_adrc.studies.run import Function, rows_of
from biped_adrc.studies.study import Point

_PRELOADED = ("biped_adrc.studies.run",)
"""Modules that are imported once, before worker processes are forked: all that these need."""
LARGEST_CHUNK = 32
"""Most walks handed to a worker at once: what a kill may lose, and what progress is counted in."""
_AHEAD = 3
"""Chunks on their way for each worker, so that none waits for this process."""
MOST_CRASHED = 20
"""A study ends once so many walks have killed their workers with no finished chunk in between."""


class WorkersError(SimulationError):
    """Workers, or the connection to them, are gone; no walk is to blame (exit code 3)."""

    exit_code = 3


class StudyProgress(NamedTuple):
    """How far a study is: the number of walks done, the number in all, and a note on what has just happened."""

    done: int
    total: int
    note: str = ""


@dataclass
class Crew:
    """Who walks: processes of this machine, or an executor of the user's, such as that of a Dask client.

    workers: a number of processes, one per core if None, or an executor, which is used as it is and not ended.
    As a context manager it ends its processes; they begin to load the package as soon as it is constructed.
    """

    workers: futures.Executor | int | None = None

    def __post_init__(self) -> None:
        """Start the executor, so that its processes load the package while the caller goes on."""
        self.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: object, *_: object) -> None:
        # the user's own executor goes on
        if self.executor is not self.workers:
            end_all(self.executor)

    def start(self) -> None:
        """Set `executor`: the user's own, or a new pool of processes; and `first`, its first task, of which
        `renew` asks whether a worker could start.
        """
        if isinstance(self.workers, futures.Executor):
            self.executor: futures.Executor = self.workers
        else:
            # _PRELOADED: modules that are imported before the processes are forked
            self.executor = processes(self.workers, _PRELOADED)
            self.first = self.executor.submit(os.getpid)

    @property
    def count(self) -> int:
        """How many chunks are walked at the same time; for an executor that does not say it, as that of a Dask
        client, the number of cores here.
        """
        # executors of Python's library have this attribute
        return int(getattr(self.executor, "_max_workers", None) or cores())

    def renew(self) -> None:
        """Start another pool in place of one of which a process died. Raises WorkersError for an executor of
        the user's, and where no worker could start.
        """
        if self.executor is self.workers:
            raise WorkersError("a worker of the executor died, which the study cannot start anew")
        if isinstance(self.first.exception(), futures.BrokenExecutor):
            raise WorkersError(NO_GUARD)
        end_all(self.executor)
        self.start()


@dataclass
class Runner:
    """Walks points and stores their rows; `done` counts walks over all calls of `run`.

    function: computes rows from records. store: the open results file. total: number of walks of the study.
    progress: called after each chunk. crashed: number of walks that killed their workers since the last
    finished chunk. pending: chunks that the executor has.
    """

    function: Function
    store: Store
    crew: Crew
    total: int
    there: Container[int] = ()
    """Places that have a row already."""
    progress: Callable[[StudyProgress], None] | None = None
    done: int = 0
    crashed: int = 0
    pending: dict[futures.Future[Any], Sequence[Point]] = field(default_factory=dict)

    def run(self, points: Iterable[Point], count: int | None = None) -> None:
        """Walk those of the points that have no row yet; they may come from a generator.

        count: number of points, `total` if None, which decides the size of chunks. Raises OutputError, and
        WorkersError where MOST_CRASHED workers die one after the other.
        """
        workers, count = self.crew.count, self.total if count is None else count
        # rounds: chunks for each worker, at least four, so that none waits long for the last one
        # LARGEST_CHUNK walks; _AHEAD chunks for each worker
        rounds = max(4, math.ceil(count / (workers * LARGEST_CHUNK)))
        size = max(1, math.ceil(count / (workers * rounds)))
        missing = self._missing(iter(points))
        # _send and _collect return points whose worker died, which _again walks one by one; mostly none
        while part := tuple(itertools.islice(missing, size)):
            self._again(self._send(part))
            while len(self.pending) >= _AHEAD * workers:
                self._again(self._collect(futures.FIRST_COMPLETED))
        while self.pending:
            self._again(self._collect(futures.FIRST_COMPLETED))
        self.tell()

    def tell(self, note: str = "") -> None:
        """Call `progress` with what is done; note: a sentence on what has just happened, "" for none."""
        if self.progress is not None:
            self.progress(StudyProgress(self.done, max(self.total, self.done), note))

    def _missing(self, points: Iterator[Point]) -> Iterator[Point]:
        """Yield the points without a row, and count those that have one as done."""
        for p in points:
            if p.place not in self.there:
                yield p
            else:
                self.done += 1

    def _send(self, chunk: Sequence[Point]) -> Sequence[Point]:
        """Hand a chunk to the executor; returns the points that it did not take: all of them where one of its
        processes has died.
        """
        try:
            # FOLDERS: where modules of the user's are, which the worker has to import too
            records, folders = [p.record for p in chunk], dict(FOLDERS)
            future = self.crew.executor.submit(rows_of, self.function, records, folders)
        except futures.BrokenExecutor:
            return chunk
        self.pending[future] = chunk
        return ()

    def _collect(self, when: str) -> list[Point]:
        """Wait for the first chunk or for all (`when`), store the finished ones, and return the points of
        chunks whose worker died.
        """
        lost: list[Point] = []
        # BrokenExecutor: a process died. Any other error is of the way to the worker: `rows_of` raises none
        for future in futures.wait(self.pending, return_when=when).done:
            chunk, error = self.pending.pop(future), future.exception()
            if error is None:
                self.crashed = 0
                self._keep(chunk, future.result())
            elif isinstance(error, futures.BrokenExecutor):
                lost += chunk
            else:
                raise WorkersError(
                    f"walks could not be handed to a worker or back: {error!r}; what was finished is kept"
                ) from error
        return lost

    def _again(self, lost: Sequence[Point]) -> None:
        """Walk lost points, those that were with a worker when it died, again: one by one, with nothing beside
        them; without such points do nothing.

        The row of a point whose worker dies again has the status CRASHED. Raises WorkersError after
        MOST_CRASHED of them with no other walk in between.
        """
        if not lost:
            return
        # a pool of which one process died loses all chunks that it had
        lost = [*lost, *self._collect(futures.ALL_COMPLETED)]
        self.tell("a worker died; what it was walking is walked again, one by one")
        self.crew.renew()
        for point in lost:
            # both return the points that are lost: none if this one has been walked and stored
            if not (self._send([point]) or self._collect(futures.ALL_COMPLETED)):
                continue
            self.crashed += 1
            self.crew.renew()
            detail = "the worker that walked it died, each time it was tried"
            row = {"status": CRASHED, "detail": detail}
            self._keep([point], [(json.dumps(row), CRASHED)])
            self.tell(f"left out, since it kills its worker: {dict(point.at)}")
            if self.crashed >= MOST_CRASHED:
                raise WorkersError(
                    f"{self.crashed} walks one after the other killed their workers; which is in the results. "
                    "Look for lack of memory; the same command goes on with the others"
                )

    def _keep(self, chunk: Sequence[Point], rows: Sequence[tuple[str, str | None]]) -> None:
        """Store a chunk, with (row as JSON, status) of each of its points, and count it as done."""
        self.store.add((p, *said) for p, said in zip(chunk, rows, strict=True))
        self.done += len(chunk)
        self.tell()
