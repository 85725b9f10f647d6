"""The page of `play` in a browser: what it shows, and a hand with a mouse, a finger and keys."""

from __future__ import annotations

import time
from typing import Any

from selenium.webdriver import Chrome
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from .processes import SOON

SHOWN = "return page.last !== null && known[0].controller !== undefined"
PLACE = """
const box = pane.getBoundingClientRect();
const part = [...parts].find(([, link]) => link === "torso")[0];
viewer.scene.updateMatrixWorld(true);
viewer.render();
const at = part.getWorldPosition(new MeshCat.THREE.Vector3()).project(viewer.camera);
return [box.left + 0.5 * (at.x + 1) * box.width, box.top + 0.5 * (1 - at.y) * box.height];
"""


def until(browser: Chrome, script: str, *given: object) -> Any:
    """What a script returns, once that is true."""
    end = time.monotonic() + SOON
    while not (found := browser.execute_script(script, *given)):
        assert time.monotonic() < end, script
        time.sleep(0.05)
    return found


def opened(browser: Chrome, url: str) -> None:
    """The page, once it shows a walk, at rest."""
    browser.get(url)
    until(browser, SHOWN)
    keys(browser, " ")
    until(browser, "return paused")


def keys(browser: Chrome, *pressed: str) -> None:
    """Press keys, not in a field."""
    browser.execute_script("document.activeElement.blur()")
    browser.find_element(By.TAG_NAME, "body").send_keys(*pressed)


def torso(browser: Chrome) -> tuple[int, int]:
    """Where the torso is in the window [px]."""
    x, y = map(round, browser.execute_script(PLACE))
    return x, y


def pulled(browser: Chrome) -> dict[str, Any]:
    """Pull the torso by the mouse, and keep pulling; the hand in the next frame."""
    mouse = ActionChains(browser)
    mouse.w3c_actions.pointer_action.move_to_location(*torso(browser))
    mouse.double_click().perform()
    until(browser, "return selected && selected.link === 'torso'")
    mouse = ActionChains(browser).key_down(Keys.CONTROL).click_and_hold().key_up(Keys.CONTROL)
    mouse.move_by_offset(60, -20).perform()
    hand: dict[str, Any] = until(browser, "return page.last.hand")
    return hand


def let_go(browser: Chrome) -> None:
    """Let the mouse go."""
    ActionChains(browser).release().perform()
    until(browser, "return page.last.hand === null")


def typed(browser: Chrome, name: str, text: str) -> None:
    """Type into the number field of a slider."""
    found = browser.find_element(By.ID, f"field-{name}")
    found.clear()
    found.send_keys(text, Keys.ENTER)
