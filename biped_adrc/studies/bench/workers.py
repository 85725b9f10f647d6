"""Who carries a study out: processes or threads of this machine, or any `concurrent.futures.Executor`.

Workers make an executor, and another one when it breaks; an executor that is handed in is used as it is.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
from abc import ABC, abstractmethod
from concurrent.futures import BrokenExecutor, Executor, ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import dataclass
from threading import Thread
from typing import Any

from biped_adrc.errors import InputError

PRELOADED = ("biped_adrc.studies.bench.run",)
"""Imported once, before the processes are forked."""


class Workers(ABC):
    """What runs chunks."""

    @abstractmethod
    def start(self) -> Executor:
        """An executor that works. Raises InputError."""

    @abstractmethod
    def count(self, executor: Executor) -> int:
        """How many chunks it runs at once."""

    @abstractmethod
    def stop(self, executor: Executor, now: bool) -> None:
        """End the executor; `now` without waiting for what runs, where that can be."""

    def restart(self, executor: Executor) -> Executor:
        """Another executor for one that broke. Raises the errors of `start`."""
        self.stop(executor, True)
        return self.start()

    def broken(self, error: BaseException) -> bool:
        """Whether an error says that a worker died, and not what it was doing."""
        return isinstance(error, BrokenExecutor)

    def check(self, executor: Executor) -> None:
        """Asked when nothing has come for a while. Raises SimulationError when nothing will."""
        return


@dataclass(frozen=True)
class Processes(Workers):
    """Processes of this machine, forked from one with `preload` imported; they end with this one."""

    number: int | None = None
    preload: tuple[str, ...] = PRELOADED

    def __post_init__(self) -> None:
        _check_number(self.number)

    def count(self, executor: Executor) -> int:
        return _number(self.number)

    def start(self) -> ProcessPoolExecutor:
        context = multiprocessing.get_context("forkserver")
        context.set_forkserver_preload(list(self.preload))
        return ProcessPoolExecutor(_number(self.number), context, initializer=_begin)

    def stop(self, executor: Executor, now: bool) -> None:
        processes: list[Any] = list((getattr(executor, "_processes", None) or {}).values())
        if now:
            executor.shutdown(wait=False, cancel_futures=True)
            for process in processes:
                process.terminate()
        executor.shutdown(wait=True, cancel_futures=now)


def _begin() -> None:
    """Ctrl-C reaches every process of the terminal, the parent alone answers it; without it no worker stays."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


@dataclass(frozen=True)
class Threads(Workers):
    """Threads of this process; what they run is to be compiled code that lets go of Python's lock."""

    number: int | None = None

    def __post_init__(self) -> None:
        _check_number(self.number)

    def count(self, executor: Executor) -> int:
        return _number(self.number)

    def start(self) -> ThreadPoolExecutor:
        return ThreadPoolExecutor(_number(self.number))

    def stop(self, executor: Executor, now: bool) -> None:
        executor.shutdown(wait=True, cancel_futures=now)


@dataclass(frozen=True)
class Given(Workers):
    """An executor of the caller's, who ends it; it cannot be started anew."""

    executor: Executor

    def count(self, executor: Executor) -> int:
        return int(getattr(self.executor, "_max_workers", None) or os.cpu_count() or 1)

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


def _number(asked: int | None) -> int:
    return asked or os.cpu_count() or 1


def _check_number(number: int | None) -> None:
    if number is not None and number < 1:
        raise InputError(f"the study asks for {number} workers, expected at least 1")
