"""One step of the classical Runge-Kutta method and of ETD-RK4, and landing by halving.

ETD-RK4 in the coordinates y = (w, E), E (k, p) row by row, with N_E in the forced rows only; its equations are
in `biped_adrc.hybrid.exponential`. A length that is not the step h is taken in sub-steps h 2^-level, and what
is left below the last level by one classical step, which is stable there.
"""

from __future__ import annotations

from biped_adrc.engine.kernels.call import Ints, call, inner, shift, unit
from biped_adrc.engine.kernels.laws import copy, copy_held, flow, join, remainder, row, watch
from biped_adrc.engine.kernels.layout import *
from biped_adrc.types import Array


@unit
def classical(
    P: Ints, F: Array, K: Array, W: Array, t: float, x: Array, dx: Array, h: float, out: Array
) -> None:
    """out = one step of length h from (t, x) with the slope dx."""
    m, rest, stage = P[MOVING], P[STATES] - P[MOVING], row(P, W, STAGE)
    k2, k3, k4 = row(P, W, K2), row(P, W, K3), row(P, W, K4)
    if rest > 0:
        copy_held(P, x, stage)
    for i in range(m):
        stage[i] = x[i] + 0.5 * h * dx[i]
    flow(P, F, K, W, t + 0.5 * h, stage, k2)
    for i in range(m):
        stage[i] = x[i] + 0.5 * h * k2[i]
    flow(P, F, K, W, t + 0.5 * h, stage, k3)
    for i in range(m):
        stage[i] = x[i] + h * k3[i]
    flow(P, F, K, W, t + h, stage, k4)
    copy(shift(x, m), shift(out, m), rest)
    for i in range(m):
        slopes = dx[i] + 2.0 * (k2[i] + k3[i]) + k4[i]
        out[i] = x[i] + (h / 6.0) * slopes


@inner
def matrix(P: Ints, F: Array, level: int, which: int) -> Array:
    """One of the matrices of a level."""
    return shift(F, P[WEIGHTS_AT] + (MATRICES * level + which) * P[STIFF] * P[STIFF])


@inner
def turn(P: Ints, M: Array, y: Array, out: Array) -> None:
    """E of out = M E of y."""
    nw = P[SLOW]
    call(P[TURN], M, shift(y, nw), shift(out, nw))


@inner
def push(P: Ints, M: Array, factor: float, N: Array, out: Array) -> None:
    """E of out += factor M N_E."""
    k, p, nw = P[STIFF], P[JOINTS], P[SLOW]
    for i in range(k):
        for j in range(P[FORCED]):
            weight = factor * M[i * k + P[P[ROWS_AT] + j]]
            for c in range(p):
                out[nw + i * p + c] += weight * N[nw + j * p + c]


@inner
def drift(P: Ints, y: Array, h: float, N: Array, out: Array) -> None:
    """w of out = w + h N_w."""
    for i in range(P[SLOW]):
        out[i] = y[i] + h * N[i]


@unit
def exponential(
    P: Ints,
    F: Array,
    K: Array,
    W: Array,
    level: int,
    t: float,
    h: float,
    y: Array,
    N: Array,
    out: Array,
) -> None:
    """out = one step of length h from (t, y) with the remainder N; h is that of the level."""
    ny, e_half = P[SLOW] + P[STIFF] * P[JOINTS], row(P, W, E_HALF)
    a, b = row(P, W, YA), row(P, W, YB)
    Na, Nb, Nc = row(P, W, NA), row(P, W, NB), row(P, W, NC)
    half, half_phi = matrix(P, F, level, HALF), matrix(P, F, level, HALF_PHI)
    middle = matrix(P, F, level, MIDDLE)
    turn(P, half, y, e_half)
    copy(e_half, a, ny)
    copy(e_half, b, ny)
    drift(P, y, 0.5 * h, N, a)
    push(P, half_phi, 1.0, N, a)
    remainder(P, F, K, W, t + 0.5 * h, a, Na)
    drift(P, y, 0.5 * h, Na, b)
    push(P, half_phi, 1.0, Na, b)
    remainder(P, F, K, W, t + 0.5 * h, b, Nb)
    turn(P, half, a, b)
    drift(P, y, h, Nb, b)
    push(P, half_phi, 2.0, Nb, b)
    push(P, half_phi, -1.0, N, b)
    remainder(P, F, K, W, t + h, b, Nc)
    turn(P, matrix(P, F, level, FULL_STEP), y, out)
    push(P, matrix(P, F, level, FIRST), 1.0, N, out)
    push(P, middle, 1.0, Na, out)
    push(P, middle, 1.0, Nb, out)
    push(P, matrix(P, F, level, LAST), 1.0, Nc, out)
    for i in range(P[SLOW]):
        slopes = N[i] + 2.0 * (Na[i] + Nb[i]) + Nc[i]
        out[i] = y[i] + (h / 6.0) * slopes


@unit
def halve(
    P: Ints, F: Array, K: Array, W: Array, guard: int, t: float, ta: float, tb: float, fb: float
) -> None:
    """Sub-steps from (t, Y0) that end before tb, and after ta only before the guard's crossing.

    Leaves the state in rows XB, DXB, its time in LANDED, and the end of the bracket with its witness in FAR.
    """
    ny, levels = P[SLOW] + P[STIFF] * P[JOINTS], P[LEVELS]
    y, N, trial = row(P, W, Y_SUB), row(P, W, N_SUB), row(P, W, Y_TRY)
    x, tried = row(P, W, XB), row(P, W, TRIED)
    copy(row(P, W, Y0), y, ny)
    copy(row(P, W, N0), N, ny)
    finest, count, now = F[H] * 0.5 ** (levels - 1), 0, t
    for level in range(1, levels):
        further = count + (1 << (levels - 1 - level))
        end = t + further * finest
        if end > ta and end >= tb:
            continue
        exponential(P, F, K, W, level, now, end - now, y, N, trial)
        if end > ta:
            join(P, K, trial, x)
            watch(P, F, K, W, end, x, tried)
            if not tried[guard] > 0.0:
                tb, fb = end, tried[guard]
                continue
        count, now = further, end
        copy(trial, y, ny)
        remainder(P, F, K, W, now, y, N)
    join(P, K, y, x)
    flow(P, F, K, W, now, x, row(P, W, DXB))
    W[LANDED], W[FAR], W[FAR_VALUE] = now, tb, fb
