"""Walks for learners: samples of 1 ms per CPU second, of one environment and of vectors.

Run: python benchmarks/bench/gym.py [OUT] [--quick]

RABBIT at 1 kHz on the published gait. `added`: small random torques beside those of ADRC (m = 1, 160 rad/s),
so that it walks on; `torques`: random torques alone, under which it falls after about 0.4 s, so that much of
the time is resets. One environment is made by `gymnasium.make`, with its wrappers; a vector by `make_vec`. Each
is timed on one core, the best of three. `reset` is the time of one walk's reset.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import gymnasium
import numpy as np
from report import Table, arguments

ID = "biped_adrc.gym:biped_adrc/Walk-v0"
CASES: dict[str, dict[str, Any]] = {
    "added": {"action": "added", "bandwidth": 160.0, "order": 1},
    "torques": {"action": "torques"},
    "added, encoders": {"action": "added", "condition": "RABBIT", "bandwidth": 160.0, "order": 1},
    "added, MuJoCo": {"action": "added", "plant": "mujoco", "bandwidth": 160.0, "order": 1},
}
SIZES = (64, 8)
REPEATS = 3


def alone(values: dict[str, Any], samples: int) -> float:
    """CPU time [s] of so many samples of one environment, resets among them."""
    env = gymnasium.make(ID, **values)
    env.reset(seed=0)
    actions = np.random.default_rng(0).uniform(-0.02, 0.02, (1000, 4))
    env.step(actions[0])
    begin = time.process_time()
    for k in range(samples):
        *_, fallen, late, _ = env.step(actions[k % 1000])
        if fallen or late:
            env.reset()
    return time.process_time() - begin


def together(values: dict[str, Any], count: int, samples: int) -> float:
    """CPU time [s] of so many samples of a vector of walks."""
    envs = gymnasium.make_vec(ID, num_envs=count, **values)
    envs.reset(seed=0)
    actions = np.random.default_rng(0).uniform(-0.02, 0.02, (1000, count, 4))
    envs.step(actions[0])
    begin = time.process_time()
    for k in range(samples):
        envs.step(actions[k % 1000])
    return time.process_time() - begin


def resets(values: dict[str, Any], count: int) -> float:
    """CPU time [s] of one reset."""
    env = gymnasium.make(ID, **values)
    env.reset(seed=0)
    begin = time.process_time()
    for _ in range(count):
        env.reset()
    return (time.process_time() - begin) / count


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    most = 4_000 if asked.quick else 20_000
    table = Table("Walks for learners", "samples of 1 ms per CPU second", "reset in ms of CPU time")
    for name, values in CASES.items():
        slow = "plant" in values
        samples = most // 20 if slow else most
        taken = min(alone(values, samples) for _ in range(REPEATS))
        table.add(f"{name}, one", speed=samples / taken, reset_ms=1e3 * resets(values, 20))
        for count in () if slow else SIZES:
            each = max(50, samples // count)
            taken = min(together(values, count, each) for _ in range(REPEATS))
            table.add(f"{name}, vector of {count}", speed=each * count / taken)
    table.finish(asked.out)


if __name__ == "__main__":
    main()
