"""Ctrl-C and a kill of a study: its processes end, what was finished is kept, and one traceback is printed."""

import contextlib
import os
import signal
import subprocess
import sys
from pathlib import Path

import psutil
import pytest
import standin

from biped_adrc.campaign.store_open import read_store

SOON = 30.0
"""[s] In which what takes less than a second has ended, on any machine; what would go on takes longer."""
MANY = 20_000
"""Records of 5 ms, for two workers: longer than `SOON`."""
SCRIPT = """
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from standin import about, records, rows
from biped_adrc.campaign.execute import run_study
from biped_adrc.campaign.store_open import open_store
from biped_adrc.campaign.workers import Processes

class Workers(Processes):
    # they say that they are told to stop, and wait for a line before they do, if that is asked for
    def stop(self, executor, now):
        if len(sys.argv) > 3:
            print("stopping", flush=True)
            sys.stdin.readline()
        super().stop(executor, now)

if __name__ == "__main__":
    with open_store(Path(sys.argv[2]), about()) as store:
        run_study(rows, records({N}, 5e-3), store, Workers(2, ("standin",)), chunk=4,
                  progress=lambda p: print(p.done, flush=True))
""".replace("{N}", str(MANY))


@pytest.fixture
def running(tmp_path, started):
    """Starts a study in two processes; its process when some of it is done, its file, and all below it."""
    folder, path, below = str(Path(standin.__file__).parent), tmp_path / "r.sqlite", []

    def start(*more):
        process = started(
            sys.executable, "-c", SCRIPT, folder, str(path), *more, stdin=subprocess.PIPE
        )
        while int(process.stdout.readline()) < 40:
            pass
        below.extend(psutil.Process(process.pid).children(recursive=True))
        return process, path, below

    yield start
    for one in below:
        with contextlib.suppress(psutil.NoSuchProcess):
            one.kill()


def tracebacks(err):
    """How many were printed; one that came while another error was handled counts with that one."""
    return err.count("Traceback") - err.count("During handling of the above exception")


def ended(process, path, below):
    """What was printed as errors; all processes end soon, and what was finished is kept."""
    _, err = process.communicate("\n", timeout=SOON)
    _, alive = psutil.wait_procs(below, SOON)
    assert not alive
    with read_store(path) as store:
        assert 40 <= len(store) < MANY
    return err


def test_ctrl_c_ends_all_processes_and_keeps_what_was_finished(running):
    process, path, below = running()
    os.killpg(process.pid, signal.SIGINT)
    err = ended(process, path, below)
    assert "KeyboardInterrupt" in err
    assert tracebacks(err) == 1, err


def test_killed_no_worker_is_left_behind(running):
    process, _, below = running()
    assert len(below) >= 3
    process.kill()
    _, alive = psutil.wait_procs(below, SOON)
    assert not alive
