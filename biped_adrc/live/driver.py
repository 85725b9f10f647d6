"""A session at the pace of a clock, and at the word of messages.

    driver = Driver(session)
    driver.go_on()              # as far as the clock has come since the last call, at the rate asked for
    driver.take(message)        # pause, go, step, back, reset, rate, push, pull, let_go, change, ghost

`nodes` and `hand` are those of the last sample, for `reading`; None where the walk has been changed since.

A walk that cannot keep up is not made good later: what is owed after `BUSY` of computing is dropped, and
`reached` says which rate there was.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from biped_adrc.errors import InputError
from biped_adrc.hybrid.simulator import FlownArc
from biped_adrc.live.hand import Hand
from biped_adrc.live.messages import Message
from biped_adrc.live.session import WALK, Session

SLOWEST, FASTEST = 0.01, 10.0
"""Rates that may be asked for: seconds of the walk a second."""
LONGEST = 0.1
"""Time [s] of the clock that is made good at once: after a longer rest, as of a computer that slept, it goes
on."""
BUSY = 0.05
"""Longest time [s] of computing in one call."""
SMOOTH = 1.0
"""Time constant [s] of the rate that is said."""


class Driver:
    """A session, whether it goes on by itself, and how fast. clock: a time [s] that never goes back."""

    def __init__(self, session: Session, clock: Callable[[], float] = time.monotonic):
        self.session, self.clock = session, clock
        self.paused, self.rate, self.reached = False, 1.0, 1.0
        self.owed, self.last = 0.0, clock()
        self.nodes: list[FlownArc | None] = []
        self.hand: Hand | None = None
        self._forget()

    def go_on(self) -> bool:
        """On by the time since the last call; whether anything has moved."""
        began = self.clock()
        passed, self.last = min(LONGEST, began - self.last), began
        if self.paused or not self.session.walks or passed <= 0.0:
            self.owed = 0.0
            return False
        self.owed += self.rate * passed
        moved = 0.0
        while self.owed > 0.0 and self.session.walks and self.clock() - began < BUSY:
            moved += self._sampled()
        share = min(1.0, passed / SMOOTH)
        self.reached += share * (moved / passed - self.reached)
        self.owed = min(self.owed, 0.0)
        return moved > 0.0

    def _sampled(self) -> float:
        """One sample on; how long it was [s]."""
        before = self.session.t
        for k, made in enumerate(self.session.sample()):
            self.nodes[k] = made[-1] if made else self.nodes[k]
        self.hand = self.session.hand
        step = self.session.t - before
        self.owed -= step
        return step

    def _forget(self) -> None:
        """The last sample is not of the walk that is there now."""
        self.nodes, self.hand = [None for _ in self.session.walking], None

    def take(self, message: Message) -> None:
        """Do what a message says. Raises InputError or ModelError; then all is as it was."""
        getattr(self, f"_{message.do}")(**message.given)

    # -- one for each message, which `messages` has checked ------------------------------------------
    def _pause(self) -> None:
        self.paused = True

    def _go(self) -> None:
        self.paused, self.last = False, self.clock()

    def _step(self) -> None:
        """One sample, and rest."""
        self.paused = True
        self._sampled()

    def _back(self) -> None:
        self.session.back()
        self._forget()

    def _reset(self) -> None:
        self.session.reset()
        self._forget()

    def _let_go(self) -> None:
        self.session.let_go()

    def _rate(self, rate: float) -> None:
        if not SLOWEST <= rate <= FASTEST:
            raise InputError(f"the rate is {rate:g}, expected {SLOWEST:g} to {FASTEST:g}")
        self.reached *= rate / self.rate  # the same share of what is asked for
        self.rate = float(rate)

    def _push(
        self,
        torque: dict[str, float] | None = None,
        force: tuple[float, float] = (0.0, 0.0),
        link: str | None = None,
        at: tuple[float, float] = (0.0, 0.0),
        seconds: float = 0.2,
    ) -> None:
        self.session.push(torque, force, link, at, seconds)

    def _pull(self, link: str, at: tuple[float, float], anchor: tuple[float, float]) -> None:
        self.session.pull(link, at, anchor)

    def _change(self, values: dict[str, object], walk: int = WALK) -> None:
        if walk != int(walk):
            raise InputError(f"walk {walk} is changed, expected a whole number")
        if none := {"self", "walk"} & set(values):
            raise InputError(f"{sorted(none)} are no fields of a scenario")
        self.session.change(int(walk), **values)
        self.nodes[int(walk)] = None

    def _ghost(self, values: dict[str, object] | None = None) -> None:
        """The session anew from its start, with a ghost of these values, or without one."""
        self.session = Session(self.session.walking[WALK].scenario, values)
        self._forget()
