"""The page of `play`: its walks are the simulator's, under a hand by script, mouse, finger and keys.

The fixture browser is Chromium with the page of OTHERS, paused; until(browser, script) waits for a script of
the page to be true, keys presses keys. FIRST is the scenario that walks first, revised(FIRST, values) the one
with these values.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from selenium.webdriver import Chrome
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

import biped_adrc as ba
from biped_adrc.core.errors import BipedError, InputError, OutputError
from biped_adrc.extras.play.page import FIRST, NEARER, guided, page, revised, tour
from biped_adrc.extras.play.page import OTHERS as CHOICES
from biped_adrc.extras.play.sliders import Slider, at_base
from biped_adrc.extras.play.walks import MOST, SPRING, PageWalk
from biped_adrc.model.planar import jacobian, link_point, point, turned
from biped_adrc.scenario.build import RobotAndGait
from biped_adrc.scenario.scenario import read_scenario
from biped_adrc.view.meshcat.view import LANE, pose
from biped_adrc.view.placement import WalkScene
from tests.commands import command

from .browser import chromium, console, requested

DOCS = Path(__file__).parents[2] / "docs"
SOON = 60.0
"""[s] within which something comes that would come at once on an idle computer."""
ODD = '</script><script>document.title = "run"</script>'
"""A name as markup."""
OTHERS: dict[str, dict[str, object]] = {
    "NPD": {"controller": "NPD"},
    "ADRC": {"controller": "ADRC"},
    "m = 3": {
        "controller.name": "ADRC",
        "controller.observer.order": 3,
        "controller.observer.bandwidth": 300.0,
    },
    ODD: {"controller": {"name": "NPD", "K_p": 900.0, "K_d": 60.0}},
}


def test_a_station_that_the_scenario_does_not_take_is_left_out_and_those_behind_it_stay() -> None:
    """A walk in continuous time has no encoders: the two stations with encoders go, and no other."""
    walks: dict[str, ba.Scenario] = {}
    stations = guided(ba.Scenario("passive", robot="compass"), walks)
    # without encoders: those that name no counts, or counts of "none"
    titles = [
        x["title"]
        for x in tour()
        if "counts" not in str(x["values"]) or "8192" not in str(x["values"])
    ]
    assert [x["title"] for x in stations] == titles == list(walks)
    assert len(titles) == 4


def test_the_hand_is_drawn_in_front_of_the_walk_and_its_ghost_behind() -> None:
    assert NEARER < 0.0 < LANE  # along y, away from the camera


@pytest.mark.parametrize("m", [1, 2, 3, 7])
def test_a_walk_to_choose_from_has_the_observer_of_its_name(m: int) -> None:
    """m: order of the observer in the name of a walk that the page offers."""
    observer = {"order": m, "bandwidth": 300.0}
    assert CHOICES[f"ADRC, m = {m}, 300 rad/s"] == {
        "controller": {"name": "ADRC", "observer": observer}
    }


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return ba.play(tmp_path_factory.mktemp("page") / "play.html", others=OTHERS)


@pytest.fixture(scope="module")
def started() -> Iterator[Chrome]:
    with chromium() as browser:
        yield browser


@pytest.fixture
def browser(started: Chrome, path: Path) -> Chrome:
    """Chromium with the page open and its walk paused."""
    opened(started, path)
    return started


def opened(browser: Chrome, path: Path) -> None:
    """Open the page, wait until it shows a walk, and pause it."""
    browser.get(path.as_uri())
    until(browser, "return typeof page !== 'undefined' && page.last !== null && known.length > 0")
    keys(browser, " ")
    until(browser, "return paused")


def until(browser: Chrome, script: str, *given: object) -> Any:
    """What the script returns, asked again until it is true; fails after SOON."""
    end = time.monotonic() + SOON
    while not (found := browser.execute_script(script, *given)):
        assert time.monotonic() < end, script
        time.sleep(0.05)
    return found


def keys(browser: Chrome, *pressed: str) -> None:
    """Press keys with no field of the page in focus."""
    browser.execute_script("document.activeElement.blur()")
    browser.find_element(By.TAG_NAME, "body").send_keys(*pressed)


# -- the walks -----------------------------------------------------------------------------------------
WALKED = """
const springs = [];
play.begin("NPD", "ADRC");
for (let k = 0; k < 700; k += 1) {
  const [walk] = play.walking;
  const push = { torque: { q1: 30, q2: 30 }, force: [40, -10], link: "right_shin", at: [0.02, -0.1] };
  if (k === 100) play.push(push);
  if (k === 400) play.pull({ link: "torso", at: [0, 0.3], anchor: [walk.foot[0] + 0.3, 1.4] });
  if (k === 600) play.let_go();
  if (k === 699) play.rows = play.walking.map(() => []);
  if (play.spring) {
    const { place, hand } = play.pulled();
    springs.push([...walk.q, ...walk.v, ...walk.foot, ...play.spring.anchor, ...place, ...hand.force]);
  }
  play.sample();
}
return { t: play.leader.t, text: scenarioText(play), springs, frame: JSON.parse(JSON.stringify(play.frame())) };
"""


def is_drawn(walk: ba.Walk, t: float, found: dict[str, Any]) -> None:
    """What the page draws and plots at t [s] is what the finished walk draws, and its signals."""
    i = found["support"]["number"] - 1
    drawn = pose(WalkScene.of(walk), i, t)
    for key in ("joints", "points", "contact"):
        assert found[key] == pytest.approx(getattr(drawn, key), rel=1e-6, abs=1e-6), key
    assert found["loads"][2:] == pytest.approx(drawn.loads[2:], rel=1e-6, abs=1e-6)
    s, row = walk.signals, found["rows"][-1]
    k = int(np.argmax(s.t > t - 1e-9))
    assert s.t[k] == pytest.approx(t, abs=1e-9)
    for key in ("error", "xi", "xi_estimate", "u"):
        there = [math.nan if x is None else x for x in row[key]]
        assert there == pytest.approx(getattr(s, key)[k], rel=1e-6, abs=1e-6, nan_ok=True), key
    assert found["loads"][:2] == pytest.approx(s.ground_reaction[k], rel=1e-6, abs=1e-6)
    F_T, F_N = s.ground_reaction[k]  # before the sample instant, as the page has it
    assert row["friction"] == pytest.approx(abs(F_T) / F_N, rel=1e-6)


@pytest.fixture(scope="module")
def walked(started: Chrome, path: Path) -> dict[str, Any]:
    """What the script WALKED returns: of a walk that a hand pushes and pulls, and what was drawn at its end."""
    opened(started, path)
    found: dict[str, Any] = started.execute_script(WALKED)
    return found


def test_what_is_drawn_and_plotted_is_what_the_finished_walk_has(
    walked: dict[str, Any], tmp_path: Path
) -> None:
    """The script WALKED walks 0.7 s under a push and a pull; the scenario that the page saves is walked by the
    simulator, and `is_drawn` compares pose, loads and plotted signals at the end.
    """
    file = tmp_path / "by_hand.toml"
    file.write_text(walked["text"], encoding="utf-8")
    is_drawn(ba.walk_scenario(read_scenario(file)), walked["t"], walked["frame"]["walks"][0])


def test_the_spring_pulls_towards_the_hand_and_not_more_than_it_may(walked: dict[str, Any]) -> None:
    """The hand's force is stiffness and damping on the point of the torso that is held, cut to the largest one;
    computed here again from the recorded states. The script pulls hard enough for 100 N at least.
    """
    plant = RobotAndGait.of(FIRST).biped
    n, k = plant.n, link_point(plant, "torso", (0.0, 0.3))
    largest = 0.0
    for row in np.array(walked["springs"]):
        q, v, (foot, anchor, place, force) = row[:n], row[n : 2 * n], row[2 * n :].reshape(4, 2)
        t = turned(k.A, q)
        p = foot + point(t, k.re, k.im)
        pull = SPRING["stiffness"] * (anchor - p) - SPRING["damping"] * (
            jacobian(k.A, t, k.re, k.im) @ v
        )
        pull *= min(1.0, MOST["force"] / np.linalg.norm(pull))
        assert place == pytest.approx(p, abs=1e-9)
        assert force == pytest.approx(pull, abs=1e-6)
        largest = max(largest, float(np.linalg.norm(force)))
    assert largest > 100.0
    assert largest <= MOST["force"] * (1.0 + 1e-9)


TUNED = """
const [sliders] = arguments;
for (const [slider, value] of Object.entries(sliders)) play.tune({ slider, value, walks: ["ADRC"] });
play.begin("ADRC", null);
while (play.leader.t < 0.6) play.sample();
const found = [scenarioText(play), play.leader.t, play.leader.step, [...play.leader.q, ...play.leader.v]];
for (const slider of Object.keys(sliders)) play.tune({ slider, value: undefined, walks: ["ADRC"] });
return found;
"""


@pytest.mark.parametrize("delay", [0.0, 4e-4, 1.3e-3])
def test_sliders_set_the_values_of_the_scenario(
    browser: Chrome, tmp_path: Path, delay: float
) -> None:
    """Sliders of gains, delay, torque limit, friction and slope are set in the page, which walks 0.6 s. The
    saved scenario has their values (0.5 times friction is an error of -0.5), and its simulation has the page's
    state.
    """
    file, values = tmp_path / "tuned.toml", {"controller.K_p": 3000.0, "hardware.delay": delay}
    values |= {"controller.observer.bandwidth": 300.0, "hardware.torque_limit": 120.0}
    values |= {"hardware.friction": 0.5, "ground.slope": 0.01}
    text, t, step, state = browser.execute_script(TUNED, values)
    file.write_text(text, encoding="utf-8")
    s = read_scenario(file)
    # the order is that of Table I, which has no slider here
    assert (s.controller.observer.bandwidth, s.controller.observer.order) == (300.0, 7)
    assert (s.hardware.delay, s.errors.friction) == (delay, -0.5)
    arc = ba.walk_scenario(s).trajectory.arcs[step - 1]
    np.testing.assert_allclose(state, arc(t, "left")[:10], rtol=0.0, atol=1e-8)


def test_a_slider_ends_where_its_controller_refuses_more() -> None:
    """NPID is stable only in a range of K_p: it can be built at both ends of the slider, and not at half the
    lower one.
    """
    walk = PageWalk.of("NPID", revised(FIRST, {"controller": "NPID"}))
    found = walk.sliders()
    assert {"controller.K_p", "controller.K_d", "controller.K_i"} <= found.keys()
    gain, _ = found["controller.K_p"]
    assert gain.low < gain.value == 5000.0 < gain.high
    for x in (gain.low, gain.high):
        walk.at({"controller.K_p": x})
    with pytest.raises(InputError, match="the loop of NPID is unstable"):
        walk.at({"controller.K_p": 0.5 * gain.low})


def test_a_fallen_robot_gets_up_again_and_the_timeline_goes_back(browser: Chrome) -> None:
    """A push throws the robot, and the button "up" begins the walk again. Number 3 of the timeline is t =
    0.03 s: the walk goes back there, a key moves it on by 1 ms, and the timeline then ends at number 3.
    """
    fallen = """
