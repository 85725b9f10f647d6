"""What pages see of a session and say to it, over `viz.meshcat.server`.

The session belongs to one thread, in which it is moved on and changed, so that the server answers while it
computes or compiles. Sixty times a second that thread takes what the pages have said since, goes on by the
clock, and makes a `frame` for all pages. Replies go to the page that spoke:

    {"refused": sentence, "names": [...]}       a message that was not taken, and the fields that it names
    {"saved": [path, ...]}, {"remark": sentence}

and to all pages `{"values": [...]}`, the values of each walk, when they are other ones.

A page that says more than it may (`messages.Allowance`) is closed. When the page goes whose hand pulls, the
hand lets go.
"""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from itertools import count
from pathlib import Path
from typing import NamedTuple

from biped_adrc.errors import BipedError
from biped_adrc.live.controls import values
from biped_adrc.live.driver import Driver
from biped_adrc.live.frame import frame, named
from biped_adrc.live.messages import MOST_BYTES, Allowance, Message, message_of
from biped_adrc.live.record import SessionRecord
from biped_adrc.live.repeated import SUFFIXES, save_session
from biped_adrc.live.session import WALK
from biped_adrc.viz.meshcat.server import Listener, Pages, ServerState

FPS = 60.0
"""Frames a second at most."""
MOST_IN_A_TURN, MOST_WAITING = 10, 300
"""Messages that are taken in one turn, and that may wait of one page: a change may take much of a turn."""
SLOW = 0.9
"""Share of the rate asked for below which a walk is said not to keep up."""


class Heard(NamedTuple):
    """What a page has said; None: it has gone."""

    page: Pages
    text: str | bytes | None


class Turn(NamedTuple):
    """What came of one turn of the session's thread."""

    frame: dict[str, object]
    replies: list[tuple[Pages, dict[str, object]]]
    values: list[dict[str, object]]
    """Of each walk."""
    save: list[tuple[Pages, SessionRecord]]
    """What is to be saved, for whom."""


class Stage(Listener):
    """A session on pages. folder: where sessions are saved."""

    longest = MOST_BYTES
    patience = 20.0  # a change may compile, for which the interpreter is held

    def __init__(self, driver: Driver, folder: Path):
        self.driver, self.folder = driver, folder
        self.heard: list[Heard] = []
        self.allowances: dict[Pages, Allowance] = {}
        self.puller: Pages | None = None
        self.known: list[dict[str, object]] = []
        """Values that the pages have been told."""
        self.saving: asyncio.Task[None] | None = None
        self.share = 1.0
        """Least share of the rate asked for that was reached."""

    # -- in the event loop of the server -------------------------------------------------------------
    def came(self, page: Pages) -> None:
        """A page has been opened: it is told all values anew, as every other."""
        self.allowances[page] = Allowance()
        self.known = []

    def said(self, page: Pages, text: str | bytes) -> None:
        """Keep what a page says for the coming turn; close a page that says too much."""
        if page not in self.allowances:
            return
        waiting = sum(one.page is page for one in self.heard)
        if waiting >= MOST_WAITING or not self.allowances[page].taken(time.monotonic()):
            del self.allowances[page]
            self.heard = [one for one in self.heard if one.page is not page]
            page.close(1008, "too many messages")
            return
        self.heard.append(Heard(page, text))

    def left(self, page: Pages) -> None:
        """A page has gone."""
        self.allowances.pop(page, None)
        self.heard.append(Heard(page, None))

    def taken(self) -> list[Heard]:
        """What the coming turn does of what was said; the rest waits."""
        now, self.heard = self.heard[:MOST_IN_A_TURN], self.heard[MOST_IN_A_TURN:]
        return now

    async def stream(self, session: ServerState) -> str:
        """Turn after turn while a page is open. It ends only by being cancelled or by an error."""
        loop = asyncio.get_running_loop()
        with ThreadPoolExecutor(1) as thread:
            due = loop.time()
            while True:
                await session.arrived.wait()
                heard, going = self.taken(), bool(session.clients)
                self.send(session, await loop.run_in_executor(thread, self.turn, heard, going))
                due = max(due + 1.0 / FPS, loop.time())
                await asyncio.sleep(due - loop.time())

    def send(self, session: ServerState, turn: Turn) -> None:
        """Tell the pages what came of a turn."""
        if turn.values != self.known:
            self.known = turn.values
            for page in session.clients:
                page.post(json.dumps({"values": turn.values}))
        for page, reply in turn.replies:
            page.post(json.dumps(reply))
        for page, record in turn.save:
            self.save(page, record)
        session.send(turn.frame)

    def save(self, page: Pages, record: SessionRecord) -> None:
        """Begin to save a session, unless one is being saved."""
        if self.saving is not None and not self.saving.done():
            page.post(json.dumps({"remark": "a session is being saved; wait for it"}))
            return
        page.post(json.dumps({"remark": "walking it again, to save it"}))
        self.saving = asyncio.create_task(self._save(page, record))

    async def _save(self, page: Pages, record: SessionRecord) -> None:
        """Save a session in a thread of its own, and say where it is."""
        try:
            paths = free_paths(self.folder)
            await asyncio.to_thread(save_session, record, *paths)
        except BipedError as error:
            page.post(json.dumps({"refused": str(error), "names": []}))
        else:
            page.post(json.dumps({"saved": [str(path) for path in paths]}))

    # -- in the thread of the session ----------------------------------------------------------------
    def ready(self) -> None:
        """Compile what a turn needs, and be at the start again."""
        self.driver.take(Message("step", {}))
        self.turn([], False)
        self.driver.take(Message("reset", {}))
        self.driver.take(Message("go", {}))

    def turn(self, heard: list[Heard], going: bool) -> Turn:
        """Do what was said, go on by the clock if there is a page, and make a frame."""
        replies: list[tuple[Pages, dict[str, object]]] = []
        save: list[tuple[Pages, SessionRecord]] = []
        for page, text in heard:
            try:
                if text is None:
                    self._gone(page)
                elif (message := message_of(text)).do == "save":
                    save.append((page, self.driver.session.record))
                else:
                    self._take(page, message)
            except BipedError as error:
                replies.append((page, {"refused": str(error), "names": names(text)}))
        if going:
            self.driver.go_on()
            self.share = min(self.share, self.driver.reached / self.driver.rate)
        walking = self.driver.session.walking
        return Turn(frame(self.driver), replies, [values(x.scenario) for x in walking], save)

    def _take(self, page: Pages, message: Message) -> None:
        """A message of a page; links are those of the drawn robot. Raises InputError and ModelError."""
        if "link" in message.given:
            live = self.driver.session.walking[WALK]
            given = {**message.given, "link": named(live, message.given["link"])}
            message = message._replace(given=given)
        self.driver.take(message)
        if message.do in ("pull", "push", "let_go"):
            self.puller = page if message.do == "pull" else None

    def _gone(self, page: Pages) -> None:
        """The hand of a page that has gone lets go."""
        if self.puller is page:
            self.puller = None
            self.driver.session.let_go()


def names(text: str | bytes | None) -> list[str]:
    """The fields that a message names, where it can be read."""
    try:
        given: Mapping[str, object] = message_of(text or "").given
    except BipedError:
        return []
    found = given.get("values")
    return [*found] if isinstance(found, dict) else []


def free_paths(folder: Path) -> list[Path]:
    """session-1.npz and session-1.toml in a folder, or the first number of which neither is there."""
    for k in count(1):
        paths = [folder / f"session-{k}{suffix}" for suffix in SUFFIXES]
        if not any(path.exists() for path in paths):
            break
    return paths
