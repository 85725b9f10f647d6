"""The page in headless Chromium: a pull by the mouse, fields, keys, the tour, and what it loads."""

import time

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

import biped_adrc as ba

from .browser import chromium, console, needs_chromium, requested
from .served import SOON, served

SHOWN = "return page.last !== null && known[0].controller !== undefined"
PLACE = """
const box = pane.getBoundingClientRect();
const part = [...parts].find(([, link]) => link === "torso")[0];
viewer.scene.updateMatrixWorld(true);
viewer.render();
const at = part.getWorldPosition(new MeshCat.THREE.Vector3()).project(viewer.camera);
return [box.left + 0.5 * (at.x + 1) * box.width, box.top + 0.5 * (1 - at.y) * box.height];
"""


def until(browser, script, *given):
    """What a script returns, once that is true."""
    end = time.monotonic() + SOON
    while not (found := browser.execute_script(script, *given)):
        assert time.monotonic() < end, script
        time.sleep(0.05)
    return found


def field(browser, name, text):
    """Type into the number field of a slider."""
    found = browser.find_element(By.ID, f"field-{name}")
    found.clear()
    found.send_keys(text, Keys.ENTER)


@needs_chromium
def test_the_page_by_mouse_and_by_keys(tmp_path):
    found = {}

    async def visit(url):
        with chromium() as browser:
            browser.get(url)
            until(browser, SHOWN)
            look(browser, url)

    def look(browser, url):
        body = browser.find_element(By.TAG_NAME, "body")
        body.send_keys(" ")
        until(browser, "return paused")
        x, y = (round(place) for place in browser.execute_script(PLACE))
        mouse = ActionChains(browser)
        mouse.w3c_actions.pointer_action.move_to_location(x, y)
        mouse.double_click().perform()
        until(browser, "return selected && selected.link === 'torso'")
        mouse = ActionChains(browser).key_down(Keys.CONTROL).click_and_hold()
        mouse.move_by_offset(60, -20).perform()
        found["hand"] = until(browser, "return page.last.hand")
        before = browser.execute_script("return page.last.t")
        body.send_keys(Keys.ARROW_RIGHT)
        until(browser, "return page.last.t > arguments[0]", before)
        assert until(browser, "return element('force').textContent").endswith(" N")
        ActionChains(browser).release().key_up(Keys.CONTROL).perform()
        until(browser, "return page.last.hand === null")
        body.send_keys("s")
        saved = until(browser, "return /saved as (.*) and/.exec(element('said').textContent)")
        found["path"] = saved[1]

        field(browser, "bandwidth", "-3")
        sentence = until(browser, "return element('refused-bandwidth').textContent")
        assert "bandwidth" in sentence
        assert browser.find_element(By.ID, "field-bandwidth").get_attribute("value") == ""
        field(browser, "K_p", "4000")
        until(browser, "return known[0].K_p === 4000")
        browser.execute_script("document.activeElement.blur()")
        body.send_keys("-")
        until(browser, "return rate === 0.5")
        body.send_keys("t")
        until(browser, "return station === 0 && !paused && page.last.t > 0.02")
        body.send_keys("t")
        until(browser, "return station === -1")
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
            browser.get(url)
            until(browser, SHOWN)
            assert browser.execute_script(NAMELESS) == []
            for width in (360, 1920):
                size = {"width": width, "height": 800, "deviceScaleFactor": 1, "mobile": False}
                browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
                until(browser, "return innerWidth === arguments[0]", width)
                assert browser.execute_script(WIDER) == []

    served(visit, None)
