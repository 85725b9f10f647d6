"""Cubic B-splines of the phase: curves with local support and two continuous derivatives.

    h(s) = sum_k alpha_k N_k(s),   knots 0, 0, 0, 0, 1/J, 2/J, ..., 1, 1, 1, 1,   J = M - 2 pieces

Each coefficient reaches over four pieces at most, where one of a Bezier curve reaches over all of the step.
By de Boor's recursion, on the polynomials of each piece:

    N_k,d = (s - t_k) / (t_k+d - t_k) N_k,d-1 + (t_k+d+1 - s) / (t_k+d+1 - t_k+1) N_k+1,d-1

with N_k,0 one on [t_k, t_k+1) and zero elsewhere, and 0 for what is divided by 0. The third derivative jumps at
the knots. de Boor, A Practical Guide to Splines, Springer, 1978.

`scipy.interpolate.BSpline` has the same values; here they are needed as polynomials by pieces, of symbols too.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from biped_adrc.core.types import Array
from biped_adrc.gait.curves import ControlledCurve

CUBIC = 3
"""Degree of each piece: the least one with two continuous derivatives."""


@dataclass(frozen=True)
class BSpline(ControlledCurve):
    """A cubic B-spline h(s), by the module's equation; alpha (p, M + 1) [rad], M >= 3: one
    less than its coefficients.

    Raises GaitError for fewer than 4 coefficients per joint.
    """

    least = CUBIC + 1

    @property
    def pieces(self) -> tuple[Array, Array]:
        return knots(self.degree)[CUBIC + 1 : -CUBIC - 1], self.coefficients @ basis(self.degree)

    @classmethod
    def abscissae(cls, degree: int) -> Array:
        t = knots(degree)
        return np.array([np.mean(t[k + 1 : k + 1 + CUBIC]) for k in range(degree + 1)])


def knots(degree: int) -> Array:
    """Knots t (M + 5,) in [0, 1] for M = `degree`, the ends four times: so the curve begins and
    ends in its outer coefficients.
    """
    inner = np.linspace(0.0, 1.0, degree - CUBIC + 2)
    return np.concatenate((np.zeros(CUBIC), inner, np.ones(CUBIC)))


@lru_cache(maxsize=32)
def basis(degree: int) -> Array:
    """Basis functions N_k as polynomials (J, M + 1, 4): on each piece the coefficients
    of each N_k in powers of s.

    By de Boor's recursion. degree: M. Cached, since the knots depend on nothing else.
    """
    t = knots(degree)
    table = np.zeros((degree - CUBIC + 1, degree + 1, CUBIC + 1))
    for j in range(len(table)):
        N = np.zeros((len(t) - 1, CUBIC + 1))
        N[CUBIC + j, 0] = 1.0
        for d in range(1, CUBIC + 1):
            N = np.array([_raised(t, N, k, d) for k in range(len(N) - 1)])
        table[j] = N
    table.setflags(write=False)
    return table


def _raised(t: Array, N: Array, k: int, d: int) -> Array:
    """Coefficients (4,) of N_k,d in powers of s, from those of degree d - 1, N (., 4); t are the knots."""
    result = np.zeros(CUBIC + 1)
    for i, sign, at in ((k, 1.0, t[k]), (k + 1, -1.0, t[k + d + 1])):
        width = t[i + d] - t[i]
        if width > 0.0:
            result[1:] += sign / width * N[i, :-1]
            result -= sign * at / width * N[i]
    return result
