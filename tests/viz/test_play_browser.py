"""The page in headless Chromium: mouse, finger, keys, fields, the tour, other windows, and what it loads."""

import functools
import http.server
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

import biped_adrc as ba
from biped_adrc.live.controls import tour

from .browser import chromium, console, needs_chromium, requested
from .hands import SHOWN, keys, let_go, opened, pulled, torso, typed, until
from .served import Page, served


@needs_chromium
def test_the_page_by_mouse_and_by_keys(tmp_path):
    found = {}

    async def visit(url):
        with chromium() as browser:
            opened(browser, url)
            look(browser, url)

    def look(browser, url):
        found["hand"] = pulled(browser)
        before = browser.execute_script("return page.last.t")
        keys(browser, Keys.ARROW_RIGHT)
        until(browser, "return page.last.t > arguments[0]", before)
        assert until(browser, "return element('force').textContent").endswith(" N")
        let_go(browser)
        by_right_button(browser)
        keys(browser, "s")
        saved = until(browser, "return /saved as (.*) and/.exec(element('said').textContent)")
        found["path"] = saved[1]

        typed(browser, "bandwidth", "-3")
        sentence = until(browser, "return element('refused-bandwidth').textContent")
        assert "bandwidth" in sentence
        assert browser.find_element(By.ID, "field-bandwidth").get_attribute("value") == ""
        typed(browser, "K_p", "4000")
        until(browser, "return known[0].K_p === 4000")
        browser.execute_script("change({ bandwidth: 300, order: 1 })")
        until(browser, "return known[0].order === 1")
        typed(browser, "bandwidth", "")
        until(browser, "return known[0].bandwidth === null && known[0].order === null")
        assert not browser.find_element(By.ID, "field-filter_time").is_enabled()
        browser.execute_script("change({ velocity: 'differences', counts: 8192 })")
        until(browser, "return !element('field-filter_time').disabled")
        keys(browser, "-", "-")
        until(browser, "return rate === 0.2")
        until(browser, "return element('shown').textContent === ', last 1.6 s'")
        assert console(browser) == []
        assert all(
            address.split("//")[1].startswith(url.split("//")[1]) for address in requested(browser)
        )

    why, _ = served(visit, None, scenario=ba.Scenario("ADRC", hardware="ideal"), out=tmp_path)
    assert why == "the browser has closed the page"
    assert found["hand"]["anchor"] is not None
    again = ba.replay_session(found["path"])
    assert again.same
    assert again.record.hands[0].hand.force == tuple(found["hand"]["force"])


CTRL = 2  # of a pointer's modifiers


def by_right_button(browser):
    """Pull the torso with Ctrl and the right button, as in MuJoCo's viewer."""
    x, y = torso(browser)
    event = {"y": y, "button": "right", "buttons": 2, "modifiers": CTRL}
    for kind, at in (("mousePressed", x), ("mouseMoved", x + 20)):
        event |= {"type": kind, "x": at}
        browser.execute_cdp_cmd("Input.dispatchMouseEvent", event)
    assert until(browser, "return page.last.hand")["anchor"] is not None
    event |= {"type": "mouseReleased", "buttons": 0}
    browser.execute_cdp_cmd("Input.dispatchMouseEvent", event)
    until(browser, "return page.last.hand === null")


def touch(browser, kind, *place):
    """A finger at (x, y) [px], or none."""
    points = [dict(zip("xy", place, strict=True))] if place else []
    browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})


