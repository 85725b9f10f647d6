"""A session at the pace of a clock, and at the word of messages.

    driver = Driver(session)
    driver.go_on()              # as far as the clock has come since the last call, at the rate asked for
    driver.take(message)        # pause, go, step, back, reset, rate, push, pull, let_go, change, ghost

`made` has the samples that were made since the last frame, of each walk, for `reading`: none where the walk has
been changed since, and those of the last frame where it has not gone on.

A walk that cannot keep up is not made good later: what is owed after `BUSY` of computing is dropped, and
`reached` says which rate there was, and `kept` the share of it over the whole session.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any, NamedTuple

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


class Sample(NamedTuple):
    """One sample of a walk."""

    flown: FlownArc
    hand: Hand | None
    """That acted over it."""


class Driver:
    """A session, whether it goes on by itself, and how fast. clock: a time [s] that never goes back."""

    def __init__(self, session: Session, clock: Callable[[], float] = time.monotonic):
        self.session, self.clock = session, clock
        self.paused, self.rate, self.reached = False, 1.0, 1.0
        self.owed, self.last = 0.0, clock()
        self.asked, self.walked = 0.0, 0.0
        self._forget()

    def go_on(self) -> bool:
        """On by the time since the last call; whether anything has moved."""
        began = self.clock()
        passed, self.last = began - self.last, began
        if self.paused or not self.session.walks or passed <= 0.0:
            self.owed = 0.0
            return False
        self.owed += self.rate * min(LONGEST, passed)
        moved = 0.0
        while self.owed > 0.0 and self.session.walks and self.clock() - began < BUSY:
            moved += self._sampled()
        self.asked, self.walked = self.asked + self.rate * passed, self.walked + moved
        share = min(1.0, passed / SMOOTH)
        self.reached += share * (moved / passed - self.reached)
        self.owed = min(self.owed, 0.0)
        return moved > 0.0

    @property
    def kept(self) -> float:
        """Walked time over that asked for, since the session was begun; 1 before."""
        return self.walked / self.asked if self.asked > 0.0 else 1.0

    def _sampled(self) -> float:
        """One sample on; how long it was [s]."""
        before = self.session.t
        for k, flown in enumerate(self.session.sample()):
            if flown and k in self._shown:
                self._shown.remove(k)
                self.made[k] = []
            self.made[k] += [Sample(one, self.session.hand) for one in flown]
        step = self.session.t - before
        self.owed -= step
        return step

    def rest(self) -> None:
        """Nobody looks: the time since the last call is not made good."""
        self.last, self.owed = self.clock(), 0.0

    def shown(self) -> None:
        """The samples of `made` have been shown: with the next one it begins anew."""
        self._shown = {*range(len(self.made))}

    def _forget(self) -> None:
        """No sample is of the walks that are there now."""
        self.made: list[list[Sample]] = [[] for _ in self.session.walking]
        self._shown = set[int]()

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

    def _reset(self, values: dict[str, object] | None = None) -> None:
        self.session.reset(**(values or {}))
        self._forget()

    def _let_go(self) -> None:
        self.session.let_go()

    def _rate(self, rate: float) -> None:
        if not SLOWEST <= rate <= FASTEST:
            raise InputError(f"the rate is {rate:g}, expected {SLOWEST:g} to {FASTEST:g}")
        self.reached *= rate / self.rate  # the same share of what is asked for
        self.rate = float(rate)

    def _push(self, **given: Any) -> None:
        self.session.push(**given)

    def _pull(self, **given: Any) -> None:
        self.session.pull(**given)

    def _change(self, values: dict[str, object], walk: int = WALK) -> None:
        if walk != int(walk):
            raise InputError(f"walk {walk} is changed, expected a whole number")
        if none := {"self", "walk"} & set(values):
            raise InputError(f"{sorted(none)} are no fields of a scenario")
        self.session.change(int(walk), **values)
        self.made[int(walk)] = []

    def _ghost(self, values: dict[str, object] | None = None) -> None:
        """The session anew from its start, with a ghost of these values, or without one."""
        self.session = Session(self.session.walking[WALK].scenario, values)
        self._forget()