play.push({ force: [-300, 0], seconds: 1 });
while (play.walking[0].walks) play.sample();
"""
    browser.execute_script(fallen)
    until(
        browser, "return !element('up').hidden && element('message').textContent.includes('walk ')"
    )
    browser.find_element(By.ID, "up").click()
    until(browser, "return page.last.walks[0].ending === '' && !paused")
    keys(browser, " ")
    until(browser, "return paused && page.last.hand === null && element('message').hidden")
    moved = """
for (let k = 0; k < 100; k += 1) play.sample();
showFrame(play.frame());
describe(page.last); // the timeline's end, which the page writes some 80 ms later
const line = element("timeline"), was = page.last.t;
line.value = arguments[0]; line.dispatchEvent(new Event("input"));
return was;
"""
    was = browser.execute_script(moved, 3)
    until(
        browser, "return Math.abs(page.last.t - 0.03) < 1e-9 && Number(element('timeline').max) > 3"
    )
    keys(browser, Keys.ARROW_RIGHT)
    until(browser, "return Math.abs(page.last.t - 0.031) < 1e-9 && element('timeline').max === '3'")
    assert was > 0.03


# -- the picture ---------------------------------------------------------------------------------------
PAINTED = """
play.begin("ADRC", null); // with the legs apart
showFrame(play.frame());
viewer.render();
const pen = viewer.renderer.pen, box = pane.getBoundingClientRect();
const of = (x, y) => [...pen.getImageData(Math.round(x), Math.round(y), 1, 1).data.slice(0, 3)];
const part = (name) => [...parts].find(([path, link]) => link === name)[0];
return [["torso", 0.3], ["left_shin", 0.3], ["right_shin", 0.3]].map(([name, z]) => {
  const at = part(name).parent.localToWorld(new THREE.Vector3(0, 0, z)).project(viewer.camera);
  return of(0.5 * (at.x + 1) * box.width, 0.5 * (1 - at.y) * box.height);
}).concat([of(3, 100)]);
"""


@pytest.mark.parametrize("camera", ["side", "perspective"])
def test_links_are_painted_where_they_are_in_their_colours(browser: Chrome, camera: str) -> None:
    """PAINTED reads the pixels (red, green, blue) at which torso, left and right shin lie in the camera's view,
    and one beside the robot: grey, one leg mostly red and the other mostly blue, white.
    """
    browser.execute_script("look(arguments[0])", camera)
    torso, left, right, beside = browser.execute_script(PAINTED)
    assert max(torso) - min(torso) < 40, "grey"
    assert {int(np.argmax(leg)) for leg in (left, right)} == {0, 2}, "orange and blue"
    assert beside == [255, 255, 255]


# -- mouse, finger, keys -------------------------------------------------------------------------------
PLACE = """
const box = pane.getBoundingClientRect();
const part = [...parts].find(([, link]) => link === "torso")[0];
viewer.scene.updateMatrixWorld(true);
viewer.render();
const at = part.getWorldPosition(new MeshCat.THREE.Vector3()).project(viewer.camera);
return [box.left + 0.5 * (at.x + 1) * box.width, box.top + 0.5 * (1 - at.y) * box.height];
"""


def torso(browser: Chrome) -> tuple[int, int]:
    """Where the torso is in the window [px]."""
    x, y = map(round, browser.execute_script(PLACE))
    return x, y


def test_the_mouse_pulls_the_torso_and_keys_step_slow_down_and_go_on(browser: Chrome) -> None:
    """A drag gives the hand a force of at most 300 N, which ends with the drag. Keys: the arrow goes on by a
    sample, two - slow down to 0.2 of real time, space plays and pauses. Two + undo that and b goes back to
    where the step began: of these only the console is looked at, which stays empty.
    """
    mouse = ActionChains(browser)
    mouse.w3c_actions.pointer_action.move_to_location(*torso(browser))
    mouse.click_and_hold().move_by_offset(60, -20).perform()
    until(browser, "return selected && selected.link === 'torso'")
    hand = until(browser, "return page.last.hand")
    assert 1.0 < math.hypot(*hand["force"]) < 300.0 + 1e-9
    before = browser.execute_script("return page.last.t")
    keys(browser, Keys.ARROW_RIGHT)
    until(browser, "return page.last.t > arguments[0]", before)
    assert until(browser, "return element('force').textContent").endswith(" N")
    ActionChains(browser).release().perform()
    until(browser, "return page.last.hand === null")
    keys(browser, "-", "-")
    # of 4 s, the plots show the share 2 rate, at most all
    until(browser, "return rate === 0.2 && element('shown').textContent === ', last 1.6 s'")
    keys(browser, "+", "+", " ")
    until(browser, "return page.last.walks[0].support.number > 2")
    keys(browser, "b", " ")
    until(browser, "return paused")
    assert console(browser) == []


def test_a_finger_on_the_robot_pulls_it(browser: Chrome) -> None:
    """The touch events are Chromium's: a finger that rests holds without a force (the anchor is at the point),
    one that moves pulls, and lifted it lets go.
    """

    def touch(kind: str, *place: float) -> None:
        points = [dict(zip("xy", place, strict=True))] if place else []
        browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    keys(browser, "v")
    until(browser, "return view === 'perspective'")
    x, y = torso(browser)  # where it is in the window [px]
    touch("touchStart", x, y)
    hand = until(browser, "return page.last.hand")  # at rest: the force is that of the next sample
    assert hand["anchor"][0] == pytest.approx(hand["at"][0], abs=1e-6), "slack"
    touch("touchMove", x + 40, y - 10)
    until(browser, "return page.last.hand.anchor[0] > page.last.hand.at[0] + 0.05")
    touch("touchEnd")
    until(browser, "return page.last.hand === null")


def test_what_walks_is_chosen_and_what_is_refused_is_said(browser: Chrome) -> None:
    """Walk and ghost are chosen from lists. Numbers out of range, no number, a slider moved while it walked,
    which no scenario can say, and too large a torque are refused with a sentence that the next good input
    removes.
    """
    choose = "element(arguments[0]).value = arguments[1]; element(arguments[0]).onchange({ target: "
    choose += "element(arguments[0]) })"
    browser.execute_script(choose, "walk", "m = 3")
    until(browser, "return known[0] === 'm = 3' && page.last.t < 0.01")
    browser.execute_script(choose, "ghost", "")
    until(browser, "return known.length === 1 && page.last.walks.length === 1")
    refused = "return element('refused').textContent"
    for number, said in ((5000, "5000 N"), ("", "the hand's shove is no number"), (100, "")):
        browser.execute_script("element('shove').value = arguments[0]; shove(1)", number)
        assert said in browser.execute_script(refused)
    assert browser.execute_script(refused) == ""
    browser.execute_script(
        "const field = document.querySelector('#sliders input[type=number]');"
        "field.value = arguments[0]; field.dispatchEvent(new Event('change'))",
        "-5",
    )
    assert "K_p [1/s²] is -5, expected 30 to 30000" in browser.execute_script(refused)
    mixed = "play.sample(); play.tune({ slider: 'ground.slope', value: 0.01, walks: known }); "
    browser.execute_script(mixed + "play.sample(); save()")
    assert "a slider was moved while it walked" in browser.execute_script(refused)
    browser.execute_script("play.tune({ slider: 'ground.slope', value: undefined, walks: known })")
    browser.execute_script("send({ do: 'push', torque: { q1: 900 } })")
    assert "900 N m" in browser.execute_script(refused)


def test_the_tour_leads_through_its_stations_and_gives_back_what_walked(browser: Chrome) -> None:
    """Keys: t begins it, n is the next station, p pushes with the station's 30 N m, which the page draws."""
    before, stations = browser.execute_script("return known[0]"), tour()
    assert browser.execute_script("return scene.tour.length") == len(stations) == 6
    for k, station in enumerate(stations):
        keys(browser, "n" if k else "t")
        until(
            browser,
            "return element('tour-title').textContent.endsWith(arguments[0])",
            station["title"],
        )
        until(browser, "return known[0] === scene.tour[station].walk")
        assert (DOCS / f"{station['page']}.md").is_file()
        if "push" in station:
            keys(browser, "p")
            until(
                browser, "return Math.max(...page.last.walks[0].loads.slice(2).map(Math.abs)) > 29"
            )
    keys(browser, "n")
    until(browser, "return station === -1 && known[0] === arguments[0]", before)


