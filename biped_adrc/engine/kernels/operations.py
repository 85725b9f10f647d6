"""The operations by which the march (`hybrid.march`) moves a compiled run r, the twins of those of
`hybrid.on_arrays`, around the functions of a walker.

A function of the walker is called by its address, with its inputs in `inp` in the order that `record.Run` has.
Its output ends with the least pivot of the matrices that the controller inverts; where that is exactly zero
(singular) or below zero (a torque beyond the bound), the status is noted in r.lost and the output made NaN,
even where a torque limit has made a finite number of it.

Symbols: x (nx,) state, its first n numbers the angles q [rad], then their rates v [rad/s]; p motors; zeta (n,)
disturbance [N m]; h integration step [s]. y = (w, E) are the coordinates of the exponential method, ETD-RK4: w
the slow states, E (k, p) the stiff ones, E' = A E + N_E, w' = N_w; rows and indices count from 0.
`values` are the event functions at the start of an integration step, `after` those at its end, `tried` those at
a time in between; x0 and x1 the states at both ends, with the slopes dx0 and dx1. A guard is an event function,
an arc the flow from one event to the next.
"""

from __future__ import annotations

import math

from biped_adrc.core.types import Array
from biped_adrc.engine.kernels.call import call, inner, shift, unit
from biped_adrc.engine.kernels.record import FOOT_STRIKE, FOOT_X, HIP_TOO_LOW, OUTSIDE, PART, Run
from biped_adrc.hybrid.constants import *


# -- vectors ---------------------------------------------------------------------------------------
@inner
def copy(x: Array, out: Array, size: int) -> None:
    """out (size,) = x (size,)."""
    for i in range(size):
        out[i] = x[i]


@inner
def add(x: Array, h: float, dx: Array, out: Array, size: int) -> None:
    """out (size,) = x + h dx."""
    for i in range(size):
        out[i] = x[i] + h * dx[i]


@inner
def rk4_sum(
    x: Array, h: float, k1: Array, k2: Array, k3: Array, k4: Array, out: Array, size: int
) -> None:
    """out (size,) = x + h / 6 (k1 + 2 (k2 + k3) + k4)."""
    for i in range(size):
        slopes = k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]
        out[i] = x[i] + (h / 6.0) * slopes


@inner
def finite(x: Array, size: int) -> bool:
    """Whether every number of x (size,) is finite."""
    good = True
    for i in range(size):
        good &= abs(x[i]) < math.inf
    return good


@inner
def matrix(r: Run, level: int, which: int) -> Array:
    """One of the six matrices (k, k) of ETD-RK4 for a step of length h 2^-level; `which`: HALF, HALF_PHI, .. of
    `hybrid.constants`.
    """
    # MATRICES: how many matrices a level has
    return shift(r.phi, (MATRICES * level + which) * r.k * r.k)


@inner
def matvec(r: Run, M: Array, y: Array, out: Array) -> None:
    """Compute E of `out` as M times E of y, both vectors (w, E), M (k, k), E (k, p); w of `out` is left as it
    is.

    By generated code, in which k and p are constants.
    """
    call(r.matvec, M, shift(y, r.n_slow), shift(out, r.n_slow))


@inner
def apply_input(r: Run, M: Array, factor: float, N: Array, out: Array) -> None:
    """Add factor * M N_E to E (k, p) of `out`. The remainder N = (N_w, row 1 of N_E) has that row alone, as the
    others are zero.
    """
    for i in range(r.k):
        weight = factor * M[i * r.k + 1]
        for c in range(r.p):
            out[r.n_slow + i * r.p + c] += weight * N[r.n_slow + c]


# -- the walker ------------------------------------------------------------------------------------
@inner
def broken(r: Run) -> int:
    """The status of a run whose state or slope is not finite: that in r.lost, which explains it, else
    NOT_FINITE."""
    return NOT_FINITE if r.lost == 0 else r.lost


@inner
def note(r: Run, out: Array, pivot: float) -> None:
    """Note the status in r.lost where a function's least pivot is not positive, and make the first number of
    its result `out` NaN: one is enough to end the run as not finite."""
    if pivot <= 0.0:
        r.lost = SINGULAR if pivot == 0.0 else RAN_AWAY
        out[0] = math.nan


