"""A thousand walks by `simulate_many`: wall time, threads, memory, and whether they are the same walks.

Run: python benchmarks/engine/batches.py [OUT] [--quick]

Every walk has 25 impacts at 1 kHz under ADRC and a push of its own: torques of normal distribution on the four
joints in a random single support, from a seeded generator. The hash is of every status, time and state before
impacts; it is that of 1 and 2 threads, and of every run. Peak memory is that of the whole process so far.
"""

from __future__ import annotations

import hashlib
import resource
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from cases import IMPACTS, TICK, load, paper
from report import Table, arguments

import biped_adrc as ba
from biped_adrc.engine.batch import Case, simulate_many
from biped_adrc.hybrid.integrators import RK4

SEED, SPREAD = 7, 20.0  # SPREAD [N m], standard deviation of a push
SIZES = (10, 100, 1000)
MB = 1e-6


class Batch(NamedTuple):
    """One batch."""

    wall: float
    """[s]"""
    cpu: float
    """[s], of all threads."""
    hash: str
    walked: int
    """Walks with all their impacts."""
    impacts: int
    """Of all."""
    simulated: float
    """[s]"""
    memory: tuple[float, float, float, float]
    """Resident before, highest while results came, after, and the process's peak [MB]."""


def pushed(count: int) -> Iterator[Case]:
    """Cases, made as they are asked for."""
    random, setting = np.random.default_rng(SEED), paper(period=TICK, push=False)
    q, v = setting.gait.start(setting.walker.plant)
    for _ in range(count):
        torque = np.append(random.normal(0.0, SPREAD, 4), 0.0)
        step, start = int(random.integers(2, IMPACTS)), float(random.uniform(0.0, 0.3))
        push = ba.TorquePulse(torque, step, start, start + 0.1)
        yield Case(replace(setting.walker, disturbance=push), q, v, RK4(TICK), IMPACTS)


def resident() -> float:
    """Resident memory of this process [MB]."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return MB * pages * resource.getpagesize()


def peak() -> float:
    """The highest there has been [MB]."""
    return 1024.0 * MB * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def batch(count: int, threads: int) -> Batch:
    """Run and forget, keeping a hash."""
    found, walked, impacts, simulated = hashlib.sha256(), 0, 0, 0.0
    before = highest = resident()
    begin, used = time.perf_counter(), time.process_time()
    for walk in simulate_many(pushed(count), threads):
        for part in (walk.times, walk.x_minus, walk.final_state):
            found.update(np.ascontiguousarray(part).tobytes())
        found.update(walk.status.name.encode())
        walked, impacts = walked + (walk.impacts == IMPACTS), impacts + walk.impacts
        simulated, highest = simulated + walk.t_end, max(highest, resident())
    wall, cpu = time.perf_counter() - begin, time.process_time() - used
    memory = (before, highest, resident(), peak())
    return Batch(wall, cpu, found.hexdigest()[:8], walked, impacts, simulated, memory)


def add(table: Table, name: str, size: int, run: Batch, one: Batch, known: str) -> None:
    """A row; `one` is the batch in one thread just before, `known` the hash of the first."""
    before, highest, after, so_far = run.memory
    table.add(
        name,
        wall_s=run.wall,
        walks_per_s=size / run.wall,
        simulated=run.simulated / run.wall,
        cores_used=run.cpu / run.wall,
        scaling=one.wall / run.wall,
        hash=run.hash,
        same=run.hash == known,
        walked=run.walked,
        MB_before=before,
        highest=highest,
        after=after,
        peak=so_far,
    )


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    sizes = SIZES[:2] if asked.quick else SIZES
    batch(2, 1)  # whatever is compiled or loaded once
    note = f"walks by threads; simulated s per wall s; MB; pushes of {SPREAD:g} N m, seed {SEED}; {load()}"
    table = Table("Batches", "sampled ADRC walks of 25 impacts", note, ("numba", "llvmlite"))
    for size in sizes:
        known = ""
        for k in (1, 2):
            one = batch(size, 1)
            known = known or one.hash
            add(table, f"{size} by 1, run {k}", size, one, one, known)
            add(table, f"{size} by 2, run {k}", size, batch(size, 2), one, known)
    table.finish(asked.out)


if __name__ == "__main__":
    main()
