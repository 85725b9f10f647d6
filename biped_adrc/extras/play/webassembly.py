"""The compiled loops and functions of walkers as one WebAssembly module, for a page that needs no server.

The module is made from the same text as the machine code: the loops of `engine.kernels` in LLVM's language, and
the functions of each walker (flow, tick, impact, ..; together its laws) as `engine.ir` writes them. LLVM makes
an object file of it, which a browser loads without a linker.

A run is one block of memory (`engine.kernels.record`), which has the addresses of the walker's functions; a
plan is the block of a run that has not begun. WebAssembly has no addresses of functions: they are called by
their number in a table, from 1 on. So the block has such a number wherever it has an address in machine code.
`web_walkers` gives the names in the order of these numbers, and the constant `called` of the module
puts the functions into the table in the same order. Walkers of the same structure (equal but for the values of
their parameters) share their functions.

The page has to pass to the module, by the name `env`: its memory, the table, the end of the stack, and
functions of mathematics such as `sin` and `pow`. `web_walkers` makes the module, and the block of each walker.
"""

from collections.abc import Mapping, Sequence
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

from llvmlite import binding

from biped_adrc.closed_loop.instant_signals import signals_at
from biped_adrc.core.errors import InputError
from biped_adrc.engine.kernels.compiled_run import CompiledRun
from biped_adrc.engine.kernels.load import loops
from biped_adrc.engine.kernels.record import FUNCTIONS, PART, PLACES
from biped_adrc.engine.machine import Code, from_disk, hash_of, object_code, parsed
from biped_adrc.engine.program import CompiledWalker, push_code


class WebWalker(NamedTuple):
    """One walker in the module."""

    plan: CompiledRun
    """Its block of memory before a run, with numbers of functions in place of addresses."""
    observe: int
    """Number in the table of the function that computes its signals (`closed_loop.instant_signals`)."""


def web_walkers(
    walkers: Sequence[CompiledWalker],
) -> tuple[bytes, tuple[str, ...], list[WebWalker]]:
    """Make one module for several compiled walkers on one gait: its bytes, the names of its functions in the
    order of their numbers, from 1 on, and the walkers that run in it.

    The first functions are those of _LOOPS, then come the walkers'. Each walker has to be compiled with a
    reference, from which its signals take the error. Raises InputError for a walker with the exponential
    method, whose product with matrices is no function of this form.
    """
    # names: text of functions -> its name; numbers: function -> its number, the first ones being the loops'
    # _LOOPS: the kernels' functions, which have the first numbers
    laws = _Laws({}, {name: k for k, name in enumerate(_LOOPS, 1)})
    modules = [_walker(one, laws) for one in walkers]
    code = web_module({name: text for text, name in laws.names.items()}, tuple(laws.numbers))
    return code, tuple(laws.numbers), modules


class _Laws(NamedTuple):
    """The functions of walkers that the module has so far, collected walker after walker."""

    names: dict[str, str]
    """Text in LLVM's language with functions of a walker -> the name under which the module has it."""
    numbers: dict[str, int]
    """Name of a function that is called by its number -> the number, from 1."""

    def of(self, code: Code) -> str:
        """Name of the text of these functions; the first call makes a new one."""
        return self.names.setdefault(code.text, f"laws{len(self.names)}")

    def number(self, name: str) -> int:
        """Number of the function `name` in the table, from 1; the first call gives it the next one."""
        return self.numbers.setdefault(name, 1 + len(self.numbers))


def _walker(one: CompiledWalker, laws: _Laws) -> WebWalker:
    """The `WebWalker` of one compiled walker, whose functions are added to `laws`.

    Raises InputError for the exponential method.
    """
    program = one.program
    if program.numbers.split is not None:
        raise InputError("an offline page takes the steps of RK4; leave out the exponential method")
    # names of two texts: flow, tick, impact, .. of the walker; and the function "reading" that computes all its
    # signals at one instant, which the page calls to show them
    own = laws.of(program.machine)
    signals = laws.of(program.reading(signals_at))
    # a copy, in which vectors have distances from the start in place of addresses
    cells = one.plan.block
    # FUNCTIONS: fields with addresses of functions; PLACES: field -> cell. The address of a function becomes
    # its number; 0 stays for a function that this walker does not have
    for name in FUNCTIONS:
        at = PLACES[name]
        cells[at] = laws.number(f"{own}.{name}") if cells[at] else 0
    # each term of the disturbance has PART cells in the table `parts`: its function, then a size that stays
    terms = one.walker.disturbance.terms if one.walker.disturbance else ()
    for k, term in enumerate(terms):
        push = laws.of(push_code(term, one.walker.plant.n))
        cells[one.plan.place("parts") + PART * k] = laws.number(f"{push}.push")
    return WebWalker(CompiledRun(cells, one.plan.pointers), laws.number(f"{signals}.reading"))


TARGET = "wasm32-unknown-unknown"
"""LLVM's name of what a browser runs."""
_LOOPS = ("go_on", "land", "look")
"""Functions of the kernels that a page calls."""


def web_module(laws: Mapping[str, str], called: Sequence[str] = _LOOPS) -> bytes:
    """Compile the loops and the functions of walkers to WebAssembly; returns the bytes, which are cached on
    disk.

    laws: name -> text in LLVM's language. called: names of the functions with numbers, in their order; function
    `f` of the text `name` is called `name.f`.
    """
    # the cache's key has the text of this file, so that a change here compiles anew
    own = Path(__file__).read_text(encoding="utf-8")
    key = hash_of(TARGET, loops(), own, *called, *chain(*laws.items()))
    return from_disk(key, lambda: _linked(laws, called))


def _linked(laws: Mapping[str, str], called: Sequence[str]) -> bytes:
    """Link the loops and the laws into one module of WebAssembly; returns its bytes.

    laws: name -> text in LLVM's language, of whose functions `f` becomes `name.f`. called: names of the
    functions with numbers, in their order.
    """
    binding.initialize_all_targets()
    binding.initialize_all_asmprinters()
    # opt=0: the browser optimises what it runs, so code of LLVM's level 3 runs no quicker there
    machine = binding.Target.from_triple(TARGET).create_target_machine(opt=0)
    module = parsed(loops(), machine)
    for name, text in laws.items():
        modules = parsed(text, machine)
        for function in _defined(modules):
            function.name = f"{name}.{function.name}"
        module.link_in(modules)
    for function in _defined(module):
        if function.name not in called:  # then LLVM may inline it, or leave it out
            function.linkage = "internal"
    # the constant `called`: the table of functions by number, as the page needs it
    names = ", ".join(f'ptr @"{name}"' for name in called)
    table = f"@called = constant [{len(called)} x ptr] [{names}]"
    heads = (f'declare void @"{name}"()' for name in called)
    module.link_in(parsed("\n".join((table, *heads)), machine))
    return object_code(module, machine)


def _defined(module: Any) -> list[Any]:
    """The functions that a module defines, without those that it only declares."""
    return [function for function in module.functions if not function.is_declaration]
