"""The page that walks without a server: what WebAssembly and scripts make of a walk is that of a session."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from selenium.webdriver import Chrome
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.cli import app
from biped_adrc.engine.webassembly import web_module
from biped_adrc.errors import InputError, OutputError
from biped_adrc.live.controls import tour
from biped_adrc.live.driver import Driver
from biped_adrc.live.frame import frame, named
from biped_adrc.live.live_walk import revised
from biped_adrc.live.offline import FIRST, page, write_play
from biped_adrc.live.session import Session

from .browser import chromium, console, needs_chromium, requested
from .hands import keys, let_go, opened, pulled, until

OTHERS: dict[str, dict[str, object]] = {
    "NPD": {"controller": "NPD"},
    "ADRC": {"controller": "ADRC"},
    "m = 3": {"controller": "ADRC", "order": 3, "bandwidth": 300.0},
}
SAMPLES, EVERY = 2000, 50
WALKED = """
const session = socket.session, [name, samples, every] = arguments, states = [], frames = [];
session.begin(name, "NPD");
for (let k = 0; k < samples; k += 1) {
  const [walk] = session.walking;
  const push = { torque: { q1: 30, q2: 30 }, force: [40, -10], link: "right_shin", at: [0.02, -0.1] };
  if (k === 600) session.push(push);
  if (k === 1200) session.pull({ link: "torso", at: [0, 0.3], anchor: [walk.foot[0] + 0.3, 1.4] });
  if (k === 1700) session.let_go();
  if (k === samples - 1) session.made = session.walking.map(() => []);
  session.sample();
  const now = session.walking.map((w) => [w.t, w.step, ...w.foot, ...w.q, ...w.v]);
  if (k % every === every - 1) states.push(now);
}
return { states, endings: session.walking.map((w) => w.ending), frame: session.frame() };
"""


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_play(tmp_path_factory.mktemp("page") / "play.html", others=OTHERS)


@pytest.fixture(scope="module")
def browser(path: Path) -> Iterator[Chrome]:
    with chromium() as browser:
        opened(browser, path.as_uri())
        yield browser


def scenario_of(name: str) -> ba.Scenario:
    """Of a walk of the page: one of OTHERS, or of a station of the tour."""
    values = OTHERS.get(name) or next(x["values"] for x in tour() if x["title"] == name)
    return revised(FIRST, values)


def walked(name: str) -> tuple[list[Any], Session, dict[str, Any]]:
    """The same by a session: states, the session, and the frame of its last sample."""
    session = Session.of(scenario_of(name), scenario_of("NPD"))
    driver, states, found = Driver(session), [], {}
    for k in range(SAMPLES):
        walk = session.walking[0]
        if k == 600:
            link = named(walk, "right_shin")
            session.push({"q1": 30.0, "q2": 30.0}, (40.0, -10.0), link, (0.02, -0.1))
        if k == 1200:
            session.pull(named(walk, "torso"), (0.0, 0.3), (float(walk.foot[0]) + 0.3, 1.4))
        if k == 1700:
            session.let_go()
        if k == SAMPLES - 1:
            driver.shown()
        driver._sampled()
        if k % EVERY == EVERY - 1:
            both = [[w.now.t, w.now.mode.step, *w.foot, *w.q, *w.v] for w in session.walking]
            states.append(both)
    found = frame(driver)
    return states, session, found


def same(one: Any, other: Any, at: str = "") -> None:
    """Equal, numbers to 1e-6 of their size; 'rate' and the like are of the clock."""
    if isinstance(one, dict):
        for name in set(one) - {"rate", "reached", "paused"}:
            same(one[name], other[name], f"{at}.{name}")
    elif isinstance(one, list | tuple):
        assert len(one) == len(other), at
        for k, (x, y) in enumerate(zip(one, other, strict=True)):
            same(x, y, f"{at}[{k}]")
    elif isinstance(one, float | int) and not isinstance(one, bool):
        assert other == pytest.approx(one, rel=1e-6, abs=1e-6), at
    else:
        assert one == other, at


@needs_chromium
@pytest.mark.parametrize(
    "name",
    [
        "NPD",
        "ADRC",
        "m = 3",
        "encoders: the observer of Table I falls",
        "a lower bandwidth bears them",
    ],
)
def test_walks_pushed_and_pulled_are_those_of_a_session(browser: Chrome, name: str) -> None:
    """Positions and rates, with sin and pow of another library, and everything that is drawn and plotted."""
    states, session, found = walked(name)
    there = browser.execute_script(WALKED, name, SAMPLES, EVERY)
    np.testing.assert_allclose(np.array(there["states"]), np.array(states), rtol=0.0, atol=1e-7)
    endings = [walk["ending"] for walk in found["walks"]]
    assert there["endings"] == endings
    assert endings[0].startswith("fell") == name.startswith("encoders")
    assert session.walking[1].walks
    for walk, other in zip(found["walks"], there["frame"]["walks"], strict=True):
        if not walk["ending"]:
            assert walk["rows"]
            same(walk, other)
    same(found["t"], there["frame"]["t"])


@needs_chromium
def test_the_page_by_mouse_and_keys(browser: Chrome, path: Path) -> None:
    opened(browser, path.as_uri())
    hand = pulled(browser)
    assert 1.0 < math.hypot(*hand["force"]) < 300.0 + 1e-9
    let_go(browser)
    browser.execute_script("change({ walk: 'm = 3' })")
    until(browser, "return known[0].walk === 'm = 3' && page.last.t < 0.01")
    browser.execute_script("ghostOf('')")
    until(browser, "return known.length === 1 && page.last.walks.length === 1")
    browser.execute_script("send({ do: 'push', force: [900, 0] })")
    assert "900 N" in until(browser, "return element('refused').textContent")
    browser.execute_script("change({ walk: 'LQR' })")
    assert "'LQR' does not walk" in until(browser, "return element('refused-walk').textContent")
    keys(browser, "s")
    assert "biped-adrc play" in until(browser, "return element('said').textContent")
    keys(browser, " ")
    until(browser, "return page.last.walks[0].support.number > 2")
    keys(browser, "b", " ")
    assert console(browser) == []
    assert all(address.startswith(("file:", "data:", "blob:")) for address in requested(browser))


@needs_chromium
def test_the_tour_has_the_stations_of_the_rigid_plant(browser: Chrome, path: Path) -> None:
    opened(browser, path.as_uri())
    rigid = [station["title"] for station in tour() if station["values"]["plant"] == "rigid"]
    for k, title in enumerate(rigid):
        keys(browser, "n" if k else "t")
        until(browser, "return element('tour-title').textContent.endsWith(arguments[0])", title)
        name = browser.execute_script("return scene.tour[station].values.walk")
        until(browser, "return known[0].walk === arguments[0]", name)
    assert browser.execute_script("return scene.tour.length") == len(rigid)


@needs_chromium
def test_next_numbers_are_those_of_c(browser: Chrome) -> None:
    pairs = [
        (0.0, 1.0),
        (0.0, -1.0),
        (1.0, 2.0),
        (1.0, 0.0),
        (-1.0, 0.0),
        (-1.0, -2.0),
        (3.0, 3.0),
        (5e-324, 0.0),
    ]
    found = browser.execute_script("return arguments[0].map(([x, y]) => nextafter(x, y))", pairs)
    assert found == [np.nextafter(x, y) for x, y in pairs]


def test_the_same_walks_give_the_same_page() -> None:
    one, other = (page(FIRST, {"NPD": {"controller": "NPD"}}) for _ in range(2))
    assert one == other


def test_a_module_begins_as_webassembly_does() -> None:
    assert web_module({})[:8] == b"\0asm\1\0\0\0"


@pytest.mark.parametrize(
    ("scenario", "others", "said"),
    [
        (ba.Scenario("ADRC"), {}, "at every instant"),
        (ba.Scenario("ADRC", hardware="ideal", plant="mujoco"), {}, "in machine code as a whole"),
        (FIRST, {"soft": {"plant": "mujoco"}}, "'soft' does not run in machine code"),
        (ba.Scenario("ADRC", hardware="ideal", push="step"), {}, "push or ground steps of its own"),
        (FIRST, {"x": {"robot": "rabbit", "gain": 3.0}}, "gain"),
        (FIRST, {"x": 3.0}, "values of a scenario by name"),
        (FIRST, 3.0, "the walks to choose from"),
        (3.0, {}, "what is to walk on a page"),
    ],
)
def test_what_a_page_cannot_walk(tmp_path: Path, scenario: Any, others: Any, said: str) -> None:
    with pytest.raises(InputError, match=said):
        write_play(tmp_path / "play.html", scenario, others)
    assert not (tmp_path / "play.html").exists()


def test_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []
    monkeypatch.setattr("biped_adrc.live.offline.write_play", lambda *given: asked.append(given))
    words = ["play", "--page", str(tmp_path / "own.html"), "--ghost", "NPID", "--K-p", "900"]
    done = CliRunner().invoke(app, words, catch_exceptions=False)
    [(path, scenario, others)] = asked
    assert "own.html" in done.output
    assert (path, scenario.K_p, scenario.hardware) == (tmp_path / "own.html", 900.0, "ideal")
    assert next(iter(others)) == "NPID"


def test_the_name_is_looked_at_before_anything_is_made(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delattr("biped_adrc.live.offline.page")
    (tmp_path / "folder.html").mkdir()
    for name in ("own.txt", "folder.html"):
        with pytest.raises((InputError, OutputError), match=name):
            write_play(tmp_path / name)
