"""The same study on a real Dask cluster of separate processes, with a worker that dies."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
import standin
from standin import about, carried_out, records, results, rows

from biped_adrc.bench.study_file import read_study
from biped_adrc.bench.sweep import sweep
from biped_adrc.campaign import dask_cluster as of_cluster
from biped_adrc.campaign.dask_cluster import Cluster
from biped_adrc.campaign.store import open_store
from biped_adrc.campaign.workers import Threads
from biped_adrc.errors import InputError
from biped_adrc.versions import differences

pytestmark = pytest.mark.filterwarnings("ignore")
FOLDER = Path(standin.__file__).parent

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


@pytest.fixture(scope="module")
def address():
    """Of a cluster in a process of its own, with two workers in theirs."""
    process = subprocess.Popen(
        [sys.executable, "-c", SCHEDULER, str(FOLDER), "2"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
        env={**os.environ, "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "1"},
    )
    yield process.stdout.readline().strip()
    process.communicate("")


def run(path, given, workers, **more):
    with open_store(path, about()) as store:
        summary = carried_out(rows, given, store, workers, **more)
        return results(store), summary


def test_walks_are_the_same_as_in_threads(tmp_path, address):
    study = read_study(
        {
            "study": {"name": "walks", "seeds": 2},
            "fixed": {"controller": "NPD", "impacts": 1, "start_rate_spread": 0.05},
            "grid": {"K_p": [4000.0, 5000.0]},
        }
    )
    here = sweep(study, tmp_path / "here", Threads(2))
    there = sweep(study, tmp_path / "there", Cluster(address), chunk=1)
    assert list(there.rows()) == list(here.rows())
    assert there.statuses() == {"COMPLETED": 4}


def test_a_worker_that_is_killed_in_the_middle(tmp_path, address):
    marked = tmp_path / "died"
    given = [{**r, "once": str(marked)} if r["x"] == 40 else r for r in records(90)]
    found, _ = run(tmp_path / "killed.sqlite", given, Cluster(address), chunk=4)
    assert marked.exists()
    assert [row for *_, row in found] == rows(records(90))


@pytest.mark.parametrize("address", ["tcp://host:port", "tcp://127.0.0.1:9"])
def test_a_scheduler_that_does_not_answer(address):
    with pytest.raises(InputError, match=f"no Dask scheduler answers at '{address}'"):
        Cluster(address, timeout=1.0).start()


def test_a_worker_with_other_versions_is_refused(monkeypatch, address):
    def other(found, here):
        return differences(found, {**here, "numpy": "99.1"})

    monkeypatch.setattr(of_cluster, "differences", other)
    with pytest.raises(InputError, match=r"worker tcp.*numpy .* there, 99.1 here"):
        Cluster(address).start()
