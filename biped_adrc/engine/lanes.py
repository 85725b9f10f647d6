"""Compiled walks side by side, as many at once as a register of this processor holds numbers (the lanes).

Walks of one structure share the code: they may differ in all numbers, such as gains, masses and pushes. None of
them changes a bit by what walks beside it, or by the number of lanes. `engine.stretch` writes the code of a
sample, `engine.kernels.lanes` moves the walks.
"""

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import Any, NamedTuple, Self

import numpy as np
from llvmlite import binding
from numpy.typing import NDArray

from biped_adrc.closed_loop.instant_signals import step_reading
from biped_adrc.core.types import Array
from biped_adrc.engine.generated import generated_text, with_casadi
from biped_adrc.engine.kernels.compiled_run import STATUS, CompiledRun
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.kernels.record import END, Ints, block_rows
from biped_adrc.engine.program import CompiledWalker
from biped_adrc.engine.structure import structure
from biped_adrc.hybrid import constants
from biped_adrc.hybrid.status import Status

SIDE_BY_SIDE = 16
"""Least number of walks of one structure that go side by side: to compile their code takes half a second,
once."""
LINE = 64
"""Length of a line of the processor's cache [bytes]."""


@cache
def width() -> int:
    """Number of lanes: numbers of 8 bytes in a register of this processor."""
    features = binding.get_host_cpu_features()
    return 8 if features.get("avx512f") else 4 if features.get("avx") else 2


class Team(NamedTuple):
    """Memory of walks side by side, for the kernels in `kernels.lanes`."""

    run: CompiledRun
    """The record of what they have in common."""
    ready: Ints
    """Which lanes have a walk that may go side by side, as `record.Run.ready`."""
    parts: list[NDArray[Any]]
    """The arrays whose addresses the record has."""


@dataclass(frozen=True)
class Lanes:
    """Code for walks of one structure side by side."""

    lanes: int
    """How many."""
    laws: dict[str, int]
    """Addresses of functions for all of them, by fields of `record.Run`, where those of one walk are: `tick`,
    slope, step, disturbance and what a node has; 0 for none."""

    @classmethod
    def key(cls, compiled: CompiledWalker, read: bool) -> Hashable | None:
        """What walks side by side have in common; None for a walk that goes by itself: with the exponential
        method, or with long steps. read: whether nodes are kept.
        """
        run, program = compiled.plan, compiled.program
        # n_K: the curve's numbers stand at the end of K, also where no nodes are kept and no code reads them
        numbers = tuple(run[name] for name in ("period", "h", "part", "moving", "lags", "n_K"))
        long = min(run["period"] or run["h"], run["h"]) > constants.RESOLUTION
        if run["kind"] != constants.RK4 or long:
            return None
        curve = read and structure(program.numbers.curve)
        return program.key, structure(compiled.terms), numbers, curve

    @classmethod
    def of(cls, compiled: CompiledWalker, read: bool, lanes: int | None = None) -> Self:
        """Compile, or find, the code for walks like this one; lanes: how many, by default `width`."""
        program, lanes, terms = compiled.program, lanes or width(), compiled.terms
        more = int(compiled.plan["moving"]), int(compiled.plan["lags"]), lanes
        key, laws = ("lanes", program.key, *more), dict.fromkeys(("pushes", "look"), 0)
        names = ("slope", "step", *(["tick"] if program.numbers.held else []))
        text = partial(with_casadi, "stretch", "stretch_text", program.equations, *more)
        addresses = generated_text(key, names, text).addresses
        # by the fields of one walk's functions in a run
        laws |= zip(("flow", "events", "tick"), map(addresses.__getitem__, names), strict=False)
        if terms:
            n = program.numbers.plant.n
            push = "push", structure(terms), n, lanes
            text = partial(with_casadi, "stretch", "push_text", terms, n, lanes)
            laws["pushes"] = generated_text(push, ("push",), text).addresses["push"]
        if read:
            laws["look"] = program.reading(step_reading, lanes).addresses["reading"]
        return cls(lanes, laws)

    def team(self, one: CompiledRun) -> Team:
        """Memory for as many runs like this one as there are lanes."""
        run, lanes = CompiledRun(one.block, one.pointers), self.lanes
        at = block_rows(int(one["n"]), one.nx)
        rows = int(at[END]) * lanes
        sizes = {"K": int(one["n_K"]) * lanes, "push": int(one["n_push"]) * lanes}
        # both blocks have two cells behind their rows
        sizes |= {"now": rows + 2, "then": rows + 2, "results": int(one["width"]) * lanes}
        parts = {name: aligned(size) for name, size in sizes.items()}
        for name in ("now", "then"):
            parts[name][rows:].view(np.int64)[:] = self.laws["pushes"], parts["push"].ctypes.data
        whole = {name: np.zeros(lanes, np.int64) for name in ("team", "seats", "ready")}
        for name, x in (parts | whole | {"at": at}).items():
            run[name] = x.ctypes.data
        for name, address in (self.laws | {"lanes": lanes}).items():
            run[name] = address
        return Team(run, whole["ready"], [*parts.values(), *whole.values(), at])

    def run(self, runs: Sequence[CompiledRun]) -> list[Status]:
        """Move these runs to their ends or over their impacts; returns how each ended. Any thread may do so."""
        team, walks = self.team(runs[0]), np.array([run.address for run in runs])
        codes = np.zeros_like(walks)
        kernels().side_by_side(team.run.address, walks.ctypes.data, len(runs), codes.ctypes.data)
        return [STATUS[code] for code in codes.tolist()]


def aligned(size: int) -> Array:
    """Zeros (size,) that begin with a line of the processor's cache, which no register then has to cross."""
    memory = np.zeros(size + LINE // 8)
    first = -memory.ctypes.data % LINE // 8
    return memory[first : first + size]
