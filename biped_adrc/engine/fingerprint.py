"""What generated code depends on, as one hash: the code of methods, the structure of robot and
parts, versions.

Object code is kept on disk between sessions, so a change of anything that it was made from has to
give another name. A method is followed into everything that it can reach: functions, classes, objects,
constants and, in modules, the attributes that it names. Libraries are represented by their names
and versions, this package by a hash of its source. What cannot be followed, such as an object of a
compiled extension, raises Untraceable: it is better not to compile than to run old code.

`engine.program`, `engine.compiled_walker` and all others that call `engine.ir.generated` build
their keys here.
"""

from __future__ import annotations

import dis
import functools
import hashlib
import pickle
import platform
import sys
import sysconfig
import types
from collections.abc import Mapping
from enum import Enum
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.engine.symbols import HIDDEN, Untraceable
from biped_adrc.engine.tracer import names_of
from biped_adrc.part import content, is_part
from biped_adrc.versions import NEVER_TRACED, packages, source_text

_PACKAGE = __name__.partition(".")[0]
_FOLDERS = tuple(sysconfig.get_paths()[kind] for kind in ("stdlib", "purelib", "platlib"))
_PLAIN = (types.NoneType, bool, int, float, complex, str, bytes, range, Enum, types.EllipsisType)
"""Values that are their own text."""
_NAMED = (
    *(types.MethodDescriptorType, types.WrapperDescriptorType, types.MemberDescriptorType),
    *(types.GetSetDescriptorType, types.MethodWrapperType, types.ClassMethodDescriptorType),
)
"""Methods of built-in classes, known by their names."""
_BARE = vars(NamedTuple("_Bare", [])) | {
    "__firstlineno__": 0,
    "_abc_impl": 0,
    "__abstractmethods__": 0,
}
"""Attributes that every class has, and that say nothing of its content."""


def hash_of(*parts: object) -> str:
    """A name for files, from the texts of these parts."""
    return hashlib.sha256("\0".join(map(str, parts)).encode()).hexdigest()[:32]


def law_text(*laws: object) -> str:
    """The code of functions or parts and all that they reach, as text.

    Two rows of them with the same text compile to the same code. What several of them reach is told once.
    Raises Untraceable where content is hidden.
    """
    reach = _Reach()
    for law in laws:
        reach.tell(law)
    return "\n".join(reach.texts)


def structure_text(tree: object) -> str:
    """Parameters without their floats: names, shapes, and what else there is, which decides the code.

    ints, texts and flags are part of it; floats and float arrays are replaced by their shapes, parts by their
    class and content.
    """
    if isinstance(tree, HIDDEN):
        return "hidden"
    if isinstance(tree, tuple | list) or is_part(tree):
        whole = content(tree) if is_part(tree) else _items(tree)
        inside = ", ".join(f"{name}={structure_text(x)}" for name, x in whole.items())
        return f"{_class_text(type(tree))}({inside})"
    if isinstance(tree, np.ndarray) and tree.dtype.kind == "f":
        return f"float{tree.shape}"
    if isinstance(tree, HIDDEN):
        return type(tree).__qualname__
    if is_part(tree):
        return f"{_class_text(type(tree))}({structure_text(tuple(content(tree).items()))})"
    return "float" if isinstance(tree, float | np.floating) else law_text(tree)


def _items(tree: Any) -> dict[object, object]:
    """What is in a tuple or list, by name or place."""
    return dict(zip(getattr(tree, "_fields", range(len(tree))), tree, strict=True))


def _class_text(cls: type) -> str:
    """The text of a class; kept for those of libraries and of this package, whose text never changes."""
    return _kept_text(cls) if all(_known(x.__module__) for x in cls.__mro__) else law_text(cls)


