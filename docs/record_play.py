"""Record the page of `play` for docs/guide/play.md: docs/images/play.gif.

Run: python docs/record_play.py

ADRC and its ghost NPD walk twenty times slower than the clock in headless Chromium, which draws by software, and
the torso is pulled by the mouse meanwhile. Pictures are taken as fast as the browser gives them; those nearest
to every 80 ms of the walk are shown for 160 ms each. One or two minutes.
"""

from __future__ import annotations

import io
import os
import signal
import sys
import threading
from pathlib import Path

from PIL import Image
from selenium.webdriver import Chrome
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from viz.browser import chromium

import biped_adrc as ba

PATH = Path(__file__).parent / "images" / "play.gif"
WIDTH, HEIGHT = 1280, 960
"""Of the window [px]; the picture is as wide, and has no controls."""
SMALLER = 0.6
"""Size of the picture, of that of the window."""
RATE, EVERY, SHOWN = 0.05, 0.08, 160
"""Rate of the walk, time of the walk from picture to picture [s], and how long one is shown [ms]."""
PULLED, LET_GO, END = 0.5, 0.9, 2.4
"""Times of the walk [s]."""
PREPARE = """
document.getElementById("panel").style.display = "none";
dispatchEvent(new Event("resize"));
send({ do: "reset" });
send({ do: "rate", rate: arguments[0] });
"""
TORSO = """
viewer.render();
const box = pane.getBoundingClientRect(), [path] = scene.links.find(([, link]) => link === "torso");
const at = node(path).getWorldPosition(new MeshCat.THREE.Vector3()).project(viewer.camera);
return [box.left + 0.5 * (at.x + 1) * box.width, box.top + 0.5 * (1 - at.y) * box.height];
"""


def recorded(browser: Chrome) -> list[tuple[float, bytes]]:
    """Pictures with the times of the walk [s] at which they were taken."""
    found: list[tuple[float, bytes]] = []
    t, held = 0.0, False
    while t < END:
        t = float(browser.execute_script("return page.last.t"))
        if not held and PULLED <= t < LET_GO:
            x, y = map(round, browser.execute_script(TORSO))
            mouse = ActionChains(browser).key_down(Keys.CONTROL)
            mouse.w3c_actions.pointer_action.move_to_location(x, y)
            mouse.click_and_hold().move_by_offset(-140, -30).perform()
            held = True
        elif held and t >= LET_GO:
            ActionChains(browser).release().key_up(Keys.CONTROL).perform()
            held = False
        found.append((t, browser.get_screenshot_as_png()))
    return found


def written(pictures: list[tuple[float, bytes]]) -> None:
    """Write the pictures nearest to equal times as one moving picture of 64 colours."""
    frames = []
    for k in range(int(END / EVERY)):
        _, picture = min(pictures, key=lambda one: abs(one[0] - k * EVERY))
        image = Image.open(io.BytesIO(picture)).convert("RGB")
        size = round(SMALLER * image.width), round(SMALLER * image.height)
        frames.append(image.resize(size, Image.Resampling.LANCZOS))
    palette = frames[-1].quantize(64)
    small = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    small[0].save(
        PATH, save_all=True, append_images=small[1:], duration=SHOWN, loop=0, optimize=True
    )


def visit(url: str) -> None:
    """Record the page at an address, and end the session."""
    try:
        with chromium() as browser:
            browser.set_window_size(WIDTH, HEIGHT)
            browser.get(url)
            browser.execute_script(PREPARE, RATE)
            written(recorded(browser))
    finally:
        os.kill(os.getpid(), signal.SIGTERM)


def main() -> None:
    """Serve a session, and record it from a thread."""
    visitors: list[threading.Thread] = []

    def say(text: str) -> None:
        if text.startswith("http"):
            visitors.append(threading.Thread(target=visit, args=(text.split()[0],)))
            visitors[0].start()

    scenario = ba.Scenario("ADRC", hardware="ideal")
    ba.play(scenario, ghost={"controller": "NPD"}, open_browser=False, say=say)
    visitors[0].join()
    print(f"{PATH.name}: {PATH.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
