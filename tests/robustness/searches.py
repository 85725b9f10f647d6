"""A search of `biped-adrc tune` on walks: killed at ten moments, and by other workers, against one left alone.

Attacks 0 to 9 kill the command and all of its processes with SIGKILL when a ninth more of the rows is in the
results file each time: the first one with none, the last one with all, while the page is written. The same
command then goes on to its end. Attacks 10 and on search with other workers. Rows, with their places, keys and
values, and the summary with all candidates, the chosen setting and the held-out numbers have to be the same.
"""

from __future__ import annotations

import json
import os
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from contextlib import closing
from functools import lru_cache
from pathlib import Path
from typing import Any

MOMENTS = 10
WAYS: dict[str, tuple[str, ...]] = {
    "1 process": ("--workers", "1"),
    "2 processes": ("--workers", "2"),
    "2 threads": ("--threads", "--workers", "2"),
    "Dask, 2 processes": ("--scheduler",),
}
"""Options by the words for them; a scheduler's address is added."""
ATTACKS = MOMENTS + len(WAYS)
STUDY = """
[study]
name = "killed"
budget = 20
generation = 5
finalists = 3
seed = 1

[fixed]
controller = "LESO"
hardware = "rabbit"
impacts = 4
push = "pulse"
on = "random joints"
amplitude = "30 N m"
pushed_step = 2

[variables]
K_p = { from = 1000.0, to = 9000.0, scale = "log" }
K_d = { from = 30.0, to = 150.0, scale = "log" }
bandwidth = { from = 100.0, to = 500.0, scale = "log" }

[[objectives]]
column = "rms_error"
counts = "made"

[[limits]]
column = "delay_margin"
least = 0.001

[training]
seeds = { from = 0, count = 8 }

[selection]
seeds = { from = 100, count = 4 }

[test]
seeds = { from = 200, count = 4 }
"""
Plain = dict[str, Any]


def judged(k: int) -> Plain:
    """Whether what is left by attack k is what a search left alone leaves."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        if k < MOMENTS:
            wanted = round(len(alone()["rows"]) * k / (MOMENTS - 1))
            found = {"way": "killed", "wanted": wanted, "found": killed(place, wanted)}
            searched(place)
        else:
            way = list(WAYS)[k - MOMENTS]
            found = {"way": way}
            by_dask(place) if "Dask" in way else searched(place, *WAYS[way])
        now, before = left(place), alone()
    same = {name: now[name] == before[name] for name in before}
    return {"k": k, **found, "rows": len(now["rows"]), "same": same}


@lru_cache(maxsize=1)
def alone() -> Plain:
    """What a search leaves that nobody kills."""
    with tempfile.TemporaryDirectory() as folder:
        searched(Path(folder))
        return left(Path(folder))


def command(place: Path, *options: str) -> list[str]:
    """The command, to be called in the folder `place`, where the study is."""
    (place / "study.toml").write_text(STUDY, encoding="utf-8")
    told = ("tune", "study.toml", "--out", "tuned", *(options or WAYS["2 processes"]))
    return [sys.executable, "-m", "biped_adrc", *told]


def searched(place: Path, *options: str) -> None:
    """The command, to its end. Raises CalledProcessError."""
    subprocess.run(command(place, *options), cwd=place, check=True, stdout=subprocess.DEVNULL)


def by_dask(place: Path) -> None:
    """The command on a cluster of this machine."""
    from distributed import LocalCluster

    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with LocalCluster(processes=True, **options) as cluster:
        searched(place, *WAYS["Dask, 2 processes"], cluster.scheduler_address)


def killed(place: Path, wanted: int) -> int:
    """Kill the command and its processes when so many rows are there; how many were.

    Raises RuntimeError where it ended before.
    """
    process = subprocess.Popen(
        command(place), cwd=place, start_new_session=True, stdout=subprocess.DEVNULL
    )
    while rows(place) < wanted and process.poll() is None:
        time.sleep(0.005)
    if process.poll() is not None:
        raise RuntimeError(f"the search ended with {process.returncode} before it was killed")
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    return max(rows(place), 0)


def rows(place: Path) -> int:
    """Rows in the results file so far; -1 where there is none."""
    try:
        with closing(sqlite3.connect(f"file:{place}/tuned/results.sqlite?mode=ro", uri=True)) as db:
            return int(db.execute("SELECT count(*) FROM runs").fetchone()[0])
    except sqlite3.Error:
        return -1


def left(place: Path) -> Plain:
    """Rows, summary but for the command as typed, and setting."""
    text = "SELECT position, key, at, row FROM points JOIN runs USING (key) ORDER BY position"
    with closing(sqlite3.connect(f"file:{place}/tuned/results.sqlite?mode=ro", uri=True)) as db:
        found = db.execute(text).fetchall()
    summary = json.loads((place / "tuned/summary.json").read_text(encoding="utf-8"))
    del summary["command"]
    return {
        "rows": found,
        "summary": json.dumps(summary),
        "setting": (place / "tuned/best.toml").read_text(encoding="utf-8"),
    }


def table(found: list[Plain]) -> str:
    """What was done, and whether all is the same, as Markdown."""
    lines = [
        "| search | rows when it was killed | rows at the end | all the same |",
        "|---|---|---|---|",
    ]
    for x in found:
        same = "yes" if all(x["same"].values()) else "NO"
        lines.append(f"| {x['way']} | {x.get('found', '')} | {x['rows']} | {same} |")
    return "\n".join(lines)


def faults(found: list[Plain]) -> list[str]:
    """A line for each search that left something else."""
    return [f"{x['k']} {x['way']}: {x['same']}" for x in found if not all(x["same"].values())]
