"""The march: the integration of a hybrid system over one arc, from an event to the next (`travel`).

It takes integration steps between breaks, which are sample instants and switching times of inputs, and after
each step looks for an event: an event function (of the guard number `guard`) that falls through zero.

This text runs twice. In Python its operations (`flow`, `watch`, `add`, ..) are those of `hybrid.on_arrays`,
around any `HybridSystem`. Compiled by numba they are those of `engine.kernels.operations`, around machine
code; a `unit` then is a function of its own, an `inner` a part of its callers. r is the run in memory, with the
same names in both. Functions write vectors into arrays of r or the argument `out`:

    x0, dx0, x1, dx1       state and slope (nx,) at both ends of the step
    values, after, tried   event functions (guards,): at the start of the step or of the stretch of it that is
                           searched, at the end of that, and at the time tried last
    x_e, dx_e, t_event     state and slope (nx,) at the time tried last; time of the event [s]
    y0, N0, y1, N1         for ETD-RK4: coordinates and remainder at both ends of the step
    t, t_arc, t_end        time now, start of the arc, its latest end [s]
    limit                  latest time [s] at which inputs are evaluated: just before the next break
    h, kind                integration step [s]; method: RK4, ETD (ETD-RK4) or SOLVER (SciPy's, in Python alone)
    moving, p              how many numbers of x flow, the first ones, the others being held; number of motors
    lags, lag_speed        above 0 where motors lag: their torques relax to the command with 1 / tau [1/s]
    fired                  number of the event function that ended the arc before, -1 for none

Operations whose names do not say it: `watch` computes all event functions, `relax(r, x, w, out)` sets each
torque of a lagging motor in `out` to its command plus w times its distance from it in x, `slow` says whether
angles and rates are within their bounds, `broken` gives the code for a state that is not finite, `accepts` and
`code_of` say whether a zero is an event, and with which code.

A code is an int: 0 to go on, STRUCK for an event with a reset, else how the arc ends (`hybrid.constants`). A
node is an instant (t, x, x') that is stored: each `every`-th step of integration, none for every = 0.

ETD-RK4 (`hybrid.exponential`) steps in the coordinates y = (w, E), w' = N_w, E' = A E + N_E; N = (N_w, N_E) is
the remainder, `split` computes y from x, and `join` x from y. A length that is not the step h is taken in
sub-steps h 2^-level, level = 1, 2, .., whose matrices are prepared, and what is left below the last level by
one step of RK4 (`classical`), which is stable there.

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
    """dx (nx,) = slope at (t, x) for a step of RK4 of length h [s] with lagging motors.

    Motion: the flow for torques whose distance from the command is P(0) times that in x; P(0) is the weight of
    the first stage in `hybrid.relaxation`, with theta = h / tau. The slope of the torques themselves serves the
    cubic of dense output alone, and is limited to 3 / h times their distance: a steeper cubic overshoots.
    """
    theta = r.lag_speed * h
    copy(x, r.stage, r.nx)
    relax(r, x, weights(theta)[0], r.stage)  # [0]: P(0)
    flow(r, t, r.stage, dx)
    relax_slope(r, x, -min(theta, 3.0) / h if h > 0.0 else 0.0, dx)


@unit
def classical(r: Run, t: float, x: Array, dx: Array, h: float, out: Array) -> None:
    """out (nx,) = the state after one step of RK4 of length h [s] from (t, x), where the slope is dx (nx,).

    Only the first r.moving numbers of x flow; the rest is held. Of the rest the flow reads only the last r.p,
    the torques on the joints, so each stage has these. With lagging motors (r.lags > 0) dx is computed anew by
    `lagging`, and their torques are exact.
    """
    m, rest, stage, middle, last, end = r.moving, r.nx - r.moving, r.stage, 0.0, 0.0, 0.0
    if rest > 0:  # shift(x, i): the vector x from its entry i on
        copy(shift(x, r.nx - r.p), shift(stage, r.nx - r.p), r.p)
    if r.lags > 0:
        # distances of the torques from the command, as shares: P(1/2), P(1) at stages, e^(-theta) at the end
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
    """out = y after one step of ETD-RK4 from (t, y), where the remainder is N; level: of the matrices, whose
    step has the length h = r.h 2^-level [s].

    The equations of `hybrid.exponential` for E; w, the first nw numbers, takes RK4 with the same stages.
    `matvec` sets E of its last argument to a matrix times E; `apply_input` adds factor times a matrix times
    N_E.
    """
    # stage a is in r.y_a; stage b, and then c, in r.y_b
    # HALF, HALF_PHI: e^(hA/2), h/2 phi1(hA/2)
    half, half_phi = matrix(r, level, HALF), matrix(r, level, HALF_PHI)
    # MIDDLE: weight of N(a) + N(b) in E1
    middle, a, b, nw = matrix(r, level, MIDDLE), r.y_a, r.y_b, r.n_slow
    matvec(r, half, y, r.e_half)
    copy(r.e_half, a, r.nx)
    copy(r.e_half, b, r.nx)
    add(y, 0.5 * h, N, a, nw)
    apply_input(r, half_phi, 1.0, N, a)  # a = e^(hA/2) E + h/2 phi1(hA/2) N(E)
    remainder(r, t + 0.5 * h, a, r.N_a)
    add(y, 0.5 * h, r.N_a, b, nw)
    apply_input(r, half_phi, 1.0, r.N_a, b)  # b, the same with N(a)
    remainder(r, t + 0.5 * h, b, r.N_b)
    matvec(r, half, a, b)
    add(y, h, r.N_b, b, nw)
    apply_input(r, half_phi, 2.0, r.N_b, b)
    apply_input(r, half_phi, -1.0, N, b)  # c = e^(hA/2) a + h/2 phi1(hA/2) (2 N(b) - N(E))
    remainder(r, t + h, b, r.N_c)
    # E1, the end of the step
    # FULL_STEP: e^(hA); FIRST, LAST: weights of N(E) and N(c)
    matvec(r, matrix(r, level, FULL_STEP), y, out)
    apply_input(r, matrix(r, level, FIRST), 1.0, N, out)
    apply_input(r, middle, 1.0, r.N_a, out)
    apply_input(r, middle, 1.0, r.N_b, out)
    apply_input(r, matrix(r, level, LAST), 1.0, r.N_c, out)
    rk4_sum(y, h, N, r.N_a, r.N_b, r.N_c, out, nw)


@unit
def halve(r: Run, guard: int, t: float, ta: float, tb: float, fb: float) -> None:
    """Take sub-steps of ETD-RK4 from (t, y0) as near as they come to tb [s], or to the zero of an event
    function in (ta, tb] [s], without passing it.

    guard: its number; it is above zero at ta, and fb, its value at tb, is not. -1: towards tb alone, with
    ta = tb and fb unused. Binary search: a sub-step h 2^-level of each level is taken or left out. One that
    ends behind the zero is left out, and its end replaces tb. Results: state and slope x_b, dx_b (nx,) at t_b
    [s]; t_far [s], f_far: tb and fb at the end.
    """
    # count: length of the sub-steps taken so far, in units of the finest one; now: the time there [s]
    levels, count, now = r.levels, 0, t
    y, N, trial, x = r.y_sub, r.N_sub, r.y_try, r.x_b
    copy(r.y0, y, r.nx)
    copy(r.N0, N, r.nN)
    finest = r.h * 0.5 ** (levels - 1)
    for level in range(1, levels):
        # length with the sub-step of this level, and the time [s] at its end
        further = count + (1 << (levels - 1 - level))
        end = t + further * finest
        if end > ta and end >= tb:
            continue  # too far; with ta = tb a sub-step may end at tb itself, else tb is behind the zero
        exponential(r, level, now, end - now, y, N, trial)
        if end > ta:
            join(r, trial, x)
            watch(r, end, x, r.tried)
            # at or behind the zero; so written, NaN counts as behind it
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
    """Set x_e and `tried`: state and event functions at s [s], by one step of RK4 from (t, x), where the slope
    is dx (nx,), or by a solver's dense output.
    """
    # numba compiles both branches, so `operations` has a `dense` too, though no compiled run gets there
    if r.kind == SOLVER:
        dense(r, s)
    else:
        classical(r, t, x, dx, s - t, r.x_e)
    watch(r, s, r.x_e, r.tried)


@unit
def retake(r: Run, t0: float, s: float) -> None:
    """Set x_e and `tried` to state and event functions at s [s], inside the step that began at t0 [s]."""
    # sub-steps towards s without an event function (-1), then RK4 from where they end
    if r.kind == ETD:
        halve(r, -1, t0, s, s, 0.0)
        reach(r, r.t_b, r.x_b, r.dx_b, s)
    else:
        reach(r, t0, r.x0, r.dx0, s)


@inner
def brent(
    r: Run, guard: int, base: float, x: Array, dx: Array, ta: float, fa: float, tb: float, fb: float
) -> float:
    """Time [s] in [ta, tb] at which the guard's event function is zero, by Brent's method, whose iterates are
    those of `scipy.optimize.brentq`.

    fa, fb: its values at ta and tb [s], of opposite signs. States in between are one step from (base, x), where
    the slope is dx (nx,). Secant or inverse quadratic steps, bisection where those do not shrink the bracket.
    """
    # written out, since compiled code cannot call SciPy; with two root finders the engines would find two
    # times of one event, and every number after it would differ
    # now: best iterate; before: the one before it; other: end of the bracket on the other side of the zero;
    # step, last: the present change of `now`, and the one before
    before, f_before, now, f_now = ta, fa, tb, fb
    other, f_other = before, f_before
    last = step = now - before
    for _ in range(ITERATIONS):
        if f_now == 0.0 or f_now != f_now:  # NaN, of a state that is not finite, which ends the run
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
    """Time [s] in (ta, tb] at which the guard's event function crosses zero, in the step from t0 [s].

    It is `values` at ta and `after` at tb. x_e and `tried` are set to the crossing. For ETD-RK4 sub-steps
    narrow the bracket first; Brent's method goes on within it with steps of RK4.
    """
    fa, fb = r.values[guard], r.after[guard]
    base, x, dx = t0, r.x0, r.dx0
    if r.kind == ETD:
        halve(r, guard, t0, ta, tb, fb)
        base, tb, fb, x, dx = r.t_b, r.t_far, r.f_far, r.x_b, r.dx_b
        # the sub-steps have passed ta without the zero: the bracket begins where they end
        if base > ta:
            watch(r, base, x, r.tried)
            ta, fa = base, r.tried[guard]
    te = brent(r, guard, base, x, dx, ta, fa, tb, fb)
    reach(r, base, x, dx, te)  # Brent's last trial may be another time than te
    return te


@inner
def crossed(r: Run, t0: float, ta: float, tb: float) -> int:
    """Code of the earliest event in (ta, tb] [s] of the step from t0 [s], 0 for none; its time goes into
    t_event, its state into x_e.

    Every crossing of zero is located, from `values` at ta to `after` at tb, and the earliest counts whose guard
    accepts it. A state that is not finite at a time that was tried ends the run: nothing is known of the event.
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
    if first_guard != last:  # x_e belongs to the crossing that was located last
        first = locate(r, first_guard, t0, ta, tb)
    r.t_event = first
    return code_of(r, first_guard)


