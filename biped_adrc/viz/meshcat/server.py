"""A server on the loopback address that shows pages, sends them messages, and hears them.

    /         the page
    /poses    a WebSocket that brings one JSON message for each frame, and takes what the page says

`run` runs an event loop of its own with two tasks: the stream that it is given sends messages, `_watch`
ends the session when the last page is closed. SIGINT and SIGTERM end it too; what ended it is returned
in words.

Only this computer can connect, and requests under another host name than that of the server are
refused: a page elsewhere could have its name resolved to the loopback address and read the stream
(DNS rebinding). A WebSocket that a page of another origin opens is refused as well, and the page cannot be
put into a frame of another one, where clicks would be led to it. A message of a page longer than
`ServerState.longest` closes that page's WebSocket.
"""

from __future__ import annotations

import asyncio
import json
import signal
import sys
from collections.abc import Callable, Coroutine, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from tornado.httpserver import HTTPServer
from tornado.netutil import bind_sockets
from tornado.web import Application, HTTPError, RequestHandler
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from biped_adrc.errors import InputError

ADDRESS = "127.0.0.1"
GRACE = 2.0
"""Time [s] a closed page may take to come back, as when it is loaded again."""
FAREWELL = 0.5
"""Time [s] the pages are given to be told of the end."""
MOST_BODY = 10_000
"""Bytes of the body of a request; none of the server's own pages sends one."""

Say = Callable[[str], None]
"""Takes a line of text for the user."""


class Listener:
    """What is done when pages come, speak and go, and at the end: nothing. The server calls it from its event
    loop.
    """

    longest = 1000
    """Bytes of a message; a page that sends a longer one is closed."""
    patience = 2.0
    """Time [s] between signs of life asked of the page, and how long it may take to give one."""

    def came(self, page: Pages) -> None:
        """A page has been opened."""

    def said(self, page: Pages, text: str | bytes) -> None:
        """A page says something."""

    def left(self, page: Pages) -> None:
        """A page has gone."""

    async def closing(self, again: asyncio.Event, say: Say) -> None:
        """The session has ended: finish what was begun. again: set by another signal."""


@dataclass
class ServerState:
    """State that the request handlers and tasks of one server share.

    html: text of the page. hosts: names under which it may be asked for. stop: set to the reason
    when the session is to end. listener: hears the pages. clients: open pages, each with its message on
    the way, or None before the first.
    arrived, left: set when a page comes, and when the last one goes. restart: the next message
    starts from the beginning, as a new page has nothing yet.
    """

    html: str
    hosts: tuple[str, ...]
    stop: asyncio.Future[str]
    listener: Listener
    clients: dict[Pages, asyncio.Future[None] | None] = field(default_factory=dict)
    arrived: asyncio.Event = field(default_factory=asyncio.Event)
    left: asyncio.Event = field(default_factory=asyncio.Event)
    restart: bool = True

    def end(self, reason: str) -> None:
        """End the session for this reason, such as a signal; the first reason counts."""
        if not self.stop.done():
            self.stop.set_result(reason)

    def send(self, message: Mapping[str, object]) -> None:
        """Send a message to every page that has taken the last one.

        A slow page misses frames in place of falling behind the clock more and more.
        """
        text = json.dumps(message)
        for client, sent in list(self.clients.items()):
            if sent is None or sent.done():
                self.clients[client] = client.tell(text)


Stream = Callable[[ServerState], Coroutine[Any, Any, str]]
"""Sends messages to the pages of a server until it is cancelled, or ends the session with a reason."""


class Guarded(RequestHandler):
    """Base of the handlers: refuses requests under a host name that is not the server's."""

    session: ServerState

    def initialize(self, session: ServerState) -> None:
        """Take the session; called by tornado for every request."""
        self.session = session

    def prepare(self) -> None:
        """Raise HTTPError (403) for a foreign host name; called by tornado before the request is handled."""
        if self.request.host not in self.session.hosts:
            raise HTTPError(403, f"unknown host; open http://{self.session.hosts[0]}/")


class Front(Guarded):
    """The page itself."""

    def get(self) -> None:
        """Answer with the page, never from the browser's cache."""
        self.set_header("Content-Type", "text/html; charset=utf-8")
        self.set_header("Cache-Control", "no-store")
        self.set_header("Content-Security-Policy", "frame-ancestors 'none'")
        self.set_header("Cross-Origin-Resource-Policy", "same-origin")
        self.write(self.session.html)


class Pages(Guarded, WebSocketHandler):
    """The WebSocket of one open page."""

    def open(self, *args: str, **kwargs: str) -> None:
        """A page has come: send from the start."""
        self.session.clients[self] = None
        self.session.restart = True
        self.session.arrived.set()
        self.session.listener.came(self)

    def on_close(self) -> None:
        """A page has gone; `_watch` is told when it was the last."""
        self.session.clients.pop(self, None)
        self.session.listener.left(self)
        if not self.session.clients:
            self.session.left.set()

    def on_message(self, message: str | bytes) -> None:
        """A page says something."""
        self.session.listener.said(self, message)

    def tell(self, text: str) -> asyncio.Future[None]:
        """Send a text; the future is done when the page has taken it."""
        return asyncio.ensure_future(self._write(text))

    async def _write(self, text: str) -> None:
        """Send, and forget a page that has gone meanwhile."""
        try:
            await self.write_message(text)
        except WebSocketClosedError:
            self.session.clients.pop(self, None)


