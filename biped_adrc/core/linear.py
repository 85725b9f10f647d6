"""Small dense linear systems A X = B, solved by LAPACK directly.

For matrices of a few rows `numpy.linalg.solve` spends most of its time on checks; dgesv (LU factors
with partial pivoting) is called without them. Control laws call `solve` and `solve_positive` by name: the
tracer, which turns laws into machine code, knows them and generates unrolled code in their place.

`sorted_eigenvalues` is NumPy's `eigvals`, in order.

SciPy's module of LAPACK is loaded alone, as the package around it takes a third of the time of a short walk.
"""

import sys
from importlib import import_module
from importlib.machinery import PathFinder
from importlib.util import find_spec, module_from_spec
from typing import Any

import numpy as np

from biped_adrc.core.errors import SingularError
from biped_adrc.core.types import Array, ComplexArray


def _lapack() -> Any:
    """SciPy's module of LAPACK, loaded without the package around it where that is possible."""
    name = "scipy.linalg._flapack"
    scipy: Any = find_spec("scipy")
    folders = [f"{folder}/linalg" for folder in scipy.submodule_search_locations]
    spec: Any = PathFinder.find_spec(name, folders)
    if spec is None:
        return import_module("scipy.linalg.lapack")
    if name not in sys.modules:
        sys.modules[name] = module_from_spec(spec)
        spec.loader.exec_module(sys.modules[name])
    return sys.modules[name]


lapack = _lapack()
dgesv = lapack.dgesv


def solve(A: Array, B: Array, what: str) -> Array:
    """Solve A X = B for X (k,) or (k, c).

    A (k, k): the matrix, in any units. B (k,) or (k, c): the right-hand side, in any units. what: names A in
    the message, such as "the decoupling matrix". Raises SingularError when a pivot is exactly zero; a badly
    conditioned A is solved without a warning.

    >>> ba.solve(np.diag([2.0, 4.0]), np.array([2.0, 4.0]), "the inertia")
    array([1., 1.])
    """
    if len(A) == 0:  # an empty system, which LAPACK does not take
        return np.zeros_like(B)
    # also returned, not used: the LU factors and the order of the rows
    _, _, X, info = dgesv(A, B)
    if info != 0:
        raise SingularError(f"{what} is singular: pivot {info} of its LU factors is zero")
    return X


def solve_positive(A: Array, B: Array, what: str) -> Array:
    """Solve A X = B for X (k,) or (k, c), with A (k, k) symmetric and positive definite, such as an inertia.

    B (k,) or (k, c): the right-hand side. what: names A in the SingularError. In Python this is `solve`. The
    engine, which makes machine code, generates the factors A = L d L' for it, whose pivots d are all positive:
    compiled code then has no search for pivots, hence no branch.
    """
    return solve(A, B, what)


def sorted_eigenvalues(matrix: Array) -> ComplexArray:
    """Eigenvalues (k,) of a matrix (k, k), the largest magnitude first."""
    values = np.linalg.eigvals(matrix).astype(complex)
    return values[np.argsort(-np.abs(values))]
