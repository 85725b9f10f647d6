"""How long a command goes on after Ctrl-C and SIGTERM, and whether it shows a traceback.

    .venv/bin/python benchmarks/interrupts.py [--early]

Each command is started in a process group of its own, with SIGINT as a terminal leaves it, and after
some seconds the whole group gets Ctrl-C, or the command alone SIGTERM. The aim is 2 s; exit code 1 above
10 s, or with a traceback or a process left. --early: a sweep is interrupted at many moments of its start.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import psutil

COMMANDS = (
    "simulate --impacts 5000 --step 1e-5",
    "simulate --engine pinocchio --impacts 500",
    "poincare --controller ADRC",
    "gait design --speed 0.7 --nodes 60",
    "gait library",
    "observer --confirm",
    "sweep study.toml --out sweep",
    "compare --out compared",
    "reproduce --out out",
)
STUDY = """
[study]
name = "long"
seeds = 400
[fixed]
controller = "ADRC"
impacts = 200
"""
LONGEST = 10.0


def interrupted(line: str, after: float, number: signal.Signals, folder: Path) -> tuple[float, str]:
    """Seconds from the signal to the end of the command and its children, and what is wrong, if anything."""
    command = [sys.executable, "-m", "biped_adrc", *line.split()]
    process = subprocess.Popen(
        command,
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    time.sleep(after)
    if process.poll() is not None:
        return 0.0, f"ended by itself, {process.returncode}"
    family = psutil.Process(process.pid).children(recursive=True)
    began = time.monotonic()
    if number == signal.SIGINT:
        os.killpg(process.pid, number)
    else:
        process.send_signal(number)
    try:
        _, stderr = process.communicate(timeout=60.0)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return 60.0, "goes on"
    while (left := [p for p in family if alive(p)]) and time.monotonic() - began < 10.0:
        time.sleep(0.02)  # psutil's own wait looks once a second
    took = time.monotonic() - began
    if left:
        os.killpg(process.pid, signal.SIGKILL)
        return took, f"{len(left)} processes left"
    return took, "traceback" if "Traceback" in stderr else ""


def alive(process: psutil.Process) -> bool:
    """Whether it runs: one that has ended, and that nobody has asked for, does not."""
    try:
        return process.is_running() and process.status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False


def main() -> int:
    """Print a table; the exit code."""
    moments = [0.2 * k for k in range(1, 21)]
    early = "--early" in sys.argv
    lines = ["sweep study.toml --out sweep"] * len(moments) if early else COMMANDS
    bad = 0
    print("| command | after [s] | signal | ends in [s] | |\n|---|---|---|---|---|")
    for k, line in enumerate(lines):
        for number in (signal.SIGINT,) if early else (signal.SIGINT, signal.SIGTERM):
            with tempfile.TemporaryDirectory() as place:
                folder = Path(place)
                (folder / "study.toml").write_text(STUDY, encoding="utf-8")
                after = moments[k] if early else 6.0
                took, wrong = interrupted(line, after, number, folder)
            bad += took > LONGEST or wrong in ("traceback", "goes on") or "left" in wrong
            print(f"| `{line}` | {after:.1f} | {number.name} | {took:.1f} | {wrong} |", flush=True)
    return min(bad, 1)


if __name__ == "__main__":
    sys.exit(main())