def run(
    html: str,
    stream: Stream,
    *,
    listener: Listener | None = None,
    port: int = 0,
    open_browser: bool = True,
    wait: float = 120.0,
    say: Say = print,
) -> str:
    """Show a page in the browser until it is closed or the process is told to stop; returns why.

    html: text of the page. stream: sends messages to the pages. listener: hears them. port: 0 for a free
    one. open_browser: open the user's browser there. wait [s]: how long to wait for the first page. say:
    is given the address. Raises InputError for a port that is in use, and inside a running event loop, as
    that of a notebook.
    """
    if not (isinstance(port, int) and 0 <= port <= 65535):
        raise InputError(f"port is {port!r}, expected 1 to 65535, or 0 for a free one")
    if not wait > 0.0:
        raise InputError(f"wait is {wait} s, expected a positive time for a browser to come")
    with suppress(RuntimeError):
        asyncio.get_running_loop()
        raise InputError(
            "live mode runs an event loop of its own and one is running already, as in a notebook; there "
            "a walk as the last line of a cell shows itself"
        )
    heard = Listener() if listener is None else listener
    return asyncio.run(_serve(html, stream, heard, port, open_browser, wait, say))


async def _serve(
    html: str,
    stream: Stream,
    listener: Listener,
    port: int,
    open_browser: bool,
    wait: float,
    say: Say,
) -> str:
    """Run the server until the session ends; returns why. Arguments as for `run`.

    The session ends by a signal, when `_watch` returns, or when a task fails, whose error is raised
    here. Pages, server, tasks and the process of the browser are closed in each case.
    """
    loop = asyncio.get_running_loop()
    try:
        sockets = bind_sockets(port, ADDRESS)
    except (OSError, OverflowError) as error:
        raise InputError(
            f"port {port} cannot be used on {ADDRESS} ({error}); leave out --port for a free one"
        ) from error
    port = sockets[0].getsockname()[1]
    hosts = f"{ADDRESS}:{port}", f"localhost:{port}"
    session = ServerState(html, hosts, loop.create_future(), listener)
    for number in (signal.SIGINT, signal.SIGTERM):
        loop.add_signal_handler(number, session.end, f"stopped by {number.name}")
    pages = [(r"/", Front, {"session": session}), (r"/poses", Pages, {"session": session})]
    server = HTTPServer(
        Application(
            pages,
            websocket_ping_interval=listener.patience,
            websocket_ping_timeout=listener.patience,
            websocket_max_message_size=listener.longest,
            log_function=lambda handler: None,
        ),
        max_body_size=MOST_BODY,
    )
    server.add_sockets(sockets)
    url = f"http://{ADDRESS}:{port}/"
    say(f"{url}  (Ctrl-C ends it)")
    tasks = [asyncio.create_task(stream(session)), asyncio.create_task(_watch(session, wait))]
    opening = [asyncio.create_task(_open(url, say))] if open_browser else []
    try:
        ends = [session.stop, *tasks]
        done, _ = await asyncio.wait(ends, return_when=asyncio.FIRST_COMPLETED)
        return done.pop().result()
    finally:
        again = asyncio.Event()
        for number in (signal.SIGINT, signal.SIGTERM):
            loop.add_signal_handler(number, again.set)
        await _close(session, server, [*tasks, *opening])
        await listener.closing(again, say)


OPEN = "import sys, webbrowser; sys.exit(not webbrowser.open(sys.argv[1]))"


async def _open(url: str, say: Say) -> None:
    """Open the user's browser from a process of its own, which ends with this task: some browsers do not
    return. Say so where there is none.

    -I: nothing is imported from the working directory.
    """
    nowhere = asyncio.subprocess.DEVNULL
    opening = await asyncio.create_subprocess_exec(
        sys.executable, "-I", "-c", OPEN, url, stdin=nowhere, stdout=nowhere, stderr=nowhere
    )
    try:
        if await opening.wait() != 0:
            say("no browser could be opened here: open the address above in one on this computer")
    finally:
        if opening.returncode is None:
            opening.kill()
            await opening.wait()


async def _watch(session: ServerState, wait: float) -> str:
    """Wait for what ends a session by itself, and return it in words: no page comes within `wait` [s],
    or the last one has gone for good.
    """
    try:
        await asyncio.wait_for(session.arrived.wait(), wait)
    except TimeoutError:
        return f"no browser has opened the page within {wait:g} s"
    while True:
        await session.left.wait()
        session.left.clear()
        await asyncio.sleep(GRACE)
        if not session.clients:
            return "the browser has closed the page"


async def _close(session: ServerState, server: HTTPServer, tasks: list[asyncio.Task[Any]]) -> None:
    """Tell the pages of the end, and close them, the tasks and the server.

    A page that does not take the message within `FAREWELL` is closed without it.
    """
    for task in tasks:
        task.cancel()
    server.stop()
    over = json.dumps({"over": "This session was ended where it was started."})
    told = [client.tell(over) for client in list(session.clients)]
    if told:
        await asyncio.wait(told, timeout=FAREWELL)
    for client in list(session.clients):
        client.close()
    await asyncio.wait(tasks)
    await server.close_all_connections()
