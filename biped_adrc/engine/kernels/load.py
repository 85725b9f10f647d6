"""The march of a walk through time (`hybrid.march`) and what is around it, as compiled functions to call.

numba translates modules, those in FILES or others, into LLVM's text once. It is kept on disk, and is used
again until one of them changes.

The sources are joined into one text of Python, without their imports of each other. The reason is
`hybrid.march`: it calls operations such as `flow` and `add` by name. In Python they are those of
`hybrid.on_arrays`, which it imports; in the joined text the same names are those of `kernels.operations`, which
FILES has in place of it. In the editor and for type checks the files are ordinary modules.

Where LLVM's text is on disk, numba is not imported. The page that walks in a browser is made from the same text
(`extras.play.webassembly`).
"""

from __future__ import annotations

import ast
import re
import sys
from ctypes import CFUNCTYPE, c_int64, c_void_p
from functools import cache
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

from llvmlite import binding

from biped_adrc.core.errors import ModelError
from biped_adrc.engine.machine import LOCK, keep, key_of, load_or_compile, stored

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
ERRORS = re.compile(r'^declare (.*?@"?(?:Py|NRT_|numba_)[^"(]*"?\(.*?\)).*$', re.MULTILINE)
"""What numba calls where Python would raise an error, which the loops never do."""


def kernels() -> Any:
    """The functions of the compiled march that Python calls, by name: `stride`, `samples` and `looks`."""
    return compiled(FILES, stride=3, samples=7, looks=5)


@cache
def compiled(files: tuple[str, ...], **arguments: int) -> SimpleNamespace:
    """The units of modules, by name. Other threads of Python run while one is called. The first call loads
    them, or compiles them where they are not on disk.

    arguments: of each unit that Python calls, how many whole numbers and addresses it takes.
    """
    with LOCK:
        at = load_or_compile(loops(files), [*arguments]).addresses
    calls = {x: CFUNCTYPE(c_int64, *[c_void_p] * size)(at[x]) for x, size in arguments.items()}
    return SimpleNamespace(**calls)


def loops(files: tuple[str, ...] = FILES) -> str:
    """The text for LLVM of all units, each under its own name: read from the disk, or made by numba and kept
    there.
    """
    root = Path(__file__).parents[3]
    paths = [*(root / f"{name.replace('.', '/')}.py" for name in files), Path(__file__)]
    *texts, own = [path.read_text(encoding="utf-8") for path in paths]
    text = "\n".join(texts)
    key = key_of(f"{text}\0{own}")
    code = stored(key)
    if code is None:
        code = _written(source(text, files)).encode()
        keep(key, code)
    return code.decode()


def source(text: str, files: tuple[str, ...]) -> str:
    """The text of files, one after the other, without their imports of each other and of the march's operations
    of Python.
    """
    # `from hybrid.on_arrays import *`, if it stayed, would put Python's operations in place of the compiled
    # ones of the same names. `__future__` has to stand first, where it is put back.
    left_out = ("__future__", *files, "biped_adrc.hybrid.on_arrays")
    statements = [
        statement
        for statement in ast.parse(text).body
        if not (isinstance(statement, ast.ImportFrom) and statement.module in left_out)
    ]
    return "from __future__ import annotations\n" + ast.unparse(ast.Module(statements, []))


def _written(text: str) -> str:
    """LLVM's text of all units of a module; errors of Python end the process."""
    from numba import cfunc, config

    if getattr(config, "DISABLE_JIT", 0):
        raise ModelError("NUMBA_DISABLE_JIT is set, so nothing can be compiled; unset it")
    module = ModuleType("biped_adrc_kernels")
    sys.modules[module.__name__] = module  # where numba looks for what a unit names
    # executed and not imported: the joined text is no file, and its imports of each other are gone
    exec(compile(text, module.__name__, "exec"), vars(module))
    names, linked = dict[str, str](), None
    for name, (symbol, signature, function) in module.UNITS.items():
        callback: Any = cfunc(signature, error_model="numpy")(function)
        # while it compiles a unit that calls this one, numba links it, by this name
        binding.add_symbol(symbol, callback.address)
        names |= {symbol: name, callback.native_name: name}
        # without numba's target the text serves this processor and WebAssembly alike
        part = re.sub(r"^target .*$", "", callback.inspect_llvm(), flags=re.MULTILINE)
        # numba's names count the functions of a process; another process finds a unit by its own name
        for theirs, ours in names.items():
            part = re.sub(rf'@"?{re.escape(theirs)}"?\(', f"@{ours}(", part)
        # numba's variables are `common`, a kind that LLVM has not for WebAssembly; `weak` ones may be linked
        # too
        one = binding.parse_assembly(part.replace(" = common ", " = weak "))
        if linked is None:
            linked = one
        else:
            linked.link_in(one)
    # numba_nextafter is in numba's library, which is not loaded where the text is on disk; C's gives the same
    llvm = re.sub("numba_nextafter", "nextafter", str(linked))
    # what would raise an error in Python is never called, but would be missing where the text is linked
    llvm = ERRORS.sub(r"define \1 { call void @llvm.trap() unreachable }", llvm)
    return f"{llvm}\ndeclare void @llvm.trap()\n"
