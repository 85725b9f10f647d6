"""Calls of a run's functions by address: flow, sample instant, impact, event functions, disturbance.

The inputs of a function are put into row INP of W in the order that `run_plan.LawAddresses` gives;
its outputs go where the caller wants them. An output row ends with the least pivot of the matrices
inverted; where that is exactly zero, or below it for a torque beyond the bound, the run is noted as
singular or run away and the row is made NaN, even where a torque limit has made a finite number of it.
"""

from __future__ import annotations

import math

from biped_adrc.engine.kernels.call import Ints, call, inner, shift, unit
from biped_adrc.engine.kernels.layout import *
from biped_adrc.types import Array


@inner
def row(P: Ints, W: Array, i: int) -> Array:
    """Pointer to work row i (width,)."""
    return shift(W, i * P[WIDTH])


@inner
def copy(x: Array, out: Array, size: int) -> None:
    """out (size,) = x (size,)."""
    for i in range(size):
        out[i] = x[i]


@inner
def copy_held(P: Ints, x: Array, out: Array) -> None:
    """The torques on the joints (p,) [N m]: all that a flow needs of what does not flow."""
    for i in range(P[STATES] - P[JOINTS], P[STATES]):
        out[i] = x[i]


@inner
def finite(x: Array, size: int) -> bool:
    """Whether the sum of squares of x (size,) is finite, as for every state that means anything.

    Four sums side by side, so that no addition waits for the one before it.
    """
    a = b = c = d = 0.0
    for i in range(0, size - 3, 4):
        a += x[i] * x[i]
        b += x[i + 1] * x[i + 1]
        c += x[i + 2] * x[i + 2]
        d += x[i + 3] * x[i + 3]
    for i in range(size - size % 4, size):
        a += x[i] * x[i]
    return a + b + c + d < math.inf


@inner
def regular(dx: Array, size: int) -> bool:
    """Whether every number of dx (size,) is finite, however large; a slope may be huge where its
    square overflows.
    """
    a = b = c = d = 0.0
    for i in range(0, size - 3, 4):
        a += 0.0 * dx[i]
        b += 0.0 * dx[i + 1]
        c += 0.0 * dx[i + 2]
        d += 0.0 * dx[i + 3]
    for i in range(size - size % 4, size):
        a += 0.0 * dx[i]
    return a + b + c + d == 0.0


@inner
def broken(W: Array) -> int:
    """The status of a run whose state (nx,) or slope is not finite: what a function has asked
    for, else NOT_FINITE.
    """
    return NOT_FINITE if W[LOST] == 0.0 else int(W[LOST])


@inner
def note(W: Array, out: Array, pivot: float) -> None:
    """Make a function's result NaN where its last output says that it means nothing, and note the status."""
    if pivot <= 0.0:
        W[LOST], out[0] = SINGULAR if pivot == 0.0 else RAN_AWAY, math.nan


@inner
def slow(P: Ints, F: Array, x: Array) -> bool:
    """Whether no rate in x (nx,) is beyond its bound, and no angle beyond the one bound of all."""
    n, at, fits = P[COORDINATES], P[FASTEST_AT], True
    for i in range(n):
        fits = fits and abs(x[n + i]) <= F[at + i] and abs(x[i]) <= F[at + n]
    return fits


@inner
def disturb(P: Ints, F: Array, W: Array, zeta: Array) -> None:
    """zeta (n,) [N m]: the sum of the disturbance's parts at (t, step, t_start, q, v) in row INP.

    Each part is a function of its own, called by its address with its own parameters in F.
    """
    n, inp, part = P[COORDINATES], row(P, W, INP), row(P, W, PART)
    for i in range(n):
        zeta[i] = 0.0
    for k in range(P[PARTS]):
        at = P[PARTS_AT] + PART_SIZE * k
        call(P[at], shift(F, P[at + 1]), inp, part)
        for i in range(n):
            zeta[i] += part[i]


@unit
def evaluate(
    P: Ints, F: Array, K: Array, W: Array, law: int, t: float, x: Array, out: Array
) -> None:
    """out = law(t, step, t_start, x, zeta) for the flow or the sample instant; out (nx + 1,) or longer.

    t [s] is taken no later than LIMIT, so that a step that ends at a break sees the limit from the
    left. Of a held state only the torques are passed on to the flow.
    """
    n, nx, inp, zeta = P[COORDINATES], P[STATES], row(P, W, INP), row(P, W, ZETA)
    inp[0], inp[1], inp[2] = min(t, W[LIMIT]), W[STEP], W[START]
    given = nx if law == TICK else P[MOVING]
    copy(x, shift(inp, 3), given)
    if given < nx:
        copy_held(P, x, shift(inp, 3))
    disturb(P, F, W, zeta)
    copy(zeta, shift(inp, 3 + nx), n)
    call(P[law], K, inp, out)
    note(W, out, out[nx])


@inner
def flow(P: Ints, F: Array, K: Array, W: Array, t: float, x: Array, dx: Array) -> None:
    """dx (nx,) = x'(t, x), t in [s], x (nx,)."""
    evaluate(P, F, K, W, FLOW, t, x, dx)


