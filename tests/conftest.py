"""Robots and gaits shared by the tests; a Biped is loaded once."""

from __future__ import annotations

import contextlib
import gc
import os
import shutil
import signal
import subprocess

import pytest
from xdist.scheduler import LoadScopeScheduling

import biped_adrc as ba
from biped_adrc.core.files import data_folder

PRESETS = ("identified", "identified-bare", "tac2003")


def pytest_configure():
    """Ctrl-C ends the commands that tests start, also where the suite is a job in the background.

    Such a job is started with SIGINT ignored, and hands that on to its children.
    """
    signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_terminal_summary(terminalreporter):
    """Say once what the tests of pages miss."""
    if any("no Chromium" in str(x.longrepr) for x in terminalreporter.stats.get("skipped", ())):
        terminalreporter.line(
            "tests of pages are skipped: on Debian, apt-get install chromium chromium-driver"
        )


@pytest.fixture
def started():
    """Starts a process in a group of its own, in text mode; the test leaves no such group, however it ends."""
    processes = []

    def start(*words, **more):
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
        processes.append(subprocess.Popen(words, start_new_session=True, **pipes | more))
        return processes[-1]

    yield start
    for process in processes:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


@pytest.fixture(scope="session", params=PRESETS)
def any_biped(request):
    return ba.Biped.load("rabbit", request.param)


@pytest.fixture(scope="session")
def biped():
    return ba.Biped.load("rabbit")


@pytest.fixture(scope="session")
def gait(biped):
    return ba.load_gait("published", biped)


@pytest.fixture(scope="session")
def bare():
    return ba.Biped.load("rabbit", "identified-bare")


@pytest.fixture(scope="session")
def published(bare):
    return ba.load_gait("published", bare)


@pytest.fixture(scope="session")
def slow_knee(tmp_path_factory):
    """RABBIT whose right knee bears 2 rad/s and stays below -0.1 rad; the others state nothing.

    On v0.6 a knee turns at up to 3.33 rad/s as the swing leg's, 1.63 as the stance leg's, which reaches -0.04.
    """
    folder = tmp_path_factory.mktemp("slow") / "rabbit"
    shutil.copytree(data_folder("urdf") / "rabbit", folder)
    text = (folder / "floating.urdf").read_text()
    knee = text.index("<limit", text.index('name="right_knee"'))
    limit = '<limit lower="-2.5" upper="-0.1" effort="150" velocity="2"/>'
    text = text[:knee] + limit + text[text.index("/>", knee) + 2 :]
    (folder / "floating.urdf").write_text(text)
    return ba.Biped.load(folder / "robot.toml")


WAIT = ("view", "study")
"""Folders whose tests wait, for browsers and processes: first, as other work goes on beside the suite then."""


ALONE = ("test_every_block_runs", "test_every_example_runs")
"""Tests of documents and examples, which are long: any worker runs one of them."""


class ByFile(LoadScopeScheduling):
    """A file is run by one worker, which makes its fixtures once."""

    def _split_scope(self, nodeid):
        file, _, name = nodeid.partition("::")
        return nodeid if name.startswith(ALONE) else file


def pytest_xdist_make_scheduler(config, log):
    return ByFile(config, log)


def pytest_collection_finish():
    """Python's collector of garbage need not look at modules and tests again, which stay to the end."""
    gc.freeze()


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """What waits comes first and documents second: no worker is left alone with one of them."""
    items.sort(
        key=lambda item: (item.path.parent.name not in WAIT, not item.name.startswith(ALONE))
    )
