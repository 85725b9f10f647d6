"""Many walks at once, each moved on by one sample under its own torque and force, in one call from Python.

A sample goes from one sample instant to the next. An impact within it is made on the way; where the clock
restarts with it, a sample instant is due there, and the sample ends. So a walk is the same as in `arc`, and the
inputs may be others at every sample instant.
"""

from __future__ import annotations

import math

from biped_adrc.engine.kernels.arc import *
from biped_adrc.engine.kernels.call import *
from biped_adrc.engine.kernels.operations import *
from biped_adrc.engine.kernels.record import Ints, Run
from biped_adrc.types import Array

WALK = 3
"""Numbers in `walks` for one: addresses of its run, and of the torque and the force in it; 0 for no walk."""
FOR_STEPPERS = ("sample", "look", "samples", "looks")
"""Units and kernels that are compiled when there is a stepper."""
MOST_ARCS = 100
"""In one sample (EVENT_LIMIT)."""


@unit
def sample(r: Run) -> int:
    """From a sample instant to the next one; a code, 0 for COMPLETED.

    Where there is no room for columns of the table, those in it are given up. Where the walk ends, the run is
    at its end.
    """
    for _ in range(MOST_ARCS):
        r.t_end = next_tick(r, r.t, clock_start(r))
        code = go_on(r)
        if code == FULL:
            r.columns = 0
            code = go_on(r)
        if code == STRUCK:
            code = land(r)
        if code != COMPLETED:
            return code
        if is_tick(r, r.t, clock_start(r)):
            return COMPLETED
    return EVENT_LIMIT


@unit
def look(r: Run, law: int, out: Array) -> None:
    """out = law(t, step, t_start, x, zeta, force) where the run is, as a sample instant there is given
    them."""
    lower(r)
    r.limit = math.inf
    measure(r, r.x0)
    call(law, r.K, r.inp, out)


@kernel
def samples(walks: Ints, inputs: Rows, states: Rows, codes: Ints, impacts: Ints) -> int:
    """One sample of each of N walks whose code is 0, under inputs (N, p + 2): torque [N m] and force [N].

    Gives how many of them end a single support, by an impact or with the walk.

    walks (N WALK,), in the order of WALK. Codes (N,) become those of `sample`, rows of states (N, 2 + nx) are
    (t, step, x) after it; those of a walk that has ended stay as they are. impacts (N,) counts those made.
    """
    given, rows, p, over = data(inputs), data(states), inputs.shape[1] - 2, 0
    for i in range(codes.shape[0]):
        if codes[i] == COMPLETED and walks[WALK * i] != 0:
            r, u = ints_at(walks[WALK * i]), shift(given, i * (p + 2))
            copy(u, floats_at(walks[WALK * i + 1]), p)
            copy(shift(u, p), floats_at(walks[WALK * i + 2]), 2)
            step = r.step
            codes[i] = sample(r)
            impacts[i] = int(r.step - step)
            over += int(impacts[i] > 0 or codes[i] != COMPLETED)
            row = shift(rows, i * states.shape[1])
            row[0], row[1] = r.t, r.step
            copy(r.x0, shift(row, 2), r.nx)
    return over


@kernel
def looks(walks: Ints, laws: Ints, views: Rows) -> None:
    """Rows of views (N, k): what the functions at the addresses laws (N,) say of the walks where they are."""
    rows = data(views)
    for i in range(laws.shape[0]):
        if walks[WALK * i] != 0:
            look(ints_at(walks[WALK * i]), laws[i], shift(rows, i * views.shape[1]))