class _Reach:
    """Texts of what is reached, each thing once, in a fixed order.

    seen: by identity the place in this order; the objects are kept, so that no identity is used again.
    texts: of what has been told.
    """

    def __init__(self) -> None:
        self.seen: dict[int | tuple[int, frozenset[str]], tuple[int, object]] = {}
        self.texts: list[str] = []

    def tell(self, x: object, names: frozenset[str] = frozenset()) -> None:
        """The texts of x; of a module those of the attributes with these names.

        A thing met again is told by its place only, so that circles end.
        """
        if isinstance(x, _PLAIN):
            self.texts.append(f"{type(x).__qualname__} {x!r}")
            return
        key = (id(x), names) if isinstance(x, types.ModuleType) else id(x)
        if key in self.seen:
            self.texts.append(f"again {self.seen[key][0]}")
            return
        self.seen[key] = len(self.seen), x
        self.texts.append(f"{type(x).__module__}.{type(x).__qualname__}")
        if isinstance(x, types.FunctionType):
            self.function(x)
        elif isinstance(x, types.ModuleType):
            self.texts.append(x.__name__)
            if not _known(x.__name__):
                inside = {name: value for name, value in vars(x).items() if name in names}
                self.named(inside, names)
        elif isinstance(x, type):
            self.class_(x)
        else:
            self.value(x)

    def function(self, x: types.FunctionType) -> None:
        """Code, defaults, and what its names stand for, here and in modules that it imports.

        A library's function is known by its name; its version is in `versions_text`.
        """
        self.texts.append(f"{x.__module__}.{x.__qualname__}")
        home = x.__module__ or ""  # None for what dataclasses add to a class that no file holds
        if _known(home) and not home.startswith(_PACKAGE):
            return
        names = names_of(x.__code__) | _words(x.__code__)
        self.texts.append(_code_text(x.__code__))
        if x.__defaults__ or x.__kwdefaults__:
            self.tell((x.__defaults__, x.__kwdefaults__))
        scope = x.__globals__
        used = {name: scope[name] for name in names if name in scope}
        self.named(used, names)
        for cell in x.__closure__ or ():
            self.tell(cell.cell_contents, names)
        for name in sorted(_imported(x.__code__)):
            if name in sys.modules:
                self.tell(sys.modules[name], names)

    def class_(self, x: type) -> None:
        """A class by its name and fields; one of the user's with all that it and its bases hold."""
        self.texts.append(f"{x.__module__}.{x.__qualname__}{getattr(x, '_fields', '')}")
        for cls in x.__mro__:
            if not _known(cls.__module__):
                self.texts.append(cls.__qualname__)
                self.named({k: v for k, v in vars(cls).items() if k not in _BARE})

    def named(self, values: Mapping[str, object], names: frozenset[str] = frozenset()) -> None:
        """Names, sorted, and what they stand for."""
        for name in sorted(values):
            self.texts.append(name)
            self.tell(values[name], names)

    def value(self, x: object) -> None:
        """An object by its parts, an array by its bytes; a set sorted by text, since its order is not fixed."""
        if isinstance(x, np.ndarray | np.generic) and x.dtype.kind != "O":
            self.texts.append(f"{x.dtype}{x.shape}{x.tobytes().hex()}")
        elif isinstance(x, tuple | list | np.ndarray):
            for part in x:
                self.tell(part)
        elif isinstance(x, dict | types.MappingProxyType):
            for pair in x.items():
                self.tell(pair)
        elif isinstance(x, set | frozenset):
            self.texts += sorted(law_text(part) for part in x)
        elif isinstance(x, types.BuiltinFunctionType):
            self.texts.append(x.__qualname__)
            if x.__self__ is not None:
                self.tell(x.__self__)
        elif isinstance(x, _NAMED):
            self.texts.append(x.__qualname__)
        elif isinstance(x, np.ufunc):
            self.texts.append(self.ufunc(x))
        else:
            self.by_parts(x)

    def by_parts(self, x: object) -> None:
        """What is inside an object of any class; of a library's the pickled form.

        Raises Untraceable where there is neither.
        """
        inside = _inside(x)
        if inside or not _known(type(x).__module__):
            self.class_(type(x))
            self.named(inside)
            return
        try:
            self.texts.append(pickle.dumps(x, protocol=4).hex())
        except Exception as error:  # whatever a class of any library says
            raise _untold(x) from error

    def ufunc(self, x: np.ufunc) -> str:
        """One of NumPy's by its name. Raises Untraceable for any other."""
        if getattr(np, x.__name__, None) is not x:
            raise _untold(x)
        return x.__name__


