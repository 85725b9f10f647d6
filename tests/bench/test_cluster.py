"""The same study on a real Dask cluster of separate processes, with workers and a scheduler that go away."""

import gc
import os
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path
from threading import Event

import pytest
import standin
from distributed import Client
from standin import about, records, results, rows

from biped_adrc.bench.study_file import read_study
from biped_adrc.bench.sweep import sweep
from biped_adrc.campaign import dask_cluster as of_cluster
from biped_adrc.campaign import execute
from biped_adrc.campaign.dask_cluster import Cluster, _Checked, difference
from biped_adrc.campaign.execute import run_study
from biped_adrc.campaign.store_open import open_store
from biped_adrc.campaign.workers import Threads
from biped_adrc.errors import InputError, SimulationError
from biped_adrc.versions import numerical_versions

pytestmark = pytest.mark.filterwarnings("ignore")
FOLDER = Path(standin.__file__).parent

SOON = 20.0
"""[s] In which what is not there is given up; Dask itself would wait for 30 s or more."""

SCHEDULER = """
import sys, time
sys.path.insert(0, sys.argv[1])
from distributed import LocalCluster
if __name__ == "__main__":
    with LocalCluster(n_workers=int(sys.argv[2]), threads_per_worker=1, processes=True,
                      dashboard_address=None, silence_logs=50) as cluster:
        # a nanny gives up a worker that is killed while it starts: others are started, as on real clusters
        cluster.adapt(minimum=int(sys.argv[2]), maximum=int(sys.argv[2]), interval="500ms")
        print(cluster.scheduler_address, flush=True)
        sys.stdin.read()
"""


