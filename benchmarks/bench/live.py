"""A session by hand: simulated seconds per CPU second, how long a change takes, and memory over ten minutes.

Run: python benchmarks/bench/live.py [OUT] [--quick]

RABBIT at 1 kHz on the published gait under ADRC; with a ghost the other walk is NPD. `pulled`: a spring at the
torso, whose anchor moves at every 16th sample, as a mouse does at 60 Hz. `slow` is the time of a sample that
1 % of samples exceed. `change` is from ADRC to NPD or back, with machine code at hand: median and longest of
20. `memory` is what the process has taken more after a session of `walked` seconds than before.
"""

from __future__ import annotations

import os
import statistics
import sys
import time
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report import Table, arguments

import biped_adrc as ba

CASES: dict[str, dict[str, Any]] = {
    "rigid": {},
    "encoders, limits": {"hardware": "rabbit", "bandwidth": 160.0, "order": 1},
    "MuJoCo": {"plant": "mujoco", "bandwidth": 160.0, "order": 1, "torque_limit": 150.0},
}


def session(values: dict[str, Any], ghost: bool) -> ba.Session:
    """A session that has walked for a moment, so that all is compiled."""
    s = ba.Scenario("ADRC", **{"hardware": "ideal"} | values)
    made = ba.Session(s, {"controller": "NPD"} if ghost else None)
    made.advance(0.05)
    return made


def pulled(made: ba.Session) -> None:
    """Move the hand: a spring at the torso, whose anchor keeps a little ahead."""
    x, z = made.walking[0].foot
    made.pull("torso", (0.0, 0.2), (float(x) + 0.15, float(z) + 1.2))


def sampled(made: ba.Session, seconds: float, pull: bool) -> list[float]:
    """CPU times [s] of the samples of so many seconds."""
    times, until = [], made.t + seconds
    while made.walks and made.t < until:
        begin = time.process_time()
        if pull and made.samples % 16 == 0:
            pulled(made)
        made.sample()
        times.append(time.process_time() - begin)
    return times


def changes(made: ba.Session) -> list[float]:
    """CPU times [s] of changes of the controller there and back."""
    values = {
        "bandwidth": made.walking[0].scenario.bandwidth,
        "order": made.walking[0].scenario.order,
    }
    found = []
    for k in range(22):
        given = {"controller": "NPD"} if k % 2 == 0 else {"controller": "ADRC", **values}
        begin = time.process_time()
        made.change(**given)
        found.append(time.process_time() - begin)
        made.advance(0.01)
    return found[2:]


def resident() -> float:
    """Memory of this process [MB]."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return 1e-6 * pages * os.sysconf("SC_PAGESIZE")


def main() -> None:
    """Print the tables, and write them when asked."""
    asked = arguments(__doc__).parse_args()
    table = Table("Walks by hand", "simulated s per CPU s", "times in us and ms of CPU time")
    for name, values in CASES.items():
        for ghost in (False, True):
            made = session(values, ghost)
            for pull in (False, True):
                times = sampled(made, 0.5 if asked.quick else 3.0, pull)
                made.let_go()
                table.add(
                    f"{name}{', ghost' if ghost else ''}{', pulled' if pull else ''}",
                    speed=1e-3 / statistics.mean(times),
                    sample_us=1e6 * statistics.mean(times),
                    slow_us=1e6 * statistics.quantiles(times, n=100)[98],
                    status=made.walking[0].status.name,
                )
        took = changes(session(values, False))
        table.add(
            f"{name}, change",
            change_ms=1e3 * statistics.median(took),
            longest_ms=1e3 * max(took),
        )
    table.finish(asked.out)
    made, before = session({}, True), resident()
    made.advance(10.0 if asked.quick else 600.0)
    memory = Table("Memory of a session", "MB")
    memory.add("rigid, ghost", walked_s=made.t, memory=resident() - before, marks=len(made.marks))
    memory.finish(asked.out)


if __name__ == "__main__":
    main()
