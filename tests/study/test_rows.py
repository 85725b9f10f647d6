"""The same rows whoever makes them and whenever they are killed; what cannot run is refused before.

Most tests run a stand-in for walks, `plants.rows`: 60 rows, cases a and b with run.impacts 1 to 30, whose
number (101 to 130 in b) is the row's column impacts. made(folder, workers, ...) runs this study in so many
processes (None: in a thread) and returns its rows, which the fixture expected has too.
"""

import json
import signal
import sqlite3
import subprocess
import sys
import time
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor
from contextlib import closing, suppress
from pathlib import Path

import numpy as np
import plants
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import BipedError, InputError, SimulationError
from biped_adrc.core.files import data_folder
from biped_adrc.scenario.scenario import DRAWN
from biped_adrc.studies import runner
from biped_adrc.studies.results import RESULTS, Results
from biped_adrc.studies.study import read_study
from tests.commands import command

FOLDER = Path(plants.__file__).parent


def made(folder, workers, base=(), **more):
    study = {**plants.ROWS, "base": {**plants.ROWS["base"], **dict(base)}}
    return list(plants.carried(study, folder, plants.rows, workers, **more).rows())


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    found = made(tmp_path_factory.mktemp("one"), None)
    assert [row["impacts"] for row in found] == [*range(1, 31), *range(101, 131)]
    return found


@pytest.mark.parametrize("workers", [1, 2])
def test_rows_do_not_depend_on_the_number_of_workers(tmp_path, expected, workers):
    """`expected` are the 60 rows made in this process; so are those of one and of two worker processes."""
    assert made(tmp_path, workers) == expected


def check_left_out(found, expected, status, detail):
    """The row of 105 has this status and detail, and all others are as expected."""
    (odd,) = [i for i, row in enumerate(found) if row["status"] == status]
    assert expected[odd]["impacts"] == 105
    assert detail in found[odd]["detail"]
    assert found[:odd] + found[odd + 1 :] == expected[:odd] + expected[odd + 1 :]


def test_a_row_that_kills_its_worker_is_named_and_left_out(tmp_path, expected):
    """The stand-in row 105 kills its process: this row alone is CRASHED and a note names its values. The same
    study again finds all 60 rows done and walks none.
    """
    notes = []
    found = made(tmp_path, 2, {"controller.kill": 105}, progress=lambda p: notes.append(p.note))
    check_left_out(found, expected, "CRASHED", "died")
    assert [x for x in notes if "left out, since it kills" in x and "'run.impacts': 5" in x]
    again = []
    assert made(tmp_path, 1, {"controller.kill": 105}, progress=again.append) == found
    assert {p.done for p in again} == {60}


def test_a_worker_that_dies_once_changes_nothing(tmp_path, expected):
    """The first walk of row 7 kills its worker (and leaves a file, so that the second does not): all rows are
    as expected.
    """
    marked = tmp_path / "died"
    assert made(tmp_path / "out", 2, {"controller.once": str(marked)}) == expected
    assert marked.exists()


def test_workers_that_die_now_and_then_do_not_end_the_study(tmp_path, monkeypatch):
    """Two walks kill their workers and a study ends after two in a row (MOST_CRASHED, made small here): there
    are others between them, so it goes on.
    """
    monkeypatch.setattr(runner, "MOST_CRASHED", 2)
    cases = {x: {"controller.x": x, "controller.of": 0} for x in "ab"}
    base = {"controller.pause": 0.0, "controller.kill": 5}
    study = {"name": "some", "base": base, "cases": cases, "grid": {"run.impacts": [*range(5, 11)]}}
    found = ba.study(study, tmp_path, 1, function=plants.rows)
    assert [row["status"] for row in found.rows()] == ["CRASHED", *["COMPLETED"] * 5] * 2


def test_workers_that_all_die_end_the_study(tmp_path, monkeypatch):
    """Each walk kills its worker: after two in a row (MOST_CRASHED, made small here) the study ends."""
    monkeypatch.setattr(runner, "MOST_CRASHED", 2)
    base = {"controller.pause": 0.0, "controller.of": 0, "controller.kill": 5}
    study = {"name": "bad", "base": base, "grid": {"run.impacts": [5]}, "seeds": 4}
    with pytest.raises(SimulationError, match="2 walks one after the other killed"):
        ba.study(study, tmp_path, 1, function=plants.rows)