@inner
def pieces(t0: float, t1: float) -> int:
    """Number of equal stretches into which a step from t0 to t1 [s] is cut, none longer than RESOLUTION [s] but
    for round-off (1e-9).
    """
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
    """Code of an event at t0 [s], the start of an arc, 0 for none.

    It is that of an event function, other than the one that has fired, which is at zero or below there and then
    falls (`values` at t0, `after` just behind): two events fell together, or a reset or the start put it there.
    One that fell through zero well before the last event (`passed`) does not count, as its event is over.
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
    """Code of an event in [t0, s] [s], the start of an arc, where an event function w begins at zero or below;
    0 for none. `values` become those at s. s - t0 is at most TOGETHER: closer events are not told apart.

    A w that rises from zero is positive at s, so `event` watches it from there, however soon it falls again.
    For a w that is zero at t0 and negative at s, the ratio w(s) / w(half-way) shows the form:

        2           a steady fall: no event if w has just fired, since its time is over; another w fires at t0
                    (`overdue`)
        4 or more   bent down, as -(t - t0)^2, or down again after a hop shorter than s: a ball at rest on its
                    floor, whose events follow too closely (EVENT_LIMIT)

    The limit between both is 3.
    """
    # retake: the step taken again up to a time inside it; `tried` are the event functions there
    retake(r, t0, t0 + 0.5 * (s - t0))
    copy(r.tried, r.after, r.guards)
    retake(r, t0, s)
    for guard in range(r.guards):
        w = r.tried[guard]
        # after: half-way; both are negative, so `<` means a ratio above 3
        if r.values[guard] == 0.0 > w and w < 3.0 * r.after[guard] and accepts(r, guard, t0):
            return EVENT_LIMIT
    copy(r.tried, r.after, r.guards)
    # an event at t0 itself; the earliest one in (t0, s] only if the first code is 0, no event
    code = overdue(r, t0) or crossed(r, t0, t0, s)
    copy(r.after, r.values, r.guards)
    return code


@unit
def event(r: Run, t0: float, t1: float) -> int:
    """Code of the earliest event in the step from (t0, x0) to (t1, x1), times in [s], 0 for none.

    A step longer than RESOLUTION is searched stretch by stretch, so that the first of two events is found, and
    an event function that falls through zero and rises again. Without an event `values` become those at t1.
    """
    # before: up to here the step has been searched [s]
    count, before = pieces(t0, t1), t0
    if t0 == r.t_arc and begins_low(r):
        # an event function begins at zero or below: `lift` finds an event in the first TOGETHER [s] of the arc
        # (closer events are not told apart); the search below begins after that time
        before = min(t0 + TOGETHER, t1)
        code = lift(r, t0, before)
        if code != 0:
            return code
    watch(r, t1, r.x1, r.after)
    # suspect: a cheap first look at the stretches of a long step; False where no event can lie in it
    if count > 1 and not suspect(r, t0, t1, count):
        copy(r.after, r.values, r.guards)
        return 0
    for j in range(1, count + 1):
        at = t1 if j == count else t0 + (t1 - t0) * j / count
        if j < count:
            retake(r, t0, at)
            copy(r.tried, r.after, r.guards)
        elif count > 1:  # `after` has been overwritten at the interior points
            watch(r, t1, r.x1, r.after)
        code = crossed(r, t0, before, at)
        copy(r.after, r.values, r.guards)
        if code != 0:
            return code
        before = at
    return 0


@inner
def arm(r: Run) -> None:
    """Set `values` to the event functions at the start of an arc.

    The one that has just fired differs from zero by round-off alone and is set to zero, as `lift`, which looks
    for events at the start of an arc, expects. armed = 1: the values are set.
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
    """Store a node (t, x, x') at t [s], unless this run stores none.

    r.look is the address of a compiled function that computes signals, 0 for none and in Python. With it the
    node has t and the signals in place of x and x', and every step is stored, whatever `every` says.
    """
    if r.every > 0 or r.look != 0:
        node(r, t, x, dx)


