"""The report in headless Chromium: it loads nothing, complains of nothing, and its animation runs inside it."""

from __future__ import annotations

import io
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from selenium.webdriver import Chrome
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from biped_adrc.scenario.recording import Walk
from biped_adrc.viz.meshcat.view import animation_html
from biped_adrc.viz.pages import write_report

from .browser import chromium, console, requested
from .test_report import SUMMARY


@pytest.fixture(scope="module")
def opened(
    walks: dict[str, Walk], tmp_path_factory: pytest.TempPathFactory
) -> Iterator[tuple[Chrome, Path]]:
    path = tmp_path_factory.mktemp("report") / "report.html"
    write_report(path, SUMMARY, {}, animation_html(walks))
    with chromium() as browser:
        requested(browser)
        browser.get(path.as_uri())
        frame = browser.find_element(By.TAG_NAME, "iframe")
        browser.execute_script("arguments[0].scrollIntoView()", frame)
        browser.switch_to.frame(frame)
        ready = "return typeof viewer === 'object' && typeof viewer.animator === 'object'"
        WebDriverWait(browser, 30.0).until(lambda page: page.execute_script(ready))
        browser.switch_to.default_content()
        time.sleep(1.0)
        yield browser, path


def test_nothing_is_loaded_and_the_animation_runs(opened: tuple[Chrome, Path]) -> None:
    browser, path = opened
    frame = browser.find_element(By.TAG_NAME, "iframe")
    image = np.asarray(Image.open(io.BytesIO(frame.screenshot_as_png)).convert("RGB"), dtype=float)
    blue = (image[:, :, 2] > image[:, :, 0] + 60) & (image[:, :, 2] > 120)
    assert blue.mean() > 1e-3  # the stance leg
    assert requested(browser) == [path.as_uri()]
    assert console(browser) == []


def test_tab_leads_into_the_animation(opened: tuple[Chrome, Path]) -> None:
    browser, _ = opened
    browser.execute_script("document.body.focus(); window.scrollTo(0, 0)")
    for _ in range(20):
        browser.switch_to.active_element.send_keys(Keys.TAB)
        if browser.execute_script("return document.activeElement.tagName") == "IFRAME":
            break
    else:
        pytest.fail("20 tabs do not reach the animation")
    browser.switch_to.frame(browser.find_element(By.TAG_NAME, "iframe"))
    try:
        assert browser.execute_script("return document.activeElement.id") in ("play", "seek")
        before = browser.find_element(By.ID, "play").text
        browser.find_element(By.ID, "play").send_keys(Keys.ENTER)
        assert browser.find_element(By.ID, "play").text != before
    finally:
        browser.switch_to.default_content()


def test_it_fits_a_narrow_window(opened: tuple[Chrome, Path]) -> None:
    browser, _ = opened
    size = browser.get_window_size()
    try:
        browser.set_window_size(500, 900)
        widths = (
            "return [document.documentElement.scrollWidth, document.documentElement.clientWidth]"
        )
        inside, window = browser.execute_script(widths)
        assert inside <= window
    finally:
        browser.set_window_size(size["width"], size["height"])