STATION = """
const { walk, push, after } = scene.tour[arguments[0]];
play.begin(walk, null);
let pushed = !push, error = 0, torque = 0;
while (play.walks && play.leader.t < 1.6) {
  if (!pushed && play.leader.t >= after) { play.push(push); pushed = true; }
  play.rows = [[]];
  play.sample();
  for (const row of play.rows[0]) {
    torque = Math.max(torque, row.torque);
    if (row.t > 0.6) error = Math.max(error, ...row.error.map(Math.abs));
  }
}
return { walks: play.walks, error, torque };
"""


def test_the_stations_show_what_they_say(browser: Chrome) -> None:
    """Errors [rad] after the push are what tour.toml says: some milliradians under NPD and with order 1, a
    fraction of these under ADRC and with order 3. With encoders the torque is at its limit and the walk ends;
    with a lower bandwidth it goes on.
    """
    titles = [station["title"] for station in tour()]

    def station(words: str) -> dict[str, Any]:
        (k,) = (k for k, title in enumerate(titles) if words in title)
        found: dict[str, Any] = browser.execute_script(STATION, k)
        return found

    npd, adrc = station("under NPD")["error"], station("under ADRC")["error"]
    assert 4e-3 < npd < 16e-3
    assert adrc < npd / 10.0
    one, three = station("order 1")["error"], station("raised to 3")["error"]
    assert 1e-3 < one < 10e-3
    assert three < one / 3.0
    encoders = station("encoders")
    assert not encoders["walks"]
    assert encoders["torque"] >= 150.0
    assert station("lower bandwidth")["walks"]


