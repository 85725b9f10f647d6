"""Worker processes of this machine, and a list of different tasks run by them.

Processes are forked from a server that has imported the modules `preload`, so that they share its memory.
They ignore Ctrl-C, which reaches every process of a terminal and which the parent handles, and end with the
parent.
"""

import gc
import multiprocessing
import os
import signal
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor, as_completed
from multiprocessing import forkserver, resource_tracker
from threading import Thread
from typing import Generic, NamedTuple, TypeVar

from biped_adrc.core.errors import InputError

_T = TypeVar("_T")
"""Type of a task's result."""

TaskProgress = Callable[[int, int, str], None]
"""A function called after each task with tasks done, tasks in all, and the name of the one just finished."""
MOST_WORKERS = 1024
"""Largest number of workers on one machine; more are a mistake, which would take its memory."""
KEPT = 3 * 2**23
"""Number of bytes that a worker allocates and frees at first: glibc then keeps twice as many of the bytes that
are freed later, so that a chunk of walks need not ask the system for its pages anew."""
NO_GUARD = (
    "no worker process could start: workers import the script that starts them, which has to be a file, and to "
    "do so under if __name__ == '__main__':"
)
"""What a user reads where workers end before their first task."""
SAFE_PATH = "PYTHONSAFEPATH"
"""Environment variable: new interpreters import nothing from the working directory."""


class Task(NamedTuple, Generic[_T]):
    """function(*arguments) under a name; function and arguments are pickled to reach another process."""

    name: str
    """Name for messages of progress."""
    function: Callable[..., _T]
    arguments: tuple[object, ...] = ()


class Timed(NamedTuple, Generic[_T]):
    """A result and the wall time it took [s]."""

    value: _T
    seconds: float


def cores() -> int:
    """Number of cores that this process may use; fewer than the machine has under a batch system."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def processes(count: int | None, preload: Sequence[str]) -> ProcessPoolExecutor:
    """Start `count` worker processes, one per core if None, which share the modules `preload`.

    Raises InputError for less than 1 or more than `MOST_WORKERS`.
    """
    if count is not None and not 1 <= count <= MOST_WORKERS:
        raise InputError(f"{count} workers were asked for, expected 1 to {MOST_WORKERS}")
    # this process is itself a worker, which is importing the script that starts workers: it ends without a
    # word, and the process that started it says why (`NO_GUARD`)
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise SystemExit
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(list(preload))
    # the server and its forks inherit this: they import nothing from the working directory
    before, os.environ[SAFE_PATH] = os.environ.get(SAFE_PATH, ""), "1"
    try:
        resource_tracker.ensure_running()
        forkserver.ensure_running()
    finally:
        os.environ[SAFE_PATH] = before
    return ProcessPoolExecutor(count or cores(), context, initializer=_begin)


def end_all(executor: Executor) -> None:
    """End an executor at once, including processes in the middle of their work."""
    # the executor has no public list of its processes; None once it has ended
    for process in list((getattr(executor, "_processes", None) or {}).values()):
        process.terminate()
    executor.shutdown(wait=True, cancel_futures=True)


def run_tasks(
    tasks: Sequence[Task[_T]],
    workers: int | None,
    preload: Sequence[str],
    progress: TaskProgress | None = None,
) -> list[Timed[_T]]:
    """Run tasks in worker processes; returns their results in order, each with its wall time [s].

    workers: processes (one per core if None); with 1 the tasks run in this process, which helps a debugger.
    preload: modules that the processes share. progress: called after each task. An error in one task, or
    Ctrl-C, terminates all workers and is raised.
    """
    report = progress or (lambda *_: None)
    if (workers or cores()) == 1:
        results = []
        for done, task in enumerate(tasks, 1):
            results.append(_timed(task))
            report(done, len(tasks), task.name)
        return results
    executor = processes(workers, preload)
    try:
        futures = {executor.submit(_timed, task): task.name for task in tasks}
        for done, future in enumerate(as_completed(futures), 1):
            future.result()  # raises the error of a task at once
            report(done, len(tasks), futures[future])
        return [future.result() for future in futures]
    finally:
        end_all(executor)


def _timed(task: Task[_T]) -> Timed[_T]:
    """Run a task in the worker, and measure its time there: waiting for a core does not count."""
    begin = time.perf_counter()
    value = task.function(*task.arguments)
    return Timed(value, time.perf_counter() - begin)


def _begin() -> None:
    """First call in each worker: ignore Ctrl-C, and end with the parent, even when it is killed."""

    def end_with_parent() -> None:
        if (parent := multiprocessing.parent_process()) is not None:
            parent.join()
            os._exit(1)

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # allocated and freed at once: glibc then keeps memory that is freed later for the worker
    bytearray(KEPT)
    gc.freeze()  # the search for garbage writes into all other objects, and pages written to are not shared
    Thread(target=end_with_parent, daemon=True).start()
