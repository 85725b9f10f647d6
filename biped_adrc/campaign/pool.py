"""A few different tasks, each in a process of its own, with their results in the order in which they were
given.

For work that is not a study: the runs of the reproduction, its figures, the hip study. Nothing is stored, and
an error in one task ends all. Many runs of one function that must survive a kill belong to `campaign.execute`.
The processes are those of `campaign.workers`.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from concurrent.futures import as_completed
from dataclasses import dataclass
from typing import Generic, NamedTuple, TypeVar

from biped_adrc.campaign.workers import Crew, Processes, cores, held_back

T = TypeVar("T")
"""What a task returns."""
T_co = TypeVar("T_co", covariant=True)

TaskProgress = Callable[[int, int, str], None]
"""Called with tasks done, tasks in all, and the name of the one that has just finished."""


@dataclass(frozen=True)
class Task(Generic[T_co]):
    """function(*arguments) under a name; function and arguments are pickled to reach another process."""

    name: str
    """Shown while it runs."""
    function: Callable[..., T_co]
    arguments: tuple[object, ...] = ()


class Timed(NamedTuple, Generic[T]):
    """A result and the wall time it took [s]."""

    value: T
    seconds: float


def _timed(task: Task[T]) -> Timed[T]:
    """Carry a task out in the worker, and measure it there: waiting for a core does not count."""
    begin = time.perf_counter()
    value = task.function(*task.arguments)
    return Timed(value, time.perf_counter() - begin)


PRELOADED = ("biped_adrc.paper.runs", "biped_adrc.paper.pictures", "biped_adrc.engine.batch")
"""Modules imported once by the process from which the workers are forked: importing them takes seconds."""


def run_tasks(
    tasks: Sequence[Task[T]], workers: int | None = None, progress: TaskProgress | None = None
) -> list[Timed[T]]:
    """Results in the order of `tasks`, with the wall time of each [s].

    workers: processes (one per core if None); with 1 the tasks run in this process, which helps a debugger. An
    error in one task, or Ctrl-C, terminates all workers and is raised.
    """
    told = progress or (lambda *_: None)
    if (workers or cores()) == 1:
        results = []
        for done, task in enumerate(tasks, 1):
            results.append(_timed(task))
            told(done, len(tasks), task.name)
        return results
    with Crew(Processes(workers, PRELOADED)) as crew:
        with held_back():
            futures = {crew.executor.submit(_timed, task): task.name for task in tasks}
        for done, future in enumerate(as_completed(futures), 1):
            future.result()
            told(done, len(tasks), futures[future])
    return [future.result() for future in futures]
