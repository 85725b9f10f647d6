"""The march of a hybrid system through time: steps, event functions, the place of an event, breaks.

This text runs twice. In Python its operations (`flow`, `watch`, `add`, ..) are those of `hybrid.on_arrays`,
around any `HybridSystem`. Compiled by numba they are those of `engine.kernels.operations`, around machine
code. r is the run in memory, the same names in both.

ETD-RK4 steps in the coordinates y = (w, E) of the module `hybrid.exponential`. A length that is not the step
h is taken in sub-steps h 2^-level, whose matrices are prepared, and what is left below the last level by one
classical step, which is stable there.

An event is located on the step itself, taken again with a shorter length, so that x- has the accuracy of the
method and both engines find the same event.
"""

from __future__ import annotations

import math

import numpy as np

from biped_adrc.core.types import Array

# The stars bring `flow`, `add`, `Run`, .. in as bare names. `engine.kernels.write` leaves these imports out of
# the text that numba compiles, and the same names are then those of `engine.kernels.operations`. With a prefix
# (`on_arrays.flow`) the march would need a text for each engine, and the two could find different events.
from biped_adrc.hybrid.constants import *
from biped_adrc.hybrid.on_arrays import *
from biped_adrc.hybrid.relaxation import relaxation

# `relaxation` is plain Python and imports nothing of this; compiled code can call decorated functions alone.
weights = inner(relaxation)

# The annotations of a `unit` are its signature in machine code (`engine.kernels.call`). A wrong one breaks the
# compiled engine alone, and a run in Python does not show it.


# -- steps -----------------------------------------------------------------------------------------
@unit
def lagging(r: Run, t: float, x: Array, h: float, dx: Array) -> None:
    """Slope dx (nx,) of the first stage of a step of length h [s] with lagging motors (`hybrid.relaxation`).

    For dense output the motors' slope is no steeper than a cubic without overshoot may be.
    """
    theta = r.lag_speed * h
    copy(x, r.stage, r.nx)
    relax(r, x, weights(theta)[0], r.stage)
    flow(r, t, r.stage, dx)
    relax_slope(r, x, -min(theta, 3.0) / h if h > 0.0 else 0.0, dx)


@unit
def classical(r: Run, t: float, x: Array, dx: Array, h: float, out: Array) -> None:
    """out (nx,) = one step of RK4 of length h [s] from (t, x) with the slope dx (nx,).

    Only the first r.moving numbers move; the rest is held. The last r.p of it are the torques on the joints,
    all that a flow reads of it. Torques of lagging motors are exact.
    """
    m, rest, stage, middle, last, end = r.moving, r.nx - r.moving, r.stage, 0.0, 0.0, 0.0
    if rest > 0:
        copy(shift(x, r.nx - r.p), shift(stage, r.nx - r.p), r.p)
    if r.lags > 0:
        _, middle, last, end = weights(r.lag_speed * h)
        lagging(r, t, x, h, r.k1)
        dx = r.k1
    add(x, 0.5 * h, dx, stage, m)
    if r.lags > 0:
        relax(r, x, middle, stage)
    flow(r, t + 0.5 * h, stage, r.k2)
    add(x, 0.5 * h, r.k2, stage, m)
    if r.lags > 0:
        relax(r, x, middle, stage)
    flow(r, t + 0.5 * h, stage, r.k3)
    add(x, h, r.k3, stage, m)
    if r.lags > 0:
        relax(r, x, last, stage)
    flow(r, t + h, stage, r.k4)
    copy(shift(x, m), shift(out, m), rest)
    rk4_sum(x, h, dx, r.k2, r.k3, r.k4, out, m)
    if r.lags > 0:
        relax(r, x, end, out)