@needs_chromium
def test_a_finger_pulls_and_the_keys_of_the_tour_lead_through_it():
    async def visit(url):
        with chromium() as browser:
            opened(browser, url)
            finger(browser)
            guided(browser)
            assert console(browser) == []

    def finger(browser):
        browser.find_element(By.ID, "pull").click()
        keys(browser, "v")
        until(browser, "return view === 'perspective'")
        x, y = torso(browser)
        touch(browser, "touchStart", x, y)
        hand = until(
            browser, "return page.last.hand"
        )  # paused: the force is that of the next sample
        assert abs(hand["anchor"][0] - hand["at"][0]) < 1e-6  # slack
        touch(browser, "touchMove", x + 40, y - 10)
        until(browser, "return page.last.hand.anchor[0] > page.last.hand.at[0] + 0.05")
        touch(browser, "touchEnd")
        until(browser, "return page.last.hand === null")

        touch(browser, "touchStart", x + 90, y)  # beside the robot: the selected point is pulled
        hand = until(browser, "return page.last.hand")
        assert abs(hand["anchor"][0] - hand["at"][0]) < 1e-6
        touch(browser, "touchEnd")

    def guided(browser):
        assert browser.find_element(By.ID, "invitation").is_displayed()
        browser.execute_script(
            "change({ slope: -0.05 })"
        )  # uphill: the foot is above it at any time
        until(browser, "return page.last.walks[0].support.slope === -0.05")
        ground = "return node('meshcat/ground').rotation.y"
        assert abs(browser.execute_script(ground) + 0.05) < 1e-9
        keys(browser, "t")
        for k, station in enumerate(tour()):
            assert until(browser, "return station === arguments[0]", k)
            assert browser.find_element(By.ID, "tour-title").text.endswith(station["title"])
            assert browser.find_element(By.ID, "tour-page").text.endswith(station["page"])
            fits = "([name, x]) => !(name in known[0]) || known[0][name] === x"
            values = f"return Object.entries(scene.tour[{k}].values).every({fits})"
            until(browser, values)
            if "push" in station:
                keys(browser, "p")
                until(
                    browser,
                    "return Math.max(...page.last.walks[0].loads.slice(2).map(Math.abs)) > 29",
                )
            keys(browser, "n")
        until(browser, "return station === -1")
        assert not browser.find_element(By.ID, "invitation").is_displayed()
        keys(browser, "t")
        until(browser, "return station === 0")
        keys(browser, "t")
        until(browser, "return station === -1")

    served(visit, None)


ELSEWHERE = """
const [url, done] = arguments, found = [];
const socket = new WebSocket(url.replace("http", "ws") + "poses");
const frame = document.createElement("iframe");
frame.src = url;
document.body.append(frame);
socket.onmessage = ({ data }) => found.push(data);
socket.onclose = async () => {
  for (const mode of ["no-cors", "cors"]) {
    await fetch(url, { mode }).then((answer) => found.push(answer.type), (error) => found.push(error.name));
  }
  done(found);
};
"""


@contextmanager
def elsewhere(folder) -> Iterator[str]:
    """The address of a page of another origin."""
    (folder / "index.html").write_text("<!doctype html><title>elsewhere</title><body>")
    handler = functools.partial(Quiet, directory=folder)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()


class Quiet(http.server.SimpleHTTPRequestHandler):
    """Says nothing of its requests."""

    def log_message(self, *words):
        """Nothing."""


@needs_chromium
def test_two_windows_see_one_walk_and_a_page_from_elsewhere_gets_nothing(tmp_path):
    async def visit(url):
        page = await Page.open(url)
        with chromium() as browser, elsewhere(tmp_path) as other:
            opened(browser, url)
            one = browser.current_window_handle
            browser.switch_to.new_window("window")
            browser.get(url)
            until(browser, SHOWN)
            two = browser.current_window_handle
            browser.switch_to.window(one)
            pulled(browser)
            browser.switch_to.window(two)
            typed(browser, "K_p", "4000")
            assert until(browser, "return page.last.hand")["anchor"] is not None
            until(browser, "return known[0].K_p === 4000")
            browser.execute_script("socket.send('{'); send({ do: 'rate', rate: 50 })")
            until(browser, "return element('refused').textContent.includes('0.01 to 10')")
            browser.execute_script("socket.send(' '.repeat(5000))")
            assert "no longer moves" in until(browser, "return element('message').textContent")
            browser.switch_to.window(one)
            until(browser, "return page.last.hand")  # the hand of the first window holds on
            for _ in range(3):
                browser.execute_script("for (let k = 0; k < 400; k++) send({ do: 'go' })")
            assert "no longer moves" in until(browser, "return element('message').textContent")
            await page.frame(lambda f: f["hand"] is None)
            browser.get(other)
            found = browser.execute_async_script(ELSEWHERE, url)
            assert found == ["TypeError", "TypeError"]
            inside = "return document.querySelector('iframe').contentWindow.length"
            assert browser.execute_script(inside) == 0
            refused = [x for x in console(browser) if "frame-ancestors" in x]
            assert refused

    assert served(visit)[0] == "stopped by SIGTERM"


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


@needs_chromium
def test_nothing_is_wider_than_the_window_and_every_field_has_a_name():
    async def visit(url):
        with chromium() as browser:
            opened(browser, url)
            assert browser.execute_script(NAMELESS) == []
            for width in (360, 1920):
                size = {"width": width, "height": 800, "deviceScaleFactor": 1, "mobile": False}
                browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
                until(browser, "return innerWidth === arguments[0]", width)
                assert browser.execute_script(WIDER) == []

    served(visit, None)