@inner
def nodes(r: Run, t0: float, t1: float) -> None:
    """Store the end of a step from t0 to t1 [s] as a node; where every step is stored, points inside a long
    step too, for which one cubic would be too coarse.
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
    """Compute what the first step after a break at t [s], of length h [s], needs besides x0: the slope dx0, and
    for ETD-RK4 y0 and N0.

    After a sample instant of a compiled run dx0 is known already (r.sloped = 1). ETD-RK4 needs dx0 for nodes
    alone. h: with lagging motors the slope depends on the length of the step (`lagging`).
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
    """Take a step of RK4 or ETD-RK4 from (t, x0) to (t1, x1), times in [s], and compute what the next step
    starts from: dx1, for ETD-RK4 N1. Returns a code, 0 for no failure.

    last: 1 for the step before a break, after which slope and remainder would be wasted, else 0. A step of
    ETD-RK4 that is not h long is made of sub-steps and one step of RK4.
    """
    x1 = r.x1
    if r.kind == RK4:
        classical(r, t, r.x0, r.dx0, t1 - t, x1)
    elif abs(t1 - t - r.h) <= SAME_STEP * r.h:  # a full step, with the matrices of level 0
        exponential(r, 0, t, t1 - t, r.y0, r.N0, r.y1)
        join(r, r.y1, x1)
    else:
        # sub-steps up to (t_b, x_b), as near to t1 as they come; -1 and 0.0: no event is looked for
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
    """Set x0 (nx,) and t to the event just found, and store a node with the slope from the left; returns
    `code`, that of the event.

    Where its state x_e is not finite, x0 and t do not change, and another code says so. An arc without duration
    has its node already.
    """
    te = r.t_event
    if not finite(r.x_e, r.nx):
        return broken(r)
    copy(r.x_e, r.x0, r.nx)
    r.t = te
    if te == r.t_arc:
        return code
    if r.every > 0:  # the node needs the slope just before the event
        flow(r, left(te), r.x0, r.dx0)
    keep(r, te, r.x0, r.dx0)
    return code


