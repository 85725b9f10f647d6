"""The numbers of a walker, which machine code reads, and its structure, which decides the code.

Both are of a tree of parts, tuples and arrays: a value with others inside, to any depth, such as a controller
with its gains. A part is a dataclass (`core.part`); its content, the fields and the numbers derived from them,
belongs to the tree. Numbers are floats and arrays of floats here, in the order in which machine code reads
them; whole numbers are part of the structure. By the structure the engine finds generated code again.

To trace a walker is to run its methods once on symbols. The engine needs a tenth of a second for it, and a
study makes thousands of walkers that differ in their numbers alone. So code in memory is stored under a
structure: classes, integers and shapes of arrays, without the values of floats. Methods that are compiled have
to be pure, as in JAX: what they read besides their arguments and fields, such as a function or a constant of a
module, is read once, when they are compiled. A class that is defined a second time is another structure.
Another process finds code on disk by the name that `lasting` makes of a structure, where all classes in it are
this package's own. So a process that replaces a function or a constant of this package breaks the rule for
others too, unless it has a folder of its own for code (BIPED_ADRC_CACHE).
"""

import random
import sys
import types
from collections.abc import Hashable, Iterator
from enum import Enum
from typing import Any

import numpy as np

from biped_adrc.core.checks import LIBRARIES, PACKAGE
from biped_adrc.core.part import Setup, content, is_part, once
from biped_adrc.core.tree import Layout
from biped_adrc.core.versions import numerical_versions
from biped_adrc.engine.machine import hash_of
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.model.biped import Biped

# tuples of classes, since float | np.floating would be made anew at each call
REALS, LISTS = (float, np.floating), (tuple, list)
_RANDOM = (np.random.Generator, np.random.RandomState, random.Random)
HIDDEN = (Biped, complex, np.complexfloating, Setup, *_RANDOM)
"""Classes of what is neither number nor structure in a part: machine code must not depend on it."""


def floats(tree: object) -> list[float]:
    """The numbers of a tree, one after the other, as machine code reads them in the vector K: all floats in it,
    an array row by row. `engine.symbols.Vector.like` puts symbols in their places, in the same order.
    """
    if isinstance(tree, REALS):
        return [float(tree)]
    if isinstance(tree, np.ndarray):
        return tree.ravel().tolist() if tree.dtype.kind == "f" else []
    if isinstance(tree, Layout):  # a large tuple without floats, so this saves time
        return []
    return _floats(tree) if is_part(tree) else floats_inside(tree)


def floats_inside(tree: object) -> list[float]:
    """The numbers of the members of a tuple, list or part, one after the other; none of any other object."""
    return [number for _, x in _inside(tree) for number in floats(x)]


_floats = once(floats_inside)
"""`floats_inside` of a part, which never changes, so it is computed once for each."""


def paths(tree: object) -> list[str]:
    """Name of each number in `floats`, in the same order: field names and indices, such as
    k.tracking.K_p[0]."""
    return [place for name, x in leaves(tree) for place in Layout.of(x).names(name)]