@unit
def exponential(r: Run, level: int, t: float, h: float, y: Array, N: Array, out: Array) -> None:
    """out = y after one step of ETD-RK4 from (t, y) with the remainder N; h [s] is the length of that level.

    The equations of `hybrid.exponential`, stages a, and b and c in turn; w takes RK4 with the same stages.
    """
    half, half_phi = matrix(r, level, HALF), matrix(r, level, HALF_PHI)
    middle, a, b, nw = matrix(r, level, MIDDLE), r.y_a, r.y_b, r.n_slow
    matvec(r, half, y, r.e_half)
    copy(r.e_half, a, r.nx)
    copy(r.e_half, b, r.nx)
    add(y, 0.5 * h, N, a, nw)
    apply_input(r, half_phi, 1.0, N, a)
    remainder(r, t + 0.5 * h, a, r.N_a)
    add(y, 0.5 * h, r.N_a, b, nw)
    apply_input(r, half_phi, 1.0, r.N_a, b)
    remainder(r, t + 0.5 * h, b, r.N_b)
    matvec(r, half, a, b)
    add(y, h, r.N_b, b, nw)
    apply_input(r, half_phi, 2.0, r.N_b, b)
    apply_input(r, half_phi, -1.0, N, b)
    remainder(r, t + h, b, r.N_c)
    matvec(r, matrix(r, level, FULL_STEP), y, out)
    apply_input(r, matrix(r, level, FIRST), 1.0, N, out)
    apply_input(r, middle, 1.0, r.N_a, out)
    apply_input(r, middle, 1.0, r.N_b, out)
    apply_input(r, matrix(r, level, LAST), 1.0, r.N_c, out)
    rk4_sum(y, h, N, r.N_a, r.N_b, r.N_c, out, nw)


@unit
def halve(r: Run, guard: int, t: float, ta: float, tb: float, fb: float) -> None:
    """Sub-steps from (t, y0) that end before tb [s], and after ta [s] only before the guard's crossing.

    Binary search: a sub-step of each level is taken or left out. One that ends behind the crossing is not taken
    and becomes the end of the bracket. The state is left in x_b, dx_b (nx,), its time in t_b, the end of the
    bracket with its event function in t_far, f_far. guard -1: towards tb alone.
    """
    levels, count, now = r.levels, 0, t
    y, N, trial, x = r.y_sub, r.N_sub, r.y_try, r.x_b
    copy(r.y0, y, r.nx)
    copy(r.N0, N, r.nN)
    finest = r.h * 0.5 ** (levels - 1)
    for level in range(1, levels):
        further = count + (1 << (levels - 1 - level))
        end = t + further * finest
        if end > ta and end >= tb:
            continue
        exponential(r, level, now, end - now, y, N, trial)
        if end > ta:
            join(r, trial, x)
            watch(r, end, x, r.tried)
            if not r.tried[guard] > 0.0:
                tb, fb = end, r.tried[guard]
                continue
        count, now = further, end
        copy(trial, y, r.nx)
        remainder(r, now, y, N)
    join(r, y, x)
    flow(r, now, x, r.dx_b)
    r.t_b, r.t_far, r.f_far = now, tb, fb


# -- events ----------------------------------------------------------------------------------------
@inner
def reach(r: Run, t: float, x: Array, dx: Array, s: float) -> None:
    """x_e and `tried`: state and event functions at s [s], one step from (t, x) with the slope dx (nx,)."""
    # numba compiles both branches, so `operations` has a `dense` too, though no compiled run gets there
    if r.kind == SOLVER:
        dense(r, s)
    else:
        classical(r, t, x, dx, s - t, r.x_e)
    watch(r, s, r.x_e, r.tried)


@unit
def retake(r: Run, t0: float, s: float) -> None:
    """x_e and `tried` at s [s] of the step that began at t0 [s]."""
    if r.kind == ETD:
        halve(r, -1, t0, s, s, 0.0)
        reach(r, r.t_b, r.x_b, r.dx_b, s)
    else:
        reach(r, t0, r.x0, r.dx0, s)


