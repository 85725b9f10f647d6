"""The whole walk in compiled code: arcs and strikes until enough of them, the end, or a terminal status."""

from __future__ import annotations

from biped_adrc.engine.kernels.arc import arm, load, save, travel
from biped_adrc.engine.kernels.call import Ints, Rows, data, kernel
from biped_adrc.engine.kernels.laws import copy, jump, lower, row
from biped_adrc.engine.kernels.layout import *
from biped_adrc.types import Array


@kernel
def strike(ints: Ints, floats: Array, numbers: Array, work: Rows, run: Array) -> int:
    """x+ in place of x- in `run`, and the head of the next arc; a status, `run` untouched where it is not 0."""
    P, K, W, s = data(ints), data(numbers), data(work), data(run)
    load(P, W, s)
    x, x_plus = row(P, W, X0), row(P, W, XE)
    code = jump(P, K, W, x, x_plus)
    if code == 0:
        copy(x_plus, x, P[STATES])
        W[FIRED], W[ARMED], W[COUNT] = FOOT_STRIKE, 0.0, 0.0
        save(P, W, s)
    return code


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
    """From `run` over `impacts` strikes, or over any number until END for 0: status and strikes made.

    strikes (m, 1 + 2 nx) gets a row (t, x-, x+) of each; more than m of them are a limit of events.
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
