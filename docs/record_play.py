"""Record the page of `play` for docs/guide/play.md: docs/recordings/play.gif.

Run: python docs/record_play.py

ADRC and its ghost NPD walk by a clock that this script moves on by 80 ms from picture to picture, while
headless Chromium, which draws by software, shows the page; the torso is pulled by the mouse meanwhile. The
pictures are shown for twice that time each. A minute or two.
"""

from __future__ import annotations

import io
import sys
import threading
import time
from pathlib import Path

from PIL import Image
from selenium.webdriver import Chrome
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from viz.browser import chromium

import biped_adrc as ba
from biped_adrc.live.driver import Driver
from biped_adrc.live.page import page
from biped_adrc.live.stage import Stage
from biped_adrc.viz.meshcat.server import run

PATH = Path(__file__).parent / "recordings" / "play.gif"
WIDTH, HEIGHT = 1000, 700
"""Of the window [px]; the picture is as wide, and has no controls."""
SMALLER = 0.72
"""Size of the picture, of that of the window."""
EVERY, SHOWN = 0.08, 160
"""Time of the walk from picture to picture [s], and how long one is shown [ms]."""
PULLED, LET_GO, END = 0.48, 0.72, 2.0
"""Times of the walk [s]."""
PREPARE = """
document.getElementById("panel").style.display = "none";
dispatchEvent(new Event("resize"));
"""
TORSO = """
viewer.render();
const box = pane.getBoundingClientRect(), [path] = scene.links.find(([, link]) => link === "torso");
const at = node(path).getWorldPosition(new MeshCat.THREE.Vector3()).project(viewer.camera);
return [box.left + 0.5 * (at.x + 1) * box.width, box.top + 0.5 * (1 - at.y) * box.height];
"""


def recorded(browser: Chrome, clock: list[float]) -> list[bytes]:
    """Pictures of the page, the clock moved on by EVERY between them."""
    found: list[bytes] = []
    held = False
    for k in range(round(END / EVERY)):
        shown_at(browser, k * EVERY)
        if not held and PULLED <= k * EVERY < LET_GO:
            x, y = map(round, browser.execute_script(TORSO))
            mouse = ActionChains(browser).key_down(Keys.CONTROL)
            mouse.w3c_actions.pointer_action.move_to_location(x, y)
            mouse.click_and_hold().move_by_offset(30, -10).perform()
            held = True
        elif held and k * EVERY >= LET_GO:
            ActionChains(browser).release().key_up(Keys.CONTROL).perform()
            held = False
        found.append(browser.get_screenshot_as_png())
        clock[0] += EVERY
    return found


def shown_at(browser: Chrome, t: float) -> None:
    """Wait until the page shows the walk at t [s], to a sample."""
    until = time.monotonic() + 60.0
    while not browser.execute_script(
        "return page.last !== null && page.last.t > arguments[0]", t - 2e-3
    ):
        if time.monotonic() > until:
            raise TimeoutError(f"the page does not come to {t:g} s")
        time.sleep(0.05)


def written(pictures: list[bytes]) -> None:
    """Write pictures as one moving picture of 64 colours."""
    frames = []
    for picture in pictures:
        image = Image.open(io.BytesIO(picture)).convert("RGB")
        size = round(SMALLER * image.width), round(SMALLER * image.height)
        frames.append(image.resize(size, Image.Resampling.LANCZOS))
    palette = frames[len(frames) // 3].quantize(64)
    small = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    small[0].save(
        PATH, save_all=True, append_images=small[1:], duration=SHOWN, loop=0, optimize=True
    )


def visit(url: str, clock: list[float]) -> None:
    """Record the page at an address; the session ends with the browser."""
    with chromium() as browser:
        browser.set_window_size(WIDTH, HEIGHT)
        browser.get(url)
        browser.execute_script(PREPARE)
        written(recorded(browser, clock))
        print(f"{PATH.name}: {PATH.stat().st_size / 1000:.0f} kB")


def main() -> None:
    """Serve a session, and record it from a thread."""
    clock = [0.0]
    session = ba.Session(ba.Scenario("ADRC", hardware="ideal"), ghost={"controller": "NPD"})
    stage = Stage(Driver(session, lambda: clock[0]), Path())
    stage.ready()

    def say(text: str) -> None:
        threading.Thread(target=visit, args=(text.split()[0], clock)).start()

    run(page(session), stage.stream, listener=stage, open_browser=False, say=say)


if __name__ == "__main__":
    main()
