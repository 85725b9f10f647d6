"""One call of each part of a step: dynamics, right-hand side, tick, impact; in Python and compiled.

Run: python benchmarks/engine/calls.py [OUT] [--quick]

"Compiled" is what Python pays for it: a call through ctypes with arrays of its own. "Machine code" is the
function in a compiled loop, as the integrators call it. Microseconds of CPU time, medians of batches; RABBIT.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from cases import TICK, load, paper
from machine_time import ROOM, machine_microseconds
from report import Table, arguments, microseconds

import biped_adrc as ba
from biped_adrc.control.passive import Passive
from biped_adrc.engine.compiled_biped import CompiledBiped
from biped_adrc.engine.program import Program
from biped_adrc.types import Array

MODE = ba.Mode(3, 0.0)


class Part:
    """A function of a program at one input."""

    def __init__(self, program: Program, name: str, inputs: Sequence[Array | float], out: int):
        self.program, self.at, self.outputs = program, program.address(name), out
        self.inp, self.out = np.concatenate([np.atleast_1d(x) for x in inputs]), np.zeros(ROOM)
        self._inp = self.inp.copy()
        self._pointers = (program.K.ctypes.data, self._inp.ctypes.data, self.out.ctypes.data)
        self._call = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 3)(self.at)

    def __call__(self) -> Array:
        """As from Python."""
        self._inp[:] = self.inp
        self._call(*self._pointers)
        return self.out[: self.outputs].copy()

    def machine(self, repeats: int) -> float:
        """By itself [us]."""
        return machine_microseconds(self.at, self.program.K, self.inp, repeats)


def add(
    table: Table, name: str, python: Callable[[], object] | None, part: Part, repeats: int
) -> None:
    """One row."""
    slow = None if python is None else microseconds(python, 300, repeats)
    row(table, name, slow, microseconds(part, 1000, repeats), part.machine(repeats))


def row(table: Table, name: str, slow: float | None, called: float, code: float) -> None:
    """Times [us] and their ratios."""
    table.add(
        name,
        Python=slow,
        compiled=called,
        machine_code=code,
        **{} if slow is None else {"Python/compiled": slow / called, "Python/code": slow / code},
    )


def dynamics(table: Table, biped: ba.Biped, q: Array, v: Array, repeats: int) -> None:
    """Of the robot alone."""
    code, f = CompiledBiped.of(biped), np.full(biped.n, 10.0)
    for name, method, args in (
        ("terms", "reduction", (q, v)),
        ("accelerate", "acceleration", (q, v, f)),
        ("ground", "ground_reaction", (q, v, f)),
    ):
        call, title = code._calls[name], {"terms": "D_s, Omega, kappa, xi"}.get(name, method)
        slow = microseconds(partial(getattr(biped, method), *args), 300, repeats)
        called = microseconds(partial(getattr(code, method), *args), 1000, repeats)
        at = call.owner.addresses[name]
        row(table, title, slow, called, machine_microseconds(at, call.K, call.inp))


def walkers(table: Table, repeats: int) -> None:
    """Of the closed loop."""
    for name in ("NPD", "ADRC"):
        walker, gait = paper(name, push=False)
        n, q, v = walker.plant.n, *gait.start(walker.plant)
        x, zeta = walker.initial_state(q, v, MODE), np.zeros(n)
        program, nx = Program.of(walker, len(x) - 2 * n), len(x)
        flow = Part(program, "flow", (0.1, MODE, x, zeta), nx + 1)
        add(table, f"right-hand side, {name}", partial(walker.flow, 0.1, x, MODE), flow, repeats)
        struck = np.concatenate((gait.q_minus, gait.v_minus, x[2 * n :]))
        strike = Part(program, "strike", (0.1, 4.0, struck), nx + 1)
        add(table, f"impact, {name}", partial(walker.struck, 0.1, struck, MODE), strike, repeats)
        for feedback in (False, True) if name == "ADRC" else ():
            laws = walker.split_laws(feedback)
            assert laws is not None
            split, stiff = Program.of(walker, len(x) - 2 * n, laws), len(laws.A) * walker.plant.p
            y = Part(split, "to", (x,), nx)()
            rest = Part(split, "remainder", (0.1, MODE, y, zeta), nx + 1)
            theirs = walker.feedback_split(MODE) if feedback else walker.split(MODE)
            assert theirs is not None
            pair = y[: nx - stiff], y[nx - stiff :].reshape(len(laws.A), -1)
            title = f"remainder{' with feedback' if feedback else ''}, {name}"
            add(table, title, partial(theirs.remainder, 0.1, *pair), rest, repeats)
        ticking = replace(walker, timing=ba.SampledTime(TICK))
        held = ticking.initial_state(q, v, MODE)
        size = len(held) - 2 * n - walker.plant.p
        tick = Part(Program.of(ticking, size), "tick", (0.1, MODE, held, zeta), len(held) + 1)
        python = partial(ticking.clocks()[0].update, 0.1, held, MODE)
        add(table, f"tick, {name}", python, tick, repeats)


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    repeats = 3 if asked.quick else 11
    biped = ba.Biped.load("rabbit")
    gait = ba.load_gait("published", biped)
    q, v = gait.start(biped)
    table = Table("Calls", "us", load(), ("pin", "numba", "llvmlite"))
    dynamics(table, biped, q, v, repeats)
    passive = Program.of(ba.Walker(biped, Passive()), 0)
    struck = np.concatenate((gait.q_minus, gait.v_minus))
    impact = Part(passive, "strike", (0.1, 2.0, struck), 2 * biped.n + 1)
    add(table, "impact", partial(biped.impact, gait.q_minus, gait.v_minus), impact, repeats)
    watch = Part(passive, "watch", (0.0, 0.0, 0.0, q), 4)

    def seen() -> tuple[Array, Array]:
        return biped.swing_foot(q), biped.hip(q)

    add(table, "feet and hip, for the guards", seen, watch, repeats)
    walkers(table, repeats)
    table.finish(asked.out)


if __name__ == "__main__":
    main()
