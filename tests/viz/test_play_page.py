"""What the page says and keeps: refusals, limits, the ghost's values, and what the tour leaves behind."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from selenium.webdriver import Chrome

import biped_adrc as ba

from .browser import chromium, console, needs_chromium
from .hands import keys, opened, typed, until
from .served import served


@needs_chromium
def test_what_the_page_says_and_keeps(tmp_path: Path) -> None:
    async def visit(url: str) -> None:
        with chromium() as browser:
            opened(browser, url)
            refused_and_forgiven(browser)
            limits_go_along(browser)
            the_tour_gives_back(browser)
            ghosts_differ(browser)
            aims_from_the_newest_pose(browser)
            assert console(browser) == []

    scenario = ba.Scenario("ADRC", hardware="ideal", torque_limit=80.0)
    why, _ = served(visit, None, scenario=scenario, ghost={"controller": "NPD"}, out=tmp_path)
    assert why == "the browser has closed the page"


def refused_and_forgiven(browser: Chrome) -> None:
    typed(browser, "K_p", "1e308")
    assert "up to 1e+300" in until(browser, "return element('refused-K_p').textContent")
    typed(browser, "K_d", "60")
    until(browser, "return known[0].K_d === 60 && element('refused-K_p').textContent === ''")
    browser.execute_script("element('shove').value = 5000; shove(1)")
    assert "5000 N" in until(browser, "return element('refused').textContent")
    browser.execute_script("element('shove').value = ''; shove(1)")
    until(browser, "return element('refused').textContent === \"the hand's shove is no number\"")
    browser.execute_script("element('shove').value = 100; shove(1)")
    assert browser.execute_script("return element('refused').textContent") == ""
    browser.execute_script("send({ do: 'let_go' })")


def limits_go_along(browser: Chrome) -> None:
    friction = browser.execute_script("return scene.limits.friction")
    assert browser.execute_script("return scene.limits.torque") == 80.0
    browser.execute_script("change({ plant: 'mujoco', ground_friction: 0.3 })")
    until(browser, "return scene.limits.friction === 0.3")
    rigid = "scene.controls.choices.find((c) => c.name === 'plant').options[0].values"
    browser.execute_script(f"change({rigid})")
    until(
        browser,
        "return known[0].plant === 'rigid' && scene.limits.friction === arguments[0]",
        friction,
    )


def the_tour_gives_back(browser: Chrome) -> None:
    before = browser.execute_script("return known[0]")
    browser.set_window_size(1366, 768)
    keys(browser, "t")
    until(browser, "return known[0].torque_limit === 150 && scene.limits.torque === 150")
    picture_fits(browser)
    keys(browser, "n", "t")
    picture_fits(browser)
    until(browser, "return known[0].torque_limit === 80 && scene.limits.torque === 80")
    assert browser.execute_script("return known[0]") == before
    keys(browser, " ")
    until(browser, "return paused")


def picture_fits(browser: Chrome) -> None:
    """The canvas is as high as its place, also where the tour has taken room from it."""
    height = "getBoundingClientRect().height"
    until(browser, f"return Math.abs(pane.{height} - pane.querySelector('canvas').{height}) < 2")


def ghosts_differ(browser: Chrome) -> None:
    said = "return element('ghost-values').textContent"
    shown = browser.execute_script(said)
    assert shown == "K_d none", "the walk has 60"
    browser.execute_script("change({ K_d: null, noise: 1e-5 })")
    until(browser, said + " === 'noise 0'")


def aims_from_the_newest_pose(browser: Chrome) -> None:
    """The camera stands where the robot is with every message, not with every picture."""
    keys(browser, " ")
    script = """
    const gaps = [], hear = describe;
    describe = (message) => { gaps.push(Math.abs(eye.position.x - followed.x)); hear(message); };
    window.gaps = gaps;
    """
    browser.execute_script(script)
    gaps: Any = until(browser, "return window.gaps.length > 20 && window.gaps")
    assert max(gaps) == pytest.approx(0.0, abs=1e-12)
