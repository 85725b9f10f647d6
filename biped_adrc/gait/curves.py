"""Curves h(s) of a normalised phase s in [0, 1], one row per joint, with two derivatives.

    h(s) = sum_k a_k s^k                                  Polynomial
    h(s) = sum_k alpha_k C(M, k) s^k (1 - s)^(M - k)      Bezier

Outside [0, 1] the curve goes on as the polynomial it is.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from math import comb
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from biped_adrc.errors import GaitError
from biped_adrc.shown import Shown
from biped_adrc.types import Array, read_only


class CurveParameters(NamedTuple):
    """Power coefficients of h, h', h'' stacked, (3 p, M + 1), and the exponents (M + 1,)."""

    stacked: Array
    powers: NDArray[np.int64]


def curve(c: CurveParameters, s: float) -> tuple[Array, Array, Array]:
    """h, dh/ds, d2h/ds2 at s, each (p,)."""
    p = c.stacked.shape[0] // 3
    values = c.stacked.dot(s**c.powers)
    return values[:p], values[p : 2 * p], values[2 * p :]


@dataclass(frozen=True)
class Curve(Shown, ABC):
    """Coefficients (p, M + 1), one row per joint [rad]. Raises GaitError when not finite or not 2-D."""

    coefficients: Array

    def __post_init__(self) -> None:
        a = read_only(self.coefficients)
        if a.ndim != 2 or a.shape[1] < 2 or not np.all(np.isfinite(a)):
            raise GaitError(
                f"curve coefficients have shape {a.shape}, expected (joints, degree + 1) finite numbers "
                "with degree >= 1"
            )
        object.__setattr__(self, "coefficients", a)

    @property
    def degree(self) -> int:
        """M."""
        return int(self.coefficients.shape[1]) - 1

    @property
    @abstractmethod
    def power_coefficients(self) -> Array:
        """a (p, M + 1) of h(s) = sum_k a_k s^k."""

    @cached_property
    def parameters(self) -> CurveParameters:
        """What the law `curve` needs."""
        a = self.power_coefficients
        k = np.arange(a.shape[1])
        first, second = np.zeros_like(a), np.zeros_like(a)
        first[:, :-1] = a[:, 1:] * k[1:]
        second[:, :-2] = a[:, 2:] * k[2:] * (k[2:] - 1.0)
        return CurveParameters(np.vstack((a, first, second)), k)

    def __call__(self, s: float) -> tuple[Array, Array, Array]:
        """h, dh/ds, d2h/ds2 at s, each (p,)."""
        return curve(self.parameters, s)


@dataclass(frozen=True)
class Polynomial(Curve):
    """h(s) = sum_k a_k s^k."""

    @property
    def power_coefficients(self) -> Array:
        return self.coefficients


@dataclass(frozen=True)
class Bezier(Curve):
    """h(s) = sum_k alpha_k C(M, k) s^k (1 - s)^(M - k); h(0) = alpha_0, h(1) = alpha_M,
    h'(0) = M (alpha_1 - alpha_0), h'(1) = M (alpha_M - alpha_(M-1))."""

    @property
    def power_coefficients(self) -> Array:
        return self.coefficients @ bernstein_to_power(self.degree)


def bernstein_to_power(degree: int) -> Array:
    """T (M + 1, M + 1) with sum_k alpha_k B_k(s) = sum_j (alpha T)_j s^j."""
    T = np.zeros((degree + 1, degree + 1))
    for k in range(degree + 1):
        for j in range(k, degree + 1):
            T[k, j] = comb(degree, k) * comb(degree - k, j - k) * (-1) ** (j - k)
    return T


def bezier_between(begin: Array, first: Array, last: Array, end: Array, degree: int) -> Array:
    """Bezier coefficients (p, M + 1) from `begin` to `end` with these first and last slopes dh/ds, each (p,).

    Those between lie on a straight line.
    """
    inner = np.linspace(0.0, 1.0, degree - 1)
    ends = begin + first / degree, end - last / degree
    middle = ends[0][:, np.newaxis] * (1.0 - inner) + ends[1][:, np.newaxis] * inner
    return np.column_stack((begin, middle, end))


def ramp(kind: type[Curve], degree: int, start: float, end: float) -> Array:
    """Coefficients (M + 1,) of start + s (end - start)."""
    k = np.arange(degree + 1) / degree
    if kind is Bezier:
        return np.asarray((1.0 - k) * start + k * end)
    a = np.zeros(degree + 1)
    a[:2] = start, end - start
    return a


CURVES: dict[str, type[Curve]] = {"bezier": Bezier, "polynomial": Polynomial}
