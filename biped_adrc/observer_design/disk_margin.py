"""The multiloop disk margin: how much all motors may be wrong at once, in gain and in phase.

With S = (1 - G)^-1 the sensitivity of the torques u = G u, the loop bears every diagonal Delta in

    u_i -> (1 + Delta_i / 2) / (1 - Delta_i / 2) u_i,    |Delta_i| < alpha
    alpha = 1 / max_w mu(S(w) - 1/2)

(Seiler, Packard, Gahinet, IEEE Control Systems Magazine 40(5), 2020, skew 0). A margin alpha lets all gains
vary between (2 - alpha) / (2 + alpha) and its inverse, and all phases by +-2 atan(alpha / 2). mu is the
structured singular value of one complex number per motor; as usual its upper bound is taken,

    mu(M) <= min over d > 0 of sigma_max(diag(d) M diag(d)^-1)

which is mu itself for up to three motors, and on the safe side beyond.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import matrix_balance, schur
from scipy.optimize import minimize

from biped_adrc.errors import InputError
from biped_adrc.types import Array, ComplexArray

BALANCED = 30
"""Sweeps of Osborne's iteration over all frequencies at once, where the exact bound starts from."""
SMOOTH = (8, 64, 512)
"""Powers p of the norms (sum sigma^p)^(1/p) that stand for sigma_max, one after the other: where two
singular values meet, sigma_max has no gradient."""


def response(M: Array, B: Array, C: Array, D: Array, angles: Array) -> ComplexArray:
    """C (z - M)^-1 B + D (F, k, p) at z = exp(i angle), angles (F,) [rad] a sample.

    M (s, s) is balanced, since its states have units far apart, and brought to its triangular form once; then
    all frequencies are solved for at once.
    """
    balanced, (scale, _) = matrix_balance(M, permute=False, separate=True)
    T, U = schur(balanced, output="complex")
    z: ComplexArray = np.exp(1j * np.asarray(angles))
    b, c = U.conj().T @ (B.T / scale).T, (C * scale) @ U
    X = np.zeros((len(M), len(z), B.shape[1]), dtype=complex)
    for i in range(len(M) - 1, -1, -1):
        rest = b[i] + np.tensordot(T[i, i + 1 :], X[i + 1 :], 1)
        X[i] = rest / (z - T[i, i])[:, np.newaxis]
    found = np.tensordot(X, c, (0, 1)).transpose(0, 2, 1) + D
    return np.asarray(found, dtype=complex)


def balanced_bound(M: ComplexArray) -> Array:
    """Upper bounds of mu (F,) of matrices M (F, p, p), by Osborne's scaling: quick, not the least ones."""
    a = np.abs(M) ** 2
    p = M.shape[-1]
    for i in [*range(p)] * BALANCED:
        others = np.arange(p) != i
        row, column = a[:, i, others].sum(-1), a[:, others, i].sum(-1)
        f = np.sqrt((column + 1e-300) / (row + 1e-300))[:, np.newaxis]
        a[:, i, others] *= f
        a[:, others, i] /= f
    scaled = M * np.sqrt(a / np.maximum(np.abs(M) ** 2, 1e-300))
    return np.asarray(np.linalg.norm(scaled, 2, axis=(-2, -1)))


def structured_value(M: ComplexArray) -> float:
    """The least upper bound of mu of one matrix M (p, p)."""
    p = len(M)
    if p == 1:
        return float(abs(M[0, 0]))

    def scaled(x: Array) -> ComplexArray:
        d = np.exp(np.append(x, 0.0))
        return d[:, np.newaxis] * M / d

    def smooth(x: Array, power: float) -> tuple[float, Array]:
        """log of the norm of this power, and its gradient."""
        U, sigma, V = np.linalg.svd(scaled(x))
        weight = (sigma / sigma[0]) ** power
        slope = np.abs(U) ** 2 @ weight - (np.abs(V) ** 2).T @ weight
        value = np.log(sigma[0]) + np.log(weight.sum()) / power
        return float(value), slope[:-1] / weight.sum()

    x = np.zeros(p - 1)
    for power in SMOOTH:
        x = minimize(smooth, x, args=(power,), jac=True, method="BFGS").x
    return float(np.linalg.norm(scaled(x), 2))


def disk_margin(S: ComplexArray) -> float:
    """alpha of sensitivities S (F, p, p) at F frequencies; infinite where S - 1/2 is zero at all of them.

    Raises InputError for S that is not a row of square matrices, or not finite.
    """
    if np.ndim(S) != 3 or S.shape[1] != S.shape[2] or not np.all(np.isfinite(S)):
        raise InputError(
            f"the sensitivity has shape {np.shape(S)}, expected finite matrices (F, p, p), one per frequency"
        )
    M = S - 0.5 * np.eye(S.shape[1])
    bounds, largest = balanced_bound(M), 0.0
    for k in np.argsort(-bounds):
        if bounds[k] <= largest:
            break
        largest = max(largest, structured_value(M[k]))
    return 1.0 / largest if largest > 0.0 else np.inf
