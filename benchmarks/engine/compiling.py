"""What the first use costs: importing, compiling, loading from the cache, and the reproduction of the paper.

Scenario: python benchmarks/engine/compiling.py [OUT] [--quick] [--full]

Every row is a new process: with an empty folder for machine code (cold), and again with what it left there. The
reproduction is that of `biped-adrc reproduce --quick`; with --full, of `biped-adrc reproduce`.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from cases import load
from report import Table, arguments

from biped_adrc.engine.machine import VARIABLE

FIRST_STEP = """
import json, time
begin = time.perf_counter()
import biped_adrc as ba
from biped_adrc.paper.plan import PAPER_PUSH
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.run import method_of
from biped_adrc.scenario.scenario import Scenario
run = Scenario("ADRC", pushes=(PAPER_PUSH,), period=PERIOD, first_step=19)
scene = RobotAndGait.of(run)
walker, gait = build(run, scene), scene.walked
ready = time.perf_counter()
ba.walk(walker, gait, 1, method_of(run, walker), first_step=19, engine="compiled")
walked = time.perf_counter()
ba.walk(walker, gait, 1, method_of(run, walker), first_step=19, engine="compiled")
again = time.perf_counter()
print(json.dumps({"ready": ready - begin, "first": walked - ready, "again": again - walked}))
"""
"""The pushed step of the paper, alone."""


def timed(command: list[str], cache: Path) -> tuple[float, str]:
    """Wall time of a process [s], and what it printed. Raises CalledProcessError."""
    begin = time.perf_counter()
    made = subprocess.run(
        command,
        env={**os.environ, VARIABLE: str(cache)},
        capture_output=True,
        text=True,
        check=True,
    )
    return time.perf_counter() - begin, made.stdout


def imports(cache: Path, repeats: int) -> dict[str, float]:
    """Seconds of `import biped_adrc` and of Python alone, medians."""
    commands = {"import biped_adrc": "import biped_adrc", "Python alone": "pass"}
    return {
        name: statistics.median(
            timed([sys.executable, "-c", text], cache)[0] for _ in range(repeats)
        )
        for name, text in commands.items()
    }


def first_step(cache: Path, period: float | None) -> tuple[float, dict[str, Any]]:
    """Wall time of the process, and its parts."""
    wall, text = timed([sys.executable, "-c", f"PERIOD = {period}\n{FIRST_STEP}"], cache)
    return wall, json.loads(text)


def main() -> None:
    """Print the table, and write it when asked."""
    parser = arguments(__doc__)
    parser.add_argument("--full", action="store_true", help="the whole reproduction")
    asked = parser.parse_args()
    table = Table("Compiling", "s", load(), ("numba", "llvmlite"))
    with tempfile.TemporaryDirectory() as folder:
        for name, seconds in imports(Path(folder), 3 if asked.quick else 7).items():
            table.add(name, process=seconds)
    for name, period in (("ADRC, continuous, push", None), ("ADRC at 1 kHz, push", 1e-3)):
        with tempfile.TemporaryDirectory() as folder:
            for kind in ("cold", "from the cache", "from the cache, again"):
                wall, parts = first_step(Path(folder), period)
                table.add(
                    f"{name}, {kind}",
                    process=wall,
                    imports_and_robot=parts["ready"],
                    first_step=parts["first"],
                    the_same_step_again=parts["again"],
                )
    reproduced(table, asked.full)
    table.finish(asked.out)


def reproduced(table: Table, full: bool) -> None:
    """The reproduction, twice."""
    options = [] if full else ["--quick"]
    with tempfile.TemporaryDirectory() as folder:
        for kind in ("cold", "from the cache"):
            out = str(Path(folder) / f"out {kind}")
            command = [str(Path(sys.executable).parent / "biped-adrc"), "reproduce", "--out", out]
            try:
                wall, _ = timed([*command, *options], Path(folder) / "cache")
            except subprocess.CalledProcessError as error:
                note = f"ended with {error.returncode}: {error.stderr.strip()[-120:]}"
                table.add(f"reproduce {' '.join(options)}, {kind}", note=note)
            else:
                table.add(f"reproduce {' '.join(options)}, {kind}", process=wall)


if __name__ == "__main__":
    main()