def test_a_script_without_a_main_guard_gets_one_sentence(tmp_path):
    """Workers import the script, which starts a study again: nothing but the error that says so, and no row."""
    text = "import biped_adrc as ba\nba.study({'name': 'one', 'seeds': 2}, 'out', 1)\n"
    (tmp_path / "script.py").write_text(text)
    command = [sys.executable, "script.py"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert done.returncode == 1
    assert done.stderr.count("Traceback") == 1
    assert "under if __name__ == '__main__':" in done.stderr.splitlines()[-1]


def test_a_row_that_raises_spoils_no_other(tmp_path, expected):
    """Row 105 raises: it is RAISED with the error's text, all others are as expected, and the pool of threads
    still works.
    """
    with ThreadPoolExecutor(2) as pool:
        found = made(tmp_path, pool, {"controller.raise": 105})
        assert pool.submit(int, "3").result() == 3
    check_left_out(found, expected, "RAISED", "ValueError: no row for 105")


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (lambda records: plants.rows(records)[1:], "argument 2 is longer than argument 1"),
        (lambda records: [{"y": object()} for _ in records], "not JSON serializable"),
        (lambda records: [{"y": float("nan")} for _ in records], "Out of range float"),
        (lambda records: sys.exit(3), "SystemExit: 3"),
    ],
)
def test_a_row_of_a_wrong_kind_says_why_it_is_refused(tmp_path, function, message):
    """function: makes a row too few, values that JSON does not have, or ends the thread; every one of the 60
    walks is then RAISED with the message.
    """
    found = plants.carried(plants.ROWS, tmp_path, function)
    ((status, (count, detail)),) = found.statuses().items()
    assert (status, count) == ("RAISED", 60)
    assert message in detail


class Broken(Executor):
    """Returns no work, or, with one more error, takes none."""

    def __init__(self, error, *at_once):
        self.error, self.at_once = error, at_once

    def submit(self, *_):
        for error in self.at_once:
            raise error
        future = Future()
        future.set_exception(self.error)
        return future


DEAD = BrokenExecutor("no")


@pytest.mark.parametrize("errors", [(ValueError("no"),), (DEAD,), (DEAD, DEAD)])
def test_an_executor_that_fails_ends_the_study(tmp_path, errors):
    """errors: the first is raised by the work; a second one already where work is handed in. A broken executor
    is named as a dead worker, any other error by itself.
    """
    # DEAD: the error of a broken executor, to which the second sentence belongs
    said = r"to a worker or back: ValueError\('no'\)|a worker of the executor died, which the study"
    with pytest.raises(SimulationError, match=said.split("|")[errors[0] is DEAD]):
        plants.carried(plants.ROWS, tmp_path, plants.rows, Broken(*errors))


@pytest.mark.parametrize(
    ("kind", "ends"), [("rows", (signal.SIGKILL, signal.SIGINT)), ("costs", (signal.SIGKILL,))]
)
def test_a_study_that_is_killed_goes_on_to_the_same_rows(tmp_path, started, kind, ends):
    """A kill and then a Ctrl-C at random moments of a study (rows), a kill of a search (costs): each goes on,
    and in the end has the rows of one that was never ended.
    """
    script, random = FOLDER / "plants.py", np.random.default_rng(38)
    out = tmp_path / "killed"
    for by in ends:
        # the study in a process of its own, with 0.03 s per row
        process = started(sys.executable, str(script), kind, str(out), "0.03")
        process.stdout.readline()  # it has begun
        time.sleep(random.uniform(0.05, 0.3))
        process.send_signal(by)
        assert process.wait() == -by
    study, function = plants.slowly(kind, 0.03)
    with ThreadPoolExecutor(8) as pool:
        found, whole = (
            list(plants.carried(study, folder, function, pool).results())
            for folder in (out, tmp_path / "whole")
        )
    assert found == whole
    assert len(found) >= 47  # of a search: 40, at least 5 on the second set, 2 on the third


STUDY = {
    "name": "walks",
    "seeds": 2,
    "base": {"run.impacts": 2, "start.rate_spread": 0.05},
    "cases": {"ADRC": {"controller.name": "ADRC"}, "NPD": {"controller.name": "NPD"}},
    "grid": {"hardware.period": ["1 ms", "2 ms"]},
}


