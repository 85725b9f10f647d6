"""Where the numbers x_c of a robot's computer lie in the struct of the C, field by field.

Numbers that no function reads, such as a torque that nothing depends on, have no place.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import casadi as ca

from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.engine.ir import straight_line
from biped_adrc.extras.export.c_text import CFunction, Entry
from biped_adrc.extras.export.computer import Computer
from biped_adrc.extras.export.functions import HEAD, init, step, touchdown


@dataclass(frozen=True)
class Field:
    """An array of the struct: its name, length, what is in it, and whether it is of doubles always."""

    name: str
    size: int
    words: str
    double: bool = False

    def __iter__(self) -> Iterator[str]:
        """Names of its entries."""
        return iter(f"{self.name}[{i}]" for i in range(self.size))


@dataclass(frozen=True)
class Functions:
    """The functions of a computer with the names that their numbers have in C."""

    fields: tuple[Field, ...]
    """Of the struct, those of x_c."""
    init: CFunction
    step: CFunction
    touchdown: CFunction
    rates: tuple[int, ...]
    """Numbers of the rates that `step` or `touchdown` read; `init` reads all."""

    @property
    def all(self) -> tuple[CFunction, CFunction, CFunction]:
        """All three."""
        return self.init, self.step, self.touchdown


def functions(computer: Computer) -> Functions:
    """Traces the functions of a computer. Raises InputError for a method that cannot be traced."""
    sizes = computer.held.sizes
    first = init(computer)
    size = first.out.shape[0] - sizes.total
    traced = first, step(computer, size), touchdown(computer, size)
    n, every = sizes.n, fields_of(computer, size)
    total = size + sizes.total
    live = _live(*traced[1:], n, total)
    kept, at = list[Field](), 0
    for field in every:
        if any(i in live for i in range(at, at + field.size)):
            kept.append(field)
        at += field.size
    left = {name for field in kept for name in field}
    states = [f"next->{name}" if name in left else "" for field in every for name in field]
    results = [*(f"u[{i}]" for i in range(sizes.p)), "*lost"]
    functions = [_named(f, every, n, states + results[: f.out.shape[0] - total]) for f in traced]
    read = _read(functions[1].function) | _read(functions[2].function)
    rates = tuple(i for i in range(n) if HEAD + n + i in read)
    return Functions(tuple(kept), functions[0], functions[1], functions[2], rates)


def fields_of(computer: Computer, size: int) -> tuple[Field, ...]:
    """The fields of x_c in its order, for a controller with `size` numbers in s."""
    k = computer.held.sizes
    sensed = (
        Field("angle", k.n, "angles of the sample instant before [rad]", double=True),
        Field("rate", k.n, "rates from differences, filtered [rad/s]"),
        Field("fresh", 1, "1 where no difference can be taken"),
        Field("landed", k.sensors - 2 * k.n - 1, "1 between a touchdown and the step after it"),
    )
    return (
        Field("s", size, "state of the controller, its observer included"),
        *(sensed if k.sensors > 0 else ()),
        Field("queue", k.queue * k.p, "torques on their way, the oldest first [N m]"),
        Field("waiting", k.waiting * k.p, "torque that acts within this period [N m]"),
        Field("acting", k.p, "torque that acts on the motors [N m]"),
    )


def _live(step: SymbolicFunction, touchdown: SymbolicFunction, n: int, total: int) -> set[int]:
    """Places in x_c of the numbers that any torque, now or later, depends on."""
    live, outputs = set[int](), range(total, step.out.shape[0])
    while True:
        kept = sorted(live)
        read = _read(step._replace(out=step.out[[*kept, *outputs]]))
        if kept:
            read |= _read(touchdown._replace(out=touchdown.out[kept]))
        result = {i - HEAD - 2 * n for i in read if i >= HEAD + 2 * n}
        if result <= live:
            return live
        live |= result


def _read(function: SymbolicFunction) -> set[int]:
    """Places of the inputs that a function reads."""
    f = straight_line(function)
    inputs = (i for i in range(f.n_instructions()) if f.instruction_id(i) == ca.OP_INPUT)
    return {at[1] for at in map(f.instruction_input, inputs) if at[0] == 1}


def _named(
    function: SymbolicFunction, fields: tuple[Field, ...], n: int, outputs: list[str]
) -> CFunction:
    """A function with its inputs by their names in C; an output without a name is dropped."""
    kept = [i for i, name in enumerate(outputs) if name]
    inputs = [
        *(
            Entry("m->t", True),
            Entry("x->last", True),
            Entry("next->step"),
            Entry("next->start", True),
        ),
        *(Entry(f"m->q[{i}]", True) for i in range(n)),
        *(Entry(f"m->v[{i}]") for i in range(n)),
        *(Entry(f"x->{name}", field.double) for field in fields for name in field),
    ]
    part = function._replace(out=function.out[kept])
    return CFunction(part, inputs, [outputs[i] for i in kept])
