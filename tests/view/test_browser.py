"""The animation in headless Chromium: where it draws the links, that it loads nothing and says nothing.

The fixture walks has two walks of RABBIT, under NPD and ADRC; opened is the browser with their page, and its
file. seek shows the walk at a time, world reads the placement of a node in the scene, and floating computes
placements by Pinocchio.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from selenium.webdriver import Chrome
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Event
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.recording import Walk
from biped_adrc.view.export import export
from biped_adrc.view.meshcat.objects import joint_path
from biped_adrc.view.placement import WalkScene

from .browser import chromium, console, requested, seek, world
from .pinocchio_view import floating


@pytest.fixture(scope="module")
def browser() -> Iterator[Chrome]:
    with chromium() as started:
        yield started


@pytest.fixture(scope="module")
def opened(
    browser: Chrome, walks: dict[str, Walk], tmp_path_factory: pytest.TempPathFactory
) -> tuple[Chrome, Path]:
    path = tmp_path_factory.mktemp("page") / "walk.html"
    export(path, walks)
    requested(browser)
    browser.get(path.as_uri())
    return browser, path


def end_of(walks: dict[str, Walk]) -> float:
    return max(walk.trajectory.t_end for walk in walks.values())


def test_nothing_else_is_loaded_and_nothing_is_complained_of(opened: tuple[Chrome, Path]) -> None:
    """The browser asked for the page's own file and no other address, and its console has no warning."""
    browser, path = opened
    # it plays, or has been loaded
    assert browser.execute_script("return viewer.animator.time > 0 || document.readyState") in (
        True,
        "complete",
    )
    assert requested(browser) == [path.as_uri()]
    assert console(browser) == []


def test_links_are_where_pinocchio_puts_them(
    opened: tuple[Chrome, Path], biped: Biped, walks: dict[str, Walk]
) -> None:
    """In the scene of the running page each link has the placement that Pinocchio computes for the walk at t.
    The last walk is drawn in lane 0, the other one as its ghost 0.4 m behind it (y).
    """
    browser, _ = opened
    solid = list(walks)[-1]
    for t in np.linspace(0.0, 0.999 * end_of(walks), 4):
        seek(browser, float(t))
        for name, walk in walks.items():
            laid_out = WalkScene.of(walk)
            expected = floating(biped, laid_out.joints(float(t)))
            lane = 0 if name == solid else 1
            for joint in biped.tree.joints:
                path = f"meshcat/robots/{lane}/{joint_path(biped.tree, joint)}"
                drawn = world(browser, path)
                there = expected[joint.child].copy()
                there[1, 3] += 0.4 * lane
                np.testing.assert_allclose(
                    drawn, there, rtol=0.0, atol=1e-5, err_msg=f"{path}, t = {t}"
                )


def test_the_player_plays_pauses_and_obeys_the_keyboard(opened: tuple[Chrome, Path]) -> None:
    """An arrow key is one frame of 1/60 s, the space bar plays and pauses, Home goes to 0; the clock shows the
    time.
    """
    browser, _ = opened
    body = browser.find_element(By.TAG_NAME, "body")
    seek(browser, 0.2)
    body.send_keys(Keys.ARROW_RIGHT)
    time = "return viewer.animator.time"
    assert browser.execute_script(time) == pytest.approx(0.2 + 1 / 60)
    body.send_keys(" ")
    WebDriverWait(browser, 20.0).until(lambda page: page.execute_script(time) > 0.25)
    body.send_keys(" ")
    at = browser.execute_script(time)
    assert browser.find_element(By.ID, "clock").text.startswith(f"t = {at:.2f} s, step ")
    body.send_keys(Keys.HOME)
    assert browser.execute_script(time) == 0.0


def test_a_walk_that_fell_says_so_and_its_arrow_is_cut(
    browser: Chrome, walks: dict[str, Walk], tmp_path: Path
) -> None:
    """A walk is changed so that it ends as fallen: the message is shown at its end and not at 0.5 s. A force of
    1e15 N, put in by script, has an arrow as long as the longest, 1.2 m, and the clock says so.
    """
    walk = walks["NPD"]
    *before, last = walk.trajectory.arcs
    event = Event("hip_too_low", float(last.t[-1]), last.x[-1], None)
    trajectory = replace(walk.trajectory, arcs=(*before, replace(last, event=event)))
    fell = replace(walk, trajectory=replace(trajectory, status=Status.FELL))
    path = tmp_path / "fell.html"
    export(path, {"NPD": fell, "ADRC": walks["ADRC"]})
    browser.get(path.as_uri())
    message = browser.find_element(By.ID, "message")
    seek(browser, 0.5)
    assert not message.is_displayed()
    seek(browser, end_of(walks))
    assert message.is_displayed()
    assert message.text == f"NPD fell at {trajectory.t_end:.2f} s: hip too low"
    # a force of 1e15 N: the arrow ends where the longest does, and the clock says how large the force is
    length, clock = browser.execute_script(
        "const pose = leader.at(0.1); pose.loads = [0, 1e15, 0, 0, 0, 0, 0];"
        "show(0.1, robots.map((robot) => robot === leader ? pose : robot.at(0.1)));"
        "return [leader.arrows[0].head.position.z + leader.walk.head, document.getElementById('clock').value];"
    )
    assert length == pytest.approx(1.2)
    assert "ground reaction of ADRC 1.00e+15 N (arrow cut)" in clock
    assert console(browser) == []
