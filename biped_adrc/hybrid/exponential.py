"""ETD-RK4, the exponential Runge-Kutta method, for a flow whose stiff part is linear.

In the coordinates of `Split`, E' = A E + N_E(t, p, E) and p' = N_p(t, p, E). A is integrated exactly
through the phi-functions; p sees the classical RK4 (Cox, Matthews, J. Comput. Phys. 176, 2002, eqs
(26)-(29)):

    a = e^(hA/2) E + h/2 phi1(hA/2) N(E)
    b = e^(hA/2) E + h/2 phi1(hA/2) N(a)
    c = e^(hA/2) a + h/2 phi1(hA/2) (2 N(b) - N(E))
    E1 = e^(hA) E + h [(phi1 - 3 phi2 + 4 phi3) N(E) + 2 (phi2 - 2 phi3) (N(a) + N(b))
                       + (4 phi3 - phi2) N(c)]
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.linalg import expm

from biped_adrc.errors import InputError, check_positive
from biped_adrc.hybrid.integrators import Flow, Form, OneStepMethod, Step, step_ends
from biped_adrc.hybrid.system import HybridSystem, Mode, Split
from biped_adrc.types import Array

Start = tuple[float, Array, Array, tuple[Array, Array]]
"""t [s], p, E and the remainder at the start of a step of ETD-RK4."""


_SAME_STEP = 1e-9
"""Relative difference [1] below which two steps share their phi-functions."""


Phi = tuple[Array, Array, Array, Array]
"""phi_0 to phi_3, each (k, k)."""


class PhiTable(NamedTuple):
    """The matrices of one step of length h of ETD-RK4, each (k, k); h is inside the weights."""

    half: Array
    """e^(hA/2)"""
    half_phi1: Array
    """h/2 phi1(hA/2) [s]"""
    full: Array
    """e^(hA)"""
    first: Array
    """h (phi1 - 3 phi2 + 4 phi3) [s], for N(E)."""
    middle: Array
    """h (2 phi2 - 4 phi3) [s], for N(a) and N(b)."""
    last: Array
    """h (4 phi3 - phi2) [s], for N(c)."""

    @classmethod
    def of(cls, half: Phi, phi: Phi, h: float) -> PhiTable:
        """For a step h [s], from the functions of hA / 2 and of hA."""
        p0, p1, p2, p3 = phi
        first, middle = h * (p1 - 3.0 * p2 + 4.0 * p3), h * (2.0 * p2 - 4.0 * p3)
        return cls(half[0], 0.5 * h * half[1], p0, first, middle, h * (4.0 * p3 - p2))


def phi_functions(A: Array, h: float) -> Phi:
    """e^(hA), phi1(hA), phi2(hA), phi3(hA), each (k, k), from one exponential of a (4k, 4k) matrix.

        phi_0 = e^z,   phi_(j+1)(z) = (phi_j(z) - 1/j!) / z

    The block matrix has the phi-functions in its first row, so no division by a small z is needed.
    """
    k = A.shape[0]
    block = np.zeros((4 * k, 4 * k))
    block[:k, :k] = h * A
    for j in range(3):
        block[j * k : (j + 1) * k, (j + 1) * k : (j + 2) * k] = np.eye(k)
    top = expm(block)[:k]
    return top[:, :k], top[:, k : 2 * k], top[:, 2 * k : 3 * k], top[:, 3 * k :]


def phi_table(A: Array, h: float) -> PhiTable:
    """The matrices of ETD-RK4 for A (k, k) [1/s] and a step h [s], from two matrix exponentials."""
    return PhiTable.of(phi_functions(A, 0.5 * h), phi_functions(A, h), h)


@lru_cache(maxsize=16)
def _remembered(A: bytes, k: int, h: float) -> PhiTable:
    """`phi_table` for the regular step of a method, kept for the last 16 (A, h); A as bytes."""
    return phi_table(np.frombuffer(A).reshape(k, k), h)


def no_coordinates() -> InputError:
    """The error of the method for a system without a split."""
    return InputError(
        "the exponential method needs a controller in continuous time whose observer is linear "
        "in its error and measures the true q_b; use RK4, Adaptive or Stiff instead"
    )


@dataclass(frozen=True)
class Exponential(OneStepMethod):
    """ETD-RK4 with fixed step h [s], in the coordinates of the system's `split`. Raises InputError for none."""

    h: float = 5e-4

    def __post_init__(self) -> None:
        check_positive(self.h, f"step h [s] is {self.h}")

    @property
    def label(self) -> str:
        return f"ETD-RK4, h = {self.h:g} s"

    def split(self, system: HybridSystem, mode: Mode) -> Split | None:
        return system.split(mode)

    def steps(
        self, f: Flow, split: Form | None, t: float, x: Array, t_end: float
    ) -> Iterator[Step]:
        """Steps from (t, x), x (nx,), to t_end [s] in the coordinates of `split`.

        A step of another length than h, before a break, makes matrices of its own, and so does
        every look inside a step. Raises InputError without such coordinates.
        """
        if not isinstance(split, Split):
            raise no_coordinates()
        A = np.ascontiguousarray(split.A)
        table = _remembered(A.tobytes(), A.shape[0], self.h)
        p, E = split.to(x)
        N, _, dx = _node(split, t, p, E)
        for t1 in step_ends(t, t_end, self.h):
            h = t1 - t
            if abs(h - self.h) > _SAME_STEP * self.h:
                table = phi_table(A, h)
            p1, E1 = etd_rk4(split, table, t, p, E, N, h)
            N1, x1, dx1 = _node(split, t1, p1, E1)

            def at(s: float, start: Start = (t, p, E, N)) -> Array:
                h = s - start[0]
                return split.back(*etd_rk4(split, phi_table(A, h), *start, h))

            yield Step(t, t1, x, x1, dx, dx1, at)
            t, x, dx, p, E, N = t1, x1, dx1, p1, E1, N1


def _node(split: Split, t: float, p: Array, E: Array) -> tuple[tuple[Array, Array], Array, Array]:
    """The remainder, x and x' (nx,) at (t, p, E); `back` is linear and maps slopes as it maps states."""
    N = split.remainder(t, p, E)
    return N, split.back(p, E), split.back(N[0], split.A @ E + N[1])


def etd_rk4(
    split: Split,
    table: PhiTable,
    t: float,
    p: Array,
    E: Array,
    N: tuple[Array, Array],
    h: float,
) -> tuple[Array, Array]:
    """p and E (k, c) after one step of length h [s] from (p, E), with N = remainder(t, p, E) known already.

    table: the matrices of that h. Three more evaluations of the remainder, as RK4 has.
    """
    Np, NE = N
    half, phi, full, first, middle, last = table
    half_E = half @ E
    Ea = half_E + phi @ NE
    Na, NEa = split.remainder(t + 0.5 * h, p + 0.5 * h * Np, Ea)
    Eb = half_E + phi @ NEa
    Nb, NEb = split.remainder(t + 0.5 * h, p + 0.5 * h * Na, Eb)
    Ec = half @ Ea + phi @ (2.0 * NEb - NE)
    Nc, NEc = split.remainder(t + h, p + h * Nb, Ec)
    p1 = p + (h / 6.0) * (Np + 2.0 * (Na + Nb) + Nc)
    E1 = full @ E + first @ NE + middle @ (NEa + NEb) + last @ NEc
    return p1, E1
