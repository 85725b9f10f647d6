"""What acts from outside on a plant that moves by itself, by machine code, in one state or at many."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.engine.compiled_biped import pointer_call
from biped_adrc.engine.compiled_walker import term_code
from biped_adrc.engine.machine import LoadedCode
from biped_adrc.engine.symbols import floats
from biped_adrc.types import Array

_LAW = ctypes.PYFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)


class CompiledPush:
    """By the machine code of a disturbance. Raises NotCompiled for one without.

    f(K, inp, out) is called for each torque and each resultant; the rows of `out` are (zeta, force) (n + 2,).
    """

    def __init__(self, disturbance: Disturbance, n: int):
        """n: number of coordinates."""
        self.inp, self.terms = np.zeros(3 + 2 * n), terms_of(disturbance, n)
        self.out = np.zeros((len(self.terms), n + 2))
        given, places = self.inp.ctypes.data, {"torque": 0, "resultant": n}
        self.calls = [
            (_LAW(code.addresses[name]), (K.ctypes.data, given, row[at:].ctypes.data))
            for (code, K), row in zip(self.terms, self.out, strict=True)
            for name, at in places.items()
            if name in code.addresses
        ]

    def __call__(self, t: float, row: Array, mode: Mode) -> Array:
        """zeta and force (n + 2,) at t [s] for a row (q, q', ..) of a plant."""
        inp = self.inp
        inp[0], inp[1], inp[2] = t, mode.step, mode.start
        inp[3:] = row[: len(inp) - 3]
        for function, given in self.calls:
            function(*given)
        return self.out.sum(axis=0) if len(self.out) > 1 else self.out[0].copy()

    def zetas(self, t: Array, rows: Array, mode: Mode) -> Array:
        """zeta (K, n) [N m] at K times [s] for rows (q, q', ..) of a plant."""
        n = (len(self.inp) - 3) // 2
        return summed(self.terms, t, rows[:, :n], rows[:, n : 2 * n], mode)


def summed(
    terms: Sequence[tuple[LoadedCode, Array]], t: Array, q: Array, v: Array, mode: Mode
) -> Array:
    """zeta (K, n) [N m] at K times [s], q (K, n) [rad], v (K, n) [rad/s]: of code and numbers of each term."""
    ones = np.ones((len(t), 1))
    inp = np.hstack((t[:, np.newaxis], mode.step * ones, mode.start * ones, q, v))
    total, out = np.zeros(q.shape), np.empty(q.shape)
    for code, K in terms:
        pointer_call(code, "torque", K, inp, out)
        total += out
    return total


def terms_of(disturbance: Disturbance | None, n: int) -> list[tuple[LoadedCode, Array]]:
    """Machine code and numbers of each term, for n coordinates. Raises NotCompiled for a term without."""
    terms = () if disturbance is None else disturbance.terms
    return [(term_code(term, n), np.array([*floats(term), 0.0])) for term in terms]
