"""Machine code of functions by their structure, in memory and on disk; traced only where neither has it."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from typing import TYPE_CHECKING

from biped_adrc.engine.machine import LoadedCode, fetch, load_or_compile, store
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.structure import lasting

if TYPE_CHECKING:
    from biped_adrc.engine.equations import SymbolicFunction

_Functions = Mapping[str, Callable[[], "SymbolicFunction"]]
"""Functions by name; each value is called, where its code is not there, to trace the expression."""
_IN_MEMORY: dict[Hashable, LoadedCode | str] = {}
"""Code by structure, or why there is none; a function is a value, so this is no state."""


def generated(key: Hashable, functions: _Functions, vectors: bool = False) -> LoadedCode:
    """Machine code of these functions in memory; they are traced once per structure.

    - key: the structure of what they are made from (`engine.structure`).
    - vectors: whether LLVM joins like operations into vector instructions (`machine.object_code`).

    Raises NotCompiled for functions that cannot be traced; a second call raises it without tracing anew.
    """
    names = list(functions)
    key = key, *names
    code = _IN_MEMORY.get(key)
    if code is None:
        try:
            code = load_or_compile(_text(key, functions), names, vectors)
        except NotCompiled as error:
            code = str(error)
        _IN_MEMORY[key] = code
    if isinstance(code, str):
        raise NotCompiled(code)
    return code


def _text(key: Hashable, functions: _Functions) -> str:
    """LLVM's text of these functions; from the disk where another process has traced the same structure."""
    link = lasting(key)
    there = fetch(link) if link else None
    if there is not None:
        return there.decode()
    from biped_adrc.engine.ir import module_text  # and with it CasADi, for what is traced alone

    result = module_text({name: f() for name, f in functions.items()})
    if link:
        store(link, result.encode())
    return result
