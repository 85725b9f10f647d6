"""N walks of learners in machine code: one call moves each of them on by a sample, under its own torque.

The call goes over all walks and samples in compiled code (`engine.kernels.samples`), so that Python's part does
not grow with N. Each walk has memory of its own, and its numbers do not depend on the other walks.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from biped_adrc.engine.compiled_signals import SignalNumbers, reading_code
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.equations import WalkerNumbers
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.kernels.run_plan import CompiledRun
from biped_adrc.engine.machine import LoadedCode
from biped_adrc.engine.symbols import floats
from biped_adrc.gait.reference import Reference
from biped_adrc.gym.episode import Episode
from biped_adrc.gym.view import learner_view
from biped_adrc.types import Array

LAW = "learner"
"""Name of `learner_view` in machine code."""


class LoadedWalk(NamedTuple):
    """One walk in memory; what the kernels read by address is kept alive here."""

    walker: CompiledWalker
    code: LoadedCode
    """Of the function LAW."""
    run: CompiledRun

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

    def begin(self, i: int, episode: Episode) -> None:
        """Walk i anew; row i of `seen` is what is to be seen at its start."""
        made = self._made(episode)
        self.made[i] = made
        self.addresses[i] = made.addresses
        width = made.run.width
        if self.seen.shape[1] < width:
            self.seen = np.hstack(
                (self.seen, np.zeros((len(self.seen), width - self.seen.shape[1])))
            )
        kernels().looks(self.addresses[i], self.seen[i : i + 1])
        self.codes[i] = 0

    def move(self, torques: Array) -> None:
        """Every walk whose code is 0 by one sample, under its row of torques (N, p) [N m]."""
        kernels().samples(self.addresses.ravel(), torques, self.seen, self.codes)

    def _made(self, episode: Episode) -> LoadedWalk:
        walker = episode.walker
        x = walker.initial_state(episode.q, episode.v, episode.mode)
        size = walker.controller_size(x)
        made = CompiledWalker.of(walker, episode.method, size, reference=self.reference)
        watched = SignalNumbers(made.program.numbers, self.reference)
        of = made.program.address("tick")
        if of not in self.laws:
            self.laws[of] = reading_code(LAW, learner_view, made.program.make, watched)
        return LoadedWalk(made, self.laws[of], made.plan.start(x, 0.0, *episode.mode, 0.0))
