"""The functions that run on a robot's computer as symbolic expressions, and the names of their numbers in C.

To trace a function of Python is to call it on CasADi's symbols: the result is the expression that it computes.
What is traced are the functions of `closed_loop.semantics`, which the simulation runs.

    init       (t, q, v)        -> x_c              observer, filter and queue at the start
    step       (t, q, v, x_c)   -> x_c, u, lost     a sample instant; u (p,) [N m] goes to the motors
    touchdown  (t, q, v, x_c)   -> x_c              after an impact, q and v named for the new stance leg

x_c = (s, w, queue, waiting, u) is what the computer keeps between sample instants: the states of controller and
sensors, torques on their way and the one that acts, as in `hardware.sample_hold`. `lost` is the least pivot of
the matrices that are inverted, 0 where one is singular; it is negative where a torque is beyond the walker's
bound.

In C the numbers x_c are fields of a struct: x holds them before a function, next after it, and m the
measurement. Numbers of x_c on which no torque depends have no field.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from biped_adrc.closed_loop import semantics
from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.core.timing import SAME_INSTANT
from biped_adrc.core.tree import flatten
from biped_adrc.core.types import Array
from biped_adrc.engine.equations import Equations, SymbolicFunction, SymbolicInstant
from biped_adrc.engine.symbols import Scalar, Vector, column, wheres
from biped_adrc.engine.tracer import apply
from biped_adrc.extras.export.c_text import CFunction, Entry, read_by
from biped_adrc.extras.export.computer import Computer, Noticed

_FIRST = {"m->t": True, "x->last": True, "next->step": False, "next->start": True}
"""Name in C of each input before q -> whether it is always a double. They are t, the time of the previous
sample instant, and number and start of the single support."""
_HEAD = len(_FIRST)
"""Number of these inputs."""


@dataclass(frozen=True)
class Inputs:
    """The inputs of one of the three functions as symbols, and the closed loop on these symbols."""

    computer: Computer

    @cached_property
    def equations(self) -> Equations:
        """The closed loop's equations, with a symbol for each parameter of the computer."""
        return Equations(self.computer.layout, self.computer.numbers)

    @cached_property
    def at(self) -> SymbolicInstant:
        """An instant on symbols; its inputs are (t, last, step, start) as in _FIRST, then x = (q, v, x_c)."""
        # take: the next symbols of `inp`. last, the time of the previous sample instant, is no part of an
        # instant; Mode is (step, start)
        # _HEAD: number of the inputs before x
        inp = Vector("inp", _HEAD + self.equations.nx)
        t, _, mode = inp.take(), inp.take(), Mode(inp.take(), inp.take())
        x = inp.take(self.equations.nx)
        return SymbolicInstant(inp, self.equations.loop(), t, x, mode)

    @property
    def parts(self) -> semantics.State:
        """The state x of symbols as a tree: q, v, s and the tail, which has the sensors' w and the torques."""
        return semantics.parts(self.at.loop, self.at.x)

    def function(self, *parts: object) -> SymbolicFunction:
        """The function from these inputs to its results `parts`, one after the other."""
        # symbols[0]: the parameters K as one vector of symbols
        return SymbolicFunction(self.equations.symbols[0], self.at.inp.symbol, column(*parts))  # type: ignore[arg-type]


def init(computer: Computer) -> SymbolicFunction:
    """Trace the function that returns x_c for a start at (t, q, v), with no torque on its way."""
    inputs = Inputs(computer)
    (q, v, _, tail), at = inputs.parts, inputs.at
    m = at.loop.measure(at.t, q, v, at.mode)
    # symbols[1]: the walker's parts with symbols in place of their numbers; on_symbols: the form of the
    # controller whose methods can be traced; apply: traces a method at m
    controller = at.loop.trace.on_symbols(inputs.equations.symbols[1].controller)
    s = apply(at.loop.trace, controller.initial_state, m)
    held = at.loop.held
    # w: state of the sensors; line: torques on their way, all zero; s: state of the controller
    w = None if held is None or held.sensors is None else held.sensors.start(q, v)
    line = np.zeros(computer.held.line.size)
    return inputs.function(flatten(s), flatten(tail._replace(sensors=w, line=line)))


def step(computer: Computer) -> SymbolicFunction:
    """Trace the function that returns x_c after a sample instant, u (p,) [N m] and lost."""
    inputs = Inputs(computer)
    # _released: x in which the torque that waited for a fraction of the period acts, if that time is over
    at = inputs.at._replace(x=_released(inputs))
    # does: traces a function at this instant
    x = at.does(semantics.tick)  # the lines that a walk runs; no second text of the law for C
    sent = semantics.parts(at.loop, x).tail.line.sent  # u: the torque that goes to the motors now
    # x_c follows q and v in x; lost is the number behind every function of the loop
    return inputs.function(x[2 * computer.robot.n :], sent, at.loop.lost)


def touchdown(computer: Computer) -> SymbolicFunction:
    """Trace the function that returns x_c after a touchdown; its inputs step and start are those of the single
    support that begins.
    """
    inputs = Inputs(computer)
    at, (q, v, _, _) = inputs.at, inputs.parts
    # `after_contact`: new labels of torques and sensors, and the controller's jump, at q, v with the new names
    x = at.loop.trace(semantics.after_contact)(at.loop, at.t, at.x, q, v, at.mode)
    return inputs.function(x[2 * len(q) :])


