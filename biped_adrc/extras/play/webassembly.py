"""The compiled loops and the functions of walkers as one WebAssembly module, for a page that needs no server.

It is made from the same text as the machine code: the loops of `engine.kernels` as numba gives them to LLVM,
and the functions as `engine.ir` writes them. LLVM makes an object file, whose functions call each other by
their numbers already; what it lacks to be a module that a browser starts are the names of those that are
called from outside, which `_with_exports` adds.

What the module does not have it imports from `env`: its memory, the table of the functions that the loops call
by address (their number in that table), the stack's end, and `sin`, `pow` and the like.

`web_walkers` makes it, and the numbers of each walker. In place of an address a block has a function's number
in `WebWalkers.functions`, from 1 on. Walkers of the same structure share their functions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import replace
from functools import partial
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

from llvmlite import binding

from biped_adrc.core.errors import InputError
from biped_adrc.engine.compiled_push import term_text
from biped_adrc.engine.compiled_signals import SignalNumbers, observe
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.ir import module_text
from biped_adrc.engine.kernels.load import loops
from biped_adrc.engine.kernels.record import PART, PLACES
from biped_adrc.engine.kernels.run_plan import Functions, RunPlan
from biped_adrc.engine.machine import keep, key_of, stored
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
    modules = [_walker(one, reference, laws) for one in walkers]
    return WebWalkers(web_module(laws.texts), tuple(laws.functions), tuple(modules))


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

    own = laws.of(program.address("flow"), program.text)
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


TARGET = "wasm32-unknown-unknown"
"""LLVM's name of what a browser runs."""
LOOPS = ("go_on", "land", "look")
"""The units of the kernels that a page calls."""
CUSTOM, EXPORTS, LATER = 0, 7, (9, 10, 11, 12)
"""Sections of WebAssembly: those of the linker, the names of functions, and those that stand behind it."""
SYMBOLS, FUNCTION, DATA, SECTION, UNDEFINED, NAMED = 8, 0, 1, 3, 0x10, 0x40
"""In the linker's section: its table of symbols, the kinds of these that are read, and their flags."""


def web_module(laws: Mapping[str, str]) -> bytes:
    """The loops and these functions as WebAssembly; those of a walker are text for LLVM, by a name for them.

    A page finds the functions of LOOPS by their names, and function `f` of the text `name` as `name.f`. The
    module is kept on the disk.
    """
    own = Path(__file__).read_text(encoding="utf-8")
    key = key_of("\0".join((TARGET, loops(), own, *chain(*laws.items()))))
    code = stored(key)
    if code is None:
        code = _linked(laws)
        keep(key, code)
    return code


def _linked(laws: Mapping[str, str]) -> bytes:
    """Link the laws, by name, and the loops into one module of WebAssembly."""
    binding.initialize_all_targets()
    binding.initialize_all_asmprinters()
    machine = binding.Target.from_triple(TARGET).create_target_machine(opt=3)
    module = _parsed(loops(), machine)
    called = {*LOOPS}
    for name, text in laws.items():
        modules = _parsed(text, machine)
        for function in _defined(modules):
            function.name = f"{name}.{function.name}"
            called.add(function.name)
        module.link_in(modules)
    for function in _defined(module):
        if function.name not in called:
            function.linkage = "internal"
    module.verify()
    tuning = binding.create_pipeline_tuning_options(speed_level=3)
    builder = binding.create_pass_builder(machine, tuning)
    builder.getModulePassManager().run(module, builder)
    return _with_exports(machine.emit_object(module), called)


def _parsed(text: str, machine: Any) -> Any:
    """A module for this machine."""
    module = binding.parse_assembly(text)
    module.triple, module.data_layout = TARGET, str(machine.target_data)
    return module


def _defined(module: Any) -> list[Any]:
    """The functions that a module has, not only names."""
    return [function for function in module.functions if not function.is_declaration]


def _with_exports(code: bytes, called: Set[str]) -> bytes:
    """An object file with the names of these functions, and without what is only for a linker."""
    head, sections = code[:8], list(_sections(code))
    linking = next(body for kind, body in sections if kind == CUSTOM and _named(body) == "linking")
    places = {name: k for name, k in _functions(linking) if name in called}
    names = b"".join(_text(name) + bytes([FUNCTION]) + _number(k) for name, k in places.items())
    kept = [(kind, body) for kind, body in sections if kind != CUSTOM]
    exports = (EXPORTS, _number(len(places)) + names)
    before = [part for part in kept if part[0] not in LATER]
    after = [part for part in kept if part[0] in LATER]
    return head + b"".join(
        bytes([kind]) + _number(len(body)) + body for kind, body in (*before, exports, *after)
    )


def _sections(code: bytes) -> Iterator[tuple[int, bytes]]:
    """(kind, body) of each section behind the eight bytes of the head."""
    at = 8
    while at < len(code):
        kind, (size, begin) = code[at], _read(code, at + 1)
        at = begin + size
        yield kind, code[begin:at]


def _functions(linking: bytes) -> Iterator[tuple[str, int]]:
    """(name, number) of each function in the linker's table of symbols."""
    at = 1 + len("linking") + 1  # and the version
    while linking[at] != SYMBOLS:
        size, begin = _read(linking, at + 1)
        at = begin + size
    _, at = _read(linking, at + 1)
    count, at = _read(linking, at)
    for _ in range(count):
        kind = linking[at]
        flags, at = _read(linking, at + 1)
        number, name = 0, ""
        if kind != DATA:
            number, at = _read(linking, at)
        if kind != SECTION and (kind == DATA or not flags & UNDEFINED or flags & NAMED):
            size, at = _read(linking, at)
            name, at = linking[at : at + size].decode(), at + size
        if kind == DATA and not flags & UNDEFINED:
            for _ in range(3):  # where it is
                _, at = _read(linking, at)
        if kind == FUNCTION:
            yield name, number


def _named(body: bytes) -> str:
    """The name of a section of the linker."""
    size, at = _read(body, 0)
    return body[at : at + size].decode()


def _text(name: str) -> bytes:
    """A name as WebAssembly has it."""
    return _number(len(name.encode())) + name.encode()


def _number(k: int) -> bytes:
    """A whole number as WebAssembly has it (LEB128)."""
    out = bytearray()
    while True:
        out.append(k & 0x7F | (0x80 if k > 0x7F else 0))
        k >>= 7
        if not k:
            return bytes(out)


def _read(data: bytes, at: int) -> tuple[int, int]:
    """The number at a place, and the place behind it."""
    k = shift = 0
    while True:
        byte = data[at]
        k, shift, at = k | (byte & 0x7F) << shift, shift + 7, at + 1
        if byte < 0x80:
            return k, at
