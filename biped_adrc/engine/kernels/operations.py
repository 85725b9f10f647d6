"""What the march does with a run in memory: the operations of `hybrid.on_arrays`, around the functions of a
walker.

A function is called by its address, with its inputs in `inp` in the order that `record.Run` has. An
output ends with the least pivot of the matrices inverted; where that is exactly zero, or below it for a
torque beyond the bound, the run is noted as singular or run away and the output made NaN, even where a torque
limit has made a finite number of it.
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
    """One of the six matrices (k, k) of a level; `which` is HALF, HALF_PHI, ..."""
    return shift(r.phi, (MATRICES * level + which) * r.k * r.k)


@inner
def matvec(r: Run, M: Array, y: Array, out: Array) -> None:
    """E of out = M E of y, M (k, k), E (k, p); w of out is left as it is.

    By generated code: k and p are constants in it.
    """
    call(r.matvec, M, shift(y, r.n_slow), shift(out, r.n_slow))


@inner
def apply_input(r: Run, M: Array, factor: float, N: Array, out: Array) -> None:
    """E (k, p) of out += factor M N_E, where only row 1 of N_E is stored."""
    for i in range(r.k):
        weight = factor * M[i * r.k + 1]
        for c in range(r.p):
            out[r.n_slow + i * r.p + c] += weight * N[r.n_slow + c]


# -- the walker ------------------------------------------------------------------------------------
@inner
def broken(r: Run) -> int:
    """The status of a run whose state or slope is not finite: what a function has asked for, else
    NOT_FINITE."""
    return NOT_FINITE if r.lost == 0 else r.lost


@inner
def note(r: Run, out: Array, pivot: float) -> None:
    """Make a function's result NaN where its last output, `pivot`, is not positive, and note the status."""
    if pivot <= 0.0:
        r.lost = SINGULAR if pivot == 0.0 else RAN_AWAY
        out[0] = math.nan


@inner
def slow(r: Run, t: float, x: Array) -> bool:
    """Whether no angle and no rate in x (nx,) is beyond its bound."""
    n, fits = r.n, True
    for i in range(n):
        fits = fits and abs(x[n + i]) <= r.fastest[i] and abs(x[i]) <= r.farthest
    return fits


@inner
def set_time(r: Run, t: float) -> None:
    """The first of the inputs: t [s], single support, its start [s]."""
    r.inp[0], r.inp[1], r.inp[2] = t, r.step, r.t_start


@unit
def load_of(r: Run) -> None:
    """load = sum over the disturbance's terms of (zeta, force), at the time and (q, v) in `inp`."""
    size, K = r.n + 2, r.push
    for i in range(size):
        r.load[i] = 0.0
    for k in range(r.n_parts):
        call(r.parts[PART * k], K, r.inp, r.one)
        add(r.load, 1.0, r.one, r.load, size)
        K = shift(K, r.parts[PART * k + 1])


@inner
def disturb(r: Run, t: float) -> None:
    """load = sum over the disturbance's terms of zeta (n,) [N m] and force (2,) [N], at t [s]; (q, v) are in
    `inp`.
    """
    set_time(r, t)
    if r.n_parts > 0:
        load_of(r)


@unit
def flow(r: Run, t: float, x: Array, dx: Array) -> None:
    """dx (nx,) = x'(t, x); dx (nx + 1,) or longer.

    t [s] is taken no later than r.limit, so that a step that ends at a break sees the limit from the left. Of
    what is held only the last p numbers are passed on, the torques on the joints.
    """
    nx, inp, moving = r.nx, r.inp, r.moving
    copy(x, shift(inp, 3), moving)
    if moving < nx:
        copy(shift(x, nx - r.p), shift(inp, 3 + nx - r.p), r.p)
    disturb(r, min(t, r.limit))
    copy(r.load, shift(inp, 3 + nx), r.n)
    call(r.flow, r.K, inp, dx)
    note(r, dx, dx[nx])


@inner
def relax(r: Run, x: Array, weight: float, out: Array) -> None:
    """Set the torques of lagging motors in out (nx,) to the command plus `weight` [1] times their distance
    from it in x.
    """
    # the last p numbers of x are `hardware.motors.Line.u`, as it is the last field: one behind it would be
    # read here
    for i in range(r.p):
        aim = x[r.nx - r.p + i]
        out[r.lags + i] = aim + weight * (x[r.lags + i] - aim)


@inner
def relax_slope(r: Run, x: Array, steep: float, dx: Array) -> None:
    """Set the slopes of lagging torques to `steep` [1/s] times their distance from the command in x (nx,)."""
    for i in range(r.p):
        dx[r.lags + i] = steep * (x[r.lags + i] - x[r.nx - r.p + i])


@unit
def remainder(r: Run, t: float, y: Array, N: Array) -> None:
    """N = (N_w, row 1 of N_E) at (t, y), t [s], y = (w, E).

    The disturbance depends on (q, v), so where there is one, x of y is computed for it first.
    """
    inp = r.inp
    if r.n_parts > 0:
        call(r.back, r.K, y, r.out)
        copy(r.out, shift(inp, 3), 2 * r.n)
    disturb(r, min(t, r.limit))
    copy(y, shift(inp, 3), r.nx)
    copy(r.load, shift(inp, 3 + r.nx), r.n)
    call(r.remainder, r.K, inp, N)
    note(r, N, N[r.nN])


@inner
def split(r: Run, x: Array, y: Array) -> None:
    """y = (w, E) of x (nx,)."""
    call(r.to, r.K, x, y)


@inner
def join(r: Run, y: Array, x: Array) -> None:
    """x (nx,) of y = (w, E)."""
    call(r.back, r.K, y, x)


