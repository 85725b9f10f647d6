"""Damaged files and nonsense on the command line: each is read right or refused with one sentence.

    python -m tests.fuzz [NUMBER] [SEED]      # `make fuzz`: 500 of each kind, 2000 random walks twice

Prints a table: how many were read, read with what the damage says (a number changed), and refused. Exit code 1
for anything else: another exception, a result that is short without a word, more than 5 s for a nonsense.
"""

from __future__ import annotations

import io
import json
import random
import re
import signal
import sqlite3
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import chdir, contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import psutil
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.bench.study_file import load_study
from biped_adrc.bench.sweep import load_sweep
from biped_adrc.cli import app
from biped_adrc.engine import machine
from biped_adrc.errors import BipedError
from biped_adrc.resources import data_folder

LONGEST = 5.0
WEIRD = (
    None,
    True,
    -1,
    0,
    1e308,
    -1e308,
    10**400,
    "",
    "nan",
    [],
    {},
    [[]],
    "\x1b[2J",
    "$x_{$",
    "é" * 500,
    ".." * 9,
)
NONSENSE = (
    "nan",
    "-1",
    "1e999",
    "",
    "[/b]",
    "../../x",
    "/dev/null",
    "é$x",
    "9" * 30,
    "q9=x@y",
    "a:b:c",
    "\x1b[2J",
    "0x",
)
STUDY = """
[study]
name = "walks"
description = "for a fuzz"
seeds = 2
[fixed]
impacts = 1
[grid]
controller = ["NPD"]
period = [ "1 ms", "2 ms" ]
"""


def bytes_changed(draw: random.Random, data: bytes) -> bytes:
    """Bits flipped, a part exchanged, cut out or doubled, or the end cut off."""
    out, at = bytearray(data), draw.randrange(len(data))
    kind, length = draw.randrange(5), draw.choice([1, 4, 40, 400])
    if kind == 0:
        out[at] ^= 1 << draw.randrange(8)
    elif kind == 1:
        out[at : at + length] = draw.randbytes(length)
    elif kind == 2:
        del out[at : at + length]
    elif kind == 3:
        out[at:at] = out[at : at + length]
    else:
        del out[at:]
    return bytes(out)


def plain_changed(draw: random.Random, value: Any) -> Any:
    """A value of JSON with one entry, somewhere in it, exchanged, removed or doubled."""
    if isinstance(value, dict) and value and draw.random() < 0.9:
        key = draw.choice(list(value))
        changed = {k: v for k, v in value.items() if k != key or draw.random() < 0.8}
        return {**changed, key: plain_changed(draw, value[key])} if key in changed else changed
    if isinstance(value, list) and value and draw.random() < 0.7:
        at = draw.randrange(len(value))
        return [
            *value[:at],
            plain_changed(draw, value[at]),
            *value[at + draw.choice([0, 1, 1, 1]) :],
        ]
    return draw.choice(WEIRD)


def run_changed(draw: random.Random, data: bytes) -> bytes:
    """A run with bytes changed, or whole as a file with one array or its record changed."""
    if draw.random() < 0.3:
        return bytes_changed(draw, data)
    with np.load(io.BytesIO(data)) as found:
        arrays = dict(found)
    name = draw.choice(list(arrays))
    if name in ("meta", "beside.walker"):
        arrays[name] = np.array(json.dumps(plain_changed(draw, json.loads(str(arrays[name])))))
    else:
        x = arrays[name]
        ways: list[Callable[[], Any]] = [
            lambda: x * np.nan,
            lambda: x[::-1],
            lambda: x[:-1],
            lambda: x.astype(complex),
            lambda: x.astype(str),
            lambda: x * 1e12,
            lambda: x.astype(int),
            lambda: x[..., None],
            lambda: x * 0.0,
        ]
        arrays[name] = draw.choice(ways)()
        if draw.random() < 0.1:
            del arrays[name]
    out = io.BytesIO()
    np.savez(out, **arrays)
    return out.getvalue()


def json_changed(draw: random.Random, data: bytes) -> bytes:
    """A file of JSON with bytes or one entry changed."""
    if draw.random() < 0.3:
        return bytes_changed(draw, data)
    return json.dumps(plain_changed(draw, json.loads(data))).encode()


