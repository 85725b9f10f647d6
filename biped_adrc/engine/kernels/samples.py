"""Many walks at once, each moved on by one sample under a torque of its own, in one call from Python.

A sample goes from one sample instant to the next. An impact within it is made on the way; where the clock
restarts with it, a sample instant is due there, and the sample ends. So a walk is the same as in `arc`, and the
torques may be others at every sample instant.

At the end of a sample a function says what is to be seen there, such as what a learner is given
(`biped_adrc.gym.view`).
"""

from __future__ import annotations

import math

from biped_adrc.engine.kernels.arc import *
from biped_adrc.engine.kernels.call import *
from biped_adrc.engine.kernels.operations import *
from biped_adrc.engine.kernels.record import Ints, Run
from biped_adrc.types import Array

WALK = 3
"""Numbers in `walks` for one: addresses of its run, of its torque among the numbers K, and of the function."""
MOST_ARCS = 100
"""In one sample (EVENT_LIMIT)."""


@unit
def sample(r: Run) -> int:
    """From a sample instant to the next one; a code, 0 for COMPLETED.

    Nodes are kept behind the first r.count; where there is no room, those are given up. Where the walk ends,
    the run is at its end.
    """
    for _ in range(MOST_ARCS):
        r.t_end = next_tick(r, r.t, clock_start(r))
        code = go_on(r)
        if code == FULL:
            r.count = 0
            code = go_on(r)
        if code == STRUCK:
            count = r.count
            code = land(r)
            r.count = count
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
def samples(walks: Ints, torques: Rows, views: Rows, codes: Ints) -> None:
    """One sample of each of N walks whose code is 0, under its row of torques (N, p) [N m].

    walks (N WALK,), in the order of WALK. Codes (N,) become those of `sample`, rows of `views` what that
    function says after it; those of a walk that has ended stay as they are.
    """
    rows, shown, p = data(torques), data(views), torques.shape[1]
    for i in range(codes.shape[0]):
        if codes[i] == COMPLETED:
            r = ints_at(walks[WALK * i])
            copy(shift(rows, i * p), floats_at(walks[WALK * i + 1]), p)
            codes[i] = sample(r)
            look(r, walks[WALK * i + 2], shift(shown, i * views.shape[1]))


@kernel
def looks(walks: Ints, views: Rows) -> None:
    """In views (1, k) what the function says of a walk where it is; walks (WALK,)."""
    look(ints_at(walks[0]), walks[2], data(views))
