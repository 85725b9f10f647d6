"""What every benchmark shares: medians of interleaved rounds, a table on the screen, and a record in JSON.

    python benchmarks/report.py FOLDER CSV

writes the ratios and errors of all records of FOLDER as one CSV, which docs/benchmarks.md shows. A ratio is
the cost of a row over that of the first row of its table, in one run on one machine.
"""

from __future__ import annotations

import argparse
import csv
import io
import json
import math
import multiprocessing
import os
import platform
import re
import resource
import statistics
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Literal, NamedTuple

from rich.console import Console
from rich.table import Table as RichTable

from biped_adrc.core.files import write_text
from biped_adrc.core.versions import packages, versions

NOT_INSTALLED = "not installed: pip install '.[bench]'"
COLUMNS = ("benchmark", "row", "ratio", "error", "note")
"""Columns of the CSV."""

Run = Callable[[], object]


class Seconds(NamedTuple):
    """Medians over rounds [s]; CPU time is that of all threads."""

    wall: float
    CPU: float


@dataclass
class Table:
    """Rows of one benchmark; costs are in milliseconds for one `unit`, ratios of CPU or wall time."""

    name: str
    unit: str
    note: str = ""
    packages: Sequence[str] = ()
    by: Literal["CPU", "wall"] = "CPU"
    rows: list[dict[str, Any]] = field(default_factory=list)

    def add(self, name: str, seconds: Seconds, count: float = 1.0, **values: Any) -> None:
        """One row: `seconds` for `count` units; keys of values become columns, with spaces for underscores."""
        cost = {f"{key} [ms]": 1e3 * x / count for key, x in seconds._asdict().items()}
        key = f"{self.by} [ms]"
        first = next((row[key] for row in self.rows if key in row), cost[key])
        more = {key.replace("_", " "): x for key, x in values.items() if x is not None}
        self.rows.append({"row": name, **cost, "ratio": cost[key] / first, **more})

    def missing(self, name: str) -> None:
        """The row of a peer whose package is not installed."""
        self.rows.append({"row": name, "note": NOT_INSTALLED})

    def finish(self, folder: Path | None) -> None:
        """Print the rows, and write them where a folder is given. Raises OutputError."""
        self.show()
        if folder is not None:
            made = vars(self) | {
                "versions": versions() | packages(self.packages),
                "date": datetime.now(UTC).isoformat(timespec="microseconds"),
                "processor": processor(),
                "cores": len(os.sched_getaffinity(0)),
            }
            name = re.sub(r"[^a-z0-9]+", "_", self.name.lower())
            write_text(folder / f"{name}.json", json.dumps(made, indent=1) + "\n")

    def show(self) -> None:
        """Print the rows, aligned; the notes last."""
        console = Console(width=None if Console().is_terminal else 130)
        keys = dict.fromkeys(key for row in self.rows for key in row)
        columns = sorted(keys, key=lambda key: key == "note")
        shown = RichTable(title=f"{self.name}, one {self.unit}", caption=self.note or None)
        for key in columns:
            side: Literal["left", "right"] = "left" if key in ("row", "note") else "right"
            shown.add_column(key.replace("[", r"\["), justify=side)
        for row in self.rows:
            shown.add_row(*(figures(row.get(key)).replace("[", r"\[") for key in columns))
        console.print(shown)


def arguments(about: str | None) -> argparse.ArgumentParser:
    """A parser with OUT and --quick."""
    parser = argparse.ArgumentParser(
        description=about, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path, nargs="?", help="folder for the JSON records")
    parser.add_argument("--quick", action="store_true", help="few rows and rounds, some seconds")
    return parser


def rounds(runs: Mapping[str, Run], count: int, budget: float = math.inf) -> dict[str, Seconds]:
    """Medians of each run, made once per round so that all meet the same machine.

    A run that has used up its budget [s] sits the later rounds out.
    """
    times: dict[str, list[Seconds]] = {name: [] for name in runs}
    for _ in range(count):
        for name, run in runs.items():
            if sum(one.wall for one in times[name]) < budget:
                times[name].append(spent(run))
    return {name: median(found) for name, found in times.items()}


def median(times: Sequence[Seconds]) -> Seconds:
    """Of wall and of CPU times."""
    return Seconds(*map(statistics.median, zip(*times, strict=True)))


def spent(run: Run) -> Seconds:
    """Wall time of a call, and CPU time of this process and of its children that end within it."""
    begin, used = time.perf_counter(), _used()
    run()
    return Seconds(time.perf_counter() - begin, _used() - used)


def _used() -> float:
    """CPU time of this process and of its children that have ended [s]."""
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + ended.ru_utime + ended.ru_stime


def repeated(run: Run, count: int) -> Run:
    """A run that makes so many."""

    def runs() -> None:
        for _ in range(count):
            run()

    return runs


@contextmanager
def forked(number: int = 2) -> Iterator[Executor]:
    """Processes that are children of this one, so that their CPU time is counted when they end."""
    with ProcessPoolExecutor(number, multiprocessing.get_context("fork")) as executor:
        yield executor


def figures(value: Any) -> str:
    """Three figures of a number, everything else as it stands."""
    if value is None:
        return ""
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def processor() -> str:
    """The processor's name where the system gives it."""
    try:
        text = Path("/proc/cpuinfo").read_text()
    except OSError:
        text = ""
    found = re.search(r"^model name\s*:\s*(.+)$", text, re.MULTILINE)
    return found.group(1) if found else platform.processor() or platform.machine()


def main() -> None:
    """Write the CSV of a folder of records, in the order in which they were made."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="JSON records of the benchmarks")
    parser.add_argument("csv", type=Path, help="file that is written")
    asked = parser.parse_args()
    records = [json.loads(path.read_text()) for path in asked.folder.glob("*.json")]
    lines = io.StringIO()
    table = csv.writer(lines, lineterminator="\n")
    table.writerow(COLUMNS)
    for record in sorted(records, key=lambda record: record["date"]):
        for row in record["rows"]:
            table.writerow([record["name"], *(figures(row.get(key)) for key in COLUMNS[1:])])
    write_text(asked.csv, lines.getvalue())


if __name__ == "__main__":
    main()
