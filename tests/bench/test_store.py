"""The results file: exact, whole after a kill at any moment, and left alone where it is not one's own."""

import random
import sqlite3
import struct
import subprocess
import sys

import pytest
import standin
from standin import about, carried_out, records, results, rows

from biped_adrc.campaign.chunk import Job, key_of, ran, text_of
from biped_adrc.campaign.store import open_store, read_store
from biped_adrc.campaign.workers import Threads
from biped_adrc.errors import InputError, OutputError

N = 160


def one(record, row):
    text = text_of(record)
    return ran(Job(key_of(text), text, record), row, 0.1)


def filled(path, n=20):
    with open_store(path, about()) as store:
        carried_out(rows, records(n), store, Threads(1))
    return path


def child(path, n, pause):
    return subprocess.Popen(
        [sys.executable, standin.__file__, str(path), str(n), str(pause)],
        stdout=subprocess.PIPE,
        text=True,
    )


def test_floats_come_back_to_the_last_bit(tmp_path):
    random.seed(3)
    bits = [struct.pack("<Q", random.getrandbits(64)) for _ in range(2000)]
    values = [x for (x,) in (struct.unpack("<d", b) for b in bits) if x == x]
    with open_store(tmp_path / "r.sqlite", about()) as store:
        store.add(one({"x": k}, {"value": x}) for k, x in enumerate(values))
        keys = [key_of(text_of({"x": k})) for k in range(len(values))]
        store.place(
            (k, key, text_of({"at": x}))
            for k, (key, x) in enumerate(zip(keys, values, strict=True))
        )
    with read_store(tmp_path / "r.sqlite") as store:
        for result, x in zip(store.results(), values, strict=True):
            assert struct.pack("<d", result.row["value"]) == struct.pack("<d", x)
            assert struct.pack("<d", result.at["at"]) == struct.pack("<d", x)


def test_resumed_equals_uninterrupted(tmp_path):
    whole, path = tmp_path / "whole.sqlite", tmp_path / "killed.sqlite"
    process = child(path, N, 2e-3)
    while int(process.stdout.readline()) < N // 4:
        pass
    process.kill()
    process.communicate()
    with open_store(path, about()) as store:
        assert N // 4 <= len(store) < N
        fresh = N - len(store)
        summary = carried_out(rows, records(N, 2e-3), store, Threads(2))
        assert (summary.points, summary.fresh) == (N, fresh)
        resumed = results(store)
        assert carried_out(rows, records(N, 2e-3), store, Threads(2)).fresh == 0
    with open_store(whole, about()) as store:
        carried_out(rows, records(N, 2e-3), store, Threads(2))
        assert results(store) == resumed


def test_a_run_that_crashed_is_replaced_and_the_file_stays_whole(tmp_path):
    path = tmp_path / "r.sqlite"
    with open_store(path, about()) as store:
        for status in ("CRASHED", "COMPLETED"):
            store.add([one({"x": 1}, {"status": status})])
    with read_store(path) as store:
        assert store.statuses() == {"COMPLETED": 1}


@pytest.mark.parametrize("lines", [0, 1, 5])
def test_killed_at_any_moment_no_finished_run_is_lost(tmp_path, lines):
    path, told = tmp_path / "r.sqlite", 0
    for _ in range(2):
        process = child(path, N, 1.5e-3)
        told = max([told, *(int(process.stdout.readline()) for _ in range(lines))])
        process.kill()
        process.communicate()
        if lines:
            with read_store(path) as store:
                assert told <= len(store) == len(results(store)) < N
    with open_store(path, about()) as store:
        carried_out(rows, records(N, 1.5e-3), store, Threads(2))
        assert [r.row["n"] for r in store.results()] == [k * k for k in range(N)]


def test_a_second_process_is_refused_and_the_first_goes_on(tmp_path):
    path = tmp_path / "r.sqlite"
    process = child(path, 60, 5e-3)
    process.stdout.readline()
    with pytest.raises(OutputError, match="in use by another process, such as a study that is"):
        open_store(path, about())
    with read_store(path) as store:  # while it grows
        assert len(store) < 60
    assert process.communicate()[0].endswith("end\n")
    with open_store(path, about()) as store:
        assert len(store) == 60


def foreign(path):
    with sqlite3.connect(path) as db:
        db.execute("CREATE TABLE mine (x)")
        db.execute("PRAGMA application_id = 42")
    db.close()


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda path: path.write_text("a,b\n1,2\n" * 200), "no results file"),
        (foreign, "another program"),
        (
            lambda path: filled(path).write_bytes(path.read_bytes()[:3000]),
            "damaged|malformed|no results",
        ),
    ],
)
def test_files_that_are_not_ours_are_left_as_they_are(tmp_path, make, message):
    path = tmp_path / "r.sqlite"
    make(path)
    before = path.read_bytes()
    for attempt in (lambda: open_store(path, about()), lambda: read_store(path)):
        with pytest.raises((InputError, OutputError), match=message):
            attempt()
    assert path.read_bytes() == before


def test_another_format_is_refused(tmp_path):
    path = filled(tmp_path / "r.sqlite", 2)
    with sqlite3.connect(path) as db:
        db.execute("PRAGMA user_version = 2")
    db.close()
    for attempt in (lambda: open_store(path, about()), lambda: read_store(path)):
        with pytest.raises(InputError, match="has the format 2, expected 3"):
            attempt()


def test_another_study_is_refused_by_what_differs(tmp_path):
    path = tmp_path / "r.sqlite"
    open_store(path, about("a", grid=[1], fixed=2)).close()
    before = path.read_bytes()
    with pytest.raises(InputError, match=r"holds the study 'a'.*is 'b'.*other in grid;"):
        open_store(path, about("b", grid=[3], fixed=2))
    assert path.read_bytes() == before


def test_other_versions_are_refused(tmp_path):
    path = filled(tmp_path / "r.sqlite", 5)
    now = about()
    other = now._replace(versions={**now.versions, "numpy": "99.1"})
    with pytest.raises(InputError, match=rf"numpy {now.versions['numpy']} there, 99.1 here"):
        open_store(path, other)


def test_a_full_disk_ends_the_study_and_keeps_what_was_finished(tmp_path):
    path = tmp_path / "r.sqlite"
    with open_store(path, about()) as store:
        store.connection.execute("PRAGMA max_page_count = 30")
        with pytest.raises(OutputError, match="full"):
            carried_out(rows, records(5000), store, Threads(2))
        kept = len(store)
        assert kept > 0
    with open_store(path, about()) as store:
        assert len(store) == kept
        carried_out(rows, records(500), store, Threads(2))
        assert [r.row["n"] for r in store.results()] == [k * k for k in range(500)]
