"""Pointers, calls of C functions by their addresses at run time, and how the loops are compiled.

The loops (of a walk through time, `hybrid.march`) work on pointers, written and read as arrays are; a vector is
a pointer to its first number. A run r is a pointer to its cells, and r.name the field of that name (`record`).
Generated functions are called by an address that is data of the run, so the loops are compiled once for all
walkers.

Functions with the decorator `inner` are compiled into each of their callers; those with `unit` are compiled
once and called by their name, which keeps the compile time down. The annotations of units are read as their
signatures (int, float, Run, Ints, Array), so numba compiles none of them for the types of a call.

An intrinsic is a function whose instructions are written here, in place of numba: numba calls it with the types
of the arguments, and it returns its signature and a function `codegen` that writes LLVM's instructions.
typingctx and context are numba's own and not read; a `builder` of llvmlite appends instructions, on values x.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
from llvmlite import ir
from numba import extending
from numba.core.imputils import lower_getattr_generic, lower_setattr_generic
from numba.core.types import Type
from numba.core.typing.templates import AttributeTemplate, Signature, infer_getattr

from biped_adrc.engine.kernels.record import KINDS, PLACES

_Function = TypeVar("_Function", bound=Callable[..., object])
"""A function that keeps its type through a decorator."""


Generated = tuple[Signature, Callable[..., ir.Value]]
"""The result of an intrinsic: its signature, and the function that writes its instructions."""


Context = Any
"""numba.core.base.BaseContext, whose methods have no annotations."""
njit: Any = numba.njit
intrinsic: Callable[[Callable[..., Generated]], Callable[..., Any]] = extending.intrinsic
types: Any = numba.types

UNITS: dict[str, tuple[str, Signature, Callable[..., object]]] = {}
"""Name of each unit -> its symbol in the machine code, signature and function, in an order in which each one
comes after those that it calls."""
_CELLS = types.CPointer(types.int64)
_TYPES = {
    "int": types.int64,
    "float": types.float64,
    "None": types.void,
    "Run": _CELLS,
    "Ints": _CELLS,
    "Array": types.CPointer(types.float64),
}
"""numba's types by annotation; a run and vectors are pointers."""


def inner(function: _Function) -> _Function:
    """Decorator for a small function, which is compiled into the units that call it."""
    # error_model: a division by zero gives infinity or NaN, as in NumPy, and no error; no wrappers for calls
    # from Python, since nothing there calls it
    return njit(error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True)(function)


def unit(function: _Function) -> _Function:
    """Decorator for a C function of its own, which `kernels.load` compiles; its annotations are its signature.

    The name in Python becomes numba's reference to that C function, so callers do not compile it again.
    """
    # strings, by `from __future__ import annotations`; without it Run would be the class of Python, no pointer
    *arguments, result = (_TYPES[hint] for hint in function.__annotations__.values())
    symbol, signature = f"biped_adrc.{function.__name__}", result(*arguments)
    # _TYPES: annotation -> numba's type; UNITS: all units, which `load` compiles
    UNITS[function.__name__] = symbol, signature, function
    return types.ExternalFunction(symbol, signature)


@intrinsic
def call(typingctx: object, address: Type, K: Type, inp: Type, out: Type) -> Generated:
    """Intrinsic that calls the function `void f(double* K, double* inp, double* out)` at `address`."""

    def codegen(
        context: Context, builder: ir.IRBuilder, signature: Signature, arguments: list[ir.Value]
    ) -> ir.Value:
        pointer = ir.DoubleType().as_pointer()
        kind = ir.FunctionType(ir.VoidType(), [pointer] * 3).as_pointer()
        builder.call(builder.inttoptr(arguments[0], kind), arguments[1:])
        return context.get_dummy_value()  # numba's value of a function that returns nothing

    return types.void(types.int64, K, inp, out), codegen


@intrinsic
def shift(typingctx: object, pointer: Type, i: Type) -> Generated:
    """Intrinsic: the pointer to entry i of the vector at `pointer`, as &pointer[i] in C (`gep` in LLVM)."""
    signature = pointer(pointer, types.int64)
    return signature, lambda context, builder, signature, x: builder.gep(x[0], [x[1]])


@intrinsic
def run_at(typingctx: object, address: Type) -> Generated:
    """Intrinsic: an address, a whole number, as a pointer to a run."""
    pointer = ir.IntType(64).as_pointer()
    signature = _CELLS(types.int64)
    return signature, lambda context, builder, signature, x: builder.inttoptr(x[0], pointer)


@intrinsic
def cell_of(typingctx: object, vector: Type) -> Generated:
    """Intrinsic: a vector as whole numbers."""
    pointer = ir.IntType(64).as_pointer()
    return _CELLS(vector), lambda context, builder, signature, x: builder.bitcast(x[0], pointer)


# -- fields of a run -------------------------------------------------------------------------------
class _Fields(AttributeTemplate):
    """Tells numba the type of r.name, for a run r."""

    key = types.CPointer

    def generic_resolve(self, run: Type, name: str) -> Any:  # type: ignore[override]
        """numba's type of the field `name` of a value of the type `run`; None where that is no run or has no
        such field.
        """
        # KINDS: kind of each field, by name; _CELLS: numba's type of a run, a pointer to its cells
        return _TYPES[KINDS[name]] if run == _CELLS and name in KINDS else None


def _cell(builder: ir.IRBuilder, run: ir.Value, name: str) -> ir.Value:
    """Write the instructions for a pointer to a field's cell: to a double for a float, else to an int64."""
    # PLACES, KINDS: number of the cell and kind of each field, by name
    cell = builder.gep(run, [ir.Constant(ir.IntType(64), PLACES[name])])
    return builder.bitcast(cell, ir.DoubleType().as_pointer()) if KINDS[name] == "float" else cell


def _read(
    context: Context, builder: ir.IRBuilder, kind: Type, run: ir.Value, name: str
) -> ir.Value:
    """Write the instructions for reading r.name: a number, or for a vector the pointer to its first number."""
    value = builder.load(_cell(builder, run, name))
    if KINDS[name] in ("int", "float"):
        return value
    number = ir.DoubleType() if KINDS[name] == "Array" else ir.IntType(64)
    return builder.inttoptr(value, number.as_pointer())


def _write(context: Context, builder: ir.IRBuilder, signature: Any, x: Any, name: str) -> None:
    """Write the instructions for r.name = value, where x is (r, value); of a vector the address is stored."""
    number = KINDS[name] in ("int", "float")
    value = x[1] if number else builder.ptrtoint(x[1], ir.IntType(64))
    builder.store(value, _cell(builder, x[0], name))


# numba knows no attributes of a pointer. With these three r.x0 reads a cell, and the march can use the same
# words for a run in memory as for the object `on_arrays.Run`.
cast(Any, infer_getattr)(_Fields)
cast(Any, lower_getattr_generic)(types.CPointer)(_read)
cast(Any, lower_setattr_generic)(types.CPointer)(_write)
