"""Steps over a segment in which all is smooth, to its end or the first event.

A segment lies between two breaks. Within it the method steps from X0 to X1 (for ETD-RK4 from Y0 to
Y1), the event functions are looked at after every step, and nodes (t, x, x') go into the rows of R,
every k-th step and points inside of a long one.

EVERY = 0 keeps no nodes. Then slopes that only nodes need are not computed: ETD-RK4 evaluates its
remainder, and gets x from y for the event functions.
"""

from __future__ import annotations

import numpy as np

from biped_adrc.engine.kernels.call import Ints, call, inner, shift, unit
from biped_adrc.engine.kernels.events import event, pieces, retake
from biped_adrc.engine.kernels.laws import *
from biped_adrc.engine.kernels.layout import *
from biped_adrc.engine.kernels.steps import classical, exponential, halve, lagging
from biped_adrc.types import Array


@inner
def left(t: float) -> float:
    """The number just before t [s]: for limits from the left."""
    return np.nextafter(t, -np.inf)


@inner
def node(P: Ints, W: Array, R: Array, t: float, x: Array, dx: Array) -> bool:
    """Keep (t, x, dx), x and dx (nx,), as the next row of R; False when there is no room.

    The caller then reports FULL, and Python repeats the arc with more rows.
    """
    i, nx = int(W[COUNT]), P[STATES]
    if i >= W[ROOM]:
        return False
    kept = shift(R, i * (1 + 2 * nx))
    kept[0] = t
    for j in range(nx):
        kept[1 + j], kept[1 + nx + j] = x[j], dx[j]
    W[COUNT] += 1.0
    return True


@inner
def nodes(P: Ints, F: Array, K: Array, W: Array, R: Array, t0: float, t1: float) -> bool:
    """Keep the end of a step from t0 to t1 [s], and of a long one points inside, where a cubic
    would be too coarse; False when there is no room.
    """
    count, xe, dxe = pieces(t0, t1), row(P, W, XE), row(P, W, DXE)
    for j in range(1, count):
        s = t0 + (t1 - t0) * j / count
        retake(P, F, K, W, t0, s)
        flow(P, F, K, W, s, xe, dxe)
        if not node(P, W, R, s, xe, dxe):
            return False
    return node(P, W, R, t1, row(P, W, X1), row(P, W, DX1))


@inner
def begin(P: Ints, F: Array, K: Array, W: Array, t: float, h: float) -> None:
    """What the first step of a segment at t [s], h [s] long, starts from, beside X0: slope DX0
    (nx,), for ETD-RK4 Y0 and N0.

    After a sample instant the slope is known (SLOPED) and not computed again. ETD-RK4 needs it for
    nodes only.
    """
    x, y = row(P, W, X0), row(P, W, Y0)
    if P[KIND] == ETD:
        call(P[TO], K, x, y)
        remainder(P, F, K, W, t, y, row(P, W, N0))
    if P[KIND] == RK4 and P[LAG_AT] > 0:
        lagging(P, F, K, W, t, x, h, row(P, W, DX0))
    elif (P[KIND] != ETD or W[EVERY] > 0.0) and W[SLOPED] == 0.0:
        flow(P, F, K, W, t, x, row(P, W, DX0))
    W[SLOPED] = 0.0


@unit
def fixed(P: Ints, F: Array, K: Array, W: Array, t: float, t1: float, last: int) -> int:
    """X1 (nx,) and what the next step starts from, at t1 [s], by RK4 or ETD-RK4; a status.

    last: 1 for the step before a break, after which the forces change and slope and remainder would
    be wasted. A step of ETD-RK4 that is not h long is made of sub-steps and one classical step.
    """
    sloped, x1, y1 = W[EVERY] > 0.0, row(P, W, X1), row(P, W, Y1)
    if P[KIND] == RK4:
        classical(P, F, K, W, t, row(P, W, X0), row(P, W, DX0), t1 - t, x1)
        sloped = sloped or last == 0
    elif abs(t1 - t - F[H]) <= SAME_STEP * F[H]:
        exponential(P, F, K, W, 0, t, t1 - t, row(P, W, Y0), row(P, W, N0), y1)
        join(P, K, y1, x1)
    else:
        halve(P, F, K, W, -1, t, t1, t1, 0.0)
        now = W[LANDED]
        classical(P, F, K, W, now, row(P, W, XB), row(P, W, DXB), t1 - now, x1)
    if not finite(x1, P[MOVING]):
        return broken(W)
    if not slow(P, F, x1):
        return RAN_AWAY
    if P[KIND] == ETD and last == 0:
        N = row(P, W, N1)
        remainder(P, F, K, W, t1, y1, N)
        if not regular(N, P[SLOW] + P[JOINTS]):
            return broken(W)
    if sloped:
        dx1 = row(P, W, DX1)
        flow(P, F, K, W, t1, x1, dx1)
        if not regular(dx1, P[MOVING]):
            return broken(W)
    return 0


@inner
def pass_on(P: Ints, W: Array) -> None:
    """The end of a step becomes the start of the next: X1, DX1 (nx,), and for ETD-RK4 Y1, N1."""
    copy(row(P, W, X1), row(P, W, X0), P[MOVING])
    copy(row(P, W, DX1), row(P, W, DX0), P[MOVING])
    if P[KIND] == ETD:
        copy(row(P, W, Y1), row(P, W, Y0), P[SLOW] + P[STIFF] * P[JOINTS])
        copy(row(P, W, N1), row(P, W, N0), P[SLOW] + P[JOINTS])


@inner
def stop(P: Ints, F: Array, K: Array, W: Array, R: Array, code: int) -> int:
    """X0 (nx,) and TIME at the event just found, kept as a node with its slope from the left; its code.

    FULL where there is no room for the node; then the arc is made again. A status, and all as
    before, where the state found is not finite.
    """
    te, x, dx = W[EVENT], row(P, W, X0), row(P, W, DX0)
    if not finite(row(P, W, XE), P[STATES]):
        return broken(W)
    copy(row(P, W, XE), x, P[STATES])
    W[TIME] = te
    if W[EVERY] > 0.0:
        flow(P, F, K, W, left(te), x, dx)
        if not node(P, W, R, te, x, dx):
            return FULL
    return code


@unit
def through(P: Ints, F: Array, K: Array, W: Array, t_next: float, R: Array) -> int:
    """From X0 at TIME to t_next [s], over which all is smooth; a code, 0 at t_next.

    Steps are counted and their length not added up, so round-off does not grow. More than MOST_STEPS
    steps, or a step of no length, end as STEP_FAILED.
    """
    t0 = t = W[TIME]
    every, skipped, steps, h = int(W[EVERY]), 0, 0, F[H]
    W[LIMIT] = left(t_next)
    count = max(1.0, np.ceil((t_next - t0) / h - LANDING))
    begin(P, F, K, W, t, h if count > 1.0 else t_next - t)
    if every > 0 and not node(P, W, R, t, row(P, W, X0), row(P, W, DX0)):
        return FULL
    while t < t_next:
        steps += 1
        t1 = t0 + steps * h if steps < count else t_next
        code = fixed(P, F, K, W, t, t1, int(steps >= count))
        if code != 0 or t1 <= t or steps > MOST_STEPS:
            return code if code != 0 else STEP_FAILED
        code = event(P, F, K, W, t, t1)
        if code != 0:
            return stop(P, F, K, W, R, code)
        skipped += 1
        if every > 0 and (t1 >= t_next or skipped >= every):
            if not nodes(P, F, K, W, R, t, t1):
                return FULL
            skipped = 0
        pass_on(P, W)
        W[TIME] = t = t1
    return 0
