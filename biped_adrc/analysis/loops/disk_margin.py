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
from scipy.optimize import minimize

from biped_adrc.core.types import Array, ComplexArray

BALANCED = 10
"""Sweeps of Osborne's iteration, whose bounds decide for which frequencies mu is computed."""
TOP = 50
"""Number of matrices of largest norm whose spectral radius excludes frequencies with smaller mu."""
SMOOTH = (8, 64, 512)
"""Powers p of the norms (sum sigma^p)^(1/p), one after the other, for sigma_max, which is not smooth."""


def balanced_bound(M: ComplexArray) -> Array:
    """Upper bounds of mu (F,) of matrices M (F, p, p), by Osborne's scaling: fast, but not the least ones."""
    p = M.shape[-1]
    a = np.moveaxis(np.abs(M) ** 2, 0, -1) * (1.0 - np.eye(p))[..., np.newaxis]  # (p, p, F)
    d = np.ones((p, len(M)))
    for i in [*range(p)] * BALANCED:
        f = np.sqrt((a[:, i].sum(0) + 1e-300) / (a[i].sum(0) + 1e-300))
        a[i] *= f
        a[:, i] /= f
        d[i] *= np.sqrt(f)
    d = d.T
    return np.asarray(np.linalg.norm(d[:, :, np.newaxis] * M / d[:, np.newaxis], 2, axis=(-2, -1)))


def structured_value(M: ComplexArray) -> float:
    """Least upper bound of mu over scalings d of one matrix M (p, p)."""
    p = len(M)
    if p == 1:
        return float(abs(M[0, 0]))

    def scaled(x: Array) -> ComplexArray:
        d = np.exp(np.append(x, 0.0))
        return d[:, np.newaxis] * M / d

    def smooth(x: Array, power: float) -> tuple[float, Array]:
        """log of the norm of order `power` at log d = (x, 0), and its gradient (p - 1,)."""
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
    """alpha of sensitivities S (F, p, p) at F frequencies; infinite where S - 1/2 is zero at all of them."""
    M = S - 0.5 * np.eye(S.shape[1])
    rough = np.linalg.norm(M, axis=(-2, -1))  # Frobenius: mu is at most this, and at least a radius
    radius = np.max(np.abs(np.linalg.eigvals(M[np.argsort(-rough)[:TOP]])))
    M = M[rough >= (1.0 - 1e-9) * radius]
    bounds, largest = balanced_bound(M), 0.0
    for k in np.argsort(-bounds):
        if bounds[k] <= largest:
            break
        largest = max(largest, structured_value(M[k]))
    return 1.0 / largest if largest > 0.0 else np.inf