@inner
def slow(r: Run, t: float, x: Array) -> bool:
    """Whether no angle and no rate in x (nx,) is beyond its bound; t is for the twin in Python, which names
    it."""
    n, fits = r.n, True
    for i in range(n):
        fits = fits and abs(x[n + i]) <= r.fastest[i] and abs(x[i]) <= r.farthest
    return fits


@inner
def set_time(r: Run, t: float) -> None:
    """Write the first three inputs of a function to `inp`: t [s], number of the single support, its start
    [s]."""
    r.inp[0], r.inp[1], r.inp[2] = t, r.step, r.t_start


@unit
def load_of(r: Run) -> None:
    """Set r.load (n + 2,) to the sum over the disturbance's terms of zeta (n,) [N m] and force (2,) [N].

    They are evaluated at the time, single support, q and v that stand in `inp`.
    """
    size, K = r.n + 2, r.push
    for i in range(size):
        r.load[i] = 0.0
    for k in range(r.n_parts):
        # PART numbers for each term: address, and how many parameters it has
        call(r.parts[PART * k], K, r.inp, r.one)
        add(r.load, 1.0, r.one, r.load, size)
        K = shift(K, r.parts[PART * k + 1])  # to the numbers of the next term


@inner
def disturb(r: Run, t: float) -> None:
    """Write t [s] and the single support to `inp`, and set r.load to the disturbance there; (q, v) stand in
    `inp` already. Without terms r.load stays zero.
    """
    set_time(r, t)
    if r.n_parts > 0:
        load_of(r)


@unit
def flow(r: Run, t: float, x: Array, dx: Array) -> None:
    """Compute dx (nx,) = x'(t, x). The vector dx has to have room for nx + 1 numbers, the last one the pivot.

    t [s] is taken no later than r.limit, so that a step that ends at a break sees the limit from the left. Of
    the held numbers behind the first r.moving only the last p are passed on, the torques on the joints.
    """
    # inp: t, step, t_start, then x from place 3 on, then zeta; `disturb` leaves zeta in r.load
    nx, inp, moving = r.nx, r.inp, r.moving
    copy(x, shift(inp, 3), moving)
    if moving < nx:
        copy(shift(x, nx - r.p), shift(inp, 3 + nx - r.p), r.p)
    disturb(r, min(t, r.limit))
    copy(r.load, shift(inp, 3 + nx), r.n)
    call(r.flow, r.K, inp, dx)
    note(r, dx, dx[nx])  # makes dx[0] NaN, which ends the run, where the pivot is not positive


@inner
def relax(r: Run, x: Array, weight: float, out: Array) -> None:
    """Set the torques of lagging motors in out (nx,) to the command plus `weight` [1] times their distance
    from it in x.
    """
    # x ends with the p commands, since they are the last field, `u`, of `hardware.motors.Line`
    for i in range(r.p):
        aim = x[r.nx - r.p + i]
        out[r.lags + i] = aim + weight * (x[r.lags + i] - aim)


@inner
def relax_slope(r: Run, x: Array, steep: float, dx: Array) -> None:
    """Set the slopes of lagging torques in dx (nx,) to `steep` [1/s] times their distance from the command in x
    (nx,).
    """
    # from index r.lags on x has the p torques of the motors, at its end the p commands
    for i in range(r.p):
        dx[r.lags + i] = steep * (x[r.lags + i] - x[r.nx - r.p + i])


@unit
def remainder(r: Run, t: float, y: Array, N: Array) -> None:
    """Compute the remainder N = (N_w, row 1 of N_E) at (t, y), t [s], y = (w, E), where w' = N_w, E' = A E +
    N_E.

    The disturbance depends on (q, v), so where there is one, x is computed from y for it first.
    """
    # inp: t, step, t_start, then x (or y) from place 3 on, then zeta, which `disturb` leaves in r.load
    inp = r.inp
    if r.n_parts > 0:
        call(r.back, r.K, y, r.out)
        # for the disturbance alone: below y takes the place of x
        copy(r.out, shift(inp, 3), 2 * r.n)
    disturb(r, min(t, r.limit))
    copy(y, shift(inp, 3), r.nx)
    copy(r.load, shift(inp, 3 + r.nx), r.n)
    call(r.remainder, r.K, inp, N)
    note(r, N, N[r.nN])  # makes N[0] NaN, which ends the run, where the pivot is not positive


@inner
def split(r: Run, x: Array, y: Array) -> None:
    """Compute y = (w, E) from x (nx,)."""
    call(r.to, r.K, x, y)


