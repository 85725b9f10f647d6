"""The text for LLVM of the march's loops, as numba writes it.

The march is the loop of a walk through time (`hybrid.march`), a unit one of its functions that becomes a
function of the text (`kernels.call.unit`). The sources are joined into one text of Python, without their
imports of each other. The reason is `hybrid.march`: it calls operations such as `flow` and `add` by name. In
Python they are those of `hybrid.on_arrays`, which it imports; in the joined text the same names are those of
`kernels.operations`, which `load.FILES` has in place of it. In the editor and for type checks the files are
ordinary modules.

Whoever changes one of these files runs `python -m validation.texts`; a test compares.
"""

from __future__ import annotations

import ast
import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

from llvmlite import binding

from biped_adrc.core.errors import ModelError
from biped_adrc.engine.machine import parsed, run_passes

_ERRORS = re.compile(r'^declare (.*?@"?(?:Py|NRT_|numba_)[^"(]*"?\(.*?\)).*$', re.MULTILINE)
"""Declarations of functions that numba calls where Python would raise an error, which the loops never do."""

HINTS = re.compile(r" ?\bcaptures\(none\)| ?\bnoundef\b| ?\brange\([^)]*\)")
"""Attributes that LLVM finds again, and whose words change from version to version: a text without them is read
by each LLVM from 20 to 22."""


def sources(files: tuple[str, ...]) -> str:
    """The texts of the modules with these names, one after the other."""
    root = Path(__file__).parents[3]
    paths = [root / f"{name.replace('.', '/')}.py" for name in files]
    return "\n".join(path.read_text(encoding="utf-8") for path in paths)


def _joined(files: tuple[str, ...]) -> str:
    """One text of Python of these modules, one after the other, without their imports of each other and of the
    march's operations for Python (`hybrid.on_arrays`).
    """
    # `from hybrid.on_arrays import *`, if it stayed, would put Python's operations in place of the compiled
    # ones of the same names. `__future__` has to stand first, where it is put back.
    left_out = ("__future__", *files, "biped_adrc.hybrid.on_arrays")
    statements = [
        statement
        for statement in ast.parse(sources(files)).body
        if not (isinstance(statement, ast.ImportFrom) and statement.module in left_out)
    ]
    return "from __future__ import annotations\n" + ast.unparse(ast.Module(statements, []))


def written(files: tuple[str, ...]) -> str:
    """LLVM's text of all units of these modules, of which each module names those before it.

    In it a call that would raise an error in Python ends the process. Raises ModelError where numba is switched
    off.
    """
    from numba import cfunc, config

    if getattr(config, "DISABLE_JIT", 0):
        raise ModelError("NUMBA_DISABLE_JIT is set, so nothing can be compiled; unset it")
    module = ModuleType("biped_adrc_kernels")
    # numba looks in sys.modules for what a unit names
    sys.modules[module.__name__] = module
    # executed and not imported, since the joined text is no file
    exec(compile(_joined(files), module.__name__, "exec"), vars(module))
    names, linked = dict[str, str](), None
    for name, (symbol, signature, function) in module.UNITS.items():
        callback: Any = cfunc(signature, error_model="numpy")(function)
        # while it compiles a unit that calls this one, numba links it, by this name
        binding.add_symbol(symbol, callback.address)
        names |= {symbol: name, callback.native_name: name}
        # without numba's target the text serves any processor and WebAssembly alike
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
    # numba_nextafter is in numba's library, which no user has; C's gives the same
    llvm = re.sub("numba_nextafter", "nextafter", str(linked))
    # what would raise an error in Python is never called, but would be missing where the text is linked
    llvm = _ERRORS.sub(r"define \1 { call void @llvm.trap() unreachable }", llvm)
    llvm = _optimised(f"{without_hints(llvm)}\ndeclare void @llvm.trap()\n")
    return without_hints(re.sub(r"^(source_filename|target) .*\n", "", llvm, flags=re.MULTILINE))


def without_hints(llvm: str) -> str:
    """LLVM's text without hints to the optimiser, which each version of LLVM writes in another way, and without
    comments.
    """
    llvm = re.sub(r"^.*@llvm\.lifetime\..*\n", "", llvm, flags=re.MULTILINE)
    llvm = re.sub(r"^(attributes #\d+ = ).*$", r"\1{ nounwind }", llvm, flags=re.MULTILINE)
    # a semicolon begins a comment, but not between quotes: bytes of numba's own constants may have one
    llvm = re.sub(r'^((?:"[^"\n]*"|[^";\n])*?) *;.*$', r"\1", llvm, flags=re.MULTILINE)
    return HINTS.sub("", llvm)


def _optimised(llvm: str) -> str:
    """LLVM's text after LLVM's passes of level 3, which inline units in each other, so that no user waits for
    them. Without vectors and unrolled loops, which suit one processor alone.
    """
    binding.initialize_all_targets()
    machine = binding.Target.from_triple("x86_64-unknown-linux-gnu").create_target_machine()
    module = parsed(llvm, machine)
    run_passes(module, machine, vectors=False)
    return str(module)
