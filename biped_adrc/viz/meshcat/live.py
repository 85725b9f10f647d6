"""Walks in the browser while this process runs: a server on the loopback address that streams poses.

    /         the page of `meshcat.view`, without the samples of the motion
    /poses    a WebSocket that brings one JSON message for each frame: t [s], and the pose of
    every walk

`play` runs an event loop of its own with two tasks: `_stream` sends poses at the pace of the clock,
`_watch` ends the session when the last page is closed. SIGINT and SIGTERM end it too; what ended it
is returned in words.

Only this computer can connect, and requests under another host name than that of the server are
refused: a page elsewhere could have its name resolved to the loopback address and read the stream
(DNS rebinding).
"""

from __future__ import annotations

import asyncio
import json
import signal
import sys
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field

from tornado.httpserver import HTTPServer
from tornado.netutil import bind_sockets
from tornado.web import Application, HTTPError, RequestHandler
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from biped_adrc.errors import InputError
from biped_adrc.viz.meshcat.frames import pose
from biped_adrc.viz.meshcat.view import Look, captions, scene_settings
from biped_adrc.viz.pages import player
from biped_adrc.viz.placement import Recorded, WalkScene

ADDRESS = "127.0.0.1"
GRACE = 2.0
"""Time [s] a closed page may take to come back, as when it is loaded again."""
REST = 1.0
"""Time [s] between the end of the walks and their next start."""
PING = 2.0
"""Time [s] between signs of life asked of the page, and how long it may take to give one."""

FAREWELL = 0.5
"""Time [s] the pages are given to be told of the end."""

Say = Callable[[str], None]
"""Takes a line of text for the user."""


@dataclass
class ServerState:
    """State that the request handlers and tasks of one server share.

    html: text of the page. hosts: names under which it may be asked for. stop: set to the reason
    when the session is to end. clients: open pages, each with its message on the way, or None
    before the first.
    arrived, left: set when a page comes, and when the last one goes. restart: the next message
    starts from the beginning, as a new page has nothing yet.
    """

    html: str
    hosts: tuple[str, ...]
    stop: asyncio.Future[str]
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
                self.clients[client] = client.post(text)


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
        self.write(self.session.html)


class Pages(Guarded, WebSocketHandler):
    """The WebSocket of one open page."""

    def open(self, *args: str, **kwargs: str) -> None:
        """A page has come: send from the start."""
        self.session.clients[self] = None
        self.session.restart = True
        self.session.arrived.set()

    def on_close(self) -> None:
        """A page has gone; `_watch` is told when it was the last."""
        self.session.clients.pop(self, None)
        if not self.session.clients:
            self.session.left.set()

    def on_message(self, message: str | bytes) -> None:
        """Pages have nothing to say yet."""

    def post(self, text: str) -> asyncio.Future[None]:
        """Send a text; the future is done when the page has taken it."""
        return asyncio.ensure_future(self._write(text))

    async def _write(self, text: str) -> None:
        """Send, and forget a page that has gone meanwhile."""
        try:
            await self.write_message(text)
        except WebSocketClosedError:
            self.session.clients.pop(self, None)


def play(
    walks: Mapping[str, Recorded],
    look: Look,
    *,
    port: int = 0,
    open_browser: bool = True,
    wait: float = 120.0,
    say: Say = print,
) -> str:
    """Show the walks in the browser until the page is closed or the process is told to stop; returns why.

    walks: name -> walk. look: as for a page. port: 0 for a free one. open_browser: open the user's
    browser there.
    wait [s]: how long to wait for the first page. say: is given the address.
    Raises InputError for a port that is in use, and inside a running event loop, as that of a
    notebook.
    """
    if not 0 <= port <= 65535:
        raise InputError(f"port is {port}, expected 1 to 65535, or 0 for a free one")
    with suppress(RuntimeError):
        asyncio.get_running_loop()
        raise InputError(
            "live mode runs an event loop of its own and one is running already, as in a notebook; there "
            "a walk as the last line of a cell shows itself"
        )
    scenes = {name: WalkScene.of(walks[name]) for name in look.order(walks)}
    settings = {**scene_settings(scenes, look), "live": True}
    html = player(settings, " and ".join(walks), captions(scenes))
    return asyncio.run(_serve(scenes, html, look.fps, port, open_browser, wait, say))


