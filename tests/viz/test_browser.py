"""The animation in headless Chromium: where it draws the links, that it loads nothing and says nothing."""

from __future__ import annotations

import io
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from selenium.webdriver import Chrome
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Event
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.recording import Walk
from biped_adrc.viz.export import export
from biped_adrc.viz.meshcat.objects import joint_path
from biped_adrc.viz.placement import WalkScene, loads, slipping

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
    browser, path = opened
    assert browser.execute_script("return viewer.animator.time > 0 || document.readyState") in (
        True,
        "complete",
    )
    assert requested(browser) == [path.as_uri()]
    assert console(browser) == []


def test_links_are_where_pinocchio_puts_them(
    opened: tuple[Chrome, Path], biped: Biped, walks: dict[str, Walk]
) -> None:
    browser, _ = opened
    solid = list(walks)[-1]
    for t in np.linspace(0.0, 0.999 * end_of(walks), 10):
        seek(browser, float(t))
        for name, walk in walks.items():
            laid_out = WalkScene.of(walk)
            expected = floating(biped, laid_out.joints(float(t)))
            lane = 0.0 if name == solid else 0.4
            for joint in biped.tree.joints:
                path = f"meshcat/robots/{name}/{joint_path(biped.tree, joint)}"
                drawn = world(browser, path)
                there = expected[joint.child].copy()
                there[1, 3] += lane
                np.testing.assert_allclose(drawn, there, atol=1e-5, err_msg=f"{path}, t = {t}")


def test_the_stance_foot_stays_on_its_footprint(
    opened: tuple[Chrome, Path], biped: Biped, walks: dict[str, Walk]
) -> None:
    browser, _ = opened
    walk, d = walks["ADRC"], biped.description
    footholds = WalkScene.of(walk).footholds
    by_child = {joint.child: joint for joint in biped.tree.joints}
    for i, arc in enumerate(walk.trajectory.arcs):
        foot = by_child[d.stance_foot if i % 2 == 0 else d.swing_foot]
        path = f"meshcat/robots/ADRC/{joint_path(biped.tree, foot)}"
        for t in np.linspace(arc.t[0] + 1e-9, arc.t[-1] - 1e-9, 9):
            seek(browser, float(t))
            x, _, z = world(browser, path)[:3, 3]
            footprint = world(browser, f"meshcat/robots/ADRC/footprints/{i}")[0, 3]
            assert abs(x - footprint) < 1e-4
            assert abs(footprint - footholds[i]) < 1e-6
            assert abs(z) < 1e-4


def picture(browser: Chrome) -> np.ndarray:
    png = browser.find_element(By.ID, "meshcat-pane").screenshot_as_png
    return np.asarray(Image.open(io.BytesIO(png)).convert("L"), dtype=float)


def test_pictures_are_not_blank_and_differ(
    opened: tuple[Chrome, Path], walks: dict[str, Walk]
) -> None:
    browser, _ = opened
    end = end_of(walks)
    shown = []
    for t in (0.0, 0.5 * end, end):
        seek(browser, t)
        shown.append(picture(browser))
    for image in shown:
        assert np.mean(image < 200) > 0.005  # some of it is robot and ground
        assert image.std() > 5.0
    for a, b in ((0, 1), (1, 2), (0, 2)):
        assert np.mean(np.abs(shown[a] - shown[b]) > 20) > 1e-3


def test_side_view_is_orthographic_and_follows_the_robot(
    opened: tuple[Chrome, Path], walks: dict[str, Walk]
) -> None:
    browser, _ = opened
    middle = []
    for t in (0.0, 0.9 * end_of(walks)):
        seek(browser, t)
        assert browser.execute_script("return viewer.camera.isOrthographicCamera") is True
        hip = world(browser, "meshcat/robots/ADRC/base_x")[0, 3]
        middle.append(browser.execute_script("return viewer.camera.position.x") - hip)
    assert middle[0] == pytest.approx(middle[1], abs=1e-6)
    browser.find_element(By.ID, "view").click()
    assert browser.execute_script("return viewer.camera.isPerspectiveCamera") is True
    browser.find_element(By.ID, "view").click()
    assert browser.execute_script("return viewer.camera.isOrthographicCamera") is True


def test_it_plays_pauses_and_obeys_the_keyboard(opened: tuple[Chrome, Path]) -> None:
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
    browser.execute_async_script("setTimeout(arguments[0], 200)")
    assert browser.execute_script(time) == at
    assert browser.find_element(By.ID, "clock").text.startswith(f"t = {at:.2f} s, step ")
    body.send_keys(Keys.HOME)
    assert browser.execute_script(time) == 0.0


def test_legs_change_colour_at_impact(opened: tuple[Chrome, Path], walks: dict[str, Walk]) -> None:
    browser, _ = opened
    impact = walks["ADRC"].trajectory.events("foot_strike")[0].t
    colours = []
    for t in (impact - 1e-3, impact + 1e-3):
        seek(browser, t)
        colours.append(
            browser.execute_script(
                "return robots[scene.leader].legs.map((leg) => leg[0].color.getHex())"
            )
        )
    assert colours[0] == colours[1][::-1]
    assert len(set(colours[0])) == 2


def test_the_second_foot_has_an_arrow_and_the_clock_says_slips(
    browser: Chrome, slippery: Walk, tmp_path: Path
) -> None:
    path = tmp_path / "soft.html"
    export(path, {"NPD": slippery})
    browser.get(path.as_uri())
    laid_out = WalkScene.of(slippery)
    arc = slippery.trajectory.arcs[1]
    other, slips = arc.read["foot_force"][:, 3], slipping(laid_out, arc)
    kinds = set()
    for k in (*np.flatnonzero(other[:-1] > 0.0)[:4:3], *np.flatnonzero(slips[:-1])[:9:4], 200):
        t = float(arc.t[k]) + 1e-6
        seek(browser, t)
        acting = loads(laid_out, t)
        shown, clock = browser.execute_script(
            "return [leader.arrows.map((arrow) => arrow.whole.visible), "
            "document.getElementById('clock').value];"
        )
        assert shown == [True, bool(acting.other.any())]
        assert clock.endswith(", slips") == acting.slips
        kinds.add((shown[1], acting.slips))
        x = world(browser, "meshcat/robots/NPD/ground_reaction")[0, 3]
        assert abs(x - laid_out.foot(1, t)[0]) < 1e-3
    assert kinds >= {(True, True), (False, False)}
    assert console(browser) == []


def test_a_walk_that_fell_says_so_and_its_arrow_is_cut(
    browser: Chrome, walks: dict[str, Walk], tmp_path: Path
) -> None:
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