@inner
def brent(
    r: Run, guard: int, base: float, x: Array, dx: Array, ta: float, fa: float, tb: float, fb: float
) -> float:
    """Time [s] of a root by Brent's method, whose iterates are those of `scipy.optimize.brentq`.

    The guard's event function is fa at ta [s] and fb at tb [s]; states in between are one step from (base, x).
    Secant or inverse quadratic steps, bisection where those do not shrink the bracket.
    """
    # written out, since compiled code cannot call SciPy; with two root finders the engines would find two
    # times of one event, and every number after it would differ
    before, f_before, now, f_now = ta, fa, tb, fb
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
        reach(r, base, x, dx, now)
        f_now = r.tried[guard]
    return now


@unit
def locate(r: Run, guard: int, t0: float, ta: float, tb: float) -> float:
    """Time [s] of the guard's crossing in (ta, tb] of the step from t0; x_e and `tried` are left there.

    For ETD-RK4 sub-steps narrow the bracket first; Brent's method goes on within it with classical steps.
    """
    fa, fb = r.values[guard], r.after[guard]
    base, x, dx = t0, r.x0, r.dx0
    if r.kind == ETD:
        halve(r, guard, t0, ta, tb, fb)
        base, tb, fb, x, dx = r.t_b, r.t_far, r.f_far, r.x_b, r.dx_b
        if base > ta:
            watch(r, base, x, r.tried)
            ta, fa = base, r.tried[guard]
    te = brent(r, guard, base, x, dx, ta, fa, tb, fb)
    reach(r, base, x, dx, te)
    return te


@inner
def crossed(r: Run, t0: float, ta: float, tb: float) -> int:
    """Code of the earliest event in (ta, tb] [s], 0 for none; its time goes into t_event, its state into x_e.

    Every event function that falls through zero is located and the earliest that is accepted counts. A state
    that is not finite at a time that was tried ends the run: nothing is known of the event.
    """
    first, first_guard, last = math.inf, -1, -1
    for guard in range(r.guards):
        if r.values[guard] > 0.0 >= r.after[guard]:
            te, last = locate(r, guard, t0, ta, tb), guard
            if not finite(r.x_e, r.nx):
                return broken(r)
            if te < first and accepts(r, guard, te):
                first, first_guard = te, guard
    if first_guard < 0:
        return 0
    if first_guard != last:
        first = locate(r, first_guard, t0, ta, tb)
    r.t_event = first
    return code_of(r, first_guard)


@inner
def pieces(t0: float, t1: float) -> int:
    """How many stretches no longer than RESOLUTION make a step from t0 to t1 [s]."""
    return max(1, math.ceil((t1 - t0) / RESOLUTION - 1e-9))


@inner
def begins_low(r: Run) -> bool:
    """Whether an event function is at zero or below where the step starts, as after its own reset."""
    low = False
    for guard in range(r.guards):
        low = low or r.values[guard] <= 0.0
    return low


@inner
def overdue(r: Run, t0: float) -> int:
    """Code of an event at t0 [s], the start of an arc, 0 for none: another event function than the one that has
    fired is at zero or below and falls, since two events fell together or a reset or the start put it there.
    """
    copy(r.x0, r.x_e, r.nx)
    watch(r, t0, r.x_e, r.tried)
    for guard in range(r.guards):
        fall = r.values[guard] - r.after[guard]
        low = guard != r.fired and r.values[guard] <= 0.0 < fall
        if low and not passed(r, guard, fall) and accepts(r, guard, t0):
            r.t_event = t0
            return code_of(r, guard)
    return 0


@unit
def lift(r: Run, t0: float, s: float) -> int:
    """Code of an event in [t0, s] [s], the first TOGETHER of an arc; `values` become those at s.

    So an event function that begins at zero is above it at s, and watched, however soon it falls again. If it
    bent down, as s^2 does, w(s) = 4 w(s/2), and a hop shorter than s, more than that, a ball is at rest on its
    floor: the next events are not told apart (EVENT_LIMIT). One that falls steadily, 2 w(s/2), is let pass
    where it has just fired, as a time that is over; another one fires at t0 (`overdue`).
    """
    retake(r, t0, t0 + 0.5 * (s - t0))
    copy(r.tried, r.after, r.guards)
    retake(r, t0, s)
    for guard in range(r.guards):
        w = r.tried[guard]
        if r.values[guard] == 0.0 > w and w < 3.0 * r.after[guard] and accepts(r, guard, t0):
            return EVENT_LIMIT
    copy(r.tried, r.after, r.guards)
    code = overdue(r, t0) or crossed(r, t0, t0, s)
    copy(r.after, r.values, r.guards)
    return code


