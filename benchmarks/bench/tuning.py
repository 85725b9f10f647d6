"""A search by `tune`: wall time, and what is spent beside the walks.

Run: python benchmarks/bench/tuning.py [OUT] [--quick]

200 candidates of two gains and a bandwidth, each on 20 walks of 10 impacts under a push of their own, at 1 kHz
with exact measurements. `bare` are the rows of the very same settings, found by workers of the same kind that
are told nothing of a search. The selection and test sets have one walk each.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report import Table, arguments

from biped_adrc.bench.run import run_trials
from biped_adrc.campaign.workers import Processes, Threads
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


def searched(asked: TuningStudy, workers: Any) -> tuple[float, list[dict[str, object]]]:
    """Wall time [s] of the search, and the records of all walks of its training set."""
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        found = tune(asked, Path(folder), workers)
        spent = time.perf_counter() - begin
    settings = [asked.values(c.chosen) for c in found.candidates]
    return spent, [
        dict(p.record) for values in settings for p in asked.walks("training").points(values, {})
    ]


def bare(records: list[dict[str, object]], workers: Any) -> float:
    """Wall time [s] of the walks alone, in chunks of 20, with the start of the workers."""
    begin = time.perf_counter()
    workers.prepare()
    pool = workers.start()
    chunks = [records[i : i + 20] for i in range(0, len(records), 20)]
    for future in [pool.submit(run_trials, chunk) for chunk in chunks]:
        future.result()
    workers.stop(pool, True)
    return time.perf_counter() - begin


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    budget, walks = (20, 5) if asked.quick else (200, 20)
    table = Table(
        "Tuning", "s", f"{budget} candidates, {walks} walks of {IMPACTS} impacts each", ("optuna",)
    )
    searched(study(4, 2), Threads(1))  # whatever is compiled once
    for name, make in (("2 threads", lambda: Threads(2)), ("2 processes", lambda: Processes(2))):
        spent, records = searched(study(budget, walks), make())
        alone = bare(records, make())
        table.add(
            name,
            walks=len(records),
            search=spent,
            bare=alone,
            ratio=spent / alone,
            walks_per_s=len(records) / spent,
        )
    table.finish(asked.out)


if __name__ == "__main__":
    main()
