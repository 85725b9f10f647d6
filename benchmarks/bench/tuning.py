"""A search by `tune`: wall time, and what is spent beside the walks.

Run: python benchmarks/bench/tuning.py [OUT] [--quick]

200 candidates of two gains and a bandwidth, each on 20 walks of 10 impacts under a push of their own, at 1 kHz
with exact measurements. `bare` are the rows of the very same settings, found by workers of the same kind that
are told nothing of a search; `overhead` is what the search takes more of CPU time, all workers included.
The selection and test sets have few walks. Processes are forked from this one, where all is imported.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable
from concurrent.futures import Executor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report import Table, arguments, forked, spent

from biped_adrc.bench.run import run_trials
from biped_adrc.campaign.chunk import Record
from biped_adrc.campaign.execute import LARGEST_CHUNK
from biped_adrc.campaign.workers import Threads, Workers
from biped_adrc.tuning.candidate import Candidate
from biped_adrc.tuning.study import TuningStudy
from biped_adrc.tuning.study_file import read_tuning
from biped_adrc.tuning.tune import tune

IMPACTS = 10


def study(budget: int, walks: int) -> TuningStudy:
    """Gains and bandwidth of m = 1."""
    return read_tuning(
        {
            "study": {
                "name": "m = 1",
                "budget": budget,
                "generation": 20,
                "finalists": 1,
                "seed": 1,
            },
            "fixed": {
                "controller": "LESO",
                "impacts": IMPACTS,
                "push": "pulse",
                "on": "random joints",
                "amplitude": 40.0,
                "pushed_step": 3,
            },
            "variables": {
                "K_p": {"from": 1000.0, "to": 9000.0, "scale": "log"},
                "K_d": {"from": 30.0, "to": 150.0, "scale": "log"},
                "bandwidth": {"from": 200.0, "to": 900.0, "scale": "log"},
            },
            "objectives": [{"column": "rms_error", "counts": "made"}],
            "training": {"seeds": {"from": 0, "count": walks}},
            "selection": {"seeds": [1000]},
            "test": {"seeds": [2000]},
        }
    )


def searched(asked: TuningStudy, workers: Workers | Executor) -> list[Candidate]:
    """The candidates of a search in a folder of its own."""
    with tempfile.TemporaryDirectory() as folder:
        return list(tune(asked, Path(folder), workers).candidates)


def records(asked: TuningStudy, found: list[Candidate]) -> list[Record]:
    """Of all walks of the training set."""
    settings = [asked.values(c.chosen) for c in found]
    return [p.record for values in settings for p in asked.walks("training").points(values, {})]


def bare(given: list[Record], executor: Executor) -> None:
    """The walks alone, in chunks as those of a search."""
    chunks = [given[i : i + LARGEST_CHUNK] for i in range(0, len(given), LARGEST_CHUNK)]
    for future in [executor.submit(run_trials, chunk) for chunk in chunks]:
        future.result()


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    budget, walks = (20, 5) if asked.quick else (200, 20)
    table = Table(
        "Tuning", "s", f"{budget} candidates, {walks} walks of {IMPACTS} impacts each", ("optuna",)
    )
    searched(study(4, 2), Threads(1))  # whatever is compiled once
    for name, make in (("2 threads", lambda: ThreadPoolExecutor(2)), ("2 processes", forked)):
        found: list[Candidate] = []

        def search(make: Callable[[], Any] = make, found: list[Candidate] = found) -> None:
            with make() as executor:
                found += searched(study(budget, walks), executor)

        whole = spent(search)
        given = records(study(budget, walks), found)

        def walked(make: Callable[[], Any] = make, given: list[Record] = given) -> None:
            with make() as executor:
                bare(given, executor)

        alone = spent(walked)
        table.add(
            name,
            walks=len(given),
            search=whole.wall,
            bare=alone.wall,
            search_CPU=whole.cpu,
            bare_CPU=alone.cpu,
            overhead=whole.cpu / alone.cpu - 1.0,
        )
    table.finish(asked.out)


if __name__ == "__main__":
    main()