@inner
def join(r: Run, y: Array, x: Array) -> None:
    """Compute x (nx,) from y = (w, E)."""
    call(r.back, r.K, y, x)


# -- events ----------------------------------------------------------------------------------------
@unit
def watch(r: Run, t: float, q: Array, out: Array) -> None:
    """Compute out (4,), the event functions at t [s], q (n,) [rad]: clearance of the swing foot [m], height of
    the hip over its limit [m], time left for the single support [s]; then x of the swing foot [m].
    """
    r.inp[0], r.inp[1], r.inp[2] = t, r.t_start, r.drop
    copy(q, shift(r.inp, 3), r.n)
    call(r.events, r.K, r.inp, out)


@inner
def passed(r: Run, guard: int, fall: float) -> bool:
    """Whether a guard that is below zero at the start of an arc was so before the last event too, and is no
    event. `fall`, how much it falls in the first step, is asked for by Python's twin alone.

    False for a walk: its clearance alone may be below zero without an event, and of that `accepts` decides.
    """
    return False


@inner
def accepts(r: Run, guard: int, te: float) -> bool:
    """Whether the zero that was found at te [s] is an event: a touchdown less than r.least_step ahead of the
    stance foot is none, as of a leg without knees in mid-swing. `tried` has the values there.
    """
    # FOOT_X: place of the swing foot's x, which `watch` puts behind the event functions
    return guard != FOOT_STRIKE or r.tried[FOOT_X] > r.least_step


@inner
def code_of(r: Run, guard: int) -> int:
    """The code with which an arc ends at the event of a guard: STRUCK, FELL or STALLED."""
    if guard == FOOT_STRIKE:
        return STRUCK
    return FELL if guard == HIP_TOO_LOW else STALLED


@inner
def hermite(r: Run, h: float, s: float, out: Array) -> None:
    """Compute out (n,) [rad], the angles q at the fraction s [1] of the step of length h [s] from x0 to x1.

    They lie on the cubic through both states with their rates as slopes; event functions need no more than q.
    """
    for i in range(r.n):
        rise = r.x1[i] - r.x0[i]
        bend = (1.0 - s) * (h * r.x0[r.n + i] - rise) - s * (h * r.x1[r.n + i] - rise)
        out[i] = r.x0[i] + s * rise + s * (1.0 - s) * bend


@inner
def suspect(r: Run, t0: float, t1: float, count: int) -> bool:
    """Whether an event function falls through zero in the step from t0 to t1 [s], by its values at `count`
    equal parts of the step on the cubic of `hermite`.

    A cheap first look at a long step, without evaluating the flow. `after` has the values at t1 already.
    """
    # v, w: the three event functions at the beginning and at the end of a part
    v0, v1, v2 = r.values[0], r.values[1], r.values[2]
    for j in range(1, count + 1):
        w = r.after
        if j < count:
            w = r.tried
            hermite(r, t1 - t0, j / count, r.stage)
            watch(r, t0 + (t1 - t0) * j / count, r.stage, w)
        w0, w1, w2 = w[0], w[1], w[2]
        if v0 > 0.0 >= w0 or v1 > 0.0 >= w1 or v2 > 0.0 >= w2:
            return True
        v0, v1, v2 = w0, w1, w2
    return False


@inner
def lower(r: Run) -> None:
    """Set r.drop, how much lower [m] the ground is where this single support ends, by the steps of the
    ground."""
    r.drop = 0.0
    for i in range(r.n_drops):  # rows (number of the single support, drop at its end)
        if r.drops[2 * i] == r.step:
            r.drop += r.drops[2 * i + 1]


@unit
def node(r: Run, t: float, x: Array, dx: Array) -> None:
    """Write the next row of `nodes` at t [s]: (t, x, dx), x and dx (nx,); or, where r.look is a function, (t,
    step, force from outside (2,), its output).
    """
    nx, row = r.nx, shift(r.nodes, r.count * r.width)
    row[0] = t
    if r.look == 0:
        copy(x, shift(row, 1), nx)
        copy(dx, shift(row, 1 + nx), nx)
    else:
        # r.load is zeta (n,), then the force (2,). With pulled = 0 that force is the constant field `force`
        # alone, and right as it is
        copy(x, shift(r.inp, 3), nx)
        if r.pulled != 0:
            disturb(r, min(t, r.limit))
        set_time(r, t)
        row[1], row[2], row[3] = r.step, r.load[r.n], r.load[r.n + 1]
        call(r.look, r.K, r.inp, shift(row, 4))
    r.count = min(r.count + 1, r.room - 1)  # never past the end of the memory