NAMELESS = """
const fields = [...document.querySelectorAll("button, input, select")].filter((x) => !x.closest(".dg"));
return fields.filter((x) => !(x.tagName === "BUTTON" && x.textContent.trim()) && x.labels.length === 0
  && !x.getAttribute("aria-label")).map((x) => x.outerHTML);
"""
WIDER = """
const room = document.documentElement.clientWidth;
if (document.documentElement.scrollWidth <= room) return [];
const all = [...document.body.querySelectorAll("*")].filter((x) => x.getBoundingClientRect().right > room);
return all.map((x) => x.outerHTML.slice(0, 200));
"""

LOWER = """
const all = [...document.querySelectorAll("button, input, select, canvas")];
const low = (x) => x.offsetParent && !x.closest(".dg") && x.getBoundingClientRect().bottom > innerHeight + 1;
return all.filter(low).map((x) => x.outerHTML.slice(0, 200));
"""


def test_nothing_is_wider_than_the_window_and_every_field_has_a_name(browser: Chrome) -> None:
    """This holds on a telephone, 390 px wide, and on two screens; on these no control is below the window
    either. The scripts list fields without a name, and what is too wide or too low.
    """
    assert browser.execute_script(NAMELESS) == []
    try:
        for width, height in ((390, 800), (1000, 700), (1400, 900)):
            size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
            browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
            until(browser, "return innerWidth === arguments[0]", width)
            assert browser.execute_script(WIDER) == []
            if width > 800:
                assert browser.execute_script(LOWER) == []
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_names_are_text_and_nothing_is_loaded(started: Chrome, path: Path) -> None:
    """ODD, a walk whose name is a script, is a name and does not run: the title is unchanged. No other address
    is asked for.
    """
    requested(started)
    opened(started, path)
    assert ODD in started.execute_script("return names")
    assert started.title == "rabbit, live"
    assert requested(started) == [path.as_uri()]
    assert console(started) == []


