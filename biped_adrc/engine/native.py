"""A law as a C function, from the lines that run in Python.

    void f(double* K, double* inp, double* out)

K holds the law's parameters k, inp its other arguments, out its result, each flat: depth first through
NamedTuples, arrays by rows, one number for an int or a float. `out` must not overlap the others.

One text is composed of the law, of every function, NamedTuple and constant it reaches, and of the shapes of its
arguments; numba compiles it once and the store keeps it by the text's hash, so a law that is edited is another
module. `a @ b` and `solve` become loops: no BLAS, whose last bits depend on its threads. Where Python raises,
as `solve` does for a singular matrix, out is NaN.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from ctypes import POINTER, c_double
from functools import lru_cache
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.engine.native_source import Unfit, composed
from biped_adrc.engine.store import forget, load_source, seal
from biped_adrc.errors import InputError
from biped_adrc.types import Array

AGREE = 1e-6
"""Largest difference from Python at the examples, relative to the largest number of the result."""


class NativeLaw(NamedTuple):
    """The address of f, and what has to be kept for it to stay there."""

    address: int
    keep: object


def native_law(law: Callable[..., Any], arguments: tuple[Any, ...], size: int) -> NativeLaw:
    """The law in machine code, for arguments of the shapes of these examples and a result of `size` numbers.

    arguments: k, then the others: numbers, arrays and NamedTuples of these. Where the law can be evaluated at
    them, the code is compared with it. Raises InputError that says why a law cannot be compiled.
    """
    K, inp = flatten(arguments[0]), flatten(arguments[1:])
    try:
        compiled = _compiled_somehow(composed(law, arguments, size))
        found = np.empty(size)
        compiled.ctypes(*(x.ctypes.data_as(POINTER(c_double)) for x in (K, inp, found)))
        _check(law, arguments, found)
    except Unfit as reason:
        name = f"{getattr(law, '__module__', '')}.{getattr(law, '__qualname__', repr(law))}"
        raise InputError(
            f"law '{name}' cannot be compiled: {reason}. Its controller or disturbance then runs in "
            "Python on the compiled plant"
        ) from reason
    return NativeLaw(int(compiled.address), compiled)


def flatten(tree: Any) -> Array:
    """The numbers of NamedTuples of arrays, floats and ints, depth first, arrays by rows.

    Raises InputError for anything else.
    """
    parts = [np.asarray(leaf, dtype=float).ravel() for leaf in _leaves(tree, "")]
    return np.concatenate(parts) if parts else np.zeros(0)


def _leaves(tree: Any, place: str) -> Iterator[Any]:
    if isinstance(tree, tuple):
        names = getattr(tree, "_fields", range(len(tree)))
        for name, part in zip(names, tree, strict=True):
            yield from _leaves(part, f"{place}.{name}".lstrip("."))
    elif np.asarray(tree).dtype.kind in "biuf" and not isinstance(tree, list):
        yield tree
    else:
        raise InputError(
            f"argument {place} of a law is {tree!r:.60} ({type(tree).__name__}); expected numbers, "
            "float64 arrays and NamedTuples of them"
        )


def _check(law: Callable[..., Any], arguments: tuple[Any, ...], found: Array) -> None:
    """Compare with Python, unless the law cannot be evaluated at the examples."""
    try:
        with np.errstate(all="ignore"):
            expected = flatten(law(*arguments))
    except Exception:  # whatever a law may raise, such as SingularError
        return
    if len(expected) != len(found):
        raise Unfit(f"it gives {len(expected)} numbers, expected {len(found)}")
    largest = np.max(np.abs(expected), initial=0.0, where=np.isfinite(expected))
    if not np.allclose(found, expected, rtol=0.0, atol=AGREE * largest, equal_nan=True):
        raise Unfit(f"the code gives {found}, Python {expected}")


def _compiled_somehow(text: str) -> Any:
    """With all in one function, which compiles two to three times faster, or where numba fails so, without."""
    try:
        return _compiled(text)
    except Unfit:
        return _compiled(text.replace('inline="always"', 'inline="never"'))


@lru_cache(maxsize=256)
def _compiled(text: str) -> Any:
    """numba's C function of a text, from the disk if it is there and undamaged."""
    from numba import cfunc, types
    from numba.core.errors import NumbaError

    pointer = types.CPointer(types.float64)  # type: ignore[no-untyped-call]
    decorate = cfunc(types.void(pointer, pointer, pointer), cache=True, error_model="numpy")
    module = load_source(text)
    try:
        made = decorate(module.entry)
    except NumbaError as error:
        raise Unfit(_reason(error)) from error
    except Exception:  # numba does not say what it raises for machine code that is damaged
        forget(module)
        module = load_source(text)
        try:
            made = decorate(module.entry)
        except Exception as error:
            raise Unfit(_reason(error)) from error
    seal(module)
    return made


def _reason(error: Exception) -> str:
    """One line of numba's many: what it misses, and the line of the law where it does."""
    lines = [line.strip() for line in str(error).splitlines()]
    said = [x for x in lines if x and not x.startswith(("Failed in", "During", "File"))]
    shown = [f"{x:.150}" for x in (*said[:1], *(x[4:] for x in said if x.startswith(">>> ")))]
    places = (line for line, below in pairwise(lines) if below == "^" and "_put(" not in line)
    place = next(places, "")
    return " ".join(shown[:2] or [type(error).__name__]) + (f" in '{place:.100}'" if place else "")
