"""Ctrl-C and a kill of a study: its processes end, what was finished is kept, and one traceback is printed."""

import contextlib
import os
import signal
import sys
from pathlib import Path

import psutil
import pytest
import standin

from biped_adrc.campaign.store import read_store

SOON = 60.0
"""[s] In which what takes less than a second has ended, on any machine; what would go on takes longer."""
MANY = 50_000
"""Records of 5 ms, for two workers: longer than `SOON`."""
SCRIPT = """
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from standin import about, carried_out, records, rows
from biped_adrc.campaign.store import open_store
from biped_adrc.campaign.workers import Processes

if __name__ == "__main__":
    with open_store(Path(sys.argv[2]), about()) as store:
        carried_out(rows, records({N}, 5e-3), store, Processes(2, ("standin",)), chunk=4,
                  progress=lambda p: print(p.done, flush=True))
""".replace("{N}", str(MANY))


@pytest.fixture
def running(tmp_path, started):
    """Starts a study in two processes; its process when some of it is done, its file, and all below it."""
    folder, path, below = str(Path(standin.__file__).parent), tmp_path / "r.sqlite", []

    def start():
        process = started(sys.executable, "-c", SCRIPT, folder, str(path))
        while int(process.stdout.readline()) < 40:
            pass
        below.extend(psutil.Process(process.pid).children(recursive=True))
        return process, path, below

    yield start
    for one in below:
        with contextlib.suppress(psutil.NoSuchProcess):
            one.kill()


def test_ctrl_c_ends_all_processes_and_keeps_what_was_finished(running):
    process, path, below = running()
    os.killpg(process.pid, signal.SIGINT)
    _, err = process.communicate(timeout=SOON)
    _, alive = psutil.wait_procs(below, SOON)
    assert not alive
    with read_store(path) as store:
        assert 40 <= len(store) < MANY
    assert err.rstrip().endswith("KeyboardInterrupt")
    assert err.count("Traceback") - err.count("During handling of the above exception") == 1, err


def test_killed_no_worker_is_left_behind(running):
    process, _, below = running()
    assert len(below) >= 3
    process.kill()
    _, alive = psutil.wait_procs(below, SOON)
    assert not alive