# -- the file ------------------------------------------------------------------------------------------
def test_the_same_walks_give_the_same_page(path: Path) -> None:
    assert page(FIRST, OTHERS) == path.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("scenario", "others", "said"),
    [
        (ba.Scenario("ADRC"), {}, "at every instant"),
        (ba.Scenario("ADRC", hardware="ideal", ground="mujoco"), {}, "on plant 'mujoco'"),
        (FIRST, {"soft": {"ground.plant": "mujoco"}}, "'soft' is on plant 'mujoco'"),
        (FIRST, {"own": {"controller": "CLF-QP"}}, "'own' does not run in machine code"),
        (
            ba.Scenario("ADRC", hardware="ideal", pushes=[{"shape": "step"}]),
            {},
            "push of its own",
        ),
        (ba.Scenario("ADRC", hardware="ideal", run={"fine": 1e-4}), {}, "fine"),
        (ba.Scenario("passive", robot="compass", hardware="ideal"), {}, "motors"),
        (FIRST, {"x": {"robot": "rabbit", "gain": 3.0}}, "gain"),
        (FIRST, {"x": 3.0}, "expected a Mapping"),
        (FIRST, 3.0, "the walks to choose from"),
        (3.0, {}, "what is to walk on a page"),
    ],
)
def test_what_a_page_cannot_walk_is_refused(
    tmp_path: Path, scenario: Any, others: Any, said: str
) -> None:
    """scenario: what walks first; others: those to choose from; said: the reason. No file is written."""
    with pytest.raises(BipedError, match=said):
        ba.play(tmp_path / "play.html", scenario, others)
    assert not (tmp_path / "play.html").exists()


