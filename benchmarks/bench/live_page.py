"""A page of a live walk: from a pointer event to the first pose that differs, poses a second, and memory.

Run: python benchmarks/bench/live_page.py [OUT] [--quick] [--minutes 10] [--no-browser]

The server is a process of its own, held to one core: RABBIT at 1 kHz under ADRC with NPD as a ghost, at the
pace of the clock. `socket` are pulls by messages over a WebSocket, `page` pulls by pointer events in headless
Chromium, where drawing is by software and shares the computer with the server: the time from the event, or
from the message, to the arrival of the first frame after a sample under the pull. A walk that is not pulled has
other bits from that sample on. The walk begins anew after every 20 pulls, and where it has fallen. `memory` is
what the server has taken more at the end of so many minutes than after the first ten seconds, with a page that
reads all frames and pulls for a fifteenth of a second every ten seconds.
"""

from __future__ import annotations

import asyncio
import json
import os
import re
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tornado.websocket import WebSocketClientConnection, websocket_connect

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))

from report import Table, arguments

PULL = {"do": "pull", "link": "torso", "at": [0, 0.3]}
BATCH = 20
"""Pulls of one script in the page; the walk begins anew with each."""
AWAY = 0.02
"""Of the anchor from the point that is held [m]: 30 N."""
IN_PAGE = """
const done = arguments[arguments.length - 1], count = arguments[0], times = [], before = socket.onmessage;
let began = null, wanted = true, waiting = null;
send({ do: "reset" });
const torso = [...parts].find(([, link]) => link === "torso")[0];
function pointer(kind) {
  const box = pane.getBoundingClientRect();
  const at = torso.getWorldPosition(new MeshCat.THREE.Vector3()).project(viewer.camera);
  const clientX = box.left + 0.5 * (at.x + 1) * box.width;
  const clientY = box.top + 0.5 * (1 - at.y) * box.height;
  const init = { clientX, clientY, ctrlKey: true, button: 0, pointerId: 1, bubbles: true };
  pane.dispatchEvent(new PointerEvent(kind, init));
}
pane.setPointerCapture = () => {};
socket.onmessage = (event) => {
  before(event);
  if (page.last.walks[0].ending) {
    release(); began = null; wanted = true; send({ do: "reset" }); wait();
    return;
  }
  if (page.last.felt !== wanted || began === null) return;
  if (wanted) { times.push(performance.now() - began); pointer("pointerup"); wanted = false; return; }
  began = null; wanted = true;
  if (times.length < count) { wait(); return; }
  socket.onmessage = before;
  done(times);
};
function wait() {
  clearTimeout(waiting);
  waiting = setTimeout(pull, 150 + 100 * Math.random());
}
function pull() {
  select({ link: "torso", at: [0, 0.3] });
  began = performance.now();
  pointer("pointerdown");
}
wait();
"""


