"""Single-line faults put in one at a time: which of them the tests notice. `python benchmarks/mutants.py OUT`.

The operators are those of cosmic-ray. Its runner is not used: laws are traced once and their machine code is
kept, so that coverage cannot choose the tests; mutants.toml says which tests see which folder, the nearest
first, and which survivors were found to be equivalent (why no test can tell) or open (what would). Each fault
is put into a copy of the repository in OUT/copy1, with a code cache of its own that is thrown away with it and
with .pyc that carry their source's hash; the tests stop at the first that fails, which has to pass without the
fault. `--workers 2` has a second copy.

What has been run is in OUT/results.jsonl and is not run again; OUT/draw.json is the draw of the seed.
`--again` runs the survivors once more, after tests were added, but for those found to be equivalent.
`--planted` puts in the faults of faults.toml, which were chosen by hand, and runs the one test that each of
them names. `--report` only prints the tables.
"""

from __future__ import annotations

import argparse
import ast
import compileall
import contextlib
import json
import os
import py_compile
import random
import shutil
import signal
import subprocess
import sys
import time
import tomllib
from collections import Counter, defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from mutations import changed_line, places

HERE = Path(__file__).parent
ROOT = HERE.parent
PACKAGE = "biped_adrc"
CPU_PER_TEST = 120.0
"""CPU time [s] after which a test is taken not to end."""
WALL = 3600.0
"""Wall time [s] after which the tests of a fault are taken not to end; it may be much: machines are shared."""
FAILED = "MUTANTS_FAILED"
"""Environment variable: the file to which pytest writes the name of a test that fails."""
COMPILES = "tests/engine/test_program.py"
"""Tests that fill the code cache once, before the first fault."""

RUNS = (ast.expr, ast.Return, ast.Assign, ast.AnnAssign, ast.Break, ast.Continue)
"""Nodes on whose lines faults are drawn."""

Fault = dict[str, Any]


def pytest_runtest_setup(item: pytest.Item) -> None:
    """As a plugin of pytest: a test that uses more CPU time than any does is killed."""
    signal.setitimer(signal.ITIMER_PROF, CPU_PER_TEST)


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """As a plugin of pytest: tell which test failed."""
    if report.failed:
        Path(os.environ[FAILED]).write_text(report.nodeid)


def draw(seed: int, number: int, least: int) -> list[Fault]:
    """`number` faults, `least` of each folder and the others by the folder's lines, in random order."""
    rng = random.Random(seed)
    folders: dict[str, list[tuple[Path, int]]] = defaultdict(list)
    for path in sorted((ROOT / PACKAGE).rglob("*.py")):
        parts = path.relative_to(ROOT / PACKAGE).parts
        folder = parts[0] if len(parts) > 1 else "."
        folders[folder] += [(path, i) for i in _code_lines(path.read_text(encoding="utf-8"))]
    wanted = [*sorted(folders) * least]
    weights = [len(folders[name]) for name in sorted(folders)]
    wanted += rng.choices(sorted(folders), weights, k=max(0, number - len(wanted)))
    known: dict[Path, Any] = {}
    faults: dict[Any, Fault] = {}
    for folder, count in sorted(Counter(wanted).items()):
        rng.shuffle(folders[folder])
        end = len(faults) + count
        for path, line in folders[folder]:
            text = path.read_text(encoding="utf-8")
            known[path] = known.get(path) or places(text)
            if len(faults) == end:
                break
            if not known[path].get(line):
                continue
            operator, k = rng.choice(known[path][line])
            found = changed_line(text, operator, k)
            if found is None:
                continue
            fault = {
                "folder": folder, "file": str(path.relative_to(ROOT)), "line": found[0],
                "operator": operator.removeprefix("core/"), "before": found[1], "after": found[2],
            }  # fmt: skip
            faults[key(fault)] = fault
    drawn = list(faults.values())
    rng.shuffle(drawn)
    return drawn


def _code_lines(source: str) -> list[int]:
    """Lines (from 1) on which a statement or an expression other than a docstring begins or goes on."""
    lines: set[int] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, RUNS) and not isinstance(node, ast.Constant | ast.Name):
            lines.add(node.lineno)
    return sorted(lines)


