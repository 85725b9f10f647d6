"""The numbers of a tree of parts, tuples and arrays, in the order in which machine code reads them.

Numbers are floats and arrays of floats here; whole numbers are part of the code. A tree is a value with others
inside, to any depth, such as a controller with its gains. A part is a dataclass (`core.part`); its content, the
fields and the numbers derived from them, belongs to the tree.
"""

import random
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from biped_adrc.core.once import once
from biped_adrc.core.part import Setup, content, is_part
from biped_adrc.core.tree import Layout
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
    places = ((name, np.ndindex(*np.shape(x))) for name, x in leaves(tree))
    return [name + (f"[{', '.join(map(str, i))}]" if i else "") for name, at in places for i in at]


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


def rebuilt(like: tuple[object, ...] | list[object], parts: Sequence[object]) -> object:
    """A tuple, NamedTuple or list of the class of `like` with these members."""
    return like._make(parts) if hasattr(like, "_make") else type(like)(parts)
