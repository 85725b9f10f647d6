"""Frequency responses C (z - M)^-1 B + D of sampled systems, of many at once, at many frequencies at once.

M is balanced, since its states have units far apart, and brought to its triangular form once; then all
frequencies are solved for at once, row by row.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.linalg import matrix_balance, schur

from biped_adrc.types import Array, ComplexArray


class Response(NamedTuple):
    """Systems with leading axes (..), of s states, m inputs and p outputs, in triangular form."""

    T: ComplexArray
    """(.., s, s), upper triangular: U^H M U of the balanced M."""
    B: ComplexArray
    """(.., s, m)."""
    C: ComplexArray
    """(.., p, s)."""
    D: Array
    """(.., p, m)."""

    @classmethod
    def of(cls, M: Array, B: Array, C: Array, D: Array) -> Response:
        """Of systems M (.., s, s), B (.., s, m), C (.., p, s), D (.., p, m)."""
        T, b, c = (np.zeros(np.shape(x), dtype=complex) for x in (M, B, C))
        for at in np.ndindex(np.shape(M)[:-2]):
            if M.shape[-1] == 0:
                break
            balanced, (scale, _) = matrix_balance(M[at], permute=False, separate=True)
            T[at], U = schur(balanced, output="complex")
            b[at], c[at] = U.conj().T @ (B[at].T / scale).T, (C[at] * scale) @ U
        return cls(T, b, c, np.asarray(D))

    def at(self, angles: Array) -> ComplexArray:
        """(.., F, p, m) at z = exp(i angle), angles (.., F) [rad] a sample."""
        z: ComplexArray = np.exp(1j * angles)
        s, m = self.B.shape[-2:]
        *axes, F = np.broadcast_shapes(z.shape, (*self.B.shape[:-2], z.shape[-1]))
        X = np.zeros((*axes, s, F, m), dtype=complex)
        for i in range(s - 1, -1, -1):
            later = X[..., i + 1 :, :, :].reshape(*axes, s - i - 1, F * m)
            rest = (self.T[..., i : i + 1, i + 1 :] @ later).reshape(*axes, F, m)
            pivot = (z - self.T[..., i, i, np.newaxis])[..., np.newaxis]
            X[..., i, :, :] = (self.B[..., i, np.newaxis, :] + rest) / pivot
        found = self.C @ X.reshape(*axes, s, F * m)
        found = found.reshape(*axes, -1, F, m).swapaxes(-3, -2)
        return np.asarray(found + self.D[..., np.newaxis, :, :])
