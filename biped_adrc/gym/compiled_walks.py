"""N walks of learners in machine code: one call moves each of them on by a sample, under its own torque.

The call goes over all walks and samples in compiled code (`engine.kernels.samples`), so that Python's part does
not grow with N. Each walk has memory of its own, and its numbers do not depend on the other walks.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode
from biped_adrc.engine.compiled_signals import SignalNumbers, reading_code
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.equations import WalkerNumbers
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.kernels.run_plan import CompiledRun
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
    run: CompiledRun
    nodes: Array
    """Of this single support (rows, 1 + 2 nx): t, x, x'."""

    @property
    def addresses(self) -> list[int]:
        """What the kernel `samples` reads of it."""
        torque = self.run.place("K") + place_of_torque(self.walker.program.numbers)
        return [self.run.address, self.run.address + 8 * torque, self.code.addresses[LAW]]


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
        self.addresses = np.zeros((count, kernels().WALK), dtype=np.int64)
        self.codes = np.ones(count, dtype=np.int64)
        self.seen = np.zeros((count, 0))
        self.needs, self.modes = Needs(count), [Mode()] * count
        self.steps, self.step_at = np.zeros(count), 0
        """Number of each single support, and its place among the numbers of `view.LearnerView`."""

    def begin(self, i: int, episode: Episode) -> None:
        """Walk i anew; row i of `seen` is what is to be seen at its start."""
        made = self._made(episode)
        self.made[i] = made
        self.addresses[i] = made.addresses
        self.step_at = 2 * episode.walker.plant.n + 3 * episode.walker.plant.p + 1
        if self.seen.shape[1] == 0:
            self.seen = np.zeros((len(self.seen), self.step_at + 3))
        kernels().looks(self.addresses[i], self.seen[i : i + 1])
        self.codes[i], self.modes[i], self.steps[i] = 0, episode.mode, episode.mode.step
        self.needs.begin(i)

    def move(self, torques: Array) -> None:
        """Every walk whose code is 0 by one sample, under its row of torques (N, p) [N m]."""
        walked = self.codes == 0
        kernels().samples(self.addresses.ravel(), torques, self.seen, self.codes)
        steps = self.seen[:, self.step_at]
        for i in np.flatnonzero(walked & ((self.codes != 0) | (steps > self.steps))):
            made = self.made[i]
            assert made is not None
            self._judge(int(i), made)
        self.steps = steps.copy()

    def _judge(self, i: int, made: LoadedWalk) -> None:
        """Take up what the single support of walk i needed that is over, and keep the nodes of the next."""
        run, mode = made.run, self.modes[i]
        rows = made.nodes[: int(run["count"])]
        nx, struck, event = run.nx, run["step"] > mode.step, None
        over, next_one = rows.copy(), rows[:0]
        if struck:
            last = int(np.searchsorted(rows[:, 0], run["t_start"])) + 1
            over, next_one = rows[:last].copy(), rows[last:].copy()
            event = Event(FOOT_STRIKE, over[-1, 0], over[-1, 1 : 1 + nx], None)
        if len(over) > 0:
            arc = Arc(mode, over[:, 0], over[:, 1 : 1 + nx], over[:, 1 + nx :], event)
            self.needs.add(i, made.episode.needed(arc))
        made.nodes[: len(next_one)] = next_one
        run["count"] = len(next_one)
        self.modes[i] = Mode(int(run["step"]), run["t_start"])

    def _made(self, episode: Episode) -> LoadedWalk:
        walker = episode.walker
        x = walker.initial_state(episode.q, episode.v, episode.mode)
        size = walker.controller_size(x)
        made = CompiledWalker.of(walker, episode.method, size, reference=self.reference)
        watched = SignalNumbers(made.program.numbers, self.reference)
        of = made.program.address("tick")
        if of not in self.laws:
            self.laws[of] = reading_code(LAW, learner_view, made.program.make, watched)
        run = made.plan.start(x, 0.0, *episode.mode, 0.0)
        nodes = np.empty((room(episode), 1 + 2 * len(x)))
        run["every"] = 1
        run.set_nodes(nodes)
        return LoadedWalk(episode, made, self.laws[of], run, nodes)


def room(episode: Episode) -> int:
    """Nodes of the longest single support: two at each break, and one at each step."""
    period = episode.walker.timing.period  # type: ignore[union-attr]
    steps = math.ceil(period / getattr(episode.method, "h", period))
    return 64 + int((steps + 4) * episode.walker.max_step_time / period)
