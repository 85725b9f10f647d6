"""A session on its server, in this process, and pages that are nothing but WebSockets."""

from __future__ import annotations

import asyncio
import json
import os
import signal
import threading
from collections.abc import Awaitable, Callable
from typing import Any, ClassVar

from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

import biped_adrc as ba
from biped_adrc.live.page import play

SOON = 60.0
"""[s] within which something comes that would come at once on an idle computer."""
Frame = dict[str, Any]


class Page:
    """A page that is open; it keeps what it is told besides frames."""

    opened: ClassVar[list[Page]] = []

    def __init__(self, socket):
        self.socket, self.told, self.ended = socket, [], False
        Page.opened.append(self)

    @classmethod
    async def open(cls, url, **headers):
        address = url.replace("http", "ws") + "poses"
        return cls(await websocket_connect(HTTPRequest(address, headers=headers)))

    async def close(self):
        self.socket.close()
        while not self.ended:
            await self.heard()

    async def say(self, **message):
        await self.socket.write_message(json.dumps(message))

    async def heard(self):
        """The next message; None where the server has closed the page."""
        text = await asyncio.wait_for(self.socket.read_message(), SOON)
        self.ended = text is None
        return None if text is None else json.loads(text)

    async def until(self, fits: Callable[[Frame], object]) -> Frame:
        """The first message from now on that fits; the others than frames are kept in `told`."""
        async with asyncio.timeout(SOON):
            while True:
                message = await self.heard()
                assert message is not None, self.socket.close_reason
                if "t" not in message:
                    self.told.append(message)
                if fits(message):
                    return message

    async def frame(self, fits=lambda frame: True):
        return await self.until(lambda message: "t" in message and fits(message))

    async def reply(self, name):
        return await self.until(lambda message: name in message)


def served(
    visit: Callable[[str], Awaitable[None]],
    stop: signal.Signals | None = signal.SIGTERM,
    heard: Callable[[str], None] = lambda text: None,
    **options,
) -> tuple[str, list[str]]:
    """Play while `visit(url)` goes on; why it ended, and what was said. stop: sent after the visit.

    heard: is given each sentence, in the thread of the server.
    """
    said: list[str] = []
    raised: list[BaseException] = []
    visitors: list[threading.Thread] = []

    async def visited_and_left(url):
        Page.opened.clear()
        try:
            await visit(url)
        finally:
            await asyncio.gather(*(page.close() for page in Page.opened))

    def visited(url):
        try:
            asyncio.run(visited_and_left(url))
        except BaseException as error:
            raised.append(error)
        if stop and not raised:
            os.kill(os.getpid(), stop)

    def say(text):
        said.append(text)
        heard(text)
        if text.startswith("http"):
            visitors.append(threading.Thread(target=visited, args=(text.split()[0],), daemon=True))
            visitors[0].start()

    scenario = options.pop("scenario", ba.Scenario("NPD", hardware="ideal"))
    why = play(scenario, open_browser=False, say=say, **options)
    visitors[0].join(SOON)
    assert not visitors[0].is_alive()
    if raised:
        raise raised[0]
    return why, said
