"""Multipliers of a return map that is known up to noise, from pairs of walks, and what the noise hides.

    x_1 = d + e_1,   x_2 = P d + e_2          x_i: half the difference of a pair's two walks on a section

Both walks of a pair start at the same distance on opposite sides of the cycle, so that what is quadratic in the
distance cancels. P is fitted by least squares to many pairs in random directions, larger than the noise e. The
noise is measured by pairs without a distance (a placebo): walks that start at the cycle, each at another
fraction of a sampling period.

A multiplier of zero is not found as zero: the noise moves it, far where P is not normal. So the floor is what
the same pairs, with fresh noise, make of multipliers that are zero.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.linalg import schur

from biped_adrc.errors import InputError
from biped_adrc.types import Array

DRAWS = 400
"""How often pairs, or their noise, are drawn again."""
LEVEL = 0.95
"""Confidence of intervals and of the floor [1]."""


class Pairs(NamedTuple):
    """Half differences of K pairs of walks, in section coordinates that are scaled alike."""

    first: Array
    """x_1 (K, k): where they pass the section first."""
    second: Array
    """x_2 (K, k): where they pass it one step later."""


class Multipliers(NamedTuple):
    """What pairs say of a return map."""

    magnitudes: Array
    """|multipliers| (k,), the largest first."""
    low: float
    """Lower end of the interval of the largest one."""
    high: float
    """Its upper end."""
    floor: float
    """Up to here a magnitude may be that of a multiplier 0."""
    left: float
    """Largest singular value of what P leaves of x_2, over the placebo's: 1 where noise explains it."""


def multipliers(pairs: Pairs, placebo: Pairs, seed: int) -> Multipliers:
    """The multipliers of P with the interval of the largest, and the floor by the placebo's noise.

    Raises InputError for fewer pairs than twice the coordinates.
    """
    count, k = pairs.first.shape
    if min(count, len(placebo.first)) < 2 * k:
        raise InputError(
            f"{count} pairs and {len(placebo.first)} without a distance are too few for {k} coordinates; "
            f"expected at least {2 * k} of each"
        )
    random, P = np.random.default_rng(seed), fitted(pairs)
    again = [magnitudes(fitted(drawn(pairs, count, random)))[0] for _ in range(DRAWS)]
    low, high = np.quantile(again, [0.5 * (1.0 - LEVEL), 0.5 * (1.0 + LEVEL)])
    rest = pairs.second - pairs.first @ P.T
    left = _largest(rest, count - k) / _largest(placebo.second, len(placebo.second))
    floor = noise_floor(P, pairs.first, placebo, random)
    return Multipliers(magnitudes(P), float(low), float(high), floor, left)


def fitted(pairs: Pairs) -> Array:
    """P (k, k) by least squares."""
    solution: Array = np.linalg.lstsq(pairs.first, pairs.second, rcond=None)[0]
    return solution.T


def magnitudes(P: Array) -> Array:
    """|eigenvalues| (k,) of P (k, k), the largest first."""
    sizes: Array = np.sort(np.abs(np.linalg.eigvals(P)))[::-1]
    return sizes


def noise_floor(P: Array, first: Array, placebo: Pairs, random: np.random.Generator) -> float:
    """What noise makes, with the confidence LEVEL, of multipliers 0 beside the largest one of P (k, k).

    first (K, k): x_1 of the pairs. In the Schur form of P all but the largest are set to 0, so that what
    couples the directions stays; x_1 and x_2 of that map get the noise of the placebo, each pair's with a
    random sign.
    """
    alone, kept = only_largest(P)
    found = []
    for _ in range(DRAWS):
        noise = drawn(placebo, len(first), random)
        sign = random.choice([-1.0, 1.0], size=(len(first), 1))
        noisy = Pairs(first + sign * noise.first, first @ alone.T + sign * noise.second)
        found.append(magnitudes(fitted(noisy))[kept])
    return float(np.quantile(found, LEVEL))


def only_largest(P: Array) -> tuple[Array, int]:
    """P (k, k) with all multipliers but the largest set to 0, and how many are left (two of a complex pair)."""
    largest = magnitudes(P)[0]
    T, Z, kept = schur(P, output="complex", sort=lambda z: abs(z) > (1.0 - 1e-9) * largest)
    T[range(kept, len(T)), range(kept, len(T))] = 0.0
    return np.real(Z @ T @ Z.conj().T), int(kept)


def drawn(pairs: Pairs, count: int, random: np.random.Generator) -> Pairs:
    """So many of the pairs, with repetition."""
    those = random.integers(0, len(pairs.first), count)
    return Pairs(pairs.first[those], pairs.second[those])


def _largest(rows: Array, freedom: int) -> float:
    """Largest singular value of rows (K, k), per root of so many degrees of freedom."""
    return float(np.linalg.svd(rows, compute_uv=False)[0] / np.sqrt(freedom))