@unit
def event(r: Run, t0: float, t1: float) -> int:
    """Code of the earliest event in the step from (t0, x0) to (t1, x1), times in [s], 0 for none.

    A long step is looked through stretch by stretch, so the first of two events in it is found, and two
    crossings within it are. Without an event `values` become those at t1.
    """
    count, before = pieces(t0, t1), t0
    if t0 == r.t_arc and begins_low(r):
        before = min(t0 + TOGETHER, t1)
        code = lift(r, t0, before)
        if code != 0:
            return code
    watch(r, t1, r.x1, r.after)
    if count > 1 and not suspect(r, t0, t1, count):
        copy(r.after, r.values, r.guards)
        return 0
    for j in range(1, count + 1):
        at = t1 if j == count else t0 + (t1 - t0) * j / count
        if j < count:
            retake(r, t0, at)
            copy(r.tried, r.after, r.guards)
        elif count > 1:
            watch(r, t1, r.x1, r.after)
        code = crossed(r, t0, before, at)
        copy(r.after, r.values, r.guards)
        if code != 0:
            return code
        before = at
    return 0


@inner
def arm(r: Run) -> None:
    """`values` of the event functions at the start of an arc.

    What is left of the one that has just fired is round-off and taken as zero, for `lift`.
    """
    r.t_arc = r.t
    watch(r, r.t, r.x0, r.values)
    if r.fired >= 0:
        r.values[r.fired] = 0.0
    r.armed = 1


# -- the march -------------------------------------------------------------------------------------
@inner
def left(t: float) -> float:
    """The number just before t [s]: for limits from the left."""
    return float(np.nextafter(t, -np.inf))


@inner
def keep(r: Run, t: float, x: Array, dx: Array) -> None:
    """Keep a node at t [s], unless this run keeps none."""
    if r.every > 0 or r.look != 0:
        node(r, t, x, dx)


@inner
def nodes(r: Run, t0: float, t1: float) -> None:
    """Keep the end of a step from t0 to t1 [s]; where every step is kept, points inside a long one too, for
    which a cubic would be too coarse.
    """
    count = pieces(t0, t1) if r.every == 1 else 1
    for j in range(1, count):
        s = t0 + (t1 - t0) * j / count
        retake(r, t0, s)
        flow(r, s, r.x_e, r.dx_e)
        node(r, s, r.x_e, r.dx_e)
    node(r, t1, r.x1, r.dx1)


@inner
def begin(r: Run, t: float, h: float) -> None:
    """Compute what the first step after a break at t [s], h [s] long, needs besides x0: dx0, for ETD-RK4 y0
    and N0.

    After a sample instant the slope is known already (r.sloped). ETD-RK4 needs it for nodes alone.
    """
    if r.kind == ETD:
        split(r, r.x0, r.y0)
        remainder(r, t, r.y0, r.N0)
    if r.kind == RK4 and r.lags > 0:
        lagging(r, t, r.x0, h, r.dx0)
    elif (r.kind != ETD or r.every > 0) and r.sloped == 0:
        flow(r, t, r.x0, r.dx0)
    r.sloped = 0


