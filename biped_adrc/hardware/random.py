"""Random numbers as a pure function of a state: MRG32k3a, in doubles that hold whole numbers exactly.

    x_n = (1403580 x_(n-2) - 810728 x_(n-3)) mod m_1,   m_1 = 2^32 - 209
    y_n = (527612 y_(n-1) - 1370589 y_(n-3)) mod m_2,   m_2 = 2^32 - 22853
    u_n = ((x_n - y_n) mod m_1) / (m_1 + 1), m_1 in place of 0

L'Ecuyer, Operations Research 47(1), 1999. Normal numbers by Box and Muller. The state is handed in and out, so
that a run is repeated by repeating its seed, and a tick may be taken again.
"""

from __future__ import annotations

import math

import numpy as np

from biped_adrc.types import Array

M_1, M_2 = 4294967087.0, 4294944443.0
SIZE = 6
"""Numbers in a state r."""


def seeded(seed: int) -> Array:
    """r (6,), as different for neighbouring seeds as for any others."""
    words = np.random.SeedSequence(seed).generate_state(SIZE, np.uint32).astype(float)
    r: Array = 1.0 + words % np.repeat([M_1 - 1.0, M_2 - 1.0], 3)
    return r


def modulo(a: float, m: float) -> float:
    """a mod m for whole numbers |a| < 2^53; the quotient may be off by one in the last bit."""
    b = a - np.floor(a / m) * m
    b = np.where(b < 0.0, b + m, b)
    return np.where(b >= m, b - m, b)


def uniforms(r: Array, count: int) -> tuple[Array, Array]:
    """The state after `count` numbers, and these (count,), in (0, 1)."""
    x0, x1, x2, y0, y1, y2 = r[0], r[1], r[2], r[3], r[4], r[5]
    u = np.zeros(count)
    for i in range(count):
        x = modulo(1403580.0 * x1 - 810728.0 * x0, M_1)
        y = modulo(527612.0 * y2 - 1370589.0 * y0, M_2)
        x0, x1, x2, y0, y1, y2 = x1, x2, x, y1, y2, y
        z = modulo(x - y, M_1)
        u[i] = np.where(z > 0.0, z, M_1) / (M_1 + 1.0)
    after = np.zeros(6)
    after[0], after[1], after[2] = x0, x1, x2
    after[3], after[4], after[5] = y0, y1, y2
    return after, u


def normals(r: Array, count: int) -> tuple[Array, Array]:
    """The state after, and `count` independent standard normal numbers."""
    pairs = (count + 1) // 2
    r, u = uniforms(r, 2 * pairs)
    g = np.zeros(2 * pairs)
    for i in range(pairs):
        radius, angle = np.sqrt(-2.0 * np.log(u[2 * i])), 2.0 * math.pi * u[2 * i + 1]
        g[2 * i], g[2 * i + 1] = radius * np.cos(angle), radius * np.sin(angle)
    return r, g[:count]
