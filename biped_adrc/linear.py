"""Small dense linear systems, without the overhead of `numpy.linalg` for matrices of a few rows."""

from __future__ import annotations

import numpy as np
from scipy.linalg.lapack import dgesv

from biped_adrc.errors import SingularError
from biped_adrc.types import Array


def solve(A: Array, B: Array, what: str) -> Array:
    """X with A X = B, for A (k, k) and B (k,) or (k, c).

    Raises SingularError that names `what` when A is singular.
    """
    if len(A) == 0:
        return np.zeros_like(B)
    _, _, X, info = dgesv(A, B)
    if info != 0:
        raise SingularError(f"{what} is singular: pivot {info} of its LU factors is zero")
    return X


def solve_positive(A: Array, B: Array, what: str) -> Array:
    """`solve` for a symmetric positive definite A, which needs no pivots where code is generated for it."""
    return solve(A, B, what)
