"""A state is a tree: a NamedTuple of arrays, of single numbers and of further states, or an array alone.

Controllers and observers read and return trees. Integrators, stored runs and machine code use vectors:
`flatten` joins the numbers of a tree in the order of its fields, and its `Layout` makes the tree of a vector
again.
"""

import math
from collections.abc import Iterator
from numbers import Real
from typing import Any, NamedTuple, Self

import numpy as np

from biped_adrc.core.checks import line_of, returned, spoken
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array, of_kind


def flatten(tree: Any) -> Array:
    """The numbers of a tree as a vector (size,), one array or number after the other; None has no numbers."""
    # first what a controller in Python has at each sample instant
    if type(tree) is np.ndarray and tree.ndim == 1:
        return tree
    if isinstance(tree, tuple):
        parts = [flatten(x) for x in tree if x is not None]
        return np.concatenate(parts) if parts else np.zeros(0)
    # by `ndim` and not by class: a leaf may be an array, an array of symbols, NumPy's or Python's number, or a
    # single symbol (`engine.symbols.Scalar`), which is no number and has no shape
    if hasattr(tree, "ndim") and tree.ndim > 0:
        return tree.reshape(-1)
    return np.array([tree])


def chosen(which: float, one: Any, other: Any) -> Any:
    """Choose between two trees of one layout: `one` if `which` is 1 (true), `other` if it is 0.

    Raises InputError for two layouts, as where a user's `correct` returns another state than `initial_state`.
    """
    if Layout.of(one) != Layout.of(other):
        names, others = ([*Layout.of(x).names("s")] for x in (one, other))
        raise InputError(f"a state is {names} or {others}; expected one class and shape")
    if isinstance(one, tuple):
        parts = [chosen(which, *pair) for pair in zip(one, other, strict=True)]
        return of_kind(type(one), parts)
    # np.where and no `if`: on symbols, whose truth is not known yet, both sides become code, and the choice is
    # made when that runs; 0.5 parts 0 from 1
    return one if one is None else np.where(which > 0.5, one, other)


def zeros_like(tree: Any) -> Any:
    """A tree of the same layout, with zeros."""
    if isinstance(tree, tuple):
        return of_kind(type(tree), [zeros_like(x) for x in tree])
    return tree if tree is None else np.zeros(np.shape(tree))


class Layout(NamedTuple):
    """The classes and shapes of a tree without its numbers, and the order in which `flatten` has these."""

    kind: type | None
    """Class of a tuple, or NoneType for the tree None; None for an array or a number."""
    parts: tuple[Any, ...]
    """Layouts of a tuple's parts; for an array its shape, () for a number."""
    size: int
    """Number of numbers in the tree."""

    @classmethod
    def of(cls, tree: Any) -> Self:
        """The layout of a tree."""
        if isinstance(tree, tuple):
            parts = tuple(map(cls.of, tree))
            return cls(type(tree), parts, sum(x.size for x in parts))
        if tree is None:
            return cls(type(None), (), 0)
        shape = np.shape(tree)
        return cls(None, shape, math.prod(shape))

    def tree(self, x: Array) -> Any:
        """The tree whose numbers are x (.., size); its arrays are views of x, with the leading axes of x."""
        if self.kind is None:  # an array of the shape `parts`, or a number where that is ()
            if self.parts == x.shape:
                return x
            if self.parts:
                return x.reshape(x.shape[:-1] + self.parts)
            # of a vector of symbols x[..., 0] were an array without axes, which no operation takes
            return x[0] if x.ndim == 1 else x[..., 0]
        if self.kind is type(None):
            return None
        at, parts = 0, []
        for part in self.parts:
            parts.append(part.tree(x[..., at : at + part.size]))
            at += part.size
        # a tuple or NamedTuple of the class `kind`
        return of_kind(self.kind, parts)

    def place(self, *path: str) -> slice:
        """The slice of the vector that a part of the tree takes; path: names of fields that lead to it from the
        whole tree, such as "tail", "own" for tree.tail.own.
        """
        at, part = 0, self
        for name in path:
            i = part.kind._fields.index(name)  # type: ignore[union-attr]
            at += sum(x.size for x in part.parts[:i])
            part = part.parts[i]
        return slice(at, at + part.size)

    def names(self, name: str = "") -> Iterator[str]:
        """Iterate over the names of all numbers of the tree, such as line.u[0]; name: what they begin with."""
        if self.kind is None:
            for i in np.ndindex(*self.parts):
                yield name + (f"[{', '.join(map(str, i))}]" if i else "")
            return
        fields = getattr(self.kind, "_fields", None) or map(str, range(len(self.parts)))
        for field, part in zip(fields, self.parts, strict=True):
            yield from part.names(f"{name}.{field}" if name else field)


def returned_tree(
    found: Any, layout: Layout | None, part: object, method: str, finite: bool = True
) -> Any:
    """Check a state that a method of a user's class returns, and return it with arrays of floats.

    layout: that of the state at the start of the run; None: every layout is right. Raises InputError that names
    class, method and line for another class, shape or type, and, where `finite`, NotFiniteError.
    """
    kind = None if layout is None else layout.kind
    if layout is not None and kind is None:  # an array or a number; `parts` is its shape
        return returned(found, layout.parts, part, method, finite)
    if layout is None and not isinstance(found, tuple):
        numeric = isinstance(found, np.ndarray | Real)
        # None for what is no number, which `returned` then refuses
        shape: tuple[int, ...] | None = np.shape(found) if numeric else None
        return returned(found, shape, part, method, finite)
    same = layout is None or type(found) is kind
    # a plain tuple is of the right class whatever its length
    if not same or (layout is not None and len(found) != len(layout.parts)):
        begin = f"{spoken(part)}.{method}{line_of(part, method)} returned"
        # _tuple_text: name of a class, and of a plain tuple its length too
        one, other = _tuple_text(type(found), found), _tuple_text(kind, layout.parts)  # type: ignore[union-attr]
        raise InputError(f"{begin} {one}, expected {other} as at the start")
    layouts = (None,) * len(found) if layout is None else layout.parts
    each = zip(found, layouts, strict=True)
    # _or_none: checks a part, which may also be None
    return of_kind(type(found), [_or_none(x, y, part, method, finite) for x, y in each])


def _tuple_text(kind: Any, parts: Any) -> str:
    """Text of a class in a message: "a NAME", of a plain tuple "a tuple of 2"."""
    return f"a {kind.__name__}" + (f" of {len(parts)}" if kind is tuple else "")


def _or_none(found: Any, layout: Layout | None, part: object, method: str, finite: bool) -> Any:
    """Check a part of a tree as `returned_tree` checks the whole; a part may also be None, without numbers.

    layout: of this part at the start of the run; None: any is right.
    """
    if found is None and (layout is None or layout.kind is type(None)):
        return None
    return returned_tree(found, layout, part, method, finite)
