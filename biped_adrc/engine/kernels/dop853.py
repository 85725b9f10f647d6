"""The explicit pair of Dormand and Prince of order 8(5, 3), with SciPy's initial step and step control.

Coefficients are those of `scipy.integrate.DOP853`; the initial step, the error's norm and the factors are as in
Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.4 and II.10.
"""

from __future__ import annotations

import math

import numpy as np

from biped_adrc.engine.kernels.call import Ints, inner, shift, unit
from biped_adrc.engine.kernels.laws import broken, copy, finite, flow, regular, row
from biped_adrc.engine.kernels.layout import *
from biped_adrc.types import Array


@inner
def weighted(P: Ints, W: Array, c: Array, stages: int, i: int) -> float:
    """sum_s c_s K_s,i."""
    slopes, width, total = row(P, W, SLOPES), P[WIDTH], 0.0
    for s in range(stages):
        total += slopes[s * width + i] * c[s]
    return total


@unit
def eighth(P: Ints, F: Array, K: Array, W: Array, t: float, h: float, out: Array) -> None:
    """out = one step of length h from (t, X0) with the slope DX0."""
    nx, A = P[STATES], shift(F, P[WEIGHTS_AT])
    x, stage, B = row(P, W, X0), row(P, W, STAGE), shift(A, B_AT)
    copy(row(P, W, DX0), row(P, W, SLOPES), nx)
    for s in range(1, STAGES):
        for i in range(nx):
            stage[i] = x[i] + weighted(P, W, shift(A, STAGES * s), s, i) * h
        flow(P, F, K, W, t + A[C_AT + s] * h, stage, row(P, W, SLOPES + s))
    for i in range(nx):
        out[i] = x[i] + h * weighted(P, W, B, STAGES, i)


@inner
def error_norm(P: Ints, F: Array, W: Array, h: float) -> float:
    """Of the step from X0 to X1 with slopes in rows SLOPES, as a fraction of the tolerance."""
    nx, A, x, x1 = P[STATES], shift(F, P[WEIGHTS_AT]), row(P, W, X0), row(P, W, X1)
    fifth, third = 0.0, 0.0
    for i in range(nx):
        scale = F[ATOL] + max(abs(x[i]), abs(x1[i])) * F[RTOL]
        fifth += (weighted(P, W, shift(A, E5_AT), STAGES + 1, i) / scale) ** 2
        third += (weighted(P, W, shift(A, E3_AT), STAGES + 1, i) / scale) ** 2
    if fifth == 0.0 and third == 0.0:
        return 0.0
    return abs(h) * fifth / math.sqrt((fifth + 0.01 * third) * nx)


@unit
def adaptive(P: Ints, F: Array, K: Array, W: Array, t: float, t_end: float, h: float) -> int:
    """X1, DX1 from X0, DX0, the time in REACHED, the next step to try in TRY; a status."""
    nx, least = P[STATES], 10.0 * (np.nextafter(t, np.inf) - t)
    x1, dx1 = row(P, W, X1), row(P, W, DX1)
    h, rejected = max(min(h, F[MAX_STEP]), least), False
    while h >= least:
        t1 = min(t + h, t_end)
        h = t1 - t
        eighth(P, F, K, W, t, h, x1)
        flow(P, F, K, W, t1, x1, dx1)
        copy(dx1, row(P, W, SLOPES + STAGES), nx)
        error = error_norm(P, F, W, h)
        if error < 1.0:
            factor = 10.0 if error == 0.0 else min(10.0, 0.9 * error**-0.125)
            if rejected:
                factor = min(1.0, factor)
            if not finite(x1, nx):
                return broken(W)
            W[REACHED], W[TRY] = t1, h * factor
            return 0
        factor = 0.9 * error**-0.125
        h *= factor if factor > 0.2 else 0.2
        rejected = True
    fine = regular(row(P, W, DX0), nx) and regular(x1, nx) and regular(dx1, nx)
    return STEP_FAILED if fine else broken(W)


@inner
def rms(P: Ints, F: Array, W: Array, x: Array, y: Array, sign: float) -> float:
    """Root mean square of x + sign * y on the scale of the tolerance at X0."""
    nx, x0, total = P[STATES], row(P, W, X0), 0.0
    for i in range(nx):
        scale = F[ATOL] + abs(x0[i]) * F[RTOL]
        total += ((x[i] + sign * y[i]) / scale) ** 2
    return math.sqrt(total) / math.sqrt(nx)


@inner
def initial_step(P: Ints, F: Array, K: Array, W: Array, t: float, t_end: float) -> float:
    """The first step to try from (t, X0) with the slope DX0."""
    length, x, dx = t_end - t, row(P, W, X0), row(P, W, DX0)
    stage, k2 = row(P, W, STAGE), row(P, W, K2)
    d0, d1 = rms(P, F, W, x, x, 0.0), rms(P, F, W, dx, dx, 0.0)
    h0 = 1e-6 if d0 < 1e-5 or d1 < 1e-5 else 0.01 * d0 / d1
    h0 = min(h0, length)
    for i in range(P[STATES]):
        stage[i] = x[i] + h0 * dx[i]
    flow(P, F, K, W, t + h0, stage, k2)
    d2 = rms(P, F, W, k2, dx, -1.0) / h0
    at_rest = d1 <= 1e-15 and d2 <= 1e-15
    h1 = max(1e-6, h0 * 1e-3) if at_rest else (0.01 / max(d1, d2)) ** 0.125
    return min(min(100.0 * h0, h1), min(length, F[MAX_STEP]))
