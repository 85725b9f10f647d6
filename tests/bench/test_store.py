"""The results file: exact, whole after a kill at any moment, and left alone where it is not one's own."""

import errno
import os
import random
import signal
import sqlite3
import struct
import subprocess
import sys
import time
from pathlib import Path

import pytest
import standin
from standin import about, records, results, rows

from biped_adrc.campaign import store_open
from biped_adrc.campaign.chunk import key_of, made, text_of
from biped_adrc.campaign.execute import run_study
from biped_adrc.campaign.store import Placed, Ran
from biped_adrc.campaign.store_open import APPLICATION, open_store, read_store
from biped_adrc.campaign.workers import Threads
from biped_adrc.errors import InputError, OutputError
from biped_adrc.versions import numerical_versions

KILLS = 50
N = 160


def ran(record, row):
    text, one = text_of(record), made(row, 0.1)
    return Ran(key_of(text), text, one.row, one.status, one.engine, record.get("seed"), one.seconds)


def filled(path, n=20):
    with open_store(path, about()) as store:
        run_study(rows, records(n), store, Threads(1))
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
        store.add(ran({"x": k}, {"value": x}) for k, x in enumerate(values))
        keys = [key_of(text_of({"x": k})) for k in range(len(values))]
        store.place(
            Placed(k, key, text_of({"at": x}))
            for k, (key, x) in enumerate(zip(keys, values, strict=True))
        )
    with read_store(tmp_path / "r.sqlite") as store:
        for result, x in zip(store.results(), values, strict=True):
            assert struct.pack("<d", result.row["value"]) == struct.pack("<d", x)
            assert struct.pack("<d", result.at["at"]) == struct.pack("<d", x)


def test_killed_at_random_moments_no_finished_run_is_lost(tmp_path):
    random.seed(11)
    path, pause = tmp_path / "killed.sqlite", 1.5e-3
    before, in_the_middle = 0, 0
    for k in range(KILLS):
        process = child(path, N, pause)
        lines = random.randint(1, 12) if k % 4 else 0  # each fourth while it still opens the file
        first = "".join(process.stdout.readline() for _ in range(lines))
        time.sleep(random.uniform(0.0, 0.01 if lines else 0.25))
        process.send_signal(signal.SIGKILL)
        said = (first + process.communicate()[0]).split()
        told = [int(line) for line in said if line.isdigit()]
        kept = finished_runs(path)
        assert kept >= max([before, *told])
        in_the_middle += before < kept < N
        before = kept
        if kept == N:
            assert_whole(path, pause)
            path.unlink()
            before = 0
    assert in_the_middle > KILLS / 5
    assert child(path, N, pause).communicate()[0].endswith("end\n")
    assert_whole(path, pause)


def finished_runs(path):
    """It opens, and each of them has its point."""
    if not path.exists():
        return 0
    try:
        with read_store(path) as store:
            assert len(results(store)) == len(store)
            return len(store)
    except InputError as error:
        if "is empty" in str(error):  # killed before anything was begun in it
            return 0
        raise


def assert_whole(path, pause):
    given = list(records(N, pause))
    with read_store(path) as store:
        expected = [(k, r, row) for k, (r, row) in enumerate(zip(given, rows(given), strict=True))]
        assert [(r.position, r.at, r.row) for r in store.results()] == expected


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
        summary = run_study(rows, records(N, 2e-3), store, Threads(2))
        assert (summary.points, summary.fresh) == (N, fresh)
        resumed = results(store)
        assert run_study(rows, records(N, 2e-3), store, Threads(2)).fresh == 0
    with open_store(whole, about()) as store:
        run_study(rows, records(N, 2e-3), store, Threads(2))
        assert results(store) == resumed


def test_one_file_is_left_when_it_is_closed(tmp_path):
    filled(tmp_path / "r.sqlite")
    assert [p.name for p in tmp_path.iterdir()] == ["r.sqlite"]


def test_a_second_process_is_refused_and_the_first_goes_on(tmp_path):
    path = tmp_path / "r.sqlite"
    process = child(path, 60, 5e-3)
    process.stdout.readline()
    with pytest.raises(InputError, match=f"being written by process {process.pid}"):
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


def of_format(number):
    def make(path):
        filled(path)
        with sqlite3.connect(path) as db:
            db.execute(f"PRAGMA user_version = {number}")
        db.close()

    return make


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda path: path.write_text("a,b\n1,2\n" * 200), "no results file"),
        (foreign, "another program"),
        *[(of_format(k), f"format {k}, expected 2") for k in (-1, 0, 1, 3)],
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


