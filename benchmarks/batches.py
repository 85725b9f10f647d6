"""Many walks by `simulate_many`: wall time by threads, memory, and whether they are the same walks.

Run: python benchmarks/batches.py [OUT] [--quick]

Every walk has 25 impacts at 1 kHz under ADRC and a push of its own: torques of normal distribution on the
four joints in a random single support, from a seeded generator. `same` compares a hash of every status,
time and state before impacts with that of the first row of the size. `peak` is that of the whole process so
far.
"""

from __future__ import annotations

import hashlib
import resource
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from report import Seconds, Table, arguments, median, spent
from walks import IMPACTS, TICK, load, setting

import biped_adrc as ba
from biped_adrc.engine.batch import Case, simulate_many
from biped_adrc.hybrid.integrators import RK4

SEED, SPREAD = 7, 20.0  # SPREAD [N m], standard deviation of a push
SIZES = (10, 100, 1000)
ROUNDS = 3


class Batch(NamedTuple):
    """What is kept of one."""

    seconds: Seconds
    hash: str
    walked: int
    """Walks with all their impacts."""


def pushed(count: int) -> Iterator[Case]:
    """Cases, made as they are asked for."""
    random, found = np.random.default_rng(SEED), setting()
    q, v = found.gait.start(found.walker.plant)
    for _ in range(count):
        torque = np.append(random.normal(0.0, SPREAD, 4), 0.0)
        step, start = int(random.integers(2, IMPACTS)), float(random.uniform(0.0, 0.3))
        push = ba.TorquePulse(torque, step, start, start + 0.1)
        yield Case(replace(found.walker, disturbance=push), q, v, RK4(TICK), IMPACTS)


def batch(count: int, threads: int) -> Batch:
    """Run and forget, keeping a hash."""
    digest, walked = hashlib.sha256(), 0

    def run() -> None:
        nonlocal walked
        for walk in simulate_many(pushed(count), threads):
            for part in (walk.times, walk.x_minus, walk.final_state):
                digest.update(np.ascontiguousarray(part).tobytes())
            digest.update(walk.status.name.encode())
            walked += walk.impacts == IMPACTS

    seconds = spent(run)
    return Batch(seconds, digest.hexdigest()[:8], walked)


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    batch(2, 1)  # whatever is compiled or loaded once
    note = f"pushes of {SPREAD:g} N m, seed {SEED}; ratios of wall time; {load()}"
    table = Table("Batches", "walk", note, ("numba", "llvmlite"), by="wall")
    for size in SIZES[:2] if asked.quick else SIZES:
        found = {threads: [] for threads in (1, 2)}
        for _ in range(1 if asked.quick else ROUNDS):
            for threads, batches in found.items():
                batches.append(batch(size, threads))
        for threads, batches in found.items():
            table.add(
                f"{size} walks, {threads} thread{'s' * (threads > 1)}",
                median([one.seconds for one in batches]),
                size,
                same=all(one.hash == found[1][0].hash for one in batches),
                walked=batches[0].walked,
                peak_MB=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
            )
    table.finish(asked.out)


if __name__ == "__main__":
    main()