@unit
def through(r: Run, t_next: float) -> int:
    """Take the steps from x0 at t to t_next [s], between which there is no break; returns a code, 0 at t_next.

    Steps are counted and their length not added up, so round-off does not grow. More than MOST_STEPS steps,
    or a step without length, end as STEP_FAILED. A compiled run with r.pause returns after each step, PAUSED,
    and goes on when it is called again (r.done: steps so far, r.t_from: time of the first [s]).
    """
    steps, r.done = r.done, 0
    if steps == 0:
        r.t_from = r.t
    t0, t = r.t_from, r.t
    skipped, code = 0, 0  # skipped: steps since the last node
    r.limit = left(t_next)
    # LANDING: round-off in the count. np.ceil gives a float in both engines; math.ceil would give an
    # int, which has only 64 bits when compiled
    count = max(1.0, np.ceil((t_next - t0) / r.h - LANDING))
    if steps == 0:
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
        # in a compiled run with r.look: the next stretch stores this instant too, so at t_next it is stored
        # here only where a force from outside may jump (r.pulled)
        if r.look != 0 and (t < t_next or r.pulled != 0):
            node(r, t, r.x0, r.dx0)
        if r.pause != 0 and t < t_next:
            r.done = steps
            return PAUSED
    return 0


@inner
def travel(r: Run) -> int:
    """Integrate from x0 at t to the first event or to t_end; returns a code, COMPLETED at t_end.

    Each round: the sample instants that are due now, then steps to the next break. x0 (nx,) and t [s] become
    those of the end.
    """
    while r.t < r.t_end:
        r.limit = math.inf  # a sample instant sees inputs as they are after a switch at this time
        code = due(r)
        if code == 0:
            code = through(r, next_break(r))
        if code != 0:
            return code
    return COMPLETED
