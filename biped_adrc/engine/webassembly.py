"""The compiled loops and the functions of walkers as one WebAssembly module, for a page that needs no server.

It is made from the same text as the machine code: the loops of `engine.kernels` as numba gives them to LLVM,
and the functions as `engine.ir` writes them. LLVM makes an object file, whose functions call each other by
their numbers already; what it lacks to be a module that a browser starts are the names of those that are
called from outside, which `_with_exports` adds.

What the module does not have it imports from `env`: its memory, the table of the functions that the loops call
by address (their number in that table), the stack's end, and `sin`, `pow` and the like.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Set
from functools import cache
from itertools import chain
from pathlib import Path
from typing import Any

from llvmlite import binding

from biped_adrc.engine.kernels.load import kernels, source
from biped_adrc.engine.machine import keep, key_of, stored

TARGET = "wasm32-unknown-unknown"
"""LLVM's name of what a browser runs."""
LOOPS = ("go_on", "land", "look")
"""The units of the kernels that a page calls."""
ERRORS = re.compile(
    r'^declare (.*?@"?(?:Py|NRT_|numba_(?!nextafter))[^"(]*"?\(.*?\)).*$', re.MULTILINE
)
"""What numba calls where Python would raise an error, which the loops never do."""
CUSTOM, EXPORTS, LATER = 0, 7, (9, 10, 11, 12)
"""Sections of WebAssembly: those of the linker, the names of functions, and those that stand behind it."""
SYMBOLS, FUNCTION, DATA, SECTION, UNDEFINED, NAMED = 8, 0, 1, 3, 0x10, 0x40
"""In the linker's section: its table of symbols, the kinds of these that are read, and their flags."""


def web_module(laws: Mapping[str, str]) -> bytes:
    """The loops and these functions as WebAssembly; those of a walker are text for LLVM, by a name for them.

    A page finds the functions of LOOPS by their names, and function `f` of the text `name` as `name.f`. The
    module is kept on the disk.
    """
    key = key_of("\0".join((TARGET, _loops(), _own_text(), *chain(*laws.items()))))
    code = stored(key)
    if code is None:
        code = _linked(laws)
        keep(key, code)
    return code


def _linked(laws: Mapping[str, str]) -> bytes:
    """As `web_module`, made anew."""
    binding.initialize_all_targets()
    binding.initialize_all_asmprinters()
    machine = binding.Target.from_triple(TARGET).create_target_machine(opt=3)
    module = _parsed(_loops(), machine)
    called = {*LOOPS}
    for name, text in laws.items():
        made = _parsed(text, machine)
        for function in _defined(made):
            function.name = f"{name}.{function.name}"
            called.add(function.name)
        module.link_in(made)
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


@cache
def _loops() -> str:
    """All units of the kernels in one text for LLVM, from the disk where it is there."""
    key = key_of(f"{TARGET}\0{source()}\0{_own_text()}")
    kept = stored(key)
    text = kept.decode() if kept is not None else _written_loops()
    if kept is None:
        keep(key, text.encode())
    return text


def _own_text() -> str:
    """The text of this file, which decides what it makes."""
    return Path(__file__).read_text(encoding="utf-8")


def _written_loops() -> str:
    """As `_loops`, each unit under its own name; errors of Python end the module.

    numba compiles them once more, since what it keeps on the disk is for this processor.
    """
    from numba import cfunc

    made = {
        symbol: cfunc(signature, error_model="numpy")(function)
        for symbol, (signature, function) in kernels().UNITS.items()
    }
    module: Any = None
    for one in made.values():
        text = re.sub(r"^target .*$", "", one.inspect_llvm(), flags=re.MULTILINE)
        for symbol, compiled in made.items():
            names = "|".join(map(re.escape, (compiled.native_name, symbol)))
            text = re.sub(rf'@"?(?:{names})"?\(', f"@{symbol.rpartition('.')[2]}(", text)
        part = binding.parse_assembly(text.replace(" = common ", " = weak "))
        if module is None:
            module = part
        else:
            module.link_in(part)
    text = ERRORS.sub(r"define \1 { call void @llvm.trap() unreachable }", str(module))
    return f"{text}\ndeclare void @llvm.trap()\n"


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
