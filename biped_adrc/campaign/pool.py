"""Independent tasks on all cores, with progress, in the order in which they were given."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from concurrent.futures import as_completed
from dataclasses import dataclass
from typing import Generic, NamedTuple, TypeVar

from biped_adrc.campaign.workers import Processes, cores, held_back, undisturbed

T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)

TaskProgress = Callable[[int, int, str], None]
"""Called with tasks done, tasks in all, and the name of the one that has just finished."""


@dataclass(frozen=True)
class Task(Generic[T_co]):
    """function(*arguments), both picklable; `name` is shown while it runs."""

    name: str
    function: Callable[..., T_co]
    arguments: tuple[object, ...] = ()


class Timed(NamedTuple, Generic[T]):
    """A result and the time it took [s]."""

    value: T
    seconds: float


def _timed(task: Task[T]) -> Timed[T]:
    begin = time.perf_counter()
    value = task.function(*task.arguments)
    return Timed(value, time.perf_counter() - begin)


PRELOADED = ("biped_adrc.paper.plan", "biped_adrc.paper.pictures", "biped_adrc.engine.batch")
"""Imported once, before the workers are forked."""


def run_tasks(
    tasks: Sequence[Task[T]], workers: int | None = None, progress: TaskProgress | None = None
) -> list[Timed[T]]:
    """Results in the order of `tasks`. An error in one, or Ctrl-C, ends all workers and is raised."""
    told = progress or (lambda *_: None)
    if (workers or cores()) == 1:
        results = []
        for done, task in enumerate(tasks, 1):
            results.append(_timed(task))
            told(done, len(tasks), task.name)
        return results
    crew = Processes(workers, PRELOADED)
    executor = crew.start()
    try:
        with held_back():
            futures = {executor.submit(_timed, task): task.name for task in tasks}
        for done, future in enumerate(as_completed(futures), 1):
            future.result()
            told(done, len(tasks), futures[future])
    except BaseException:
        with undisturbed():
            crew.stop(executor, True)
        raise
    crew.stop(executor, False)
    return [future.result() for future in futures]
