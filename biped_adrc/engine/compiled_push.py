"""What acts from outside on a plant that moves by itself, asked for in one state or at many.

`PythonPush` asks the loop's disturbance, `CompiledPush` its terms in machine code (`engine.compiled_walker`);
both give the same.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.stepping_plant import Load
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.engine.compiled_biped import pointer_call
from biped_adrc.engine.compiled_walker import term_code
from biped_adrc.engine.machine import LoadedCode
from biped_adrc.engine.symbols import floats
from biped_adrc.types import Array

_LAW = ctypes.PYFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)


class PlantPush(Protocol):
    """What acts from outside, in any form."""

    def load(self, t: float, q: Array, v: Array, mode: Mode) -> Load | None:
        """At t [s], q (n,) [rad], v (n,) [rad/s]; None for nothing."""

    def zeta(self, t: Array, q: Array, v: Array, mode: Mode) -> Array:
        """zeta (K, n) [N m] at K times [s], q (K, n) [rad], v (K, n) [rad/s]."""


@dataclass(frozen=True)
class PythonPush:
    """By the methods of the loop, whose disturbance may be none."""

    loop: SteppingLoop

    def load(self, t: float, q: Array, v: Array, mode: Mode) -> Load | None:
        """At t [s], q (n,) [rad], v (n,) [rad/s]; None without a disturbance."""
        return None if self.loop.disturbance is None else self.loop.load(t, q, v, mode)

    def zeta(self, t: Array, q: Array, v: Array, mode: Mode) -> Array:
        """zeta (K, n) [N m] at K times [s], q (K, n) [rad], v (K, n) [rad/s]."""
        if self.loop.disturbance is None:
            return np.zeros_like(q)
        return np.array([self.loop.external(*at, mode) for at in zip(t, q, v, strict=True)])


class CompiledPush:
    """By the machine code of a disturbance. Raises NotCompiled for one without.

    f(K, inp, out) is called for each torque and each resultant; the rows of `out` are (zeta, force) (n + 2,).
    """

    def __init__(self, loop: SteppingLoop, disturbance: Disturbance):
        n = loop.plant.n
        self.loop, self.inp, self.terms = loop, np.zeros(3 + 2 * n), terms_of(disturbance, n)
        self.out = np.zeros((len(self.terms), n + 2))
        given, places = self.inp.ctypes.data, {"torque": 0, "resultant": n}
        self.calls = [
            (_LAW(code.addresses[name]), (K.ctypes.data, given, row[at:].ctypes.data))
            for (code, K), row in zip(self.terms, self.out, strict=True)
            for name, at in places.items()
            if name in code.addresses
        ]

    def _at(self, t: float, q: Array, v: Array, mode: Mode) -> Array:
        """zeta and force in one row (n + 2,)."""
        inp, n = self.inp, len(q)
        inp[0], inp[1], inp[2] = t, mode.step, mode.start
        inp[3 : 3 + n], inp[3 + n :] = q, v
        for function, given in self.calls:
            function(*given)
        return self.out.sum(axis=0) if len(self.out) > 1 else self.out[0].copy()

    def load(self, t: float, q: Array, v: Array, mode: Mode) -> Load | None:
        """At t [s], q (n,) [rad], v (n,) [rad/s]; Python says what is wrong with numbers that are not
        finite.
        """
        row = self._at(t, q, v, mode)
        size = row.dot(row)
        if not math.isfinite(size):
            return self.loop.load(t, q, v, mode)
        return Load(row[:-2], row[-2:]) if size > 0.0 else None

    def zeta(self, t: Array, q: Array, v: Array, mode: Mode) -> Array:
        """zeta (K, n) [N m] at K times [s], q (K, n) [rad], v (K, n) [rad/s]."""
        return summed(self.terms, t, q, v, mode)


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