def test_another_study_is_refused_by_what_differs(tmp_path):
    path = tmp_path / "r.sqlite"
    open_store(path, about("a", grid=[1], fixed=2)).close()
    before = path.read_bytes()
    with pytest.raises(InputError, match=r"holds the study 'a'.*is 'b'.*other in grid;"):
        open_store(path, about("b", grid=[3], fixed=2))
    assert path.read_bytes() == before


def test_other_versions_are_refused_unless_asked_for(tmp_path):
    path = filled(tmp_path / "r.sqlite", 5)
    now = about()
    other = now._replace(versions={**now.versions, "numpy": "99.1"})
    with pytest.raises(InputError, match=rf"numpy {now.versions['numpy']} there, 99.1 here"):
        open_store(path, other)
    with open_store(path, other, other_versions=True) as store:
        run_study(rows, records(8), store, Threads(1))
    with sqlite3.connect(path) as db:
        made_with = dict(db.execute("SELECT versions, count(*) FROM runs GROUP BY 1").fetchall())
    db.close()
    assert sorted(made_with.values()) == [3, 5]


def test_a_full_disk_ends_the_study_and_keeps_what_was_finished(tmp_path):
    path = tmp_path / "r.sqlite"
    with open_store(path, about()) as store:
        store.connection.execute("PRAGMA max_page_count = 30")
        with pytest.raises(OutputError, match="full"):
            run_study(rows, records(5000), store, Threads(2))
        kept = len(store)
        assert kept > 0
    with open_store(path, about()) as store:
        assert len(store) == kept
        run_study(rows, records(500), store, Threads(2))
        assert [r.row["n"] for r in store.results()] == [k * k for k in range(500)]


def test_a_disk_too_full_for_the_lock_leaves_it_free(tmp_path, monkeypatch):
    path = filled(tmp_path / "r.sqlite", 3)

    def full(*_, **__):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patched:
        patched.setattr(Path, "write_text", full)
        with pytest.raises(OutputError, match="No space") as caught:
            open_store(path, about())
    with open_store(path, about()) as store:
        assert len(store) == 3
    assert caught.value.exit_code == 5


def test_a_file_that_cannot_be_written(tmp_path):
    (tmp_path / "file").touch()
    for path in (tmp_path / "file" / "r.sqlite", Path(os.devnull) / "r.sqlite"):
        with pytest.raises(OutputError, match="cannot write"):
            open_store(path, about())
    (tmp_path / "folder").mkdir()
    with pytest.raises(OutputError, match="is a folder"):
        open_store(tmp_path / "folder", about())
    with open_store(tmp_path / "r.sqlite", about()) as store:
        store.connection.execute("PRAGMA query_only = ON")
        with pytest.raises(OutputError, match="readonly"):
            store.add([ran({"x": 1}, {"y": 1.0})])


def test_a_damaged_row_is_named(tmp_path):
    path = filled(tmp_path / "r.sqlite", 5)
    with sqlite3.connect(path) as db:
        db.execute("UPDATE runs SET row = substr(row, 1, 9) || char(1) WHERE record LIKE '%: 3}'")
    db.close()
    with pytest.raises(InputError, match=r"row [0-9a-f]{32} of 'runs' .*damaged"):
        read_store(path)
    with sqlite3.connect(path) as db:
        db.execute("UPDATE study SET configuration = '{'")
    db.close()
    with pytest.raises(InputError, match="damaged"):
        read_store(path)


def test_a_number_that_the_file_cannot_hold(tmp_path):
    with open_store(tmp_path / "r.sqlite", about()) as store:
        with pytest.raises(InputError, match="too large"):
            run_study(rows, [{"x": 1, "seed": 2**63}], store, Threads(1))
        assert len(store) == 0


def test_versions_name_what_the_numbers_depend_on():
    assert {"qpsolvers", "daqp", "source of biped-adrc"} <= set(numerical_versions())


def test_the_application_is_in_the_header(tmp_path):
    header = filled(tmp_path / "r.sqlite").read_bytes()[:100]
    assert struct.unpack(">II", header[60:64] + header[68:72]) == (2, APPLICATION)