def text_changed(draw: random.Random, data: bytes) -> bytes:
    """Text with bytes changed, or one number or word exchanged."""
    if draw.random() < 0.4:
        return bytes_changed(draw, data)
    words = data.decode().split(" ")
    words[draw.randrange(len(words))] = str(draw.choice((*WEIRD, *NONSENSE)))
    return " ".join(words).encode(errors="replace")


def store_changed(draw: random.Random, data: bytes) -> bytes:
    """A results file with bytes changed, or a row removed or changed."""
    if draw.random() < 0.7:
        return bytes_changed(draw, data)
    with tempfile.TemporaryDirectory() as place, chdir(place):
        path = Path(place) / "r.sqlite"
        path.write_bytes(data)
        with sqlite3.connect(path) as db:
            table = draw.choice(["runs", "points", "study", "versions"])
            column = draw.choice([row[1] for row in db.execute(f"PRAGMA table_info({table})")])
            change = draw.choice(["DELETE FROM {t}", "UPDATE {t} SET {c} = {c} || 'x'"])
            try:
                db.execute(change.format(t=table, c=column))
            except sqlite3.IntegrityError:
                db.execute(f"DELETE FROM {table}")
        db.close()
        return path.read_bytes()


@contextmanager
def files(folder: Path) -> Iterator[dict[str, tuple[Path, Any, Any]]]:
    """By kind: a file that is whole, what changes its bytes, and what reads it into a value to be compared."""
    biped = ba.Biped.load("rabbit")
    run = ba.walk_scenario(ba.Scenario("NPD", engine="compiled", impacts=1)).save(folder / "a.npz")
    gait, study, robot = folder / "a.json", folder / "a.toml", folder / "robot.toml"
    ba.load_gait("published", biped).save(gait)
    study.write_text(STUDY)
    for path in (data_folder("urdf") / "rabbit").iterdir():
        (folder / path.name).write_bytes(path.read_bytes())
    done = CliRunner().invoke(app, ["sweep", str(study), "--out", str(folder / "s"), "--threads"])
    assert done.exit_code == 0, done.output
    store, code = folder / "s" / "results.sqlite", machine._path("fuzz")
    machine.keep("fuzz", bytes(range(256)) * 8)

    def read_run(path: Path) -> object:
        walk = ba.load_walk(path)
        return [
            (arc.t.tobytes(), arc.x.tobytes()) for arc in walk.trajectory.arcs
        ], walk.signals.u.shape

    def read_store(path: Path) -> object:
        return load_sweep(path).statuses()

    def read_robot(path: Path) -> object:
        return ba.Biped.load(str(robot)).mass

    yield {
        "run": (run, run_changed, read_run),
        "gait": (gait, json_changed, lambda path: ba.load_gait(path, biped).q_minus.tobytes()),
        "study": (study, text_changed, lambda path: load_study(path).hash),
        "store": (store, store_changed, read_store),
        "cache": (code, bytes_changed, lambda path: machine.stored("fuzz")),
        "robot record": (robot, text_changed, read_robot),
        "URDF": (folder / "floating.urdf", text_changed, read_robot),
    }
    code.unlink(missing_ok=True)


def damage(kind: str, number: int, seed: int, folder: Path) -> tuple[Counter[str], list[str]]:
    """How so many damaged files of a kind were met, and what was wrong."""
    draw, found, wrong = random.Random(f"{kind} {seed}"), Counter[str](), list[str]()
    with files(folder) as every:
        path, change, read = every[kind]
        whole, expected = path.read_bytes(), read(path)
        for k in range(number):
            data = change(draw, whole)
            path.write_bytes(data)
            try:
                value = read(path)
            except BipedError as error:
                found["refused"] += 1
                if "Traceback" in str(error) or len(str(error)) > 4000:
                    wrong.append(f"{kind} {k}: {str(error)[:200]}")
            except Exception as error:  # what this looks for
                wrong.append(f"{kind} {k}: {type(error).__name__}: {str(error)[:200]}")
            else:
                same = value == expected
                found["refused" if value is None else "read" if same else "read as changed"] += 1
                if not same and value is not None and kind in ("store", "cache"):
                    wrong.append(f"{kind} {k}: read otherwise without a word")
        path.write_bytes(whole)
    return found, wrong