def test_walks_are_the_same_in_processes_and_threads(tmp_path):
    """Real walks, 2 controllers x 2 periods x 2 seeds: the rows of two processes equal those of two threads."""
    with ThreadPoolExecutor(2) as pool:
        apart, beside = (ba.study(STUDY, tmp_path / f"{x}", x) for x in (2, pool))
        assert list(apart.rows()) == list(beside.rows())
    assert apart.statuses() == {"COMPLETED": (8, "")}


PUSH = {"pushes.0.torque": 30.0}
# Scenarios in which the seed matters, by what is drawn from it (DRAWN), and some in which it does not.
DRAWS = {
    "start": {"start.rate_spread": 0.01},
    "onset": PUSH,
    "joints": PUSH | {"pushes.0.onset": 0.1, "pushes.0.joints": "random"},
    "noise": PUSH | {"pushes.0.onset": 0.1, "pushes.0.shape": "noise"},
    "sensors": {"hardware.encoders.noise": 1e-5},
    "model": {"errors.mass_width": 0.05},
    "impact": {"errors.impact_width": 0.01},
    "ground": {"ground.rms": 1e-3},
    "sensor": {"hardware.sensor.name": "encoders", "hardware.sensor.noise": 1e-5},
    "touchdown": {"hardware.touchdown.name": "faulty", "hardware.touchdown.missed": 0.1},
    "stones": {"ground.stone_range": [0.4, 0.45], "controller.name": "footstep"},
}
FIXED = {
    "nothing": {},
    "push": PUSH | {"pushes.0.onset": 0.1},
    "push of no torque": {"pushes.0.torque": 0.0, "pushes.0.joints": "random"},
    "noise of no force": {"pushes.0.link": "torso", "pushes.0.shape": "noise"},
    "counts": {"hardware.encoders.counts": 8192.0},
    "masses": {"errors.mass": {"torso": 1.1}, "errors.trunk_load": 0.1},
    "ground": {"ground.drop": 0.01},
    "sensor": {"hardware.sensor.name": "encoders", "hardware.sensor.counts": 8192.0},
    "touchdown": {"hardware.touchdown.name": "faulty", "hardware.touchdown.late": 1e-3},
    "stones": {"ground.stones": [0.4, 0.4], "controller.name": "footstep"},
}


def test_a_study_knows_before_its_first_walk_where_something_is_drawn():
    """`rehearse` returns the cases in which another seed changes nothing: all of FIXED and none of DRAWS, which
    has an example of everything that is drawn (DRAWN). With one seed, or where some level of a grid draws,
    there is none.
    """
    assert set(DRAWS) == set(DRAWN)
    base = {"controller.name": "NPD", "run.impacts": 3}
    cases = {f"drawn {x}": base | y for x, y in DRAWS.items()}
    cases |= {f"fixed {x}": base | y for x, y in FIXED.items()}
    study = read_study({"name": "a", "seeds": 2, "cases": cases})
    assert {case for case, _ in study.rehearse()} == {f"fixed {x}" for x in FIXED}
    assert read_study({"name": "a", "seeds": [3], "cases": cases}).rehearse() == frozenset()
    grid = read_study({"name": "a", "seeds": 2, "grid": {"hardware.encoders.noise": [0.0, 1e-5]}})
    assert grid.rehearse() == frozenset()


def test_a_walk_without_anything_drawn_is_made_once(tmp_path):
    """NPD alone draws nothing: 1 walk, and 6 seeds of the case with noise make 7. Each of the 6 is compared
    with that one walk.
    """
    cases = {"NPD": {}, "noise": {"hardware.encoders.noise": 1e-5}}
    base = {"controller.name": "NPD", "run.impacts": 1}
    tables, notes = {"name": "a", "seeds": 6, "base": base, "cases": cases}, []
    with ThreadPoolExecutor(1) as pool:
        found = ba.study(tables, tmp_path, pool, progress=notes.append)
    assert notes[0].note == "Walked once, as nothing that acts is drawn from the seed: NPD."
    assert {p.total for p in notes} == {7}
    first, *others = found.rows()
    assert "run.seed" not in first
    assert [row["run.seed"] for row in others] == [*range(6)]
    exact, noisy = found.table()
    assert (exact.walks, noisy.walks, noisy.ratio.pairs) == (1, 6, 6)
    assert noisy.ratio.p < 1.0  # there is a p, not NaN, though NPD has one walk
    assert found.notes == (notes[0].note,)


HOLD = {"controller.contact.name": "hold", "hardware.period": None}


