"""Who carries a study out: processes or threads of this machine, or any `concurrent.futures.Executor`.

A `Workers` object says which executor is made, and a `Crew` has the one in use: a `ProcessPoolExecutor` of
which one process has died is useless, and another one takes its place in the middle of a study. An executor
that the user hands in is used as it is and never ended (`Given`).

Two things are done here that the standard library leaves open. Ctrl-C reaches every process of a terminal at
once: the workers ignore it and the parent alone answers, by storing what is finished. And workers end when
their parent is killed.

Used by `campaign.execute` and `campaign.pool`; `campaign.dask_cluster` adds the workers of a cluster.

What a number, a class or an executor means where workers are asked for (`workers_of`):

    None, 4          processes of this machine, one per core or four
    Threads(4)       threads of this process
    Cluster("..")    workers of a Dask scheduler (`campaign.dask_cluster`)
    an Executor      any other of `concurrent.futures`, used as it is
"""

from __future__ import annotations

import multiprocessing
import os
import signal
from abc import ABC, abstractmethod
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor, Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import forkserver, resource_tracker
from threading import Thread, current_thread, main_thread
from typing import ClassVar

from biped_adrc.errors import InputError, SimulationError

PRELOADED = ("biped_adrc.bench.run",)
"""Modules imported once by the process from which the workers are forked."""
GUARD = (
    "Worker processes import the script that starts them: what starts a study has to stand under "
    "if __name__ == '__main__': in it. Otherwise use Threads, and look for lack of memory, or for a fault in "
    "what they import"
)
"""The hint for a script without a main guard, whose workers would start the study again."""
SAFE_PATH = "PYTHONSAFEPATH"
"""Environment variable: the working directory is not put first on the path."""
MOST_WORKERS = 1024
"""Of one machine; more are a mistake, which would take its memory before a walk is made."""


class WorkersError(SimulationError):
    """Workers, or the connection to them, are gone; no walk is to blame (exit code 3)."""

    exit_code = 3


class Workers(ABC):
    """What makes executors and knows their failures."""

    elsewhere: ClassVar[bool] = False
    """Whether they run on other machines, with files of their own."""

    @abstractmethod
    def start(self) -> Executor:
        """An executor that works. Raises InputError, WorkersError."""

    @abstractmethod
    def count(self, executor: Executor) -> int:
        """How many chunks it runs at the same time."""

    def stop(self, executor: Executor, now: bool) -> None:
        """End the executor; `now`: without waiting for what runs, where that is possible."""
        executor.shutdown(wait=True, cancel_futures=now)

    def broken(self, error: BaseException) -> bool:
        """Whether an error means that a worker died, rather than an error in what it ran."""
        return isinstance(error, BrokenExecutor)


@dataclass(frozen=True)
class Threads(Workers):
    """Threads of this process; useful where most time is spent in compiled code that releases Python's lock.

    number: how many, one per core if None. Raises InputError for less than 1, or more than MOST_WORKERS.
    """

    number: int | None = None

    def __post_init__(self) -> None:
        if self.number is not None and not 1 <= self.number <= MOST_WORKERS:
            raise InputError(
                f"the study asks for {self.number} workers, expected at least 1 and at most {MOST_WORKERS}"
            )

    def count(self, executor: Executor | None = None) -> int:
        return self.number or cores()

    def start(self) -> Executor:
        return ThreadPoolExecutor(self.count())


@dataclass(frozen=True)
class Processes(Threads):
    """Processes of this machine, forked from a server process that has imported `preload`.

    A fork server has no threads and no locks of this process, which a fork of it would copy in any state; and
    what it has imported is shared by all workers.
    """

    preload: tuple[str, ...] = PRELOADED

    def start(self) -> ProcessPoolExecutor:
        """Start the processes and wait until one of them answers.

        Raises InputError in a process that is itself being started, as its script has no main guard, and
        WorkersError when the first process ends before it has done anything.
        """
        if getattr(multiprocessing.current_process(), "_inheriting", False):
            raise InputError(GUARD)
        context = multiprocessing.get_context("forkserver")
        context.set_forkserver_preload(list(self.preload))
        with held_back():
            _start_forkserver()
        executor = ProcessPoolExecutor(self.count(), context, initializer=_begin)
        try:
            with held_back():
                first = executor.submit(os.getpid)
            first.result()
        except BaseException as error:
            self.stop(executor, True)
            if isinstance(error, BrokenExecutor):
                raise WorkersError(f"the worker processes end as they start. {GUARD}") from error
            raise
        return executor

    def stop(self, executor: Executor, now: bool) -> None:
        """End the processes; now: also those in the middle of a run, for which a pool alone would wait."""
        if now:
            for process in list((getattr(executor, "_processes", None) or {}).values()):
                process.terminate()
        super().stop(executor, now)


@dataclass(frozen=True)
class Given(Workers):
    """An executor of the user's, who ends it; it cannot be started anew."""

    executor: Executor

    def count(self, executor: Executor) -> int:
        return int(getattr(self.executor, "_max_workers", None) or cores())

    def start(self) -> Executor:
        return self.executor

    def stop(self, executor: Executor, now: bool) -> None:
        return

    def broken(self, error: BaseException) -> bool:
        return False


@dataclass
class Crew:
    """Workers at work, from one round of a study to the next; a context manager, which starts and ends them.

    running: the executor in use, if any.
    """

    workers: Workers
    running: Executor | None = None

    @property
    def executor(self) -> Executor:
        """The executor in use, started where there is none. Raises the errors of `Workers.start`."""
        if self.running is None:
            self.running = self.workers.start()
        return self.running

    def close(self, now: bool = False) -> None:
        """End the executor; `now`: with what it runs. Ctrl-C waits until that is done."""
        running, self.running = self.running, None
        if running is not None:
            with held_back():
                self.workers.stop(running, now)

    def __enter__(self) -> Crew:
        assert self.executor
        return self

    def __exit__(self, kind: object, *_: object) -> None:
        self.close(now=kind is not None)


def workers_of(given: Workers | Executor | int | None) -> Workers:
    """`Workers` as they are, the user's executor, or this many processes (None: one per core)."""
    if isinstance(given, Workers):
        return given
    if given is None or isinstance(given, int):
        return Processes(given)
    return Given(given)


def cores() -> int:
    """Cores that this process may use; fewer than the machine has under a batch system."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@contextmanager
def held_back() -> Iterator[None]:
    """Ctrl-C within the block is raised at its end; does nothing outside of the main thread."""
    if current_thread() is not main_thread():
        yield
        return
    came: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _: came.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before or signal.SIG_DFL)
        if came:
            signal.raise_signal(signal.SIGINT)


def _start_forkserver() -> None:
    """Start the fork server with Ctrl-C blocked, a state that its children inherit.

    The resource tracker, which multiprocessing would otherwise start in between, lets the signal in; it is
    started before. Both are `python -c`, which would import modules from the working directory.
    """
    safe = os.environ.get(SAFE_PATH, "")
    os.environ[SAFE_PATH] = "1"
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ())
    try:
        resource_tracker.ensure_running()
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        forkserver.ensure_running()
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        os.environ[SAFE_PATH] = safe


def _begin() -> None:
    """First call in each worker: ignore Ctrl-C, and end with the parent, even where that is killed."""

    def end_with_parent() -> None:
        if (parent := multiprocessing.parent_process()) is not None:
            parent.join()
            os._exit(1)

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=end_with_parent, daemon=True).start()