@contextmanager
def server() -> Iterator[tuple[int, int]]:
    """(process, port) of a session on one core."""
    command = [sys.executable, "-m", "biped_adrc.cli", "play", "--ghost", "NPD", "--no-browser"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    try:
        found = re.search(r":(\d+)/", process.stdout.readline())
        assert found is not None, "the server said no address"
        os.sched_setaffinity(process.pid, {0})
        for task in os.listdir(f"/proc/{process.pid}/task"):
            os.sched_setaffinity(int(task), {0})
        yield process.pid, int(found[1])
    finally:
        process.terminate()
        process.wait(60)


async def frame(socket: WebSocketClientConnection) -> dict[str, Any]:
    """The next frame."""
    while True:
        found = json.loads(await socket.read_message() or "{}")
        if "t" in found:
            return dict(found)


async def closed(socket: WebSocketClientConnection) -> None:
    """Close a socket, and wait until it is."""
    socket.close()
    while await socket.read_message() is not None:
        pass


async def rates(port: int, seconds: float) -> tuple[float, float]:
    """Frames a second, and the rate of the walk, over so many seconds."""
    socket = await websocket_connect(f"ws://127.0.0.1:{port}/poses")
    first, began, count = await frame(socket), time.monotonic(), 0
    while time.monotonic() < began + seconds:
        last, count = await frame(socket), count + 1
    passed = time.monotonic() - began
    await closed(socket)
    return count / passed, (last["t"] - first["t"]) / passed


async def pulls(port: int, count: int) -> list[float]:
    """Times [ms] from a message that pulls to the first frame that has felt it."""
    socket = await websocket_connect(f"ws://127.0.0.1:{port}/poses")
    times = []
    for k in range(count):
        if k % BATCH == 0:
            await socket.write_message('{"do": "reset"}')
        for _ in range(k % 17):  # at other times of a step
            await frame(socket)
        await asyncio.sleep(1e-3 * (k % 16))  # and of a frame
        x, z = (await frame(socket))["walks"][0]["points"][:2]
        began = time.monotonic()
        await socket.write_message(json.dumps(PULL | {"anchor": [x + AWAY, z + 0.3]}))
        while not (seen := await frame(socket))["felt"]:
            if seen["walks"][0]["ending"]:
                raise RuntimeError(f"the walk {seen['walks'][0]['ending']}, after {k} pulls")
        times.append(1e3 * (time.monotonic() - began))
        await socket.write_message('{"do": "let_go"}')
        while (await frame(socket))["felt"]:
            pass
    await closed(socket)
    return times


def pulls_in_page(port: int, count: int) -> list[float]:
    """The same [ms] from pointer events in headless Chromium."""
    from viz.browser import chromium

    with chromium() as browser:
        browser.set_script_timeout(600)
        browser.get(f"http://127.0.0.1:{port}/")
        while not browser.execute_script("return page.last !== null"):
            time.sleep(0.1)
        found: list[float] = []
        for k in range(0, count, BATCH):
            found += browser.execute_async_script(IN_PAGE, min(BATCH, count - k))
        return found


def resident(process: int) -> float:
    """Memory of a process [MB]."""
    pages = int(Path(f"/proc/{process}/statm").read_text().split()[1])
    return 1e-6 * pages * os.sysconf("SC_PAGESIZE")


async def memory(process: int, port: int, seconds: float) -> tuple[float, float, float]:
    """Memory [MB] after ten seconds and at the end, and how long was walked [s]."""
    socket = await websocket_connect(f"ws://127.0.0.1:{port}/poses")
    began, first, at, pulled = time.monotonic(), 0.0, 0.0, False
    while (passed := time.monotonic() - began) < seconds:
        seen = await frame(socket)
        if seen["walks"][0]["ending"]:
            raise RuntimeError(f"the walk {seen['walks'][0]['ending']}")
        if first == 0.0 and passed > min(10.0, 0.5 * seconds):
            first, at = resident(process), seen["t"]
        if (passed % 10.0 < 1.0 / 15.0) == pulled:
            continue
        pulled = not pulled
        x, z = seen["walks"][0]["points"][:2]
        said = PULL | {"anchor": [x + 2.0 * AWAY, z + 0.3]} if pulled else {"do": "let_go"}
        await socket.write_message(json.dumps(said))
    await closed(socket)
    return first, resident(process), seen["t"] - at


def main() -> None:
    """Print the tables, and write them when asked."""
    parser = arguments(__doc__)
    parser.add_argument("--minutes", type=float, default=10.0, help="of walking, for the memory")
    parser.add_argument("--no-browser", action="store_true", help="leave the page out")
    asked = parser.parse_args()
    count = 20 if asked.quick else 200
    table = Table("Pulls, to the first pose that differs", "ms")
    with server() as (process, port):
        found = {"socket": asyncio.run(pulls(port, count))}
        per_second, rate = asyncio.run(rates(port, 2.0 if asked.quick else 20.0))
    if not asked.no_browser:
        with server() as (process, port):
            found["page"] = pulls_in_page(port, count)
    for name, times in found.items():
        late = statistics.quantiles(times, n=20)[-1]
        table.add(
            name, pulls=len(times), median=statistics.median(times), late=late, longest=max(times)
        )
    table.finish(asked.out)
    poses = Table("Poses of a live walk on one core", "1/s and share of real time")
    poses.add("rigid, ghost", poses_a_second=per_second, rate=rate)
    poses.finish(asked.out)
    minutes = 0.2 if asked.quick else asked.minutes
    kept = Table("Memory of a live page's server", "MB")
    with server() as (process, port):
        first, last, walked = asyncio.run(memory(process, port, 60.0 * minutes))
    kept.add("rigid, ghost", minutes=minutes, walked_s=walked, first=first, more=last - first)
    kept.finish(asked.out)


if __name__ == "__main__":
    main()
