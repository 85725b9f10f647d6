"""`biped-adrc play` as a process: how it ends, what it leaves, and what it says."""

import asyncio
import os
import signal
import subprocess

import psutil
import pytest

from .browser import chromium, needs_chromium
from .hands import opened, pulled, until
from .processes import COMMAND, Live, get, listening
from .served import Page

PLAY = ("play", "--robot", "rabbit")


@pytest.fixture
def live():
    session = Live(*PLAY, "--no-browser")
    yield session
    session.close()


@needs_chromium
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_in_the_middle_of_a_pull_ends_it_and_nothing_is_left(live, number):
    assert listening(live.process.pid) == [("127.0.0.1", live.port)]
    with chromium() as browser:
        opened(browser, live.url)
        pulled(browser)
        live.process.send_signal(number)
        assert live.ends() == (0, f"stopped by {number.name}")
        assert "was ended where it was started" in until(
            browser, "return element('message').textContent"
        )


@needs_chromium
def test_a_browser_that_is_killed_in_the_middle_of_a_pull_lets_go_and_the_walk_goes_on(live):
    with chromium() as browser:
        opened(browser, live.url)
        pulled(browser)
        asyncio.run(killed(browser, live.url))
        assert live.ends() == (0, "the browser has closed the page")


async def killed(browser, url):
    """Another page, which sees the hand let go when the browser is killed."""
    page = await Page.open(url)
    await page.frame(lambda f: f["hand"] is not None)
    for process in psutil.Process(browser.service.process.pid).children(recursive=True):
        process.kill()
    await page.frame(lambda f: f["hand"] is None)
    await page.say(do="go")
    now = await page.frame()
    await page.frame(lambda f: f["t"] > now["t"] + 0.05 and not f["walks"][0]["ending"])
    await page.close()


@needs_chromium
def test_a_server_that_stands_still_is_said_to_be_silent_until_it_goes_on(live):
    with chromium() as browser:
        opened(browser, live.url)
        live.process.send_signal(signal.SIGSTOP)
        until(browser, "return element('message').textContent.includes('has said nothing')")
        live.process.send_signal(signal.SIGCONT)
        until(browser, "return element('message').hidden")


def test_a_port_in_use_and_a_missing_browser_are_said(live):
    refused = subprocess.run(
        [*COMMAND, *PLAY, "--no-browser", "--port", str(live.port)],
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert refused.returncode == 3
    assert f"port {live.port} cannot be used" in refused.stderr
    assert "play" in get(live.url)
    alone = Live(*PLAY, "--wait", "5", BROWSER="no-such-browser", PATH=os.path.dirname(COMMAND[0]))
    try:
        code, said = alone.ends()
    finally:
        alone.close()
    assert code == 0
    assert "no browser could be opened here" in said
    assert "no browser has opened the page within 5 s" in said
