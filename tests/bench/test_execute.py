"""The same rows whoever makes them, and a clear end for those that cannot be made."""

import os
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from standin import about, carried_out, records, results, rows

import biped_adrc as ba
from biped_adrc.campaign import execute
from biped_adrc.campaign.chunk import Point
from biped_adrc.campaign.execute import LOOK_UP
from biped_adrc.campaign.store import open_store, read_store
from biped_adrc.campaign.workers import Processes, Threads
from biped_adrc.errors import SimulationError

LIGHT = ("standin",)
SOON = 30.0
"""[s] In which what takes less than a second has ended, on any machine."""


def run(path, given, workers, **more):
    with open_store(path, about()) as store:
        summary = carried_out(more.pop("function", rows), given, store, workers, **more)
        return results(store), summary


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    return run(tmp_path_factory.mktemp("one") / "r.sqlite", records(90), Threads(1), chunk=90)[0]


@pytest.mark.parametrize(
    ("workers", "chunk"),
    [
        (Processes(1, LIGHT), None),
        (Processes(2, LIGHT), 4),
        (Threads(1), 1),
        (Threads(3), 7),
    ],
)
def test_rows_do_not_depend_on_workers_or_chunks(tmp_path, expected, workers, chunk):
    assert run(tmp_path / "r.sqlite", records(90), workers, chunk=chunk)[0] == expected


def test_an_executor_of_the_callers_is_used_and_not_ended(tmp_path, expected):
    with ThreadPoolExecutor(2) as pool:
        assert run(tmp_path / "r.sqlite", records(90), pool)[0] == expected
        assert pool.submit(int, "3").result() == 3


def test_repeated_points_run_once_and_have_their_rows(tmp_path):
    lock, seen = threading.Lock(), []

    def counting(given):
        with lock:
            seen.extend(record["x"] for record in given)
        return rows(given)

    given = [Point({"x": k % 10}, {"x": k % 10, "place": k}) for k in range(3 * LOOK_UP)]
    found, summary = run(tmp_path / "r.sqlite", given, Threads(2), function=counting, chunk=2)
    assert sorted(seen) == list(range(10))
    assert (summary.points, summary.fresh) == (3 * LOOK_UP, 10)
    assert [at["place"] for _, _, at, _ in found] == list(range(3 * LOOK_UP))
    assert all(row["n"] == at["x"] ** 2 for _, _, at, row in found)


def test_points_are_made_when_they_are_needed(tmp_path):
    taken = []

    def endless():
        for record in records(10**9):
            taken.append(record["x"])
            yield record

    def stop(p):
        if p.fresh >= 50:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(tmp_path / "r.sqlite", endless(), Threads(2), progress=stop)
    assert len(taken) <= 2 * LOOK_UP


def test_what_was_running_when_a_study_is_stopped_is_stored(tmp_path):
    begun, go_on = threading.Event(), threading.Event()

    def in_turn(given):
        """The run of 0 ends while that of 1 is in the middle."""
        if given[0]["x"] == 1:
            begun.set()
            assert go_on.wait(SOON)
        assert begun.wait(SOON)
        return rows(given)

    def stop(p):
        if p.fresh == 1:
            go_on.set()
            raise KeyboardInterrupt

    with open_store(tmp_path / "r.sqlite", about()) as store:
        with pytest.raises(KeyboardInterrupt):
            carried_out(in_turn, records(2), store, Threads(2), chunk=1, progress=stop)
        assert [row["n"] for *_, row in results(store)] == [0, 1]


def test_a_record_that_raises_is_named_and_spoils_no_other(tmp_path, expected):
    given = [{**r, "raise": 1} if r["x"] in (5, 50) else r for r in records(90)]
    found, _ = run(tmp_path / "r.sqlite", given, Threads(2), chunk=9)
    for got, good in zip(found, expected, strict=True):
        if got[0] in (5, 50):
            assert got[3] == {"status": "RAISED", "detail": f"ValueError: no row for {got[0]}"}
        else:
            assert got == good


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (lambda given: rows(given)[1:], "0 rows for 1 records"),
        (lambda given: [{"y": object()} for _ in given], "expected a number or text"),
        (lambda given: sys.exit(3), "SystemExit: 3"),
    ],
)
def test_rows_that_are_none_have_the_reason(tmp_path, function, message):
    found, _ = run(tmp_path / "r.sqlite", records(4), Threads(1), function=function)
    assert [row["status"] for *_, row in found] == ["RAISED"] * 4
    assert message in found[0][3]["detail"]


