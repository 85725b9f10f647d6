"""One arc: the sample instants that are due, steps to the next break, and so on to the first event.

A break is a switching time of the disturbance or a sample instant. A run is a vector s: the head of
`layout`, then x. `arc` goes on from s; `strike`, or another END, makes it the next arc or the next
stretch of the same one. Nodes (t, x, x') go into the rows of R.

`stride` is the whole walk in compiled code, for many walks at once: arcs and impacts until enough
of them, the end, or a terminal status. `hold` is for controllers in Python: it moves the plant to
the next sample instant and computes there what the controller is given.

The order of what happens at equal times is that of `hybrid.simulator`, whose results these loops
repeat.
"""

from __future__ import annotations

import math

import numpy as np

from biped_adrc.engine.kernels.call import *
from biped_adrc.engine.kernels.laws import *
from biped_adrc.engine.kernels.layout import *
from biped_adrc.engine.kernels.segment import node, through
from biped_adrc.types import Array


@inner
def is_tick(F: Array, t: float, start: float) -> bool:
    """Whether t [s] is exactly a sample instant of the clock that began at `start` [s].

    Sample instants are always computed as start + k T, so equality is exact.
    """
    k = np.floor((t - start) / F[PERIOD] + 0.5)
    return t == start + k * F[PERIOD]


@inner
def next_tick(F: Array, t: float, start: float) -> float:
    """The first sample instant after t [s] of the clock that began at `start` [s]."""
    k = np.floor((t - start) / F[PERIOD])
    while start + k * F[PERIOD] <= t:
        k += 1.0
    return start + k * F[PERIOD]


@inner
def next_break(P: Ints, F: Array, W: Array, t: float, start: float) -> float:
    """The first switching time or sample instant after t [s], at most the END of the run."""
    first = next_switch(P, F, W, t, W[END])
    if F[PERIOD] > 0.0:
        first = min(first, next_tick(F, t, start))
    if F[PERIOD_PART] > 0.0:
        first = min(first, next_tick(F, t, start + F[PERIOD_PART]))
    return first


@inner
def release(P: Ints, F: Array, W: Array, t: float, start: float) -> None:
    """Where a fraction of the period has passed since a sample instant, the waiting torque acts: in
    X0 the last p numbers are replaced by the p before them [N m].
    """
    begin = start + F[PERIOD_PART]
    if t >= begin and is_tick(F, t, begin):
        x, nx, p = row(P, W, X0), P[STATES], P[JOINTS]
        for i in range(p):
            x[nx - p + i] = x[nx - 2 * p + i]


@inner
def travel(P: Ints, F: Array, K: Array, W: Array, R: Array) -> int:
    """From X0 at TIME to the first event or END; a code, COMPLETED at END.

    Each round: the sample instant that is due, the release of a waiting torque that is due, then
    steps to the next break. X0 (nx,) and TIME [s] are left where it ended.
    """
    start = W[ARC] if P[RESTART] == 1 else F[T_FIRST]
    while W[TIME] < W[END]:
        t = W[TIME]
        W[LIMIT] = math.inf
        if F[PERIOD] > 0.0 and is_tick(F, t, start):
            code = act(P, F, K, W, t, row(P, W, X0))
            if code != 0:
                return code
        if F[PERIOD_PART] > 0.0:
            release(P, F, W, t, start)
        code = through(P, F, K, W, next_break(P, F, W, t, start), R)
        if code != 0:
            return code
    return COMPLETED


@inner
def arm(P: Ints, F: Array, K: Array, W: Array) -> None:
    """Values of the event functions (GUARDS,) at the start of an arc.

    What is left of the one that has just fired is round-off and taken as zero, which never fires.
    """
    W[ARC] = W[TIME]
    after = row(P, W, AFTER)
    watch(P, F, K, W, W[TIME], row(P, W, X0), after)
    for guard in range(GUARDS):
        fired = W[FIRED] == guard
        W[VALUES + guard] = 0.0 if fired else after[guard]
    W[ARMED] = 1.0


@inner
def load(P: Ints, W: Array, s: Array) -> None:
    """The head of W and row X0 from the run vector s (HEAD + nx,)."""
    copy(s, W, HEAD)
    copy(shift(s, HEAD), row(P, W, X0), P[STATES])
    W[LOST] = 0.0


@inner
def save(P: Ints, W: Array, s: Array) -> None:
    """The run vector s (HEAD + nx,) from the head of W and row X0."""
    copy(W, s, HEAD)
    copy(row(P, W, X0), shift(s, HEAD), P[STATES])


