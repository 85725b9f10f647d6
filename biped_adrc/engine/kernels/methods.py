"""Tables of the one-step methods for the compiled loops, and the matrices of ETD-RK4 for a step and
its halvings.

    phi_0 = e^z,   phi_(j+1)(z) = (phi_j(z) - 1/j!) / z

An event or a sample instant rarely falls on a multiple of h, and a matrix exponential inside a
kernel would be slow. So steps to such a time are made of sub-steps h 2^-level, whose matrices are
computed here beforehand. By their series for steps so short that |hA| < 1/2, and doubled from
there:

    phi_0(2z) = phi_0^2                    phi_1(2z) = (phi_0 phi_1 + phi_1) / 2
    phi_2(2z) = (phi_0 phi_2 + phi_1 + phi_2) / 4
    phi_3(2z) = (phi_0 phi_3 + phi_1 / 2 + phi_2 + phi_3) / 8

by plain sums and not by BLAS, whose order of summation differs from machine to machine.
"""

from __future__ import annotations

import math

import numpy as np

from biped_adrc.engine.kernels import layout
from biped_adrc.engine.kernels.run_plan import MethodTable
from biped_adrc.errors import InputError, check_positive
from biped_adrc.hybrid.exponential import Phi, PhiTable
from biped_adrc.types import Array

TERMS = 24
"""Terms of the series; |z|^24 / 24! < 1e-30 for |z| < 1/2."""
STABLE = 0.1
"""Largest |lambda| h 2^-(levels - 1) [1] for which the classical step that ends a landing is taken
as stable.
"""


def rk4(h: float) -> MethodTable:
    """The classical method with step h [s]. Raises InputError."""
    check_positive(h, f"step h [s] is {h}")
    return MethodTable(layout.RK4, h=h)


def etd(h: float, A: Array, levels: int = 13) -> MethodTable:
    """ETD-RK4 with step h [s] for E' = A E + N_E, A (k, k) [1/s], N_E zero but in row 1.

    levels: the shortest sub-step of a landing is h 2^-(levels - 1). Raises InputError, also where
    the classical step below the shortest sub-step would not be stable.
    """
    check_positive(h, f"step h [s] is {h}")
    A = np.array(A, dtype=float)
    if A.ndim != 2 or A.shape[0] != A.shape[1] or len(A) < 2 or not np.all(np.isfinite(A)):
        raise InputError(f"A has shape {A.shape}, expected a square matrix of finite numbers")
    if not 1 <= levels <= 40:
        raise InputError(f"levels is {levels}, expected 1 to 40")
    shortest = h * 0.5 ** (levels - 1)
    fastest = float(np.max(np.abs(np.linalg.eigvals(A)), initial=0.0))
    if fastest * shortest > STABLE:
        raise InputError(
            f"the fastest pole is {fastest:.3g} rad/s and the shortest sub-step {shortest:.2e} s; "
            f"their product has to be below {STABLE}: give more levels or a shorter h"
        )
    return MethodTable(layout.ETD, h=h, phi=phi_levels(A, h, levels))


def _times(A: Array, B: Array) -> Array:
    """A B, both (k, k), by plain sums."""
    product: Array = np.einsum("ij,jk->ik", A, B)
    return product


def _series(Z: Array) -> Phi:
    """phi_0 to phi_3 of a small Z (k, k), each by Horner's rule."""
    one = np.eye(len(Z))

    def phi(j: int) -> Array:
        total = one / math.factorial(TERMS + j)
        for i in reversed(range(TERMS)):
            total = one / math.factorial(i + j) + _times(Z, total)
        return total

    return phi(0), phi(1), phi(2), phi(3)


def _doubled(phi: Phi) -> Phi:
    """phi_0 to phi_3 of 2z from those of z, each (k, k)."""
    p0, p1, p2, p3 = phi
    return (
        _times(p0, p0),
        0.5 * (_times(p0, p1) + p1),
        0.25 * (_times(p0, p2) + p1 + p2),
        0.125 * (_times(p0, p3) + 0.5 * p1 + p2 + p3),
    )


def phi_levels(A: Array, h: float, levels: int) -> Array:
    """The six matrices of `hybrid.exponential.PhiTable` for h 2^-level, (levels, 6, k, k); A (k, k)
    [1/s], h [s].
    """
    size = float(np.max(np.sum(np.abs(A), axis=1), initial=0.0)) * h
    short = max(0, math.ceil(math.log2(2.0 * size))) if size > 0.0 else 0
    phi = _series(A * (h * 0.5 ** max(short, levels)))
    table = np.zeros((levels, layout.MATRICES, *A.shape))
    for level in reversed(range(max(short, levels))):
        half, phi = phi, _doubled(phi) if level < short else _series(A * (h * 0.5**level))
        if level < levels:
            table[level] = PhiTable.of(half, phi, h * 0.5**level)
    return table
