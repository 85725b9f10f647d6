"""Functions on symbols: run once on CasADi's scalars in NumPy's object arrays, a function leaves an expression.

This is the first stage of the compiler: method -> expression (here) -> LLVM text (`engine.ir`) ->
machine code (`engine.machine`). The method is an ordinary one on NumPy arrays. `engine.tracer` makes a copy of
it, and of every function that it reaches, in which `np`, `math` and `core.linear` are replaced by twins that
make no float arrays and decide nothing by the numbers. The method's own lines are not rewritten.

Numbers of type int decide (sizes, flags) and are part of the expression's structure; floats are
symbols, to be given at run time, so that one compilation serves all values. What branches on
a symbol raises `NotCompiled`; np.where is the way to write such a choice.

Symbols are typed as the numbers and arrays that they stand for, since the functions that take them
are typed for numbers.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, Union

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from biped_adrc.core.part import content, is_part, with_content
from biped_adrc.core.types import Array, T, frozen, of_kind
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.structure import HIDDEN, LISTS, REALS, floats

_Number = Union["Scalar", float]
"""A symbol, or a number that is a constant of the expression."""


def expression(x: _Number) -> ca.SX | float:
    """The CasADi expression of a Scalar; a number itself, as a float. Raises NotCompiled for all else."""
    if isinstance(x, Scalar):
        return x.e
    try:
        return float(x)
    except (TypeError, ValueError) as error:
        raise NotCompiled(f"a law gives {x!r}, expected a real number") from error


def _binary(code: int, reflected: bool = False) -> Callable[[Scalar, _Number], Scalar]:
    """A method of `Scalar` for CasADi's operation `code`; reflected: with operands exchanged, as for 2.0 * x.

    Beside an array it returns NotImplemented, and NumPy then applies the operator entry by entry. CasADi's own
    operators take eight times as long, as they look for other types first.
    """

    def apply(self: Scalar, other: _Number) -> Scalar:
        if isinstance(other, np.ndarray):
            return NotImplemented
        one, two = self.e, expression(other)
        return Scalar(ca.SX.binary(code, two, one) if reflected else ca.SX.binary(code, one, two))

    return apply


def function_of(name: str) -> Callable[[_Number], Scalar]:
    """CasADi's function of that name for one Scalar."""
    code = getattr(ca, f"OP_{name.upper()}")
    return lambda x: Scalar(ca.SX.unary(code, expression(x)))


class Scalar:
    """One number of an expression; arithmetic with another Scalar or a float gives another Scalar.

    e: the CasADi expression. Turning it into a bool or a float raises NotCompiled, since that is
    where a method would decide by a number. Comparisons give Scalars that are 0 or 1, for np.where.
    """

    __slots__ = ("e",)

    def __init__(self, e: ca.SX | float):
        self.e = e

    def __bool__(self) -> bool:
        raise NotCompiled("the law branches on the value of a number")

    def __float__(self) -> float:
        raise NotCompiled("the law turns a number into a float of Python's or of an array's")

    def __pow__(self, other: _Number) -> Scalar:
        """A whole exponent stays an int, which CasADi turns into products; any other is a power."""
        if isinstance(other, np.ndarray):
            return NotImplemented
        if isinstance(other, int | float | np.number) and float(other).is_integer():
            return Scalar(self.e ** int(other))
        return Scalar(self.e ** expression(other))

    def __pos__(self) -> Scalar:
        return self

    def __hash__(self) -> int:
        raise NotCompiled("the law looks a number up in a dictionary or a set")

    __abs__, __neg__ = function_of("fabs"), function_of("neg")
    __add__, __radd__ = _binary(ca.OP_ADD), _binary(ca.OP_ADD, reflected=True)
    __sub__, __rsub__ = _binary(ca.OP_SUB), _binary(ca.OP_SUB, reflected=True)
    __mul__, __rmul__ = _binary(ca.OP_MUL), _binary(ca.OP_MUL, reflected=True)
    __truediv__, __rtruediv__ = _binary(ca.OP_DIV), _binary(ca.OP_DIV, reflected=True)
    __lt__, __le__ = _binary(ca.OP_LT), _binary(ca.OP_LE)
    # CasADi has no operation >: a > b is b < a
    __gt__, __ge__ = _binary(ca.OP_LT, reflected=True), _binary(ca.OP_LE, reflected=True)


# set from outside, since a type checker refuses an __eq__ that returns no bool; with Python's own, x == 0.0
# would be False for every symbol, and a law would be compiled with that answer
setattr(Scalar, "__eq__", _binary(ca.OP_EQ))  # noqa: B010
setattr(Scalar, "__ne__", _binary(ca.OP_NE))  # noqa: B010


