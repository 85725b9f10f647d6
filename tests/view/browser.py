"""Headless Chromium for the tests of pages: what it needs, what it loads, what it says."""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest
from selenium.webdriver import Chrome, ChromeOptions
from selenium.webdriver.chrome.service import Service

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
FLAGS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--enable-unsafe-swiftshader",  # WebGL without a graphics processor
    "--disable-background-networking",
    "--window-size=1000,700",
)


@contextmanager
def chromium() -> Iterator[Chrome]:
    """A browser that logs its console and its network; without Chromium the test is skipped."""
    if CHROMIUM is None or DRIVER is None:
        pytest.skip("no Chromium")
    options = ChromeOptions()
    options.binary_location = CHROMIUM
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        for flag in (*FLAGS, f"--user-data-dir={profile}"):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        browser = Chrome(options, Service(DRIVER))
        browser.set_script_timeout(60)
        try:
            yield browser
        finally:
            browser.quit()


SLOW = "GPU stall due to ReadPixels"
"""What Chromium says of WebGL without a graphics processor."""


def console(browser: Chrome) -> list[str]:
    """Warnings and errors of the console since the last call, but for SLOW."""
    entries = [e for e in browser.get_log("browser") if e["level"] in ("SEVERE", "WARNING")]
    return [e["message"] for e in entries if SLOW not in e["message"]]


def requested(browser: Chrome) -> list[str]:
    """Addresses asked for since the last call, but for data:, blob: and the browser's own pages."""
    messages = [json.loads(e["message"])["message"] for e in browser.get_log("performance")]
    urls = [
        m["params"]["request"]["url"] if "request" in m["params"] else m["params"]["url"]
        for m in messages
        if m["method"] in ("Network.requestWillBeSent", "Network.webSocketCreated")
    ]
    return [url for url in urls if not url.startswith(("data:", "blob:", "chrome:"))]


def seek(browser: Chrome, t: float) -> None:
    """Show the walk at t [s]."""
    browser.execute_script(
        "viewer.animator.pause(); viewer.animator.seek(arguments[0]);"
        "viewer.scene.updateMatrixWorld(true); viewer.render();",
        t,
    )


def world(browser: Chrome, path: str) -> np.ndarray:
    """Placement (4, 4) of a node in the scene, whose z is up (the viewer's own world has y up)."""
    found, root = browser.execute_script(
        "let n = viewer.scene_tree; for (const name of arguments[0].split('/')) {"
        "  n = n.children[name]; if (n === undefined) throw new Error('no node ' + name); }"
        "return [n.object, viewer.scene].map((o) => o.matrixWorld.elements);",
        path,
    )
    M, base = (np.array(elements).reshape(4, 4).T for elements in (found, root))
    return np.linalg.solve(base, M)