@inner
def next_switch(P: Ints, F: Array, W: Array, t: float, last: float) -> float:
    """The first switching time of the disturbance after t [s], at most `last` [s].

    A switch with step 0 counts from the start of the run, any other from the start of that single
    support.
    """
    first = last
    for i in range(P[SWITCHES]):
        at = P[SWITCHES_AT] + 2 * i
        if F[at] == 0.0 or F[at] == W[STEP]:
            s = F[at + 1] if F[at] == 0.0 else W[START] + F[at + 1]
            if t < s < first:
                first = s
    return first


@inner
def from_outside(P: Ints, F: Array, W: Array, t: float, force: Array) -> None:
    """force (2,) from outside on the robot as a whole [N] at t [s], with (q, v) in row INP.

    Only the parts of the disturbance that have a resultant are asked; pure torques have none.
    """
    inp, part = row(P, W, INP), row(P, W, PART)
    force[0] = force[1] = 0.0
    inp[0], inp[1], inp[2] = t, W[STEP], W[START]
    for k in range(P[PARTS]):
        at = P[PARTS_AT] + PART_SIZE * k
        if P[at + 2] != 0:
            call(P[at + 2], shift(F, P[at + 1]), inp, part)
            force[0] += part[0]
            force[1] += part[1]


@inner
def act(P: Ints, F: Array, K: Array, W: Array, t: float, x: Array) -> int:
    """x (nx,) after a sample instant at t [s], and row DX0 its slope.

    On a non-finite result x is left unchanged and an error code returned. The slope comes with the
    same call; unless motors lag it is complete, and the first step needs no evaluation of the flow.
    """
    n, nx, out, dx = P[COORDINATES], P[STATES], row(P, W, OUT), row(P, W, DX0)
    from_outside(P, F, W, t, shift(row(P, W, INP), 3 + nx + n))
    evaluate(P, F, K, W, TICK, t, x, out)
    if not finite(out, nx):
        return broken(W)
    copy(out, x, nx)
    copy(shift(x, n), dx, n)
    copy(shift(out, nx + 1), shift(dx, n), n)
    for i in range(2 * n, nx):
        dx[i] = 0.0
    W[SLOPED] = 1.0 if P[MOVING] == 2 * n else 0.0
    return 0


@unit
def remainder(P: Ints, F: Array, K: Array, W: Array, t: float, y: Array, N: Array) -> None:
    """N = (N_w, N_E) at (t, y), t [s], y = (w, E), N_E in the forced rows only.

    The disturbance depends on (q, v), so where there is one, x of y is computed for it first.
    """
    n, ny = P[COORDINATES], P[SLOW] + P[STIFF] * P[JOINTS]
    inp, zeta = row(P, W, INP), row(P, W, ZETA)
    inp[0], inp[1], inp[2] = min(t, W[LIMIT]), W[STEP], W[START]
    if P[PARTS] > 0:
        call(P[BACK], K, y, row(P, W, OUT))
        copy(row(P, W, OUT), shift(inp, 3), 2 * n)
    disturb(P, F, W, zeta)
    copy(y, shift(inp, 3), ny)
    copy(zeta, shift(inp, 3 + ny), n)
    call(P[REMAINDER], K, inp, N)
    note(W, N, N[P[SLOW] + P[FORCED] * P[JOINTS]])


@inner
def join(P: Ints, K: Array, y: Array, x: Array) -> None:
    """x (nx,) of y = (w, E)."""
    call(P[BACK], K, y, x)


@inner
def jump(P: Ints, K: Array, W: Array, x: Array, out: Array) -> int:
    """out (nx,) = x+ at the impact in x (nx,); a status.

    On success STEP, START and ARC become those of the single support that begins; on failure they
    stay.
    """
    nx, inp = P[STATES], row(P, W, INP)
    inp[0], inp[1] = W[TIME], W[STEP] + 1.0
    copy(x, shift(inp, 2), nx)
    call(P[STRIKE], K, inp, out)
    if out[nx] == 0.0:
        return SINGULAR
    if not finite(out, nx):
        return NOT_FINITE
    W[STEP] += 1.0
    W[START] = W[ARC] = W[TIME]
    return 0


@unit
def watch(P: Ints, F: Array, K: Array, W: Array, t: float, q: Array, out: Array) -> None:
    """out (4,): the event functions at (t, q), t [s], q (n,) [rad]: clearance [m], hip margin [m],
    time left [s]; then x of the swing foot [m].
    """
    inp = row(P, W, INP)
    inp[0], inp[1], inp[2] = t, W[START], W[DROP]
    copy(q, shift(inp, 3), P[COORDINATES])
    call(P[WATCH], K, inp, out)


@inner
def lower(P: Ints, F: Array, W: Array) -> None:
    """DROP: how far the steps of the ground lower the ground [m] on which this single support ends."""
    W[DROP] = 0.0
    for i in range(P[DROPS]):
        at = P[DROPS_AT] + 2 * i
        if F[at] == W[STEP]:
            W[DROP] += F[at + 1]
