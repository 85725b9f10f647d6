"""Live mode: who can reach it, how it ends, and that it never hangs."""

from __future__ import annotations

import asyncio
import signal
import subprocess
import time
import urllib.error
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import psutil
import pytest
from selenium.webdriver.common.by import By

from biped_adrc.errors import InputError
from biped_adrc.scenario.run import walk_scenario
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.stored import load_walk
from biped_adrc.viz.meshcat.live import play
from biped_adrc.viz.meshcat.view import Look

from .browser import chromium, console, needs_chromium
from .processes import COMMAND, SOON, Live, get, listening

SERVED = ("--live", "--no-browser")


@pytest.fixture(scope="module")
def stored(tmp_path_factory: pytest.TempPathFactory) -> Path:
    run = Scenario("NPD", impacts=3, h=2e-3)
    path = tmp_path_factory.mktemp("runs") / "walk.npz"
    walk_scenario(run).save(path)
    return path


@pytest.fixture
def live(stored: Path) -> Iterator[Live]:
    session = Live("animate", str(stored), *SERVED)
    yield session
    session.close()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_and_nothing_is_left(live: Live, number: signal.Signals) -> None:
    assert listening(live.process.pid) == [("127.0.0.1", live.port)]
    assert "MeshCat" in get(live.url)
    assert psutil.Process(live.process.pid).children() == []
    live.process.send_signal(number)
    code, said = live.ends()
    assert code == 0
    assert said == f"stopped by {number.name}"
    with pytest.raises(urllib.error.URLError):
        get(live.url)


def test_two_sessions_do_not_collide(live: Live, stored: Path) -> None:
    other = Live("animate", str(stored), *SERVED)
    try:
        assert other.port != live.port
        assert "MeshCat" in get(other.url)
        other.process.send_signal(signal.SIGTERM)
        assert other.ends()[0] == 0
        assert "MeshCat" in get(live.url)
    finally:
        other.close()


def test_a_port_in_use_is_refused(live: Live, stored: Path) -> None:
    found = subprocess.run(
        [*COMMAND, "animate", str(stored), *SERVED, "--port", str(live.port)],
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert found.returncode == 3
    assert f"port {live.port} cannot be used" in found.stderr


def test_a_port_that_does_not_exist_is_refused(stored: Path) -> None:
    with pytest.raises(InputError, match="port is 99999, expected 1 to 65535"):
        play({"NPD": load_walk(stored)}, Look(), port=99999, open_browser=False)


def test_other_names_of_this_machine_are_refused(live: Live) -> None:
    with pytest.raises(urllib.error.HTTPError, match="403"):
        get(live.url, host="attacker.example")


SAMPLED = """
const done = arguments[0], times = [];
const timer = setInterval(() => {
  times.push(viewer.animator.time);
  if (times.length === 40) { clearInterval(timer); done(times); }
}, 40);
"""


@needs_chromium
def test_the_page_moves_and_closing_it_ends_the_session(live: Live) -> None:
    with chromium() as browser:
        browser.get(live.url)
        times = browser.execute_async_script(SAMPLED)
        moving = [b - a for a, b in pairwise(times) if b > a > 0.0]
        assert len(moving) >= 2
        assert browser.find_element(By.ID, "clock").text.startswith("t = ")
        assert console(browser) == []
    code, said = live.ends()
    assert (code, said) == (0, "the browser has closed the page")


@needs_chromium
def test_killing_the_browser_ends_the_session(live: Live) -> None:
    with chromium() as browser:
        browser.get(live.url)
        browser.execute_async_script("setTimeout(arguments[0], 500)")
        driver = psutil.Process(browser.service.process.pid)
        for process in driver.children(recursive=True):
            process.kill()
        assert live.ends() == (0, "the browser has closed the page")


@needs_chromium
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGSTOP])
def test_the_page_says_that_the_server_is_gone(live: Live, number: signal.Signals) -> None:
    with chromium() as browser:
        browser.get(live.url)
        browser.execute_async_script("setTimeout(arguments[0], 500)")
        live.process.send_signal(number)
        message, until = browser.find_element(By.ID, "message"), time.monotonic() + SOON
        while not message.is_displayed():
            assert time.monotonic() < until, "the page says nothing"
            time.sleep(0.1)
        assert message.text.startswith("The server has stopped")


@needs_chromium
def test_ending_it_tells_the_page(live: Live) -> None:
    with chromium() as browser:
        browser.get(live.url)
        browser.execute_async_script("setTimeout(arguments[0], 500)")
        live.process.send_signal(signal.SIGTERM)
        assert live.ends()[0] == 0
        message, until = browser.find_element(By.ID, "message"), time.monotonic() + SOON
        while not message.is_displayed():
            assert time.monotonic() < until
            time.sleep(0.1)
        assert "was ended where it was started" in message.text


def test_it_does_not_wait_for_ever_for_a_browser(stored: Path) -> None:
    session = Live("animate", str(stored), *SERVED, "--wait", "0.5")
    try:
        code, said = session.ends()
        assert (code, said) == (0, "no browser has opened the page within 0.5 s")
    finally:
        session.close()


def test_inside_a_running_loop_it_says_what_to_do(stored: Path) -> None:
    async def inside() -> None:
        play({"NPD": load_walk(stored)}, Look(), open_browser=False)

    with pytest.raises(InputError, match="last line of a cell"):
        asyncio.run(inside())