LINES = (
    "simulate --engine compiled --impacts 1",
    "simulate --plant mujoco --period 1e-3 --controller NPD --impacts 1 --set contact=hold",
    "simulate --period 1e-3 --set touchdown=told --impacts 1",
    "poincare --samples 3",
    "gait show",
    "gait zero",
    "gait export published -o g.json",
    "gait import g.json",
    "gait design --speed 0.6",
    "observer",
    "robot show rabbit",
    "robot export rabbit --mjcf a.xml",
    "robot check a.urdf",
    "robot new a.urdf -o own",
    "plot a.npz",
    "animate a.npz",
    "sweep a.toml --out s",
    "compare --out c",
    "compare --plant mujoco --out c",
    "reproduce --out r",
)


def options_of(words: list[str]) -> list[str]:
    """The options of the command that begins with these words, as its help lists them."""
    names = words[: 2 if words[0] in ("gait", "robot") else 1]
    text = CliRunner().invoke(app, [*names, "--help"]).output
    return sorted(set(re.findall(r"--[a-z][\w-]+", text)) - {"--help"})


def lines(number: int, seed: int) -> tuple[Counter[str], list[str]]:
    """How so many random command lines ended; each has at least one nonsense, and 5 s."""
    draw, found, wrong = random.Random(seed), Counter[str](), list[str]()

    def late(*_: object) -> None:
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, late)
    known = {tuple(line.split()[:2]): options_of(line.split()) for line in LINES}
    for _ in range(number):
        words = draw.choice(LINES).split()
        begin = words[:2]
        for _ in range(draw.randint(1, 3)):
            words += [draw.choice(known[tuple(begin)]), draw.choice(NONSENSE)]
        signal.setitimer(signal.ITIMER_REAL, LONGEST)
        try:
            done = CliRunner().invoke(app, words, catch_exceptions=True)
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            failed = done.exception
        except TimeoutError as error:
            failed = error
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
        if failed is None or isinstance(failed, SystemExit):
            found[f"exit code {done.exit_code}"] += 1
        elif isinstance(failed, BipedError):
            found["refused"] += 1
        elif isinstance(failed, TimeoutError):
            found["at work after 5 s"] += 1
            wrong.append(f"{words}: more than {LONGEST} s")
        else:
            wrong.append(f"{words}: {type(failed).__name__}: {str(failed)[:200]}")
    signal.signal(signal.SIGALRM, before)
    return found, wrong


def leak(walks: int) -> float:
    """Growth of the process over so many walks after a tenth of them [MB]."""
    process, begin = psutil.Process(), 0.0
    for k in range(walks):
        ba.walk_scenario(ba.Scenario("NPD", engine="compiled", impacts=1, seed=k))
        if k == walks // 10:
            begin = process.memory_info().rss
    return (process.memory_info().rss - begin) / 1e6


KINDS = ("run", "gait", "study", "store", "cache", "robot record", "URDF")


def main(number: int = 500, seed: int = 1) -> int:
    """Print the table; the exit code."""
    from tests.bench.test_random_trials import attack

    every = list[str]()
    print("| what | number | how they were met |\n|---|---|---|")
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as place, chdir(place):
        for kind in (*KINDS, "command line"):
            folder = Path(place) / kind.replace(" ", "-")
            folder.mkdir()
            found, wrong = (
                lines(number, seed)
                if kind == "command line"
                else damage(kind, number, seed, folder)
            )
            every += wrong
            told = ", ".join(f"{count} {how}" for how, count in sorted(found.items()))
            print(
                f"| {kind} | {number} | {told}{f', {len(wrong)} wrong' if wrong else ''} |",
                flush=True,
            )
    ends = ", ".join(f"{count} {status}" for status, count in sorted(attack(4 * number).items()))
    print(f"| random walk | {4 * number} | {ends} |", flush=True)
    grown = leak(4 * number)
    every += [f"{grown:.1f} MB more after {4 * number} walks"] if grown > 20.0 else []
    print(
        f"| walks in one process | {4 * number} | memory grew by {grown:.1f} MB after the first tenth |"
    )
    print(f"\nseed {seed}, {time.monotonic() - began:.0f} s")
    for text in every:
        print(text, file=sys.stderr)
    return 1 if every else 0


if __name__ == "__main__":
    sys.exit(main(*(int(text) for text in sys.argv[1:])))