@unit
def fixed(r: Run, t: float, t1: float, last: int) -> int:
    """x1 (nx,) and what the next step starts from, at t1 [s], by RK4 or ETD-RK4; a status.

    last: 1 for the step before a break, after which slope and remainder would be wasted. A step of ETD-RK4
    that is not h long is made of sub-steps and one classical step.
    """
    x1 = r.x1
    if r.kind == RK4:
        classical(r, t, r.x0, r.dx0, t1 - t, x1)
    elif abs(t1 - t - r.h) <= SAME_STEP * r.h:
        exponential(r, 0, t, t1 - t, r.y0, r.N0, r.y1)
        join(r, r.y1, x1)
    else:
        halve(r, -1, t, t1, t1, 0.0)
        classical(r, r.t_b, r.x_b, r.dx_b, t1 - r.t_b, x1)
    if not finite(x1, r.moving):
        return broken(r)
    if not slow(r, t1, x1):
        return RAN_AWAY
    if r.kind == ETD and last == 0:
        remainder(r, t1, r.y1, r.N1)
        if not finite(r.N1, r.nN):
            return broken(r)
    if r.every > 0 or (r.kind == RK4 and last == 0):
        flow(r, t1, x1, r.dx1)
        if not finite(r.dx1, r.moving):
            return broken(r)
    return 0


@inner
def pass_on(r: Run) -> None:
    """Make the end of a step the start of the next one: x1, dx1 (nx,), and for ETD-RK4 y1, N1."""
    copy(r.x1, r.x0, r.moving)
    copy(r.dx1, r.dx0, r.moving)
    if r.kind == ETD:
        copy(r.y1, r.y0, r.nx)
        copy(r.N1, r.N0, r.nN)


@inner
def stop(r: Run, code: int) -> int:
    """Set x0 (nx,) and t to the event just found, and keep a node with its slope from the left; returns its
    code.

    Where the state is not finite, x0 and t do not change, and the status says so. An arc of no length has its
    node already.
    """
    te = r.t_event
    if not finite(r.x_e, r.nx):
        return broken(r)
    copy(r.x_e, r.x0, r.nx)
    r.t = te
    if te == r.t_arc:
        return code
    if r.every > 0:
        flow(r, left(te), r.x0, r.dx0)
    keep(r, te, r.x0, r.dx0)
    return code


@unit
def through(r: Run, t_next: float) -> int:
    """March from x0 at t to t_next [s], without a break in between; returns a code, 0 at t_next.

    Steps are counted and their length not added up, so round-off does not grow. More than MOST_STEPS steps,
    or a step of no length, end as STEP_FAILED.
    """
    t0 = t = r.t
    skipped, steps, code = 0, 0, 0
    r.limit = left(t_next)
    # np.ceil gives a float in both engines; math.ceil would give an int, which has only 64 bits when compiled
    count = max(1.0, np.ceil((t_next - t0) / r.h - LANDING))
    begin(r, t, r.h if count > 1.0 else t_next - t)
    keep(r, t, r.x0, r.dx0)
    while t < t_next:
        steps += 1
        if r.kind == SOLVER:
            t1 = solve(r, t_next)
        else:
            t1 = t0 + steps * r.h if steps < count else t_next
            code = fixed(r, t, t1, int(steps >= count))
        if code != 0 or t1 <= t or steps > MOST_STEPS:
            return code if code != 0 else STEP_FAILED
        code = event(r, t, t1)
        if code != 0:
            return code if code == EVENT_LIMIT else stop(r, code)
        skipped += 1
        if r.every > 0 and (t1 >= t_next or skipped >= r.every):
            nodes(r, t, t1)
            skipped = 0
        pass_on(r)
        r.t = t = t1
        # the next stretch begins with the same, but for a force that jumps
        if r.look != 0 and (t < t_next or r.pulled != 0):
            node(r, t, r.x0, r.dx0)
    return 0


@inner
def travel(r: Run) -> int:
    """March from x0 at t to the first event or to t_end; returns a code, COMPLETED at t_end.

    Each round: the sample instants that are due, then steps to the next break, a sample instant or a switching
    time of an input. x0 (nx,) and t [s] are left where it ended.
    """
    while r.t < r.t_end:
        r.limit = math.inf
        code = due(r)
        if code == 0:
            code = through(r, next_break(r))
        if code != 0:
            return code
    return COMPLETED