def test_another_controller_comes_without_the_observer_of_the_one_before() -> None:
    """NPD in the place of ADRC has no bandwidth left over, while a new bandwidth alone keeps ADRC's order."""
    s = ba.Scenario(
        {"name": "ADRC", "observer": {"bandwidth": 200.0, "order": 1}}, hardware="ideal"
    )
    assert revised(s, {"controller": "NPD"}).controller.observer.bandwidth is None
    assert revised(s, {"controller.observer.bandwidth": 250.0}).controller.observer.order == 1


def test_the_command_writes_a_page_or_opens_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """`play` and the browser are replaced by recorders: with -o the page is written to that file, without it to
    a file that is opened; the ghost is the first walk to choose from. A browser that does not open (None) is
    remarked.
    """
    asked: list[Any] = []
    shown: list[str] = []
    monkeypatch.setattr("biped_adrc.extras.play.page.play", lambda *given: asked.append(given))
    monkeypatch.setattr("webbrowser.open", lambda url: shown.append(url))
    words = ["play", "--ghost", "NPID", "--set", "controller.K_p=900"]
    for more in (["-o", "own.html"], []):
        printed = command(*words, *more)
        path, scenario, others = asked[-1]
        assert f"written to {path}" in printed
        assert (scenario.controller.K_p, scenario.hardware.period) == (900.0, 1e-3)
        assert next(iter(others)) == "NPID"
    assert asked[0][0] == Path("own.html")
    assert shown == [path.as_uri()]
    assert "no browser could be opened" in printed


