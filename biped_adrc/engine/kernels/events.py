"""Crossings of the event functions in a step, located on the step itself, taken again with a shorter length.

A step longer than RESOLUTION could hide two crossings. It is looked through first on the cubic
Hermite polynomial of q, which costs nothing but event functions; only where that shows a crossing
are interior points of the step taken again. The time is found by Brent's method, as SciPy's, so
that x- has the accuracy of the method and both engines find the same event.

Rows XE and TRIED are left at the event: state, and values of the event functions.
"""

from __future__ import annotations

import math

from biped_adrc.engine.kernels.call import Ints, inner, shift, unit
from biped_adrc.engine.kernels.laws import broken, copy, finite, row, watch
from biped_adrc.engine.kernels.layout import *
from biped_adrc.engine.kernels.steps import classical, halve
from biped_adrc.types import Array


@inner
def reach(P: Ints, F: Array, K: Array, W: Array, t: float, x: Array, dx: Array, s: float) -> None:
    """Rows XE and TRIED: state and event functions at s [s], by one classical step from (t, x), with the
    slope dx; both (nx,).
    """
    xe = row(P, W, XE)
    classical(P, F, K, W, t, x, dx, s - t, xe)
    watch(P, F, K, W, s, xe, row(P, W, TRIED))


@unit
def retake(P: Ints, F: Array, K: Array, W: Array, t0: float, s: float) -> None:
    """Rows XE and TRIED: state and event functions at s [s] of the step that began at t0 [s].

    For ETD-RK4 by sub-steps with prepared matrices, and one classical step for what is left.
    """
    if P[KIND] == ETD:
        halve(P, F, K, W, -1, t0, s, s, 0.0)
        reach(P, F, K, W, W[LANDED], row(P, W, XB), row(P, W, DXB), s)
    else:
        reach(P, F, K, W, t0, row(P, W, X0), row(P, W, DX0), s)


@inner
def brent(
    P: Ints,
    F: Array,
    K: Array,
    W: Array,
    guard: int,
    base: float,
    x: Array,
    dx: Array,
    before: float,
    f_before: float,
    now: float,
    f_now: float,
) -> float:
    """Time [s] of a root by Brent's method as in `scipy.optimize.brentq`, whose iterates it repeats.

    The guard's event function is f_before at `before` and f_now at `now` [s]; states in between are
    one step from (base, x), x (nx,), dx (nx,). Secant or inverse quadratic steps, bisection where
    those do not shrink the bracket.
    """
    other, f_other = before, f_before
    last = step = now - before
    for _ in range(ITERATIONS):
        if f_now == 0.0 or f_now != f_now:  # a state that is not finite, which ends the run
            return now
        if (f_before < 0.0) != (f_now < 0.0):
            other, f_other = before, f_before
            last = step = now - before
        if abs(f_other) < abs(f_now):
            before, now, other = now, other, now
            f_before, f_now, f_other = f_now, f_other, f_now
        delta, half = 0.5 * (XTOL + XRTOL * abs(now)), 0.5 * (other - now)
        if f_now == 0.0 or abs(half) < delta:
            return now
        trial = math.inf
        if abs(last) > delta and abs(f_now) < abs(f_before):
            if before == other:
                trial = -f_now * (now - before) / (f_now - f_before)
            else:
                d_before = (f_before - f_now) / (before - now)
                d_other = (f_other - f_now) / (other - now)
                scale = d_other * d_before * (f_other - f_before)
                trial = -f_now * (f_other * d_other - f_before * d_before) / scale
        if 2.0 * abs(trial) < min(abs(last), 3.0 * abs(half) - delta):
            last, step = step, trial
        else:
            last = step = half
        before, f_before = now, f_now
        if abs(step) > delta:
            now += step
        else:
            now += delta if half > 0.0 else -delta
        reach(P, F, K, W, base, x, dx, now)
        f_now = row(P, W, TRIED)[guard]
    return now


@unit
def locate(
    P: Ints, F: Array, K: Array, W: Array, guard: int, t0: float, ta: float, tb: float
) -> float:
    """Time [s] of the guard's crossing in (ta, tb] of the step from t0; rows XE and TRIED are left there.

    For ETD-RK4 sub-steps narrow the bracket first, down to the shortest one; Brent's method goes on
    within it with classical steps, which are stable at that length.
    """
    fa, fb = W[VALUES + guard], row(P, W, AFTER)[guard]
    base, x, dx = t0, row(P, W, X0), row(P, W, DX0)
    if P[KIND] == ETD:
        halve(P, F, K, W, guard, t0, ta, tb, fb)
        base, tb, fb = W[LANDED], W[FAR], W[FAR_VALUE]
        x, dx = row(P, W, XB), row(P, W, DXB)
        if base > ta:
            watch(P, F, K, W, base, x, row(P, W, TRIED))
            ta, fa = base, row(P, W, TRIED)[guard]
    te = brent(P, F, K, W, guard, base, x, dx, ta, fa, tb, fb)
    reach(P, F, K, W, base, x, dx, te)
    return te