def _compare(name: str) -> Callable[..., Any]:
    """NumPy's comparison `name` as a method whose result is an array of Scalars; NumPy's own result is one of
    bool.
    """
    return lambda self, other: getattr(np, name)(self, other, dtype=object)


class _Symbols(np.ndarray[tuple[int, ...], np.dtype[np.float64]]):
    """An object array of Scalars; comparisons give Scalars too, for `np.where`.

    Typed as the array of float64 that it stands for, so that methods take it.
    """

    __lt__, __le__ = _compare("less"), _compare("less_equal")
    __gt__, __ge__ = _compare("greater"), _compare("greater_equal")
    __hash__ = None

    def __array_wrap__(self, array: Array, *_: object) -> Any:
        """The result of an operation of NumPy: a `_Symbols`, or the symbol itself for an array without axes."""
        return array.item() if array.ndim == 0 else array.view(_Symbols)


def elementwise(function: Callable[..., Any]) -> Callable[..., Any]:
    """A function of scalars made into one of arrays and scalars, which acts entry by entry as NumPy's do; its
    result is an object array, or one entry where all arguments are scalars.
    """
    vectorised = np.frompyfunc(function, function.__code__.co_argcount, 1)
    # NumPy's own object would take `out=` too, and write into an array; the lambda takes no keywords
    return lambda *arguments: vectorised(*arguments)


_OF_ANGLES = ("sin", "cos", "tan")
_ALIKE = (*_OF_ANGLES, "sqrt", "exp", "log", "sinh", "cosh", "tanh", "fabs", "floor", "sign")
TWINS = {x: x for x in _ALIKE} | {f"arc{x}": f"a{x}" for x in _OF_ANGLES}
"""Functions of one number that can be traced: NumPy's names and CasADi's."""
# np.sin of an object array calls the method `sin` of each entry
for _name, _theirs in TWINS.items():
    setattr(Scalar, _name, function_of(_theirs))


def minimum(a: _Number, b: _Number) -> Scalar:
    """The smaller of two numbers; in machine code NaN where one of them is."""
    return Scalar(ca.SX.binary(ca.OP_FMIN, expression(a), expression(b)))


def maximum(a: _Number, b: _Number) -> Scalar:
    """The larger of two numbers; in machine code NaN where one of them is."""
    return Scalar(ca.SX.binary(ca.OP_FMAX, expression(a), expression(b)))


def where(condition: _Number, a: _Number, b: _Number) -> Scalar:
    """a where the condition is not 0, else b; at run time both are computed."""
    return Scalar(ca.if_else(expression(condition), expression(a), expression(b)))


def solve_positive(A: Array, B: Array, what: str) -> Array:
    """X (n, c) or (n,) with A X = B, B of the shape of X, for a symmetric positive definite A (n, n), by
    A = L d L' without pivoting: L lower triangular with ones on its diagonal, d diagonal.

    Written out entry by entry, since the expression has to be straight-line code. The argument `what` is not
    used: in the version for numbers, `linear.solve_positive`, it names the matrix in an error. Here a zero in d
    gives NaN or infinity at run time.
    """
    # columns: B, which becomes L^-1 B, then d^-1 L^-1 B, then X
    n = len(A)
    columns: Any = B.reshape(n, -1).astype(object)
    L = np.full((n, n), 0.0, dtype=object)
    d: list[_Number] = []
    inverse: list[_Number] = []
    for j in range(n):
        d.append(A[j, j] - sum(L[j, k] * L[j, k] * d[k] for k in range(j)))
        inverse.append(1.0 / d[j])
        for i in range(j + 1, n):
            L[i, j] = (A[i, j] - sum(L[i, k] * L[j, k] * d[k] for k in range(j))) * inverse[j]
    for i in range(n):
        for k in range(i):
            columns[i] = columns[i] - L[i, k] * columns[k]
    for i in reversed(range(n)):
        columns[i] = columns[i] * inverse[i]
        for k in range(i + 1, n):
            columns[i] = columns[i] - L[k, i] * columns[k]
    return columns.reshape(B.shape)


