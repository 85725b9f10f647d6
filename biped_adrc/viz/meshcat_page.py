"""Meshcat's viewer as one offline page: an in-memory window in place of its server, and the page itself."""

from __future__ import annotations

import base64
import html
import json
import uuid
from importlib.resources import files
from typing import Any, Protocol

import umsgpack  # type: ignore[import-untyped]

POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval'; style-src 'unsafe-inline'; "
    "img-src data: blob:; worker-src blob:"
)
"""Content security policy of the page: the browser itself refuses every load from a network."""


class Command(Protocol):
    """What meshcat hands to a window."""

    def lower(self) -> dict[str, Any]:
        """The command as plain values."""


class MemoryWindow:
    """Takes the place of meshcat's window: keeps the commands, opens no port and starts no process."""

    def __init__(self) -> None:
        self.commands: list[bytes] = []
        self._names: dict[str, str] = {}

    def send(self, command: Command) -> None:
        """Pack a command of meshcat as its viewer expects it.

        Meshcat names objects by clock and host (uuid1); they are counted here, for the same bytes every time.
        """
        plain = command.lower()
        self._count(plain)
        self.pack(self._renamed(plain))

    def pack(self, command: dict[str, Any]) -> None:
        """As `send`, for plain values without names to be replaced."""
        self.commands.append(umsgpack.packb(command))

    def _count(self, value: Any) -> None:
        if isinstance(value, list):
            for item in value:
                self._count(item)
        elif isinstance(value, dict):
            if "uuid" in value:
                number = uuid.UUID(int=len(self._names) + 1)
                self._names.setdefault(value["uuid"], str(number))
            for item in value.values():
                self._count(item)

    def _renamed(self, value: Any) -> Any:
        if isinstance(value, list):
            return [self._renamed(item) for item in value]
        if isinstance(value, dict):
            return {key: self._renamed(item) for key, item in value.items()}
        return self._names.get(value, value) if isinstance(value, str) else value


def page(window: MemoryWindow, title: str, caption: str, follow: str, marks: list[Any]) -> str:
    """The page. follow: path of the node whose x the camera follows; marks: [start, stop, text] [s].

    `title` and `caption` are plain text and are escaped here.
    """
    viewer = files("meshcat").joinpath("viewer", "dist", "main.min.js").read_text(encoding="utf-8")
    commands = [base64.b64encode(c).decode("ascii") for c in window.commands]
    settings = {"follow": follow.strip("/").split("/"), "marks": marks, "commands": commands}
    data = json.dumps(settings).replace("<", "\\u003c")
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n'
        f"<title>{html.escape(title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n"
        '<div id="meshcat-pane"></div>\n'
        f'<p id="caption">{html.escape(caption)} <output id="clock"></output></p>\n'
        f"<script>{viewer}</script>\n"
        f'<script type="application/json" id="scene">{data}</script>\n'
        f"<script>{SCRIPT}</script>\n</body>\n</html>\n"
    )


STYLE = """
body { margin: 0; }
#meshcat-pane { width: 100vw; height: 100vh; overflow: hidden; }
#caption { position: absolute; left: 0; bottom: 0; margin: 0; padding: 0.5em 1em; font: 15px sans-serif;
  background: rgba(255, 255, 255, 0.85); color: #111; }
#clock { font-variant-numeric: tabular-nums; font-weight: bold; }
"""

SCRIPT = """
const scene = JSON.parse(document.getElementById("scene").textContent);
const viewer = new MeshCat.Viewer(document.getElementById("meshcat-pane"));
// the viewer keeps the left edge of an orthographic camera and moves the right one; keep the middle instead
const resize = viewer.set_3d_pane_size.bind(viewer);
viewer.set_3d_pane_size = (w, h) => {
  const camera = viewer.camera;
  if (camera.isOrthographicCamera) {
    const width = w === undefined ? viewer.dom_element.offsetWidth : w;
    const height = h === undefined ? window.innerHeight : h;
    camera.left = -0.5 * (camera.top - camera.bottom) * width / height;
  }
  resize(w, h);
};
for (const text of scene.commands) {
  viewer.handle_command_bytearray(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)));
}
const leader = viewer.scene_tree.find(scene.follow).object;
const clock = document.getElementById("clock");
const render = viewer.render.bind(viewer);
let x = 0;
viewer.render = () => {
  const step = leader.position.x - x;
  x += step;
  viewer.camera.position.x += step;
  viewer.controls.target.x += step;
  const t = viewer.animator.time;
  const now = scene.marks.filter((m) => m[0] <= t && t < m[1]).map((m) => ", " + m[2]);
  clock.textContent = "t = " + t.toFixed(2) + " s" + now.join("");
  render();
};
viewer.controls.target.set(0, viewer.camera.position.y, 0);
viewer.gui.open();
viewer.gui.__folders["Scene"].close();
"""
