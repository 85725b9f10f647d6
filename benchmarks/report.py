"""What every benchmark shares: medians of interleaved rounds, a table on the screen, a record in JSON.

A record is `{name, unit, note, columns, rows, versions, date, processor, cores}`, one file per table. Judge by
the ratios of one run, and by CPU time where other work shares the machine: wall time favours short runs then.
"""

from __future__ import annotations

import argparse
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
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, NamedTuple

from rich.console import Console
from rich.table import Table as RichTable

from biped_adrc.files import write_text
from biped_adrc.versions import versions

NOT_INSTALLED = "not installed: pip install 'biped-adrc[bench]'"
_WIDTH = 130  # of a table that is not printed on a terminal

Row = dict[str, Any]


class Seconds(NamedTuple):
    """Medians over rounds [s]; CPU time tells what other work on the machine hides in wall time."""

    wall: float
    cpu: float
    rounds: int


@dataclass
class Table:
    """Rows of one benchmark; the columns are the rows' keys in the order of their first use."""

    name: str
    unit: str
    note: str = ""
    packages: Sequence[str] = ()
    rows: list[Row] = field(default_factory=list)

    def add(self, name: str, **values: Any) -> None:
        """One row; keys become columns, with spaces for their underscores."""
        self.rows.append({"name": name} | {key.replace("_", " "): v for key, v in values.items()})

    def missing(self, name: str) -> None:
        """The row of a peer whose package is not there."""
        self.add(name, note=NOT_INSTALLED)

    @property
    def columns(self) -> list[str]:
        """Keys of all rows, the notes last."""
        keys = list(dict.fromkeys(key for row in self.rows for key in row))
        return sorted(keys, key=lambda key: key == "note")

    def show(self) -> None:
        """Print the rows, aligned."""
        console = Console(width=None if Console().is_terminal else _WIDTH)
        title = f"{self.name} [{self.unit}]"
        table = RichTable(title=_plain(title), caption=_plain(self.note) or None)
        for key in self.columns:
            table.add_column(_plain(key), justify="left" if key in ("name", "note") else "right")
        for row in self.rows:
            table.add_row(*(_plain(figure(row.get(key))) for key in self.columns))
        console.print(table)

    def write(self, folder: Path) -> Path:
        """The record, whole or not at all. Raises OutputError."""
        path = folder / (re.sub(r"[^a-z0-9]+", "_", self.name.lower()).strip("_") + ".json")
        record = {
            "name": self.name,
            "unit": self.unit,
            "note": self.note,
            "columns": self.columns,
            "rows": self.rows,
            "versions": versions() | _versions_of(self.packages),
            "date": datetime.now(UTC).isoformat(timespec="seconds"),
            "processor": processor(),
            "cores": len(os.sched_getaffinity(0)),
        }
        write_text(path, json.dumps(record, indent=1) + "\n")
        return path

    def finish(self, folder: Path | None) -> None:
        """Show, and write where a folder was given."""
        self.show()
        if folder is not None:
            self.write(folder)


def arguments(about: str | None) -> argparse.ArgumentParser:
    """A parser with OUT and --quick."""
    parser = argparse.ArgumentParser(
        description=about, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path, nargs="?", help="folder for the JSON records")
    parser.add_argument("--quick", action="store_true", help="few rounds, for a short look")
    return parser


def rounds(
    runs: Mapping[str, Callable[[], object]], count: int, budget: float = math.inf
) -> dict[str, Seconds]:
    """Medians of each run, made once per round so that all meet the same machine.

    A run that has used up its budget [s] sits the later rounds out.
    """
    times: dict[str, list[tuple[float, float]]] = {name: [] for name in runs}
    for _ in range(count):
        for name, run in runs.items():
            if sum(wall for wall, _ in times[name]) < budget:
                begin, used = time.perf_counter(), time.process_time()
                run()
                wall, cpu = time.perf_counter() - begin, time.process_time() - used
                times[name].append((wall, cpu))
    return {name: _medians(found) for name, found in times.items()}


@contextmanager
def forked(number: int = 2) -> Iterator[Executor]:
    """Processes that are children of this one, so that their CPU time is counted when they end."""
    with ProcessPoolExecutor(number, multiprocessing.get_context("fork")) as executor:
        yield executor


def spent(run: Callable[[], object]) -> Seconds:
    """Wall time of a call, and CPU time of this process and of its children that end within it."""
    begin, used = time.perf_counter(), _used()
    run()
    return Seconds(time.perf_counter() - begin, _used() - used, 1)


def _used() -> float:
    """CPU time of this process and of its children that have ended [s]."""
    both = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(one.ru_utime + one.ru_stime for one in both)


def _medians(times: Sequence[tuple[float, float]]) -> Seconds:
    wall, cpu = (statistics.median(part) for part in zip(*times, strict=True))
    return Seconds(wall, cpu, len(times))


def microseconds(function: Callable[[], object], batch: int = 1000, repeats: int = 7) -> float:
    """Median CPU time of one call over batches [us]."""
    function()
    found = []
    for _ in range(repeats):
        begin = time.process_time()
        for _ in range(batch):
            function()
        found.append((time.process_time() - begin) / batch)
    return 1e6 * statistics.median(found)


def figure(value: Any) -> str:
    """Three figures of a number, everything else as it stands."""
    if value is None:
        return ""
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def processor() -> str:
    """The processor's name where the system tells it."""
    try:
        text = Path("/proc/cpuinfo").read_text()
    except OSError:
        text = ""
    found = re.search(r"^model name\s*:\s*(.+)$", text, re.MULTILINE)
    return found.group(1) if found else platform.processor() or platform.machine()


def _plain(text: str) -> str:
    """Brackets are markup to rich."""
    return text.replace("[", r"\[")


def _versions_of(packages: Sequence[str]) -> dict[str, str]:
    found = {}
    for package in packages:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "not installed"
    return found
