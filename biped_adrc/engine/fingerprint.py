"""What generated code depends on, as one hash: the laws' code, the make of robot and parameters, versions."""

from __future__ import annotations

import hashlib
import platform
import types
from collections import namedtuple
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from biped_adrc.engine.symbols import names_of
from biped_adrc.versions import NEVER_TRACED, packages, source_text


def hash_of(*parts: Any) -> str:
    """A name for files."""
    return hashlib.sha256("\0".join(map(str, parts)).encode()).hexdigest()[:32]


def law_text(law: Any, seen: set[Any] | None = None) -> str:
    """The code of a law and of all functions that it reaches, and the constants that they use."""
    seen = set() if seen is None else seen
    if isinstance(law, type):
        return _class_text(law)
    if isinstance(law, tuple):
        return "\n".join(law_text(part, seen) for part in law)
    if not isinstance(law, types.FunctionType):
        return constant_text(law)
    if law in seen:
        return law.__qualname__
    seen.add(law)
    names = sorted(names_of(law.__code__))
    used = {name: law.__globals__[name] for name in names if name in law.__globals__}
    closed = [cell.cell_contents for cell in law.__closure__ or ()]
    parts = [law.__qualname__, _code_text(law.__code__), constant_text(law.__defaults__)]
    parts += [constant_text(law.__kwdefaults__)]
    parts += [f"{name}={_reached(value, names, seen)}" for name, value in used.items()]
    return "\n".join([*parts, *(_reached(value, names, seen) for value in closed)])


def _reached(value: Any, names: list[str], seen: set[Any]) -> str:
    """A value, and what of these names is found in it where it is a module."""
    inside: list[Any] = []
    if isinstance(value, types.ModuleType) and value.__name__.split(".")[0] not in (
        "numpy",
        "math",
    ):
        inside = [getattr(value, name) for name in names if hasattr(value, name)]
    return "\n".join([law_text(value, seen), *(law_text(x, seen) for x in inside)])


_PLAIN = {*vars(namedtuple("_Plain", ()))}


@lru_cache(maxsize=1024)
def _class_text(cls: type) -> str:
    """A class by name, a NamedTuple with the code of its own methods and properties."""
    if not hasattr(cls, "_fields"):
        return constant_text(cls)
    own = [value for name, value in sorted(vars(cls).items()) if name not in _PLAIN]
    laws = [x.fget if isinstance(x, property) else x for x in own]
    methods = (law_text(x) for x in laws if isinstance(x, types.FunctionType))
    return "\n".join([constant_text(cls), *methods])


@lru_cache(maxsize=1024)
def _code_text(code: types.CodeType) -> str:
    inner = [_code_text(c) if isinstance(c, types.CodeType) else repr(c) for c in code.co_consts]
    return f"{code.co_code.hex()} {code.co_names} {code.co_varnames} {inner}"


def constant_text(value: Any) -> str:
    """A constant by value, a class or module by name."""
    if isinstance(value, np.ndarray):
        return f"{value.dtype}{value.shape}{value.tobytes().hex()}"
    if isinstance(value, types.ModuleType):
        return value.__name__
    if isinstance(value, type):
        return f"{value.__module__}.{value.__qualname__}{getattr(value, '_fields', '')}"
    return repr(value)


def skeleton(tree: Any) -> str:
    """Parameters without their floats: names, shapes, and the ints, which decide."""
    if isinstance(tree, tuple):
        names = getattr(tree, "_fields", range(len(tree)))
        inside = ", ".join(f"{name}={skeleton(x)}" for name, x in zip(names, tree, strict=True))
        return f"{_class_text(type(tree))}({inside})"
    if isinstance(tree, np.ndarray):
        return f"float{tree.shape}" if tree.dtype.kind == "f" else constant_text(tree)
    return "float" if isinstance(tree, float | np.floating) else repr(tree)


@lru_cache(maxsize=1)
def versions_text() -> str:
    """The versions of what makes code, the processor, and the package's own source."""
    from biped_adrc.engine.machine import processor

    made_by = packages(("numpy", "casadi", "llvmlite")).values()
    source = source_text(Path(__file__).parents[1], NEVER_TRACED)
    return "\n".join([platform.python_version(), *made_by, processor(), source])
