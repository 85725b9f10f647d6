"""Walks from random states, gains and pushes: each ends with a named status, none with a NaN.

Some hundred of them here, 2000 by `make fuzz`.
"""

import math
from collections import Counter

import numpy as np
import psutil

from biped_adrc.analysis.certificate import REASONS
from biped_adrc.bench.run import COLUMNS, REFUSED, run_trial
from biped_adrc.hybrid.status import Status

WALKS = 600
MAKES = (
    {"controller": "NPD"},
    {"controller": "NPD", "velocity": "differences", "counts": 4096.0, "noise": 1e-4},
    {"controller": "ADRC", "delay": 0.5e-3},
    {"controller": "LESO", "lag": 2e-3, "rate_limit": 1e4, "torque_limit": 200.0},
    {"controller": "LESO", "hardware": "rabbit", "reset": "relabel"},
    {"controller": "NPD", "mass_error": 0.5, "com_error": 0.5, "inertia_error": 0.5},
)
"""What needs code of its own; all else is drawn."""
PUSHES = ("none", "pulse", "step", "sine", "noise")
NAMES = {status.name for status in Status} | {REFUSED}


def trial(random):
    """Far outside of what anyone would walk with."""

    def log(low, high):
        return float(np.exp(random.uniform(np.log(low), np.log(high))))

    make = dict(MAKES[random.integers(len(MAKES))])
    if make["controller"] == "LESO":
        make |= {"bandwidth": log(1.0, 1e5), "order": int(random.integers(0, 4))}
    start = {f"q{i}": float(random.normal(0.0, 0.3)) for i in range(1, 6)}
    start |= {f"v{i}": float(random.normal(0.0, 3.0)) for i in range(1, 6)}
    push = str(random.choice(PUSHES))
    return {
        **make,
        "impacts": int(random.integers(1, 4)),
        "seed": int(random.integers(1_000_000)),
        "K_p": log(1.0, 1e8),
        "K_d": log(0.1, 1e5),
        "push": push,
        "on": str(random.choice(["random joints", "q5", "q1,-q4"])),
        "amplitude": 0.0 if push == "none" else log(0.1, 1e5),
        "pushed_step": 1,
        "start": start if random.uniform() < 0.5 else {},
        "start_speed": float(random.uniform(-0.9, 2.0)) if random.uniform() < 0.3 else 0.0,
        "slope": float(random.uniform(-0.3, 0.3)) if random.uniform() < 0.3 else 0.0,
        "ground_step": float(random.uniform(-0.1, 0.1)) if random.uniform() < 0.2 else 0.0,
        "impact_error": float(random.choice([0.0, 0.9])) if random.uniform() < 0.1 else 0.0,
    }


def test_every_walk_ends_with_a_name_and_numbers():
    found = attack(WALKS)
    assert found["COMPLETED"] > 0.05 * WALKS
    assert found["FELL"] > 0.05 * WALKS
    assert sum(found.values()) == WALKS


def attack(walks):
    """How many of so many walks ended how, each of them checked, and the memory that they took."""
    random, found = np.random.default_rng(2026), Counter()
    process, memory = psutil.Process(), []
    for i in range(walks):
        record = trial(random)
        row = run_trial(record)
        assert list(row) == list(COLUMNS)
        assert row["status"] in NAMES, (record, row)
        for name, x in row.items():
            assert not isinstance(x, float) or math.isfinite(x), (name, record, row)
        assert (row["survived"] == 1) == (row["status"] == "COMPLETED")
        assert row["status"] != "COMPLETED" or row["impacts"] == record["impacts"]
        assert row["status"] != REFUSED or row["detail"], (record, row)
        word = {"FELL": {"fell"}, "COMPLETED": {"made", "legal"}, REFUSED: {None}, "RAISED": {None}}
        assert row["outcome"] in word.get(row["status"], {"ended"}), (record, row)
        assert row["legal"] in (None, int(row["outcome"] == "legal")), (record, row)
        bad = [row[f"bad_{name}"] for name in REASONS]
        assert row["outcome"] != "legal" or not any(bad), (record, row)
        assert row["outcome"] != "made" or any(bad), (record, row)
        found[row["status"]] += 1
        if (i + 1) % (walks // 4) == 0:
            memory.append(process.memory_info().rss / 2**20)
    assert memory[-1] - memory[1] < 60.0, memory  # [MB]
    return found
