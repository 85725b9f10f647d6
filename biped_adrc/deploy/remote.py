"""Controllers of a walker whose every sample instant is a datagram to a process, and its answer.

`LockStep` waits for the answer: the walk is that of `ExportedController`, bit for bit. `RealTime` keeps to the
clock on the wall:

    due_k = due_0 + (t_k - t_0)     the measurement of the instant t_k is sent, at the earliest
    due_k + deadline                the answer is there and acts from t_k on, or the torque before goes on

So a walk in which no answer is late is that of `LockStep`. Where the scenario's delay is at least the deadline,
no torque acts before it is there. A late answer is left aside, as the one of another number.

The state is s = (number, w, u, t, q, v): of the datagram sent last, and 0 at the start; w the time on the wall
at t = 0; the torque; and the measurement of the start, from which the process is begun at the first sample
instant. What the observer holds is in the process: only from the state that it is in can a walk go on.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass, field

import numpy as np

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.deploy.datagram import INIT, NUMBERS, STEP, TOUCHDOWN, Answer
from biped_adrc.deploy.loaded import OK, check_flag
from biped_adrc.deploy.process import Channel
from biped_adrc.deploy.tick_times import Tick, TickTimes
from biped_adrc.errors import InputError, SimulationError, check_positive
from biped_adrc.types import Array

PATIENCE = 10.0
"""Longest time for an answer that has to come [s]."""
LEAD = 0.01
"""From the begin of the process to the first sample instant in real time [s]."""


def answer_to(channel: Channel, number: int, until: float) -> Answer | None:
    """The answer to the datagram of this number, others left aside; None where it is not there `until` [s]."""
    while (answer := channel.receive(until)) is not None:
        if answer.number == number % NUMBERS:
            return answer
    return None


@dataclass(frozen=True)
class RemoteController(Controller):
    """What both have in common; a subclass says how a sample instant and a touchdown pass."""

    channel: Channel = field(repr=False)

    @abstractmethod
    def asked(self, m: Measurement, u: Array, w: float) -> Array:
        """The torque (p,) [N m] from this sample instant on, after u (p,); w [s] is the wall's at t = 0."""

    @abstractmethod
    def told(self, after: Measurement, w: float) -> None:
        """Tell the process of a touchdown; w [s] is the wall's at t = 0."""

    def initial_state(self, m: Measurement) -> Array:
        return np.concatenate(([0.0, 0.0], np.zeros(len(m.q_b)), [m.t], m.q, m.v))

    def correct(self, s: Array, m: Measurement) -> Array:
        w = self._wall(s, m)
        return self._kept(s, w, self.asked(m, self.output(s, m), w))

    def output(self, s: Array, m: Measurement) -> Array:
        return s[2 : 2 + len(m.q_b)]

    def jump(self, s: Array, after: Measurement, swap: Array) -> Array:
        w = self._wall(s, after)
        self.told(after, w)
        return self._kept(s, w, self.output(s, after)[swap])

    def continuous(self) -> Controller:
        raise InputError(
            "a controller in another process acts at sample instants; give timing=SampledTime(period)"
        )

    def waited(self, number: int) -> Answer:
        """The answer to this datagram. Raises SimulationError for none, and as `check_flag`."""
        answer = answer_to(self.channel, number, self.channel.now() + PATIENCE)
        if answer is None:
            raise SimulationError(
                f"the controller's process is there, and has not answered for {PATIENCE:g} s"
            )
        check_flag(answer.flag)
        return answer

    def _wall(self, s: Array, m: Measurement) -> float:
        """Time on the wall at t = 0 [s]; where s is a start the process is begun.

        Raises InputError where the process is not at s.
        """
        if s[0] == 0.0:
            n = len(m.q)
            self.waited(self.channel.send(INIT, s[-2 * n - 1], s[-2 * n : -n], s[-n:]))
            return self.channel.now() + LEAD - m.t
        if s[0] != self.channel.number:
            raise InputError(
                "the controller's process is at another instant than this state, and cannot go back; begin "
                "from initial_state, and walk one walk at a time"
            )
        return float(s[1])

    def _kept(self, s: Array, w: float, u: Array) -> Array:
        """s after a datagram that left the torque u (p,) [N m]."""
        return np.concatenate(([float(self.channel.number), w], u, s[2 + len(u) :]))


@dataclass(frozen=True)
class LockStep(RemoteController):
    """The process of a channel as a walker's controller, waited for at every sample instant."""

    def asked(self, m: Measurement, u: Array, w: float) -> Array:
        return self.waited(self.channel.send(STEP, m.t, m.q, m.v)).u

    def told(self, after: Measurement, w: float) -> None:
        self.waited(self.channel.send(TOUCHDOWN, after.t, after.q, after.v))


@dataclass(frozen=True)
class RealTime(RemoteController):
    """The process of a channel as a walker's controller, by the clock on the wall; for one walk.

    deadline: longest time from a measurement to its torque [s]. ticks: the walk writes them. Raises InputError.
    """

    deadline: float
    ticks: list[Tick] = field(default_factory=list, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        check_positive(self.deadline, f"the deadline is {self.deadline} s")

    def asked(self, m: Measurement, u: Array, w: float) -> Array:
        channel, due = self.channel, w + m.t
        reached = channel.now()
        channel.pause(due)
        sent = channel.now()
        number = channel.send(STEP, m.t, m.q, m.v)
        answer, trip = answer_to(channel, number, sent + self.deadline), channel.now() - sent
        if answer is None or trip > self.deadline:
            self.ticks.append(Tick(m.t, reached - due, sent - due, math.nan, OK))
            return u
        self.ticks.append(Tick(m.t, reached - due, sent - due, trip, answer.flag))
        return answer.u

    def told(self, after: Measurement, w: float) -> None:
        self.channel.pause(w + after.t)
        self.channel.send(TOUCHDOWN, after.t, after.q, after.v)

    @property
    def times(self) -> TickTimes:
        """Of the walk so far. Raises InputError before the first sample instant."""
        return TickTimes.of(self.ticks)