# -- breaks ----------------------------------------------------------------------------------------
# `hybrid.constants` is plain Python, and compiled code calls decorated functions alone. Both engines compute a
# sample instant by this one expression: another order of its operations would miss a tick by round-off.
at_tick, after_tick = inner(is_tick), inner(next_tick)


@inner
def clock_start(r: Run) -> float:
    """Time [s] from which sample instants are counted in this arc: its start for a clock that restarts at
    impacts, else the start of the run.
    """
    return r.t_arc if r.restart == 1 else r.t_first


@inner
def next_switch(r: Run, t: float, last: float) -> float:
    """The first time after t [s] at which the disturbance switches, at most `last` [s].

    A row of `switches` with step 0 counts from the start of the run, any other from the start of that single
    support.
    """
    first = last
    for i in range(r.n_switches):
        step, s = r.switches[2 * i], r.switches[2 * i + 1]
        if step == r.step:
            s += r.t_start
        if (step == 0.0 or step == r.step) and t < s < first:
            first = s
    return first


@inner
def next_break(r: Run) -> float:
    """The first time after r.t [s] across which no step may go, at most r.t_end: the disturbance switches, a
    sample instant, or the instant from which a torque acts that waited for a part of the period.
    """
    first = next_switch(r, r.t, r.t_end)
    if r.period > 0.0:
        first = min(first, after_tick(r.t, clock_start(r), r.period))
    if r.part > 0.0:
        first = min(first, after_tick(r.t, clock_start(r) + r.part, r.period))
    return first


@unit
def due(r: Run) -> int:
    """Change x0 (nx,) by what is due at r.t: a sample instant, and a torque that has waited for a part of the
    period. Returns 0, or the code of a failure, which leaves x0 as it was.

    The function `tick` also gives q'', and so the slope dx0. Unless motors lag, that is complete (r.sloped),
    and the first step needs no evaluation of the flow.
    """
    n, nx, x, out, dx = r.n, r.nx, r.x0, r.out, r.dx0
    if r.period > 0.0 and at_tick(r.t, clock_start(r), r.period):
        measure(r, x)  # writes the inputs of `tick`
        out[0] = math.nan  # stays, and ends the run, where `tick` is Python's and Ctrl-C stops it
        call(r.tick, r.K, r.inp, out)
        note(r, out, out[nx])  # the least pivot; behind it stands q''
        if not finite(out, nx):
            return broken(r)
        copy(out, x, nx)
        copy(shift(x, n), dx, n)
        copy(shift(out, nx + 1), shift(dx, n), n)
        for i in range(2 * n, nx):
            dx[i] = 0.0
        # moving = 2 n: no lagging motors, and no `tick` in Python, which writes no q''
        r.sloped = 1 if r.moving == 2 * n < nx else 0
    if r.part > 0.0:
        begin = clock_start(r) + r.part
        if r.t >= begin and at_tick(r.t, begin, r.period):
            # the same as `semantics.release`: `waiting` and `u` are the last two fields of
            # `hardware.motors.Line`
            for i in range(r.p):
                x[nx - r.p + i] = x[nx - 2 * r.p + i]
    return 0


@inner
def measure(r: Run, x: Array) -> None:
    """Write the inputs of a sample instant at r.t in x (nx,) to `inp`: (t, step, t_start, x, zeta, force)."""
    copy(x, shift(r.inp, 3), r.nx)
    # limit: just before the next switching time, so that the disturbance has its value from before
    disturb(r, min(r.t, r.limit))
    # OUTSIDE: the force from outside stands behind zeta
    copy(r.load, shift(r.inp, 3 + r.nx), r.n + OUTSIDE)


# -- a solver's steps, which are Python's ----------------------------------------------------------
# The march names both, so the compiled text needs them; runs with SciPy's solvers never come here.
@inner
def solve(r: Run, t_next: float) -> float:
    """Returns r.t, a step of no length, by which the march would end as STEP_FAILED: SciPy's solvers, for which
    this operation is, run in Python alone."""
    return r.t


@inner
def dense(r: Run, s: float) -> None:
    """Does nothing, since no solver runs here."""