@inner
def crossed(P: Ints, F: Array, K: Array, W: Array, t0: float, ta: float, tb: float) -> int:
    """Code of the earliest event in (ta, tb] [s], 0 for none; its time goes into EVENT, its state
    into row XE.

    Every event function that falls through zero is located and the earliest counts. A touchdown
    less than LEAST_STEP ahead of the stance foot is no event, so the others are still looked at. A
    state without numbers at a time that was tried is a status: nothing is known of the event.
    """
    after, tried = row(P, W, AFTER), row(P, W, TRIED)
    first, first_guard, last = math.inf, -1, -1
    for guard in range(GUARDS):
        if W[VALUES + guard] > 0.0 >= after[guard]:
            te, last = locate(P, F, K, W, guard, t0, ta, tb), guard
            if not finite(row(P, W, XE), P[STATES]):
                return broken(W)
            ahead = tried[FOOT_X] > F[LEAST_STEP]
            if te < first and (guard != FOOT_STRIKE or ahead):
                first, first_guard = te, guard
    if first_guard < 0:
        return 0
    if first_guard != last:
        first = locate(P, F, K, W, first_guard, t0, ta, tb)
    W[EVENT] = first
    if first_guard == FOOT_STRIKE:
        return STRUCK
    return FELL if first_guard == HIP_TOO_LOW else STALLED


@inner
def pieces(t0: float, t1: float) -> int:
    """How many stretches no longer than RESOLUTION make a step from t0 to t1 [s]."""
    return max(1, math.ceil((t1 - t0) / RESOLUTION - 1e-9))


@inner
def hermite(P: Ints, W: Array, h: float, s: float, out: Array) -> None:
    """out (n,) [rad] = q at the fraction s of the step of length h [s] from X0 to X1.

    The cubic through both states with their rates as slopes; q alone, since event functions need no
    more.
    """
    n, x0, x1 = P[COORDINATES], row(P, W, X0), row(P, W, X1)
    for i in range(n):
        rise = x1[i] - x0[i]
        bend = (1.0 - s) * (h * x0[n + i] - rise) - s * (h * x1[n + i] - rise)
        out[i] = x0[i] + s * rise + s * (1.0 - s) * bend


@inner
def suspect(P: Ints, F: Array, K: Array, W: Array, t0: float, t1: float, count: int) -> bool:
    """Whether an event function falls through zero between `count` points of the Hermite polynomial.

    A cheap first look at a long step: no flow is evaluated. Row AFTER has the values at t1 [s]
    already.
    """
    stage = row(P, W, STAGE)
    v0, v1, v2 = W[VALUES], W[VALUES + 1], W[VALUES + 2]
    for j in range(1, count + 1):
        w = row(P, W, AFTER)
        if j < count:
            w = row(P, W, TRIED)
            hermite(P, W, t1 - t0, j / count, stage)
            watch(P, F, K, W, t0 + (t1 - t0) * j / count, stage, w)
        w0, w1, w2 = w[0], w[1], w[2]
        if v0 > 0.0 >= w0 or v1 > 0.0 >= w1 or v2 > 0.0 >= w2:
            return True
        v0, v1, v2 = w0, w1, w2
    return False


@unit
def event(P: Ints, F: Array, K: Array, W: Array, t0: float, t1: float) -> int:
    """Code of the earliest event in the step from (t0, X0) to (t1, X1), times in [s], 0 for none.

    A long step is looked through stretch by stretch, so the first of two events in it is found.
    Without an event VALUES become those at t1.
    """
    count, x1, w = pieces(t0, t1), row(P, W, X1), row(P, W, AFTER)
    watch(P, F, K, W, t1, x1, w)
    if count > 1 and not suspect(P, F, K, W, t0, t1, count):
        copy(w, shift(W, VALUES), GUARDS)
        return 0
    before = t0
    for j in range(1, count + 1):
        after = t1 if j == count else t0 + (t1 - t0) * j / count
        if j < count:
            retake(P, F, K, W, t0, after)
            copy(row(P, W, TRIED), w, GUARDS)
        elif count > 1:
            watch(P, F, K, W, t1, x1, w)
        found = crossed(P, F, K, W, t0, before, after)
        copy(w, shift(W, VALUES), GUARDS)
        if found != 0:
            return found
        before = after
    return 0
