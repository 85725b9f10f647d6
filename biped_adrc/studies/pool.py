"""Independent tasks on all cores, with progress, in the order in which they were given."""

from __future__ import annotations

import multiprocessing
import os
import signal
import time
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from dataclasses import dataclass
from typing import Any, NamedTuple

TaskProgress = Callable[[int, int, str], None]
"""Called with tasks done, tasks in all, and the name of the one that has just finished."""


@dataclass(frozen=True)
class Task:
    """function(*arguments), both picklable; `name` is shown while it runs."""

    name: str
    function: Callable[..., Any]
    arguments: tuple[Any, ...] = ()


class Timed(NamedTuple):
    """A result and the time it took [s]."""

    value: Any
    seconds: float


def _timed(task: Task) -> Timed:
    begin = time.perf_counter()
    value = task.function(*task.arguments)
    return Timed(value, time.perf_counter() - begin)


def _ignore_interrupt() -> None:
    """Ctrl-C reaches every process of the terminal; the parent alone answers it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


PRELOADED = ("biped_adrc.studies.plan", "biped_adrc.studies.pictures", "biped_adrc.engine.batch")
"""Imported once, before the workers are forked."""


def run_tasks(
    tasks: Sequence[Task], workers: int | None = None, progress: TaskProgress | None = None
) -> list[Timed]:
    """Results in the order of `tasks`. An error in one, or Ctrl-C, ends all workers and is raised."""
    workers = workers or os.cpu_count() or 1
    if workers == 1:
        results = []
        for i, task in enumerate(tasks):
            results.append(_timed(task))
            if progress is not None:
                progress(i + 1, len(tasks), task.name)
        return results
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(list(PRELOADED))
    pool = ProcessPoolExecutor(workers, context, initializer=_ignore_interrupt)
    processes: list[Any] = []
    try:
        futures = [pool.submit(_timed, task) for task in tasks]
        processes = list((pool._processes or {}).values())
        _collect(dict(zip(futures, tasks, strict=True)), progress)
        return [future.result() for future in futures]
    except BaseException:
        pool.shutdown(wait=False, cancel_futures=True)
        for process in processes:
            process.terminate()
        raise
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _collect(tasks: dict[Future[Any], Task], progress: TaskProgress | None) -> None:
    pending, done = set(tasks), 0
    while pending:
        finished, pending = wait(pending, return_when=FIRST_COMPLETED)
        for future in finished:
            future.result()
            done += 1
            if progress is not None:
                progress(done, len(tasks), tasks[future].name)
