"""The march of a walk through time (`hybrid.march`) and what is around it, as compiled functions to call.

They are called units (`kernels.call.unit`). Their text for LLVM lies beside this file, as numba has written it
(`kernels.write`), and is compiled for the processor once. Its first line has the checksum of the sources from
which it was written. Where these have changed, numba writes it anew, and it is kept in the user's cache. The
page that walks in a browser is made from the same text (`extras.play.webassembly`).
"""

import hashlib
from collections.abc import Mapping
from contextlib import suppress
from ctypes import CFUNCTYPE, c_int64, c_void_p
from functools import cache
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from biped_adrc.core.errors import ModelError
from biped_adrc.engine.kernels.write import sources, written
from biped_adrc.engine.machine import LOCK, from_disk, hash_of, load_or_compile

_HERE = "biped_adrc.engine.kernels"
FILES = (
    "biped_adrc.hybrid.constants",
    f"{_HERE}.record",
    f"{_HERE}.call",
    f"{_HERE}.operations",
    "biped_adrc.hybrid.relaxation",
    "biped_adrc.hybrid.march",
    f"{_HERE}.arc",
    f"{_HERE}.lanes",
)
"""The modules of the march, in an order in which each one comes after those that it needs."""
WRITER = f"{_HERE}.write"
"""The module that writes their text, which depends on it, too."""


def kernels() -> Any:
    """The functions of the compiled march that Python calls, by name."""
    # numbers of their arguments
    return compiled(FILES, stride=1, samples=8, looks=5, side_by_side=4)


def compiled(files: tuple[str, ...], **arguments: int) -> Any:
    """The units of these modules that Python calls, as attributes; the first call loads or compiles them.

    arguments: name of each of these units -> how many arguments it takes, whole numbers and addresses alone.
    While a unit runs, other threads of Python run too.
    """
    if files not in _PROGRAMS:  # `functools.cache` would let two threads load at once
        with LOCK:
            _PROGRAMS[files] = _PROGRAMS.get(files) or _loaded(files, arguments)
    return _PROGRAMS[files]


_PROGRAMS: dict[tuple[str, ...], SimpleNamespace] = {}
"""Names of modules -> their units in memory, as `compiled` returns them."""


def _loaded(files: tuple[str, ...], arguments: Mapping[str, int]) -> SimpleNamespace:
    """Load the units of the modules `files`, compiled if need be, as functions of ctypes; arguments: name of
    each unit that Python calls -> how many arguments it takes.
    """
    # `loops` is their text for LLVM, `at` the address of each unit
    at = load_or_compile(loops(files), [*arguments])
    calls = {x: CFUNCTYPE(c_int64, *[c_void_p] * size)(at[x]) for x, size in arguments.items()}
    return SimpleNamespace(**calls)


@cache
def loops(files: tuple[str, ...] = FILES) -> str:
    """The text for LLVM of all units of these modules: the file of the package, or, where that does not fit the
    sources, one that numba has written for them. Raises ModelError where numba is needed and is not installed.
    """
    with suppress(OSError, UnicodeError):
        first, _, text = text_file(files).read_text(encoding="utf-8").partition("\n")
        if first == head(files, text):
            return text
    if find_spec("numba") is None:
        raise ModelError(
            f"{text_file(files)} is damaged or does not fit the sources beside it, and numba, which writes it "
            "anew, is not installed; reinstall biped-adrc, or run pip install numba"
        )
    # WRITER: the module that writes the text
    key = hash_of(sources((*files, WRITER)), version("numba"))
    return from_disk(key, lambda: written(files).encode()).decode()


def text_file(files: tuple[str, ...]) -> Path:
    """The package's file with the text for LLVM of these modules: it has the name of the last one."""
    return Path(__file__).with_name(f"{files[-1].rpartition('.')[2]}.ll")


def head(files: tuple[str, ...], text: str) -> str:
    """The first line of `text_file(files)`: checksums of the sources of these modules, and of the text below
    it."""
    each = (hashlib.sha256(x.encode()).hexdigest()[:32] for x in (sources((*files, WRITER)), text))
    return f"; sources {next(each)}, text {next(each)}"
