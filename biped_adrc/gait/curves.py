"""Curves h(s) [rad] of a normalised phase s in [0, 1], one row per joint, with dh/ds and d2h/ds2 [rad].

    h(s) = sum_k a_k s^k                                  Polynomial
    h(s) = sum_k alpha_k C(M, k) s^k (1 - s)^(M - k)      Bezier
    h(s) = sum_k alpha_k N_k(s)                           BSpline

A curve has p rows, one per joint, with M + 1 coefficients each. As polynomials it has J pieces, each with K
coefficients a_k per row, of s^0 to s^(K-1).

Outside [0, 1] the curve goes on as the polynomial it is, its first or last piece: after a push a step may end
late, and the reference must not stop there.

Every curve gives its own representation as polynomials by pieces, from which its values are computed in
Python, machine code, the zero dynamics and the optimisation of gaits. A curve of another basis is a new class
with `pieces` and `ramp` (the coefficients of a straight line), and a line in the registry of names
(`core/registry.toml`).
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import lru_cache
from math import comb
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from biped_adrc.core.errors import GaitError
from biped_adrc.core.part import derived
from biped_adrc.core.registry import REGISTRY
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, read_only


@dataclass(frozen=True)
class Curve(Shown, ABC):
    """Base of all curves: coefficients (p, M + 1) [rad], one row per joint; h is linear in them.

    Raises GaitError when they are not finite or not 2-D.
    """

    coefficients: Array
    least: ClassVar[int] = 2
    """Least number of coefficients of a joint."""

    def __post_init__(self) -> None:
        a = read_only(self.coefficients)
        if a.ndim != 2 or a.shape[1] < self.least or not np.all(np.isfinite(a)):
            raise GaitError(
                f"curve coefficients have shape {a.shape}, expected finite numbers, a row for each joint, at "
                f"least {self.least} columns"
            )
        object.__setattr__(self, "coefficients", a)

    @property
    def degree(self) -> int:
        """M, one less than the number of coefficients of a joint: for `Bezier` and `Polynomial` the degree, for
        `BSpline`, whose pieces are cubic, only a count.
        """
        return int(self.coefficients.shape[1]) - 1

    @property
    @abstractmethod
    def pieces(self) -> tuple[Array, Array]:
        """Breaks (J - 1,) in (0, 1), increasing, where pieces join, and coefficients a (J, p, K) [rad].

        On piece j h(s) = sum_k a_jk s^k, where s is the phase in the whole curve, not in the piece.

        Values and derivatives follow from this: a new kind of curve need not define its derivatives.
        """

    @classmethod
    @abstractmethod
    def ramp(cls, degree: int, start: float, end: float) -> Array:
        """Coefficients (M + 1,) in this basis of the straight line start + s (end - start); degree: M."""

    @property
    def power_coefficients(self) -> Array:
        """Coefficients a (p, K) of h(s) = sum_k a_k s^k, for a curve of one piece.

        Raises GaitError for a curve of several pieces.
        """
        breaks, a = self.pieces
        if len(breaks):
            raise GaitError(
                f"the {type(self).__name__} has {len(a)} pieces, expected one polynomial; take a bezier curve"
            )
        return a[0]

    @derived
    def breaks(self) -> Array:
        """Places (J - 1,) in (0, 1) where a further piece begins, increasing."""
        return self.pieces[0]

    @derived
    def stacked(self) -> Array:
        """Power coefficients of h, dh/ds, d2h/ds2 stacked, (J, 3 p, K) [rad]: one product with the powers of s
        gives all three.
        """
        a = self.pieces[1]
        k = np.arange(a.shape[2])
        first, second = np.zeros_like(a), np.zeros_like(a)
        first[..., :-1] = a[..., 1:] * k[1:]
        second[..., :-2] = a[..., 2:] * k[2:] * (k[2:] - 1.0)
        return np.concatenate((a, first, second), axis=1)

    @derived
    def powers(self) -> NDArray[np.int64]:
        """Exponents (K,) of s in the power basis of a piece."""
        return np.arange(self.stacked.shape[2])

    def piece(self, s: float) -> Array:
        """Coefficients (3 p, K) [rad] of the piece at s, for p joints: p rows of h, p of dh/ds, p of d2h/ds2.

        A row has the K coefficients of s^0 .. s^(K-1). At a break they are those of the later piece: piece j +
        1 (stacked[j + 1]) begins at breaks[j].
        """
        a = self.stacked[0]
        # np.where, not an index, since s may be a symbol
        for j in range(len(self.breaks)):
            a = np.where(s >= self.breaks[j], self.stacked[j + 1], a)
        return a

    def __call__(self, s: float) -> tuple[Array, Array, Array]:
        """h [rad], dh/ds, d2h/ds2 at s, each (p,); s may lie outside of [0, 1]."""
        p = self.stacked.shape[1] // 3
        # rows of the piece: p of h, p of dh/ds, p of d2h/ds2
        values = self.piece(s).dot(s**self.powers)
        return values[:p], values[p : 2 * p], values[2 * p :]


@dataclass(frozen=True)
class Polynomial(Curve):
    """A polynomial h(s) = sum_k a_k s^k, a (p, M + 1) [rad]: for imported curves, as the paper's gait (b).

    Gaits are designed with `ControlledCurve`.
    """

    @property
    def pieces(self) -> tuple[Array, Array]:
        # no breaks, and the coefficients of the one piece
        return np.zeros(0), self.coefficients[np.newaxis]

    @classmethod
    def ramp(cls, degree: int, start: float, end: float) -> Array:
        # the straight line start + s (end - start) in powers of s
        a = np.zeros(degree + 1)
        a[:2] = start, end - start
        return a


@dataclass(frozen=True)
class ControlledCurve(Curve):
    """Base of curves that go from their first to their last coefficient, in a basis that adds up to one.

    The basis is symmetric in s and 1 - s. Gaits are designed with such curves: the state before impact gives
    the last value and slope, the state after it the first ones, hence the two outer coefficients at either end,
    and the optimisation moves those between. `Polynomial` is none: its last coefficient is not h(1).
    """

    @classmethod
    @abstractmethod
    def abscissae(cls, degree: int) -> Array:
        """Coefficients (M + 1,) of h(s) = s. The second one is the `reach` of a slope: a curve that begins with
        the slope dh/ds has alpha_1 = alpha_0 + reach dh/ds.
        """

    @classmethod
    def ramp(cls, degree: int, start: float, end: float) -> Array:
        # the straight line start + s (end - start): the basis adds up to one, and the abscissae give s
        return np.asarray(start + cls.abscissae(degree) * (end - start))

    @classmethod
    def between(cls, begin: Array, first: Array, last: Array, end: Array, degree: int) -> Array:
        """Coefficients (p, M + 1) of a curve from `begin` to `end` [rad] with the slopes dh/ds `first` and
        `last` [rad] there, each (p,); degree: M.

        The slopes fix alpha_1 and alpha_(M-1); the coefficients between these lie on a straight line. The
        search for a gait starts from this curve, with ends and slopes that make it hybrid-invariant.
        """
        inner = np.linspace(0.0, 1.0, degree - 1)  # from alpha_1 to alpha_(M-1)
        # abscissae: the coefficients of h(s) = s; by the second, alpha_1 = alpha_0 + reach dh/ds at s = 0,
        # likewise at s = 1
        reach = cls.abscissae(degree)[1]
        ends = begin + reach * first, end - reach * last
        middle = ends[0][:, np.newaxis] * (1.0 - inner) + ends[1][:, np.newaxis] * inner
        return np.column_stack((begin, middle, end))


@dataclass(frozen=True)
class Bezier(ControlledCurve):
    """A Bezier curve h(s) = sum_k alpha_k C(M, k) s^k (1 - s)^(M - k), alpha (p, M + 1)
    [rad], as the paper's gait (a).

    h(0) = alpha_0, h(1) = alpha_M, h'(0) = M (alpha_1 - alpha_0), h'(1) = M (alpha_M - alpha_(M-1)). It stays
    within the hull of its coefficients, so bounds on these are bounds on the angles.
    """

    @property
    def pieces(self) -> tuple[Array, Array]:
        # no breaks, and the coefficients of the one piece in powers of s
        return np.zeros(0), (self.coefficients @ bernstein_to_power(self.degree))[np.newaxis]

    @classmethod
    def abscissae(cls, degree: int) -> Array:
        # coefficients of h(s) = s
        return np.arange(degree + 1) / degree


def bernstein_to_power(degree: int) -> Array:
    """Matrix T (M + 1, M + 1) from Bezier to power coefficients: sum_k alpha_k B_k(s) = sum_j (alpha T)_j s^j,
    with B_k the Bernstein polynomials of degree M.

    Its numbers grow with the degree, up to 2^M and more: in powers a curve of degree 20 has lost some digits.
    """
    powers = range(degree + 1)
    # row k, column j; comb(j, k) is 0 for j < k
    T = [[(-1) ** (j - k) * comb(degree, j) * comb(j, k) for j in powers] for k in powers]
    return np.array(T, dtype=float)


def basis_at(kind: type[Curve], degree: int, s: Array) -> tuple[Array, ...]:
    """The M + 1 basis functions of a kind of curve at the phases s (K,), and their first and second derivatives
    by s: three arrays (K, M + 1); degree: M.

    They are the rows of the curve whose coefficients are the identity matrix.
    """
    return tuple(map(np.array, zip(*map(kind(np.eye(degree + 1)), s), strict=True)))


def curve_kind(name: str) -> type[Curve]:
    """The class of a curve by its name in the registry, such as "bezier". Raises GaitError with the known
    names.
    """
    if name not in REGISTRY["curve"]:
        raise GaitError(
            f"curve is '{name}', expected one of {sorted(REGISTRY['curve'])}; a class of one's own gets a name "
            "with biped_adrc.register('curve', NAME, CLASS) first, since files are read without importing "
            "anything"
        )
    return REGISTRY["curve"][name].load()  # type: ignore[return-value]


CUBIC = 3
"""Degree of each piece: the least one with two continuous derivatives."""


@dataclass(frozen=True)
class BSpline(ControlledCurve):
    """A cubic B-spline h(s): local support and two continuous derivatives; alpha (p, M + 1) [rad], M >= 3.

        h(s) = sum_k alpha_k N_k(s),   knots 0, 0, 0, 0, 1/J, 2/J, ..., 1, 1, 1, 1,   J = M - 2 pieces

    Each coefficient reaches over four pieces at most, where one of a Bezier curve reaches over all of the step.
    By de Boor's recursion, on the polynomials of each piece:

        N_k,d = (s - t_k) / (t_k+d - t_k) N_k,d-1 + (t_k+d+1 - s) / (t_k+d+1 - t_k+1) N_k+1,d-1

    with N_k,0 one on [t_k, t_k+1) and zero elsewhere; t_k are the knots, and a term divided by 0 counts as 0.
    The third derivative jumps at the knots. de Boor, A Practical Guide to Splines, Springer, 1978.
    `scipy.interpolate.BSpline` has the same values; here they are needed as polynomials by pieces, of symbols
    too.

    Raises GaitError for fewer than 4 coefficients per joint.
    """

    least = CUBIC + 1  # coefficients of a joint

    @property
    def pieces(self) -> tuple[Array, Array]:
        # the knots between the ends, which are there four times each, are the breaks
        return knots(self.degree)[CUBIC + 1 : -CUBIC - 1], self.coefficients @ basis(self.degree)

    @classmethod
    def abscissae(cls, degree: int) -> Array:
        t = knots(degree)
        # Greville abscissae: alpha_k = mean of the knots t_k+1 .. t_k+3 gives h(s) = s
        return np.array([np.mean(t[k + 1 : k + 1 + CUBIC]) for k in range(degree + 1)])


def knots(degree: int) -> Array:
    """Knots t (M + 5,) in [0, 1] of a `BSpline` with M = `degree`: equally spaced, 0 and 1 four times each, so
    that the curve begins and ends with its outer coefficients.
    """
    # both ends too, to which CUBIC more are added
    inner = np.linspace(0.0, 1.0, degree - CUBIC + 2)
    return np.concatenate((np.zeros(CUBIC), inner, np.ones(CUBIC)))


@lru_cache(maxsize=32)
def basis(degree: int) -> Array:
    """Basis functions N_k of a `BSpline` as polynomials (J, M + 1, 4): entry [j, k, i] is the coefficient
    of s^i of N_k on piece j.

    degree: M, one less than the number of basis functions; each is cubic, on J = M - 2 pieces. By de Boor's
    recursion. Cached, since the knots depend on M alone.
    """
    t = knots(degree)
    table = np.zeros((degree - CUBIC + 1, degree + 1, CUBIC + 1))
    for j in range(len(table)):
        N = np.zeros((len(t) - 1, CUBIC + 1))
        N[CUBIC + j, 0] = 1.0  # N_k,0 is 1 on piece j for k = CUBIC + j alone, as t_0 .. t_3 are 0
        for d in range(1, CUBIC + 1):
            N = np.array([_raised(t, N, k, d) for k in range(len(N) - 1)])
        table[j] = N
    return read_only(table)  # all callers share the cached array


def _raised(t: Array, N: Array, k: int, d: int) -> Array:
    """Coefficients (4,) of N_k,d in powers of s, by one step of the recursion of `BSpline`.

    t: knots. N (., 4): coefficients of all functions of degree d - 1, one row each.
    """
    result = np.zeros(CUBIC + 1)
    for i, sign, at in ((k, 1.0, t[k]), (k + 1, -1.0, t[k + d + 1])):
        width = t[i + d] - t[i]
        if width > 0.0:
            # adds sign (s - at) / width N_i,d-1; a factor s moves the coefficients up by one
            result[1:] += sign / width * N[i, :-1]
            result -= sign * at / width * N[i]
    return result