def test_the_name_is_looked_at_before_anything_is_made(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A wrong suffix or a folder is refused although the function that makes the page is deleted here."""
    monkeypatch.delattr("biped_adrc.extras.play.page.page")
    (tmp_path / "folder.html").mkdir()
    for name in ("own.txt", "folder.html"):
        with pytest.raises((InputError, OutputError), match=name):
            ba.play(tmp_path / name)


def test_a_page_says_that_its_motors_have_no_torque_limit(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The page of a scenario without hardware.torque_limit says so, the usual one, with a limit, does not. Its
    machine code, which other tests run, and its tour, which would be three walks more, are left out.
    """
    said = "motors without a torque limit"
    monkeypatch.setattr("biped_adrc.extras.play.webassembly.from_disk", lambda *_: b"")
    monkeypatch.setattr("biped_adrc.extras.play.page.guided", lambda *_: [])
    unlimited = ba.Scenario(controller="NPD", hardware={"period": 1e-3})
    assert said in page(unlimited, {}, samples=0)
    assert said not in path.read_text(encoding="utf-8")


def test_a_slider_begins_at_the_value_that_gives_the_walks_numbers() -> None:
    """The slider begins at x with number = a + b x^k; a relative error of 0.2 is a factor of 1.2."""
    error = Slider("errors.mass", -0.5, 0.5, False)  # from -0.5 to 0.5, not logarithmic
    for form, number, value in (((1.0, 1.0, 1), 1.2, 0.2), ((3.0, 2.0, 2), 3.02, 0.1)):
        # form: (a, b, k) of number 0
        assert at_base(error, np.array([number]), {0: form}).value == pytest.approx(value)