@pytest.mark.parametrize(
    ("statement", "said"),
    [
        ("DELETE FROM runs WHERE record LIKE '%: 3}'", "19 runs of 20"),
        ("DELETE FROM points WHERE position = 19", "19 points of 20"),
        ("UPDATE runs SET seconds = seconds + 1 WHERE record LIKE '%: 3}'", "'runs' has another"),
        ("UPDATE points SET at = replace(at, '3', '4') WHERE position = 3", "3 of 'points' has"),
        ("UPDATE study SET points = 7", "1 of 'study' has another checksum"),
        ("UPDATE versions SET versions = '{}'", "1 of 'versions' has another checksum"),
        ("DELETE FROM tally", "number of its rows is missing"),
    ],
)
def test_a_row_that_was_changed_or_is_gone_is_named(tmp_path, statement, said):
    path = filled(tmp_path / "r.sqlite")
    with sqlite3.connect(path) as db:
        db.execute(statement)
    db.close()
    before = path.read_bytes()
    for attempt in (lambda: open_store(path, about()), lambda: read_store(path)):
        with pytest.raises(InputError, match=said):
            attempt()
    assert path.read_bytes() == before


def test_damaged_pages_are_refused_or_of_no_matter(tmp_path):
    """Of 80 such files 17 opened, and 6 of them lacked rows without an error."""
    path = filled(tmp_path / "r.sqlite", 300)
    whole, draw = path.read_bytes(), random.Random(5)
    with read_store(path) as store:
        expected = results(store)
    refused = 0
    for _ in range(60):
        data = bytearray(whole)
        begin = draw.randrange(len(data) - 600)
        data[begin : begin + draw.choice([1, 8, 600])] = draw.randbytes(draw.choice([1, 8, 600]))
        path.write_bytes(data[: len(whole)])
        try:
            with read_store(path) as store:
                assert results(store) == expected
        except InputError:
            refused += 1
    assert refused > 40


def test_a_file_that_is_removed_while_it_is_written_ends_the_study(tmp_path):
    path = tmp_path / "r.sqlite"
    with open_store(path, about()) as store:
        store.add([ran({"x": 1}, {"y": 1.0})])
        path.unlink()
        with pytest.raises(OutputError, match="was removed or replaced while it was written"):
            store.add([ran({"x": 2}, {"y": 1.0})])


def test_what_is_left_of_a_file_is_not_begun_anew(tmp_path):
    path = tmp_path / "r.sqlite"
    path.touch()
    with pytest.raises(InputError, match="is empty: nothing was begun in it, or it was cut off"):
        open_store(path, about())
    path.unlink()
    log = path.with_name("r.sqlite-wal")
    log.write_bytes(b"log")
    with pytest.raises(InputError, match=r"was removed, and the log of one, 'r\.sqlite-wal', is"):
        open_store(path, about())
    assert not path.exists()
    assert log.read_bytes() == b"log"


@pytest.mark.parametrize("beside", ["", ".lock", "-wal"])
def test_what_is_a_link_to_another_folder_is_not_written_to(beside, tmp_path):
    path = filled(tmp_path / "r.sqlite", 3)
    link, target = path.with_name(f"r.sqlite{beside}"), tmp_path / "elsewhere"
    if beside:
        target.write_text("kept")
    else:
        path.rename(target)
    link.symlink_to(target)
    before = target.read_bytes()
    with pytest.raises(OutputError, match=rf"r\.sqlite{beside}' is a link to '.*elsewhere'"):
        open_store(path, about())
    assert target.read_bytes() == before


def test_a_lock_of_another_program_is_named_soon(tmp_path, monkeypatch):
    assert store_open.LOCKED < 9.0
    monkeypatch.setattr(store_open, "LOCKED", 0.1)
    path = filled(tmp_path / "r.sqlite", 3)
    other = sqlite3.connect(path, isolation_level=None)
    other.execute("BEGIN EXCLUSIVE")
    began = time.monotonic()
    with pytest.raises(OutputError, match="another program has locked it"):
        open_store(path, about())
    assert 0.1 < time.monotonic() - began < 4.0
    other.close()


def test_garbage_in_the_lock_and_in_the_schema_is_a_sentence(tmp_path):
    path = filled(tmp_path / "r.sqlite", 3)
    path.with_name("r.sqlite.lock").write_bytes(b"\xff\xfe")
    data = path.read_bytes()
    at = data.index(b"CREATE TABLE runs")
    path.write_bytes(data[:at] + b"\xff\xfe\x80" * 6 + data[at + 18 :])
    for attempt in (lambda: open_store(path, about()), lambda: read_store(path)):
        with pytest.raises((InputError, OutputError), match=r"r\.sqlite"):
            attempt()
