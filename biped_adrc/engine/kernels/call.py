"""Pointers, calls of C functions by their addresses at run time, and how the loops are compiled.

The loops work on pointers, written and read as arrays are; a vector is a pointer to its first
number. A run r is a pointer to its cells, and r.name the field of that name (`record`). Generated functions are
called by an address that is data of the run, so the loops are compiled once for all walkers.

There are three decorators. `inner` functions are compiled into each of their callers, those of `unit` once
each and called by their symbol, which keeps the compile time down; those of `kernel` are what Python calls.
The annotations of units and kernels are read as their signatures (int, float, Ints, Array, Rows),
so nothing is compiled for types seen at run time.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeVar

import numba
import numpy as np
from llvmlite import binding, ir
from numba import extending
from numba.core.dispatcher import Dispatcher
from numba.core.imputils import lower_getattr_generic, lower_setattr_generic
from numba.core.types import Type
from numba.core.typing.templates import AttributeTemplate, Signature, infer_getattr
from numpy.typing import NDArray

from biped_adrc.engine.kernels.record import KINDS, PLACES

Rows = NDArray[np.float64]
_Function = TypeVar("_Function", bound=Callable[..., object])
"""A function that keeps its type through a decorator."""


Generated = tuple[Signature, Callable[..., ir.Value]]
"""What an intrinsic gives numba: its signature, and the function that writes its instructions."""


Context = Any
"""numba.core.base.BaseContext, whose methods have no annotations."""
njit: Any = numba.njit
cfunc: Any = numba.cfunc
types: Any = numba.types

KERNELS: list[Dispatcher] = []
"""All kernels, to be compiled."""
UNITS: dict[str, tuple[Signature, Callable[..., object]]] = {}
"""By symbol: the signature and the function, in the order in which they need each other."""
ADDRESSES: dict[str, int] = {}
"""Of the units in memory, by name."""
_NUMBERS = {"int": types.int64, "float": types.float64, "None": types.void}
"""numba's types by the annotations of numbers."""
_CELLS = types.CPointer(types.int64)
_POINTERS = {"Run": _CELLS, "Ints": _CELLS, "Array": types.CPointer(types.float64)}
"""Of a run and of vectors, in units."""
_ARRAYS = {"Ints": types.int64[::1], "Array": types.float64[::1], "Rows": types.float64[:, ::1]}
"""Of vectors and matrices, in kernels."""
_KEEP: list[object] = []


def intrinsic(function: Callable[..., Generated]) -> Callable[..., Any]:
    """numba's decorator for a function that is written in LLVM's instructions."""
    made: Any = extending.intrinsic
    return made(function)


def kernel(function: _Function) -> _Function:
    """Callable from Python without the GIL, with arrays, once `compile_those` has run."""
    made: Any = njit(nogil=True, error_model="numpy", cache=True)(function)
    KERNELS.append(made)
    return made


def inner(function: _Function) -> _Function:
    """Compiled into the units and kernels that call it, and kept on disk with them; for small functions."""
    return njit(
        nogil=True,
        error_model="numpy",
        no_cpython_wrapper=True,
        no_cfunc_wrapper=True,
    )(function)


def _signature(
    function: Callable[..., object], kinds: Mapping[str, Type]
) -> tuple[list[Type], Any]:
    """numba's types of the arguments and of the result (None for none known), from the annotations."""
    known = {**_NUMBERS, **kinds}
    hints = function.__annotations__
    return [known[hint] for name, hint in hints.items() if name != "return"], known.get(
        hints["return"]
    )


def unit(function: _Function) -> _Function:
    """A C function with a symbol of its own, once `compile_those` has run; its annotations are its signature.

    What it is given comes back as a reference to that symbol, so callers do not compile it again.
    """
    arguments, result = _signature(function, _POINTERS)
    signature = result(*arguments)
    symbol = f"{function.__module__}.{function.__name__}"
    UNITS[symbol] = signature, function
    return types.ExternalFunction(symbol, signature)


def compile_those(chosen: Callable[[str], bool]) -> None:
    """The machine code of units and kernels by name, from the disk if it is there; no more is compiled after.

    Units come first, in the order in which they need each other: a kernel links to their symbols.
    """
    for symbol, (signature, function) in UNITS.items():
        if not chosen(function.__name__):
            continue
        compiled = cfunc(signature, cache=True, error_model="numpy")(function)
        _KEEP.append(compiled)
        ADDRESSES[symbol.rpartition(".")[2]] = compiled.address
        binding.add_symbol(symbol, compiled.address)
    for made in KERNELS:
        if not chosen(made.py_func.__name__):
            continue
        made.compile(tuple(_signature(made.py_func, _ARRAYS)[0]))
        made.disable_compile()


