"""One step of each method: the classical Runge-Kutta method, and ETD-RK4 with landing by halving.

ETD-RK4 in the coordinates y = (w, E), E (k, p) row by row, with N_E in row 1 alone; its equations are
in `hybrid.exponential`. A length that is not the step h is taken in sub-steps h
2^-level, whose matrices are prepared (`kernels.methods`), and what is left below the last level by
one classical step, which is stable there.
"""

from __future__ import annotations

from biped_adrc.engine.kernels.call import Ints, call, inner, shift, unit
from biped_adrc.engine.kernels.laws import *
from biped_adrc.engine.kernels.layout import *
from biped_adrc.hybrid.relaxation import relaxation
from biped_adrc.types import Array

weights = inner(relaxation)


@inner
def relax(P: Ints, x: Array, weight: float, out: Array) -> None:
    """Torques of lagging motors in out (nx,): what is asked, and `weight` [1] of what x has beyond it."""
    for i in range(P[JOINTS]):
        aim = x[P[STATES] - P[JOINTS] + i]
        out[P[LAG_AT] + i] = aim + weight * (x[P[LAG_AT] + i] - aim)


@unit
def lagging(P: Ints, F: Array, K: Array, W: Array, t: float, x: Array, h: float, dx: Array) -> None:
    """dx (nx,) of the first stage of a step of length h [s], with lagging motors; see `relaxing_rk4`."""
    stage, at, theta = row(P, W, STAGE), P[LAG_AT], F[LAG_SPEED] * h
    copy(x, stage, P[STATES])
    relax(P, x, weights(theta)[0], stage)
    flow(P, F, K, W, t, stage, dx)
    steep = -min(theta, 3.0) / h if h > 0.0 else 0.0
    for i in range(P[JOINTS]):
        dx[at + i] = steep * (x[at + i] - x[P[STATES] - P[JOINTS] + i])


@unit
def classical(
    P: Ints, F: Array, K: Array, W: Array, t: float, x: Array, dx: Array, h: float, out: Array
) -> None:
    """out (nx,) = one RK4 step of length h [s] from (t, x) with the slope dx (nx,).

    Only the first MOVING numbers move; the rest, held between sample instants, is copied. The
    stages see the torques of it, which is all that a flow reads. Torques of lagging motors are exact.
    """
    m, rest, stage = P[MOVING], P[STATES] - P[MOVING], row(P, W, STAGE)
    k2, k3, k4, lag = row(P, W, K2), row(P, W, K3), row(P, W, K4), P[LAG_AT] > 0
    if rest > 0:
        copy_held(P, x, stage)
    middle = last = end = 0.0
    if lag:
        _, middle, last, end = weights(F[LAG_SPEED] * h)
        dx = row(P, W, K1)
        lagging(P, F, K, W, t, x, h, dx)
    for i in range(m):
        stage[i] = x[i] + 0.5 * h * dx[i]
    if lag:
        relax(P, x, middle, stage)
    flow(P, F, K, W, t + 0.5 * h, stage, k2)
    for i in range(m):
        stage[i] = x[i] + 0.5 * h * k2[i]
    if lag:
        relax(P, x, middle, stage)
    flow(P, F, K, W, t + 0.5 * h, stage, k3)
    for i in range(m):
        stage[i] = x[i] + h * k3[i]
    if lag:
        relax(P, x, last, stage)
    flow(P, F, K, W, t + h, stage, k4)
    copy(shift(x, m), shift(out, m), rest)
    for i in range(m):
        slopes = dx[i] + 2.0 * (k2[i] + k3[i]) + k4[i]
        out[i] = x[i] + (h / 6.0) * slopes
    if lag:
        relax(P, x, end, out)


@inner
def matrix(P: Ints, F: Array, level: int, which: int) -> Array:
    """Pointer to one of the six matrices (k, k) of a level in F; `which` is HALF, HALF_PHI, ..."""
    return shift(F, P[WEIGHTS_AT] + (MATRICES * level + which) * P[STIFF] * P[STIFF])


@inner
def turn(P: Ints, M: Array, y: Array, out: Array) -> None:
    """E of out = M E of y, M (k, k), E (k, p); w of out is left as it is.

    By generated vector code: k and p are constants in it.
    """
    nw = P[SLOW]
    call(P[TURN], M, shift(y, nw), shift(out, nw))


@inner
def push(P: Ints, M: Array, factor: float, N: Array, out: Array) -> None:
    """E (k, p) of out += factor M N_E, where row 1 of N_E alone is stored, the others being zero."""
    k, p, nw = P[STIFF], P[JOINTS], P[SLOW]
    for i in range(k):
        weight = factor * M[i * k + 1]
        for c in range(p):
            out[nw + i * p + c] += weight * N[nw + c]


@inner
def drift(P: Ints, y: Array, h: float, N: Array, out: Array) -> None:
    """w of out (nw,) = w + h N_w, h in [s]."""
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
    """out = y after one step of ETD-RK4 of length h [s] from (t, y) with the remainder N; h is that
    of the level.

    The equations of `hybrid.exponential`, stages a, b and c in rows YA and YB; w takes the
    classical RK4 with the same stages.
    """
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
    """Sub-steps from (t, Y0) that end before tb [s], and after ta [s] only before the guard's crossing.

    Binary search with the prepared matrices: a sub-step of each level is taken or left out. One
    that ends behind the crossing is not taken and becomes the end of the bracket. Leaves the state
    in rows XB, DXB (nx,), its time in LANDED, and the end of the bracket with its event function in
    FAR, FAR_VALUE. guard -1: without an event, towards tb alone.
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