async def _serve(
    scenes: Mapping[str, WalkScene],
    html: str,
    fps: float,
    port: int,
    open_browser: bool,
    wait: float,
    say: Say,
) -> str:
    """Run the server until the session ends; returns why. Arguments as for `play`, with the text of the page.

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
    session = ServerState(html, (f"{ADDRESS}:{port}", f"localhost:{port}"), loop.create_future())
    for number in (signal.SIGINT, signal.SIGTERM):
        loop.add_signal_handler(number, session.end, f"stopped by {number.name}")
    pages = [(r"/", Front, {"session": session}), (r"/poses", Pages, {"session": session})]
    server = HTTPServer(
        Application(
            pages,
            websocket_ping_interval=PING,
            websocket_ping_timeout=PING,
            log_function=lambda handler: None,
        )
    )
    server.add_sockets(sockets)
    say(f"http://{ADDRESS}:{port}/  (Ctrl-C ends it)")
    launcher = await _launch(f"http://{ADDRESS}:{port}/") if open_browser else None
    tasks = [
        asyncio.create_task(_stream(session, scenes, fps)),
        asyncio.create_task(_watch(session, wait)),
    ]
    try:
        ends = [session.stop, *tasks]
        done, _ = await asyncio.wait(ends, return_when=asyncio.FIRST_COMPLETED)
        return done.pop().result()
    finally:
        await _close(session, server, tasks, launcher)


async def _launch(url: str) -> asyncio.subprocess.Process:
    """Open the user's browser from a process of its own: some browsers do not return.

    -I: nothing is imported from the working directory.
    """
    nowhere = asyncio.subprocess.DEVNULL
    return await asyncio.create_subprocess_exec(
        sys.executable, "-I", "-m", "webbrowser", url, stdin=nowhere, stdout=nowhere, stderr=nowhere
    )


async def _stream(session: ServerState, scenes: Mapping[str, WalkScene], fps: float) -> str:
    """Send a message for each frame while a page is open, by the clock; from the start again after the end.

    fps [1/s]: frames per second at most. It ends only by being cancelled or by an error.
    """
    start = min(scene.trajectory.t_start for scene in scenes.values())
    end = max(scene.trajectory.t_end for scene in scenes.values())
    began = time.monotonic()
    while True:
        await session.arrived.wait()
        t = start + time.monotonic() - began
        if session.restart or t > end + REST:
            began, t, session.restart = time.monotonic(), start, False
            session.send({"t": start, "restart": True, "poses": _poses(scenes, start)})
        else:
            t = min(t, end)
            session.send({"t": t, "poses": _poses(scenes, t)})
        await asyncio.sleep(1.0 / fps)


def _poses(scenes: Mapping[str, WalkScene], t: float) -> list[dict[str, object]]:
    """The pose of every walk at t [s], as plain values; of a walk that has ended, its last one."""
    found = []
    for scene in scenes.values():
        at = min(max(t, scene.trajectory.t_start), scene.trajectory.t_end)
        i = scene.arc_at(at)
        p = pose(scene, i, at)
        shown = {
            name: getattr(p, name).tolist() for name in ("joints", "loads", "points", "contact")
        }
        found.append({"arc": i, **shown})
    return found


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


async def _close(
    session: ServerState,
    server: HTTPServer,
    tasks: list[asyncio.Task[str]],
    launcher: asyncio.subprocess.Process | None,
) -> None:
    """Tell the pages of the end, close them and the server, and end the process that opened the browser.

    A page that does not take the message within `FAREWELL` is closed without it.
    """
    for task in tasks:
        task.cancel()
    server.stop()
    over = json.dumps({"over": "This session was ended where it was started."})
    told = [client.post(over) for client in list(session.clients)]
    if told:
        await asyncio.wait(told, timeout=FAREWELL)
    for client in list(session.clients):
        client.close()
    await asyncio.wait(tasks)
    await server.close_all_connections()
    if launcher is not None and launcher.returncode is None:
        launcher.kill()
        await launcher.wait()