@unit
def go_on(P: Ints, F: Array, K: Array, W: Array, s: Array, R: Array) -> int:
    """From the run vector s (HEAD + nx,), whose ROOM is the rows of R, to the first event or its
    END; a code.

    s is written only where R was not FULL, so that the call can be repeated with more room. An arc
    that ends before its first step leaves one node, so that no arc is empty.
    """
    load(P, W, s)
    lower(P, F, W)
    if W[ARMED] == 0.0:
        arm(P, F, K, W)
    code = travel(P, F, K, W, R)
    if W[EVERY] > 0.0 and W[COUNT] == 0.0 and code != FULL:
        dx = row(P, W, DX0)
        for i in range(P[STATES]):
            dx[i] = 0.0
        if not node(P, W, R, W[TIME], row(P, W, X0), dx):
            code = FULL
    if code != FULL:
        save(P, W, s)
    return code


@kernel
def arc(ints: Ints, floats: Array, numbers: Array, work: Rows, run: Array, kept: Rows) -> int:
    """Go on from `run` (HEAD + nx,) to the first event or its END; a code. `run` is as it was where
    `kept` is FULL.
    """
    run[ROOM] = kept.shape[0]
    return go_on(data(ints), data(floats), data(numbers), data(work), data(run), data(kept))


@unit
def hold(given: Ints, seen: Array) -> int:
    """As `arc`; then in `seen` (t, q, q') there, and behind them what a function says of these.

    given (8,): addresses of P, F, K, W, s and R, of the function, and of its numbers. By addresses, so
    that Python passes two pointers and no arrays.
    """
    P, F, K, W = ints_at(given[0]), floats_at(given[1]), floats_at(given[2]), floats_at(given[3])
    s = floats_at(given[4])
    code, size = go_on(P, F, K, W, s, floats_at(given[5])), 2 * P[COORDINATES]
    if code != FULL:
        seen[0] = s[TIME]
        copy(shift(s, HEAD), shift(seen, 1), size)
        call(given[6], floats_at(given[7]), seen, shift(seen, 1 + size))
    return code


@unit
def land(P: Ints, K: Array, W: Array, s: Array) -> int:
    """x+ in place of x- in s (HEAD + nx,), and the head of the next arc; a status, s untouched where it is
    not 0.
    """
    load(P, W, s)
    x, x_plus = row(P, W, X0), row(P, W, XE)
    code = jump(P, K, W, x, x_plus)
    if code == 0:
        copy(x_plus, x, P[STATES])
        W[FIRED], W[ARMED], W[COUNT] = FOOT_STRIKE, 0.0, 0.0
        save(P, W, s)
    return code


@kernel
def strike(ints: Ints, floats: Array, numbers: Array, work: Rows, run: Array) -> int:
    """x+ in place of x- in `run` (HEAD + nx,), as `land`; a status."""
    return land(data(ints), data(numbers), data(work), data(run))


@kernel
def stride(
    ints: Ints,
    floats: Array,
    numbers: Array,
    work: Rows,
    run: Array,
    impacts: int,
    strikes: Rows,
) -> tuple[int, int]:
    """From `run` (HEAD + nx,) over `impacts` impacts, or over any number until END for 0: status
    and how many were made.

    strikes (m, 1 + 2 nx) gets a row (t, x-, x+) of each; more than m of them end as EVENT_LIMIT. No
    nodes are kept in between.
    """
    P, F, K, W, s = data(ints), data(floats), data(numbers), data(work), data(run)
    nx, made = P[STATES], 0
    load(P, W, s)
    x, x_plus = row(P, W, X0), row(P, W, XE)
    W[EVERY] = 0.0
    while True:
        lower(P, F, W)
        arm(P, F, K, W)
        code = travel(P, F, K, W, data(strikes))
        if code == STRUCK:
            code = EVENT_LIMIT if made >= strikes.shape[0] else jump(P, K, W, x, x_plus)
        elif code == COMPLETED:
            code = TIME_OUT if made < impacts else COMPLETED
            break
        if code != 0:
            break
        strikes[made, 0] = W[TIME]
        for i in range(nx):
            strikes[made, 1 + i], strikes[made, 1 + nx + i] = x[i], x_plus[i]
        copy(x_plus, x, nx)
        W[FIRED] = FOOT_STRIKE
        made += 1
        if made == impacts:
            break
    save(P, W, s)
    return code, made
