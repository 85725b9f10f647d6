"""A study by `sweep`: wall time, walks per second and core, memory, and the same bits wherever it runs.

Run: python benchmarks/bench/studies.py [OUT] [--quick]

Every walk has 25 impacts at 1 kHz under ADRC with a push of its own and counts its own error, torque and work.
The hash is of every row, in the order of the study. `memory` is the highest that was resident in the process
that carries the study out, `workers` in its largest child, both so far.

A second table has the same walks as a bare batch: the walkers are there before the clock starts, with the same
meter, and nobody asks for a row. `share` is CPU time of the batch over that of the study, medians of rounds in
turn, children included; what is missing to 1 is what a study costs beside its walks.
"""

from __future__ import annotations

import hashlib
import json
import resource
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from functools import partial
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report import Table, arguments, forked, spent

from biped_adrc.bench.build import case
from biped_adrc.bench.compare_study import RESULTS, run_comparison
from biped_adrc.bench.parameters import trial
from biped_adrc.bench.study import Study
from biped_adrc.bench.sweep import Sweep, sweep
from biped_adrc.campaign.chunk import Record
from biped_adrc.campaign.execute import LARGEST_CHUNK
from biped_adrc.campaign.store_open import read_store
from biped_adrc.campaign.workers import Processes, Threads, Workers
from biped_adrc.engine.batch import Case, simulate_many

KB = 1024.0 * 1e-6  # [MB]


def study(walks: int, impacts: int = 25) -> Study:
    """Pushes drawn by seed."""
    fixed: dict[str, Any] = {
        "controller": "ADRC",
        "impacts": impacts,
        "push": "pulse",
        "on": "random joints",
        "amplitude": 40.0,
    }
    return Study(name=f"{walks} walks", fixed=fixed, seeds=tuple(range(walks)))


def hash_of(found: Sweep) -> str:
    """Of all rows."""
    digest = hashlib.sha256()
    for result in found.results():
        digest.update(json.dumps([result.at, result.row], sort_keys=True).encode())
    return digest.hexdigest()[:12]


def carried_out(asked: Study, workers: Any) -> tuple[float, str]:
    """Wall time [s] and hash of a study in a folder of its own."""
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        found = sweep(asked, Path(folder), workers)
        return time.perf_counter() - begin, hash_of(found)


def peak(who: int) -> float:
    """The highest resident memory so far [MB]."""
    return KB * resource.getrusage(who).ru_maxrss


def on_a_cluster(asked: Study) -> tuple[float, str] | None:
    """On a Dask cluster of two worker processes; None without Dask."""
    try:
        from distributed import LocalCluster
    except ImportError:
        return None
    from biped_adrc.campaign.dask_cluster import Cluster

    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with LocalCluster(processes=True, **options) as cluster:
        return carried_out(asked, Cluster(cluster.scheduler_address))


CASES: list[Case] = []
"""The walks of the bare batch; processes that are forked have them too."""


def walk(first: int, last: int) -> int:
    """Some of the cases, one after the other; the number of their impacts."""
    return sum(walked.impacts for walked in simulate_many(CASES[first:last], threads=1))


def bare(executor: Executor | None) -> None:
    """All cases: in chunks on an executor, in this process without one."""
    if executor is None:
        walk(0, len(CASES))
        return
    chunks = range(0, len(CASES), LARGEST_CHUNK)
    for future in [executor.submit(walk, i, i + LARGEST_CHUNK) for i in chunks]:
        future.result()


def swept(asked: Study, workers: Workers | Executor) -> list[Record]:
    """Carry a study out in a folder of its own; the records of its walks."""
    with tempfile.TemporaryDirectory() as folder:
        sweep(asked, Path(folder), workers)
    return [p.record for p in asked.points()]


def compared(seeds: int, workers: Workers | Executor) -> list[Record]:
    """A comparison of two controllers with its figures and page; the records of its walks."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder)
        run_comparison(out, "", ("NPD", "ADRC"), seeds=seeds, workers=workers)
        with read_store(out / RESULTS) as store:
            return [json.loads(text) for (text,) in store.connection.execute(RECORDS)]


RECORDS = "SELECT record FROM runs ORDER BY record"
Way = Callable[[Workers | Executor], list[Record]]


def on_two(run: Callable[[Executor], object]) -> None:
    """A call with two processes of its own."""
    with forked() as executor:
        run(executor)


def beside_bare(ways: Mapping[str, Way], rounds: int) -> Table:
    """Studies and the bare batches of their walks, in turn."""
    note = f"medians of {rounds} rounds; sweep: ADRC, 25 impacts; compare: NPD and ADRC, all conditions"
    table = Table("Studies beside bare batches", "CPU s", note, ("numba",))
    for name, way in ways.items():
        CASES[:] = [case(trial(record)) for record in way(Threads(2))]
        runs: dict[str, tuple[Callable[[], object], Callable[[], object]]] = {
            "1 thread": (partial(way, Threads(1)), partial(bare, None)),
            "2 processes": (partial(on_two, way), partial(on_two, bare)),
        }
        for who, both in runs.items():
            times = [tuple(spent(run).cpu for run in both) for _ in range(rounds)]
            whole, batch = (statistics.median(part) for part in zip(*times, strict=True))
            share = statistics.median(b / a for a, b in times)
            table.add(f"{name}, {who}", walks=len(CASES), study=whole, batch=batch, share=share)
    return table


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    table = Table(
        "Studies", "sampled ADRC walks of 25 impacts", "s and MB", ("numba", "distributed")
    )
    carried_out(study(4), Processes(2))  # whatever is compiled once
    size = 100 if asked.quick else 1000
    crews: dict[str, Any] = {
        "1 process": Processes(1),
        "2 processes": Processes(2),
        "2 threads": Threads(2),
    }
    alone, known = 0.0, ""
    for name, workers in crews.items():
        wall, found = carried_out(study(size), workers)
        alone, known = alone or wall, known or found
        add(table, f"{name}, {size}", size, wall, alone, found == known, workers.number)
    cluster = on_a_cluster(study(size))
    if cluster is None:
        table.missing("Dask cluster")
    else:
        add(table, f"Dask cluster, {size}", size, cluster[0], alone, cluster[1] == known, 2)
    for many in (1000,) if asked.quick else (1000, 10_000):
        wall, _ = carried_out(study(many, 5), Processes(2))
        add(table, f"2 processes, {many} of 5 impacts", many, wall, wall, True, 2)
    table.finish(asked.out)
    ways: dict[str, Way] = {
        "sweep": partial(swept, study(size)),
        "compare": partial(compared, size // 50),
    }
    beside_bare(ways, 3).finish(asked.out)


def add(
    table: Table, name: str, walks: int, wall: float, alone: float, same: bool, cores: int
) -> None:
    """A row."""
    table.add(
        name,
        wall_s=wall,
        walks_per_s=walks / wall,
        per_core=walks / wall / cores,
        scaling=alone / wall,
        same_bits=same,
        memory=peak(resource.RUSAGE_SELF),
        workers=peak(resource.RUSAGE_CHILDREN),
    )


if __name__ == "__main__":
    main()