@lru_cache(maxsize=1024)
def _kept_text(cls: type) -> str:
    return law_text(cls)


@lru_cache(maxsize=1024)
def _code_text(code: types.CodeType) -> str:
    """Bytecode, names and constants; sets of constants sorted, since their order changes from run to run."""
    parts = [code.co_code.hex(), code.co_names, code.co_varnames, code.co_freevars]
    for constant in code.co_consts:
        inside = sorted(map(repr, constant)) if isinstance(constant, frozenset) else constant
        parts.append(_code_text(inside) if isinstance(inside, types.CodeType) else repr(inside))
    return " ".join(map(str, parts))


def _inside(x: object) -> dict[str, object]:
    """The parts of an object by name: of wrappers what they wrap, of others slots and attributes."""
    wrapped = ("fget", "func", "__func__", "__self__", "args", "keywords", "__wrapped__")
    wraps = (property, functools.cached_property, functools.partial, staticmethod, classmethod)
    if isinstance(x, (*wraps, types.MethodType)) or hasattr(x, "cache_parameters"):
        return {name: getattr(x, name) for name in wrapped if hasattr(x, name)}
    slots = (name for cls in type(x).__mro__ for name in getattr(cls, "__slots__", ()))
    found = {name: getattr(x, name) for name in slots if hasattr(x, name)}
    return {**found, **getattr(x, "__dict__", {})}


def _untold(x: object) -> Untraceable:
    """The error for an object that cannot be followed."""
    return Untraceable(
        f"a law reaches {x!r}, a {type(x).__name__}, whose content cannot be told from outside"
    )


@lru_cache(maxsize=4096)
def _known(module: str) -> bool:
    """Whether a module belongs to a library, or to this package where what is traced may come from.

    Those are covered by versions and by the source's hash, so they are not followed.
    """
    top, *rooms = module.split(".")
    if top == _PACKAGE:
        return not rooms or rooms[0] not in NEVER_TRACED
    if top in sys.stdlib_module_names and top != "__main__":
        return True
    place = getattr(sys.modules.get(module), "__file__", None)
    return place is not None and place.startswith(_FOLDERS)


@lru_cache(maxsize=1024)
def _words(code: types.CodeType) -> frozenset[str]:
    """Texts in a piece of code that may be names of attributes, as for `getattr`; they are looked up too."""
    inner = (_words(x) for x in code.co_consts if isinstance(x, types.CodeType))
    own = (x for x in code.co_consts if isinstance(x, str) and x.isidentifier())
    return frozenset(own).union(*inner)


@lru_cache(maxsize=1024)
def _imported(code: types.CodeType) -> frozenset[str]:
    """Names of modules that a piece of code imports inside itself."""
    own = {x.argval for x in dis.get_instructions(code) if x.opname == "IMPORT_NAME"}
    inner = (_imported(x) for x in code.co_consts if isinstance(x, types.CodeType))
    return frozenset(own).union(*inner)


@lru_cache(maxsize=1)
def versions_text() -> str:
    """The versions of what makes code, the processor, and a hash of the package's own source; once
    per process.
    """
    from biped_adrc.engine.machine import processor

    made_by = packages(("numpy", "casadi", "llvmlite")).values()
    source = source_text(Path(__file__).parents[1], NEVER_TRACED)
    return "\n".join([platform.python_version(), *made_by, processor(), source])