def _pointer(context: Context, builder: ir.IRBuilder, kind: Type, value: ir.Value) -> ir.Value:
    """The first address of an array; a pointer as it is."""
    if isinstance(kind, types.Array):
        return context.make_array(kind)(context, builder, value).data
    return value


@intrinsic
def call(typingctx: object, address: Type, K: Type, inp: Type, out: Type) -> Generated:
    """Call `void f(double* K, double* inp, double* out)` at `address`, with pointers or arrays of float64."""

    def codegen(
        context: Context, builder: ir.IRBuilder, signature: Signature, arguments: list[ir.Value]
    ) -> ir.Value:
        double = ir.DoubleType().as_pointer()
        kind = ir.FunctionType(ir.VoidType(), [double] * 3).as_pointer()
        pairs = zip(signature.args[1:], arguments[1:], strict=True)
        pointers = [_pointer(context, builder, *pair) for pair in pairs]
        builder.call(builder.inttoptr(arguments[0], kind), pointers)
        return context.get_dummy_value()

    return types.void(types.int64, K, inp, out), codegen


@intrinsic
def data(typingctx: object, array: Any) -> Generated:
    """Pointer to the first number of an array."""

    def codegen(
        context: Context, builder: ir.IRBuilder, signature: Signature, arguments: list[ir.Value]
    ) -> ir.Value:
        return _pointer(context, builder, signature.args[0], arguments[0])

    return types.CPointer(array.dtype)(array), codegen


@intrinsic
def shift(typingctx: object, pointer: Type, i: Type) -> Generated:
    """Pointer to entry i of what `pointer` points to."""

    def codegen(
        context: Context, builder: ir.IRBuilder, signature: Signature, arguments: list[ir.Value]
    ) -> ir.Value:
        return builder.gep(arguments[0], [arguments[1]])

    return pointer(pointer, types.int64), codegen


def _pointer_at(number: Type, kind: ir.Type) -> Callable[..., Any]:
    """An intrinsic from an address (int64) to a pointer to numbers of this type."""

    def at(typingctx: object, address: Type) -> Generated:
        def codegen(
            context: Context,
            builder: ir.IRBuilder,
            signature: Signature,
            arguments: list[ir.Value],
        ) -> ir.Value:
            return builder.inttoptr(arguments[0], kind.as_pointer())

        return types.CPointer(number)(types.int64), codegen

    return intrinsic(at)


floats_at = _pointer_at(types.float64, ir.DoubleType())
"""Pointer to the float64 at an address."""
ints_at = _pointer_at(types.int64, ir.IntType(64))
"""Pointer to the int64 at an address."""


# -- fields of a run -------------------------------------------------------------------------------
class _Fields(AttributeTemplate):
    """Types of r.name, for a run r."""

    key = types.CPointer

    def generic_resolve(self, run: Type, name: str) -> Any:  # type: ignore[override]
        """numba's type of a field; None for a pointer to something else, or another name."""
        return {**_NUMBERS, **_POINTERS}[KINDS[name]] if run == _CELLS and name in KINDS else None


def _cell(builder: ir.IRBuilder, run: ir.Value, name: str) -> ir.Value:
    """Pointer to the cell of a field, of the field's own kind."""
    cell = builder.gep(run, [ir.Constant(ir.IntType(64), PLACES[name])])
    return builder.bitcast(cell, ir.DoubleType().as_pointer()) if KINDS[name] == "float" else cell


def _read(
    context: Context, builder: ir.IRBuilder, kind: Type, run: ir.Value, name: str
) -> ir.Value:
    """r.name"""
    value = builder.load(_cell(builder, run, name))
    if KINDS[name] in ("int", "float"):
        return value
    number = ir.DoubleType() if KINDS[name] == "Array" else ir.IntType(64)
    return builder.inttoptr(value, number.as_pointer())


def _write(
    context: Context, builder: ir.IRBuilder, signature: Signature, arguments: Any, name: str
) -> None:
    """r.name = value"""
    builder.store(arguments[1], _cell(builder, arguments[0], name))


_infer: Any = infer_getattr
_getattr: Any = lower_getattr_generic
_setattr: Any = lower_setattr_generic
_infer(_Fields)
_getattr(types.CPointer)(_read)
_setattr(types.CPointer)(_write)
