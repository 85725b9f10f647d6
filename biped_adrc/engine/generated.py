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
"""By name, each to be called for its expression."""
_IN_MEMORY: dict[Hashable, LoadedCode | str] = {}
"""Code by structure, or why there is none; a function is a value, so this is no state."""


def generated(key: Hashable, functions: _Functions, vectors: bool = False) -> LoadedCode:
    """These functions in memory, by name; traced once per structure.

    - key: the structure of what they are made from (`engine.structure`).
    - vectors: as of `machine.object_code`.

    Raises NotCompiled, each time without tracing anew.
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
    """The text of these functions; from the disk where another process has made it for the same structure."""
    link = lasting(key)
    there = fetch(link) if link else None
    if there is not None:
        return there.decode()
    from biped_adrc.engine.ir import module_text  # and with it CasADi, for what is traced alone

    result = module_text({name: f() for name, f in functions.items()})
    if link:
        store(link, result.encode())
    return result
