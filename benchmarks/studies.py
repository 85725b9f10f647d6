"""Studies beside the walks that they make: a sweep over seeds, and a search.

Run: python benchmarks/studies.py [OUT] [--quick]

The bare walks are there before the clock starts, with the same table, and nobody asks for a row; what a
ratio has above 1 is what a study costs beside its walks. CPU time, of the children too; processes are
forked from this one, where all is imported. Sweep: ADRC at 1 kHz, 25 impacts, every walk with a push of its
own. Search: candidates of two gains and a bandwidth, each on walks of 10 impacts with a push of their own;
its bare walks are the rows of the very same settings.
"""

from __future__ import annotations

import json
import tempfile
from collections.abc import Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from report import Run, Table, arguments, forked, rounds, spent

import biped_adrc as ba
from biped_adrc.engine.batch import Case, simulate_many
from biped_adrc.studies.build import Values, scenario_of, trial_of
from biped_adrc.studies.results import opened
from biped_adrc.studies.run import run_trials
from biped_adrc.studies.runner import LARGEST_CHUNK
from biped_adrc.studies.study import Study, read_study

PUSH: dict[str, Any] = {"pushes.0.joints": "random", "pushes.0.torque": 40.0}
CASES: list[Case] = []
"""The walks of the bare batch; processes that are forked have them too."""


def study(walks: int) -> Study:
    """Pushes drawn by seed."""
    base = {"controller.name": "ADRC", "run.impacts": 25, **PUSH}
    return read_study({"name": f"{walks} walks", "base": base, "seeds": walks})


def swept(asked: Study, executor: Executor) -> None:
    """Carry a study out in a folder of its own."""
    with tempfile.TemporaryDirectory() as folder:
        ba.study(asked, folder, executor)


def in_a_thread(run: Any) -> None:
    """A call with one thread of its own."""
    with ThreadPoolExecutor(1) as executor:
        run(executor)


def walk(first: int, last: int) -> int:
    """Some of the cases, one after the other; the number of their impacts."""
    return sum(walked.impacts for walked in simulate_many(CASES[first:last], threads=1))


def bare(executor: Executor) -> None:
    """All cases, in chunks."""
    chunks = range(0, len(CASES), LARGEST_CHUNK)
    for future in [executor.submit(walk, i, i + LARGEST_CHUNK) for i in chunks]:
        future.result()


def on_two(run: Any) -> None:
    """A call with two processes of its own."""
    with forked() as executor:
        run(executor)


def sweeps(size: int, count: int) -> Table:
    """A sweep in one thread and in two processes."""
    asked = study(size)
    CASES[:] = [trial_of(scenario_of(point.record)).case for point in asked.points()]
    table = Table("Sweep", "walk", f"{size} walks", ("numba",))
    runs: dict[str, Run] = {
        "bare walks, 1 thread": partial(walk, 0, size),
        "sweep, 1 thread": partial(in_a_thread, partial(swept, asked)),
        "bare walks, 2 processes": partial(on_two, bare),
        "sweep, 2 processes": partial(on_two, partial(swept, asked)),
    }
    for name, seconds in rounds(runs, count).items():
        table.add(name, seconds, size)
    return table


def search(budget: int, walks: int) -> Study:
    """Gains and bandwidth of m = 1."""
    ranges = {
        "controller.K_p": (1000.0, 9000.0),
        "controller.K_d": (30.0, 150.0),
        "controller.observer.bandwidth": (200.0, 900.0),
    }
    return read_study(
        {
            "name": "m = 1",
            "base": {"controller.name": "LESO", "run.impacts": 10, "pushes.0.step": 3, **PUSH},
            "search": {
                "budget": budget // len(ranges),  # for each variable
                "generation": 20,
                "finalists": 1,
                "seed": 1,
                "objective": {"column": "rms_error", "counts": "made"},
                "variables": {
                    name: {"from": low, "to": high, "scale": "log"}
                    for name, (low, high) in ranges.items()
                },
                "walks": {
                    "search": {"seeds": walks},
                    "choice": {"seeds": [1000]},
                    "test": {"seeds": [2000]},
                },
            },
        }
    )


def searched(asked: Study, executor: Executor) -> list[Values]:
    """Search in a folder of its own; the records of all walks of the first set."""
    with tempfile.TemporaryDirectory() as folder:
        ba.study(asked, folder, executor)
        with opened(Path(folder), asked) as store:
            found = store.db.execute("SELECT record FROM walks WHERE at LIKE '%\"search\"%'")
            return [json.loads(record) for (record,) in found]


def rows(records: Sequence[Values], executor: Executor) -> None:
    """The walks alone, in chunks as those of a search."""
    chunks = [records[i : i + LARGEST_CHUNK] for i in range(0, len(records), LARGEST_CHUNK)]
    for future in [executor.submit(run_trials, chunk) for chunk in chunks]:
        future.result()


def searches(budget: int, walks: int) -> Table:
    """A search in two threads and in two processes."""
    note = f"{budget} candidates, {walks} walks of 10 impacts each"
    table = Table("Search", "walk", note, ("optuna", "cmaes"))
    if not (find_spec("optuna") and find_spec("cmaes")):
        table.missing("tune")
        return table
    with ThreadPoolExecutor(2) as executor:
        searched(search(6, 2), executor)  # whatever is compiled once
    asked = search(budget, walks)
    for name, workers in (("2 threads", partial(ThreadPoolExecutor, 2)), ("2 processes", forked)):
        records: list[Values] = []

        def whole(workers: Any = workers, records: list[Values] = records) -> None:
            with workers() as executor:
                records.extend(searched(asked, executor))

        def alone(workers: Any = workers, records: list[Values] = records) -> None:
            with workers() as executor:
                rows(records, executor)

        seconds = spent(whole)
        table.add(f"bare walks, {name}", spent(alone), len(records))
        table.add(f"search, {name}", seconds, len(records))
    return table


def main() -> None:
    """Print both tables, and write them when asked."""
    asked = arguments(__doc__).parse_args()
    in_a_thread(partial(swept, study(4)))  # whatever is compiled once
    sweeps(*(12, 1) if asked.quick else (500, 3)).finish(asked.out)
    searches(*(4, 2) if asked.quick else (100, 20)).finish(asked.out)


if __name__ == "__main__":
    main()
