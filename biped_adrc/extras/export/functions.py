"""The functions of a robot's computer on symbols, by the lines of `closed_loop.semantics`.

    init       (t, q, v)        -> x_c              observer, filter and queue at the start
    step       (t, q, v, x_c)   -> x_c, u, lost     a sample instant; u (p,) [N m] goes to the motors
    touchdown  (t, q, v, x_c)   -> x_c              after an impact, q and v in the labels that begin

x_c = (s, w, queue, waiting, u): the controller's state, and what is held between sample instants.
lost is not positive where a matrix is singular or a torque beyond the walker's bound.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from biped_adrc.closed_loop import semantics
from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.core.timing import SAME_INSTANT
from biped_adrc.core.types import Array
from biped_adrc.engine.equations import Equations, SymbolicFunction, SymbolicInstant
from biped_adrc.engine.symbols import Scalar, Vector, column, where
from biped_adrc.engine.tracer import Tracer, run
from biped_adrc.extras.export.computer import Computer
from biped_adrc.hardware.motors import Line
from biped_adrc.hardware.sample_hold import read

HEAD = 4
"""Inputs before q: t, time of the sample instant before, number and start of the single support."""


@dataclass(frozen=True)
class Inputs:
    """The inputs of a function on symbols, and the loop that they are given to."""

    computer: Computer
    size: int
    """Numbers in s."""

    @cached_property
    def equations(self) -> Equations:
        """The computer's parts, with symbols for its numbers."""
        return Equations.of(self.size, self.computer.numbers)

    @cached_property
    def at(self) -> SymbolicInstant:
        """(t, last, step, start), then x = (q, v, x_c)."""
        inp, trace = Vector("inp", HEAD + self.equations.nx), Tracer()
        t, _, mode = inp.take(), inp.take(), Mode(inp.take(), inp.take())
        x = inp.take(self.equations.nx)
        return SymbolicInstant(inp, trace, self.equations.loop(trace), t, x, mode)

    @property
    def parts(self) -> tuple[Array, Array, Array, Array]:
        """q, v (n,), s, and what is held."""
        return semantics.parts(self.at.loop, self.at.x)

    def function(self, *parts: object) -> SymbolicFunction:
        """The function of these inputs, its parts one after the other."""
        return SymbolicFunction(self.equations.K, self.at.inp.symbol, column(*parts))  # type: ignore[arg-type]


def init(computer: Computer) -> SymbolicFunction:
    """x_c at the start of a single support at (t, q, v); no torque is on its way."""
    inputs, k = Inputs(computer, 0), computer.held
    q, v = inputs.parts[:2]
    at = inputs.at
    m = at.loop.measure(at.t, q, v, at.mode)
    controller = at.trace.on_symbols(inputs.equations.numbers.controller)
    s = run(at.trace, controller.initial_state, m)
    held = at.loop.held
    w = np.zeros(0) if held is None or held.sensors is None else held.sensors.start(q, v)
    return inputs.function(s, w, np.zeros(k.sizes.total - k.sizes.sensors))


def step(computer: Computer, size: int) -> SymbolicFunction:
    """x_c, u (p,) [N m] and lost at a sample instant, for a controller with `size` numbers in s."""
    inputs, k = Inputs(computer, size), computer.held
    n = k.sizes.n
    at = inputs.at._replace(x=_released(inputs))
    x = at.does(semantics.tick)
    line = read(k.sizes, semantics.parts(at.loop, x)[3]).line
    return inputs.function(x[2 * n :], sent_last(line), at.lost)


def touchdown(computer: Computer, size: int) -> SymbolicFunction:
    """x_c after a touchdown; the inputs of the mode are the single support that begins."""
    inputs = Inputs(computer, size)
    at, (q, v) = inputs.at, inputs.parts[:2]
    x = at.trace(semantics.after_contact)(at.loop, at.t, at.x, q, v, at.mode)
    return inputs.function(x[2 * len(q) :])


def _released(inputs: Inputs) -> Array:
    """x in which a torque that waited for a fraction of the period acts once that time is over."""
    k, at = inputs.computer.held, inputs.at
    if k.sizes.waiting == 0:
        return at.x
    p, after = k.sizes.p, k.motors.fraction * inputs.computer.timing.period - SAME_INSTANT
    over = at.t - Scalar(at.inp.symbol[1]) >= after
    u = [where(over, new, old) for new, old in zip(at.x[-2 * p : -p], at.x[-p:], strict=True)]
    return np.concatenate((at.x[:-p], np.array(u, dtype=object)))


def sent_last(line: Line) -> Array:
    """The torque (p,) [N m] that was sent at this sample instant, wherever on its way it is."""
    if len(line.queue) > 0:
        return line.queue[len(line.queue) - len(line.u) :]
    return line.waiting if len(line.waiting) > 0 else line.u