@pytest.mark.parametrize(
    ("tables", "message"),
    [
        ({"base": {"robot.name": "rabit"}}, "study 'typo', at base: .*rabit"),
        ({"grid": {"controller.name": ["ADRC", "ADCR"]}}, "controller.name: .*ADCR"),
        ({"base": {"start.q9": 0.1}}, "q9"),
        # HOLD: a controller that needs a period, and the period None
        ({"cases": {"a": {}, "b": HOLD}}, "at case = b: .*period"),
    ],
)
def test_a_study_that_cannot_run_is_refused_before_the_first_walk(tmp_path, tables, message):
    """A misspelt name, a value that is none of the robot's, and parts that do not fit in one case; no folder is
    left behind.
    """
    with pytest.raises(InputError, match=message):
        ba.study({"name": "typo", **tables}, tmp_path / "out", 1)
    assert not (tmp_path / "out").exists()


def test_a_file_of_another_study_is_never_gone_on_over(tmp_path, expected):
    """A file of results (RESULTS) of a study with another value, a text in its place, and half a file: each is
    refused, and the first file keeps all its bytes.
    """
    made(tmp_path, 1)
    before = (tmp_path / RESULTS).read_bytes()
    with pytest.raises(InputError, match=r"base\.controller\.more"):
        made(tmp_path, 1, {"controller.more": 1})
    for name, content, message in (
        ("other", b"a text that is long enough to be no database" * 9, "no results file"),
        ("cut", before[: len(before) // 2], "damaged"),
    ):
        (tmp_path / name).mkdir()
        (tmp_path / name / RESULTS).write_bytes(content)
        with pytest.raises(InputError, match=message):
            made(tmp_path / name, 1)
    assert (tmp_path / RESULTS).read_bytes() == before


def test_a_bit_that_flips_in_the_results_changes_no_number(tmp_path, expected):
    """A walk of a damaged row is made again; where more is damaged, the file is refused.

    Half of the 60 bits are taken from the part of the file with the rows: at least 10 have to reach one.
    """
    made(tmp_path, None)
    path, random = tmp_path / RESULTS, np.random.default_rng(20)
    whole, again = path.read_bytes(), 0
    rows = whole.index(b'{"status"')
    for k in range(60):
        data = bytearray(whole)
        data[random.integers(rows if k % 2 else 0, len(data))] ^= 1 << random.integers(8)
        path.write_bytes(data)
        notes = []
        with suppress(BipedError):  # which refuses the file
            assert made(tmp_path, None, progress=notes.append) == expected
        again += any("walked again: 1." in p.note for p in notes)
    assert again >= 10


def changed(path, *commands):
    with closing(sqlite3.connect(path)) as db, db:
        for text in commands:
            db.execute(text)


@pytest.mark.parametrize(
    ("commands", "message"),
    [
        (["PRAGMA user_version = 0"], "has results of form 0, expected form 1"),
        (["DROP TABLE walks"], "other tables"),
        (["PRAGMA application_id = 7"], "of another program"),
        (["DELETE FROM study"], "empty or damaged"),
        (
            ["UPDATE study SET hash = 7"],
            "another one: its values are the same, and its hash is not",
        ),
        (["UPDATE study SET hash = 7, study = NULL"], "damaged"),
        (["UPDATE study SET hash = 7, study = '[]'"], "damaged"),
        (["UPDATE study SET versions = x'ff'"], "damaged"),
    ],
)
def test_a_database_of_somebody_else_is_refused_in_a_sentence(tmp_path, commands, message):
    """commands: what is changed in the SQLite file of a finished study (form, tables, program, its record); the
    file is left as it is.
    """
    made(tmp_path, None)
    changed(tmp_path / RESULTS, *commands)
    before = (tmp_path / RESULTS).read_bytes()
    with pytest.raises(InputError, match=message):
        made(tmp_path, None)
    assert (tmp_path / RESULTS).read_bytes() == before


def test_a_database_that_is_no_study_is_not_written_into(tmp_path):
    """SQLite's file of another program has tables and no mark: it is refused, and is the same byte for byte."""
    changed(tmp_path / RESULTS, "CREATE TABLE songs (name)", "INSERT INTO songs VALUES ('a')")
    before = (tmp_path / RESULTS).read_bytes()
    with pytest.raises(InputError, match="is a database of another program"):
        made(tmp_path, None)
    assert (tmp_path / RESULTS).read_bytes() == before


def test_rows_of_other_types_are_walked_again(tmp_path, expected):
    """Rows 0 to 4 become bytes, a broken text, nothing, a number and a row with NaN, and row 30 goes to place
    777: reading refuses the first, and the study makes all of them again.
    """
    made(tmp_path, None)
    values = (
        "x'00ff'",
        "CAST(x'80ff' AS TEXT)",
        "NULL",
        "3.5",
        """replace(row, '"feasible": 1', '"feasible": NaN')""",
    )
    for place, value in enumerate(values):
        changed(tmp_path / RESULTS, f"UPDATE walks SET row = {value} WHERE place = {place}")
    changed(tmp_path / RESULTS, "UPDATE walks SET place = 777 WHERE place = 30")
    with pytest.raises(InputError, match="row 0 does not fit its checksum"):
        list(Results(read_study(plants.ROWS), tmp_path).results())
    assert made(tmp_path, None) == expected


def test_a_study_that_is_told_to_end_says_one_sentence_and_keeps_its_rows(tmp_path, started):
    """A study of 400 walks in a process of its own is terminated once it has a row: exit code 130, and the rows
    are still there.
    """
    path, out = tmp_path / "long.toml", tmp_path / "out"
    path.write_text('name = "long"\nseeds = 400\nbase = { start.spread = 1e-3 }\n')
    line = (
        sys.executable,
        "-m",
        "biped_adrc",
        "study",
        str(path),
        "-o",
        str(out),
        "--workers",
        "1",
    )
    process = started(*line, stderr=subprocess.PIPE)
    while not ((out / RESULTS).exists() and count(out / RESULTS)):
        assert process.poll() is None
        time.sleep(0.05)
    process.terminate()
    said, errors = process.communicate()
    assert process.returncode == 130
    assert "the same command goes on from there" in " ".join(said.split())
    assert errors.strip() == "interrupted; what was already written is complete"
    assert count(out / RESULTS)


def count(path):
    with closing(sqlite3.connect(path)) as db:
        names = db.execute("SELECT name FROM sqlite_master WHERE name = 'walks'").fetchall()
        return db.execute("SELECT count(*) FROM walks").fetchone()[0] if names else 0


def test_a_file_that_a_study_names_belongs_to_its_numbers(tmp_path):
    """The gait's file is written anew between two runs, with other spaces: the study sees another file and
    refuses to go on with the old rows.
    """
    gait, out = tmp_path / "mine.json", tmp_path / "out"
    gait.write_text((data_folder("gaits") / "rabbit" / "published-identified.json").read_text())
    study = {"name": "a", "base": {"gait.name": str(gait), "run.impacts": 1}}
    with ThreadPoolExecutor(1) as pool:
        ba.study(study, out, pool)
        gait.write_text(json.dumps(json.loads(gait.read_text()), indent=3))
        with pytest.raises(InputError, match=r"other versions.*file .*mine.json"):
            ba.study(study, out, pool)


def test_the_command_walks_writes_and_goes_on(tmp_path):
    """8 walks are 9 lines of a table; the same command again makes the same page. The study's name has markup,
    which is text in the page. Of two walks a median has no interval, which is said.
    """
    path, out, table = tmp_path / "walks.toml", tmp_path / "out", tmp_path / "rows.csv"
    path.write_text(
        'name = "a <b> $x$"\nseeds = 2\nbase = { run.impacts = 1, start.rate_spread = 0.05 }\n'
        'grid = { hardware.period = ["1 ms", "2 ms"] }\n'
        '[cases]\nADRC = { controller.name = "ADRC" }\nNPD = { controller.name = "NPD" }\n'
    )
    line = ["study", path, "-o", out, "--workers", "1"]
    assert command(*line, "--dry-run").strip() == "a <b> $x$: 8 walks, over hardware.period"
    assert not out.exists()
    command(*line, "--table", table)
    assert {p.name for p in out.iterdir()} == {"results.sqlite", "study.html"}
    assert len(table.read_text().splitlines()) == 9
    page = (out / "study.html").read_text()
    assert "a &lt;b&gt; $x$" in page
    assert page.count("<figure>") == 4  # errors, their ratio, and two maps over the period
    command(*line)
    assert (out / "study.html").read_text() == page
    few = tmp_path / "few.toml"
    few.write_text(
        'name = "few"\nseeds = 2\nbase = { run.impacts = 1, start.rate_spread = 0.05 }\n'
    )
    done = command("study", few, "-o", tmp_path / "few", "--workers", "1")
    assert "An interval of a median takes at least 6 walks." in done