class SymbolicSolver:
    """`linear.solve` on symbols: elimination with the largest pivot of each column.

    Which row has the largest pivot is not known while tracing, so rows are exchanged by choices in
    the expression. The absolute values of all pivots are kept in `pivots`: an exact zero among them at run
    time means a singular matrix, which the kernels report as SINGULAR.
    """

    def __init__(self) -> None:
        self.pivots: list[Scalar] = []

    def __call__(self, A: Array, B: Array, what: str = "") -> Array:
        """X (n, c) or (n,) with A X = B, for A (n, n) and B of the shape of X; `what`, for errors on numbers,
        is not used.
        """
        n = len(A)
        if n == 0:
            return np.full(np.shape(B), 0.0, dtype=object)
        # rows of (A, B): elimination with an exchange of rows i and j where the entry of i is larger, then
        # substitution from the last row up
        rows: Any = np.hstack((A, B.reshape(n, -1))).astype(object)
        inverse: list[_Number] = []
        for j in range(n):
            for i in range(j + 1, n):
                one, other = rows[j, j:].copy(), rows[i, j:].copy()
                # Scalar(..): an entry may be a plain number, and `where` needs the comparison as a symbol
                swap = abs(Scalar(expression(other[0]))) > abs(Scalar(expression(one[0])))
                rows[j, j:], rows[i, j:] = wheres(swap, other, one), wheres(swap, one, other)
            self.pivots.append(abs(rows[j, j]))
            inverse.append(1.0 / rows[j, j])
            for i in range(j + 1, n):
                rows[i, j:] = rows[i, j:] - rows[i, j] * inverse[j] * rows[j, j:]
        X: Any = np.full((n, rows.shape[1] - n), 0.0, dtype=object)
        for i in reversed(range(n)):
            known = sum(rows[i, k] * X[k] for k in range(i + 1, n))
            X[i] = (rows[i, n:] - known) * inverse[i]
        return X.reshape(B.shape)

    @property
    def least(self) -> Scalar:
        """The smallest |pivot| of all systems solved so far, infinite without one; 0 means a singular matrix.
        Generated functions return it.
        """
        return functools.reduce(minimum, self.pivots, Scalar(ca.SX(math.inf)))


wheres: Callable[..., Any] = elementwise(where)
"""`where`, entry by entry."""


class Hidden:
    """A stand-in for an object that has no symbols: a robot, complex or random numbers. A law that uses it in
    any way raises NotCompiled; one that only holds it is compiled.
    """

    def __init__(self, what: str):
        """what: its name in the text of the error."""
        self._what = what

    def __getattr__(self, name: str) -> Any:
        raise NotCompiled(f"the law uses {self._what}, which has no form on symbols")

    # Python looks operators up in the class, past __getattr__, so each of them is named here
    __iter__ = __len__ = __add__ = __radd__ = __mul__ = __rmul__ = __array__ = __call__ = (
        lambda self, *_: self.__getattr__("")
    )


class Vector:
    """A flat vector of symbols (size,); `take` hands them out from the front, one array after the other.

    name: for CasADi's messages. symbol: CasADi's column (size, 1). `structure.floats` lists the numbers of
    parameters in the same order, so a generated function and its caller agree on the layout without writing it
    down.
    """

    def __init__(self, name: str, size: int):
        self.symbol = ca.SX.sym(name, size)
        self._taken = 0

    def take(self, *shape: int) -> Any:
        """The next symbols as a read-only object array of this shape; a Scalar for no shape."""
        if not shape:
            self._taken += 1
            return Scalar(self.symbol[self._taken - 1])
        out = np.empty(shape, dtype=object).view(_Symbols)
        for index in np.ndindex(*shape):
            out[index] = self.take()
        return frozen(out)

    def like(self, tree: T) -> T:
        """The same tree of parts, tuples and arrays with the next symbols in place of its floats.

        Whole numbers, and objects that are hidden from machine code (HIDDEN), stay as they are.
        """
        result: Any = tree
        if isinstance(tree, LISTS):
            result = of_kind(type(tree), [self.like(x) for x in tree])
        elif isinstance(tree, np.ndarray):
            result = self.take(*tree.shape) if tree.dtype.kind == "f" else tree
        elif is_part(tree) and not isinstance(tree, HIDDEN):
            result = with_content(tree, {name: self.like(x) for name, x in content(tree).items()})
        elif isinstance(tree, REALS):
            result = self.take()
        return result


def symbols_of(example: T) -> tuple[ca.SX, T]:
    """Symbols for the floats of a tree: CasADi's column K of them, and the tree with them in place of floats.

    K has one unused symbol at its end, so that it is never empty.
    """
    K = Vector("K", 1 + len(floats(example)))
    return K.symbol, K.like(example)


def column(*parts: ArrayLike | Scalar) -> ca.SX:
    """CasADi's column (size, 1) of all numbers in arrays and scalars, one after the other, rows first."""
    flat = [expression(x) for part in parts for x in np.asarray(part, dtype=object).ravel()]
    return ca.vertcat(*flat) if flat else ca.SX(0, 1)
