"""N walks of learners in machine code: one call moves each of them on by a sample, under its own torque.

The call goes over all walks and samples in compiled code (`engine.kernels.samples`), so that Python's part does
not grow with N. Each walk has memory of its own, and its numbers do not depend on the other walks.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode
from biped_adrc.engine.compiled_signals import SignalNumbers, reading_code
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.equations import WalkerNumbers
from biped_adrc.engine.kernels import layout
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.machine import LoadedCode
from biped_adrc.engine.symbols import floats
from biped_adrc.gait.reference import Reference
from biped_adrc.gym.episode import Episode, Needs
from biped_adrc.gym.view import learner_view
from biped_adrc.hybrid.trajectory import Arc, Event
from biped_adrc.types import Array

LAW = "learner"
"""Name of `learner_view` in machine code."""


class LoadedWalk(NamedTuple):
    """One walk in memory; what the kernels read by address is kept alive here."""

    episode: Episode
    walker: CompiledWalker
    code: LoadedCode
    """Of the function LAW."""
    P: NDArray[np.int64]
    F: Array
    K: Array
    """Numbers of the walker, then those of the reference."""
    W: Array
    s: Array
    R: Array
    """Nodes of this single support (rows, 1 + 2 nx): t, x, x'."""

    @property
    def given(self) -> list[int]:
        """What the kernel `samples` is given of it."""
        at = [x.ctypes.data for x in (self.P, self.F, self.K, self.W, self.s, self.R)]
        return [*at, place_of_torque(self.walker.program.numbers), self.code.addresses[LAW]]


def place_of_torque(numbers: WalkerNumbers) -> int:
    """Where the learner's torque is among the numbers of a walker under an `AddedTorque`."""
    inner = numbers.controller.inner  # type: ignore[attr-defined]
    return len(floats((numbers.plant, numbers.model, inner)))


class CompiledWalks:
    """N walks. Raises NotCompiled, when one begins, for a part that cannot be compiled."""

    def __init__(self, count: int, reference: Reference):
        """reference: the curve that errors refer to."""
        self.reference = reference
        self.laws = dict[int, LoadedCode]()
        """By the address of the walk's own code, with which they change."""
        self.made: list[LoadedWalk | None] = [None] * count
        self.given = np.zeros((count, kernels().GIVEN), dtype=np.int64)
        self.codes = np.ones(count, dtype=np.int64)
        self.seen = np.zeros((count, 0))
        self.needs, self.modes = Needs(count), [Mode()] * count
        self.steps, self.step_at = np.zeros(count), 0
        """Number of each single support, and its place among the numbers of `view.LearnerView`."""

    def begin(self, i: int, episode: Episode) -> None:
        """Walk i anew; row i of `seen` is what is to be seen at its start."""
        made = self._made(episode)
        self.made[i] = made
        self.given[i] = made.given
        self.step_at = 2 * episode.walker.plant.n + 3 * episode.walker.plant.p + 1
        if self.seen.shape[1] == 0:
            self.seen = np.zeros((len(self.seen), self.step_at + 3))
        kernels().looks(self.given[i], self.seen[i : i + 1])
        self.codes[i], self.modes[i], self.steps[i] = 0, episode.mode, episode.mode.step
        self.needs.begin(i)

    def move(self, torques: Array) -> None:
        """Every walk whose code is 0 by one sample, under its row of torques (N, p) [N m]."""
        walked = self.codes == 0
        kernels().samples(self.given.ravel(), torques, self.seen, self.codes)
        steps = self.seen[:, self.step_at]
        for i in np.flatnonzero(walked & ((self.codes != 0) | (steps > self.steps))):
            made = self.made[i]
            assert made is not None
            self._judge(int(i), made)
        self.steps = steps.copy()

    def _judge(self, i: int, made: LoadedWalk) -> None:
        """Take up what the single support of walk i needed that is over, and keep the nodes of the next."""
        s, mode = made.s, self.modes[i]
        rows = made.R[: int(s[layout.COUNT])]
        nx, struck, event = (rows.shape[1] - 1) // 2, s[layout.STEP] > mode.step, None
        over, next_one = rows.copy(), rows[:0]
        if struck:
            last = int(np.searchsorted(rows[:, 0], s[layout.START])) + 1
            over, next_one = rows[:last].copy(), rows[last:].copy()
            event = Event(FOOT_STRIKE, over[-1, 0], over[-1, 1 : 1 + nx], None)
        if len(over) > 0:
            arc = Arc(mode, over[:, 0], over[:, 1 : 1 + nx], over[:, 1 + nx :], event)
            self.needs.add(i, made.episode.needed(arc))
        made.R[: len(next_one)] = next_one
        s[layout.COUNT] = len(next_one)
        self.modes[i] = Mode(int(s[layout.STEP]), float(s[layout.START]))

    def _made(self, episode: Episode) -> LoadedWalk:
        walker = episode.walker
        x = walker.initial_state(episode.q, episode.v, episode.mode)
        made = CompiledWalker.of(walker, episode.method, walker.controller_size(x))
        watched = SignalNumbers(made.program.numbers, self.reference)
        of = made.program.address("tick")
        if of not in self.laws:
            self.laws[of] = reading_code(LAW, learner_view, made.program.make, watched)
        K = np.array([*floats(watched), 0.0])
        s = made.plan.start(x, 0.0, *episode.mode, 0.0)
        R = np.empty((room(episode), 1 + 2 * len(x)))
        s[layout.ROOM] = len(R)
        of_plan = made.plan.P, made.plan.F, K, made.plan.work(), s, R
        return LoadedWalk(episode, made, self.laws[of], *of_plan)


def room(episode: Episode) -> int:
    """Nodes of the longest single support: two at each break, and one at each step."""
    period = episode.walker.timing.period  # type: ignore[union-attr]
    steps = math.ceil(period / getattr(episode.method, "h", period))
    return 64 + int((steps + 4) * episode.walker.max_step_time / period)
