"""What the first use costs: importing, compiling, and loading machine code from the cache.

Run: python benchmarks/compiling.py [OUT] [--quick]

Every row is a new process. "First use" has an empty folder for machine code, "from the cache" what it left
there; --quick has the user's own folder alone. One step of ADRC is walked, then walked again: columns in ms
of wall time.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from report import Table, arguments, median, spent
from walks import load

from biped_adrc.engine.machine import VARIABLE

STEP = """
import json, time
begin = time.perf_counter()
import biped_adrc as ba
from walks import setting
found = setting(**{"hardware.period": PERIOD})
method = ba.RK4(1e-3) if PERIOD else ba.Exponential(5e-4)
times = [begin, time.perf_counter()]
for _ in range(2):
    ba.walk(found.walker, found.gait, 1, method, engine="compiled")
    times.append(time.perf_counter())
print(json.dumps([1e3 * (b - a) for a, b in zip(times, times[1:])]))
"""
COLUMNS = ("imports and robot", "first step", "same step again")
PERIODS = {"ADRC at 1 kHz": 1e-3, "ADRC in continuous time": None}


def add(table: Table, name: str, program: str, cache: Path | None, repeats: int = 1) -> None:
    """The row of a process, its times medians; it prints the times of its parts or nothing."""
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parent)}
    if cache is not None:
        environment[VARIABLE] = str(cache)
    printed: list[str] = []

    def run() -> None:
        command = [sys.executable, "-c", program]
        made = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
        printed.append(made.stdout)

    seconds = median([spent(run) for _ in range(repeats)])
    parts = dict(zip(COLUMNS, json.loads(printed[-1]), strict=True)) if printed[-1] else {}
    table.add(name, seconds, **parts)


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    table, repeats = Table("Compiling", "process", load(), ("numba", "llvmlite")), 7
    if asked.quick:
        repeats = 1
    add(table, "import biped_adrc", "import biped_adrc", None, repeats)
    add(table, "Python alone", "pass", None, repeats)
    for name, period in PERIODS.items():
        program = f"PERIOD = {period}\n{STEP}"
        if asked.quick:
            add(table, f"{name}, from the cache", program, None)
            continue
        with tempfile.TemporaryDirectory() as folder:
            add(table, f"{name}, first use", program, Path(folder))
            add(table, f"{name}, from the cache", program, Path(folder), 3)
    table.finish(asked.out)


if __name__ == "__main__":
    main()