def started(workers):
    """A cluster of its own process, and its address."""
    process = subprocess.Popen(
        [sys.executable, "-c", SCHEDULER, str(FOLDER), str(workers)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
        env={**os.environ, "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "1"},
    )
    return process, process.stdout.readline().strip()


@pytest.fixture(scope="module")
def address():
    process, address = started(2)
    yield address
    process.communicate("")


def run(path, given, workers, **more):
    with open_store(path, about()) as store:
        summary = run_study(rows, given, store, workers, **more)
        return results(store), summary


def test_the_same_rows_as_in_threads(tmp_path, address):
    here, _ = run(tmp_path / "here.sqlite", records(90), Threads(2))
    there, _ = run(tmp_path / "there.sqlite", records(90), Cluster(address), chunk=4)
    assert there == here


def test_what_is_submitted_twice_runs_twice(address):
    """A chunk whose worker died is the same call again, and must not be answered with its old outcome."""
    crew = Cluster(address)
    executor = crew.start()
    given = [executor.submit(os.urandom, 8) for _ in range(2)]
    one, other = [future.result(timeout=SOON) for future in given]
    crew.stop(executor, True)
    assert one != other


def test_walks_are_the_same_as_in_threads(tmp_path, address):
    study = read_study(
        {
            "study": {"name": "walks", "seeds": 2},
            "fixed": {"impacts": 2, "start_rate_spread": 0.05},
            "grid": {"controller": ["ADRC", "NPD"]},
        }
    )
    here = sweep(study, tmp_path / "here", Threads(2))
    there = sweep(study, tmp_path / "there", Cluster(address), chunk=1)
    assert list(there.rows()) == list(here.rows())
    assert there.statuses() == {"COMPLETED": 4}


def test_a_controller_of_ones_own_is_found_by_its_name(tmp_path, address):
    fixed = {"controller": "standin_controller:StandinController", "impacts": 1}
    study = read_study({"study": {"name": "own"}, "fixed": fixed, "grid": {"own.gain": [0.5, 1.0]}})
    here = sweep(study, tmp_path / "here", Threads(1))
    there = sweep(study, tmp_path / "there", Cluster(address), chunk=1)
    assert list(there.rows()) == list(here.rows())
    assert there.statuses() == {"COMPLETED": 2}


def test_a_worker_that_is_killed_in_the_middle(tmp_path, address):
    marked = tmp_path / "died"
    given = [{**r, "once": str(marked)} if r["x"] == 40 else r for r in records(90)]
    found, _ = run(tmp_path / "killed.sqlite", given, Cluster(address), chunk=4)
    assert marked.exists()
    assert [row for *_, row in found] == rows(records(90))


def test_a_record_that_kills_every_worker_is_named(tmp_path, address):
    given = [{**r, "kill": 1} if r["x"] == 3 else r for r in records(12)]
    found, _ = run(tmp_path / "kill.sqlite", given, Cluster(address), chunk=2)
    assert [k for k, _, _, row in found if row["status"] == "CRASHED"] == [3]


def test_a_cluster_that_has_lost_all_its_workers_ends_a_study(tmp_path, address):
    crew = Cluster(address, timeout=1.0)
    process, empty = started(0)
    with Client(empty, set_as_default=False) as client:
        executor = _Checked(client, {})
        crew.check(executor, 5.0)  # they may come back
        with pytest.raises(SimulationError, match="has had no worker for 7 s"):
            crew.check(executor, 7.0)
    process.communicate("")
    there = Cluster(address, timeout=60.0)
    executor = there.start()
    there.check(executor, 1e9)  # a long run on workers that are there
    there.stop(executor, True)


def test_a_study_says_for_how_long_nothing_has_ended(tmp_path, monkeypatch):
    """Counted anew once a run has ended; each of the three ends when that was asked of it."""
    ended, fresh, heard = [time.monotonic()], [0], []
    asked = [Event() for _ in range(3)]

    def slowly(given):
        assert asked[len(ended) - 1].wait(SOON)
        ended.append(time.monotonic())
        return rows(given)

    def check(crew, executor, idle):
        heard.append((idle, time.monotonic() - ended[fresh[-1]]))
        asked[fresh[-1]].set()

    monkeypatch.setattr(execute, "PATIENCE", 0.05)
    monkeypatch.setattr(Threads, "check", check)
    with open_store(tmp_path / "r.sqlite", about()) as store:
        run_study(
            slowly, records(3), store, Threads(1), chunk=1, progress=lambda p: fresh.append(p.fresh)
        )
    assert len(heard) >= 3
    assert all(0.05 <= idle <= most for idle, most in heard)


def test_a_worker_that_dies_with_a_result_that_nobody_has_fetched(address):
    class Lost:
        """A task whose state says that its worker died, while its result has come all the same."""

        status = "error"

        def add_done_callback(self, call):
            call(self)

        def result(self):
            return [1, 2, 3, 4]

    class Client:
        def submit(self, *args, **kwargs):
            return Lost()

    assert _Checked(Client(), {}).submit(len, "four").result(timeout=SOON) == [1, 2, 3, 4]


def test_a_scheduler_that_goes_away_ends_the_study_and_keeps_what_was_finished(tmp_path):
    process, address = started(1)

    def stop(p):
        if p.fresh >= 20:
            os.killpg(process.pid, signal.SIGKILL)

    path = tmp_path / "r.sqlite"
    begin = time.monotonic()
    with pytest.raises(SimulationError, match="gone away") as caught:
        run(path, records(400, 5e-3), Cluster(address), chunk=4, progress=stop)
    assert time.monotonic() - begin < 30.0
    assert caught.value.exit_code == 3  # no robot fell
    process.communicate()
    with open_store(path, about()) as store:
        assert 20 <= len(store) < 400


@pytest.mark.parametrize(
    "address",
    [
        "nowhere",
        "",
        "tcp://",
        "tcp://localhost",
        "tcp://host:port",
        "foo://bar:1",
        "tcp://host:70000",
    ],
)
def test_what_is_no_address(address):
    with pytest.raises(InputError, match=r"is '.*', expected one such as tcp://host:8786"):
        Cluster(address).start()


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:9", "127.0.0.1:9", "tls://127.0.0.1:9"])
def test_a_scheduler_that_does_not_answer(address):
    """And nothing of the attempt is left, which Dask would try to close while the next client starts."""
    begin = time.monotonic()
    gc.disable()
    try:
        with pytest.raises(InputError, match="no Dask scheduler answers"):
            Cluster(address, timeout=1.0).start()
        assert not [x for x in gc.get_objects() if type(x) is Client and x.status != "closed"]
    finally:
        gc.enable()
    assert time.monotonic() - begin < SOON


def test_a_scheduler_without_workers():
    process, address = started(0)
    with pytest.raises(InputError, match="no workers after 1 s"):
        Cluster(address, timeout=1.0).start()
    process.communicate("")


def test_a_worker_with_other_versions_is_refused(monkeypatch, address):
    other = {**numerical_versions(), "numpy": "99.1"}
    monkeypatch.setattr(of_cluster, "numerical_versions", lambda: other)
    with pytest.raises(InputError, match=r"worker tcp.*numpy .* there, 99.1 here"):
        Cluster(address).start()


def test_a_worker_that_joins_with_other_versions_is_refused():
    here = dict(numerical_versions())
    assert of_cluster._run(here, int, "3") == 3
    with pytest.raises(InputError, match=r"a worker of the cluster .*scipy .* there, 0 here"):
        of_cluster._run({**here, "scipy": "0"}, int, "3")
    assert "cannot be imported" in difference("biped-adrc cannot be imported there", here)


def test_without_dask_the_extra_is_named():
    code = """
        import sys
        sys.modules["distributed"] = None
        from biped_adrc.campaign.dask_cluster import Cluster
        Cluster("tcp://127.0.0.1:9").start()
    """
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, check=False
    )
    assert "pip install 'biped-adrc[cluster]'" in done.stderr
