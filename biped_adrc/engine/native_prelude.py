"""What every composed module begins and ends with: loops in place of BLAS, and the C function itself."""

from __future__ import annotations

PRELUDE = '''"""A law and what it reaches; written from their sources, and again when one is changed."""

import math
from collections import namedtuple

import numpy as np
from numba import carray, njit, types
from numba.core.cgutils import gep
from numba.extending import intrinsic, overload

jit = njit(error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True)
law = njit(inline="always", error_model="numpy", no_cpython_wrapper=True)


@intrinsic
def _at(context, pointer, i):
    return pointer(pointer, types.intp), lambda _, builder, __, x: gep(builder, x[0], x[1])


@jit
def _whole(x):
    out = np.empty(x.shape, np.int64)
    for i, a in np.ndenumerate(x):
        out[i] = int(a)
    return out


@jit
def _dot(a, b):
    if len(a) != len(b):
        raise ValueError("a @ b of different lengths")
    total = 0.0
    for i in range(len(a)):
        total += a[i] * b[i]
    return total


@jit
def _times(A, b):
    if A.shape[1] != len(b):
        raise ValueError("A @ b of different lengths")
    out = np.zeros(A.shape[0])
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            out[i] += A[i, j] * b[j]
    return out


@jit
def _row_times(a, B):
    if B.shape[0] != len(a):
        raise ValueError("a @ B of different lengths")
    out = np.zeros(B.shape[1])
    for i in range(B.shape[0]):
        for j in range(B.shape[1]):
            out[j] += a[i] * B[i, j]
    return out


@jit
def _product(A, B):
    if A.shape[1] != B.shape[0]:
        raise ValueError("A @ B of different lengths")
    out = np.zeros((A.shape[0], B.shape[1]))
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            for k in range(B.shape[1]):
                out[i, k] += A[i, j] * B[j, k]
    return out


def _matmul(a, b):
    pass


@overload(_matmul, jit_options={"error_model": "numpy"})
def _choose_matmul(a, b):
    kinds = {(1, 1): _dot, (2, 1): _times, (1, 2): _row_times, (2, 2): _product}
    chosen = kinds.get((getattr(a, "ndim", 0), getattr(b, "ndim", 0)))
    return chosen and (lambda a, b: chosen(a, b))


@jit
def _factors(A):
    """L and U in one matrix and the order of its rows; NaN for a singular one."""
    n = A.shape[0]
    LU, order = np.empty((n, n)), np.arange(n)
    for i in range(n):
        for j in range(n):
            LU[i, j] = A[i, j]
    for i in range(n):
        best = i
        for j in range(i + 1, n):
            if abs(LU[j, i]) > abs(LU[best, i]):
                best = j
        if LU[best, i] == 0.0:
            LU[best, i] = np.nan
        order[i], order[best] = order[best], order[i]
        for k in range(n):
            LU[i, k], LU[best, k] = LU[best, k], LU[i, k]
        for j in range(i + 1, n):
            LU[j, i] /= LU[i, i]
            for k in range(i + 1, n):
                LU[j, k] -= LU[j, i] * LU[i, k]
    return LU, order


@jit
def _substitute(LU, order, b, x):
    n = len(order)
    for i in range(n):
        x[i] = b[order[i]]
        for j in range(i):
            x[i] -= LU[i, j] * x[j]
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            x[i] -= LU[i, j] * x[j]
        x[i] /= LU[i, i]


@jit
def _solve_one(A, b):
    LU, order = _factors(A)
    x = np.empty(len(b))
    _substitute(LU, order, b, x)
    return x


@jit
def _solve_columns(A, B):
    LU, order = _factors(A)
    X = np.empty(B.shape)
    for k in range(B.shape[1]):
        _substitute(LU, order, B[:, k], X[:, k])
    return X


def _solve(A, B, what=""):
    pass


@overload(_solve, jit_options={"error_model": "numpy"})
def _choose_solve(A, B, what=""):
    chosen = _solve_one if B.ndim == 1 else _solve_columns
    return lambda A, B, what="": chosen(A, B)


def _put(out, at, x):
    pass


@overload(_put, jit_options={"error_model": "numpy"})
def _choose_put(out, at, x):
    """Write x from place `at` on; the place after it."""
    if isinstance(x, types.Number | types.Boolean):

        def put(out, at, x):
            if at < len(out):
                out[at] = x
            return at + 1
    elif isinstance(x, types.Array):

        def put(out, at, x):
            for a in x.flat:
                if at < len(out):
                    out[at] = a
                at += 1
            return at
    elif isinstance(x, types.BaseTuple) and len(x) == 0:

        def put(out, at, x):
            return at
    elif isinstance(x, types.BaseTuple):

        def put(out, at, x):
            return _put(out, _put(out, at, x[0]), x[1:])
    else:
        return None
    return put
'''
ENTRY = """
def entry(_K, _inp, _out):
    _k, _x, _y = carray(_K, ({K},)), carray(_inp, ({inp},)), carray(_out, ({out},))
    for _i in range({out}):
        _y[_i] = np.nan
    if _put(_y, 0, {law}({arguments})) != {out}:
        for _i in range({out}):
            _y[_i] = np.nan
"""
GUARD = """
unguarded = jit(entry)


def entry(_K, _inp, _out):
    try:
        unguarded(_K, _inp, _out)
    except Exception:
        pass
"""
