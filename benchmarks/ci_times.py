"""CPU and wall time of the tests by file: `python benchmarks/ci_times.py OUT [options of pytest]`.

A test is charged with the CPU time that its worker and all of its child processes used since the test before:
its own, and that of the fixtures and the compiling which it is the first to need. The table shows the largest
files; OUT/ci_times.json has every file and test. `--before FILE` puts an earlier one beside.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections import defaultdict
from pathlib import Path

import psutil
import pytest

LARGEST = 20


def used(process: psutil.Process) -> float:
    """CPU time [s] of a process and its descendants, those that have ended included."""
    total = 0.0
    for one in (process, *process.children(recursive=True)):
        try:
            total += sum(one.cpu_times()[:4])
        except psutil.Error:  # ended meanwhile: its parent has its time
            continue
    return total


class InWorker:
    """What each test costs, as properties of its last report."""

    def __init__(self) -> None:
        self.process = psutil.Process()
        self.before = 0.0  # imports and collection are charged to the first test

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item):
        start = time.perf_counter()
        self.item, self.start = item, start
        return (yield)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_makereport(self, item, call):
        report = yield
        if report.when == "teardown":
            now = used(self.process)
            cost = (max(0.0, now - self.before), time.perf_counter() - self.start)
            report.user_properties.append(("cost", cost))
            self.before = now
        return report


class Table:
    """The costs of all workers, written at the end."""

    def __init__(self) -> None:
        self.tests: dict[str, tuple[float, float]] = {}

    def pytest_runtest_logreport(self, report):
        for name, cost in report.user_properties:
            if name == "cost" and report.when == "teardown":
                self.tests[report.nodeid] = tuple(cost)


def pytest_configure(config):
    """As a plugin: in every process that runs tests."""
    config.pluginmanager.register(InWorker(), "ci_times_worker")


def by_file(tests: dict[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
    """CPU and wall time [s] of each file."""
    files: dict[str, tuple[float, float]] = defaultdict(lambda: (0.0, 0.0))
    for name, (cpu, wall) in tests.items():
        file = name.split("::")[0]
        files[file] = (files[file][0] + cpu, files[file][1] + wall)
    return dict(sorted(files.items(), key=lambda pair: -pair[1][0]))


def lines(files: dict[str, tuple[float, float]], before: dict[str, list[float]]) -> list[str]:
    """The table: CPU and wall time [s] of the largest files, and before."""
    rows = [f"{'file':<44}{'CPU [s]':>9}{'wall [s]':>9}{'before':>9}"]
    names = sorted(
        {*files, *before},
        key=lambda name: -max(files.get(name, (0,))[0], before.get(name, (0,))[0]),
    )
    for name in names[:LARGEST]:
        cpu, wall = files.get(name, (0.0, 0.0))
        then = f"{before[name][0]:9.1f}" if name in before else ""
        rows.append(f"{name:<44}{cpu:9.1f}{wall:9.1f}{then}")
    total = [sum(pair[k] for pair in files.values()) for k in (0, 1)]
    then = f"{sum(pair[0] for pair in before.values()):9.1f}" if before else ""
    rows.append(f"{'all':<44}{total[0]:9.1f}{total[1]:9.1f}{then}")
    return rows


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path, help="folder of ci_times.json")
    parser.add_argument("--before", type=Path, help="ci_times.json of an earlier run")
    arguments, options = parser.parse_known_args()
    table = Table()
    sys.path.insert(0, str(Path(__file__).parent))  # where workers find the plugin, too
    code = pytest.main(
        ["-p", "ci_times", "--dist", "loadgroup", "--no-loadscope-reorder", *options],
        plugins=[table],
    )
    files = by_file(table.tests)
    before = json.loads(arguments.before.read_text())["files"] if arguments.before else {}
    print("\n".join(lines(files, before)))
    arguments.out.mkdir(parents=True, exist_ok=True)
    report = {"files": files, "tests": table.tests}
    (arguments.out / "ci_times.json").write_text(json.dumps(report, indent=1) + "\n")
    return int(code)


if __name__ == "__main__":
    sys.exit(main())
