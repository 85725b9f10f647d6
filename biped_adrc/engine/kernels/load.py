"""The kernels as one module on disk, so that its machine code is kept under the hash of all of its text.

numba's own cache looks at one file at a time and would not notice that a kernel in another file has
changed. So the files of FILES are joined into one text, without their imports of each other,
written to the cache folder by `engine.machine`, and imported from there. Read the files as one
module; in the editor and for type checks they are ordinary ones.
"""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path
from threading import Lock
from types import ModuleType

from numba.core import config

from biped_adrc.engine.machine import load_source, note_checksums
from biped_adrc.errors import ModelError

_HERE = "biped_adrc.engine.kernels"
FILES = (
    f"{_HERE}.record",
    f"{_HERE}.call",
    "biped_adrc.hybrid.constants",
    f"{_HERE}.operations",
    "biped_adrc.hybrid.relaxation",
    "biped_adrc.hybrid.march",
    f"{_HERE}.arc",
    f"{_HERE}.samples",
)
"""Their modules, in the order in which they need each other."""
_LEFT_OUT = (*FILES, "biped_adrc.hybrid.on_arrays")
"""Imports that are left out: what is there, and the march's operations of Python."""


_LOCK = Lock()


def kernels() -> ModuleType:
    """The compiled module, with `arc`, `strike`, `stride`; made by the first thread that asks."""
    with _LOCK:
        return _compiled(False)


def step_kernels() -> ModuleType:
    """The same module with `samples` and `looks` too."""
    with _LOCK:
        return _compiled(True)


@cache
def _compiled(for_steppers: bool) -> ModuleType:
    """The module with its code for all, or with that for steppers too."""
    if getattr(config, "DISABLE_JIT", 0):
        raise ModelError("NUMBA_DISABLE_JIT is set, so nothing can be compiled; unset it")
    module = _compiled(False) if for_steppers else load_source(source())
    module.compile_those(lambda name: (name in module.FOR_STEPPERS) == for_steppers)
    note_checksums(module)
    return module


def source() -> str:
    """The text of all kernels, their imports of each other left out."""
    root = Path(__file__).parents[3]
    paths = (root / f"{name.replace('.', '/')}.py" for name in FILES)
    texts = [_alone(path.read_text(encoding="utf-8")) for path in paths]
    return "\n\n".join(['"""Compiled loops."""', "from __future__ import annotations", *texts])


def _alone(text: str) -> str:
    """A file's text with imports from this package's kernels and from __future__ blanked; line numbers stay."""
    lines = text.splitlines()
    for statement in ast.parse(text).body:
        if isinstance(statement, ast.ImportFrom) and (
            statement.module == "__future__" or statement.module in _LEFT_OUT
        ):
            for i in range(statement.lineno - 1, statement.end_lineno or statement.lineno):
                lines[i] = ""
    return "\n".join(lines)