def test_a_worker_that_is_killed_once_changes_nothing(tmp_path, expected):
    marked = tmp_path / "died"
    given = [{**r, "once": str(marked)} if r["x"] == 40 else r for r in records(90)]
    notes = []
    found, summary = run(
        tmp_path / "r.sqlite", given, Processes(2, LIGHT), progress=lambda p: notes.append(p.note)
    )
    assert summary.deaths == 1
    assert any("died" in note for note in notes)
    assert [row for *_, row in found] == [row for *_, row in expected]


def test_a_record_alone_in_its_chunk_is_tried_twice(tmp_path, expected):
    """Its worker may have died of something else."""
    (given,) = records(1)
    dies = {**given, "once": str(tmp_path / "died")}
    found, summary = run(tmp_path / "r.sqlite", [dies], Processes(1, LIGHT), chunk=1)
    assert (summary.deaths, found[0][3]) == (1, expected[0][3])


def test_a_record_that_kills_its_worker_is_named(tmp_path, expected):
    given = [{**r, "kill": 1} if r["x"] == 30 else r for r in records(40)]
    found, summary = run(tmp_path / "r.sqlite", given, Processes(2, LIGHT), chunk=4)
    assert summary.deaths >= 2
    assert [k for k, _, _, row in found if row["status"] == "CRASHED"] == [30]
    assert "died" in found[30][3]["detail"]
    assert all(a == b for a, b in zip(found, expected, strict=False) if a[0] != 30)
    again = run(tmp_path / "r.sqlite", given, Processes(1, LIGHT))
    assert (again[0], again[1].fresh) == (found, 1)


def test_what_killed_its_worker_before_comes_last(tmp_path):
    seen = []

    def noting(given):
        seen.extend(record["x"] for record in given)
        return rows(given)

    with open_store(tmp_path / "r.sqlite", about()) as store:
        jobs = [execute._job(Point(r, r)) for r in records(5)]
        row = {"status": "CRASHED", "detail": "it died"}
        store.add(execute.ran(job, row, 0.0) for job in jobs[:2])
        carried_out(noting, records(5), store, Threads(1), chunk=1)
        assert seen == [2, 3, 4, 0, 1]
        assert store.statuses() == {"COMPLETED": 5}


def test_records_that_all_kill_their_workers_end_the_study(tmp_path, monkeypatch):
    monkeypatch.setattr(execute, "MOST_CRASHED", 3)
    given = [{"x": k, "kill": 1} for k in range(40)]
    path = tmp_path / "r.sqlite"
    with pytest.raises(SimulationError, match="3 runs one after the other killed"):
        run(path, given, Processes(1, LIGHT), chunk=1)
    with read_store(path) as store:
        assert store.statuses() == {"CRASHED": 3}


def test_workers_import_nothing_from_the_working_directory(tmp_path):
    """A file called as one of the standard library, where the study is started."""
    script = tmp_path / "bin" / "study.py"
    script.parent.mkdir()
    script.write_text(
        "import os\nfrom biped_adrc.campaign.workers import Processes\n"
        "if __name__ == '__main__':\n"
        "    p = Processes(1, preload=())\n    e = p.start()\n"
        "    print(e.submit(os.getpid).result() > 0)\n    p.stop(e, True)\n"
    )
    for name in ("selectors", "socket"):
        (tmp_path / f"{name}.py").write_text("open('ran', 'w').close()\n")
    done = subprocess.run(
        [sys.executable, script],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(Path(ba.__file__).parents[1])},
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.stdout.strip() == "True", done.stderr
    assert not (tmp_path / "ran").exists()