class Copy:
    """A copy of the files that git knows, as they are now, in which faults are put in and tests are run."""

    def __init__(self, out: Path, number: int = 1) -> None:
        self.root, self.out = out / f"copy{number}", out / f"worker{number}"
        self.cache = self.out / "cache"
        self.out.mkdir(exist_ok=True)
        listed = subprocess.run(
            ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
            cwd=ROOT, check=True, capture_output=True, text=True,
        )  # fmt: skip
        shutil.rmtree(self.root, ignore_errors=True)
        for name in listed.stdout.splitlines():
            if (ROOT / name).is_file() and not (ROOT / name).is_symlink():
                (self.root / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(ROOT / name, self.root / name)
                shutil.copymode(ROOT / name, self.root / name)
        (self.root / ".venv").symlink_to((ROOT / ".venv").resolve())
        by_hash = py_compile.PycInvalidationMode.CHECKED_HASH
        compileall.compile_dir(self.root / PACKAGE, quiet=1, invalidation_mode=by_hash)
        self.passes: dict[str, bool] = {}

    def tests(self, names: list[str], cache: Path, without: list[str]) -> tuple[int, str]:
        """Exit code of the tests until one fails, and the name of that one."""
        environment = os.environ | {
            "BIPED_ADRC_CACHE": str(cache), "OPENBLAS_NUM_THREADS": "1",
            FAILED: str(self.out / "failed"),
            "PYTHONPATH": f"{self.root}{os.pathsep}{self.root / 'benchmarks'}",
        }  # fmt: skip
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        options = ["-x", "-p", "no:cacheprovider", "-p", "mutants", "--tb=line"]
        deselected = [word for name in without for word in ("--deselect", name)]
        log, named = self.out / "pytest.log", self.out / "failed"
        named.unlink(missing_ok=True)
        with log.open("w") as text:
            process = subprocess.Popen(
                [self.root / ".venv/bin/python", "-m", "pytest", *options, *deselected, *names],
                cwd=self.root, env=environment, stdout=text, stderr=subprocess.STDOUT,
                start_new_session=True,
            )  # fmt: skip
            try:
                code = process.wait(WALL)
            except subprocess.TimeoutExpired:
                code = -signal.SIGKILL
            finally:
                _end(process)
        if code < 0:
            return code, "does not end" if code in (-signal.SIGPROF, -signal.SIGKILL) else "dies"
        failed = named.read_text() if named.exists() else "pytest does not start"
        return code, failed if code else ""

    def verdict(self, fault: Fault, names: list[str]) -> tuple[str, str]:
        """`noticed` and by which test, `survived`, or `gone` where the line is no longer there."""
        path = self.root / fault["file"]
        text = path.read_text(encoding="utf-8")
        changed = put_in(text, fault)
        if changed is None:
            return "gone", ""
        base, cache = self.cache, self.out / "cache_of_the_fault"
        without = [name for name, passes in self.passes.items() if not passes]
        try:
            while True:
                shutil.rmtree(cache, ignore_errors=True)
                if base.exists():
                    shutil.copytree(base, cache)
                path.write_text(changed, encoding="utf-8")
                code, name = self.tests(names, cache, without)
                path.write_text(text, encoding="utf-8")
                if code == 0:
                    return "survived", ""
                if "::" not in name:
                    return "noticed", name
                if name not in self.passes:
                    self.passes[name] = self.tests([name], base, [])[0] == 0
                if self.passes[name]:
                    return "noticed", name
                if name in without:
                    raise SystemExit(f"'{name}' fails without a fault and cannot be left out")
                print(f"  fails without a fault, too: {name}", flush=True)
                without.append(name)
        finally:
            path.write_text(text, encoding="utf-8")
            shutil.rmtree(cache, ignore_errors=True)


def _end(process: subprocess.Popen[bytes]) -> None:
    """End what is left of the session that these tests started."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def put_in(text: str, fault: Fault) -> str | None:
    """The file with the fault, at the line that is nearest to where it was drawn; None: it is not there."""
    before, after = fault["before"], fault["after"]
    if "\n" in before or "line" not in fault:
        return text.replace(before, after, 1) if before in text else None
    lines = text.splitlines(keepends=True)
    at = [i for i, line in enumerate(lines) if line.rstrip("\n") == before]
    if not at:
        return None
    nearest = min(at, key=lambda i: abs(i + 1 - fault["line"]))
    lines[nearest] = after + "\n"
    return "".join(lines)


def key(fault: Fault) -> tuple[str, str, str]:
    """What tells two faults apart, wherever the line has moved."""
    return fault["file"], fault["before"], fault["after"]


def report(faults: list[Fault], results: dict[Any, Fault], judged: list[Fault]) -> str:
    """The table of folders and the survivors, as Markdown."""
    equivalent = {key(f): f["equivalent"] for f in judged if "equivalent" in f}
    open_ = {key(f): f["open"] for f in judged if "open" in f}
    rows = [
        "| folder | faults | noticed | equivalent | open | noticed of those not equivalent |",
        "|---|---|---|---|---|---|",
    ]
    done = [r for f in faults if (r := results.get(key(f))) and r["verdict"] != "gone"]
    survivors = [r for r in done if r["verdict"] == "survived"]
    for folder in [*sorted({r["folder"] for r in done}), "all"]:
        some = [r for r in done if folder in (r["folder"], "all")]
        left = [r for r in survivors if folder in (r["folder"], "all")]
        same = sum(key(r) in equivalent for r in left)
        noticed = len(some) - len(left)
        countable = len(some) - same
        share = f"{100 * noticed / countable:.0f} %" if countable else "none"
        rows.append(
            f"| {folder} | {len(some)} | {noticed} | {same} | {len(left) - same} | {share} |"
        )
    rows.append("")
    for r in sorted(survivors, key=key):
        why = equivalent.get(key(r))
        word = f"equivalent: {why}" if why else f"open {open_.get(key(r), '')}".strip()
        rows += [f"- {r['file']}:{r['line']}, {word}", f"  - before: `{r['before'].strip()}`"]
        rows += [f"  - after: `{r['after'].strip()}`"]
    return "\n".join([*rows, "", f"{len(done)} of {len(faults)} faults have been run."])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path, help="folder of the copy, the draw and the results")
    parser.add_argument("--seed", type=int, default=17)
    parser.add_argument("--number", type=int, default=212, help="faults to draw")
    parser.add_argument("--workers", type=int, default=1, help="faults run at a time")
    parser.add_argument("--least", type=int, default=10, help="faults of each folder")
    parser.add_argument(
        "--limit", type=float, default=1e9, help="minutes after which none is begun"
    )
    for name in ("again", "planted", "report"):
        parser.add_argument(f"--{name}", action="store_true")
    given = parser.parse_args()
    signal.signal(
        signal.SIGINT, signal.default_int_handler
    )  # a job in the background is started without
    out = given.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    settings = tomllib.loads((HERE / "mutants.toml").read_text(encoding="utf-8"))
    if given.planted:
        return planted(Copy(out), given.limit)
    drawn, stored = out / "draw.json", out / "results.jsonl"
    if not drawn.exists():
        faults = draw(given.seed, given.number, given.least)
        drawn.write_text(json.dumps({"seed": given.seed, "faults": faults}, indent=1) + "\n")
    faults = json.loads(drawn.read_text())["faults"]
    lines = stored.read_text().splitlines() if stored.exists() else []
    results = {key(row): row for row in map(json.loads, lines)}
    if not given.report:
        same = {key(f) for f in settings.get("survivor", []) if "equivalent" in f}
        left = [f for f in faults if key(f) not in results or key(f) not in same]
        _run(out, left, results, settings["tests"], given)
    text = report(faults, results, settings.get("survivor", []))
    (out / "report.md").write_text(text + "\n")
    print(text)
    return 0


def _run(out: Path, faults: list[Fault], results: dict[Any, Fault], tests: Any, given: Any) -> None:
    """Run what has not been run; with `again`, the survivors, too."""
    end = time.monotonic() + 60 * given.limit
    copies = [Copy(out, k + 1) for k in range(given.workers)]
    for copy in copies:
        if not copy.cache.exists():
            copy.tests([COMPILES], copy.cache, [])
    verdicts = [results.get(key(fault), {}).get("verdict") for fault in faults]
    left = [
        fault
        for fault, verdict in zip(faults, verdicts, strict=True)
        if verdict is None or (given.again and verdict != "noticed")
    ][::-1]
    with ThreadPoolExecutor(given.workers) as pool:
        for worker in [pool.submit(_work, copy, left, results, tests, end) for copy in copies]:
            worker.result()


def nearest_first(names: list[str], file: str) -> list[str]:
    """The test files of `names`, those first that are called as the module is, or that speak of it."""
    found: list[Path] = []
    for name in names:
        path = ROOT / name
        found += sorted(path.rglob("test_*.py")) if path.is_dir() else [path]
    stem = Path(file).stem
    found.sort(key=lambda p: (stem not in p.stem, stem not in p.read_text(encoding="utf-8")))
    return [str(path.relative_to(ROOT)) for path in dict.fromkeys(found)]


def _work(copy: Copy, left: list[Fault], results: dict[Any, Fault], tests: Any, end: float) -> None:
    """Run the last fault of `left`, which all workers share, while there is time [s, monotonic]."""
    while left and time.monotonic() < end:
        fault = left.pop()
        at = time.monotonic()
        verdict, by = copy.verdict(fault, nearest_first(tests[fault["folder"]], fault["file"]))
        row = {**fault, "verdict": verdict, "by": by, "seconds": round(time.monotonic() - at)}
        results[key(fault)] = row
        with (copy.root.parent / "results.jsonl").open("a") as file:
            file.write(json.dumps(row) + "\n")
        print(
            f"{fault['file']}:{fault['line']} {verdict} {by} {row['seconds']} s",
            flush=True,
        )


def planted(copy: Copy, limit: float) -> int:
    """Each fault of faults.toml with the test that it names: the exit code says whether all are noticed."""
    begin, missed = time.monotonic(), 0
    faults = tomllib.loads((HERE / "faults.toml").read_text(encoding="utf-8"))["fault"]
    for fault in faults:
        if time.monotonic() - begin > 60 * limit:
            print("not all: the time is over")
            return 1
        verdict, by = copy.verdict(fault, [fault["test"]])
        missed += verdict != "noticed"
        print(f"{verdict:<9}{fault['what']} ({fault['file']}) {by}", flush=True)
    print(f"{len(faults) - missed} of {len(faults)} planted faults are noticed")
    return int(missed > 0)


if __name__ == "__main__":
    sys.exit(main())
