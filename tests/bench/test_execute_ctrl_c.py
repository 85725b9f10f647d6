"""Ctrl-C and a kill of a study: its processes end, what was finished is kept, and one traceback is printed."""

import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import psutil
import pytest
import standin

from biped_adrc.campaign.store_open import read_store
from biped_adrc.campaign.workers import Processes

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


def test_ctrl_c_while_workers_stop_is_as_once(running):
    process, path, below = running("asking")
    os.killpg(process.pid, signal.SIGINT)
    while process.stdout.readline() != "stopping\n":
        pass
    for _ in range(5):
        os.killpg(process.pid, signal.SIGINT)
        time.sleep(0.02)
    err = ended(process, path, below)
    assert tracebacks(err) == 1, err


def test_ctrl_c_again_and_again_leaves_nothing_behind(running):
    """Also where one of them comes as the interpreter ends, which may print more than one traceback."""
    process, path, below = running()
    for _ in range(5):
        os.killpg(process.pid, signal.SIGINT)
        time.sleep(0.02)
    ended(process, path, below)
    assert process.returncode != 0


@pytest.mark.parametrize("pause", [0.3, 0.6, 0.9, 1.2, 1.6])
def test_ctrl_c_while_workers_start(tmp_path, pause, started):
    folder = Path(standin.__file__).parent
    text = SCRIPT.replace("with open_store", "print(0, flush=True); \n    with open_store")
    process = started(sys.executable, "-c", text, str(folder), str(tmp_path / "r.sqlite"))
    process.stdout.readline()
    time.sleep(pause / 2)
    os.killpg(process.pid, signal.SIGINT)
    _, err = process.communicate(timeout=SOON)
    assert tracebacks(err) == 1, err
    assert err.rstrip().endswith("KeyboardInterrupt"), err


def test_workers_that_are_stopped_leave_no_thread_that_the_interpreter_would_wait_for():
    before = {*threading.enumerate()}
    crew = Processes(2)
    executor = crew.start()
    pending = [executor.submit(time.sleep, 60.0) for _ in range(4)]
    crew.stop(executor, True)
    assert {*threading.enumerate()} <= before
    assert all(future.done() for future in pending)


def test_killed_no_worker_is_left_behind(running):
    process, _, below = running()
    assert len(below) >= 3
    process.kill()
    _, alive = psutil.wait_procs(below, SOON)
    assert not alive
