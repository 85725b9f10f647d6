"""Machine code of functions such as a walker's flow, found by their structure in memory or on disk, else
compiled.

The structure of a function is all that decides its code, without the values of floats (`engine.structure`). To
trace is to run its Python once on symbols, which gives the expression that is compiled.
"""

from collections.abc import Callable, Hashable, Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any

from biped_adrc.engine.machine import Code, from_disk
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.structure import lasting

if TYPE_CHECKING:
    from biped_adrc.engine.equations import SymbolicFunction

_Traces = Mapping[str, Callable[[], "SymbolicFunction"]]
"""Name of a function -> what is called to trace it where its code is neither in memory nor on disk."""
_IN_MEMORY: dict[Hashable, Code | str] = {}
"""Structure and names of functions -> their code; a text where they cannot be compiled, the reason."""


def with_casadi(module: str, name: str, *arguments: object) -> Any:
    """What the function `name` of a module of the engine returns; the import is here, as it brings CasADi in,
    which is needed only where something is traced.
    """
    return getattr(import_module(f"biped_adrc.engine.{module}"), name)(*arguments)


def generated(key: Hashable, functions: _Traces, optimised: bool = False, lanes: int = 1) -> Code:
    """The machine code of these functions; they are traced once per structure.

    - key: the structure of what they are made from; equal keys have to mean equal code.
    - functions: name -> what traces its expression when it is called.
    - optimised: whether LLVM's passes run (`machine.object_code`).
    - lanes: number of walks that they serve in one call (`ir.function_text`).

    Raises NotCompiled for functions that cannot be traced; a second call raises it without tracing anew.
    """

    def text() -> str:
        return with_casadi("ir", "module_text", {x: f() for x, f in functions.items()}, lanes)

    return generated_text((key, *functions, lanes), tuple(functions), text, optimised)


def generated_text(
    key: Hashable, names: tuple[str, ...], write: Callable[[], str], optimised: bool = False
) -> Code:
    """The machine code of a module in LLVM's language, with these functions, that `write` makes; else as
    `generated`."""
    code = _IN_MEMORY.get(key)
    if code is None:
        try:
            # from the disk, where another process has made a text of the same structure
            name = lasting(key)  # empty for a structure with classes of the user's
            text = from_disk(name, lambda: write().encode()).decode() if name else write()
            code = Code(text, names, optimised)
        except NotCompiled as error:
            code = str(error)
        _IN_MEMORY[key] = code
    if isinstance(code, str):
        raise NotCompiled(code)
    return code
