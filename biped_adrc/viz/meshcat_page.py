"""Meshcat's viewer as one offline page: an in-memory window in place of its server, and the page itself."""

from __future__ import annotations

import base64
import html
import json
import random
import uuid
from collections.abc import Sequence
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

    def __init__(self, seed: str = "scene") -> None:
        self.commands: list[bytes] = []
        self._names: dict[str, str] = {}
        self._source = random.Random(seed)

    def packed(self) -> list[str]:
        """The commands in base64."""
        return [base64.b64encode(command).decode("ascii") for command in self.commands]

    def send(self, command: Command) -> None:
        """Pack a command of meshcat as its viewer expects it.

        Meshcat names objects by clock and host (uuid1); here names come from a seeded source, for the same
        bytes every time.
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
                number = uuid.UUID(int=self._source.getrandbits(128), version=4)
                self._names.setdefault(value["uuid"], str(number))
            for item in value.values():
                self._count(item)

    def _renamed(self, value: Any) -> Any:
        if isinstance(value, list):
            return [self._renamed(item) for item in value]
        if isinstance(value, dict):
            return {key: self._renamed(item) for key, item in value.items()}
        return self._names.get(value, value) if isinstance(value, str) else value


def page(settings: dict[str, Any], title: str, captions: Sequence[tuple[str, str]]) -> str:
    """The page that plays `settings` (see `meshcat.scene_settings`).

    captions: (colour, text) of the legend. Texts are plain and are escaped here.
    """
    viewer = files("meshcat").joinpath("viewer", "dist", "main.min.js").read_text(encoding="utf-8")
    own = files("biped_adrc.viz")
    style, script = (
        own.joinpath(f"player.{kind}").read_text(encoding="utf-8") for kind in ("css", "js")
    )
    data = json.dumps(settings).replace("<", "\\u003c")
    policy = POLICY + ("; connect-src 'self'" if settings["live"] else "")
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
        f"<title>{html.escape(title)}</title>\n<style>{style}</style>\n</head>\n<body>\n"
        f'<div id="meshcat-pane" role="img" aria-label="{html.escape(title)}, walking"></div>\n'
        '<p id="message" role="alert" hidden></p>\n'
        f'<div id="panel">{_bar(settings)}<p id="caption">{_legend(captions)}</p></div>\n'
        f"<script>{viewer}</script>\n"
        f'<script type="application/json" id="scene">{data}</script>\n'
        f"<script>{script}</script>\n</body>\n</html>\n"
    )


def _bar(settings: dict[str, Any]) -> str:
    speeds = {"1": "1 x", "0.5": "1/2 x", "0.25": "1/4 x", "0.1": "1/10 x", "2": "2 x"}
    options = "".join(f'<option value="{v}">{text}</option>' for v, text in speeds.items())
    return (
        '<div id="bar"><button id="play" title="space">pause</button>'
        f'<input id="seek" type="range" min="{settings["start"]}" max="{settings["end"]}" '
        f'step="{1.0 / settings["fps"]}" aria-label="time [s]">'
        f'<output id="clock"></output><select id="speed" aria-label="speed">{options}</select>'
        '<button id="view" title="v">perspective</button></div>'
    )


def _legend(captions: Sequence[tuple[str, str]]) -> str:
    entries = []
    for colour, text in captions:
        swatch = f'<i class="swatch" style="background:{colour}"></i>' if colour else ""
        entries.append(f"<span>{swatch}{html.escape(text)}</span>")
    return " &nbsp; ".join(entries)
