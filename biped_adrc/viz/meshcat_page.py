"""Meshcat's viewer as one offline page: an in-memory window in place of its server, and the page itself."""

from __future__ import annotations

import base64
import json
import random
import uuid
from collections.abc import Sequence
from importlib.resources import files
from typing import Any, Protocol

import umsgpack  # type: ignore[import-untyped]
from markupsafe import Markup

from biped_adrc.viz.pages import POLICY, rendered


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
    data = json.dumps(settings).replace("<", "\\u003c")
    return rendered(
        "player",
        s=settings,
        title=title,
        captions=captions,
        style="player.css",
        policy=POLICY + ("; connect-src 'self'" if settings["live"] else ""),
        viewer=Markup(viewer),
        data=Markup(data),
    )