def leaves(tree: object, name: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the numbers and arrays of numbers in a tree, each with its name; `name`: that of the tree
    itself."""
    if isinstance(tree, REALS) or (isinstance(tree, np.ndarray) and tree.dtype.kind == "f"):
        yield name, tree
    for part, x in _inside(tree):
        place = f"[{part}]" if isinstance(part, int) else f".{part}" if name else part
        yield from leaves(x, name + place)


def _inside(tree: object) -> Iterator[tuple[str | int, object]]:
    """Yield the members of a tuple, list or part, each with its field name or its index; none for other
    objects."""
    if is_part(tree) and not isinstance(tree, HIDDEN):
        yield from content(tree).items()
    elif isinstance(tree, LISTS):
        yield from zip(getattr(tree, "_fields", range(len(tree))), tree, strict=True)


def structure(tree: Any, exact: bool = False) -> Hashable:
    """The structure of a tree of parts, tuples, arrays and numbers: two trees with equal ones share their code.

    It is a nested tuple, to be compared and hashed. exact: whether floats count by value too. Raises
    NotCompiled for an object whose content cannot be compared.
    """
    # a float (a class of REALS) is a symbol in the code, so its value does not count; an int decides a size or
    # a branch, so it does
    if isinstance(tree, REALS) and not exact:
        return float
    if isinstance(tree, np.ndarray):
        numbers = tree.dtype.kind == "f" and not exact
        return tree.dtype.str, tree.shape, None if numbers else tree.tobytes()
    # HIDDEN: classes on which code must not depend, such as a robot; a method that uses one is not compiled
    if isinstance(tree, HIDDEN):
        return "hidden", type(tree)
    if is_part(tree):
        return _of_part(tree, exact)
    if isinstance(tree, Layout):  # whole numbers alone, to be compared as it is
        return tree
    if isinstance(tree, LISTS):
        return type(tree), *(structure(x, exact) for x in tree)
    if isinstance(tree, dict):  # its numbers are constants in the code, so they count by value
        return dict, *((name, structure(x, True)) for name, x in tree.items())
    try:
        hash(tree)
    except TypeError:
        raise NotCompiled(
            f"a part holds {tree!r}, a {type(tree).__name__} whose content cannot be compared"
        ) from None
    # any other object, such as an Enum's: by itself, and by the values of the attributes that it has
    known = isinstance(tree, type | types.FunctionType | types.ModuleType)
    inside = {} if known else getattr(tree, "__dict__", {})
    return type(tree), tree, structure(inside, True) if inside else None


def alike(one: Any, other: Any) -> bool:
    """Whether two values have equal structures; what both share, such as an observer, is not looked into."""
    if one is other:
        return True
    # HIDDEN: robots and others that are no tree
    if type(one) is not type(other) or not is_part(one) or isinstance(one, HIDDEN):
        return structure(one) == structure(other)
    members = content(other)
    return all(alike(x, members[name]) for name, x in content(one).items())


@once
def _of_part(part: Any, exact: bool) -> Hashable:
    """The structure of a part: its class, and the structures of its fields and derived numbers by name.

    exact: whether floats count by their values too, as where they are constants in the code.
    """
    return type(part), *((name, structure(x, exact)) for name, x in content(part).items())


def lasting(key: Hashable) -> str:
    """Make a name of a structure, a hash, that is the same in every process with the same versions of the
    libraries; code on disk is found by it.

    Empty for a structure with classes or functions of the user's.
    """
    try:
        # `_spelled`, the structure as text, raises LookupError for a class or function of the user's
        return hash_of(_spelled(key), str(numerical_versions()))
    except LookupError:
        return ""


def _spelled(key: Hashable) -> str:
    """A structure as text. Raises LookupError for what may be something else in another process."""
    if isinstance(key, tuple):
        return f"({','.join(map(_spelled, key))})"
    if isinstance(key, type | types.FunctionType):
        home = str(key.__module__).partition(".")[0]
        # one that is not found by its name in its module was made inside a function: a KeyError, a LookupError
        own = home == "biped_adrc" and vars(sys.modules[key.__module__])[key.__qualname__] is key
        if own or home in ("builtins", "enum", "numpy"):
            return f"{key.__module__}.{key.__qualname__}"
    elif key is None or isinstance(key, int | float | str | bytes | Enum | np.generic):
        return repr(key)
    raise LookupError(key)


def is_library(module: types.ModuleType) -> bool:
    """Whether a module is Python's or an installed library's: neither the user's nor of this package, whose own
    folder may be among the libraries.
    """
    file = getattr(module, "__file__", None)
    # LIBRARIES: folders of Python and of installed packages; PACKAGE: that of this one
    return file is None or (file.startswith(LIBRARIES) and not file.startswith(PACKAGE))
