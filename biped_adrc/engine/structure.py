"""What decides generated code, to be found again in memory and on disk.

Tracing takes a tenth of a second, and a study makes thousands of walkers with other numbers. So code in memory
is found by the structure of what it was made from, floats replaced by their shapes, and by what its methods
reached outside of this package: a class, function or constant that was defined anew makes other code. Another
process finds it by that structure where all of it is this package's own (`lasting`).
"""

from __future__ import annotations

import sys
import types
from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from enum import Enum
from typing import Any

import numpy as np

from biped_adrc.core.checks import LIBRARIES, PACKAGE, is_users
from biped_adrc.core.part import content, is_part
from biped_adrc.core.versions import numerical_versions
from biped_adrc.engine.machine import hash_of
from biped_adrc.engine.symbols import HIDDEN, LISTS, REALS, NotCompiled


def structure(tree: Any, exact: bool = False) -> Hashable:
    """All that decides the code of a tree of parts, tuples, arrays and numbers; exact: floats by value too.

    Raises NotCompiled for an object whose content cannot be compared.
    """
    if isinstance(tree, REALS) and not exact:
        return float
    if isinstance(tree, np.ndarray):
        numbers = tree.dtype.kind == "f" and not exact
        return tree.dtype.str, tree.shape, None if numbers else tree.tobytes()
    if isinstance(tree, HIDDEN):
        return "hidden", type(tree)
    if is_part(tree):
        return type(tree), *((name, structure(x, exact)) for name, x in content(tree).items())
    if isinstance(tree, LISTS):
        return type(tree), *(structure(x, exact) for x in tree)
    if isinstance(tree, dict):
        return dict, *((name, structure(x, True)) for name, x in tree.items())
    try:
        hash(tree)
    except TypeError:
        raise NotCompiled(
            f"a part holds {tree!r}, a {type(tree).__name__} whose content cannot be compared"
        ) from None
    known = isinstance(tree, type | types.FunctionType | types.ModuleType)
    inside = {} if known else getattr(tree, "__dict__", {})
    return type(tree), tree, structure(inside, True) if inside else None


def lasting(key: Hashable) -> str:
    """Name for a structure, the same in every process of the same versions; empty for one with classes or
    functions of the user's, or where one of this package's functions was replaced in this process."""
    try:
        return "" if _replaced() else hash_of(_spelled(key), str(numerical_versions()))
    except LookupError:
        return ""


def _spelled(key: Hashable) -> str:
    """A structure as text. Raises LookupError for what may be something else in another process."""
    if isinstance(key, tuple):
        return f"({','.join(map(_spelled, key))})"
    if isinstance(key, type | types.FunctionType):
        home = str(key.__module__).partition(".")[0]
        own = home == "biped_adrc" and vars(sys.modules[key.__module__])[key.__qualname__] is key
        if own or home in ("builtins", "enum", "numpy"):
            return f"{key.__module__}.{key.__qualname__}"
    elif key is None or isinstance(key, int | float | str | bytes | Enum | np.generic):
        return repr(key)
    raise LookupError(key)


def _replaced() -> bool:
    """Whether a function or method of this package is the user's in this process."""
    for name, module in list(sys.modules.items()):
        for x in list(vars(module).values()) if name.startswith("biped_adrc.") else ():
            own = isinstance(x, type) and x.__module__ == name
            for member in vars(x).values() if own else (x,):
                home = member.__globals__ if type(member) is types.FunctionType else vars(module)
                if home is not vars(module) and changes(home["__name__"], home.get("__file__")):
                    return True
    return False


Unchanged = Callable[[], bool]
"""Whether something that a traced method reached is still what it was."""
_REACHED: ContextVar[list[Unchanged] | None] = ContextVar("reached", default=None)


@contextmanager
def reaching() -> Iterator[list[Unchanged]]:
    """What is traced within the block notes here what it reaches outside of this package and of libraries."""
    result: list[Unchanged] = []
    token = _REACHED.set(result)
    try:
        yield result
    finally:
        _REACHED.reset(token)


def note(names: dict[str, Any] | types.MappingProxyType[str, Any], name: str) -> None:
    """Note the value of a name in the globals of a function, or in a class."""
    reached, value = _REACHED.get(), names[name]
    if reached is None:
        return
    kept = _snapshot(value)
    reached.append(lambda: name in names and names[name] is value and _snapshot(value) == kept)


def _snapshot(value: Any) -> object:
    """What can change in place of a constant."""
    if isinstance(value, np.ndarray):
        return value.tobytes()
    return repr(value) if isinstance(value, list | dict | set) else None


def is_library(module: types.ModuleType) -> bool:
    """Whether a module is neither the user's nor of this package, which may be installed among libraries."""
    file = getattr(module, "__file__", None)
    return file is None or (file.startswith(LIBRARIES) and not file.startswith(PACKAGE))


def changes(module: str | None, file: str | None) -> bool:
    """Whether a module is one of the user's, and no library's or this package's."""
    if module is None or module.partition(".")[0] == "biped_adrc":
        return False
    return file is None or is_users(file)
