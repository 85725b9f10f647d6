"""What pages see of a session and say to it, over `viz.meshcat.server`.

The session belongs to one thread, in which it is moved on and changed, so that the server answers while it
computes or compiles. Sixty times a second that thread takes what the pages have said since, goes on by the
clock, and makes a `frame` for all pages. What takes longer waits for the next turn. Replies go to the page
that spoke:

    {"refused": sentence, "names": [...]}       a message that was not taken, and the fields that it names
    {"saved": [path, ...]}, {"remark": sentence}

and to all pages `{"values": [...]}`, the values of each walk, when they are other ones.

A page that says more than it may (`messages.Allowance`) is closed. When the page goes whose hand pulls, the
hand lets go.
"""

from __future__ import annotations

import asyncio
import json
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from itertools import count
from pathlib import Path
from typing import NamedTuple

from biped_adrc.errors import BipedError
from biped_adrc.live.controls import values
from biped_adrc.live.driver import BUSY, Driver
from biped_adrc.live.frame import frame, named
from biped_adrc.live.messages import MOST_BYTES, MOST_ENTRIES, Allowance, Message, message_of
from biped_adrc.live.record import SessionRecord
from biped_adrc.live.repeated import SUFFIXES, save_session
from biped_adrc.live.session import WALK
from biped_adrc.viz.meshcat.server import Listener, Pages, Say, ServerState

FPS = 60.0
"""Frames a second at most."""
MOST_WAITING = 300
"""Messages of one page that may wait."""


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
    waits: list[Heard]
    """What was not done, as the turn was long enough: for the next one."""


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
        self.saving: asyncio.Task[list[Path]] | None = None
        self.given_up = threading.Event()
        """Whether what is being saved is not to be saved any more."""

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

    def listens(self, one: Heard) -> bool:
        """Whether this is still to be done: a page that was closed is not heard any more, but that it left."""
        return one.text is None or one.page in self.allowances

    def left(self, page: Pages) -> None:
        """A page has gone."""
        self.allowances.pop(page, None)
        self.heard.append(Heard(page, None))

    async def stream(self, session: ServerState) -> str:
        """Turn after turn while a page is open. It ends only by being cancelled or by an error."""
        loop = asyncio.get_running_loop()
        with ThreadPoolExecutor(1) as thread:
            await session.arrived.wait()
            self.driver.rest()
            due = loop.time()
            while True:
                heard, self.heard = self.heard, []
                going = bool(session.clients)
                turn = await loop.run_in_executor(thread, self.turn, heard, going)
                self.heard[:0] = [one for one in turn.waits if self.listens(one)]
                self.send(session, turn)
                due = max(due + 1.0 / FPS, loop.time())
                await asyncio.sleep(due - loop.time())

    def send(self, session: ServerState, turn: Turn) -> None:
        """Tell the pages what came of a turn."""
        if turn.values != self.known:
            self.known = turn.values
            for page in session.clients:
                page.tell(json.dumps({"values": turn.values}))
        for page, reply in turn.replies:
            page.tell(json.dumps(reply))
        for page, record in turn.save:
            self.save(page, record)
        session.send(turn.frame)

    def save(self, page: Pages, record: SessionRecord) -> None:
        """Begin to save a session, unless one is being saved."""
        if self.saving is not None and not self.saving.done():
            page.tell(json.dumps({"remark": "a session is being saved; wait for it"}))
            return
        page.tell(json.dumps({"remark": "walking it again, to save it"}))
        self.saving = asyncio.create_task(self._save(page, record))

    async def _save(self, page: Pages, record: SessionRecord) -> list[Path]:
        """Save a session in a thread of its own, and say where it is; nowhere where it cannot be written."""
        try:
            paths = free_paths(self.folder)
            await asyncio.to_thread(save_session, record, *paths, going=self.goes_on)
        except BipedError as error:
            page.tell(json.dumps({"refused": str(error), "names": []}))
            return []
        page.tell(json.dumps({"saved": [str(path) for path in paths]}))
        return paths

    def goes_on(self) -> bool:
        """Whether a session is still to be saved."""
        return not self.given_up.is_set()

    async def closing(self, again: asyncio.Event, say: Say) -> None:
        """Wait for a session that is being saved, or until it is given up."""
        if self.saving is None or self.saving.done():
            return
        say("a session is still being saved; Ctrl-C gives it up")
        told = asyncio.ensure_future(again.wait())
        await asyncio.wait((self.saving, told), return_when=asyncio.FIRST_COMPLETED)
        told.cancel()
        if again.is_set():
            self.given_up.set()
        paths = await self.saving
        say(f"saved as {' and '.join(map(str, paths))}" if paths else "the session is not saved")

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
        waits, until = [*heard], self.driver.clock() + BUSY
        while waits and self.driver.clock() <= until:
            page, text = waits.pop(0)
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
        else:
            self.driver.rest()
        told = [values(x.scenario) for x in self.driver.session.walking]
        seen = frame(self.driver)
        self.driver.shown()
        return Turn(seen, replies, told, save, waits)

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
        found = json.loads(text or "")["values"]
    except (ValueError, TypeError, LookupError, RecursionError):
        return []
    return [*found][:MOST_ENTRIES] if isinstance(found, dict) else []


def free_paths(folder: Path) -> list[Path]:
    """session-1.npz and session-1.toml in a folder, or the first number of which neither is there."""
    for k in count(1):
        paths = [folder / f"session-{k}{suffix}" for suffix in SUFFIXES]
        if not any(path.exists() for path in paths):
            break
    return paths
