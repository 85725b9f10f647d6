"""Who carries a study out: processes or threads of this machine, or any `concurrent.futures.Executor`.

Workers make an executor, and another one when it breaks; an executor that is handed in is used as it is.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import forkserver, resource_tracker
from multiprocessing.process import BaseProcess
from threading import Thread, current_thread, main_thread
from types import FrameType
from typing import ClassVar

from biped_adrc.errors import InputError, SimulationError

PRELOADED = ("biped_adrc.bench.run",)
"""Imported once, before the processes are forked."""
GUARD = (
    "Worker processes import the script that starts them: what starts a study has to stand under "
    "if __name__ == '__main__': in it. Otherwise use Threads, and look for lack of memory, or for a fault in "
    "what they import"
)


class WorkersError(SimulationError):
    """Workers, or what is between them and this process, are gone: no walk is to blame (exit code 3)."""

    exit_code = 3


class Workers(ABC):
    """What runs chunks."""

    elsewhere: ClassVar[bool] = False
    """Whether on other machines, with files of their own."""

    @abstractmethod
    def start(self) -> Executor:
        """An executor that works. Raises InputError."""

    def prepare(self) -> None:
        """Raise what `start` would, as far as that is soon known; asked before anything is written."""
        return

    @abstractmethod
    def count(self, executor: Executor) -> int:
        """How many chunks it runs at once."""

    def stop(self, executor: Executor, now: bool) -> None:
        """End the executor; `now` without waiting for what runs, where that can be."""
        executor.shutdown(wait=True, cancel_futures=now)

    def restart(self, executor: Executor) -> Executor:
        """Another executor for one that broke. Raises the errors of `start`."""
        self.stop(executor, True)
        return self.start()

    def broken(self, error: BaseException) -> bool:
        """Whether an error says that a worker died, and not what it was doing."""
        return isinstance(error, BrokenExecutor)

    def check(self, executor: Executor) -> None:
        """Asked when nothing has come for a while. Raises WorkersError when nothing will."""
        return


@dataclass(frozen=True)
class Threads(Workers):
    """Threads of this process; what they run is to be compiled code that lets go of Python's lock."""

    number: int | None = None

    def __post_init__(self) -> None:
        if self.number is not None and self.number < 1:
            raise InputError(f"the study asks for {self.number} workers, expected at least 1")

    def count(self, executor: Executor | None = None) -> int:
        return self.number or cores()

    def start(self) -> Executor:
        return ThreadPoolExecutor(self.count())


@dataclass(frozen=True)
class Processes(Threads):
    """Processes of this machine, forked from one with `preload` imported; they end with this one."""

    preload: tuple[str, ...] = PRELOADED

    def prepare(self) -> None:
        """Raises InputError in a process that is itself just starting."""
        if getattr(multiprocessing.current_process(), "_inheriting", False):
            raise InputError(GUARD)

    def start(self) -> ProcessPoolExecutor:
        """Raises InputError, and WorkersError when the first process ends before it has done anything."""
        self.prepare()
        context = multiprocessing.get_context("forkserver")
        context.set_forkserver_preload(list(self.preload))
        executor = ProcessPoolExecutor(self.count(), context, initializer=_begin)
        try:
            with held_back():
                _start_forkserver()
                first = executor.submit(os.getpid)
            first.result()
        except BrokenExecutor as error:
            self.stop(executor, True)
            raise WorkersError(f"the worker processes end as they start. {GUARD}") from error
        except BaseException:
            with undisturbed():
                self.stop(executor, True)
            raise
        return executor

    def stop(self, executor: Executor, now: bool) -> None:
        processes: dict[int, BaseProcess] = getattr(executor, "_processes", None) or {}
        running = list(processes.values())
        if now:
            executor.shutdown(wait=False, cancel_futures=True)
            for process in running:
                process.terminate()
        super().stop(executor, now)


def _start_forkserver() -> None:
    """With Ctrl-C blocked, so that it and its children begin so; what keeps track of them would let it in."""
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        forkserver.ensure_running()
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


Handler = signal.Handlers | Callable[[int, FrameType | None], object]
"""What answers a signal."""


@contextmanager
def undisturbed(handler: Handler = signal.SIG_IGN) -> Iterator[None]:
    """Without Ctrl-C, where it would be heard; `handler` hears it instead."""
    if current_thread() is not main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before or signal.SIG_DFL)


@contextmanager
def held_back() -> Iterator[None]:
    """Ctrl-C is heard at the end, so that no process is started and not known of."""
    came: list[int] = []
    try:
        with undisturbed(lambda number, _: came.append(number)):
            yield
    finally:
        if came:
            signal.raise_signal(signal.SIGINT)


def _begin() -> None:
    """Ctrl-C reaches every process of the terminal, the parent alone answers it; without it no worker stays."""

    def end_with_parent() -> None:
        if (parent := multiprocessing.parent_process()) is not None:
            parent.join()
            os._exit(1)

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    Thread(target=end_with_parent, daemon=True).start()


@dataclass(frozen=True)
class Given(Workers):
    """An executor of the caller's, who ends it; it cannot be started anew."""

    executor: Executor

    def count(self, executor: Executor) -> int:
        return int(getattr(self.executor, "_max_workers", None) or cores())

    def start(self) -> Executor:
        return self.executor

    def stop(self, executor: Executor, now: bool) -> None:
        return

    def broken(self, error: BaseException) -> bool:
        return False


def workers_of(given: Workers | Executor | int | None) -> Workers:
    """Workers as they are, an executor of the caller's, or so many processes (None: one per core)."""
    if isinstance(given, Workers):
        return given
    if given is None or isinstance(given, int):
        return Processes(given)
    return Given(given)


def cores() -> int:
    """Those that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
