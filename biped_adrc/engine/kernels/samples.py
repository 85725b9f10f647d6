"""Many walks at once, each moved on by one sample under a torque of its own, in one call from Python.

A sample goes from one sample instant to the next. An impact within it is made on the way; where the clock
restarts with it, a sample instant is due there, and the sample ends. So a walk is the same as in `arc`, and the
torques may be others at every sample instant.

At the end of a sample a function says what is to be seen there, such as what a learner is given
(`biped_adrc.gym.view`).
"""

from __future__ import annotations

from biped_adrc.engine.kernels.arc import *
from biped_adrc.engine.kernels.call import *
from biped_adrc.engine.kernels.laws import *
from biped_adrc.engine.kernels.layout import *
from biped_adrc.types import Array

GIVEN = 8
"""Numbers in `given` for a walk: addresses of P, F, K, W, s, R, place of the torques in K, that function's."""
MOST_ARCS = 100
"""In one sample (EVENT_LIMIT)."""


@unit
def sample(P: Ints, F: Array, K: Array, W: Array, s: Array, R: Array) -> int:
    """s (HEAD + nx,) from a sample instant to the next one; a code, 0 for COMPLETED.

    Nodes go into R behind its first COUNT rows; where it is FULL, those are given up. Where the walk ends, s is
    at its end.
    """
    s[EVERY] = 1.0
    for _ in range(MOST_ARCS):
        start = s[ARC] if P[RESTART] == 1 else F[T_FIRST]
        s[END] = next_tick(F, s[TIME], start)
        code = go_on(P, F, K, W, s, R)
        if code == FULL:
            s[COUNT] = 0.0
            code = go_on(P, F, K, W, s, R)
        if code == STRUCK:
            count = s[COUNT]
            code = land(P, K, W, s)
            s[COUNT] = count
        if code != COMPLETED:
            return code
        if is_tick(F, s[TIME], s[ARC] if P[RESTART] == 1 else F[T_FIRST]):
            return COMPLETED
    return EVENT_LIMIT


@unit
def look(P: Ints, F: Array, K: Array, W: Array, s: Array, law: int, out: Array) -> None:
    """out = law(t, step, t_start, x, zeta, force) in s, as a sample instant there is given them."""
    n, nx, inp, zeta = P[COORDINATES], P[STATES], row(P, W, INP), row(P, W, ZETA)
    load(P, W, s)
    lower(P, F, W)
    copy(row(P, W, X0), shift(inp, 3), nx)
    from_outside(P, F, W, s[TIME], shift(inp, 3 + nx + n))
    inp[0], inp[1], inp[2] = s[TIME], s[STEP], s[START]
    disturb(P, F, W, zeta)
    copy(zeta, shift(inp, 3 + nx), n)
    call(law, K, inp, out)


@kernel
def samples(given: Ints, torques: Rows, seen: Rows, codes: Ints) -> None:
    """One sample of each of N walks whose code is 0, under its row of torques (N, p) [N m].

    given (N GIVEN,), in the order of GIVEN. Codes (N,) become those of `sample`, rows of `seen` what
    that function says after it; those of a walk that has ended stay as they are.
    """
    rows, shown, p = data(torques), data(seen), torques.shape[1]
    for i in range(codes.shape[0]):
        if codes[i] != COMPLETED:
            continue
        at = GIVEN * i
        P, F, K = ints_at(given[at]), floats_at(given[at + 1]), floats_at(given[at + 2])
        W, s = floats_at(given[at + 3]), floats_at(given[at + 4])
        copy(shift(rows, i * p), shift(K, given[at + 6]), p)
        codes[i] = sample(P, F, K, W, s, floats_at(given[at + 5]))
        look(P, F, K, W, s, given[at + 7], shift(shown, i * seen.shape[1]))


@kernel
def looks(given: Ints, seen: Rows) -> None:
    """In seen (1, k) what the function says of a walk where it is; given (GIVEN,)."""
    P, F, K = ints_at(given[0]), floats_at(given[1]), floats_at(given[2])
    look(P, F, K, floats_at(given[3]), floats_at(given[4]), given[7], data(seen))
