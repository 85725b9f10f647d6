"""Walkers as one WebAssembly module, and the numbers of each: what a page needs to walk them without a server.

The functions are those of `engine.program` and `engine.compiled_signals`; in place of an address a block has a
function's number in `WebWalkers.functions`, from 1 on. Walkers of the same structure share their functions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

from biped_adrc.engine.compiled_signals import SignalNumbers, observe
from biped_adrc.engine.compiled_walker import CompiledWalker, term_text
from biped_adrc.engine.ir import module_text
from biped_adrc.engine.kernels.record import PART, PLACES
from biped_adrc.engine.kernels.run_plan import Functions, RunPlan
from biped_adrc.engine.webassembly import web_module
from biped_adrc.errors import InputError
from biped_adrc.gait.reference import Reference


class WebWalker(NamedTuple):
    """The numbers of one walker."""

    plan: RunPlan
    """With numbers of functions in place of addresses."""
    observe: int
    """Number of the function that says its signals (`closed_loop.instant_signals`)."""


class WebWalkers(NamedTuple):
    """Walkers for a page."""

    code: bytes
    """The module."""
    functions: tuple[str, ...]
    """Names in the module of those that are called by their number, from 1 on."""
    walkers: tuple[WebWalker, ...]


def web_walkers(walkers: Sequence[CompiledWalker], reference: Reference) -> WebWalkers:
    """One module for walkers on one gait, made with the reference to which their signals refer.

    Raises InputError for the exponential method, whose product with matrices has another form.
    """
    laws = _Laws({}, {}, [])
    made = [_walker(one, reference, laws) for one in walkers]
    return WebWalkers(web_module(laws.texts), tuple(laws.functions), tuple(made))


class _Laws(NamedTuple):
    """What the walkers share, filled by one after the other."""

    texts: dict[str, str]
    """Functions of walkers in LLVM's language, by a name for them."""
    names: dict[int, str]
    """That name by the address of one of the functions here; by minus that, of what reads its signals."""
    functions: list[str]
    """Names of those that are called by their number."""

    def of(self, address: int, text: Callable[[], str]) -> str:
        """The name of the text to which a function belongs; it is made where it is not there yet."""
        if address not in self.names:
            self.names[address] = f"laws{len(self.names)}"
            self.texts[self.names[address]] = text()
        return self.names[address]

    def number(self, name: str) -> int:
        """The number of a function, a new one where it has none yet."""
        if name not in self.functions:
            self.functions.append(name)
        return 1 + self.functions.index(name)


def _walker(one: CompiledWalker, reference: Reference, laws: _Laws) -> WebWalker:
    """The numbers of one walker, whose functions join those of the others. Raises InputError."""
    program = one.program
    if program.numbers.split is not None:
        raise InputError("an offline page takes the steps of RK4; leave out the exponential method")
    signals = SignalNumbers(program.numbers, reference)

    own = laws.of(program.address("flow"), lambda: program.machine.text)
    seen = laws.of(
        -program.address("flow"), lambda: module_text({"observe": observe(program.make, signals)})
    )
    cells = one.plan.cells.copy()
    for name in Functions._fields:
        at = PLACES[name]
        cells[at] = laws.number(f"{own}.{name}") if cells[at] else 0
    terms = one.walker.disturbance.terms if one.walker.disturbance else ()
    for k, term in enumerate(terms):
        part = cells[one.plan.places["parts"] + PART * k :][:PART]
        push = laws.of(int(part[0]), partial(term_text, term, one.walker.plant.n))
        part[0] = laws.number(f"{push}.torque")
        part[2] = laws.number(f"{push}.resultant") if part[2] else 0
    return WebWalker(replace(one.plan, cells=cells), laws.number(f"{seen}.observe"))
