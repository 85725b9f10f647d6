"""The march of a walk through time (`hybrid.march`) and what is around it, as compiled functions to call.

Their text for LLVM lies beside this file, as `kernels.write` has it from numba, and is compiled for the
processor once. It says from which sources it was written. Where these have changed it is written anew by numba,
and kept on disk. The page that walks in a browser is made from the same text (`extras.play.webassembly`).
"""

from __future__ import annotations

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
from biped_adrc.engine.machine import LOCK, fetch, hash_of, load_or_compile, store

_HERE = "biped_adrc.engine.kernels"
FILES = (
    "biped_adrc.hybrid.constants",
    f"{_HERE}.record",
    f"{_HERE}.call",
    f"{_HERE}.operations",
    "biped_adrc.hybrid.relaxation",
    "biped_adrc.hybrid.march",
    f"{_HERE}.arc",
)
"""The modules of the march, in the order in which they need each other."""
WRITER = f"{_HERE}.write"
"""The module that writes their text."""


def kernels() -> Any:
    """The functions of the compiled march that Python calls, by name: `stride`, `samples` and `looks`."""
    return compiled(FILES, stride=3, samples=7, looks=5)


def compiled(files: tuple[str, ...], **arguments: int) -> Any:
    """The units of modules, by name. Other threads of Python run while one is called. The first call loads
    them, or compiles them where they are not on disk.

    arguments: of each unit that Python calls, how many whole numbers and addresses it takes.
    """
    if files not in _PROGRAMS:  # `functools.cache` would let two threads load at once
        with LOCK:
            _PROGRAMS[files] = _PROGRAMS.get(files) or _loaded(files, arguments)
    return _PROGRAMS[files]


_PROGRAMS: dict[tuple[str, ...], SimpleNamespace] = {}
"""Units in memory, by the modules that have them."""


def _loaded(files: tuple[str, ...], arguments: Mapping[str, int]) -> SimpleNamespace:
    """Load the units of modules as functions that Python can call; `arguments` as in `compiled`."""
    at = load_or_compile(loops(files), [*arguments]).addresses
    calls = {x: CFUNCTYPE(c_int64, *[c_void_p] * size)(at[x]) for x, size in arguments.items()}
    return SimpleNamespace(**calls)


@cache
def loops(files: tuple[str, ...] = FILES) -> str:
    """The text for LLVM of all units, each under its own name: that of the package, or written anew where it
    does not fit the sources. Raises ModelError where numba is needed for that and is not there.
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
    key = hash_of(sources((*files, WRITER)), version("numba"))
    code = fetch(key)
    if code is None:
        code = written(files).encode()
        store(key, code)
    return code.decode()


def text_file(files: tuple[str, ...]) -> Path:
    """The file with the text of these modules."""
    return Path(__file__).with_name(f"{files[-1].rpartition('.')[2]}.ll")


def head(files: tuple[str, ...], text: str) -> str:
    """First line of that file: the checksums of the sources and of the text below it."""
    each = (hashlib.sha256(x.encode()).hexdigest()[:32] for x in (sources((*files, WRITER)), text))
    return f"; sources {next(each)}, text {next(each)}"