# -- events ----------------------------------------------------------------------------------------
@unit
def watch(r: Run, t: float, q: Array, out: Array) -> None:
    """out (4,): the event functions at (t, q), t [s], q (n,) [rad]: clearance [m], hip margin [m], time left
    [s]; then x of the swing foot [m].
    """
    r.inp[0], r.inp[1], r.inp[2] = t, r.t_start, r.drop
    copy(q, shift(r.inp, 3), r.n)
    call(r.events, r.K, r.inp, out)


@inner
def passed(r: Run, guard: int, fall: float) -> bool:
    """False: of a walk's event functions the touchdown alone may be below zero, and `accepts` asks of it."""
    return False


@inner
def accepts(r: Run, guard: int, te: float) -> bool:
    """Whether the crossing found is an event: a touchdown less than least_step ahead of the stance foot is
    none."""
    return guard != FOOT_STRIKE or r.tried[FOOT_X] > r.least_step


@inner
def code_of(r: Run, guard: int) -> int:
    """How an arc ends at the event of a guard."""
    if guard == FOOT_STRIKE:
        return STRUCK
    return FELL if guard == HIP_TOO_LOW else STALLED


@inner
def hermite(r: Run, h: float, s: float, out: Array) -> None:
    """out (n,) [rad] = q at the fraction s of the step of length h [s] from x0 to x1.

    The cubic through both states with their rates as slopes; q alone, since event functions need no more.
    """
    for i in range(r.n):
        rise = r.x1[i] - r.x0[i]
        bend = (1.0 - s) * (h * r.x0[r.n + i] - rise) - s * (h * r.x1[r.n + i] - rise)
        out[i] = r.x0[i] + s * rise + s * (1.0 - s) * bend


@inner
def suspect(r: Run, t0: float, t1: float, count: int) -> bool:
    """Whether an event function falls through zero between `count` points of the Hermite polynomial.

    A cheap first look at a long step: no flow is evaluated. `after` has the values at t1 [s] already.
    """
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
    """drop: how far the steps of the ground lower the ground [m] on which this single support ends."""
    r.drop = 0.0
    for i in range(r.n_drops):
        if r.drops[2 * i] == r.step:
            r.drop += r.drops[2 * i + 1]


@unit
def node(r: Run, t: float, x: Array, dx: Array) -> None:
    """Write the next row of `nodes` at t [s]: x and dx (nx,), or the result of the function `look`."""
    nx, row = r.nx, shift(r.nodes, r.count * r.width)
    row[0] = t
    if r.look == 0:
        copy(x, shift(row, 1), nx)
        copy(dx, shift(row, 1 + nx), nx)
    else:
        copy(x, shift(r.inp, 3), nx)
        if r.pulled != 0:
            disturb(r, min(t, r.limit))
        set_time(r, t)
        row[1], row[2], row[3] = r.step, r.load[r.n], r.load[r.n + 1]
        call(r.look, r.K, r.inp, shift(row, 4))
    r.count = min(r.count + 1, r.room - 1)


# -- breaks ----------------------------------------------------------------------------------------
# `hybrid.constants` is plain Python, and compiled code calls decorated functions alone. Both engines compute a
# sample instant by this one expression: another order of its operations would miss a tick by round-off.
at_tick, after_tick = inner(is_tick), inner(next_tick)


@inner
def clock_start(r: Run) -> float:
    """Time [s] at which the clock of the sample instants began that counts in this arc."""
    return r.t_arc if r.restart == 1 else r.t_first


@inner
def next_switch(r: Run, t: float, last: float) -> float:
    """The first switching time of the disturbance after t [s], at most `last` [s].

    A switch with step 0 counts from the start of the run, any other from the start of that single support.
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
    """The first switching time or sample instant after t [s], at most t_end."""
    first = next_switch(r, r.t, r.t_end)
    if r.period > 0.0:
        first = min(first, after_tick(r.t, clock_start(r), r.period))
    if r.part > 0.0:
        first = min(first, after_tick(r.t, clock_start(r) + r.part, r.period))
    return first


@unit
def due(r: Run) -> int:
    """x0 (nx,) after what is due at t: a sample instant, with dx0 its slope; the torque that waited for a
    part of the period. A status, x0 unchanged where it is not 0.

    The slope comes with the same call; unless motors lag it is complete, and the first step needs no
    evaluation of the flow.
    """
    n, nx, x, out, dx = r.n, r.nx, r.x0, r.out, r.dx0
    if r.period > 0.0 and at_tick(r.t, clock_start(r), r.period):
        measure(r, x)
        out[0] = math.nan  # what stays where Python is interrupted
        call(r.tick, r.K, r.inp, out)
        note(r, out, out[nx])
        if not finite(out, nx):
            return broken(r)
        copy(out, x, nx)
        copy(shift(x, n), dx, n)
        copy(shift(out, nx + 1), shift(dx, n), n)
        for i in range(2 * n, nx):
            dx[i] = 0.0
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
    """The inputs of a function at a sample instant at t in x (nx,): (t, step, t_start, x, zeta, force)."""
    copy(x, shift(r.inp, 3), r.nx)
    disturb(r, min(r.t, r.limit))
    copy(r.load, shift(r.inp, 3 + r.nx), r.n + OUTSIDE)


# -- a solver's steps, which are Python's ----------------------------------------------------------
# The march names both, so the compiled text needs them; runs with SciPy's solvers never come here.
@inner
def solve(r: Run, t_next: float) -> float:
    """No step: the march then ends as STEP_FAILED."""
    return r.t


@inner
def dense(r: Run, s: float) -> None:
    """No solver runs here."""