def _released(inputs: Inputs) -> Array:
    """The state x at a sample instant, in which the torque that waited for a fraction of the period acts, if
    that time is over.
    """
    # A walk stops at that time, by a clock of its own (`ClosedLoop.clocks`). A robot's computer is called at
    # sample instants alone, so C does it at the next one. `over` is a symbol: both vectors are written, and C
    # chooses.
    computer, at = inputs.computer, inputs.at
    # of the period, by which the delay is longer than whole periods
    fraction = computer.held.motors.fraction
    if fraction == 0.0:
        return at.x
    # symbol[1]: `last`, the time of the sample instant before
    acts = fraction * computer.walker.clock.period - SAME_INSTANT
    over = at.t - Scalar(at.inp.symbol[1]) >= acts
    # released: x with the waiting torque in place of the one that acts, which is the last p numbers of x
    p, released = computer.robot.p, semantics.release(at.loop, at.x)
    return np.concatenate((at.x[:-p], wheres(over, released[-p:], at.x[-p:])))


@dataclass(frozen=True)
class Field:
    """An array in the struct of x_c: its name, length, description, and whether it is always of doubles."""

    name: str
    size: int
    words: str
    double: bool = False

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names of its entries in C, such as "s[0]"."""
        return iter(f"{self.name}[{i}]" for i in range(self.size))


@dataclass(frozen=True)
class Functions:
    """The three functions of a computer, with the names in C of their inputs and outputs."""

    fields: tuple[Field, ...]
    """Fields of the struct that hold x_c."""
    all: tuple[CFunction, ...]
    """init, step and touchdown."""
    rates: tuple[int, ...]
    """Indices of the rates v that `step` or `touchdown` reads; `init` reads all."""


def functions(computer: Computer) -> Functions:
    """Trace the functions of a computer and name their numbers; fields that no torque depends on are left out.

    Raises InputError for a method that cannot be traced.
    """
    traced = init(computer), step(computer), touchdown(computer)
    n, p, every = computer.robot.n, computer.robot.p, fields_of(computer)
    total = computer.layout.size - 2 * n
    # total: length of x_c; live: indices in x_c of the numbers on which a torque depends
    live = _live(*traced[1:], n, total)
    names = [name for field in every for name in field]  # of the entries of x_c, in its order
    needed = {names[i] for i in live}
    kept = tuple(field for field in every if not needed.isdisjoint(field))
    entries = {name for field in kept for name in field}  # of the kept fields
    # an empty name drops the output
    states = [f"next->{name}" if name in entries else "" for name in names]
    results = [*(f"u[{i}]" for i in range(p)), "*lost"]
    # all three functions return x_c, and step u and lost behind it; _named gives the names in C
    functions = [_named(f, every, n, states + results[: f.out.shape[0] - total]) for f in traced]
    # in the inputs of a function q begins at _HEAD, and v at _HEAD + n
    read = read_by(functions[1].function, 1) | read_by(functions[2].function, 1)
    rates = tuple(i for i in range(n) if _HEAD + n + i in read)
    return Functions(kept, tuple(functions), rates)


def fields_of(computer: Computer) -> tuple[Field, ...]:
    """The fields of x_c in its order; a field of length 0 is left out later."""
    n, p, line = computer.robot.n, computer.robot.p, computer.held.line
    # parts of x: q, v, s, tail. A Field has name, length and words; `double`: also where the others are floats
    s, sensors = computer.layout.parts[2], computer.sensors
    landed = int(isinstance(sensors, Noticed))
    sensed = (
        Field("angle", n, "angles of the sample instant before [rad]", double=True),
        Field("rate", n, "rates from differences, filtered [rad/s]"),
        Field("fresh", 1, "1 where no difference can be taken"),
        Field("landed", landed, "1 between a touchdown and the step after it"),
    )
    # line: torques on their way, one after the other: queue, then waiting (p numbers or none), then acting (p)
    queue = line.place("queue").stop
    return (
        Field("s", s.size, "state of the controller, its observer included"),
        *(() if sensors is None else sensed),
        Field("queue", queue, "torques on their way, the oldest first [N m]"),
        Field("waiting", line.size - queue - p, "torque that acts within this period [N m]"),
        Field("acting", p, "torque that acts on the motors [N m]"),
    )


def _live(step: SymbolicFunction, touchdown: SymbolicFunction, n: int, total: int) -> set[int]:
    """Indices in x_c of the numbers on which a torque or `lost` depends, at this sample instant or a later one.

    n: number of coordinates. total: number of entries of x_c.
    """
    # A number is needed where u or lost reads it, or another number that is needed: the set grows until it
    # stays. What is left are numbers for plots, which would cost memory and time on a small computer.
    live, outputs = set[int](), range(total, step.out.shape[0])
    while True:
        kept = sorted(live)
        # inputs that `step` reads for these entries of x_c, for u and for lost
        read = read_by(step._replace(out=step.out[[*kept, *outputs]]), 1)
        if kept:
            read |= read_by(touchdown._replace(out=touchdown.out[kept]), 1)
        # the inputs are _HEAD numbers, q (n,), v (n,), then x_c
        result = {i - _HEAD - 2 * n for i in read if i >= _HEAD + 2 * n}
        if result <= live:
            return live
        live |= result


def _named(
    function: SymbolicFunction, fields: tuple[Field, ...], n: int, outputs: list[str]
) -> CFunction:
    """Give a function the names in C of its inputs and `outputs`; an output with an empty name is dropped."""
    kept = [i for i, name in enumerate(outputs) if name]
    # t, time of the last sample instant, number and start of the single support come first (_FIRST). True: a
    # double even where the other numbers are floats, since a difference of times or angles needs all digits
    inputs = [
        *(Entry(name, double) for name, double in _FIRST.items()),
        *(Entry(f"m->q[{i}]", True) for i in range(n)),
        *(Entry(f"m->v[{i}]") for i in range(n)),
        *(Entry(f"x->{name}", field.double) for field in fields for name in field),
    ]
    part = function._replace(out=function.out[kept])
    return CFunction(part, inputs, [outputs[i] for i in kept])
